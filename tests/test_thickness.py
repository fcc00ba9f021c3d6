# SPDX-License-Identifier: LGPL-2.1-or-later
"""Thickness changes: joints staggered per face, chamfers, what follows them, and closed axes."""

import FreeCAD  # noqa: F401
import numpy as np
import pytest
from curved_members import ELLIPSOID, member
from random_members import random_member
from section_cuts import penetration, sections_at

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.members.thickness import Chamfer, ThicknessRules, stagger_offsets
from BendTorsionWB.core.members.volume import skin_volumes
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import Material, box
from BendTorsionWB.core.sections.section_types import i_section
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.shapes import brep

LENGTH = 20000.0
BIG = box("B800", "box1", 800, 700, 20)
SMALL = box("B600", "box1", 600, 560, 16)
THICK = box("T", "box1", 600, 500, 30, 30, 24)
THIN = box("t", "box1", 600, 500, 20, 20, 20)


def joints(law):
    return {strip.face: law.joints_of(k) for k, strip in enumerate(law.strips)}


def thickness_at(law, face, s):
    """Thickness of the stock and of the chamfered plate of a face."""
    k = [strip.face for strip in law.strips].index(face)
    cell = next(c for c in law.cells if c.start <= s < c.end)
    depth = 0.0 if cell.chamfer is None else (cell.chamfer[0] + (s - cell.start) * cell.chamfer[1])
    return cell.thickness[k], cell.thickness[k] - (depth if np.isscalar(depth) else depth[k])


@pytest.mark.parametrize(
    "segments, flanges, webs",
    [
        ([Segment(BIG), Segment(SMALL, 8000.0)], 8350.0, 8550.0),
        ([Segment(SMALL), Segment(BIG, 8000.0)], 7900.0, 7700.0),
        ([Segment(THICK), Segment(THIN, 8000.0)], 8000.0, 8200.0),
        ([Segment(THIN), Segment(THICK, 8000.0)], 8000.0, 7800.0),
    ],
)
def test_thick_plates_reach_past_the_transition_staggered_on_the_thinner_side(
    segments, flanges, webs
):
    law = section_law("M1", segments, LENGTH)
    assert joints(law) == {
        "top": (flanges,),
        "bottom": (flanges,),
        "left": (webs,),
        "right": (webs,),
    }
    assert law.joints == () and law.findings == ()
    # Nowhere thinner than asked: between the outermost joint and the thick end all are thick.
    thick = max(segments, key=lambda g: g.section.strips[0].thickness).section
    for strip in law.strips:
        own = joints(law)[strip.face][0]
        for s in np.linspace(7000.0, 9000.0, 401):
            is_thick = s < own if segments[0].section is thick else s >= own
            asked = thick if is_thick else {BIG: SMALL, SMALL: BIG, THICK: THIN, THIN: THICK}[thick]
            wanted = next(o.thickness for o in asked.strips if o.face == strip.face)
            stock, chamfered = thickness_at(law, strip.face, s)
            assert stock == wanted and chamfered <= stock
            thin = min(g.section.strips[law.strips.index(strip)].thickness for g in segments)
            assert chamfered >= thin - 1e-9


def test_each_plate_changes_at_its_own_thin_end():
    mixed = box("mixed", "box1", 600, 600, 30, 16, 20)
    law = section_law("M1", [Segment(BIG), Segment(mixed, 8000.0)], LENGTH)
    # top 20 -> 30 and bottom 20 -> 16: thick plates in the transition; webs stay 20.
    assert joints(law) == {"top": (7900.0,), "bottom": (8350.0,), "left": (), "right": ()}


def test_another_grade_of_the_same_thickness_is_a_joint_without_a_chamfer():
    strong = box("B600q", "box1", 600, 560, 20, material=Material("S460", fy=460.0))
    for segments, at in (
        ([Segment(BIG), Segment(strong, 8000.0)], (7900.0, 7700.0)),
        ([Segment(strong), Segment(BIG, 8000.0)], (8350.0, 8550.0)),
    ):
        law = section_law("M1", segments, LENGTH)
        assert (joints(law)["top"][0], joints(law)["left"][0]) == at
        assert all(cell.chamfer is None for cell in law.cells)
        names = [{m.name for m in law.cells[i].materials} for i in (0, -1)]
        assert names == [{g.section.material.name} for g in segments]


def test_given_offsets_and_none():
    law = section_law(
        "M1", [Segment(BIG), Segment(SMALL, 8000.0, stagger="top=50 left=400 right=400")], LENGTH
    )
    assert joints(law) == {
        "top": (8300.0,),
        "bottom": (8250.0,),
        "left": (8650.0,),
        "right": (8650.0,),
    }
    law = section_law("M1", [Segment(BIG), Segment(SMALL, 8000.0, stagger="none")], LENGTH)
    assert set(joints(law).values()) == {(8250.0,)}
    [finding] = law.findings
    assert (finding.severity, finding.code) == ("warning", "thickness-joints-not-staggered")
    assert finding.position == "segment 2, s = 8250 mm"
    assert (finding.value, finding.limit, finding.unit) == (0.0, 200.0, "mm") and finding.mend


def test_the_rule_sets_the_stagger_and_the_chamfer():
    rules = ThicknessRules(stagger=300.0, fold_clearance=100.0, chamfer_slope=10.0)
    law = section_law("M1", [Segment(THICK), Segment(THIN, 8000.0)], LENGTH, rules=rules)
    assert joints(law)["left"] == (8300.0,)
    assert law.chamfers_of(0, 0.0, 8000.0) == (None, Chamfer(100.0, 10.0))
    assert law.chamfers_of(0, 8000.0, LENGTH) == (None, None)
    assert law.chamfers_of(2, 0.0, 8300.0) == (None, Chamfer(40.0, 4.0))


def test_without_room_the_joints_stay_and_are_warned_of():
    # The middle segment is 150 long behind its transition.
    segments = [Segment(BIG), Segment(SMALL, 8000.0), Segment(BIG, 8400.0)]
    law = section_law("M1", segments, LENGTH)
    assert {f.code for f in law.findings} == {"thickness-joints-not-staggered"}
    assert {f.position.split(",")[0] for f in law.findings} <= {"segment 2", "segment 3"}


@pytest.mark.parametrize(
    "stagger, cut, code, value, limit",
    [
        ("top", 8000.0, "stagger", "top", None),
        ("top=-5", 8000.0, "stagger", "top=-5", None),
        ("top=5 top=6", 8000.0, "stagger", "top=5 top=6", None),
        ("lid=5", 8000.0, "stagger", "lid=5", None),
        ("left=12000", 8000.0, "stagger", 12000.0, LENGTH - 8250.0 - 10.0),
        ("none", 12.0, "chamfer-too-long", 16.0, 2.0),
    ],
)
def test_what_cannot_be_is_refused_with_place_value_and_mend(stagger, cut, code, value, limit):
    before = THICK if code == "chamfer-too-long" else BIG
    after = THIN if code == "chamfer-too-long" else SMALL
    with pytest.raises(BendTorsionError) as caught:
        section_law("M1", [Segment(before), Segment(after, cut, stagger=stagger)], LENGTH)
    finding = [f for f in caught.value.findings if f.severity == "error"][-1]
    assert (finding.code, finding.object) == (code, "M1") and finding.mend
    assert finding.position.startswith("segment 2")
    assert finding.value == pytest.approx(value) if limit else finding.value == value
    assert finding.limit == (pytest.approx(limit) if limit else None)


def test_an_offset_of_a_face_that_does_not_change_is_warned_of():
    same_webs = box("w", "box1", 600, 500, 30, 30, 20)
    law = section_law("M1", [Segment(same_webs), Segment(THIN, 8000.0, stagger="left=100")], LENGTH)
    assert [f.code for f in law.findings] == ["stagger-without-change"]


def test_staggers_are_read_as_they_are_written():
    assert stagger_offsets("auto") is None and stagger_offsets("none") == {}
    assert stagger_offsets("top=0 left=12.5") == {"top": 0.0, "left": 12.5}


# --- on a straight member every volume is known


def straight(segments, **law):
    plane = analytic_surface("plane", {})
    points = np.column_stack([np.linspace(0.0, 12000.0, 5), np.zeros(5), np.zeros(5)])
    axis = fit_axis("A1", points, plane)
    return Member(
        "M1", surface_frames(axis, plane), section_law("M1", segments, axis.length, **law)
    )


def simpson(function, edges):
    """Integral of a function that is at most cubic between edges."""
    return sum(
        (b - a) / 6 * (function(a + 1e-9) + 4 * function((a + b) / 2) + function(b - 1e-9))
        for a, b in zip(edges[:-1], edges[1:])
    )


def test_volume_of_chamfered_straight_plates_and_clear_widths_between_them():
    built = straight([Segment(THICK), Segment(THIN, 5000.0)])
    plates, _ = split_plates(built, {})
    flange, web = 5000.0, 5200.0
    by_mark = {plate.mark: plate for plate in plates}
    # Webs, full height 600: 24 thick up to 5200 with a chamfer to 20 over the last 16.
    assert by_mark["M1-L1"].volume == pytest.approx(600 * (24 * web - 4 * 16 / 2), rel=1e-9)
    assert by_mark["M1-L2"].volume == pytest.approx(600 * 20 * (12000 - web), rel=1e-9)
    assert by_mark["M1-T1"].chamfers == (None, Chamfer(40.0, 10.0))
    assert by_mark["M1-L1"].chamfers == (None, Chamfer(16.0, 4.0))
    assert by_mark["M1-T2"].chamfers == by_mark["M1-L2"].chamfers == (None, None)

    def web_thickness(s):
        return np.interp(s, [web - 16, web], [24, 20])

    def flange_thickness(s):
        return np.interp(s, [flange - 40, flange], [30, 20])

    # Flanges fit between the webs: 500 less twice the web, following its chamfer.
    edges = [0.0, flange - 40, flange]
    expected = simpson(lambda s: flange_thickness(s) * (500 - 2 * web_thickness(s)), edges)
    assert by_mark["M1-T1"].volume == pytest.approx(expected, rel=1e-8)
    edges = [flange, web - 16, web, 12000.0]
    expected = simpson(lambda s: 20 * (500 - 2 * web_thickness(s)), edges)
    assert by_mark["M1-B2"].volume == pytest.approx(expected, rel=1e-8)
    skins = solid_skins.plate_skins(plates)
    volumes = skin_volumes(skins)
    solids = brep.tube_solids([[(p.knots, p.poles) for p in one] for one in skins])
    for plate, volume, solid in zip(plates, volumes, solids, strict=True):
        assert volume == pytest.approx(plate.volume, rel=1e-6)
        assert solid.isValid() and solid.Volume == pytest.approx(plate.volume, rel=1e-6)
    s = np.linspace(4900.0, 5300.0, 161) + 0.1
    assert max(map(penetration, sections_at(built, plates, s))) < 1e-6


@pytest.mark.parametrize("type", ["box1", "box2"])
@pytest.mark.parametrize("grows", [False, True])
def test_inner_faces_meet_flush_at_the_joint(type, grows):
    thick, thin = (box("S", type, 600, 500, t, gap1=2.0) for t in (30, 20))
    pair = (thin, thick) if grows else (thick, thin)
    built = member([Segment(pair[0]), Segment(pair[1], 9000.0)])
    plates, _ = split_plates(built, {})
    for face in ("top", "bottom", "left", "right"):
        one, two = (p for p in plates if p.face == face)
        assert (one.thickness, two.thickness) == ((20, 30) if grows else (30, 20))
        for level in ("outer", "inner"):
            end, start = getattr(one.rails, level), getattr(two.rails, level)
            assert end(one.end) == pytest.approx(start(two.start), abs=1e-6)
        # The chamfer is 1:4, on the thick plate alone.
        thick_plate, side = (two, 0) if grows else (one, 1)
        chamfer = thick_plate.chamfers[side]
        assert chamfer == Chamfer(pytest.approx(40.0), 10.0)
        assert (one if grows else two).chamfers == (None, None)


def test_a_web_of_an_i_section_is_chamfered_on_both_faces():
    thick, thin = (i_section("S", 600, 300, 20, 20, t) for t in (24, 12))
    built = straight([Segment(thick), Segment(thin, 6000.0)])
    web = next(p for p in split_plates(built, {})[0] if p.face == "web")
    assert web.chamfers == (None, Chamfer(24.0, 6.0, "both"))
    height = 600 - 2 * 20
    assert web.volume == pytest.approx(height * (24 * 6000 - 12 * 24 / 2), rel=1e-9)


def test_the_pattern_is_that_of_the_plate_before_it_is_chamfered():
    def webs(slope):
        # Full height: nothing but their own chamfers could change them.
        built = member(
            [Segment(THICK), Segment(THIN, 9000.0)], rules=ThicknessRules(chamfer_slope=slope)
        )
        plates = [p for p in split_plates(built, {})[0] if p.face == "left"]
        return plates, [develop_plate(plate) for plate in plates]

    (chamfered, _), patterns = webs(4.0)
    (plain, _), plain_patterns = webs(0.0)
    assert plain.chamfers == (None, None) and chamfered.chamfers[1].depth == 4.0
    assert chamfered.volume < plain.volume
    assert patterns[0].chamfers == chamfered.chamfers
    for one, other in zip(patterns, plain_patterns, strict=True):
        assert (one.length, one.width) == pytest.approx((other.length, other.width), abs=1e-6)
        assert one.area == pytest.approx(other.area, rel=1e-9)
        assert [line.label for line in one.lines] == [line.label for line in other.lines]
        for mine, its in zip(one.lines, other.lines, strict=True):
            assert mine.flat == pytest.approx(its.flat, abs=1e-6)
        assert {fold.label for fold in one.folds} == {fold.label for fold in other.folds}


@pytest.mark.parametrize("seed", range(12))
def test_plates_of_random_members_with_thickness_changes_never_overlap(seed):
    built = random_member(seed, changes=True)
    plates, _ = split_plates(built, {})
    law = built.law
    places = {p for c in law.changes for p in (c.place, *c.chamfer)} | set(law.folds)
    s = np.unique([p + d for p in places for d in (-30, -12, -5, -1.3, -0.3, 0.3, 1.3, 5, 12, 30)])
    s = s[(s > 0.0) & (s < built.length)]
    s = np.concatenate([s, np.linspace(5.0, built.length - 5.0, 40)])
    for rings in sections_at(built, plates, s):
        assert penetration(rings) < 0.02
    volumes = skin_volumes(solid_skins.plate_skins(plates))
    for plate, volume in zip(plates, volumes, strict=True):
        assert volume == pytest.approx(plate.volume, rel=1e-6)


# --- rings


def ring_of(segments, **law):
    """A member round the ellipsoid on a parallel."""
    t = np.linspace(0.0, 2 * np.pi, 17)[:-1]
    points = np.column_stack(
        [40000 * 0.8 * np.cos(t), 30000 * 0.8 * np.sin(t), np.full(len(t), 20000 * 0.6)]
    )
    axis = fit_axis("A1", points, ELLIPSOID, closed=True)
    frames = surface_frames(axis, ELLIPSOID)
    return Member("M1", frames, section_law("M1", segments, axis.length, closed=True, **law))


@pytest.mark.parametrize("cut", [0.0, 170000.0, 100.0, -150.0])
def test_a_ring_closes_wherever_the_closing_transition_lies(cut):
    length = ring_of([Segment(BIG)]).length
    cut = length + cut if cut < 0 else cut
    built = ring_of([Segment(BIG, cut), Segment(SMALL, 60000.0)])
    law = built.law
    reach = 250.0
    start = {0.0: length - reach}.get(cut, cut)
    closing = [c for c in law.cells if c.label == "b-2"]
    assert sum(c.end - c.start for c in closing) == pytest.approx(reach)
    assert any(c.start == pytest.approx(start) for c in closing)
    assert len(law.face_steps) == 2 and len(law.sections) == 2
    # The section, its motion and its thicknesses are the same on both sides of the seam.
    last, first = law.cells[-1], law.cells[0]
    assert last.corners_at(np.array([length]))[0] == pytest.approx(first.corners, abs=1e-9)
    assert law.length == pytest.approx(length)
    ends = built.corners(0.0, length)(np.array([0.0, length])).reshape(2, 4, 3)
    assert np.linalg.norm(ends[1] - ends[0], axis=1).max() < 1e-3
    plates, _ = split_plates(built, {})
    for face in ("top", "bottom", "left", "right"):
        own = [p for p in plates if p.face == face]
        assert own[0].start == 0.0 and own[-1].end == pytest.approx(length)
        assert own[0].thickness == own[-1].thickness
        for level in ("outer", "inner"):
            start_line = getattr(own[0].rails, level)(0.0)
            end_line = getattr(own[-1].rails, level)(own[-1].end)
            # Where the closing transition ends at the seam, its mitre is there.
            assert np.abs(start_line - end_line).max() < (2.0 if cut == 0.0 else 1e-3)
    for plate, volume in zip(plates, skin_volumes(solid_skins.plate_skins(plates)), strict=True):
        assert volume == pytest.approx(plate.volume, rel=1e-6)


def test_a_ring_of_thickness_changes_alone_has_no_joint_but_its_own():
    built = ring_of([Segment(THICK), Segment(THIN, 60000.0)])
    # The closing change is at the seam, where every face has a joint already.
    assert joints(built.law) == {
        "top": (60000.0,),
        "bottom": (60000.0,),
        "left": (60200.0,),
        "right": (60200.0,),
    }
    assert built.law.findings == ()
    plates, _ = split_plates(built, {})
    firsts = {p.face: p for p in plates if p.start == 0.0}
    assert all(p.chamfers[0] is not None for p in firsts.values())
    for face, first in firsts.items():
        last = [p for p in plates if p.face == face][-1]
        assert first.rails.inner(0.0) == pytest.approx(last.rails.inner(last.end), abs=1e-3)


@pytest.mark.parametrize(
    "segments, closed, code",
    [
        ([Segment(BIG, 500.0), Segment(SMALL, 8000.0)], False, "cut-on-first-segment"),
        ([Segment(BIG, 500.0)], True, "cut-on-first-segment"),
        (
            [Segment(BIG, 9000.0), Segment(SMALL, 8000.0), Segment(BIG, 12000.0)],
            True,
            "cut-on-first-segment",
        ),
        ([Segment(BIG, 7900.0), Segment(SMALL, 8000.0)], True, "transitions-overlap"),
        ([Segment(BIG), Segment(SMALL, 19800.0)], True, "transitions-overlap"),
    ],
)
def test_a_closing_cut_that_cannot_be_is_named(segments, closed, code):
    with pytest.raises(BendTorsionError) as caught:
        section_law("M1", segments, LENGTH, closed=closed)
    [finding] = caught.value.findings
    assert (finding.code, finding.object) == (code, "M1")
    assert finding.position in ("segment 1", "segment 2") and finding.mend
    assert finding.value is not None and finding.limit is not None and finding.unit == "mm"
