# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens a schedule workbook and reads its sheets into records of parsed cells with their place."""

from __future__ import annotations

import datetime
from dataclasses import dataclass, replace
from pathlib import Path

from openpyxl.utils import get_column_letter

from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.exchange.csv_folder import parted_folder
from BendTorsionWB.exchange.decimal_marks import DecimalMarks, decimal_marks, holds_numbers
from BendTorsionWB.exchange.file_kind import refuse_no_file
from BendTorsionWB.exchange.output_folder import MANIFEST
from BendTorsionWB.exchange.schedule_cells import BadCell, Percent, did_you_mean
from BendTorsionWB.exchange.schedule_columns import OPTIONAL_SHEETS, SHEETS
from BendTorsionWB.exchange.schedule_headings import (
    MOST_CELLS,
    TITLE_ROWS,
    heading_name,
    heading_row,
    sheet_name,
)
from BendTorsionWB.exchange.workbook_file import open_workbook

_WRITTEN = {
    ("Summary", "Plates", "Checks"): "a results file",
    ("Transmittal",): "the transmittal of a revision",
    ("Changes",): "a list of changes",
    ("Plates",): "the plates since the last issue",
}
"""Sheets that tell a workbook or folder written by this program from a schedule."""


@dataclass(frozen=True)
class Place:
    """A row of a sheet of a file."""

    file: str
    sheet: str
    row: int | None = None

    def position(self, column: str = "") -> str:
        """`sheet Members, row 7, column cut`."""
        parts = [f"sheet {self.sheet}"] if self.sheet else []
        if self.row is not None:
            parts.append(f"row {self.row}")
        if column:
            parts.append(f"column {column}")
        return ", ".join(parts)

    def error(self, column: str, code: str, message: str, mend: str = "", **fields) -> Finding:
        """An error finding at a cell of this row."""
        return error(code, self.file, message, mend, position=self.position(column), **fields)


@dataclass(frozen=True)
class Record:
    """One row: parsed values by column (defaults filled in, None where bad), and cells as given."""

    place: Place
    values: dict
    given: dict
    bad: frozenset

    def __getitem__(self, column: str):
        return self.values[column]

    def error(self, column: str, code: str, message: str, mend: str = "", **fields) -> Finding:
        """An error finding at a cell of this row, with the cell's value."""
        fields.setdefault("value", shown(self.given.get(column)))
        return self.place.error(column, code, message, mend, **fields)


def shown(value):
    """A cell's value in a finding: as a person sees it, long texts cut short."""
    value = plain_cell(value)
    return f"{value[:77]}..." if isinstance(value, str) and len(value) > 80 else value


def plain_cell(value):
    """A cell's value as a person sees it: numbers stay numbers, everything else is text."""
    if isinstance(value, Percent):
        return f"{value * 100:.10g}%"
    if isinstance(value, (bool, datetime.date, datetime.time, datetime.timedelta)):
        return str(value)
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return int(value)
    return value if value is None or isinstance(value, (int, float, str)) else str(value)


def parse_cell(place: Place, column, raw) -> tuple[object, Finding | None]:
    """One cell read by its column: (value, None), or (None, the finding)."""
    if raw is None:
        if column.required:
            mend = f"fill in {column.name}"
            return None, place.error(column.name, "value-missing", "the cell is empty", mend)
        return column.default, None
    try:
        return column.parse(raw), None
    except BadCell as bad:
        fields = {"value": shown(raw), "limit": bad.limit, "unit": bad.unit}
        return None, place.error(column.name, bad.code, bad.message, bad.mend, **fields)


def _parse_marked(place: Place, column, raw, key, marks: DecimalMarks):
    """A cell as `parse_cell` reads it, its numbers with the decimal mark that the file shows."""
    if isinstance(raw, str) and holds_numbers(place.sheet, column, key):
        try:
            raw, written = marks.plain(raw), raw
        except BadCell as bad:
            fields = {"value": shown(raw)}
            return None, place.error(column.name, bad.code, bad.message, bad.mend, **fields)
        value, fault = parse_cell(place, column, raw)
        return value, replace(fault, value=shown(written)) if fault else None
    return parse_cell(place, column, raw)


def read_records(path) -> tuple[dict[str, list[Record] | None], list[tuple[Place, Finding]]]:
    """Every known sheet's rows, and the faults with their places.

    An optional sheet that is absent has no rows; a sheet whose rows cannot be told is None.
    Raises BendTorsionError with one finding when the file cannot be opened as a workbook.
    """
    path = Path(path)
    refuse_no_file(path)
    _refuse_kind(path)
    hollow, broken, separators = {}, [], {}
    if path.is_dir():
        workbook, separators = parted_folder(path)
    else:
        workbook, hollow, broken = open_workbook(path)
    if broken:
        raise BendTorsionError(
            Place(path.name, cell.sheet, cell.row).error(
                cell.column,
                "not-finite",
                "not a finite number",
                "write a number",
                value=shown(cell.figure),
            )
            for cell in broken
        )
    for sheet in workbook.worksheets:
        known = sheet_name(sheet.title)
        if known != sheet.title and known not in workbook.sheetnames:
            hollow[known] = hollow.pop(sheet.title, {})
            # openpyxl would number a name that differs from the present one in its case alone.
            sheet.title = "-"
            sheet.title = known
    _refuse_written(path, workbook.sheetnames)
    marks = decimal_marks(workbook, separators)
    faults: list[tuple[Place, Finding]] = []
    present = [sheet.title for sheet in workbook.worksheets]
    renamed = set()
    for title in workbook.sheetnames:
        place = Place(path.name, title)
        if title not in SHEETS or title not in present:
            near = did_you_mean(title, [name for name in SHEETS if name not in present])
            renamed.add(near)
            mend = f"did you mean {near}? rename it" if near else "delete or rename it"
            limit = ", ".join(SHEETS)
            message, fields = "unknown sheet", {"value": title, "limit": limit}
            faults.append((place, place.error("", "sheet-unknown", message, mend, **fields)))
    records: dict[str, list[Record] | None] = {}
    for title, columns in SHEETS.items():
        place = Place(path.name, title)
        records[title] = [] if title in OPTIONAL_SHEETS and title not in renamed else None
        if title in present:
            holes = hollow.get(title, {})
            records[title] = _read_sheet(workbook[title], place, columns, holes, marks, faults)
        elif title not in OPTIONAL_SHEETS and title not in renamed:
            names = ", ".join(column.name for column in columns if column.required)
            mend = f"add sheet {title} with at least the columns {names}"
            message = f"sheet {title} is missing"
            faults.append((place, place.error("", "sheet-missing", message, mend)))
    return records, faults


def _refuse_kind(path: Path) -> None:
    """Raises BendTorsionError for what is no schedule by its name or record: a document, a single
    CSV file, the folder of a build."""
    name = path.name or str(path)
    lists = {file.stem for file in path.glob("*.csv")}
    if (path / MANIFEST).is_file() and lists <= {"nesting"}:
        raise BendTorsionError(
            error(
                "schedule-is-results",
                name,
                "this is the folder of a build, not a schedule",
                "name the schedule it was made from",
            )
        )
    if path.suffix.lower() == ".fcstd" and path.is_file():
        raise BendTorsionError(
            error(
                "schedule-is-results",
                name,
                "this is a FreeCAD document, not a schedule",
                "name the schedule it was made from, or write it back as one: "
                f"export {name} --out {path.stem}.xlsx",
            )
        )
    if path.suffix.lower() == ".csv" and path.is_file():
        raise BendTorsionError(
            error(
                "not-xlsx",
                name,
                "a single .csv file is no whole schedule",
                "name the folder that holds a .csv file for each sheet",
            )
        )


def _refuse_written(path: Path, names: list[str]) -> None:
    """Raises BendTorsionError for a workbook that tells results: it has their sheets and not the
    one every schedule has."""
    for sheets, kind in _WRITTEN.items():
        if "Members" not in names and set(sheets) <= set(names):
            raise BendTorsionError(
                Place(path.name, "").error(
                    "",
                    "schedule-is-results",
                    f"this is {kind}, not a schedule",
                    "name the schedule it was made from",
                    value=", ".join(sheets),
                )
            )


def _read_sheet(sheet, place, columns, hollow, marks, faults) -> list[Record] | None:
    span = sheet.max_row * sheet.max_column
    if span > MOST_CELLS:
        mend = "delete the empty, formatted rows and columns beyond the table"
        message = f"the sheet reaches to row {sheet.max_row}, column {sheet.max_column}"
        fields = {"value": span, "limit": MOST_CELLS, "unit": "cells"}
        faults.append((place, place.error("", "sheet-too-large", message, mend, **fields)))
        return None
    names = [column.name for column in columns]
    above = [[cell.value for cell in row] for row in sheet.iter_rows(max_row=TITLE_ROWS)]
    top = heading_row(above, names)
    rows = sheet.iter_rows(min_row=top, max_row=_last_row(sheet))
    heading = Place(place.file, place.sheet, top)
    headings = [cell for cell in next(rows, ()) if _raw(cell) is not None]
    if not headings:
        names = ", ".join(column.name for column in columns if column.required)
        mend = f"write the headings in row 1: {names}"
        fault = heading.error("", "heading-missing", "there are no column headings", mend)
        faults.append((heading, fault))
        return None
    by_index, complete = _read_heading(headings, heading, columns, faults)
    records = []
    for cells in rows:
        # A formatted blank string is as empty as no cell at all.
        raw = {cell.column: _raw(cell) for cell in cells}
        holes = {cell.column for cell in cells if (cell.row, cell.column) in hollow}
        if all(value is None for value in raw.values()) and not holes:
            continue
        here = Place(place.file, place.sheet, cells[0].row)
        for index in sorted(index for index in raw if index not in by_index):
            if raw[index] is not None:
                letter = get_column_letter(index)
                mend = f"name the column in row {top} or empty the cell"
                message = "a value in a column without a known heading"
                # A whole column under an unknown heading was reported at the heading.
                if sheet.cell(top, index).value is None:
                    fields = {"value": shown(raw[index])}
                    fault = here.error(letter, "column-unnamed", message, mend, **fields)
                    faults.append((here, fault))
        records.append(_read_row(cells, here, by_index, raw, hollow, marks, faults))
    if not complete:
        return None
    # Points has no rows where every axis comes from a file.
    if not records and place.sheet not in (*OPTIONAL_SHEETS, "Points"):
        message = f"sheet {place.sheet} has no rows"
        mend = "fill in at least one row below the headings"
        faults.append((place, place.error("", "sheet-empty", message, mend)))
    return records


def _last_row(sheet) -> int:
    """The last row with a value: formatted empty ones below the table take no time."""
    return max(
        (row for (row, _), cell in sheet._cells.items() if cell.value is not None), default=1
    )


def _read_heading(cells, place, columns, faults):
    """Declared column by its index in the sheet, and whether every required one is there."""
    declared = {column.name: column for column in columns}
    names = {cell.column: heading_name(cell.value, declared) for cell in cells}
    by_index, renamed = {}, set()
    for index, name in names.items():
        if name not in declared:
            near = did_you_mean(name, [known for known in declared if known not in names.values()])
            renamed.add(near)
            mend = f"did you mean {near}? rename it" if near else "delete or rename the column"
            limit = ", ".join(declared)
            fields = {"value": name, "limit": limit}
            fault = place.error(name, "column-unknown", "unknown column", mend, **fields)
            faults.append((place, fault))
        elif declared[name] in by_index.values():
            mend = "delete or rename one of the two columns"
            fault = place.error(name, "duplicate", "the column is there twice", mend, value=name)
            faults.append((place, fault))
        else:
            by_index[index] = declared[name]
    missing = [
        column.name for column in columns if column.required and column.name not in names.values()
    ]
    for name in missing:
        if name not in renamed:
            mend = f"add a column with the heading {name} in row 1"
            message = f"column {name} is missing"
            faults.append((place, place.error(name, "column-missing", message, mend)))
    return by_index, not missing


def _read_row(cells, place, by_index, raw, hollow, marks, faults) -> Record:
    values, given, bad = {}, {}, set()
    key = next((raw[index] for index, column in by_index.items() if column.name == "key"), None)
    for cell in cells:
        column = by_index.get(cell.column)
        if column is None:
            continue
        hole = hollow.get((cell.row, cell.column))
        fault = None
        if hole == "formula" and raw[cell.column] is None:
            mend = "open and save the file in a spreadsheet program, or write the value itself"
            message = "a formula that was never calculated"
            fault = place.error(column.name, "formula-without-value", message, mend)
        elif hole is not None and raw[cell.column] is None:
            mend = "write a number"
            fields = {"value": "NaN"}
            fault = place.error(column.name, "not-finite", "not a finite number", mend, **fields)
        elif cell.data_type == "e":
            mend = "correct the formula or write the value itself"
            message, fields = "the cell holds an error", {"value": cell.value}
            fault = place.error(column.name, "cell-error", message, mend, **fields)
        if fault is None:
            values[column.name], fault = _parse_marked(place, column, raw[cell.column], key, marks)
        if fault is not None:
            values[column.name] = None
            bad.add(column.name)
            faults.append((place, fault))
        if raw[cell.column] is not None:
            given[column.name] = plain_cell(raw[cell.column])
    for column in SHEETS[place.sheet]:
        values.setdefault(column.name, column.default)
    return Record(place, values, given, frozenset(bad))


def _raw(cell):
    """The cell's value; None when blank, Percent when shown in per cent."""
    value = cell.value
    if isinstance(value, str):
        return value if value.strip() else None
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if is_number and "%" in str(cell.number_format):
        return Percent(value)
    return value
