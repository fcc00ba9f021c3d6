# SPDX-License-Identifier: LGPL-2.1-or-later
"""What nodes add: steps and angles of flanges, and diaphragms inside the through member."""

import math

import FreeCAD  # noqa: F401 - Part needs it loaded first
import numpy as np
import pytest
from curved_members import ELLIPSOID
from meeting_members import along_x, at_angle, straight, twisted_pair

from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.detailing import (
    MemberGeometry,
    PlatesInput,
    noded,
    plates_of,
    torsion_error,
)
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry import arc_contour
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.nodes.node_faces import outer_faces
from BendTorsionWB.core.nodes.node_input import NodeInput, NodeRules
from BendTorsionWB.core.nodes.node_members import nodes_of_member, with_nodes
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.shapes import cut_solid
from BendTorsionWB.shapes.flat_solid import flat_solid

LOW = box("L", "box1", 300, 250, 12)


def node_of(members, rows=(), rules=None):
    (node,) = find_nodes(members, {"X": 1, "M1": 1}, rows, rules or NodeRules()).nodes
    return node


def built(members, name, nodes, joints):
    """The plates of a member, with joints before and behind the node on all faces."""
    geometry = MemberGeometry(members[name], ELLIPSOID, FrameInput(), ())
    object.__setattr__(geometry, "_made_from", f"test {id(geometry)}")
    given = nodes_of_member(nodes, name, members[name].length)
    faces = ("top", "bottom", "left", "right")
    return plates_of(
        noded(geometry, given), PlatesInput(dict.fromkeys(faces, Joints(joints, "mm")))
    )


@pytest.fixture(scope="module")
def twisted():
    """A twisted box that a lower twisted one crosses, with all diaphragms."""
    members = twisted_pair(second=[Segment(box("B", "box1", 500, 450, 14))])
    row = NodeInput("M1", "M2", diaphragms="flanges and webs")
    nodes = find_nodes(members, {}, (row,)).nodes
    through = built(members, "M1", nodes, (12600.0, 13750.0))
    return members, nodes, through, built(members, "M2", nodes, (7000.0, 8400.0))


@pytest.mark.parametrize(("lift", "roll"), [(0.0, 0.0), (1.5, 0.0), (-0.8, 0.004)])
def test_steps_and_angles_of_straight_members_are_the_lift_and_the_roll(lift, roll):
    """A branch at right angles, lifted and turned about its own axis."""
    members = {m.name: m for m in (along_x(), at_angle(90, z=lift))}
    members["Y"] = rolled(members["Y"], roll)
    (branch,) = node_of(members).branches
    for step in branch.steps:
        # y of the branch points to -x: its left edge is at x = -200.
        side = 1.0 if step.edge == "left" else -1.0
        height = 300.0 if step.face == "top" else -300.0
        corner = lift + height * math.cos(roll) + side * 200.0 * math.sin(roll)
        outward = 1.0 if step.face == "top" else -1.0
        assert step.step == pytest.approx(outward * corner - 300.0, abs=1e-9)
        assert step.angle == pytest.approx(abs(roll), abs=1e-7)
        assert step.in_line and step.through_face == step.face
    assert len(branch.steps) == 8


def rolled(member, roll):
    from dataclasses import replace

    from BendTorsionWB.core.axes.frames import frames_of

    frames = frames_of(member.frames.axis, None, FrameInput("fixed", roll=roll))
    return replace(member, frames=frames)


def test_steps_beyond_the_rules_are_told_and_lower_branches_are_none():
    members = {m.name: m for m in (along_x(), at_angle(90, z=2.5))}
    findings = find_nodes(members, {"X": 1}).findings
    assert [(f.code, f.value, f.limit) for f in findings] == [
        ("node-step", pytest.approx(2.5), 2.0)
    ]
    members["Y"] = at_angle(90, section=LOW)
    assert not find_nodes(members, {"X": 1}).findings


def test_the_concert_hall_s_steps_are_of_the_size_expected():
    """A common surface normal does not make flanges flush: the surface bends between them."""
    (node,) = find_nodes(twisted_pair(), {"M1": 1}).nodes
    steps = [abs(s.step) for s in node.branches[0].steps]
    assert 0.5 < max(steps) < 4.0


def test_diaphragms_of_a_straight_crossing_have_their_closed_form():
    members = {m.name: m for m in (along_x(), at_angle(90, section=LOW))}
    (branch,) = node_of(members).branches
    assert len(branch.diaphragms) == 2
    for flat in branch.diaphragms:
        # Between webs 400 - 2 x 16 apart, with gaps of 2; as broad as the flange between its webs.
        assert flat.area == pytest.approx((400 - 32 - 4) * (250 - 24), rel=1e-9)
        assert abs(abs(flat.frame[2, 3]) - 144.0) < 1e-9
        assert flat.thickness == 12.0 and flat.s == pytest.approx(6000.0)
    webs = NodeInput("X", "Y", diaphragms="flanges and webs")
    (branch,) = node_of(members, (webs,)).branches
    assert len(branch.diaphragms) == 4
    for flat in branch.diaphragms[2:]:
        side = (400 - 36) * (600 - 36)
        # Between flanges 276 apart, 50 clear of both, in whole 10 mm.
        hole = math.pi * (0.5 * 170) ** 2
        assert flat.area == pytest.approx(side - 4 * 0.5 * 30**2 - hole, rel=1e-6)
        assert abs(abs(flat.frame[0, 3]) - 119.0) < 1e-9


def test_none_and_flanges_in_line_ask_for_no_diaphragm():
    members = {m.name: m for m in (along_x(), at_angle(90))}
    assert node_of(members).branches[0].diaphragms == ()
    members["Y"] = at_angle(90, section=LOW)
    assert node_of(members, (NodeInput("X", "Y", diaphragms="none"),)).branches[0].diaphragms == ()


def test_a_diaphragm_without_room_to_weld_is_told():
    members = {m.name: m for m in (along_x(), at_angle(90, section=box("N", "box1", 500, 250, 12)))}
    findings = find_nodes(members, {"X": 1}).findings
    assert {f.code for f in findings} == {"node-diaphragm-access"}
    # 300 - 250 of height, less the flange of the through member.
    assert findings[0].value == pytest.approx(300 - 16 - 250, abs=1e-6)
    assert findings[0].object == "X" and findings[0].mend


def test_an_end_on_branch_has_diaphragms_from_wall_to_wall():
    members = {m.name: m for m in (along_x(), at_angle(90, section=LOW, ahead=0.0))}
    (branch,) = node_of(members).branches
    assert [round(f.area) for f in branch.diaphragms] == [364 * 226] * 2


def test_diaphragms_are_numbered_plates_of_the_through_member(twisted):
    _, nodes, through, branch = twisted
    assert [flat.mark for flat in through.flat] == ["M1-D1", "M1-D2", "M1-D3", "M1-D4"]
    assert not branch.flat
    assert all(arc_contour.area(flat.outline) > 0 for flat in through.flat)


def test_no_solids_of_a_twisted_node_share_anything(twisted):
    """The kernel's own common volumes of all plates and diaphragms about the node."""
    _, _, through, branch = twisted
    near = [i for i in through.plates if i.plate.start == 12600.0]
    own = [solid for solid, _ in cut_solid.plate_solids(near)]
    ends = cut_solid.plate_solids([i for i in branch.plates if i.plate.is_cut])
    assert all(ok for _, ok in ends) and len(own) == 4 and len(ends) == 8
    flats = [flat_solid(flat) for flat in through.flat]
    for index, flat in enumerate(flats):
        assert flat.isValid()
        for other in (*own, *flats[index + 1 :]):
            assert flat.common(other).Volume < 1e-3
    for end, _ in ends:
        for other in (*own, *flats):
            assert end.common(other).Volume < 1e-3


def test_flange_diaphragms_lie_in_the_planes_of_the_branch_s_flanges(twisted):
    members, nodes, through, branch = twisted
    rails = {item.plate.mark: item.plate for item in branch.plates}
    for flat, face in zip(through.flat, "TB", strict=False):
        origin, normal = flat.frame[:3, 3], flat.frame[:3, 2]
        for number, end in ((2, 1), (3, 0)):
            plate = rails[f"M2-{face}{number}"]
            value = plate.uncut.mid(plate.cuts[end].at("mid", np.array([0.5])))[0]
            middle = 0.5 * (value[:3] + value[3:])
            assert abs((middle - origin) @ normal) < 0.5


@pytest.fixture(scope="module")
def blended():
    """A twisted pair, as it is and blended at its node."""
    members = twisted_pair()
    plain = find_nodes(members, {"M1": 1}).nodes
    nodes = find_nodes(members, {}, (NodeInput("M1", "M2", blend=True),)).nodes
    given = nodes_of_member(nodes, "M2", members["M2"].length)
    return members, plain, nodes, with_nodes(members["M2"], given)


def test_a_blend_lands_flush(blended):
    _, plain, nodes, _ = blended
    before = [abs(s.step) for s in plain[0].branches[0].steps if s.face == "top"]
    after = [abs(s.step) for s in nodes[0].branches[0].steps if s.face == "top"]
    assert min(before) > 2.0 and max(after) < 1e-6


def test_a_blend_changes_its_last_2h_only_and_starts_smoothly(blended):
    members, _, nodes, member = blended
    one, two = nodes[0].branches[0].blends
    assert one.full - one.start == pytest.approx(2 * 800.0)
    ends = np.array([one.start - 10.0, two.start + 10.0])
    before, after = members["M2"].corners(0.0, 15000.0), member.corners(0.0, 15000.0)
    assert np.abs(before(ends) - after(ends)).max() < 1e-7
    # No slope and no curvature at its start: a tenth in, a hundredth of it is there.
    near = np.array([one.start + 0.1 * 1600.0])
    assert np.abs(before(near) - after(near)).max() < 0.01 * 3.0
    there = np.array([one.full])
    assert np.abs(before(there) - after(there)).max() > 1.5


def test_patterns_of_a_blended_branch_stay_exact(blended):
    *_, member = blended
    plates, _ = split_plates(member, {"top": Joints((6000.0,), "mm")})
    for plate in plates[:3]:
        pattern = develop_plate(plate)
        edges = [p for p in pattern.panels if p.what.startswith("edge")]
        assert max(abs(p.flat - p.arc) for p in edges) < 1e-6
        assert pattern.length_error_max < 0.03


def test_the_cut_of_a_blended_branch_is_on_the_true_face(blended):
    members, _, _, member = blended
    plates, _ = split_plates(member, {})
    faces = outer_faces(members["M1"], 12000.0, 14500.0)
    w = np.linspace(0.0, 1.0, 21)
    for plate in plates:
        end = 0 if plate.cuts[0] else 1
        value = plate.uncut.mid(plate.cuts[end].at("mid", w))
        points = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
        face = faces.names.index("left" if end else "right")
        assert np.abs(faces.distance(face, points)[0] - 3.0).max() < 1e-6


def test_a_blended_member_is_where_its_roll_says(blended):
    """The reported torsion error counts the blend's roll as asked for."""
    members, *_, member = blended
    assert torsion_error(MemberGeometry(member, ELLIPSOID, FrameInput(), ())) < 1e-5


def test_a_lower_branch_in_line_with_nothing_is_told_and_left():
    members = {m.name: m for m in (along_x(), at_angle(90, section=LOW))}
    result = find_nodes(members, {}, (NodeInput("X", "Y", blend=True),))
    assert [f.code for f in result.findings] == ["node-blend-nothing"]
    assert result.nodes[0].branches[0].blends == ()


def test_a_blend_without_room_is_an_error():
    members = {m.name: m for m in (along_x(), at_angle(90, z=1.0, back=1300.0))}
    nodes = find_nodes(members, {}, (NodeInput("X", "Y", blend=True),)).nodes
    with pytest.raises(BendTorsionError) as raised:
        with_nodes(members["Y"], nodes_of_member(nodes, "Y", members["Y"].length))
    (finding,) = raised.value.findings
    assert finding.code == "node-blend-too-long"
    assert (finding.value, finding.limit) == (pytest.approx(1200.0), pytest.approx(1097.0))


@pytest.fixture(scope="module")
def strut():
    """A strut from above, askew, that lands on the top and the left face of a twisted box."""
    members = twisted_pair()
    at = members["M1"].frames.at(np.array([13000.0]))
    end = at.origin[0]
    start = end + 2500.0 * at.z[0] + 2300.0 * at.y[0] + 400.0 * at.x[0]
    members = {
        "M1": members["M1"],
        "Y": straight("Y", start, end, section=box("S", "box1", 300, 250, 12)),
    }
    row = NodeInput("M1", "Y", diaphragms="none")
    nodes = find_nodes(members, {}, (row,)).nodes
    return members, nodes, built(members, "Y", nodes, ())


def test_an_end_on_an_arris_has_a_corner_on_it(strut):
    members, nodes, plates = strut
    (side,) = nodes[0].branches[0].sides
    assert set(side.faces) == {"top", "left"}
    faces = outer_faces(members["M1"], 11000.0, 15000.0)
    top, left = (faces.names.index(name) for name in ("top", "left"))
    corners = 0
    w = np.linspace(0.0, 1.0, 101)
    for item in plates.plates:
        cut = item.plate.cuts[1]
        for level in ("outer", "mid", "inner"):
            curve = getattr(cut, level)
            at = np.sort(np.concatenate([w, curve.breaks]))
            value = getattr(item.plate.uncut, level)(cut.at(level, at))
            points = value[:, :3] + at[:, None] * (value[:, 3:] - value[:, :3])
            both = np.stack([faces.distance(k, points)[0] - 3.0 for k in (top, left)])
            assert np.abs(both.max(axis=0)).max() < 1e-6
            one_after_the_other = len(np.unique(np.argmax(both, axis=0))) == 2
            # Where it passes from face to face both are at the gap, and the curve has a break.
            touches = np.abs(both).max(axis=0).min() < 1e-6
            assert touches == one_after_the_other
            corners += one_after_the_other
    assert corners >= 6


def test_solids_and_patterns_of_an_end_on_an_arris(strut):
    members, nodes, plates = strut
    solids = cut_solid.plate_solids(plates.plates)
    for item, (solid, sound) in zip(plates.plates, solids, strict=True):
        assert sound and solid.Volume == pytest.approx(item.plate.volume, rel=1e-5)
        pattern = develop_plate(item.plate)
        assert pattern.area == pytest.approx(item.plate.volume / 12.0, rel=0.01)
