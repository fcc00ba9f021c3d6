# SPDX-License-Identifier: LGPL-2.1-or-later
"""Zones of a member as a table: groups, slopes and face steps, in files and on the sheet."""

import json

import openpyxl
import pytest
from curved_members import ELLIPSOID, diagonal, irregular
from flat_plates import member as flat_member
from flat_plates import rectangle

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_tables import MOST_ROWS
from BendTorsionWB.core.lofting import ZoneRecord
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.members.zone_table import group_of, zone_records
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.exchange.report import write_report
from BendTorsionWB.exchange.results_workbook import write_results

BIG, SMALL = box("B", "box1", 800, 700, 20), box("S", "box1", 600, 560, 20)
SEGMENTS = (
    Segment(BIG),
    Segment(SMALL, 5000.0, 2.5, align="top", align_to="previous"),
    Segment(BIG, 10000.0, 0.0, align="left"),
    Segment(SMALL, 15000.0, 4.0, align="top-left", offset_z=30.0, transition="smooth"),
)


@pytest.fixture(scope="module")
def geometry():
    axis = detailing.axis_of(AxisInput("A1", irregular(diagonal)), ELLIPSOID)
    return detailing.member_of(detailing.MemberInput("M1", SEGMENTS), axis, ELLIPSOID)


def test_zones_follow_each_other_with_the_paper_s_groups_slopes_and_steps(geometry):
    zones = zone_records(geometry.member.law)
    assert [(z.label, z.group) for z in zones] == [
        ("d-1", "B1"),
        ("b-1", "A1"),
        ("d-2", "A1"),
        ("d-3", "A2"),
        ("b-3", "A3"),
        ("d-4", "A3"),
    ]
    assert [z.start for z in zones[1:]] == [z.end for z in zones[:-1]]
    assert (zones[0].start, zones[-1].end) == (0.0, geometry.member.length)
    by_label = {z.label: z for z in zones}
    # Top faces flush, 800 -> 600 x 560: bottom up 200, sides in by 70.
    assert by_label["b-1"].steps == pytest.approx((0.0, 200.0, -70.0, 70.0))
    assert by_label["b-1"].slope == pytest.approx(2.5)
    assert by_label["b-1"].length == pytest.approx(500.0)
    # A step has its differences where it stands, and no slope; sections of one plane again.
    assert by_label["d-3"].slope is None
    assert by_label["d-3"].steps == pytest.approx((0.0, -400.0 + 200.0, -280.0, -420.0))
    # 800 x 700, left on the axis, to 600 x 560 with its top left corner 30 above it.
    assert by_label["b-3"].steps == pytest.approx((30.0 - 400.0, -570.0 + 400.0, 0.0, 140.0))
    assert by_label["b-3"].slope == pytest.approx(4.0)
    assert by_label["d-2"].steps is None and by_label["d-4"].steps is None


def test_the_measured_corners_step_as_the_table_says(geometry):
    law = geometry.member.law
    for zone in zone_records(law):
        if zone.steps is None or zone.slope is None:
            continue
        cells = [c for c in law.cells if c.label == zone.label]
        before = cells[0].corners_at([cells[0].start])[0]
        after = cells[-1].corners_at([cells[-1].end])[0]
        found = after - before
        assert (found[0, 1], found[2, 1], found[0, 0], found[2, 0]) == pytest.approx(zone.steps)


def test_groups():
    assert [group_of(z) for z in ("d-1", "b-1", "d-2", "b-12", "d-13")] == [
        "B1",
        "A1",
        "A1",
        "A12",
        "A12",
    ]


def test_the_workbook_the_report_and_the_sheet_hold_the_same_zones(geometry, tmp_path):
    zones = zone_records(geometry.member.law)
    record = flat_member("M1", (rectangle(),), zones=zones)
    write_results([record], (), tmp_path / "r.xlsx")
    rows = [*openpyxl.load_workbook(tmp_path / "r.xlsx")["Zones"].values]
    assert rows[0][-4:] == ("d_top", "d_bottom", "d_left", "d_right")
    for row, zone in zip(rows[1:], zones, strict=True):
        assert row[:7] == (
            "M1",
            zone.label,
            zone.group,
            zone.start,
            zone.end,
            zone.length,
            zone.slope,
        )
        assert row[7:] == (zone.steps or (None,) * 4)
    write_report([record], (), "0", tmp_path / "r.json")
    [told] = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))["members"]
    assert [z["d_bottom_mm"] for z in told["zones"]] == [z.steps and z.steps[1] for z in zones]
    table = next(t for t in member_sheets(record)[0].tables if t.header[0] == "zone")
    assert [row[:2] for row in table.rows] == [(z.label, z.group) for z in zones]
    assert table.rows[1][4:] == ("1:2.5", "0.0", "200.0", "-70.0", "70.0")
    assert table.rows[3][4] == "step"


def test_the_sheet_says_how_many_zones_found_no_room():
    zones = tuple(ZoneRecord(f"d-{k}", "B1", k, k + 1.0) for k in range(1, 31))
    sheet = member_sheets(flat_member("M1", (rectangle(),), zones=zones))[0]
    table = next(t for t in sheet.tables if t.header[0] == "zone")
    assert len(table.rows) == MOST_ROWS + 1
    assert table.rows[-1][0] == f"+{30 - MOST_ROWS}"
    assert sum(table.widths) < 180.0
