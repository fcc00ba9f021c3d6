# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the shop has done with plates: a list of marks and statuses, as a CSV file or a sheet."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.exchange.csv_folder import read_csv
from BendTorsionWB.exchange.revision import STATUSES
from BendTorsionWB.exchange.schedule_columns import SHEETS
from BendTorsionWB.exchange.schedule_headings import heading_name, heading_row
from BendTorsionWB.exchange.schedule_rows import StatusRow
from BendTorsionWB.exchange.schedule_workbook import Place

PROPOSED = 50
"""Marks that are no plate's are told with the nearest one up to this many."""


def read_statuses(path: str | Path) -> tuple[StatusRow, ...]:
    """The rows of a CSV file with the columns plate and status, in Chinese too, titles above them
    passed over; raises BendTorsionError with one finding per bad row."""
    path = Path(path)
    columns = [column.name for column in SHEETS["Status"]]
    rows = [[cell.strip() for cell in row] for row in read_csv(path, columns)] or [[]]
    top = heading_row([[cell.lower() for cell in row] for row in rows], columns)
    names = [heading_name(heading.lower(), columns) for heading in rows[top - 1]]
    if "plate" not in names or "status" not in names:
        place = Place(path.name, "", top)
        message, mend = "no columns plate and status", "write the headings plate,status in row 1"
        raise BendTorsionError(place.error("", "heading-missing", message, mend))
    found, faults = {}, []
    for number, row in enumerate(rows[top:], start=top + 1):
        cells = dict(zip(names, row))
        mark, status = cells.get("plate", ""), cells.get("status", "").lower()
        if not mark and not status:
            continue
        place = Place(path.name, "", number)
        if not mark:
            faults.append(_unnamed(place))
        if status not in STATUSES:
            words = ", ".join(STATUSES)
            fields = {"value": status, "limit": words}
            mend = f"use one of {words}"
            faults.append(place.error("status", "unknown-value", "unknown status", mend, **fields))
        elif mark and mark in found:
            mend = "delete one of the two rows"
            faults.append(
                place.error("plate", "duplicate", f"{mark} is there twice", mend, value=mark)
            )
        found[mark] = StatusRow(place, mark, status)
    if faults:
        raise BendTorsionError(faults)
    return tuple(found.values())


def _unnamed(place: Place) -> Finding:
    mend = "write its mark, or delete the row"
    return place.error("plate", "value-missing", "no plate is named", mend)


def status_findings(
    rows: Iterable[StatusRow], marks: Collection[str], unseen: Collection[str]
) -> tuple[Finding, ...]:
    """An error for each row whose plate there is not: it would guard nothing. marks: of the plates
    there are or were issued; unseen: members of which nothing is known, whose plates pass."""
    starts = tuple(f"{name}-" for name in unseen)
    unknown = [row for row in rows if row.name not in marks and not row.name.startswith(starts)]
    by_plain = {_plain(mark): mark for mark in sorted(marks)} if unknown else {}
    found = []
    for number, row in enumerate(unknown):
        some = list(by_plain) if number < PROPOSED else []
        near = difflib.get_close_matches(_plain(row.name), some, 1)
        found.append(
            row.place.error(
                "plate",
                "plate-unknown",
                "there is no such plate in this build or in an issue",
                f"write {by_plain[near[0]]} if that is meant, or delete the row"
                if near
                else "write the mark as it is on the plate, or delete the row",
                value=row.name,
            )
        )
    return tuple(found)


def _plain(mark: str) -> str:
    """A mark as it compares when it was typed by hand."""
    return mark.casefold().replace("_", "-").replace(" ", "")
