# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the sheets of a schedule as a workbook or as a folder of CSV files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from BendTorsionWB.exchange.csv_folder import write_folder
from BendTorsionWB.exchange.whole_file import write_whole
from BendTorsionWB.exchange.xlsx_file import Column, Table, xlsx_bytes

WIDEST = 40


def write_schedule(sheets: Mapping[str, Sequence[Sequence]], path: str | Path) -> None:
    """Write sheets, each rows with the headings first, of text, numbers and None: a workbook when
    the path ends in .xlsx, else a folder with a CSV file per sheet. Numbers keep all their digits.
    The same sheets give the same bytes. Raises BendTorsionError."""
    path = Path(path)
    if path.suffix.lower() != ".xlsx":
        write_folder(path, sheets)
        return
    write_whole(path, xlsx_bytes([_table(name, rows) for name, rows in sheets.items()]))


def _table(name: str, rows: Sequence[Sequence]) -> Table:
    headings, *cells = rows
    return Table(
        name,
        [
            Column(heading, "General", _width([heading, *(row[k] for row in cells)]))
            for k, heading in enumerate(headings)
        ],
        cells,
    )


def _width(values: Sequence) -> float:
    longest = max(len(f"{v:.8g}" if isinstance(v, float) else str(v or "")) for v in values)
    return float(min(longest + 3, WIDEST))
