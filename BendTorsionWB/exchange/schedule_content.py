# SPDX-License-Identifier: LGPL-2.1-or-later
"""What some members of a schedule are made from, wherever its rows stand in the file."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields, is_dataclass

from BendTorsionWB.exchange.schedule_rows import Row, Schedule


def content_of(schedule: Schedule, members: Collection[str]) -> tuple:
    """Plain nested values of the settings and of every row these members use, places apart; rows
    that belong to no member count for all, but the shop's statuses, which make nothing."""
    rows = [row for row in schedule.members if row.name in members]
    axes = {row.axis for row in rows}
    used = {
        "members": set(members),
        "axes": axes,
        "surfaces": {row.surface for row in schedule.axes if row.name in axes}
        | {cut.surface for row in rows for cut in (row.start_cut, row.end_cut) if cut is not None},
        "sections": {segment.section for row in rows for segment in row.segments},
    }
    content = []
    for item in fields(schedule):
        value = getattr(schedule, item.name)
        if item.name == "statuses":
            continue
        if isinstance(value, tuple):
            names = used.get(item.name)
            kept = [row for row in value if _is_used(row, names, members)]
            content.append((item.name, plain(tuple(kept))))
        elif isinstance(value, Row):
            content.append((item.name, plain(value)))
    return tuple(content)


def _is_used(row, names: Collection[str] | None, members: Collection[str]) -> bool:
    if names is not None:
        return row.name in names
    return getattr(row, "member", None) is None or row.member in members


def plain(value):
    """A row as nested tuples of (field, value), its place left out."""
    if is_dataclass(value):
        return tuple(
            (item.name, plain(getattr(value, item.name)))
            for item in fields(value)
            if item.name != "place"
        )
    if isinstance(value, (tuple, list)):
        return tuple(plain(item) for item in value)
    return value
