# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cutting list: every plate once, sums that agree, cells no program takes for formulas."""

import csv
import io

import pytest
from flat_plates import annular_sector, member, rectangle

from BendTorsionWB.exchange.cutting_tables import CUTTING, TOTALS, cutting_tables, nesting_csv


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
