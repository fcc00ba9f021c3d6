# SPDX-License-Identifier: LGPL-2.1-or-later
"""Assembly beds: frames, seats, stops, pins and templates against the member's own geometry."""

import curved_members
import numpy as np
import pytest

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.beds.bed import SEAT_INSET, bed_of, saddle_places, steep_findings
from BendTorsionWB.core.beds.bed_face import BedInput, least_direction
from BendTorsionWB.core.beds.templates import convex_hull, offset_outline, section_outline
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.rigid import inverse, moved
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.joints.pieces import PieceInput
from BendTorsionWB.core.members.end_cut import EndCut
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.plates.diaphragms import Diaphragm
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import i_section

BOX = box("B", "box1", 800, 600, 16)
TAPERED = curved_members.tapered()
PLANE = analytic_surface("plane", {})


def straight(length=7000.0, points=None, surface=PLANE, section=BOX):
    points = [[0.0, 0.0, 0.0], [length, 0.0, 0.0]] if points is None else points
    axis = fit_axis("A", np.array(points), surface)
    return Member(
        "M1", surface_frames(axis, surface), section_law("M1", [Segment(section)], axis.length)
    )


def whole(member, **given):
    return bed_of(member, BedInput(**given), 500.0, 0, 0.0, member.length)


def down_face_distance(member, bed, places, s):
    """Distance (n,) of bed points from the plane-section line of the down face at s (n,)."""
    strip = next(k for k in member.law.strips if k.face == bed.face)
    corners = member.corners(bed.start, bed.end)(s).reshape(len(s), -1, 3)
    first, second = corners[:, strip.first], corners[:, strip.second]
    off, along = moved(bed.to_model, places) - first, second - first
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    return np.linalg.norm(off - (off * along).sum(axis=1)[:, None] * along, axis=1)


def test_a_straight_box_lies_level_on_its_bottom():
    bed = whole(straight())
    assert (bed.face, bed.plane, bed.name) == ("bottom", "fit", "M1")
    assert bed.deviation == pytest.approx(0.0, abs=1e-9)
    places = [200.0, 1850.0, 3500.0, 5150.0, 6800.0]
    assert [saddle.s for saddle in bed.saddles] == pytest.approx(places)
    for saddle in bed.saddles:
        for seat, y in ((saddle.left, 300 - SEAT_INSET), (saddle.right, SEAT_INSET - 300)):
            np.testing.assert_allclose(seat.place, (saddle.s, y, 700.0), atol=1e-9)
        assert (saddle.left.edge, saddle.right.edge) == ("left", "right")
        assert saddle.slope == pytest.approx(0.0, abs=1e-12)
        np.testing.assert_allclose(np.abs(saddle.stop), (saddle.s, 300.0, 850.0), atol=1e-9)
    top = [point.bed[2] for point in bed.points if point.corner == "TL"]
    np.testing.assert_allclose(top, 1500.0)


def test_the_axis_down_a_slope_is_levelled_and_x_runs_along_it():
    ramp = straight(points=[[0.0, 0.0, 0.0], [3000.0, 4000.0, 0.0]])
    bed = whole(ramp, height=500.0)
    last = bed.points[-1]
    assert last.line == "E-2" and last.bed[0] == pytest.approx(5000.0, abs=1e-6)
    assert min(point.bed[2] for point in bed.points) == pytest.approx(500.0, abs=1e-9)
    np.testing.assert_allclose(bed.to_bed[:3, :3] @ [0.6, 0.8, 0.0], [1.0, 0.0, 0.0], atol=1e-12)


@pytest.mark.parametrize("face", ["auto", "bottom", "top", "left", "right"])
@pytest.mark.parametrize("plane", ["fit", "middle"])
def test_seats_touch_the_face_that_lies_down(face, plane):
    bed = whole(TAPERED, face=face, plane=plane)
    assert face in ("auto", bed.face)
    s = np.array([saddle.s for saddle in bed.saddles])
    for side in ("left", "right"):
        seats = np.array([getattr(saddle, side).place for saddle in bed.saddles])
        assert down_face_distance(TAPERED, bed, seats, s).max() < 1e-6
    left = np.array([saddle.left.place for saddle in bed.saddles])
    right = np.array([saddle.right.place for saddle in bed.saddles])
    assert (left[:, 1] > right[:, 1]).all()
    assert min(left[:, 2].min(), right[:, 2].min()) == pytest.approx(700.0, abs=1e-9)
    # The section is above its seats, and the member is seen the right way round.
    assert np.linalg.det(bed.to_bed[:3, :3]) == pytest.approx(1.0)
    middle = np.mean([point.bed for point in bed.points], axis=0)
    assert middle[2] > np.mean([left[:, 2].mean(), right[:, 2].mean()])
    for saddle in bed.saddles:
        low = getattr(saddle, saddle.stop_side)
        assert low.place[2] <= min(saddle.left.place[2], saddle.right.place[2]) + 1e-6
        # The stop is 150 mm up the face beside, from the corner the seat is 100 mm from.
        reach = np.linalg.norm(saddle.stop - low.place)
        assert reach == pytest.approx(np.hypot(150.0, SEAT_INSET), rel=2e-2)


def test_the_best_plane_is_no_worse_than_any_near_it():
    bed = whole(TAPERED, face="bottom")
    edges = bed.face_edges.reshape(-1, 3)
    off = edges - edges.mean(axis=0)
    least = (off[:, 2] ** 2).sum()
    assert least == pytest.approx(np.linalg.eigvalsh(off.T @ off)[0], rel=1e-9)
    assert bed.deviation == pytest.approx(np.ptp(edges[:, 2]) / 2)


def test_the_least_direction_is_that_of_an_eigenvalue_solver():
    rng = np.random.default_rng(1)
    for _ in range(5):
        points = rng.normal(size=(40, 3)) * (1e4, 300.0, 40.0) @ curved_members.rotation(2).T
        off = points - points.mean(axis=0)
        wanted = np.linalg.eigh(off.T @ off)[1][:, 0]
        assert abs(least_direction(points) @ wanted) == pytest.approx(1.0, abs=1e-12)


def test_a_bed_moves_with_its_member():
    turn, shift = curved_members.rotation(), np.array([1000.0, -2e4, 300.0])
    t = np.linspace(0.0, 1.0, 9)
    arc = np.column_stack([np.cos(t), np.sin(t) * np.cos(0.3 * t), np.sin(t) * np.sin(0.3 * t)])
    one, two = (
        whole(
            straight(
                points=20000.0 * arc @ rotation.T + centre,
                surface=analytic_surface("sphere", {"r": 20000.0}, tuple(centre)),
            ),
            pin_pitch=250.0,
        )
        for rotation, centre in ((np.eye(3), np.zeros(3)), (turn, shift))
    )
    assert not np.allclose(one.to_bed[:3, :3], two.to_bed[:3, :3], atol=0.1)
    for a, b in zip(one.saddles, two.saddles, strict=True):
        np.testing.assert_allclose(a.left.place, b.left.place, atol=1e-5)
        np.testing.assert_allclose(a.stop, b.stop, atol=1e-5)
    assert [(p.column, p.row) for p in one.pins] == [(p.column, p.row) for p in two.pins]
    # And the records' own matrices take the model's points to the bed and back.
    for bed in (one, two):
        xyz = np.array([point.xyz for point in bed.points])
        np.testing.assert_allclose(
            moved(bed.to_bed, xyz), [point.bed for point in bed.points], atol=1e-6
        )
        np.testing.assert_allclose(
            moved(bed.to_model, [point.bed for point in bed.points]), xyz, atol=1e-6
        )
    assert np.allclose(inverse(one.to_bed) @ one.to_bed, np.eye(4))


def test_a_given_normal_points_up():
    bed = whole(TAPERED, face="top", plane="normal", normal=(0.1, 0.2, -2.0))
    up = np.array([0.1, 0.2, -2.0]) / np.linalg.norm([0.1, 0.2, -2.0])
    np.testing.assert_allclose(bed.to_bed[2, :3], up)
    with pytest.raises(BendTorsionError, match="does not face down"):
        whole(TAPERED, face="bottom", plane="normal", normal=(0.1, 0.2, -2.0))


def test_saddles_stand_at_diaphragms_and_no_farther_apart_than_asked():
    places = saddle_places(0.0, 9000.0, 2000.0, (100.0, 3000.0, 3500.0, 20000.0))
    assert {200.0, 3000.0, 3500.0, 8800.0} <= set(places)
    assert np.diff(places).max() <= 2000.0 and (np.diff(places) > 0).all()
    assert saddle_places(1000.0, 1400.0, 2000.0).tolist() == [1100.0, 1300.0]


def test_pins_touch_the_face_at_the_nodes_of_the_grid():
    bed = whole(TAPERED, face="left", pin_pitch=300.0, lowest_pin=250.0)
    assert len(bed.pins) > 150
    assert min(pin.height for pin in bed.pins) == pytest.approx(250.0)
    strip = next(k for k in TAPERED.law.strips if k.face == "left")
    corners = TAPERED.corners(0.0, TAPERED.length)
    dense = np.linspace(0.0, TAPERED.length, 20001)
    rails = corners(dense).reshape(len(dense), -1, 3)[:, [strip.first, strip.second]]
    rails = moved(bed.to_bed, rails.reshape(-1, 3)).reshape(-1, 2, 3)
    for pin in bed.pins[9::37]:
        assert (pin.x, pin.y) == (300.0 * pin.column, 300.0 * pin.row)
        # The ruling that passes over the pin in plan, by the sign of its side.
        a, b = rails[:, 0], rails[:, 1]
        side = (b - a)[:, 0] * (pin.y - a[:, 1]) - (b - a)[:, 1] * (pin.x - a[:, 0])
        k = int(np.flatnonzero(np.diff(np.sign(side)))[0])
        share = side[k] / (side[k] - side[k + 1])
        first, second = (1 - share) * rails[k] + share * rails[k + 1]
        w = np.dot((pin.x, pin.y) - first[:2], (second - first)[:2]) / np.dot(
            (second - first)[:2], (second - first)[:2]
        )
        height = first[2] + w * (second - first)[2] - bed.pin_base
        assert pin.height == pytest.approx(height, abs=1e-3)
        normal = np.cross(rails[k + 1].mean(axis=0) - rails[k].mean(axis=0), second - first)
        level = abs(normal[2]) / np.linalg.norm(normal)
        assert np.cos(pin.tilt) == pytest.approx(level, abs=2e-3)


def test_pins_below_a_level_face_are_level():
    bed = whole(straight(), pin_pitch=200.0)
    assert {(pin.column, pin.row) for pin in bed.pins} == {
        (i, j) for i in range(36) for j in (-1, 0, 1)
    }
    assert max(pin.tilt for pin in bed.pins) < 1e-9
    assert bed.pin_base == pytest.approx(450.0)


def test_templates_are_the_section_outline():
    bed = whole(TAPERED, template_lines=("L-20",))
    lines = [board.line for board in bed.templates]
    assert lines[0] == "E-1" and lines[-1] == "E-2" and "L-20" in lines
    assert [board.name for board in bed.templates][:2] == [
        "M1-E1",
        f"M1-{lines[1]}".replace("L-", "L"),
    ]
    assert np.diff([board.s for board in bed.templates]).max() <= 3500.0 + 500.0
    for board in bed.templates:
        at = TAPERED.frames.at(np.array([board.s]))
        in_space = at.origin + board.section[:, 1:] * at.z - board.section[:, :1] * at.y
        corners = TAPERED.corners(0.0, TAPERED.length)(np.array([board.s])).reshape(-1, 3)
        gap = np.linalg.norm(in_space[:, None] - corners[None], axis=2)
        assert gap.min(axis=0).max() < 1e-6 and gap.min(axis=1).max() < 1e-6
        assert board.outline is board.section or np.array_equal(board.outline, board.section)


def test_clearance_moves_every_side_of_a_template():
    (board, *_) = whole(straight(), clearance=5.0).templates
    np.testing.assert_allclose(np.ptp(board.outline, axis=0), (610.0, 810.0))
    hexagon = np.array([[np.cos(a), np.sin(a)] for a in np.arange(6) * np.pi / 3]) * 100.0
    apothem = 100.0 * np.cos(np.pi / 6)
    grown = offset_outline(hexagon, 7.0)
    np.testing.assert_allclose(grown, hexagon * (apothem + 7.0) / apothem, atol=1e-9)
    with pytest.raises(BendTorsionError, match="leaves nothing"):
        whole(straight(), clearance=-350.0)


def test_where_the_section_steps_each_template_is_its_own_sides():
    member = curved_members.member(
        [Segment(BOX), Segment(box("S", "box1", 500, 600, 16), 9000.0, 0.0)]
    )
    before, after = (section_outline(member, 9000.0, side) for side in ("earlier", "later"))
    assert np.ptp(before[:, 1]) == pytest.approx(800.0)
    assert np.ptp(after[:, 1]) == pytest.approx(500.0)


def test_the_hull_of_a_cross_is_its_tips():
    points = np.array([[0, 0], [2, 0], [-2, 0], [0, 1], [0, -1], [0.2, 0.1]], float)
    assert sorted(map(tuple, convex_hull(points))) == [(-2, 0), (0, -1), (0, 1), (2, 0)]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"face": "side"}, "no face 'side'"),
        ({"spacing": 0.0}, "saddle spacing is too small"),
        ({"pin_pitch": 5.0}, "pin pitch is too small"),
        ({"height": -1.0}, "seat height is too small"),
        ({"plane": "normal", "normal": (0.0, 0.0, 0.0)}, "no direction"),
    ],
)
def test_what_cannot_be_bedded_is_said(given, words):
    with pytest.raises(BendTorsionError, match=words):
        whole(straight(), **given)


def test_a_steep_bed_is_noted():
    assert steep_findings(whole(straight())) == []
    (found,) = steep_findings(whole(TAPERED, face="right"))
    assert (found.severity, found.object, found.unit) == ("note", "M1", "°")
    assert found.value > found.limit == pytest.approx(15.0)


def test_an_open_section_lies_on_its_flange_and_its_template_is_its_hull():
    member = straight(section=i_section("I", 600, 300, 20, 16, 12))
    bed = whole(member)
    assert bed.face == "bottom"
    for saddle in bed.saddles:
        np.testing.assert_allclose(np.abs(saddle.left.place[1:]), (75.0, 700.0), atol=1e-6)
    corners = {(-150.0, -300.0), (150.0, -300.0), (150.0, 300.0), (-150.0, 300.0)}
    assert {tuple(point) for point in bed.templates[1].section.round(6)} == corners
    tilted = curved_members.member([Segment(i_section("I", 600, 300, 20, 16, 12))])
    for board in whole(tilted).templates:
        np.testing.assert_allclose(np.ptp(board.section, axis=0), (300.0, 600.0), atol=1e-6)


def test_a_ring_has_a_bed_on_its_side():
    u = np.linspace(0.0, 2.0 * np.pi, 17)[:-1]
    points = 9000.0 * np.column_stack([np.cos(u), np.sin(u), 0.0 * u])
    surface = analytic_surface("cylinder", {"r": 9000.0})
    axis = axis_from(AxisInput("R", points, closed=True), surface)
    ring = Member("R", surface_frames(axis, surface), section_law("R", [Segment(BOX)], axis.length))
    bed = whole(ring)
    assert bed.face in ("left", "right")
    assert bed.deviation == pytest.approx(0.0, abs=1e-3)
    heights = [seat.place[2] for one in bed.saddles for seat in (one.left, one.right)]
    np.testing.assert_allclose(heights, 700.0, atol=2e-3)
    # Asked for, a face of the ring that cannot lie down is refused.
    with pytest.raises(BendTorsionError, match="does not face down"):
        whole(ring, face="top")


def test_each_delivery_piece_has_its_bed_with_saddles_at_its_diaphragms():
    pieces = (PieceInput(1, (0.0, False), (12000.0, False)), PieceInput(2))
    job = detailing.MemberJob(
        curved_members.ELLIPSOID,
        AxisInput("A1", curved_members.irregular(curved_members.diagonal)),
        detailing.MemberInput("M1", (Segment(BOX),)),
        detailing.PlatesInput(diaphragms=(Diaphragm(5000.0, 12.0, 2.0),), pieces=pieces),
        BedInput(face="bottom", spacing=3000.0),
    )
    record = detailing.detail(job).record
    assert [bed.name for bed in record.beds] == ["M1-P1", "M1-P2"]
    one, two = record.beds
    assert (one.start, one.end, two.start) == (0.0, 12000.0, 12000.0)
    assert 5000.0 in [saddle.s for saddle in one.saddles]
    assert max(saddle.s for saddle in one.saddles) <= 12000.0 - 200.0 + 1e-9
    assert min(saddle.s for saddle in two.saddles) >= 12000.0 + 200.0 - 1e-9
    for bed in record.beds:
        heights = [seat.place[2] for o in bed.saddles for seat in (o.left, o.right)]
        assert min(heights) == pytest.approx(700.0)
    assert one.templates[0].name == "M1-P1-E1" and two.templates[-1].name == "M1-P2-E2"


def test_control_points_of_skew_ends_are_the_corners_of_the_plates():
    job = detailing.MemberJob(
        curved_members.ELLIPSOID,
        AxisInput("A1", curved_members.irregular(curved_members.diagonal)),
        detailing.MemberInput(
            "M1",
            (Segment(BOX),),
            start_cut=EndCut("plane", normal=(1.0, 0.3, -0.5)),
        ),
        detailing.PlatesInput(),
        BedInput(face="bottom"),
    )
    record = detailing.detail(job).record
    (bed,) = record.beds
    for side, letter in (("left", "L"), ("right", "R")):
        plate = next(plate for plate in record.plates if plate.face == side)
        for line in ("E-1", "L-9", "E-2"):
            arris = {p.edge: p.xyz for p in plate.points if p.line == line and p.kind == "arris"}
            for edge, name in (("top", f"T{letter}"), ("bottom", f"B{letter}")):
                (point,) = [p for p in bed.points if (p.line, p.corner) == (line, name)]
                np.testing.assert_allclose(point.xyz, arris[edge], atol=1e-4)
    places = {p.corner: p.s for p in bed.points if p.line == "E-1"}
    assert len(set(places.values())) == 4
    # Seats stand on the face where it is whole.
    assert bed.saddles[0].s >= max(places["BL"], places["BR"]) + 199.0
