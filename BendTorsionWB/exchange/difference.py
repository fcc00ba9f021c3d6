# SPDX-License-Identifier: LGPL-2.1-or-later
"""The difference of two schedules: what changed, per member and property."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass

from BendTorsionWB.exchange.file_kind import CHANGES, check_ending
from BendTorsionWB.exchange.renames import Reference, renames
from BendTorsionWB.exchange.schedule_cells import Cut, Joints
from BendTorsionWB.exchange.schedule_rows import PartRow, Row, Schedule
from BendTorsionWB.exchange.whole_file import write_whole
from BendTorsionWB.exchange.xlsx_file import TEXT, Column, Table, xlsx_bytes


@dataclass(frozen=True)
class Change:
    """One difference. what: `added`, `removed`, `changed`, or `renamed` from before to after by its
    looks (the same content under another name) or, with the property Label, by its label in the
    document; kind and name: of the row or object; member: those
    it concerns, parted by commas."""

    what: str
    kind: str
    name: str
    property: str = ""
    before: object = None
    after: object = None
    member: str = ""

    def line(self) -> str:
        """The change as one line."""
        concerned = f" (members {self.member})" if self.member not in ("", self.name) else ""
        if self.what == "renamed":
            by = "label" if self.property == "Label" else "content"
            return f"renamed, by its {by}: {self.kind} {self.before} -> {self.after}{concerned}"
        if self.what != "changed":
            return f"{self.what}: {self.kind} {self.name}{concerned}"
        figures = f"{_shown(self.before)} -> {_shown(self.after)}"
        row = f"{self.kind} {self.name}".rstrip()
        return f"{row}: {self.property} {figures}{concerned}"


# Fields of a Schedule whose rows have no name of their own are named by these.
_KEYS = ("member", "face", "number", "joint", "seam", "piece", "node")


def schedule_changes(before: Schedule, after: Schedule) -> tuple[Change, ...]:
    """What changed from one schedule to another, in the order of the sheets; where a row stands in
    the file is no part of it."""
    rows = _rows(before), _rows(after)
    old, new = ({key: _paths(row) for key, row in own.items()} for own in rows)
    concerned = [_members_by_row(schedule) for schedule in (before, after)]
    gone, came = _contents(rows[0], new), _contents(rows[1], old)
    renamed = renames(gone, came, _NAMED)
    changes = [
        Change("renamed", kind, name, "", was, name, concerned[1].get((kind, name), ""))
        for (kind, was), name in renamed.items()
    ]
    told = {*renamed, *((kind, name) for (kind, _), name in renamed.items())}
    for kind, name in [key for key in old if key[0] == "statuses" and key not in new]:
        member, _, rest = name.rpartition("-")
        now = (kind, f"{renamed.get(('members', member))}-{rest}")
        if new.get(now) == old[kind, name]:
            told |= {(kind, name), now}
    for key in dict.fromkeys((*old, *new)):
        kind, name = key
        members = concerned[1].get(key) or concerned[0].get(key, "")
        if told & {key, _owner(rows[1].get(key) or rows[0][key])}:
            continue
        if key not in new:
            changes.append(Change("removed", kind, name, member=members))
        elif key not in old:
            changes.append(Change("added", kind, name, member=members))
        else:
            one, other = old[key], new[key]
            changes += _left(key, concerned, {*old} ^ {*new}, told)
            for path in dict.fromkeys((*one, *other)):
                if one.get(path) != other.get(path):
                    values = one.get(path), other.get(path)
                    changes.append(Change("changed", kind, name, path, *values, member=members))
    return tuple(changes)


def _left(key, concerned, whole: Collection, told: Collection) -> list[Change]:
    """That an axis in both schedules has lost, or got, its only members with their rows. whole:
    keys of rows in one schedule alone; told: those of renamed ones."""
    was, now = (names.get(key, "") for names in concerned)
    rows = {("members", name) for name in (was or now).split(", ")}
    if key[0] != "axes" or bool(was) == bool(now) or not rows <= {*whole} - {*told}:
        return []
    return [Change("changed", *key, "member", was or None, now or None, member=was or now)]


_NAMED = ("surfaces", "materials", "sections", "axes", "members")
"""Tables whose rows have names of their own, each after those its rows refer to."""
_REFERENCES = {"surface": "surfaces", "material": "materials", "section": "sections"}
_REFERENCES["axis"] = "axes"
"""Tables the cells of these columns refer to."""


def _owner(row) -> tuple[str, str]:
    """Kind and name of the member a row is part of, empty for a row of its own."""
    member = getattr(row, "member", None)
    return ("members", member) if isinstance(member, str) else ("", "")


def _contents(rows: Mapping[tuple[str, str], Row], others: Mapping) -> dict:
    """What rows with names say, those of others apart; that of members with all rows of theirs."""
    found: dict[tuple[str, str], dict] = {}
    for key, row in rows.items():
        owner = _owner(row) if _owner(row)[1] else key
        if owner in others or owner[0] not in _NAMED:
            continue
        content = found.setdefault(owner, {})
        # Named by the rest of its name: in which order rows stand says nothing.
        number = key[1].removeprefix(owner[1]) if owner != key else ""
        for path, value in _paths(row).items():
            table = _REFERENCES.get(path.rpartition(" ")[2])
            if (table, value) == owner:
                continue
            if table and isinstance(value, str):
                value = Reference(table, value)
            content[(key[0], number, path)] = value
    return found


def _rows(schedule: Schedule) -> dict[tuple[str, str], Row]:
    """The rows by kind and name."""
    rows: dict[tuple[str, str], Row] = {}
    for item in fields(schedule):
        value = getattr(schedule, item.name)
        if isinstance(value, Row):
            rows[item.name, ""] = value
        elif isinstance(value, tuple):
            for index, row in enumerate(value, start=1):
                kind, name = _kind(item.name, row), _name(row, index)
                while (kind, name) in rows:
                    name += " +"
                rows[kind, name] = row
    return rows


def _kind(table: str, row) -> str:
    """The sheet of a row, in small letters; rows of all sheets about plates are in one table."""
    return row.sheet.lower() if isinstance(row, PartRow) else table


def _name(row, index: int) -> str:
    name = getattr(row, "name", None)
    if isinstance(name, str):
        return name
    cells = dict(getattr(row, "cells", ()))
    given = [cells.get(key, getattr(row, key, None)) for key in _KEYS]
    words = [str(word) for word in given if word is not None]
    place = cells.get("s", cells.get("from"))
    if place is not None:
        words.append(_plain_place(str(place)))
    return " ".join(words) or str(index)


# Fields that are no word of a sheet: what is below them belongs to the row itself.
_WITHIN = ("cells", "sizes", "patterns", "allowances")
_COLUMN_OF = {
    ("MemberRow", "offset_y"): "member_offset_y",
    ("MemberRow", "offset_z"): "member_offset_z",
    ("PatternInput", "surface"): "flattened_surface",
    ("Allowances", "joint"): "joint_allowance",
    ("Allowances", "diaphragm"): "diaphragm_allowance",
}
"""Of fields named otherwise than their columns: these."""
_IN_UNIT = {
    "roll": math.degrees,
    "angle": math.degrees,
    "site_rotation": math.degrees,
    "density": lambda density: density * 1e9,
}
"""Of fields in other units than their columns: what makes the column's of them."""


def _paths(value, path: str = "") -> dict[str, object]:
    """Every single value below a row by its path, as its cell says it; rows within rows by their
    number, `segment 2 slope`."""
    if isinstance(value, (Cut, Joints)):
        return {path: _place(value)}
    if is_dataclass(value):
        found = {}
        for item in fields(value):
            if item.name not in ("place", "name", "member", "sheet"):
                word = _COLUMN_OF.get((type(value).__name__, item.name), item.name)
                below = path if item.name in _WITHIN else f"{path} {word}".strip()
                found |= _paths(getattr(value, item.name), below)
        return found
    if isinstance(value, tuple) and any(is_dataclass(item) for item in value):
        found = {}
        for index, item in enumerate(value, start=1):
            number = getattr(item, "number", index)
            found |= _paths(item, f"{path.removesuffix('s')} {number}")
        return found
    if isinstance(value, tuple) and value and all(_is_named(item) for item in value):
        found = {}
        for name, item in value:
            found |= _paths(item, f"{path} {name}".strip())
        return found
    in_unit = _IN_UNIT.get(path.rpartition(" ")[2])
    if in_unit is not None and isinstance(value, float):
        return {path: float(f"{in_unit(value):.12g}")}
    return {path: _plain_place(value) if isinstance(value, str) else value}


def _is_named(item) -> bool:
    return isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], str)


def _place(value: Cut | Joints) -> str:
    """A place or places as in a cell: `35%`, `7200`, `0.3 0.6`, `auto`."""
    if isinstance(value, Joints):
        none = "auto" if value.kind == "auto" else "none"
        return " ".join(f"{own:.12g}" for own in value.values) or none
    return f"{100.0 * value.value:.12g}%" if value.is_ratio else f"{value.value:.12g}"


def _plain_place(words: str) -> str:
    """`80.0%` and `2500.0`, as rows of plates keep their places, as `80%` and `2500`."""
    return re.sub(r"^(\d+)\.0(%?)$", r"\1\2", words)


def _members_by_row(schedule: Schedule) -> dict[tuple[str, str], str]:
    """The members each surface, axis, section and row of a member concerns."""
    found: dict[tuple[str, str], list[str]] = {}

    def note(kind, name, member):
        names = found.setdefault((kind, name), [])
        if member not in names:
            names.append(member)

    surfaces = {axis.name: axis.surface for axis in schedule.axes}
    materials = {section.name: section.material for section in schedule.sections}
    for row in schedule.members:
        note("members", row.name, row.name)
        note("axes", row.axis, row.name)
        note("surfaces", surfaces[row.axis], row.name)
        for segment in row.segments:
            note("sections", segment.section, row.name)
            note("materials", materials[segment.section], row.name)
    for index, row in enumerate(schedule.nodes, start=1):
        for member in (row.through, row.other):
            note("nodes", _name(row, index), member)
    for row in schedule.statuses:
        # A mark is `M1-T3`, and a member's name may have a hyphen as well.
        for member in {own.name for own in schedule.members} & {row.name.rpartition("-")[0]}:
            note("statuses", row.name, member)
    for item in fields(schedule):
        value = getattr(schedule, item.name)
        for index, row in enumerate(value if isinstance(value, tuple) else (), start=1):
            if isinstance(getattr(row, "member", None), str):
                note(_kind(item.name, row), _name(row, index), row.member)
    return {key: ", ".join(names) for key, names in found.items()}


COLUMNS = (
    Column("member", TEXT, 16),
    Column("what", TEXT, 10),
    Column("kind", TEXT, 12),
    Column("name", TEXT, 16),
    Column("property", TEXT, 22),
    Column("before", "General", 24),
    Column("after", "General", 24),
)


def change_rows(changes: Iterable[Change]) -> list[tuple]:
    """The changes as rows of COLUMNS."""
    return [
        (c.member, c.what, c.kind, c.name, c.property, _cell(c.before), _cell(c.after))
        for c in changes
    ]


def write_changes(changes: Sequence[Change], path: str | os.PathLike) -> None:
    """Write changes as .xlsx, .csv or .json, by the ending. Raises BendTorsionError, for another
    ending too."""
    from BendTorsionWB.exchange.csv_folder import csv_bytes

    check_ending(path, CHANGES)
    ending = os.fspath(path).lower().rpartition(".")[2]
    if ending == "json":
        rows = [{**asdict(c), "before": _cell(c.before), "after": _cell(c.after)} for c in changes]
        write_whole(path, (json.dumps(rows, indent=1, ensure_ascii=False) + "\n").encode())
    elif ending == "csv":
        header = [column.name for column in COLUMNS]
        write_whole(path, csv_bytes([header, *change_rows(changes)]))
    else:
        write_whole(path, xlsx_bytes([Table("Changes", COLUMNS, change_rows(changes))], "Changes"))


def _cell(value):
    if isinstance(value, bool):
        return _shown(value)
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return value if value is None or isinstance(value, (int, float, str)) else _shown(value)


def _shown(value) -> str:
    if value is None or value == "":
        return "nothing"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    if is_dataclass(value):
        value = tuple(getattr(value, item.name) for item in fields(value))
    if isinstance(value, Mapping):
        value = tuple(value.items())
    if isinstance(value, (tuple, list)):
        return " ".join(_shown(item) for item in value) or "nothing"
    return str(value)
