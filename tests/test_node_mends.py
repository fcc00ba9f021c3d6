# SPDX-License-Identifier: LGPL-2.1-or-later
"""What cannot be a node is named once, with place, value, limit and mend, and its mend, applied
with the figures it gives, makes a node."""

import re

import numpy as np
import pytest
from meeting_members import along_x, at_angle, found, straight, twisted_pair

from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.nodes.node_members import nodes_of_member, with_nodes
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box


def refused(result, code):
    """The one error, complete, naming both members, that leaves no node but a row with its code."""
    (finding,) = [f for f in result.findings if f.severity == "error"]
    assert finding.code == code and not result.nodes
    assert len(finding.objects) == 2 and finding.position and finding.mend
    assert finding.value is not None and finding.limit is not None and finding.unit
    (record,) = result.unmade
    assert record.status == code and {record.through, record.other} == set(finding.objects)
    return finding


def sound(result):
    assert not [f.line() for f in result.findings if f.severity == "error"]
    assert result.nodes and not result.unmade
    return result


def ways_out(finding):
    ways = {
        way: int(length)
        for length, way in re.findall(r"by at least (\d+) mm towards the (start|end)", finding.mend)
    }
    assert ways, finding.mend
    return ways


WIDE, MIDDLE, SLIM = (box("A", "box1", 600, b, 16) for b in (400, 380, 340))


@pytest.mark.parametrize("way", ["start", "end"])
@pytest.mark.parametrize(
    ("varying", "degrees", "cut", "slope", "narrow"),
    [
        ("X", 90.0, 5950.0, 10.0, SLIM),
        ("X", 60.0, 5700.0, 10.0, SLIM),
        ("X", 50.0, 6150.0, 5.0, MIDDLE),
        ("Y", 90.0, 5600.0, 10.0, SLIM),
        ("Y", 60.0, 6100.0, 5.0, SLIM),
        ("X", 90.0, 6050.0, 0.0, SLIM),
    ],
)
def test_a_node_in_a_transition_tells_both_ways_out(varying, degrees, cut, slope, narrow, way):
    """Each applied leaves no error, and three millimetres less leave it: the seat grows or shrinks
    with the section that comes to lie at the node."""

    def members(cut):
        segments = [Segment(WIDE), Segment(narrow, cut, slope)]
        low = [Segment(box("L", "box1", 560, 400, 16))]
        x = along_x(segments=segments if varying == "X" else None)
        return {"X": x, "Y": at_angle(degrees, segments=segments if varying == "Y" else low)}

    def made(cut):
        return found(*members(cut).values())

    finding = refused(made(cut), "node-in-transition")
    assert finding.position.endswith(f"of {varying}") and finding.value > finding.limit == 0.0
    ways = ways_out(finding)
    assert set(ways) == {"start", "end"}
    sign = -1.0 if way == "start" else 1.0
    result = sound(made(cut + sign * ways[way]))
    # Both members have plates then.
    for name, member in members(cut + sign * ways[way]).items():
        given = nodes_of_member(result.nodes, name, member.length)
        assert split_plates(with_nodes(member, given), {})[0]
    short = made(cut + sign * (ways[way] - 3.0))
    assert "node-in-transition" in {f.code for f in short.findings}


@pytest.mark.parametrize("way", ["start", "end"])
def test_a_twisted_node_in_a_transition_tells_both_ways_out(way):
    """Between twisted members, aligned with their tops to the surface's axis."""

    def made(cut):
        first = [
            Segment(box("A", "box1", 800, 800, 20), align="top"),
            Segment(box("B", "box1", 700, 640, 20), cut, 3.0, align="top"),
        ]
        second = [Segment(box("C", "box1", 600, 400, 14), align="top")]
        return find_nodes(twisted_pair(first, second), {"M1": 1, "M2": 2})

    finding = refused(made(13000.0), "node-in-transition")
    sign = -1.0 if way == "start" else 1.0
    sound(made(13000.0 + sign * ways_out(finding)[way]))


def test_a_transition_with_no_room_on_one_side_tells_the_other():
    segments = [Segment(WIDE), Segment(MIDDLE, 300.0, 5.0), Segment(SLIM, 420.0, 5.0)]
    x = straight("X", (-450, 0, 0), (9000, 0, 0), segments=segments)
    result = found(x, at_angle(90, section=box("L", "box1", 500, 300, 12)))
    findings = [f for f in result.findings if f.code == "node-in-transition"]
    assert findings and all("towards the" in f.mend or "no room" in f.mend for f in findings)
    assert len({f.position for f in findings}) == len(findings)


@pytest.mark.parametrize(("ahead", "degrees"), [(500.4, 90.0), (380.0, 60.0)])
def test_a_branch_just_beyond_a_node_is_made_as_much_longer_as_told(ahead, degrees):
    finding = refused(found(along_x(), at_angle(degrees, ahead=ahead)), "node-at-end")
    longer = int(re.search(r"it (\d+) mm longer at its end", finding.mend).group(1))
    sound(found(along_x(), at_angle(degrees, ahead=ahead + longer)))
    sound(found(along_x(), at_angle(degrees, ahead=0.0)))


def test_a_branch_that_does_not_reach_all_round_is_made_longer():
    ahead = -203.0 / np.sin(np.radians(60))
    finding = refused(found(along_x(), at_angle(60, ahead=ahead)), "node-at-end")
    longer = int(re.search(r"Y (\d+) mm longer at its end", finding.mend).group(1))
    sound(found(along_x(), at_angle(60, ahead=ahead + longer)))


def test_a_through_member_that_ends_at_the_node_is_made_longer():
    def made(start):
        return found(straight("X", (start, 0, 0), (9000, 0, 0)), at_angle(90, ahead=0.0))

    finding = refused(made(-229.6), "node-at-end")
    longer = int(re.search(r"X (\d+) mm longer at its start", finding.mend).group(1))
    sound(made(-229.6 - longer))


def test_near_parallel_members_are_turned():
    finding = refused(found(along_x(), at_angle(24.3)), "node-angle")
    assert (finding.value, finding.limit) == pytest.approx((24.3, 30.0)) and finding.unit == "deg"
    turn = float(re.search(r"by ([\d.]+) degrees", finding.mend).group(1))
    sound(found(along_x(), at_angle(24.3 + turn)))


def test_a_branch_wider_than_its_face_is_made_lower():
    def made(height):
        return found(along_x(), at_angle(90, section=box("W", "box1", height, 400, 16)))

    result = made(640.0)
    finding = refused(result, "branch-wider-than-face")
    less = int(re.search(r"by (\d+) mm or more on that side", finding.mend).group(1))
    sound(made(640.0 - 2 * less))


def test_three_members_through_a_place_are_named_and_one_ends_there():
    def made(**last):
        members = (along_x(), at_angle(60, "Y"), at_angle(120, "Z", **last))
        return found(*members, ranks={"X": 1, "Y": 2, "Z": 3})

    result = made()
    (finding,) = [f for f in result.findings if f.severity == "error"]
    assert finding.code == "node-three-through" and finding.objects == ("Y", "Z")
    assert (finding.value, finding.limit) == (3, 2) and "of X" in finding.position
    assert {own.status for own in result.unmade} == {"node-three-through"}
    small = box("S", "box1", 300, 200, 10)
    members = (
        along_x(),
        at_angle(60, "Y", section=small),
        at_angle(120, "Z", ahead=0.0, section=small),
    )
    sound(found(*members, ranks={"X": 1, "Y": 2, "Z": 3}))


def test_members_that_nearly_touch_are_moved_either_way():
    (finding,) = found(along_x(), at_angle(90, z=610.0)).findings
    assert finding.code == "members-nearly-touch" and finding.objects == ("X", "Y")
    assert (finding.value, finding.limit, finding.unit) == (pytest.approx(10.0), 20.0, "mm")
    nearer, away = map(float, re.findall(r"([\d.]+) mm or more", finding.mend))
    assert not found(along_x(), at_angle(90, z=610.0 + away)).findings
    met = found(along_x(), at_angle(90, z=610.0 - nearer - 1.0))
    assert {f.code for f in met.findings} == {"branch-wider-than-face"}


@pytest.mark.parametrize(("gap", "limit"), [(-5.0, 0.0), (60.0, 20.0), (1e9, 20.0)])
def test_a_root_gap_nobody_can_weld_is_refused(gap, limit):
    def made(gap):
        return found(along_x(), at_angle(90), rows=(NodeInput("X", "Y", gap=gap),))

    finding = refused(made(gap), "node-gap")
    assert (finding.value, finding.limit, finding.unit) == (gap, limit, "mm")
    sound(made(float(re.search(r"write ([\d.]+)", finding.mend).group(1))))


def test_the_widest_gap_follows_the_thinner_plate():
    thin = box("T", "box1", 500, 300, 6)
    rows = (NodeInput("X", "Y", gap=13.0),)
    finding = refused(found(along_x(), at_angle(90, section=thin), rows=rows), "node-gap")
    assert finding.limit == 12.0 and "plates of 6 mm" in finding.message


@pytest.mark.parametrize("ahead", [6000.0, 0.0])
@pytest.mark.parametrize("length", [150.0, 5950.0])
def test_stubs_too_short_or_too_long_for_the_branch_are_refused(ahead, length):
    def made(length):
        row = NodeInput("X", "Y", type="stub", stub_length=length)
        return found(along_x(), at_angle(90, ahead=ahead), rows=(row,))

    (finding,) = made(length).findings
    assert finding.code == ("node-stub-short" if length < 1000 else "node-stub-long")
    assert finding.value == length and not made(length).nodes
    told = float(re.search(r"the stub (\d+) mm", finding.mend).group(1))
    assert told == finding.limit
    sound(made(told))


def test_a_stub_does_not_reach_into_the_next_node():
    members = (along_x(), along_x("W", y=2000.0), at_angle(90, back=3000.0))
    row = NodeInput("X", "Y", type="stub", stub_length=1750.0)
    result = found(*members, ranks={"X": 1, "W": 2, "Y": 3}, rows=(row,))
    (finding,) = result.findings
    # The face at 2000 - 200, less the gap of 3 and room of 100, in tens.
    assert (finding.code, finding.limit) == ("node-stub-long", 1690.0)


def test_stubs_are_counted_from_the_through_member_s_axis():
    """Whether the branch's axis ends on it, short of it, or passes above it at an angle."""
    low = box("L", "box1", 300, 250, 12)
    for end, z, degrees in ((0.0, 0.0, 90.0), (-150.0, 0.0, 90.0), (-150.0, 100.0, 60.0)):
        row = NodeInput("X", "Y", type="stub", stub_length=900.0)
        branch = at_angle(degrees, ahead=end, z=z, section=low)
        result = sound(found(along_x(), branch, rows=(row,)))
        (place,) = nodes_of_member(result.nodes, "Y", branch.length).stubs
        point = branch.frames.axis.position(np.array([place]))[0]
        way = branch.frames.axis.tangent(np.array([place]))[0]
        node = result.nodes[0].point
        # Along the branch, from the point of the through member's axis the node is at.
        assert float(((node - point) * way).sum()) == pytest.approx(900.0, abs=1e-6)


def test_both_of_two_that_pass_through_a_third_leave_no_node_though_not_at_one_place():
    """Their axes meet that of X 50 mm apart: neither is a node, as both have the error."""
    result = found(along_x(), at_angle(45, "Y", x=25.0), at_angle(135, "Z", x=-25.0))
    (finding,) = [f for f in result.findings if f.severity == "error"]
    assert finding.code == "node-three-through" and finding.objects == ("Y", "Z")
    assert not result.nodes
    assert {own.status for own in result.unmade} == {"node-three-through"}
