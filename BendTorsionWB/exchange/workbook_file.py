# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens an xlsx file that may be damaged, encrypted, packed to burst, or hold entities."""

from __future__ import annotations

import io
import math
import os
import posixpath
import re
import warnings
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import openpyxl
from openpyxl.utils.cell import coordinate_to_tuple
from openpyxl.utils.exceptions import InvalidFileException

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.file_kind import refuse_no_file

LARGEST_UNPACKED = 200e6
"""Bytes a workbook may unpack to."""

# What openpyxl, zipfile and the XML parser raise on damaged files; each means "unreadable".
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    InvalidFileException,
    OSError,
    EOFError,
    SyntaxError,
    LookupError,
    ValueError,
    TypeError,
    AttributeError,
    ArithmeticError,
    AssertionError,
    RuntimeError,
)
_OLE_MAGIC = bytes.fromhex("D0CF11E0A1B11AE1")
_SAVE_AS_XLSX = "save it as an Excel workbook (.xlsx) in a spreadsheet program"
_SHEET = re.compile(r"/?xl/worksheets/[^/]+\.xml")
_ROW = b'<row r="'
_EMPTY_ROW = re.compile(rb'<row r="[0-9]+"[^<>]*(?:/>|>\s*(?:<c [^<>]*(?:/>|>\s*</c>)\s*)*</row>)')
_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


@dataclass(frozen=True)
class NoNumber:
    """A numeric cell whose figure is none."""

    sheet: str
    column: str
    row: int
    figure: str


def open_workbook(path: Path) -> tuple[openpyxl.Workbook, dict, list[NoNumber]]:
    """The workbook with cached values; {sheet: {(row, column): 'formula' | 'number'}} of its cells
    that have a value element but no value (a formula without its cached value, or an empty number,
    which is how programs write NaN); and its numeric cells that hold none.

    Raises BendTorsionError with one finding when the file cannot be opened as a workbook.
    """

    def refuse(code, message, mend, **fields):
        return BendTorsionError(error(code, path.name or str(path), message, mend, **fields))

    refuse_no_file(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        mend = "check the folder and the name"
        raise refuse("file-missing", "there is no such file", mend, value=str(path)) from None
    except IsADirectoryError:
        mend = "name the workbook itself"
        raise refuse("file-unreadable", "this is a folder", mend, value=str(path)) from None
    except OSError as reason:
        mend = "check that you may read it and that no other program locks it"
        message = f"the file cannot be read: {os.strerror(reason.errno or 0)}"
        raise refuse("file-unreadable", message, mend) from None
    if not content:
        raise refuse("not-xlsx", "the file is empty", "restore it or write it again")
    if content.startswith(_OLE_MAGIC):
        if "EncryptedPackage".encode("utf-16-le") in content:
            mend = "save it without a password"
            raise refuse("file-encrypted", "the workbook is encrypted", mend)
        raise refuse("not-xlsx", "an old Excel file (.xls), not a workbook (.xlsx)", _SAVE_AS_XLSX)
    if content.startswith(b"PK\3\4") and not zipfile.is_zipfile(io.BytesIO(content)):
        message = "the file is cut short, as when saving or copying it was interrupted"
        raise refuse("file-unreadable", message, "save or copy it again, or restore it")
    if not zipfile.is_zipfile(io.BytesIO(content)):
        raise refuse("not-xlsx", "not an Excel workbook (.xlsx)", _SAVE_AS_XLSX)
    hollow = None
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            unpacked = sum(item.file_size for item in archive.infolist())
            if unpacked > LARGEST_UNPACKED:
                fields = {"value": unpacked, "limit": int(LARGEST_UNPACKED), "unit": "bytes"}
                mend = "delete pictures, and empty formatted rows below the tables"
                raise refuse("file-too-large", "the workbook unpacks to too much", mend, **fields)
            if any(item.flag_bits & 1 for item in archive.infolist()):
                mend = "save it without a password"
                raise refuse("file-encrypted", "the workbook is encrypted", mend)
            if any(_has_entities(archive, item) for item in archive.infolist()):
                mend = f"open it and {_SAVE_AS_XLSX}"
                raise refuse("file-unsafe", "the workbook declares XML entities", mend)
            if "xl/workbook.xml" not in archive.namelist():
                message = "not an Excel workbook (.xlsx)"
                raise refuse("not-xlsx", message, _SAVE_AS_XLSX)
            content = _without_empty_rows(archive)
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            hollow, broken = _scan_cells(archive)
            if broken:
                return openpyxl.Workbook(), hollow, broken
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                workbook = openpyxl.load_workbook(io.BytesIO(content), data_only=True)
    except _DAMAGED as reason:
        message = f"the workbook is damaged ({type(reason).__name__})"
        raise refuse("file-unreadable", message, f"open it and {_SAVE_AS_XLSX}") from None
    return workbook, hollow, []


def _without_empty_rows(archive: zipfile.ZipFile) -> bytes:
    """The archive, not packed, without rows of sheets that hold nothing but formats: of those there
    may be a million, and each takes its time."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as plain:
        for item in archive.infolist():
            content = archive.read(item)
            # Rows and cells without a number stand after the one before.
            if _SHEET.fullmatch(item.filename) and content.count(b"<row") == content.count(_ROW):
                content = _EMPTY_ROW.sub(b"", content)
            plain.writestr(item.filename, content)
    return made.getvalue()


def _has_entities(archive: zipfile.ZipFile, item: zipfile.ZipInfo) -> bool:
    """Whether a part declares a document type, the place where entities are defined: no program
    that writes workbooks does, and what they stand for may be a file of this machine."""
    if not item.filename.lower().endswith((".xml", ".rels", ".vml")):
        return False
    content = archive.read(item)
    declared = "<!DOCTYPE"
    return any(declared.encode(coding) in content for coding in ("ascii", "utf-16-le", "utf-16-be"))


def _scan_cells(archive: zipfile.ZipFile):
    """Cells openpyxl reads as empty though they are not, and numeric cells it would fail on."""
    book = ElementTree.fromstring(archive.read("xl/workbook.xml"))
    relations = ElementTree.fromstring(archive.read("xl/_rels/workbook.xml.rels"))
    targets = {relation.get("Id"): relation.get("Target") for relation in relations}
    hollow: dict[str, dict[tuple[int, int], str]] = {}
    broken = []
    for sheet in book.iter(f"{_MAIN}sheet"):
        title = sheet.get("name")
        part = posixpath.normpath(posixpath.join("/xl", targets[sheet.get(_RELATION)]))[1:]
        holes = hollow.setdefault(title, {})
        with archive.open(part) as stream:
            for _, element in ElementTree.iterparse(stream):
                if element.tag != f"{_MAIN}c":
                    continue
                figure = element.findtext(f"{_MAIN}v")
                kind = element.get("t", "n")
                where = element.get("r")
                if where and not figure and element.find(f"{_MAIN}f") is not None:
                    holes[coordinate_to_tuple(where)] = "formula"
                elif where and kind == "n" and figure is not None and not figure.strip():
                    holes[coordinate_to_tuple(where)] = "number"
                elif where and kind == "n" and figure and not _is_number(figure):
                    letters, row = re.fullmatch(r"([A-Z]+)([0-9]+)", where).groups()
                    broken.append(NoNumber(title, letters, int(row), figure))
                element.clear()
    return hollow, broken


def _is_number(figure: str) -> bool:
    try:
        return math.isfinite(float(figure))
    except ValueError:
        return False
