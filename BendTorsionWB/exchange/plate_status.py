# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the shop has done with plates: a list of marks and statuses, as a CSV file or a sheet."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.csv_folder import read_csv
from BendTorsionWB.exchange.revision import STATUSES
from BendTorsionWB.exchange.schedule_workbook import Place


def read_statuses(path: str | Path) -> Mapping[str, str]:
    """Status by mark from a CSV file with the columns plate and status; raises BendTorsionError
    with one finding per bad row."""
    path = Path(path)
    headings, *rows = read_csv(path) or [[]]
    names = [heading.strip().lower() for heading in headings]
    if "plate" not in names or "status" not in names:
        place = Place(path.name, "", 1)
        message, mend = "no columns plate and status", "write the headings plate,status in row 1"
        raise BendTorsionError(place.error("", "heading-missing", message, mend))
    found, faults = {}, []
    for number, row in enumerate(rows, start=2):
        cells = dict(zip(names, (cell.strip() for cell in row)))
        mark, status = cells.get("plate", ""), cells.get("status", "").lower()
        if not mark and not status:
            continue
        place = Place(path.name, "", number)
        if status not in STATUSES:
            words = ", ".join(STATUSES)
            fields = {"value": status, "limit": words}
            mend = f"use one of {words}"
            faults.append(place.error("status", "unknown-value", "unknown status", mend, **fields))
        elif mark in found:
            mend = "delete one of the two rows"
            faults.append(
                place.error("plate", "duplicate", f"{mark} is there twice", mend, value=mark)
            )
        found[mark] = status
    if faults:
        raise BendTorsionError(faults)
    return found
