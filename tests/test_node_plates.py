# SPDX-License-Identifier: LGPL-2.1-or-later
"""Branches cut at nodes: every plate ends on the through member's true face, less the gap."""

import math

import numpy as np
import pytest
from meeting_members import PLANE, along_x, at_angle, twisted_pair

from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.detailing import MemberGeometry, painted_area
from BendTorsionWB.core.joints.pieces import with_pieces
from BendTorsionWB.core.nodes.node_faces import outer_faces
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.nodes.node_members import nodes_of_member, with_nodes
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box


def cut_member(members, through, branch, rows=()):
    nodes = find_nodes(members, {through: 1, branch: 2}, rows).nodes
    member = members[branch]
    return with_nodes(member, nodes_of_member(nodes, branch, member.length))


@pytest.fixture(scope="module")
def twisted():
    members = twisted_pair()
    plates, findings = split_plates(cut_member(members, "M1", "M2"), {})
    assert not findings
    return members, plates


def test_plates_are_interrupted_over_the_through_member(twisted):
    _, plates = twisted
    marks = [plate.mark for plate in plates]
    assert marks == [f"M2-{letter}{n}" for letter in "TBLR" for n in (1, 2)]
    assert all(
        [c is not None for c in p.cuts] == [p.mark[-1] == "2", p.mark[-1] == "1"] for p in plates
    )


def test_every_end_lies_on_the_true_face_less_the_gap(twisted):
    """On a grid twice as fine as any the cut was made from, all three surfaces of all plates."""
    members, plates = twisted
    faces = outer_faces(members["M1"], 12000.0, 14500.0)
    w = np.linspace(0.0, 1.0, 67)
    worst = 0.0
    for plate in plates:
        for end, cut in enumerate(plate.cuts):
            if cut is None:
                continue
            face = faces.names.index("left" if end else "right")
            for level in ("outer", "mid", "inner"):
                value = getattr(plate.uncut, level)(cut.at(level, w))
                points = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
                worst = max(worst, np.abs(faces.distance(face, points)[0] - 3.0).max())
    assert worst < 1e-6


def test_no_point_of_a_branch_is_nearer_to_the_through_member_than_the_gap(twisted):
    members, plates = twisted
    faces = outer_faces(members["M1"], 11500.0, 15000.0)
    for plate in plates:
        rails = plate.rails.inner
        s = np.linspace(max(rails.start, 6500.0), min(rails.end, 9000.0), 60)
        for w in np.linspace(0.0, 1.0, 7):
            value = rails(s)
            points = value[:, :3] + w * (value[:, 3:] - value[:, :3])
            low = plate.cuts[0].at("inner", [w])[0] if plate.cuts[0] else -np.inf
            high = plate.cuts[1].at("inner", [w])[0] if plate.cuts[1] else np.inf
            own = points[(s >= low) & (s <= high)]
            assert faces.inside(own).min() > 3.0 - 1e-6


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_straight_branches_have_their_closed_forms(degrees):
    """Between plane faces a plate is a prism: volume is area times its mean length."""
    members = {
        m.name: m for m in (along_x(), at_angle(degrees, section=box("S", "box1", 500, 300, 12)))
    }
    plates, _ = split_plates(cut_member(members, "X", "Y"), {})
    sine, tangent = math.sin(math.radians(degrees)), math.tan(math.radians(degrees))
    # Distance of the cut from the node's centre at breadth y to the left of the branch.
    area = {"top": 276.0 * 12, "bottom": 276.0 * 12, "left": 500.0 * 12, "right": 500.0 * 12}
    middle = {"top": 0.0, "bottom": 0.0, "left": 144.0, "right": -144.0}
    for plate in plates:
        way = 1.0 if plate.mark.endswith("2") else -1.0
        length = 6000.0 - 203.0 / sine + way * middle[plate.face] / tangent
        assert plate.volume == pytest.approx(area[plate.face] * length, rel=1e-9)
        pattern = develop_plate(plate)
        half = 138.0 if plate.face in ("top", "bottom") else 0.0
        assert pattern.length == pytest.approx(length + half / tangent, abs=1e-6)
        assert pattern.area == pytest.approx(plate.volume / 12.0, rel=1e-9)


def test_edges_of_the_pattern_keep_their_length_to_the_cut(twisted):
    _, plates = twisted
    for plate in plates[:4]:
        pattern = develop_plate(plate)
        assert pattern.length_error_max < 0.05
        edges = [p for p in pattern.panels if p.what.startswith("edge")]
        assert max(abs(p.flat - p.arc) for p in edges) < 1e-6


def test_joints_in_a_node_fall_away_and_are_told():
    members = {m.name: m for m in (along_x(), at_angle(90))}
    member = cut_member(members, "X", "Y")
    plates, findings = split_plates(member, {"top": Joints((0.25, 0.5, 1.0))})
    assert [(p.mark, p.start, p.end) for p in plates if p.face == "top"] == [
        ("Y-T1", 0.0, pytest.approx(3000.0)),
        ("Y-T2", pytest.approx(3000.0), pytest.approx(5797.0)),
        ("Y-T3", pytest.approx(6203.0), pytest.approx(12000.0)),
    ]
    assert [(f.code, f.value) for f in findings] == [("joint-in-node", pytest.approx(6000.0))]


def test_an_end_on_branch_stops_at_the_face():
    members = {m.name: m for m in (along_x(), at_angle(90, ahead=0.0))}
    member = cut_member(members, "X", "Y")
    plates, _ = split_plates(member, {})
    assert {p.mark for p in plates} == {"Y-T1", "Y-B1", "Y-L1", "Y-R1"}
    assert all(p.end == pytest.approx(5797.0) for p in plates)


def test_a_stub_has_a_field_joint_at_its_length():
    members = {m.name: m for m in (along_x(), at_angle(90))}
    row = NodeInput("X", "Y", type="stub", stub_length=1000.0)
    plates, _ = split_plates(cut_member(members, "X", "Y", (row,)), {})
    top = [(p.start, p.end) for p in plates if p.face == "top"]
    ends = [0.0, 5000.0, 5797.0, 6203.0, 7000.0, 12000.0]
    assert np.allclose(top, [ends[:2], ends[1:3], ends[3:5], ends[4:]])


def test_a_wider_gap_only_moves_the_cut():
    members = {m.name: m for m in (along_x(), at_angle(60))}
    one = split_plates(cut_member(members, "X", "Y"), {})[0]
    two = split_plates(cut_member(members, "X", "Y", (NodeInput("X", "Y", gap=8.0),)), {})[0]
    for a, b in zip(one, two, strict=True):
        lost = 5.0 / math.sin(math.radians(60)) * (a.volume - b.volume > 0)
        assert a.volume - b.volume == pytest.approx(lost * a.thickness * _width(a), rel=1e-6)


def _width(plate):
    value = plate.rails.mid(np.array([plate.rails.mid.start]))[0]
    return np.linalg.norm(value[3:] - value[:3])


def test_a_branch_is_delivered_in_pieces_between_nodes_and_stubs():
    members = {m.name: m for m in (along_x(), at_angle(90))}
    row = NodeInput("X", "Y", type="stub", stub_length=1000.0)
    member, findings = with_pieces(cut_member(members, "X", "Y", (row,)), ())
    assert not findings
    spans = [(piece.start, piece.end) for piece in member.pieces]
    assert np.allclose(spans, [(0, 5000), (5000, 5797), (6203, 7000), (7000, 12000)])
    plates, _ = split_plates(member, {})
    assert {p.mark: p.piece for p in plates if p.face == "top"} == {
        f"Y-T{k}": k for k in (1, 2, 3, 4)
    }
    assert with_pieces(members["X"], ())[0].pieces[0].end == pytest.approx(12000.0)


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_what_a_node_takes_is_not_painted(degrees):
    members = {m.name: m for m in (along_x(), at_angle(degrees))}
    geometry = MemberGeometry(cut_member(members, "X", "Y"), PLANE, FrameInput("fixed"), ())
    object.__setattr__(geometry, "_made_from", f"test {id(geometry)}")
    # Around the box, on both sides of the node, as on the axis: what is lost left is won right.
    length = 12000.0 - 2 * 203.0 / math.sin(math.radians(degrees))
    assert painted_area(geometry) == pytest.approx(2 * (600 + 400) * length, rel=1e-9)
