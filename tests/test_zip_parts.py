# SPDX-License-Identifier: LGPL-2.1-or-later
"""Archives of parts packed before, and tables whose rows were made before."""

import io
import random
import zipfile
import zlib

import openpyxl
import pytest

from BendTorsionWB.exchange.xlsx_file import (
    TENTH,
    TEXT,
    WHOLE,
    Column,
    Table,
    row_block,
    xlsx_bytes,
)
from BendTorsionWB.exchange.zip_parts import combined, packed, zip_bytes

COLUMNS = (Column("plate", TEXT, 9), Column("s", TENTH, 9, "mm"), Column("number", WHOLE))
ROWS = [
    ("M1-T1 <&>", 1.5, None),
    (None, None, 3),
    ("=1+1", float("nan"), 4),
    (" two  spaces ", -0.25, 5),
    (None, None, None),
]


@pytest.mark.parametrize("sizes", [(0, 0), (0, 5), (7, 0), (1, 1), (1000, 70000), (3, 2**17)])
def test_the_checksum_of_two_texts_follows_from_those_of_each(sizes):
    one, other = (random.Random(size).randbytes(size) for size in sizes)
    both = combined(zlib.crc32(one), zlib.crc32(other), len(other))
    assert both == zlib.crc32(one + other)


def test_files_of_parts_are_whole_for_another_program():
    texts = ["ä" * 5000, "", "<row/>" * 9000, "end"]
    made = zip_bytes(
        [("a/parts.xml", list(map(packed, texts))), ("empty", []), ("b", [packed("b")])]
    )
    with zipfile.ZipFile(io.BytesIO(made)) as archive:
        assert archive.testzip() is None
        assert archive.read("a/parts.xml").decode() == "".join(texts)
        assert archive.namelist() == ["a/parts.xml", "empty", "b"] and archive.read("empty") == b""
        assert {info.date_time for info in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    assert made == zip_bytes(
        [("a/parts.xml", list(map(packed, texts))), ("empty", []), ("b", [packed("b")])]
    )


def read(content):
    sheet = openpyxl.load_workbook(io.BytesIO(content))["T"]
    return [[cell.value for cell in row] for row in sheet.iter_rows()], sheet.auto_filter.ref


def test_rows_made_before_read_as_rows_written_at_once():
    notes = [("total", 1.25, 9)]
    at_once = xlsx_bytes([Table("T", COLUMNS, ROWS * 3, notes)])
    block = row_block(Table("T", COLUMNS, ROWS))
    nothing = row_block(Table("T", COLUMNS, ()))
    in_parts = xlsx_bytes([Table("T", COLUMNS, ROWS, notes, (block, nothing, block))])
    assert read(in_parts) == read(at_once)
    values, area = read(at_once)
    assert area == "A1:C16" and values[3] == ["=1+1", None, 4]
    assert values[1] == ["M1-T1 <&>", 1.5, None] and values[4][0] == " two  spaces "
    assert values[17] == ["total", 1.25, 9]
