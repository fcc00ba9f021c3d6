# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms and end plates: closed forms on straight boxes, clearance on twisted and tapered."""

from dataclasses import replace

import numpy as np
import pytest
from curved_members import ELLIPSOID, hand_frames, tapered
from schedule_books import findings

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import FrameInput, frames_of
from BendTorsionWB.core.axes.frames_law import GivenDirection
from BendTorsionWB.core.geometry import arc_contour
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.plates.diaphragm_input import Closing, Diaphragm, closing_of
from BendTorsionWB.core.plates.diaphragms import flat_parts
from BendTorsionWB.core.plates.flat_plate import developed_flat
from BendTorsionWB.core.plates.hole_shape import hole_shape, placed_hole
from BendTorsionWB.core.plates.plate_parts import with_parts
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import Material, box
from BendTorsionWB.core.sections.section_types import i_section

PLANE = analytic_surface("plane", {})


def straight(*segments, length=6000.0, twist=0.0):
    """A member along x, turned by `twist` (rad) from end to end."""
    axis = fit_axis("A1", np.array([[0.0, 0, 0], [length / 3, 0, 0], [length, 0, 0]]), PLANE)
    law = FrameInput(twist=(GivenDirection(0.0, 0.0), GivenDirection(length, twist)))
    frames = frames_of(axis, PLANE, law if twist else FrameInput())
    return Member("M1", frames, section_law("M1", segments, axis.length))


def parts(member, *rows, joints=None):
    plates, _ = split_plates(member, joints or {})
    return flat_parts(member, plates, rows), plates


def hollow(**changed):
    return Segment(box("B", **{"type": "box1", "h": 900.0, "b": 600.0, "t_top": 20.0, **changed}))


def test_in_a_straight_box_it_is_the_inner_rectangle_less_the_gap():
    """Every side stands off its wall by the gap; area, mass and centre in closed form."""
    member = straight(hollow(t_bottom=30.0, t_web=16.0))
    row = Diaphragm(2000.0, 12.0, gap=3.0, snipe=40.0, manhole=hole_shape("d=300"))
    found, _ = parts(member, row)
    flat = found.flats[0]
    breadth, height = 600 - 2 * 16 - 6, 900 - 50 - 6
    low = -450 + 30 + 3
    corners = flat.outline[:, :2]
    assert np.allclose(corners.min(axis=0), [-breadth / 2, low], atol=1e-7)
    assert np.allclose(corners.max(axis=0), [breadth / 2, low + height], atol=1e-7)
    area = breadth * height - 4 * 0.5 * 40.0**2 - np.pi * 150.0**2
    assert flat.area == pytest.approx(area, rel=1e-12)
    assert flat.mass == pytest.approx(area * 12.0 * 7.85e-6, rel=1e-12)
    assert np.allclose(flat.centre_of_gravity, [2000.0, 0.0, 5.0], atol=1e-6)
    assert (flat.mark, flat.face, flat.letter) == ("M1-D1", "diaphragm", "D")


def test_its_record_is_that_of_a_plate_without_errors():
    """Outline from (0, 0), exact sizes, P points on the +s side, frames that agree both ways."""
    member = straight(hollow())
    row = Diaphragm(0.25, 10.0, gap=2.0, snipe=30.0, manhole=hole_shape("d=200"), s_is_ratio=True)
    flat = parts(member, row)[0].flats[0]
    plate = developed_flat(flat)
    assert (plate.length, plate.width) == pytest.approx((556.0, 856.0), abs=1e-7)
    assert np.abs(np.concatenate(plate.outline).min(axis=0)).max() == 0.0
    assert plate.forming == "flat" and plate.length_error_max == 0.0 == plate.strain_max
    assert [point.label for point in plate.points] == [f"P-{k}" for k in range(1, 9)]
    for point in plate.points:
        assert point.xyz[0] == pytest.approx(1500.0 + 5.0)
        local = plate.placing @ [*point.xyz, 1.0]
        assert np.allclose(local[:3], point.local, atol=1e-8)
        assert np.allclose(plate.flat_to_placing @ [*point.flat, 0, 1.0], local, atol=1e-8)
    assert np.allclose(plate.points[0].local, 0.0, atol=1e-9)
    assert plate.points[1].local[1] == pytest.approx(0.0, abs=1e-9)
    assert plate.points[0].flat[1] == pytest.approx(0.0, abs=1e-9)
    u, v, diameter = plate.holes[0].circle
    assert (u, v, diameter) == pytest.approx((278.0, 428.0, 200.0), abs=0.002)


def clearances(plates, flat):
    """Per wall the distances of places of its inner surface, within the diaphragm's thickness,
    from the diaphragm's nearest side, in its plane; frames worked out by hand."""
    origin, y, z, x = (flat.frame[:3, k] for k in (3, 0, 1, 2))
    outline = flat.outline[:, :2]
    every = {}
    for plate in plates:
        if not plate.start <= flat.s <= plate.end:
            continue
        s = np.linspace(flat.s - 15.0, flat.s + 15.0, 601)
        rails = plate.rails.inner(s).reshape(-1, 2, 3)
        near = []
        for w in np.linspace(0.0, 1.0, 401):
            off = rails[:, 0] + w * (rails[:, 1] - rails[:, 0]) - origin
            inside = np.abs(off @ x) <= flat.thickness / 2 + 0.03
            near.append(np.column_stack([off[inside] @ y, off[inside] @ z]))
        near = np.concatenate(near)
        step = np.roll(outline, -1, axis=0) - outline
        length = np.hypot(*step.T)
        outward = np.column_stack([step[:, 1], -step[:, 0]]) / length[:, None]
        distance = ((near[:, None] - outline[None]) * outward[None]).sum(axis=2)
        along = ((near[:, None] - outline[None]) * step[None]).sum(axis=2) / length**2
        beside = (along >= 0) & (along <= 1) & (distance > 0)
        distance = np.where(beside, distance, np.inf)
        every[plate.face] = distance.min()
    return every


@pytest.mark.parametrize("twist", [0.0, 0.5, -1.2])
def test_a_twisted_box_stays_clear_by_the_gap_and_no_more(twist):
    """Within the whole thickness no wall comes nearer than the gap, and each comes that near,
    measured square to the wall, which leans by the twist times its lever."""
    member = straight(hollow(), twist=twist)
    found, plates = parts(member, Diaphragm(3100.0, 25.0, gap=4.0))
    for face, distance in clearances(plates, found.flats[0]).items():
        lean = abs(twist) / 6000.0 * (290.0 if face in ("top", "bottom") else 440.0)
        assert 4.0 - 0.003 <= distance <= 4.0 * np.hypot(1.0, lean) + 0.006, face


def test_in_a_taper_the_gap_is_measured_square_to_the_wall():
    """Slope 1:2.5 of 100 mm: the far face of the plate decides, and the gap grows by √(1 + a²)."""
    member = straight(hollow(), hollow_at(2000.0), length=6000.0)
    row = Diaphragm(2125.0, 20.0, gap=5.0)
    flat = parts(member, row)[0].flats[0]
    slope = 100.0 / 250.0
    inset = 20.0 * np.hypot(1.0, slope)
    at_far_face = 450.0 - slope * (125.0 + 10.0)
    top = at_far_face - inset - 5.0 * np.hypot(1.0, slope)
    assert flat.outline[:, 1].max() == pytest.approx(top, abs=1e-6)


def hollow_at(cut):
    return replace(hollow(h=700.0), cut=cut, slope=2.5)


def test_on_a_curved_member_it_lies_in_the_section_plane():
    """Frame against frames by hand; walls clear on the doubly curved, tapered box too."""
    member = tapered()
    found, plates = parts(member, Diaphragm(9100.0, 20.0, gap=2.0), Diaphragm(4000.0, 16.0))
    for flat in found.flats:
        origin, x, y, z = hand_frames(member, ELLIPSOID, np.array([flat.s]))
        assert np.allclose(flat.frame[:3, 3], origin[0], atol=1e-6)
        assert np.allclose(flat.frame[:3, :3].T, [y[0], z[0], x[0]], atol=1e-6)
    assert [flat.mark for flat in found.flats] == ["M1-D1", "M1-D2"]
    assert found.flats[0].s == 4000.0


def test_at_a_joint_with_a_change_of_thickness_the_thicker_wall_counts():
    """Half the diaphragm lies within each top plate; the thicker one is chamfered 1:4 there."""
    thin = replace(hollow(t_top=12.0, t_bottom=20.0, t_web=20.0), cut=3000.0, slope=0.0)
    flat = parts(straight(hollow(), thin), Diaphragm(3000.0, 20.0, gap=1.0))[0].flats[0]
    assert np.ptp(flat.outline[:, 0]) == pytest.approx(600 - 40 - 2, abs=1e-6)
    assert flat.outline[:, 1].min() == pytest.approx(-450 + 20 + 1, abs=1e-6)
    chamfered = 12.0 + 10.0 / 4.0
    assert flat.outline[:, 1].max() == pytest.approx(450 - chamfered - np.hypot(1, 0.25), abs=1e-3)


def test_end_plates_stand_over_the_section_and_outside_it():
    """A negative gap is an overhang; the inner face lies in the member's end plane."""
    member = straight(hollow())
    rows = (
        Diaphragm(0.0, 25.0, gap=-20.0, end="start"),
        Diaphragm(0.0, 30.0, gap=5.0, end="end", material=Material("Q420", 7.85e-6, 2e5, 420.0)),
    )
    start, end = parts(member, *rows)[0].flats
    assert np.allclose(np.ptp(start.outline[:, :2], axis=0), [640.0, 940.0], atol=1e-7)
    assert np.allclose(np.ptp(end.outline[:, :2], axis=0), [590.0, 890.0], atol=1e-7)
    assert start.frame[0, 3] == pytest.approx(-12.5) and end.frame[0, 3] == pytest.approx(6015.0)
    assert (start.mark, end.mark, end.face) == ("M1-E1", "M1-E2", "end")
    assert (start.material.name, end.material.name) == ("S355", "Q420")


def test_both_its_faces_are_marked_on_the_inner_faces_of_all_walls():
    """On a straight box the lines lie at s ± t/2, from snipe to snipe, the first with its mark."""
    member = straight(hollow(t_web=16.0))
    plates, _ = split_plates(member, {})
    row = Diaphragm(2000.0, 12.0, gap=3.0, snipe=40.0)
    made, flats = with_parts(member, plates, [row])
    for plate in made:
        assert [mark.text for mark in plate.marks] == ["M1-D1", ""]
        lines = [mark.places for mark in plate.marks]
        assert [line[:, 0].mean() for line in lines] == pytest.approx([1994.0, 2006.0], abs=1e-6)
        width = {"top": 568.0, "bottom": 568.0}.get(plate.face, 900.0)
        clear = {"top": 568.0, "bottom": 568.0}.get(plate.face, 860.0)
        span = np.ptp(lines[0][:, 1]) * width
        assert span == pytest.approx(clear - 2 * 3.0 - 2 * 40.0, abs=1e-6)


def test_slots_in_the_closing_plate_lie_on_the_diaphragm():
    """Defaults: 100 long, 8 mm wider than the plate, 250 apart, along the diaphragm's line."""
    member = straight(hollow(b=800.0))
    plates, _ = split_plates(member, {})
    made, _ = with_parts(member, plates, [Diaphragm(2000.0, 12.0, closing=closing_of("top slot"))])
    top = next(plate for plate in made if plate.face == "top")
    assert [o.title for o in top.openings] == ["slot 100x28"] * 3
    assert [o.spot.s for o in top.openings] == pytest.approx([2000.0] * 3)
    assert np.diff([o.spot.point[1] for o in top.openings]) == pytest.approx([-250.0] * 2, abs=1e-6)
    reach = np.ptp(np.concatenate(top.openings[0].runs), axis=0)
    assert reach == pytest.approx([28.0, 100.0 / 760.0], rel=1e-4)
    assert all(not plate.openings for plate in made if plate.face != "top")


def test_a_face_only_welded_on_three_sides_may_have_its_own_gap():
    member = straight(hollow())
    row = Diaphragm(2000.0, 12.0, 2.0, closing=closing_of("top weld 15"))
    flat = parts(member, row)[0].flats[0]
    assert flat.outline[:, 1].max() == pytest.approx(430.0 - 15.0)
    assert flat.outline[:, 1].min() == pytest.approx(-430.0 + 2.0)


def test_closing_words():
    """Every form, and a word that is none."""
    assert closing_of("top weld") == Closing("top", "weld")
    assert closing_of("left slot 90x30 @ 200") == Closing("left", "slot", 90.0, 30.0, 200.0)
    assert closing_of("left  slot@200").pitch == 200.0
    for text in ("top", "slot", "top slot 20x30", "top glue"):
        assert findings(closing_of, text)[0].code == "diaphragm-closing"


BAD = [
    (Diaphragm(3.0, 12.0), "diaphragm-outside"),
    (Diaphragm(5999.0, 12.0), "diaphragm-outside"),
    (Diaphragm(2000.0, 0.0), "diaphragm-thickness"),
    (Diaphragm(2000.0, 12.0, gap=-1.0), "diaphragm-gap"),
    (Diaphragm(2000.0, 12.0, gap=300.0), "diaphragm-no-room"),
    (Diaphragm(2000.0, 12.0, snipe=290.0), "diaphragm-snipe"),
    (Diaphragm(2000.0, 12.0, manhole=hole_shape("d=480")), "manhole-ligament"),
    (Diaphragm(2000.0, 12.0, 0, 0, *placed_hole("d=300 at 100 0")), "manhole-ligament"),
    (Diaphragm(2000.0, 12.0, closing=Closing("north", "slot")), "diaphragm-closing"),
    (Diaphragm(2000.0, 12.0, closing=Closing("top", "slot", 900.0, 30.0)), "diaphragm-slot"),
    (Diaphragm(0.0, 12.0, end="start", closing=Closing("top", "weld")), "diaphragm-closing"),
]


@pytest.mark.parametrize(("row", "code"), BAD, ids=[f"{c}-{k}" for k, (_, c) in enumerate(BAD)])
def test_bad_rows_are_named(row, code):
    """By row, with a mend."""
    member = straight(hollow())
    plates, _ = split_plates(member, {})
    good = Diaphragm(4000.0, 10.0)
    found = findings(flat_parts, member, plates, (good, row))
    assert [(f.code, f.position, f.object) for f in found] == [(code, "diaphragm 2", "M1")]


def test_diaphragms_on_each_other_and_open_sections_are_refused():
    member = straight(hollow())
    plates, _ = split_plates(member, {})
    found = findings(flat_parts, member, plates, (Diaphragm(2000, 20.0), Diaphragm(2015, 20.0)))
    assert [f.code for f in found] == ["diaphragms-meet"]
    section = i_section("I", 600.0, 300.0, 20.0, 12.0)
    member = straight(Segment(section))
    plates, _ = split_plates(member, {})
    found = findings(flat_parts, member, plates, (Diaphragm(2000, 20.0),))
    assert found[0].code == "diaphragm-section" and section.type in found[0].message


def test_contours_are_exact():
    """Area and centroid of a rounded rectangle with a bite, against its parts."""
    rounded = arc_contour.rounded_rectangle(300.0, 200.0, 50.0)
    area = 300 * 200 - (4 - np.pi) * 50.0**2
    assert arc_contour.area(rounded) == pytest.approx(area, rel=1e-14)
    half = np.array([[0.0, -100.0, 1.0], [0.0, 100.0, 0.0]])
    assert arc_contour.centroid(half) == pytest.approx([4 * 100 / (3 * np.pi), 0.0], abs=1e-12)
    bite = arc_contour.reversed_contour(half)
    assert arc_contour.area(bite) == -arc_contour.area(half)
    moved = arc_contour.moved(rounded, 0.7, (50.0, -20.0))
    assert arc_contour.centroid(moved) == pytest.approx([50.0, -20.0], abs=1e-10)
    _, weights = arc_contour.inner_nodes(rounded)
    assert weights.sum() == pytest.approx(area, rel=1e-12)
    assert arc_contour.clearance(rounded, np.array([[0.0, 0.0]])) == pytest.approx(100.0, abs=0.01)
    assert arc_contour.clearance(rounded, np.array([[160.0, 0.0]])) == pytest.approx(-10.0)
    assert tolerances.MANHOLE_LIGAMENT > 0.0
