# SPDX-License-Identifier: LGPL-2.1-or-later
"""Root gaps: one figure between two plates, in their geometry, patterns, masses and weld list."""

import math
from dataclasses import replace

import pytest
from cut_members import job

from BendTorsionWB.core.detailing import PlatesInput, detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.joints.pieces import PieceInput
from BendTorsionWB.core.plates.plates import Joints
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import polygon
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import Prep
from BendTorsionWB.exchange.schedule_jobs import job_of, located

B6 = Prep("B6", "bevel", math.radians(35), 0.0, 6.0, backing=(30.0, 6.0))
BUTT = Prep("J6", "v", math.radians(45), 0.0, 6.0, backing=(40.0, 6.0))
DENSITY = 7.85e-6
SECTION = box("B", "box1", 800, 600, 20)
LENGTH = 6000.0


def made(rows=(), section=None, joints=None, pieces=()):
    """A straight member along x with these rows of edges: h 800, b 600, t 20."""
    given = job([(0, 0, 0), (LENGTH, 0, 0)], Plane(), section=section or SECTION)
    plates = PlatesInput(joints or {}, edges=tuple(rows), pieces=tuple(pieces))
    return detail(replace(given, plates=plates))


def refused(*arguments, **more):
    with pytest.raises(BendTorsionError) as caught:
        made(*arguments, **more)
    (finding,) = caught.value.findings
    return finding


def of(detailed, mark):
    return next(plate for plate in detailed.record.plates if plate.mark == mark)


def gaps(detailed, name):
    return {weld.prep.gap for weld in detailed.record.welds if weld.name == name}


def test_the_gap_of_a_preparation_comes_off_the_plate_that_stops():
    """Top plate 600 - 2 · 20 - 6 wide: pattern, solid, mass and weld list say the same."""
    plain, open_ = made(), made([EdgeTreatment("TL", prep=B6)])
    assert of(plain, "M1-T1").width == pytest.approx(560.0, abs=1e-6)
    assert of(open_, "M1-T1").width == pytest.approx(554.0, abs=1e-6)
    saved = 6.0 * 20.0 * LENGTH * DENSITY
    assert plain.record.mass - open_.record.mass == pytest.approx(saved, rel=1e-9)
    solid = {item.plate.mark: item.skin_volume for item in open_.plates.plates}
    assert solid["M1-T1"] == pytest.approx(554.0 * 20.0 * LENGTH, rel=1e-9)
    assert gaps(open_, "TL") == {6.0} and gaps(open_, "TR") == {0.0}
    # Its neighbours stay what they are.
    for mark in ("M1-B1", "M1-L1", "M1-R1"):
        assert of(open_, mark).area == pytest.approx(of(plain, mark).area, rel=1e-12)
    assert not open_.record.findings


def test_the_gap_of_a_section_is_the_one_told_where_the_preparation_has_none():
    told = made(section=box("B", "box1", 800, 600, 20, gap1=3, gap2=4))
    assert gaps(told, "TL") == gaps(told, "BL") == {3.0} and gaps(told, "TR") == {4.0}
    alike = made(
        [EdgeTreatment("TL", prep=replace(B6, gap=3.0))], told.geometry.member.law.sections[0]
    )
    assert of(alike, "M1-T1").width == pytest.approx(of(told, "M1-T1").width, abs=1e-9)


def test_two_gaps_for_one_seam_are_refused_with_both_figures():
    section = box("B", "box1", 800, 600, 20, gap1=3)
    finding = refused([EdgeTreatment("TR"), EdgeTreatment("TL", prep=B6)], section)
    assert (finding.code, finding.position) == ("root-gap-differs", "edge 2")
    assert (finding.value, finding.limit) == (6.0, 3.0) and "section B" in finding.message
    rows = [
        EdgeTreatment("TL", 0.0, 3000.0, B6),
        EdgeTreatment("TL", 3000.0, prep=replace(B6, gap=4.0)),
    ]
    finding = refused(rows)
    assert (finding.code, finding.value, finding.limit) == ("root-gap-differs", 4.0, 6.0)


def test_a_row_for_part_of_a_seam_opens_all_of_it_and_says_so():
    half = made([EdgeTreatment("BR", 0.0, 3000.0, B6)])
    assert of(half, "M1-B1").width == pytest.approx(554.0, abs=1e-6)
    assert gaps(half, "BR") == {6.0}
    assert [f.code for f in half.record.findings] == ["root-gap-whole-seam"]


def test_a_row_over_another_holds_for_the_gap_as_for_the_weld():
    """The later row asks for a test alone: its stretch has the rule pack's preparation."""
    rows = [EdgeTreatment("BR", prep=B6), EdgeTreatment("BR", 3000.0, ndt="UT 100%")]
    part = made(rows)
    assert gaps(part, "BR") == {6.0}
    assert [f.code for f in part.record.findings] == ["root-gap-whole-seam"]
    over = made([rows[0], EdgeTreatment("BR", ndt="UT 100%")])
    assert gaps(over, "BR") == {0.0} and not over.record.findings


def test_both_plates_of_a_mitre_keep_half_of_the_gap():
    corners = [(300, 300), (-300, 300), (-300, -300), (300, -300)]
    square = polygon("P", corners, 20)
    plain, open_ = made(section=square), made([EdgeTreatment("AB", prep=B6)], square)
    for mark in ("M1-A1", "M1-B1"):
        # Half the gap square to a mitre of 45 degrees.
        lost = of(plain, mark).width - of(open_, mark).width
        assert lost == pytest.approx(3.0 * math.sqrt(2.0), abs=1e-6)
    assert gaps(open_, "AB") == {6.0} and gaps(open_, "BC") == {0.0}


def test_a_gap_that_leaves_no_plate_is_refused_at_its_row():
    finding = refused([EdgeTreatment("TL", prep=replace(B6, gap=556.0))])
    assert (finding.code, finding.position) == ("gap-too-wide", "edge 1")
    # Not at the first row with a gap: that of a joint takes nothing off the section.
    joints = {"top": Joints((3000.0,), "mm")}
    rows = [EdgeTreatment("joints", prep=BUTT), EdgeTreatment("TL", prep=replace(B6, gap=556.0))]
    finding = refused(rows, joints=joints)
    assert (finding.code, finding.position) == ("gap-too-wide", "edge 2")


def test_the_gap_of_a_joint_comes_off_both_plates():
    joints = {"top": Joints((2000.0, 4000.0), "mm")}
    open_ = made([EdgeTreatment("T1/T2", prep=BUTT)], joints=joints)
    assert [of(open_, f"M1-T{k}").length for k in (1, 2, 3)] == pytest.approx([1997, 1997, 2000])
    assert gaps(open_, "T1/T2") == {6.0} and gaps(open_, "T2/T3") == {2.0}
    every = made([EdgeTreatment("joints", prep=BUTT)], joints=joints)
    assert [of(every, f"M1-T{k}").length for k in (1, 2, 3)] == pytest.approx([1997, 1994, 1997])
    # Of two rows the later one holds, for the weld as for the plates.
    rows = [EdgeTreatment("T1/T2", prep=BUTT), EdgeTreatment("joints", prep=replace(BUTT, gap=4.0))]
    later = made(rows, joints=joints)
    assert of(later, "M1-T1").length == pytest.approx(1998.0) and gaps(later, "T1/T2") == {4.0}


def test_plates_beside_a_short_one_are_not_welded_to_each_other():
    joints = {"top": Joints((2000.0, 2060.0), "mm")}
    short = made(joints=joints)
    names = [w.name for w in short.record.welds if w.kind == "joint"]
    assert names == ["T1/T2", "T2/T3"]
    open_ = made([EdgeTreatment("joints", prep=BUTT)], joints=joints)
    assert [w.name for w in open_.record.welds if w.kind == "joint"] == ["T1/T2", "T2/T3"]


def test_the_field_gap_is_the_one_told_and_no_other_is_taken():
    pieces = [PieceInput(1, None, (3000.0, False), gap=10.0), PieceInput(2)]
    field = made(pieces=pieces)
    assert gaps(field, "T1/T2") == {10.0}
    finding = refused([EdgeTreatment("joints", prep=BUTT)], pieces=pieces)
    assert (finding.code, finding.position) == ("root-gap-differs", "edge 1")
    assert (finding.value, finding.limit) == (6.0, 10.0)


def test_lanes_keep_their_width_and_a_warning_says_so():
    given = job([(0, 0, 0), (LENGTH, 0, 0)], Plane(), section=SECTION)
    plates = PlatesInput(lanes={"top": Lanes((0.5,))}, edges=(EdgeTreatment("T", prep=BUTT),))
    record = detail(replace(given, plates=plates)).record
    assert [f.code for f in record.findings] == ["root-gap-lanes"]


def test_a_gap_told_twice_in_a_schedule_is_refused_at_the_row_of_edges(read):
    def edit(sheets):
        sheets["Preps"] = [["prep", "type", "angle", "gap"], ["P", "bevel", 45, 6]]
        sheets["Edges"] = [["member", "seam", "prep"], ["M1", "TL", "P"]]

    schedule = read({}, edit)
    row = schedule.member("M1")
    with pytest.raises(BendTorsionError) as caught:
        detail(job_of(schedule, row))
    finding = located(schedule, row, caught.value.findings[-1])
    assert (finding.code, finding.position) == (
        "root-gap-differs",
        "sheet Edges, row 2, column prep",
    )
    assert (finding.value, finding.limit) == (6.0, 2.0)
