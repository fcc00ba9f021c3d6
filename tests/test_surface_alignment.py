# SPDX-License-Identifier: LGPL-2.1-or-later
"""Alignment to the surface itself: the held face keeps its distance where the axis does not."""

import numpy as np
import pytest

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.volume import skin_volumes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import i_section

R = 20000.0
CYLINDER = analytic_surface("cylinder", {"r": R})
BIG = box("B800", "box1", 800, 700, 20, gap1=3, gap2=3)
SMALL = box("B600", "box1", 600, 500, 16, gap1=3, gap2=3)
CROSSING = np.array([[20300.0, -5000.0, 0.0], [19700.0, 5000.0, 4000.0]])
"""A straight axis that goes into the cylinder and out again, oblique to its rulings."""


def geometry(segments, points=CROSSING, surface=CYLINDER, **given):
    axis = detailing.axis_of(AxisInput("A1", np.asarray(points), fit="keep"), surface)
    return detailing.member_of(detailing.MemberInput("M1", tuple(segments), **given), axis, surface)


def middle_of(made, s, face):
    """(n, 3): the middle of the outer line of the top or bottom face of a box."""
    corners = made.member.corners(0.0, made.member.length)(s).reshape(len(s), -1, 3)
    one, other = (0, 1) if face == "top" else (2, 3)
    return 0.5 * (corners[:, one] + corners[:, other])


def places(made, count=401):
    return np.linspace(0.0, made.member.length, count)


def by_hand(y, distance, z_of_axis, s):
    """The height at which o + y Y + z Z has radius R + distance, from the quadratic in z; the frame
    from the straight axis and the radial direction."""
    along = np.diff(CROSSING, axis=0)[0]
    x = along / np.linalg.norm(along)
    origin = CROSSING[0] + s[:, None] * x
    radial = origin * [1.0, 1.0, 0.0]
    z = radial - (radial @ x)[:, None] * x
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    q = (origin + y * np.cross(z, x))[:, :2]
    a, b = (z[:, :2] ** 2).sum(axis=1), (q * z[:, :2]).sum(axis=1)
    c = (q**2).sum(axis=1) - (R + distance) ** 2
    return (-b + np.sqrt(b * b - a * c)) / a - z_of_axis


@pytest.mark.parametrize("offset", [0.0, -150.0, 60.0])
@pytest.mark.parametrize("align", ["top", "bottom", "top-left", "bottom-right"])
def test_the_middle_of_the_held_face_keeps_its_distance(align, offset):
    made = geometry([Segment(BIG, align=align, align_to="surface", offset_z=offset)], offset_z=10.0)
    s = places(made)
    middle = middle_of(made, s, align.split("-")[0])
    assert np.hypot(middle[:, 0], middle[:, 1]) - R == pytest.approx(offset + 10.0, abs=1e-5)
    # The axis itself leaves the surface by far more.
    origin = made.member.frames.axis.position(s)
    assert np.ptp(np.hypot(origin[:, 0], origin[:, 1])) > 200.0


def test_the_section_moves_along_its_height_as_the_quadratic_says():
    segment = Segment(BIG, align="top", align_to="surface", offset_y=120.0, offset_z=-40.0)
    made = geometry([segment])
    s = places(made)
    [cell] = made.member.law.cells
    corners = cell.corners_at(s)
    assert corners[:, :2, 0] == pytest.approx(np.array([[470.0, -230.0]] * len(s)))
    expected = by_hand(120.0, -40.0, 0.0, s)
    assert corners[:, 0, 1] == pytest.approx(expected, abs=1e-5)
    assert corners[:, 0, 1] - corners[:, 2, 1] == pytest.approx(800.0)


def test_an_axis_on_the_surface_gives_the_alignment_to_the_axis():
    angle = np.linspace(0.0, 0.6, 9)
    helix = np.column_stack([R * np.cos(angle), R * np.sin(angle), 8000.0 * angle])
    to = {
        name: geometry([Segment(BIG, align="top", align_to=name)], points=helix)
        for name in ("axis", "surface")
    }
    s = places(to["axis"])
    off = [middle_of(made, s, "top") for made in to.values()]
    # The spline through the points is off the surface by this much.
    axis_off = np.abs(np.hypot(off[0][:, 0], off[0][:, 1]) - R).max()
    assert np.abs(off[0] - off[1]).max() <= 1.01 * axis_off + 1e-9


def test_built_solids_hold_the_distance_and_their_volume():
    segments = [
        Segment(BIG, align="top", align_to="surface"),
        Segment(SMALL, 4000.0, align="top", align_to="surface"),
    ]
    made = geometry(segments)
    plates = detailing.plates_of(made, detailing.PlatesInput())
    volumes = skin_volumes([item.skin for item in plates.plates])
    for item, volume in zip(plates.plates, volumes, strict=True):
        assert volume == pytest.approx(item.plate.volume, rel=1e-6)
        if item.plate.face == "top":
            for piece in item.skin:
                s = np.linspace(piece.knots[0], piece.knots[-1], 57)
                middle = piece.at(s)[:, :2].mean(axis=1)
                assert np.abs(np.hypot(middle[:, 0], middle[:, 1]) - R).max() < 0.005
    assert detailing.torsion_error(made) < np.radians(0.001)
    # Both segments hold the same line: it runs on straight through the folds of the other faces.
    rate = made.member.corners(0.0, made.member.length).derivative
    for fold in made.member.law.folds:
        before, after = (
            rate([fold], side)[0].reshape(4, 3)[:2].mean(axis=0) for side in ("earlier", "later")
        )
        assert np.abs(after - before).max() < 1e-8
    assert len(made.member.law.folds) == 2
    assert vars(made.member.law.face_steps[0]) == pytest.approx(
        {"top": 0.0, "bottom": 200.0, "left": -100.0, "right": 100.0}
    )


def test_the_shortest_way_from_the_axis_to_the_surface_is_a_transition():
    segments = [
        Segment(SMALL, align="top"),
        Segment(SMALL, 3000.0, 4.0, align="top", align_to="surface", transition="linear"),
        Segment(SMALL, 7000.0, align="centre", align_to="previous"),
    ]
    made = geometry(segments)
    law = made.member.law
    at_cut = by_hand(0.0, 0.0, 0.0, np.array([3000.0]))[0]
    assert law.face_steps[0].top == pytest.approx(at_cut, abs=1e-6)
    assert law.face_steps[0].left == 0.0
    transition = next(cell for cell in law.cells if cell.label == "b-1")
    assert transition.end - transition.start == pytest.approx(4.0 * abs(at_cut), abs=1e-5)
    s = places(made, 2001)
    top = np.concatenate(
        [cell.corners_at(s[(s >= cell.start) & (s < cell.end)]) for cell in law.cells]
    )
    top, hand = top[:, 0, 1], by_hand(0.0, 0.0, 0.0, s[s < law.length])
    s = s[s < law.length]
    assert top[s < 3000.0] == pytest.approx(0.0, abs=1e-9)
    assert top[s >= transition.end] == pytest.approx(hand[s >= transition.end], abs=1e-5)
    part = ((s - 3000.0) / (transition.end - 3000.0))[(s >= 3000.0) & (s < transition.end)]
    inside = (s >= 3000.0) & (s < transition.end)
    assert top[inside] == pytest.approx(part * hand[inside], abs=1e-5)
    # Segment 3 follows segment 2, which has the same section: no step.
    assert law.face_steps[1].largest == 0.0
    assert detailing.plates_of(made, detailing.PlatesInput()).plates


def test_an_open_section_and_any_frame_can_be_held():
    i = i_section("I", 600, 300, 20, 20, 12)
    made = geometry([Segment(i, align="bottom", align_to="surface", offset_z=500.0)], roll=0.2)
    s = places(made)
    at = made.member.frames.at(s)
    [cell] = made.member.law.cells
    bottom = cell.corners_at(s)[:, [2, 3]].mean(axis=1)
    point = at.origin + bottom[:, :1] * at.y + bottom[:, 1:] * at.z
    assert np.hypot(point[:, 0], point[:, 1]) - R == pytest.approx(500.0, abs=1e-5)


def test_a_preset_keeps_the_distance_on_the_design_axis():
    from BendTorsionWB.core.axes.axis_preset import Preset

    preset = Preset(
        np.array([0.0, 0.5, 1.0]), np.array([[0, 0, 0], [0, 0, 30.0], [0, 0, 0]]), "ratio"
    )
    axis = detailing.axis_of(AxisInput("A1", CROSSING, fit="keep", preset=preset), CYLINDER)
    given = detailing.MemberInput("M1", (Segment(BIG, align="top", align_to="surface"),))
    made = detailing.member_of(given, axis, CYLINDER)
    s = places(made)
    at = made.member.frames.at(s)
    top = made.member.law.cells[0].corners_at(s)[:, 0, 1]
    point = axis.surface_points(s) + top[:, None] * at.z
    assert np.abs(np.hypot(point[:, 0], point[:, 1]) - R).max() < 1e-5


@pytest.mark.parametrize("align", ["centre", "left", "right"])
def test_what_a_surface_cannot_hold_is_refused_by_name(align):
    with pytest.raises(BendTorsionError) as raised:
        geometry([Segment(BIG), Segment(SMALL, 3000.0, align=align, align_to="surface")])
    [finding] = raised.value.findings
    assert finding.code == "alignment" and finding.position == "segment 2"
    assert finding.value == align and "top" in finding.mend


def test_a_section_that_does_not_face_the_surface_is_refused_with_its_place():
    axis = detailing.axis_of(AxisInput("A1", CROSSING, fit="keep"), CYLINDER)
    frame = FrameInput("fixed", direction=(0.0, 0.0, 1.0))
    given = detailing.MemberInput(
        "M1", (Segment(BIG, align="top", align_to="surface"),), frame=frame
    )
    with pytest.raises(BendTorsionError) as raised:
        detailing.member_of(given, axis, CYLINDER)
    finding = raised.value.findings[-1]
    assert finding.code == "alignment-to-surface" and "s = " in finding.position and finding.mend


@pytest.mark.parametrize("transition", ["linear", "smooth"])
def test_the_rate_of_the_lift_is_its_derivative_and_joins_as_the_transition_does(transition):
    segments = [
        Segment(SMALL, align="top"),
        Segment(SMALL, 3000.0, 4.0, align="top", align_to="surface", transition=transition),
    ]
    law = geometry(segments).member.law
    cells = {cell.label: cell for cell in law.cells}
    for cell in cells.values():
        if cell.lift is None:
            continue
        s = np.linspace(cell.start + 1.0, cell.end - 1.0, 50)
        slope = (cell.lift.at(s + 0.5)[0] - cell.lift.at(s - 0.5)[0]) / 1.0
        assert cell.lift.at(s)[1] == pytest.approx(slope, abs=1e-6)
    transit, after = cells["b-1"].lift, cells["d-2"].lift
    start, end = [cells["b-1"].start], [cells["b-1"].end]
    assert transit.at(start)[0] == pytest.approx(0.0) and cells["d-1"].lift is None
    assert transit.at(end)[0] == pytest.approx(after.at(end)[0], abs=1e-9)
    folded = [abs(transit.at(start)[1][0]), abs((transit.at(end)[1] - after.at(end)[1])[0])]
    if transition == "smooth":
        assert folded == pytest.approx([0.0, 0.0], abs=1e-12) and law.folds == ()
    else:
        assert min(folded) > 0.01 and law.folds == (start[0], end[0])


def test_a_ring_beside_the_surface_is_held_all_round():
    turn = np.linspace(0.0, 2 * np.pi, 25)[:-1]
    radius = R - 300.0 + 80.0 * np.cos(3 * turn)
    ring = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), 500.0 * np.sin(2 * turn)])
    axis = detailing.axis_of(AxisInput("A1", ring, fit="keep", closed=True), CYLINDER)
    segment = Segment(BIG, align="bottom", align_to="surface", offset_z=20.0)
    made = detailing.member_of(detailing.MemberInput("M1", (segment,)), axis, CYLINDER)
    middle = middle_of(made, places(made), "bottom")
    assert np.hypot(middle[:, 0], middle[:, 1]) == pytest.approx(R + 20.0, abs=1e-5)
    assert middle[0] == pytest.approx(middle[-1], abs=1e-5)


def test_past_the_border_of_a_surface_is_a_warning_with_its_place():
    from exact_axes import curves

    curve = curves()["HP-S"]
    points = curve.derivatives(np.array([0.0, 1.0]))[0]
    axis = detailing.axis_of(AxisInput("A1", points, fit="keep"), curve.surface)
    far = Segment(SMALL, align="top", align_to="surface")
    inside = detailing.member_of(detailing.MemberInput("M1", (far,)), axis, curve.surface)
    assert not any(f.code == "alignment-surface-border" for f in inside.findings)
    ends = points + 0.6 * (points - points[::-1])
    axis = detailing.axis_of(AxisInput("A2", ends, fit="keep"), curve.surface)
    made = detailing.member_of(detailing.MemberInput("M2", (far,)), axis, curve.surface)
    [finding] = [f for f in made.findings if f.code == "alignment-surface-border"]
    assert finding.severity == "warning" and finding.position.startswith("segment 1, s = ")
