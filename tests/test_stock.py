# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stock the schedule gives: what it means, in joints, checks, cutting list and nesting list."""

import csv
import io
from dataclasses import replace

import pytest
from cut_members import job
from flat_plates import member, rectangle
from schedule_books import one

from BendTorsionWB.core.detailing import PlatesInput, detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.joints.stock import StockSheet, sheets_for, smallest_for, stock_of
from BendTorsionWB.core.plates.plates import JointRules, Joints
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.solids.member_figures import beyond_stock, with_stock
from BendTorsionWB.exchange.cutting_tables import CUTTING, cutting_tables, nesting_csv
from BendTorsionWB.exchange.schedule_jobs import job_of

WORDS = "12000x2500; 16 10000 x 2000; 16 8000x3000; 30 S460 8000x2200; S460 9000x2000"
STOCK = stock_of(WORDS)


def test_the_words_of_the_stock():
    assert STOCK == (
        StockSheet(12000.0, 2500.0),
        StockSheet(10000.0, 2000.0, 16.0),
        StockSheet(8000.0, 3000.0, 16.0),
        StockSheet(8000.0, 2200.0, 30.0, "S460"),
        StockSheet(9000.0, 2000.0, None, "S460"),
    )
    assert stock_of("") == ()


@pytest.mark.parametrize("thickness", ["16", "16mm", "16 mm", "16 MM,"])
def test_a_thickness_may_say_its_unit(thickness):
    assert stock_of(f"{thickness} 10000x2000") == (StockSheet(10000.0, 2000.0, 16.0),)
    assert stock_of(f"S355 {thickness} 10000x2000") == (StockSheet(10000.0, 2000.0, 16.0, "S355"),)


@pytest.mark.parametrize("words", ["12000", "2500x12000", "16 S355 S460 12000x2500", "1x1", "axb"])
def test_words_that_are_no_stock_are_refused(words):
    with pytest.raises(BendTorsionError, match="stock cannot be read"):
        stock_of(words)


def test_the_sheets_that_say_most_of_a_plate_are_its_own():
    assert [s.length for s in sheets_for(STOCK, 16.0, "S355")] == [10000.0, 8000.0]
    assert [s.length for s in sheets_for(STOCK, 30.0, "S460")] == [8000.0]
    assert [s.length for s in sheets_for(STOCK, 20.0, "S460")] == [9000.0]
    assert [s.length for s in sheets_for(STOCK, 20.0, "S355")] == [12000.0]
    assert sheets_for(STOCK[1:2], 20.0, "S355") == ()
    assert smallest_for(STOCK, 7000.0, 2100.0) == StockSheet(8000.0, 2200.0, 30.0, "S460")
    assert smallest_for(STOCK, 9500.0, 2600.0) is None


def test_plates_beyond_every_sheet_are_warned_of_with_the_sheet():
    rules = JointRules(stock=stock_of("5000x2000; 3000x2500"))
    plate = rectangle(length=4000.0, width=2200.0)
    (finding,) = beyond_stock(plate, rules)
    assert (finding.code, finding.value, finding.limit) == ("beyond-stock", 4000.0, 3000.0)
    (finding,) = beyond_stock(
        rectangle(length=4500.0, width=2600.0, mark="M1-T2"),
        JointRules(stock=stock_of("5000x2000")),
    )
    assert (finding.value, finding.limit) == (2600.0, 2000.0)
    assert beyond_stock(rectangle(length=4900.0, width=1900.0), rules) == []
    # Without stock the rule pack's: longer than any of these.
    assert beyond_stock(plate, JointRules()) == []


def test_joints_and_lanes_by_rule_keep_to_the_stock():
    section = box("B", "box1", 2600, 600, 20)
    given = job([(0, 0, 0), (9000, 0, 0)], Plane(), section=section)

    def made(words):
        rules = JointRules(stock=stock_of(words))
        auto = {face: Joints((), "auto") for face in ("top", "bottom", "left", "right")}
        lanes = {face: Lanes((), "auto") for face in ("left", "right")}
        plates = PlatesInput(auto, rules=rules, lanes=lanes)
        return detail(replace(given, plates=plates)).record

    for words, most, widest, lanes in (
        ("12000x3000", 9000.0, 3000.0, 1),
        ("20 4000x3000; 6000x3000", 4000.0, 3000.0, 1),
        ("20 12000x2000", 9000.0, 2000.0, 2),
    ):
        record = made(words)
        assert max(plate.length for plate in record.plates) <= most + 1e-6
        assert max(plate.width for plate in record.plates) <= widest + 1e-6
        assert len({p.mark[-1] for p in record.plates if p.mark[-1].isalpha()}) == (lanes > 1) * 2
        assert {plate.stock for plate in record.plates} == {
            tuple(map(float, words.split(";")[0].split()[-1].split("x")))
        }
        assert not [f for f in record.findings if f.code == "beyond-stock"]


def test_the_cutting_and_the_nesting_list_name_the_sheet():
    rules = JointRules(stock=stock_of("20 6000x2000; 20 12000x2500"))
    plates = (with_stock(rectangle(length=5000.0), rules), rectangle("M1-T2", thickness=12.0))
    records = [member("M1", plates)]
    cutting, _ = cutting_tables(records)
    names = [column.name for column in CUTTING]
    found = {row[0]: dict(zip(names, row, strict=True)) for row in cutting.rows}
    assert (found["M1-T1"]["stock_length"], found["M1-T1"]["stock_width"]) == (6000.0, 2000.0)
    assert found["M1-T2"]["stock_length"] is None
    head, *rows = csv.reader(io.StringIO(nesting_csv(records).decode("utf-8-sig")))
    assert head[-2:] == ["stock_length", "stock_width"]
    assert [row[-2:] for row in rows] == [["6000", "2000"], ["", ""]]


def test_the_setting_reaches_the_rules_and_is_refused_at_its_cell(read):
    schedule = read({}, lambda sheets: sheets["Settings"].append(["stock", WORDS]))
    assert job_of(schedule, schedule.member("M1")).plates.rules.stock == STOCK
    finding = one(read, {}, lambda sheets: sheets["Settings"].append(["stock", "big"]))
    assert (finding.code, finding.position) == ("bad-stock", "sheet Settings, row 4, column value")
