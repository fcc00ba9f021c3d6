# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds of a member: every seam and joint once, as long as it is, prepared as asked."""

import math

import pytest
from curved_members import member, tapered

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.edge_faces import with_edges
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment, WeldDefaults
from BendTorsionWB.core.welds.preps import Prep, prep_findings, prep_of, prep_text
from BendTorsionWB.core.welds.welds import welds_of

CORNER = Prep("C", "bevel", math.radians(40), 6.0, 2.0)
BUTT = Prep("B", "v", math.radians(60), 2.0, 2.0)
DEFAULTS = WeldDefaults(CORNER, BUTT, "MT", "UT")


def made(built, joints=None, rows=(), **more):
    plates, _ = split_plates(built, joints or {}, **more)
    developed = with_edges(plates, tuple(map(develop_plate, plates)), built.law.strips)
    return developed, *welds_of(built.name, developed, built.law.strips, rows, DEFAULTS)


def straight(**more):
    return member([Segment(box("B", "box1", 800, 700, 20, gap1=2, gap2=2))], **more)


def test_seams_add_up_to_the_edges_they_join():
    plates, welds, findings = made(tapered(), {"top": Joints((0.3, 0.7)), "left": Joints((0.45,))})
    assert not findings
    for name, face, edge in (
        ("TL", "top", "left"),
        ("TR", "top", "right"),
        ("BL", "bottom", "left"),
    ):
        length = sum(w.length for w in welds if w.name == name)
        arcs = [
            p.arc for q in plates if q.face == face for p in q.panels if p.what == f"edge {edge}"
        ]
        assert length == pytest.approx(sum(arcs), rel=1e-9)
    marks = [w.mark for w in welds]
    assert len(set(marks)) == len(marks)


def test_every_pair_of_plates_that_meets_is_welded_once():
    plates, welds, _ = made(straight(), {"top": Joints((0.5,)), "left": Joints((0.25,))})
    pairs = [frozenset(w.plates) for w in welds]
    assert len(pairs) == len(set(pairs))
    # T1-T2, L1-L2; T1 on L1 and L2, T2 on L2, T1 and T2 on R1, B1 on L1, L2 and R1.
    assert len(pairs) == 2 + 3 + 2 + 3
    assert all(w.kind == "joint" for w in welds if w.plates[0][3] == w.plates[1][3])


def test_the_plate_that_stops_is_the_one_prepared():
    for kind, cut in (("box1", "TB"), ("box2", "LR")):
        built = member([Segment(box("B", kind, 800, 700, 20, gap1=2, gap2=2))])
        _, welds, _ = made(built)
        assert all(w.plates[0].split("-")[1][0] in cut for w in welds if w.kind == "seam")


def test_a_box_is_square_at_its_corners():
    _, welds, _ = made(straight())
    for weld in welds:
        assert weld.dihedral == pytest.approx(math.pi / 2, abs=math.radians(1.0))


def test_rows_hold_in_their_range_and_defaults_outside():
    own = Prep("F", "bevel", math.radians(45), 0.0, 6.0, backing=(30.0, 6.0))
    rows = (
        EdgeTreatment("TL", 2000.0, 5000.0, own, "field", "UT 100 %"),
        EdgeTreatment("T1/T2", 0.0, 1e9, None, "field"),
    )
    _, welds, findings = made(straight(), {"top": Joints((0.5,))}, rows)
    assert not findings
    seam = sorted((w for w in welds if w.name == "TL"), key=lambda w: w.start)
    inside = [w for w in seam if w.prep is own]
    assert inside[0].start == 2000.0 and inside[-1].end == 5000.0
    assert {w.place for w in inside} == {"field"} and {w.ndt for w in inside} == {"UT 100 %"}
    assert all(a.end == b.start for a, b in zip(seam, seam[1:]))
    joint = next(w for w in welds if w.kind == "joint")
    assert joint.prep is BUTT and joint.place == "field"


def test_lanes_of_a_face_are_welded_to_each_other():
    plates, welds, _ = made(straight(), {"top": Joints((0.5,))}, lanes={"top": Lanes((0.5,))})
    lanes = [w for w in welds if w.kind == "lane"]
    assert [w.plates for w in lanes] == [("M1-T1a", "M1-T1b"), ("M1-T2a", "M1-T2b")]
    joints = [w.plates for w in welds if w.kind == "joint"]
    assert joints == [("M1-T1a", "M1-T2a"), ("M1-T1b", "M1-T2b")]


def test_rows_that_apply_to_nothing_and_grooves_that_cannot_be_are_named():
    rows = (EdgeTreatment("XY", 0.0, 1e9, BUTT),)
    with pytest.raises(BendTorsionError) as caught:
        made(straight(), rows=(EdgeTreatment("TL"), *rows))
    (finding,) = caught.value.findings
    assert (finding.code, finding.position) == ("edge-row-unused", "edge 2")
    deep = Prep("D", "v", math.radians(60), land=20.0)
    codes = {f.code for f in prep_findings(deep, 20.0, "M1")}
    assert codes == {"prep-land"}
    assert {f.code for f in prep_findings(Prep("N", "v"), 20.0, "M1")} == {"prep-angle"}


def test_a_preparation_that_does_not_fit_stops_the_member_at_its_row():
    thick = Prep("D", "v", math.radians(60), land=25.0)
    rows = (EdgeTreatment("TR", prep=BUTT), EdgeTreatment("TL", prep=thick))
    with pytest.raises(BendTorsionError) as caught:
        made(straight(), rows=rows)
    (finding,) = caught.value.findings
    assert (finding.code, finding.position, finding.limit) == ("prep-land", "edge 2", 20.0)


@pytest.mark.parametrize(
    "words",
    [
        "bevel angle=40 land=6.5 gap=2.0 inner backing=30.0x6.0",
        "B1: v angle=60 land=2.0",
        "square",
        "fillet",
        "double-v angle=52.5 gap=3.0",
    ],
)
def test_words_of_a_preparation_read_back(words):
    prep = prep_of(words)
    assert prep_text(prep) == words
    assert prep_of(prep_text(prep)) == prep


@pytest.mark.parametrize("words", ["", "w angle=40", "v angle=x", "v wide=3", "v backing=6"])
def test_words_that_are_no_preparation_are_named(words):
    with pytest.raises(BendTorsionError, match="preparation cannot be read"):
        prep_of(words)


def test_depth_of_grooves():
    assert BUTT.depth(20.0) == 18.0 and BUTT.cut_angle == pytest.approx(math.radians(30))
    assert Prep("X", "double-v", 1.0, 2.0).depth(20.0) == 9.0
    assert Prep("F", "fillet").depth(20.0) == 0.0


def test_pieces_are_welded_across_their_field_gap(delivered):
    """Each face of three pieces has its two field joints, with the groove cut, gap or none."""
    welds = [w for w in delivered.record.welds if w.kind == "joint" and w.place == "field"]
    faces = sorted(w.name.split("/")[0][0] for w in welds)
    assert faces == sorted(2 * "TBLR")
    plates = {plate.mark: plate for plate in delivered.record.plates}
    for weld in welds:
        one, two = (plates[mark] for mark in weld.plates)
        assert two.piece == one.piece + 1
        assert two.s_start - one.s_end == pytest.approx(6.0 if one.piece == 1 else 4.0)
        assert any(b.weld == weld.mark for b in (*one.bevels, *two.bevels))
