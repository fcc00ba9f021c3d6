# SPDX-License-Identifier: LGPL-2.1-or-later
"""A folder of CSV files, one per sheet, read and written as a workbook is."""

from __future__ import annotations

import csv
import io
import os
import re
import shutil
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import islice
from pathlib import Path

import openpyxl
from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.file_kind import refuse_no_file
from BendTorsionWB.exchange.outside_files import refuse_outside
from BendTorsionWB.exchange.schedule_columns import SHEETS
from BendTorsionWB.exchange.schedule_headings import (
    MOST_CELLS,
    MOST_COLUMNS,
    TITLE_ROWS,
    heading_name,
    sheet_name,
)
from BendTorsionWB.exchange.whole_file import (
    not_written,
    part_beside,
    remove_parts,
    write_changed,
    write_whole,
)

LARGEST_FILE = 50e6
"""Bytes of one file."""
WHOLE = ".whole"
"""Folder within the folder, there only while its files are being written."""
_SEPARATORS = (",", ";", "\t")
_ENCODINGS = ("utf-8-sig", "gb18030")
# With apostrophes of its own before it, so that reading takes away the one put here. Spreadsheets
# set for Chinese take full-width signs as well.
_FORMULA = re.compile("'*[=+\\-@\t\r＝＋－＠]")
_NUMBER = re.compile(r"[+-]?\d+(\.\d*)?([eE][+-]?\d+)?%?")


def read_folder(folder: Path) -> openpyxl.Workbook:
    """A workbook with a sheet per `NAME.csv`, as `parted_folder` reads it."""
    return parted_folder(folder)[0]


def parted_folder(folder: Path) -> tuple[openpyxl.Workbook, dict[str, str]]:
    """A workbook with a sheet per `NAME.csv`, all cells as text, empty ones empty; and what parts
    the cells, by the sheet.

    Comma, semicolon or tab parts the cells, whichever makes most headings of the sheet; UTF-8,
    UTF-16 with its mark, or GB 18030. Where writing the folder was cut short, what was to be in it.
    Raises BendTorsionError for files that cannot be read, that are named after no sheet, or that
    links lead to from outside the folder, unless those are allowed (`outside_files`).
    """
    book = openpyxl.Workbook()
    book.remove(book.active)
    faults, separators = [], {}
    place = folder
    if (folder / WHOLE).is_dir():
        folder = folder / WHOLE
    # A Mac lays a hidden file beside each it copies.
    files = [path for path in folder.glob("[!.]*") if path.suffix.lower() == ".csv"]
    for path in sorted(files, key=lambda path: path.name.lower()):
        columns = [column.name for column in SHEETS.get(sheet_name(path.stem), ())]
        try:
            refuse_no_file(path)
            refuse_outside(place, str(path.relative_to(place)), place.name or str(place))
            rows, separator = _parted(path, columns)
            sheet = book.create_sheet(path.stem)
            separators[path.stem] = separator
        except BendTorsionError as problem:
            faults += problem.findings
            continue
        except ValueError:
            # A name that no sheet of a workbook can have.
            mend, known = "delete or rename it", ", ".join(SHEETS)
            fields = {"value": path.stem, "limit": known}
            faults.append(error("sheet-unknown", path.name, "unknown sheet", mend, **fields))
            continue
        for row in rows:
            # Those without a cell take no time: rows of commas alone have thousands.
            sheet.append({k: cell for k, cell in enumerate(row, start=1) if cell.strip()})
    if faults:
        raise BendTorsionError(faults)
    if not book.worksheets:
        raise BendTorsionError(
            error(
                "file-missing",
                folder.name or str(folder),
                "there is no .csv file in the folder",
                "name a workbook, or a folder with a .csv file for each sheet",
                value=str(folder),
            )
        )
    return book, separators


def read_csv(path: Path, columns: Sequence[str] = ()) -> list[list[str]]:
    """The rows of a CSV file, parted as most of these columns are headings in a row; raises
    BendTorsionError for one that cannot be read."""
    return _parted(path, columns)[0]


def _parted(path: Path, columns: Sequence[str]) -> tuple[list[list[str]], str]:
    """The rows of a CSV file, and what parts its cells; raises BendTorsionError."""
    refuse_no_file(path)
    try:
        return _rows(path, columns)
    except FileNotFoundError:
        mend = "check the folder and the name"
        raise BendTorsionError(
            error("file-missing", path.name, "there is no such file", mend, value=str(path))
        ) from None
    except IsADirectoryError:
        raise BendTorsionError(
            error(
                "file-is-folder",
                path.name,
                "is a folder, not a file",
                "name the .csv file in it",
                value=str(path),
            )
        ) from None
    except (OSError, UnicodeError, csv.Error) as reason:
        message = f"cannot be read as CSV: {getattr(reason, 'strerror', None) or reason}"
        raise BendTorsionError(
            error("file-unreadable", path.name, message, "save it as CSV (UTF-8) again")
        ) from reason


def _rows(path: Path, columns: Sequence[str]) -> tuple[list[list[str]], str]:
    if path.stat().st_size > LARGEST_FILE:
        raise csv.Error(f"larger than {LARGEST_FILE / 1e6:g} MB")
    content = path.read_bytes()
    text = None
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        text = content.decode("utf-16")
    for encoding in _ENCODINGS:
        if text is None:
            try:
                text = content.decode(encoding)
            except UnicodeDecodeError:
                continue
    if text is None:
        raise UnicodeError("save it as UTF-8")
    if ILLEGAL_CHARACTERS_RE.search(text):
        raise csv.Error("it holds control characters")
    lines = max(text.count("\n"), text.count("\r"))
    _refuse_large(path, lines + max(map(text.count, _SEPARATORS)), MOST_CELLS, "cells")
    first = next((line for line in text.splitlines() if line.strip()), "")
    # A title above the headings may hold any of them, or none.
    separator = max(_SEPARATORS, key=lambda by: (_headings(text, by, columns), first.count(by)))
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    read = [[_read(cell) for cell in row] for row in rows]
    _refuse_large(path, max(map(len, read), default=0), MOST_COLUMNS, "columns")
    return read, separator


def _refuse_large(path: Path, count: int, most: int, unit: str) -> None:
    if count > most:
        fields = {"value": count, "limit": most, "unit": unit}
        message, mend = "is larger than a sheet may be", "delete the empty rows and columns in it"
        raise BendTorsionError(error("sheet-too-large", path.name, message, mend, **fields))


def _headings(text: str, separator: str, columns: Iterable[str]) -> int:
    """The most of these columns that any of the first rows names."""
    known = set(columns)
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        top = list(islice(rows, TITLE_ROWS))
    except csv.Error:
        return 0
    found = [{heading_name(cell, known) for cell in {*row[:MOST_COLUMNS]}} & known for row in top]
    return max(map(len, found), default=0)


def write_folder(folder: Path, sheets: Mapping[str, Sequence[Sequence]]) -> None:
    """One `NAME.csv` per sheet, rows of text, numbers and None; UTF-8 with the mark Excel needs.
    All sheets together or none: they are made in a folder below, which counts for the whole from
    when it has its name until all of it is copied. Files of other sheets that a schedule may have
    are removed. Raises BendTorsionError."""
    whole = folder / WHOLE
    part = part_beside(whole)
    made = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        remove_parts(folder)
        if whole.is_dir():
            _into(whole, folder)
        for name, rows in sheets.items():
            write_whole(part / f"{name}.csv", csv_bytes(rows))
        os.rename(part, whole)
        _into(whole, folder)
    except BendTorsionError as problem:
        # Of a file in a folder that is hidden and gone by now.
        raise BendTorsionError(replace(f, object=str(folder)) for f in problem.findings) from None
    except OSError as failure:
        raise BendTorsionError(not_written(folder, failure)) from failure
    finally:
        shutil.rmtree(part, ignore_errors=True)
        if made:
            # Nothing could be written into it.
            with suppress(OSError):
                folder.rmdir()


def _into(whole: Path, folder: Path) -> None:
    """Copy what counts for a folder into it, and let the folder count again."""
    names = {path.name for path in whole.iterdir()}
    for name in sorted(names):
        write_changed(folder / name, (whole / name).read_bytes())
    for sheet in SHEETS:
        if f"{sheet}.csv" not in names:
            (folder / f"{sheet}.csv").unlink(missing_ok=True)
    done = part_beside(whole)
    os.rename(whole, done)
    shutil.rmtree(done, ignore_errors=True)


def csv_bytes(rows: Sequence[Sequence]) -> bytes:
    """Rows of text, numbers and None as a CSV file; UTF-8 with the mark Excel needs."""
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerows([[_written(cell) for cell in row] for row in rows])
    return stream.getvalue().encode("utf-8-sig", "replace")


def _written(cell):
    """A cell as written; text no spreadsheet takes for a formula: with an apostrophe before it."""
    if cell is None:
        return ""
    if isinstance(cell, str) and _FORMULA.match(cell) and not _NUMBER.fullmatch(cell):
        return f"'{cell}"
    return cell


def _read(cell: str) -> str:
    """A cell without the apostrophe `_written` puts before it."""
    return cell[1:] if cell[:1] == "'" and _FORMULA.match(cell[1:]) else cell
