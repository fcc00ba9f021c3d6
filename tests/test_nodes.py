# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where members meet: nodes found, named, resolved, and what cannot be a node told."""

import math

import numpy as np
import pytest
from meeting_members import along_x, at_angle, found, straight, twisted_pair

from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.nodes.node_cut import landings, outer_lines
from BendTorsionWB.core.nodes.node_faces import outer_faces
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.plates.flat_room import separation
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import i_section


def codes(result):
    """Every code with every member it names; no finding is told twice."""
    assert len(set(result.findings)) == len(result.findings)
    return {(f.code, name) for f in result.findings for name in f.objects}


@pytest.mark.parametrize("degrees", [90.0, 60.0, 40.0])
def test_a_straight_crossing_has_its_closed_form(degrees):
    result = found(along_x(), at_angle(degrees), ranks={"X": 1, "Y": 2})
    assert not result.findings
    (node,) = result.nodes
    assert (node.name, node.kind, node.through) == ("N1", "crossing", "X")
    assert np.allclose(node.point, 0.0, atol=1e-6) and math.isclose(node.s, 6000.0)
    (branch,) = node.branches
    assert branch.member == "Y" and math.isclose(branch.s, 6000.0)
    assert math.isclose(math.degrees(branch.angle), degrees)
    # The face at y = 200 less the gap of 3; the branch is 400 broad.
    sine, tangent = math.sin(branch.angle), math.tan(branch.angle)
    middle, half = 203.0 / sine, 200.0 / tangent
    for side in branch.sides:
        far = sorted(abs(place - 6000.0) for place in (side.low, side.high))
        assert far == pytest.approx([middle - half, middle + half])
    assert {side.faces for side in branch.sides} == {("left",), ("right",)}


def test_distances_are_those_of_a_plane_box():
    member = along_x(z=50.0)
    faces = outer_faces(member, 0.0, member.length)
    points = np.random.default_rng(1).uniform(-500, 500, (200, 3))
    for name, normal in (("left", (0, 1, 0)), ("top", (0, 0, 1)), ("right", (0, -1, 0))):
        value, gradient = faces.distance(faces.names.index(name), points)
        half = 300.0 if name == "top" else 200.0
        assert np.allclose(gradient, normal)
        assert np.allclose(value, (points - [0, 0, 50.0]) @ np.array(normal) - half, atol=1e-9)


def test_distances_to_a_twisted_face_are_true_ones():
    """The nearest of a million points of the face is as far as the distance says."""
    members = twisted_pair()
    faces = outer_faces(members["M1"], 12000.0, 14500.0)
    face = faces.names.index("left")
    s, w = (grid.ravel() for grid in np.meshgrid(np.linspace(12300, 14200, 1001), [0.1, 0.5, 0.9]))
    at, normal = faces.at(face, s, w)
    for reach in (-50.0, 3.0, 400.0):
        value, gradient = faces.distance(face, at + reach * normal)
        assert np.abs(value - reach).max() < 1e-8
        assert np.abs(gradient - normal).max() < 1e-8
    # The gradient is the rate of the distance.
    points = at[::300] + [120.0, -80.0, 300.0]
    value, gradient = faces.distance(face, points)
    for step in 1e-3 * np.eye(3):
        rate = (faces.distance(face, points + step)[0] - value) / 1e-3
        assert np.allclose(rate, gradient @ step / 1e-3, atol=1e-5)


def test_lines_of_a_branch_end_on_the_gap():
    members = twisted_pair()
    (node,) = find_nodes(members, {"M1": 1}).nodes
    (branch,) = node.branches
    for side in branch.sides:
        lines = outer_lines(members["M2"], branch.s - 2000, branch.s + 2000)
        s, points = landings(side.cut, lines, branch.s)
        (face,) = side.cut.landing
        assert np.allclose(side.cut.faces.distance(face, points)[0], 3.0, atol=1e-8)
        assert (side.low, side.high) == (s.min(), s.max())


def test_ranks_and_rows_say_who_runs_through():
    members = twisted_pair()
    assert find_nodes(members, {"M1": 1, "M2": 2}).nodes[0].through == "M1"
    assert find_nodes(members, {"M1": 3, "M2": 2}).nodes[0].through == "M2"
    assert find_nodes(members, {"M2": 2}).nodes[0].through == "M2"
    row = NodeInput("M2", "M1", "K7", gap=5.0)
    (node,) = find_nodes(members, {"M1": 1}, (row,)).nodes
    assert (node.name, node.through, node.branches[0].gap) == ("K7", "M2", 5.0)


@pytest.mark.parametrize("ranks", [{}, {"M1": 4, "M2": 4}])
def test_a_crossing_nobody_resolved_is_an_error_of_both(ranks):
    result = find_nodes(twisted_pair(), ranks)
    assert not result.nodes
    assert codes(result) == {("node-unresolved", "M1"), ("node-unresolved", "M2")}
    assert all(f.severity == "error" and "rank" in f.mend for f in result.findings)


def test_a_row_without_a_crossing_is_named():
    result = find_nodes(twisted_pair(), {"M1": 1}, (NodeInput("M1", "M3", "K1"),))
    assert {f.code for f in result.findings if f.severity == "error"} == {"node-not-found"}
    assert len(result.nodes) == 1


def test_names_follow_place_and_kept_names_are_not_given_twice():
    members = (along_x(), *(at_angle(90, f"Y{k}", x=x) for k, x in ((1, 3000.0), (2, -3000.0))))
    ranks = {"X": 1, "Y1": 2, "Y2": 2}
    plain = found(*members, ranks=ranks)
    assert [(n.name, n.branches[0].member) for n in plain.nodes] == [("N1", "Y2"), ("N2", "Y1")]
    named = found(*members, ranks=ranks, rows=(NodeInput("X", "Y1", "N1"),))
    assert [(n.name, n.branches[0].member) for n in named.nodes] == [("N2", "Y2"), ("N1", "Y1")]


@pytest.mark.parametrize(
    ("degrees", "kind", "ways"), [(90.0, "T", {-1}), (50.0, "Y", {-1}), (130.0, "Y", {-1})]
)
def test_a_branch_that_ends_inside_has_one_side(degrees, kind, ways):
    (node,) = found(along_x(), at_angle(degrees, ahead=0.0)).nodes
    assert node.kind == kind
    assert {side.way for side in node.branches[0].sides} == ways


def test_two_branches_that_end_at_one_place_make_a_k():
    one = at_angle(120, "Y1", ahead=0.0, x=80.0, section=box("S", "box1", 300, 200, 10))
    two = at_angle(60, "Y2", ahead=0.0, x=-80.0, section=box("S", "box1", 300, 200, 10))
    three = at_angle(-60, "Y3", ahead=0.0, x=0.0, section=box("S", "box1", 300, 200, 10))
    result = found(along_x(), one, two, three, ranks={"X": 1})
    assert [(n.kind, len(n.branches)) for n in result.nodes] == [("K", 3)]
    # The diaphragms of the third one, opposite, would run into those of the first two.
    assert codes(result) == {("node-diaphragms-meet", "X")}
    assert {f.severity for f in result.findings} == {"warning"}
    (node,) = result.nodes
    assert sum(len(b.diaphragms) for b in node.branches) == 4
    flats = [flat for branch in node.branches for flat in branch.diaphragms]
    assert min(separation(a, b) for a in flats for b in flats if a is not b) > 10.0


def test_branches_that_overlap_beside_the_through_member_are_named():
    one = at_angle(120, "Y1", ahead=0.0, x=-100.0, section=box("S", "box1", 300, 200, 10))
    two = at_angle(60, "Y2", ahead=0.0, x=100.0, section=box("S", "box1", 300, 200, 10))
    result = found(along_x(), one, two, ranks={"X": 1})
    assert codes(result) == {("node-branches-overlap", "Y1"), ("node-branches-overlap", "Y2")}
    assert not result.nodes and result.findings[0].value > 10.0


def test_a_corner_is_an_end_on_node_near_the_through_member_s_end():
    through = straight("X", (-400, 0, 0), (9000, 0, 0))
    (node,) = found(through, at_angle(90, ahead=0.0)).nodes
    assert node.kind == "corner"


def test_several_branches_make_one_node():
    members = (
        along_x(),
        at_angle(90, "Y1", back=0.0),
        at_angle(90, "Y2", ahead=0.0, x=100.0),
    )
    (node,) = found(*members, ranks={"X": 1}).nodes
    assert {b.member for b in node.branches} == {"Y1", "Y2"}


def test_a_branch_may_land_on_two_faces_at_an_arris():
    """A strut from above, askew in two planes, lands on the top and on the left face."""
    strut = straight("Y", (0, 3000, 3200), (0, 0, 0), section=box("S", "box1", 200, 200, 10))
    (node,) = found(along_x(), strut).nodes
    (side,) = node.branches[0].sides
    assert set(side.faces) == {"top", "left"}


def test_near_parallel_members_are_named_with_place_value_limit_and_mend():
    result = found(along_x(), at_angle(25))
    assert codes(result) == {("node-angle", "X"), ("node-angle", "Y")}
    finding = result.findings[0]
    assert (round(finding.value), round(finding.limit), finding.unit) == (25, 30, "deg")
    assert "s = 6000 mm of X" in finding.position and finding.mend


def test_a_branch_higher_than_the_face_is_named():
    result = found(along_x(), at_angle(90, section=box("W", "box1", 640, 400, 16)))
    assert codes(result) == {("branch-wider-than-face", "X"), ("branch-wider-than-face", "Y")}
    finding = result.findings[0]
    assert (finding.value, finding.limit) == (pytest.approx(20.0), 8.0)
    higher = found(along_x(), at_angle(90, section=box("W", "box1", 610, 400, 16)))
    assert {f.code for f in higher.findings} == {"node-step"} and higher.nodes
    assert not found(along_x(), at_angle(90, section=box("W", "box1", 300, 300, 16))).findings


@pytest.mark.parametrize(
    ("ahead", "value"), [(500.0, 297.0), (210.0, 7.0), (-150.0, None), (-198.0, None)]
)
def test_a_branch_that_ends_at_the_node_is_named(ahead, value):
    result = found(along_x(), at_angle(90, ahead=ahead))
    if value is None:
        assert not result.findings and result.nodes[0].kind == "T"
        return
    assert codes(result) == {("node-at-end", "X"), ("node-at-end", "Y")}
    finding = result.findings[0]
    assert (finding.value, finding.limit) == (pytest.approx(value), 600.0)
    assert f"{600 - value:.0f} mm longer" in finding.mend


def test_a_branch_too_short_to_land_all_round_is_named():
    """At 60 degrees one web would land 115 mm before the other, and the branch ends between."""
    result = found(along_x(), at_angle(60, ahead=-203.0 / math.sin(math.radians(60))))
    assert codes(result) == {("node-at-end", "X"), ("node-at-end", "Y")}
    half = 200.0 / math.tan(math.radians(60))
    assert result.findings[0].value == pytest.approx(-half)


def test_a_node_at_the_end_of_the_through_member_is_named():
    result = found(straight("X", (-230, 0, 0), (9000, 0, 0)), at_angle(90, ahead=0.0))
    assert codes(result) == {("node-at-end", "X"), ("node-at-end", "Y")}
    assert (result.findings[0].value, result.findings[0].limit) == (pytest.approx(30.0), 50.0)


@pytest.mark.parametrize("varying", ["X", "Y"])
def test_a_node_in_a_transition_is_named(varying):
    taper = [Segment(box("A", "box1", 600, 400, 16)), Segment(box("B", "box1", 600, 360, 16), 5700)]
    taper[1] = Segment(taper[1].section, 5700 if varying == "Y" else 5950, 10.0)
    x = along_x(segments=taper) if varying == "X" else along_x()
    y = at_angle(90, segments=taper) if varying == "Y" else at_angle(90)
    result = found(x, y)
    assert codes(result) == {("node-in-transition", "X"), ("node-in-transition", "Y")}
    assert f"of {varying}" in result.findings[0].position


def test_three_members_through_one_place_are_named():
    result = found(along_x(), at_angle(60, "Y"), at_angle(120, "Z"), ranks={"X": 1, "Y": 2, "Z": 3})
    assert ("node-three-through", "Y") in codes(result)
    assert ("node-three-through", "Z") in codes(result)
    assert not result.nodes


def test_members_that_nearly_touch_are_named():
    result = found(along_x(), at_angle(90, z=610.0))
    assert codes(result) == {("members-nearly-touch", name) for name in "XY"} and not result.nodes
    finding = result.findings[0]
    assert (finding.severity, finding.value) == ("warning", pytest.approx(10.0))
    assert not found(along_x(), at_angle(90, z=630.0)).findings


def test_an_open_section_cannot_run_through():
    member = along_x(section=i_section("I", 600, 300, 12, 20))
    result = found(member, at_angle(90))
    assert codes(result) == {("node-open-section", "X"), ("node-open-section", "Y")}


def test_rows_in_a_circle_leave_nothing_that_runs_through():
    """X over Y, Y over Z, Z over X: each ends on a member that is itself cut there."""
    rows = (NodeInput("X", "Y"), NodeInput("Y", "Z"), NodeInput("Z", "X"))
    result = found(along_x(), at_angle(60, "Y"), at_angle(120, "Z"), rows=rows)
    assert {name for code, name in codes(result) if code == "node-three-through"} == set("XYZ")
    assert not result.nodes


def test_a_stub_reaches_outside_the_member_it_stands_on():
    """A field joint inside the through member is no node; the length it names is one."""

    def made(length):
        row = NodeInput("X", "Y", type="stub", stub_length=length)
        return found(along_x(), at_angle(90), rows=(row,))

    refused = made(150.0)
    (finding,) = refused.findings
    assert (finding.code, finding.object, finding.value) == ("node-stub-short", "Y", 150.0)
    assert not refused.nodes
    assert made(finding.limit).nodes
    assert not made(finding.limit - 10.0).nodes
