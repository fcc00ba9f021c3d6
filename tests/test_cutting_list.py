# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cutting list: every plate once, sums that agree, cells no program takes for formulas."""

import csv
import io
import math

import openpyxl
import pytest
from flat_plates import annular_sector, member, rectangle

from BendTorsionWB.exchange.csv_folder import csv_bytes, read_csv
from BendTorsionWB.exchange.cutting_tables import CUTTING, TOTALS, cutting_tables, nesting_csv
from BendTorsionWB.exchange.xlsx_file import TEXT, Column, Table, xlsx_bytes


def records():
    twin = rectangle("M2-T1", part="M1-T1", quantity=2)
    return [
        member("M1", (rectangle(quantity=2), annular_sector(thickness=12.0))),
        member("M2", (twin, rectangle("M2-T2", material="S460"))),
    ]


def rows(table, columns):
    names = [column.name for column in columns]
    return [dict(zip(names, row, strict=True)) for row in table.rows]


def test_parts_are_listed_once_thick_ones_first():
    cutting, _ = cutting_tables(records())
    found = rows(cutting, CUTTING)
    assert [(row["part"], row["quantity"], row["marks"]) for row in found] == [
        ("M1-T1", 2, "M1-T1 M2-T1"),
        ("M2-T2", 1, "M2-T2"),
        ("M1-L1", 1, "M1-L1"),
    ]


def test_totals_are_those_of_the_plates():
    _, totals = cutting_tables(records())
    plates = [plate for record in records() for plate in record.plates]
    found = rows(totals, TOTALS)
    assert sum(row["plates"] for row in found) == len(plates)
    for what in ("area", "mass"):
        whole = sum(getattr(plate, what) for plate in plates)
        assert sum(row[f"net_{what}"] for row in found) == pytest.approx(whole)
        assert sum(row[f"gross_{what}"] for row in found) == pytest.approx(whole)


def test_the_nesting_list_reads_back_and_holds_no_formula():
    nasty = member("M1", (rectangle("=cmd|' /C calc'!A0", part="=cmd|' /C calc'!A0"),))
    text = nesting_csv([*records(), nasty]).decode("utf-8-sig")
    head, *found = csv.reader(io.StringIO(text))
    assert head[:4] == ["part", "thickness", "material", "quantity"]
    assert len(found) == 4 and {row[0] for row in found} >= {"M1-T1", "M1-L1"}
    assert not any(cell[:1] in "=+-@" for row in found for cell in row)


def test_no_cell_of_any_list_is_a_formula_and_all_read_back_as_they_were(tmp_path):
    nasty = ["=1+1", "+A1", "-A1", "@SUM(A1)", "\tx", "'quoted", "-12.5", "+3", "plain", "-5%"]
    path = tmp_path / "list.csv"
    path.write_bytes(csv_bytes([["name"], *([cell] for cell in nasty), [-4.5], [None]]))
    written = [row[0] for row in csv.reader(io.StringIO(path.read_text(encoding="utf-8-sig")))]
    formulas = [c for c in written if c[:1] in ("=", "+", "-", "@", "\t") and not number(c)]
    assert formulas == []
    assert [row[0] for row in read_csv(path)][1:-2] == nasty
    [sheet] = openpyxl.load_workbook(
        io.BytesIO(xlsx_bytes([Table("T", [Column("name", TEXT)], [(cell,) for cell in nasty])]))
    )
    for cell, given in zip(list(sheet["A"])[1:], nasty, strict=True):
        assert (cell.data_type, cell.value) == ("s", given)
        assert cell.quotePrefix or given[0] not in "=+-@\t"


def number(text):
    try:
        return math.isfinite(float(text.rstrip("%")))
    except ValueError:
        return False
