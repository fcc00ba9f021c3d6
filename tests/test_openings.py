# SPDX-License-Identifier: LGPL-2.1-or-later
"""Openings and marks on plates: shapes, closed forms, contours on the surfaces, maps both ways."""

import numpy as np
import pytest
from curved_members import tapered
from schedule_books import findings
from scipy.integrate import trapezoid
from test_diaphragms import hollow, straight

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import FrameInput, frames_of
from BendTorsionWB.core.geometry import arc_contour
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.members.end_cut import SQUARE, EndCut, with_end_cuts
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.part_tables import diaphragm_of, mark_of, material_of, opening_of, place_of
from BendTorsionWB.core.patterns.inner_contours import hole_contour
from BendTorsionWB.core.patterns.pattern import MODES, develop_plate, pattern_of
from BendTorsionWB.core.plates.diaphragm_input import Diaphragm
from BendTorsionWB.core.plates.diaphragms import flat_parts
from BendTorsionWB.core.plates.face_marks import FaceMark, mark_words
from BendTorsionWB.core.plates.hole_shape import hole_shape, placed_hole
from BendTorsionWB.core.plates.openings import Opening, fitted_circle
from BendTorsionWB.core.plates.plate_parts import with_parts
from BendTorsionWB.core.plates.plate_places import surface_point
from BendTorsionWB.core.plates.plates import Joints, split_plates


def made(member, openings=(), marks=(), joints=None):
    plates, _ = split_plates(member, joints or {})
    return with_parts(member, plates, (), openings, marks)[0]


def of(plates, face):
    return next(plate for plate in plates if plate.face == face)


def ring_beam(radius=12000.0):
    """A level box along a quarter circle on a cylinder: webs are coaxial cylinders."""
    angle = np.linspace(0.0, 0.6, 9)
    points = radius * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    surface = analytic_surface("cylinder", {"r": radius})
    axis = fit_axis("A1", points, surface)
    frames = frames_of(axis, surface, FrameInput())
    return Member("M1", frames, section_law("M1", [hollow()], axis.length))


def test_shapes_are_read_as_written():
    """Every form and back; sizes exact."""
    for text, area in (
        ("d=120", np.pi * 3600),
        ("200x100", 20000),
        ("200x100 r=20", 20000 - (4 - np.pi) * 400),
        ("slot 120x40", 80 * 40 + np.pi * 400),
    ):
        shape = hole_shape(text)
        assert shape.title == text
        assert arc_contour.area(shape.contour) == pytest.approx(area, rel=1e-14)
    assert hole_shape("D = 50").is_circle and hole_shape("50 x 50 r=25").is_circle
    assert placed_hole("400x600 at 50 -100") == (hole_shape("400x600"), (50.0, -100.0))
    for text in ("", "120", "d=0", "slot 40x40", "200x100 r=60", "d=-3", "round 4"):
        assert findings(hole_shape, text)[0].code == "hole-shape"


def test_in_a_flat_plate_an_opening_is_its_own_shape():
    """Place, size, area, volume and mass in closed form; + offset is towards the second edge."""
    member = straight(hollow())
    rows = [
        Opening("top", 1000.0, hole_shape("d=120"), 100.0),
        Opening("top", 0.5, hole_shape("200x100 r=20"), -50.0, np.pi / 6, True),
    ]
    plate = of(made(member, rows), "top")
    assert plate.edges == ("left", "right")
    circle, rounded = plate.openings
    # Left is +y: towards the right edge is −y.
    assert np.allclose(circle.spot.point, [1000.0, -100.0, 440.0], atol=1e-9)
    assert np.allclose(circle.centre, circle.spot.point, atol=1e-9)
    areas = np.pi * 3600, 20000 - (4 - np.pi) * 400
    assert [o.volume for o in plate.openings] == pytest.approx([20 * a for a in areas], rel=1e-12)
    record, whole = develop_plate(plate), develop_plate(of(made(member), "top"))
    assert whole.area - record.area == pytest.approx(sum(areas), rel=1e-10)
    assert whole.mass - record.mass == pytest.approx(sum(areas) * 20 * 7.85e-6, rel=1e-10)
    assert [h.area for h in record.holes] == pytest.approx(areas, rel=1e-12)
    assert record.holes[0].circle[2] == pytest.approx(120.0, abs=1e-3)
    assert record.holes[1].circle is None
    assert arc_contour.area(hole_contour(record.holes[1])) == pytest.approx(areas[1], rel=1e-4)


def test_through_a_cylinder_an_opening_is_straight_and_rolled_out_exactly():
    """The top of a ring beam: contour on all surfaces on the drill's cylinder; in the pattern
    along = R asin(x / R), R that of the mid-surface; area and volume by closed forms."""
    member = ring_beam()
    plate = of(made(member, [Opening("top", 3000.0, hole_shape("d=400"))]), "top")
    opening = plate.openings[0]
    at, spot = np.concatenate(opening.runs), opening.spot
    off = surface_point(plate.rails.mid, at[:, 0], at[:, 1]) - spot.point
    assert np.abs(np.hypot(off @ spot.x, off @ spot.y) - 200.0).max() < 1e-6
    radius = 12000.0 + 450.0 - 10.0
    assert np.hypot(*spot.point[:2]) == pytest.approx(radius, abs=0.01)
    record = develop_plate(plate)
    points = np.concatenate(record.holes[0].runs)
    off = points - 0.5 * (points.min(axis=0) + points.max(axis=0))
    unrolled = np.hypot(radius * np.sin(off[:, 0] / radius), off[:, 1])
    assert np.abs(unrolled - 200.0).max() < 1e-4
    a = np.linspace(-np.pi / 2, np.pi / 2, 20001)
    x, chord = 200.0 * np.sin(a), 400.0 * np.cos(a)
    lean = np.sqrt(1 - (x / radius) ** 2)
    assert record.holes[0].area == pytest.approx(trapezoid(chord / lean, x), rel=1e-7)
    depth = np.sqrt((radius + 10) ** 2 - x**2) - np.sqrt((radius - 10) ** 2 - x**2)
    assert opening.volume == pytest.approx(trapezoid(chord * depth, x), rel=1e-6)
    outer = develop_plate(plate, surface="outer").holes[0]
    lean = np.sqrt(1 - (x / (radius + 10)) ** 2)
    assert outer.area == pytest.approx(trapezoid(chord / lean, x), rel=1e-7)


@pytest.mark.parametrize("mode", MODES)
def test_the_pattern_maps_both_ways(mode):
    """(s, w) -> (u, v) -> (s, w) to 1e-6 mm, folds included; points of the pattern likewise."""
    plates, _ = split_plates(tapered(), {"top": Joints((8000.0,), "mm")})
    for plate in (plates[1], plates[-1]):
        pattern = pattern_of(plate, mode=mode)
        random = np.random.default_rng(5)
        s, w = random.uniform(plate.start, plate.end, 400), random.uniform(0, 1, 400)
        back = pattern.places(pattern.flat(s, w))
        width = 800.0
        assert np.abs(back[0] - s).max() < 1e-6 and np.abs(back[1] - w).max() * width < 1e-6


def test_a_small_hole_in_a_doubly_curved_plate_stays_a_circle():
    """To 0.01 mm, so that NC1 can drill it; the area is the one drilled to 1e-4."""
    plate = of(made(tapered(), [Opening("top", 4000.0, hole_shape("d=80"), 60.0)]), "top")
    hole = develop_plate(plate).holes[0]
    assert hole.circle is not None and hole.circle[2] == pytest.approx(80.0, abs=0.01)
    assert hole.area == pytest.approx(np.pi * 1600.0, rel=1e-4)
    pattern = pattern_of(plate)
    spot = plate.openings[0].spot
    middle = pattern.flat(np.array([spot.s]), np.array([spot.w]))
    assert np.allclose(middle[0], hole.circle[:2], atol=0.01)


def test_circles_are_told_from_what_is_none():
    angle = np.linspace(0.0, 2 * np.pi, 300, endpoint=False)
    unit = np.column_stack([np.cos(angle), np.sin(angle)])
    assert fitted_circle(50.0 * unit + [3.0, 4.0]) == pytest.approx((3.0, 4.0, 100.0), abs=1e-9)
    assert fitted_circle(unit * [50.0, 50.03]) is None


MEMBER_ROWS = [
    (Opening("top", 100.0, hole_shape("d=300")), "opening-on-joint"),
    (Opening("top", 165.0, hole_shape("d=300")), "opening-on-joint"),
    (Opening("top", 3100.0, hole_shape("d=300")), "opening-on-joint"),
    (Opening("left", 3100.0, hole_shape("300x200"), 800.0), "opening-outside"),
    (Opening("left", 3100.0, hole_shape("300x200"), 345.0), "opening-near-edge"),
    (Opening("north", 3100.0, hole_shape("300x200")), "opening-face"),
    (Opening("top", 9000.0, hole_shape("d=300")), "opening-outside"),
]


@pytest.mark.parametrize(("row", "code"), MEMBER_ROWS, ids=[c for _, c in MEMBER_ROWS])
def test_bad_openings_are_named(row, code):
    """By row and plate, with a mend."""
    good = Opening("top", 2000.0, hole_shape("d=100"))
    joints = {"top": Joints((3000.0,), "mm")}
    found = findings(made, straight(hollow()), (good, row), (), joints)
    assert [(f.code, f.position) for f in found] == [(code, "opening 2")]


def test_openings_keep_clear_of_each_other_and_of_folds():
    row = Opening("top", 2000.0, hole_shape("d=100"))
    for s, size in ((2110.0, "d=100"), (2000.0, "d=9")):
        found = findings(made, straight(hollow()), (row, Opening("top", s, hole_shape(size))))
        assert [f.code for f in found] == ["openings-overlap"]
    found = findings(made, tapered(), [Opening("top", 9200.0, hole_shape("d=200"))])
    assert [f.code for f in found] == ["opening-on-fold"]


def test_beside_a_cut_end_openings_and_diaphragms_keep_clear_of_the_cut():
    """A plane through (6000, 0, 0) that leans by 30°: at z it cuts at 6000 − z tan 30°."""
    normal = np.cos(np.pi / 6), 0.0, np.sin(np.pi / 6)
    cut = EndCut("plane", point=(6000.0, 0.0, 0.0), normal=normal)
    member = with_end_cuts(straight(hollow()), (SQUARE, cut))
    at_top = 6000.0 - 440.0 * np.tan(np.pi / 6)
    hole = hole_shape("d=100")
    good = made(member, [Opening("top", at_top - 50.0 - 45.0, hole)])
    assert len(of(good, "top").openings) == 1
    for s in (at_top - 50.0 - 10.0, at_top):
        found = findings(made, member, [Opening("top", s, hole)])
        assert [f.code for f in found] == ["opening-on-joint"]
    plates, _ = split_plates(member, {})
    at_corner = 6000.0 - 430.0 * np.tan(np.pi / 6)
    assert flat_parts(member, plates, [Diaphragm(at_corner - 12.0, 20.0)]).flats
    for row, code in (
        (Diaphragm(at_corner - 5.0, 20.0), "diaphragm-outside"),
        (Diaphragm(0.0, 20.0, end="end"), "end-plate-on-cut"),
    ):
        assert [f.code for f in findings(flat_parts, member, plates, [row])] == [code]


def test_on_lanes_the_offset_counts_from_the_middle_of_the_face():
    """Two lanes of 280 mm: an opening lies on the one its offset falls on."""
    member = straight(hollow())
    plates, _ = split_plates(member, {}, lanes={"top": Lanes((0.5,))})
    rows = [Opening("top", 2000.0, hole_shape("d=80"), offset) for offset in (-140.0, 150.0)]
    first, second = (p for p in with_parts(member, plates, (), rows)[0] if p.face == "top")
    assert first.openings[0].spot.point == pytest.approx([2000.0, 140.0, 440.0], abs=1e-8)
    assert second.openings[0].spot.point == pytest.approx([2000.0, -150.0, 440.0], abs=1e-8)
    for offset, value in ((0.0, None), (-50.0, 10.0)):
        row = Opening("top", 2000.0, hole_shape("d=80"), offset)
        (finding,) = findings(with_parts, member, plates, (), [row])
        assert finding.code == "opening-on-seam" and "offset" in finding.mend
        assert finding.value == (None if value is None else pytest.approx(value, abs=0.01))
    outside = Opening("top", 2000.0, hole_shape("d=80"), -270.0)
    assert [f.code for f in findings(with_parts, member, plates, (), [outside])] == [
        "opening-outside"
    ]
    flat = flat_parts(member, plates, [Diaphragm(4000.0, 10.0, gap=2.0)]).flats[0]
    assert np.ptp(flat.outline[:, :2], axis=0) == pytest.approx([556.0, 856.0], abs=1e-6)


def test_marks_lie_where_they_are_asked_for():
    """Lines keep their length and direction, punches and texts their place; the rest is refused."""
    rows = [
        FaceMark("bottom", 1000.0, 50.0, "line", length=200.0, angle=np.pi / 2),
        FaceMark("bottom", 1500.0, -50.0),
        FaceMark("bottom", 0.5, 0.0, "text", "LIFT", s_is_ratio=True),
    ]
    plate = of(made(straight(hollow()), (), rows), "bottom")
    line, punch, text = develop_plate(plate).marks
    assert [m.kind for m in (line, punch, text)] == ["line", "punch", "text"]
    assert np.linalg.norm(line.flat[-1] - line.flat[0]) == pytest.approx(200.0, abs=1e-8)
    assert np.allclose(line.flat[:, 0], 1000.0, atol=1e-8)
    step = punch.flat[0] - line.flat.mean(axis=0)
    assert np.abs(step) == pytest.approx([500.0, 100.0], abs=1e-8)
    assert text.text == "LIFT" and text.flat[0, 0] == pytest.approx(3000.0)
    assert text.flat[1, 0] > text.flat[0, 0]
    bad = FaceMark("bottom", 1000.0, 250.0, "line", length=200.0, angle=np.pi / 2)
    curved = of(made(ring_beam(), (), [FaceMark("top", 3000.0)]), "top")
    mid, inner = (develop_plate(curved, surface=s).marks[0].flat[0, 0] for s in ("mid", "inner"))
    assert inner / mid == pytest.approx(12430.0 / 12440.0, rel=1e-6)
    found = findings(made, straight(hollow()), (), (rows[1], bad, FaceMark("x", 1.0)))
    assert [(f.code, f.position) for f in found] == [
        ("mark-outside", "mark 2"),
        ("mark-face", "mark 3"),
    ]


def test_words_of_marks_and_tables():
    assert mark_words("punch")[0] == "punch"
    assert mark_words("line 200 90deg") == ("line", "", 200.0, pytest.approx(np.pi / 2))
    assert mark_words("line of sight") == ("text", "line of sight", 0.0, 0.0)
    assert findings(mark_words, "line -5")[0].code == "mark-text"
    assert place_of("35%") == (0.35, True) and place_of(3000.0) == (3000.0, False)
    for text in ("120%", "-1", "middle"):
        assert findings(place_of, text)[0].code == "part-place"
    row = diaphragm_of({"s": "end", "t": 20.0, "gap": -15.0, "material": "Q355, 7850, 206000, 355"})
    assert (row.end, row.gap, row.material.density) == ("end", -15.0, pytest.approx(7.85e-6))
    assert findings(material_of, "Q355, 7850")[0].code == "part-material"
    assert opening_of({"face": "top", "s": "10%", "shape": "d=5", "rotation": 90.0}).s_is_ratio
    assert mark_of({"face": "top", "s": 5, "text": "A 1"}).text == "A 1"
