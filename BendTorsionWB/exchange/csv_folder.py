# SPDX-License-Identifier: LGPL-2.1-or-later
"""A folder of CSV files, one per sheet, read and written as a workbook is."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

import openpyxl

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.whole_file import write_whole

LARGEST_FILE = 50e6
"""Bytes of one file."""
_SEPARATORS = (",", ";", "\t")
_ENCODINGS = ("utf-8-sig", "gb18030")


def read_folder(folder: Path) -> openpyxl.Workbook:
    """A workbook with a sheet per `NAME.csv`, all cells as text, empty ones empty.

    Comma, semicolon or tab parts the cells, whichever the first line holds most of; UTF-8, UTF-16
    with its mark, or GB 18030. Raises BendTorsionError for files that cannot be read.
    """
    book = openpyxl.Workbook()
    book.remove(book.active)
    faults = []
    for path in sorted(folder.glob("*.csv"), key=lambda path: path.name.lower()):
        try:
            rows = read_csv(path)
        except BendTorsionError as problem:
            faults += problem.findings
            continue
        sheet = book.create_sheet(path.stem)
        for row in rows:
            sheet.append([cell if cell.strip() else None for cell in row])
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
    return book


def read_csv(path: Path) -> list[list[str]]:
    """The rows of a CSV file; raises BendTorsionError for one that cannot be read."""
    try:
        return _rows(path)
    except (OSError, UnicodeError, csv.Error) as reason:
        message = f"cannot be read as CSV: {reason}"
        raise BendTorsionError(
            error("file-unreadable", path.name, message, "save it as CSV (UTF-8) again")
        ) from reason


def _rows(path: Path) -> list[list[str]]:
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
    if "\x00" in text:
        raise csv.Error("it holds zero bytes")
    first = next((line for line in text.splitlines() if line.strip()), "")
    separator = max(_SEPARATORS, key=first.count)
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True))


def write_folder(folder: Path, sheets: Mapping[str, Sequence[Sequence]]) -> None:
    """One `NAME.csv` per sheet, rows of text, numbers and None; UTF-8 with the mark Excel needs.
    Raises BendTorsionError."""
    for name, rows in sheets.items():
        write_whole(folder / f"{name}.csv", csv_bytes(rows))


def csv_bytes(rows: Sequence[Sequence]) -> bytes:
    """Rows of text, numbers and None as a CSV file; UTF-8 with the mark Excel needs."""
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerows([["" if cell is None else cell for cell in row] for row in rows])
    return stream.getvalue().encode("utf-8-sig")
