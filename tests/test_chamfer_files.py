# SPDX-License-Identifier: LGPL-2.1-or-later
"""The chamfer of a thicker plate reaches every file of the shop, with the land it leaves."""

from dataclasses import replace

import numpy as np
import pytest
from cut_members import job
from test_nc1 import contour, read

from BendTorsionWB.core.detailing import detail
from BendTorsionWB.core.drawings.sheet_pattern import bevel_text as drawn_bevel
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.members.thickness import Chamfer
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.bevel_record import EdgeBevel
from BendTorsionWB.core.welds.bevels import edge_levels
from BendTorsionWB.exchange.bevel_tables import bevel_tables
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.dxf_bevels import bevel_text, edge_texts
from BendTorsionWB.exchange.nc1 import plate_nc1
from BendTorsionWB.exchange.report import report_json

LENGTH = 8000.0
THICK, THIN = (box(f"B{t}", "box1", 600, 500, t) for t in (20, 16))


def built(first, second):
    """The record of a straight member whose section changes half way."""
    given = job([(0, 0, 0), (LENGTH, 0, 0)], Plane(), section=first)
    segments = (*given.member.segments[:1], Segment(second, LENGTH / 2))
    return detail(replace(given, member=replace(given.member, segments=segments))).record


@pytest.fixture(scope="module")
def thinner():
    return built(THICK, THIN)


@pytest.fixture(scope="module")
def thicker():
    return built(THIN, THICK)


def chamfered(record):
    return [(p, b) for p in record.plates for b in p.bevels if b.chamfer]


def test_every_thick_plate_has_its_chamfer_at_the_joint_and_the_thin_plates_land(thinner, thicker):
    for record, edge in ((thinner, "E-2"), (thicker, "E-1")):
        found = chamfered(record)
        assert len(found) == 4
        for plate, bevel in found:
            assert plate.thickness == 20.0 and bevel.edge == edge
            assert (bevel.chamfer.faces, bevel.chamfer.depth) == ("inner", pytest.approx(4.0))
            assert bevel.chamfer.slope >= 4.0 - 1e-9
            # The plate at the other side of the weld, as thick as the chamfer leaves this one.
            (weld,) = (w for w in record.welds if w.mark == bevel.weld)
            (other,) = (p for p in record.plates if p.mark in weld.plates and p is not plate)
            (own,) = (b for b in other.bevels if b.weld == bevel.weld)
            assert other.thickness == 16.0 and own.chamfer is None
            assert bevel.land(20.0) == pytest.approx(own.land(16.0))


def test_texts_tables_and_report_tell_it(thinner):
    rows = {
        (r[0], r[2]): dict(zip((c.name for c in t.columns), r, strict=True))
        for t in bevel_tables([thinner])[:1]
        for r in t.rows
    }
    listed = {
        p["mark"]: p["chamfers"] for p in report_json([thinner], (), "0")["members"][0]["plates"]
    }
    for plate, bevel in chamfered(thinner):
        chamfer = bevel.chamfer
        text = bevel_text(bevel, plate.marking_face, 20.0)
        assert text.endswith(f"land 2, chamfer 1:4 {chamfer.length:g}x{chamfer.depth:g} up")
        assert text in plate_dxf(plate).decode() and text in edge_texts(plate)
        other = bevel_text(bevel, "outside", 20.0)
        assert other.endswith("4 down") and " up land" in other
        nc1 = plate_nc1(plate).decode()
        assert f"E-2 {text.split(', ')[1]}\r\n" in nc1
        row = rows[plate.mark, "E-2"]
        told = [row[f"chamfer_{name}"] for name in ("slope", "length", "depth", "face")]
        assert told == [chamfer.slope, chamfer.length, chamfer.depth, "inner"]
        assert row["land"] == pytest.approx(2.0)
        (own,) = listed[plate.mark]
        assert (own["edge"], own["face"], own["land_mm"]) == ("E-2", "inner", pytest.approx(2.0))
        assert own["length_mm"] == pytest.approx(own["slope"] * own["depth_mm"])
        assert "chamfer 1:4 × 4" in drawn_bevel(bevel, PLAIN_STYLE)


def test_a_chamfer_without_a_groove_is_a_row_and_leaves_the_torch_a_square_edge(thinner):
    plate, bevel = chamfered(thinner)[0]
    bare = replace(bevel, prep="square", outer=(0.0, 0.0))
    assert bare.is_cut and bare.land(20.0) == 16.0
    assert bevel_text(bare, "inside", 20.0).startswith("chamfer 1:4")
    alone = replace(plate, bevels=(bare,))
    points = contour(dict(read(plate_nc1(alone))["blocks"])["AK"])
    assert not any(any(point[3:]) for point in points)


def test_a_groove_from_the_chamfered_face_is_cut_through_what_the_chamfer_takes():
    angle = np.radians(30.0)
    bevel = EdgeBevel(
        "end", "E-2", "", "", 0.0, 500.0, 0.0, (0.0, 0.0), (angle, 14.0), Chamfer(16.0, 4.0)
    )
    assert bevel.land(20.0) == 2.0 and bevel.cut_depths == (0.0, 18.0)
    levels = edge_levels(bevel, np.zeros(1), np.zeros(1), 20.0)
    assert levels["inner"][0] == pytest.approx(-18.0 * np.tan(angle))
    both = replace(bevel, chamfer=Chamfer(8.0, 2.0, "both"))
    assert both.land(20.0) == 2.0 and both.cut_depths == (0.0, 16.0)
    assert bevel_text(both, "inside", 20.0) == "30.0 deg up land 2, chamfer 1:4 8x2 up/down"
