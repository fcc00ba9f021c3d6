# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds that cannot be made are refused at their row; backing bars and marks of welds."""

import math
from dataclasses import replace

import pytest
from cut_members import job

from BendTorsionWB.core.detailing import PlatesInput, detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.joints.pieces import PieceInput
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.diaphragm_input import Diaphragm, closing_of
from BendTorsionWB.core.plates.hole_shape import hole_shape
from BendTorsionWB.core.plates.openings import Opening
from BendTorsionWB.core.plates.plates import Joints
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import polygon
from BendTorsionWB.core.welds.backing_clash import snipe_needed
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import prep_of
from BendTorsionWB.exchange.weld_tables import weld_tables

BOX = box("B", "box1", 600, 500, 20)


def made(*rows, section=BOX, **plates):
    """A straight member, 4 m along x."""
    given = job([(0, 0, 0), (4000, 0, 0)], Plane(), section=section)
    return detail(replace(given, plates=PlatesInput(edges=tuple(rows), **plates))).record


def fault(*rows, **more):
    with pytest.raises(BendTorsionError) as caught:
        made(*rows, **more)
    (finding,) = caught.value.findings
    return finding


def row(where, words, *places):
    return EdgeTreatment(where, *places, prep=prep_of(words))


@pytest.mark.parametrize("kind", ["v", "double-v"])
def test_a_v_is_refused_where_one_plate_alone_ends(kind):
    found = fault(row("BL", f"{kind} angle=60 land=2"))
    assert (found.code, found.position, found.value) == ("prep-corner", "edge 1", kind)
    bevel = kind.replace("v", "bevel")
    assert bevel in found.mend
    record = made(row("BL", f"{bevel} angle=60 land=2"))
    cut = {p.mark: [b for b in p.bevels if b.prep.startswith(bevel)] for p in record.plates}
    # The whole angle on the plate that ends there, nothing on the one that runs through.
    [own] = cut.pop("M1-B1")
    assert math.degrees(own.outer[0]) == pytest.approx(60.0)
    assert not any(cut.values())


def test_a_small_box_needs_a_face_that_is_closed_from_outside():
    """One seam from inside can be welded before the box is closed, two across it cannot both be,
    nor one of the face named to be closed last; a box one gets into has no such order."""
    small = box("S", "box1", 400, 300, 12)
    words = "bevel angle=45 land=2 inner"
    last = Diaphragm(2000.0, 12.0, snipe=30.0, closing=closing_of("top weld 10"))

    def told(*seams, section=small, **more):
        found = made(*(row(name, words) for name in seams), section=section, **more).findings
        return [f for f in found if f.code == "weld-access"]

    assert told("TL") == told("TL", "BL") == told("TL", "BR", section=BOX) == []
    found = told("TL", "BR")
    assert [(f.severity, f.position, f.limit) for f in found] == [
        ("warning", "edge 1", 400.0),
        ("warning", "edge 2", 400.0),
    ]
    assert found[0].value == pytest.approx(276.0) and "276 x 376" in found[0].message
    assert [f.position for f in told("TL", diaphragms=(last,))] == ["edge 1"]
    assert told("BL", diaphragms=(last,)) == []


def test_field_joints_of_a_small_box_are_not_welded_from_inside():
    small = box("S", "box1", 400, 300, 12)
    pieces = (PieceInput(1, end=(2000.0, False)), PieceInput(2))
    inner = row("joints", "v angle=60 land=2 inner")
    found = fault(inner, section=small, pieces=pieces)
    assert (found.code, found.position, found.limit) == ("weld-access", "edge 1", 400.0)
    assert found.value == pytest.approx(276.0) and "piece 2" in found.message
    # Of one wall alone, or with a hand hole to reach through, it is a warning; by size, nothing.
    hole = Opening("top", 1700.0, hole_shape("d=150"))
    top = row("T1/T2", "v angle=60 land=2 inner")
    for record, severities in (
        (made(inner, section=small, pieces=pieces, openings=(hole,)), ["warning"]),
        (made(top, section=small, pieces=pieces), ["warning"]),
        (made(inner, pieces=pieces), []),
        (made(row("joints", "v angle=60 land=2"), section=small, pieces=pieces), []),
    ):
        assert [f.severity for f in record.findings if f.code == "weld-access"] == severities


def test_a_v_stays_where_both_plates_end():
    hexagon = polygon("P", [(300 * math.cos(k), 300 * math.sin(k)) for k in HEX], 16.0)
    record = made(row("AB", "v angle=60 land=2"), section=hexagon)
    grooved = [p.mark for p in record.plates for b in p.bevels if b.prep.startswith("v ")]
    assert len(grooved) == 2
    assert made(row("joints", "v angle=60 land=2"), joints={"top": Joints((0.5,))})


HEX = [math.radians(60 * k) for k in range(6)]


def test_fillets_need_a_ledge_an_angle_and_a_plate_as_thick():
    found = fault(row("TL", "fillet leg=8"))
    assert (found.code, found.value, found.limit) == ("fillet-ledge", 0.0, 8.0)
    assert fault(row("TL", "double-fillet leg=8")).code == "fillet-ledge"
    # Inside, the web runs on below the flange.
    assert {w.prep.leg for w in made(row("TL", "fillet leg=8 inner")).welds if w.row} == {8.0}
    found = fault(row("joints", "fillet leg=8"), joints={"top": Joints((0.5,))})
    assert (found.code, found.value) == ("fillet-angle", pytest.approx(180.0))
    found = fault(row("D1", "fillet leg=80"), diaphragms=(Diaphragm(2000.0, 12.0),))
    assert (found.code, found.value, found.limit) == ("fillet-leg", 80.0, pytest.approx(14.4))


def test_an_end_plate_needs_room_for_the_fillet_of_its_row():
    flush = (Diaphragm(0.0, 20.0, end="end"),)
    assert fault(row("E1", "fillet leg=8"), diaphragms=flush).code == "fillet-ledge"
    assert made(row("E1", "fillet leg=8"), diaphragms=(replace(flush[0], gap=-20.0),))


def test_a_gap_no_weld_bridges_is_refused():
    found = fault(row("TL", "bevel angle=45 land=2 gap=100"))
    assert (found.code, found.position) == ("root-gap-too-wide", "edge 1")
    assert (found.value, found.limit) == (pytest.approx(100.0), 20.0)
    assert fault(row("TL", "fillet leg=8 gap=9 inner")).limit == 5.0
    assert made(row("TL", "bevel angle=30 gap=10 backing=30x6"))


def test_a_range_that_runs_backwards_is_told_as_such():
    found = fault(row("TL", "bevel angle=45 land=2", 3000.0, 1000.0))
    assert (found.code, found.value, found.limit) == ("edge-row-order", 3000.0, 1000.0)


def test_marks_are_unique_and_rows_leave_those_before_and_beside_them():
    groove = "bevel angle=40 land=6"
    joints = {"bottom": Joints((0.75,))}
    plain = made(joints=joints)
    rows = row("BL", groove, 1000.0, 2000.0), row("BL", groove, 1500.0, 1800.0)
    for count in (1, 2):
        record = made(*rows[:count], joints=joints)
        marks = [w.mark for w in record.welds]
        assert len(set(marks)) == len(marks)
        assert {w.mark for w in plain.welds} <= set(marks)
    spans = {w.mark: (w.start, w.end) for w in made(rows[0]).welds if w.name == "BL"}
    assert spans == {
        "M1-BL-B1/L1": (0.0, 1000.0),
        "M1-BL-B1/L1@1000": (1000.0, 2000.0),
        "M1-BL-B1/L1@2000": (2000.0, pytest.approx(4000.0, abs=1e-9)),
    }
    # A row for the whole seam makes the same welds, with the same marks.
    whole = made(row("BL", groove), joints=joints)
    assert [w.mark for w in whole.welds] == [w.mark for w in plain.welds]


def test_the_depth_at_a_thickness_joint_is_that_of_the_thinner_plate():
    given = job([(0, 0, 0), (4000, 0, 0)], Plane(), section=BOX)
    thin = replace(BOX, name="C", strips=tuple(replace(s, thickness=16.0) for s in BOX.strips))
    segments = (Segment(BOX), Segment(thin, 2000.0))
    record = detail(replace(given, member=replace(given.member, segments=segments))).record
    _, table = weld_tables([record])
    names = [column.name for column in table.columns]
    told = {w["weld"]: w["depth"] for w in (dict(zip(names, r, strict=True)) for r in table.rows)}
    steps = [w for w in record.welds if w.kind == "joint" and set(w.thickness) == {16.0, 20.0}]
    assert len(steps) == 4
    for weld in steps:
        cut = {
            b.outer[1]
            for plate in record.plates
            for b in plate.bevels
            if weld.mark in b.weld.split()
        }
        assert cut == {told[weld.mark]} == {14.0}


def test_the_snipe_that_clears_a_bar():
    right = 0.5 * math.pi
    # Its far corner is at (30, 6) from the arris; a snipe of n clears x + y >= n + 2 gaps.
    assert snipe_needed((30.0, 6.0), (0.0, 0.0), right) == pytest.approx(36.0)
    assert snipe_needed((30.0, 6.0), (2.0, 2.0), right) == pytest.approx(32.0)
    assert snipe_needed((30.0, 6.0), (6.0, 2.0), right) == 0.0
    # The same corner by its distance from the line between the ends of the snipe.
    angle = math.radians(70.0)
    needed = snipe_needed((30.0, 6.0), (2.0, 3.0), angle)
    u, w = (1.0, 0.0), (math.cos(angle), math.sin(angle))
    p, q = 3.0 / math.sin(angle), 2.0 / math.sin(angle)
    vertex = p + q * w[0], q * w[1]
    ends = [(vertex[0] + needed * d[0], vertex[1] + needed * d[1]) for d in (u, w)]
    (x0, y0), (x1, y1) = ends
    assert (x1 - x0) * (6.0 - y0) - (y1 - y0) * (30.0 - x0) == pytest.approx(0.0, abs=1e-9)


def test_a_backing_bar_that_meets_a_diaphragm_is_told_with_the_snipe_it_needs():
    groove = row("TL", "bevel angle=45 gap=6 backing=30x6")
    rows = Diaphragm(1000.0, 12.0, 2.0, 20.0), Diaphragm(0.5, 12.0, 2.0, 32.0, s_is_ratio=True)
    (found,) = [f for f in made(groove, diaphragms=rows).findings if f.code == "backing-clash"]
    assert (found.severity, found.position) == ("warning", "diaphragm 1")
    assert (found.value, found.limit) == (20.0, pytest.approx(32.0, abs=0.01))
    assert "snipe of 32 mm" in found.mend
    outside = row("TL", "bevel angle=45 gap=6 backing=30x6 inner")
    assert not [f for f in made(outside, diaphragms=rows).findings if f.code == "backing-clash"]
