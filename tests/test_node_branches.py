# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several branches at one node that overlap: the later one ends on the earlier one as well."""

import math
from dataclasses import replace

import numpy as np
import pytest
from meeting_members import along_x, at_angle
from test_sheet_node import SMALL, X, at, straight

from BendTorsionWB.core import detailing
from BendTorsionWB.core.flattening.outline_sides import sides_of
from BendTorsionWB.core.nodes.node_input import NodeInput, NodeRules
from BendTorsionWB.core.nodes.node_jobs import jobs_with_nodes
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.plates.flat_room import separation
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.shapes import cut_solid
from BendTorsionWB.shapes.flat_solid import flat_solid

STRUT = box("S", "box1", 300, 260, 10)


def meeting(rows=(), ranks=None, **rules):
    """Two struts at 60 degrees either side that meet in one point of a straight member."""
    members = (
        along_x(),
        at_angle(120, "Y", ahead=0.0, section=STRUT),
        at_angle(60, "Z", ahead=0.0, section=STRUT),
    )
    ranks = ranks or {"X": 1, "Y": 2, "Z": 3}
    return find_nodes({m.name: m for m in members}, ranks, rows, NodeRules(**rules))


def branches(found):
    (node,) = found.nodes
    return {branch.member: branch for branch in node.branches}


def test_steps_are_to_the_faces_landed_on():
    """Z stands 7 lower than Y and ends on it with its inner web: flush or not there is told against
    Y; with X, 150 higher, nothing is in line."""
    low = box("D", "box1", 286, 260, 10)
    members = (
        along_x(),
        at_angle(120, "Y", ahead=0.0, section=STRUT),
        at_angle(60, "Z", ahead=0.0, section=low),
    )
    own = branches(find_nodes({m.name: m for m in members}, {"X": 1, "Y": 2, "Z": 3}))
    steps = {(s.face, s.edge): s for s in own["Z"].steps if s.face in ("top", "bottom")}
    inner = [step for step in steps.values() if step.on]
    assert {(s.through_face, s.on) for s in inner} == {("Y top", "Y"), ("Y bottom", "Y")}
    assert [s.step for s in inner] == pytest.approx([-7.0, -7.0])
    assert all(s.in_line for s in inner)
    outer = [step for step in steps.values() if not step.on]
    assert [s.step for s in outer] == pytest.approx([143.0 - 300.0] * 2)
    assert not any(s.in_line for s in outer)
    # As high as Y it is flush with it, and nothing is told.
    found = meeting()
    assert {f.code for f in found.findings} <= {"node-diaphragms-meet", "node-diaphragm-access"}
    steps = [s for s in branches(found)["Z"].steps if s.on and s.face in ("top", "bottom")]
    assert [s.step for s in steps] == pytest.approx([0.0, 0.0], abs=1e-9)
    # Beyond the rule it is told of the branch it lands on.
    told = find_nodes({m.name: m for m in members}, {"X": 1, "Y": 2, "Z": 3}).findings
    (finding,) = [f for f in told if f.code == "node-step"]
    assert "that of Y" in finding.message and finding.value == pytest.approx(7.0)


def test_the_later_branch_ends_on_the_earlier_one():
    own = branches(meeting())
    assert own["Y"].sides[0].faces == ("right",)
    assert set(own["Z"].sides[0].faces) == {"right", "Y left"}
    # On the face of X at -200 less the gap: the webs, 130 off the axis, and Y keeps its end.
    middle, half = 203.0 / math.sin(math.radians(60)), 130.0 / math.tan(math.radians(60))
    far = sorted(6000.0 - place for place in (own["Y"].sides[0].low, own["Y"].sides[0].high))
    assert far == pytest.approx([middle - half, middle + half])
    # The inner web of Z ends on the face of Y, 130 off its axis, less the gap.
    inner = (133.0 + 130.0 * math.cos(math.radians(60))) / math.sin(math.radians(60))
    assert inner > middle - half
    far = sorted(6000.0 - place for place in (own["Z"].sides[0].low, own["Z"].sides[0].high))
    assert far == pytest.approx([inner, middle + half])


def test_rows_come_before_ranks_and_equal_ranks_are_an_error():
    own = branches(meeting(rows=(NodeInput("Z", "Y"),)))
    assert own["Z"].sides[0].faces == ("right",)
    assert set(own["Y"].sides[0].faces) == {"right", "Z right"}
    found = meeting(ranks={"X": 1, "Y": 2, "Z": 2})
    errors = [f for f in found.findings if f.severity == "error"]
    assert [(f.code, f.object) for f in errors] == [("node-branches-overlap", "Y, Z")]
    finding = errors[0]
    assert finding.value > 20.0 and finding.limit == 0.0 and finding.unit == "mm"
    assert finding.position == "s = 6000 mm of X" and "rank" in finding.mend
    assert not found.nodes


def test_rows_in_a_circle_are_three_members_that_run_through():
    """Each of three struts at one place is to run through another of them."""
    members = (
        along_x(),
        at_angle(120, "Y", ahead=0.0, section=STRUT),
        at_angle(90, "V", ahead=0.0, section=STRUT),
        at_angle(60, "Z", ahead=0.0, section=STRUT),
    )
    rows = (NodeInput("Y", "V"), NodeInput("V", "Z"), NodeInput("Z", "Y"))
    found = find_nodes(
        {m.name: m for m in members}, {"X": 1}, rows, NodeRules(least_angle=math.radians(20))
    )
    (finding,) = [f for f in found.findings if f.severity == "error"]
    assert finding.code == "node-three-through" and set(finding.objects) == set("YVZ")


def test_a_branch_others_end_on_is_not_blended():
    found = meeting(rows=(NodeInput("X", "Y", blend=True), NodeInput("X", "Z")))
    assert ("node-blend-overlap", "Z, Y") in {(f.code, f.object) for f in found.findings}


def test_struts_at_too_small_an_angle_to_each_other_are_named():
    found = meeting(least_angle=math.radians(59.0))
    assert branches(found)
    found = meeting(least_angle=math.radians(59.9) + 0.01)
    errors = [f for f in found.findings if f.severity == "error"]
    assert {f.code for f in errors} == {"node-angle"}


@pytest.fixture(scope="module")
def built():
    # Z comes from above and is lower than Y.
    low = box("D", "box1", 180, 220, 10)
    members = [
        X,
        ("Y", at(-120, 2500), (0, 0, 0), SMALL),
        ("Z", (*at(-60, 2500)[:2], 400.0), (0, 0, 0), low),
    ]
    jobs = {member[0]: straight(*member) for member in members}
    made, found = jobs_with_nodes(jobs, {"X": 1, "Y": 2, "Z": 3}, (), NodeRules())
    assert not [f for f in found.findings if f.severity == "error"]
    return [detailing.detail(job) for job in made.values()]


def test_no_solids_of_the_node_intersect_and_volumes_are_the_kernel_s(built):
    solids = []
    for one in built:
        cut = cut_solid.plate_solids(one.plates.plates)
        for item, (solid, sound) in zip(one.plates.plates, cut, strict=True):
            assert sound and solid.Volume == pytest.approx(item.plate.net_volume, rel=1e-6)
            solids.append((item.plate.mark, solid))
        solids += [(flat.mark, flat_solid(flat)) for flat in one.plates.flat]
    for k, (mark, solid) in enumerate(solids):
        for other, beside in solids[k + 1 :]:
            if solid.BoundBox.intersect(beside.BoundBox):
                assert solid.common(beside).Volume < 1e-3, (mark, other)


def test_patterns_and_welds_follow_both_faces(built):
    record = built[2].record
    top = next(plate for plate in record.plates if plate.mark == "Z-T1")
    assert [(p.member, p.face) for p in top.ends[1]] == [("Y", "right"), ("X", "right")]
    welds = {w.mark: w for w in record.welds if w.kind == "node"}
    # Two welds at the end of each flange, one on each member.
    assert welds["Z-N1-T1.Y.right"].plates == ("Z-T1", "Y right")
    assert welds["Z-N1-T1.X.right"].plates == ("Z-T1", "X right")
    length = sum(w.length for w in welds.values() if w.plates[0] == "Z-T1")
    assert length == pytest.approx(top.lines[-1].length_3d, abs=0.01)
    # The pattern's end is of two runs with a corner between them, as long as the welds.
    runs = sides_of(top).end
    steps = [np.hypot(*np.diff(run, axis=0).T).sum() for run in runs]
    parts = [welds[f"Z-N1-T1.{name}.right"].length for name in ("Y", "X")]
    assert steps == pytest.approx(parts, abs=0.01)
    ways = [np.arctan2(*(run[-1] - run[0])) for run in runs]
    assert abs(ways[1] - ways[0]) > math.radians(30)
    bevels = [(b.start, b.end) for b in top.bevels if b.side == "end"]
    assert bevels[0][0] == 0.0 and bevels[0][1] == pytest.approx(parts[0])
    assert bevels[-1][1] == pytest.approx(length)


def test_separation_of_flat_parts_is_the_distance_of_boxes(built):
    flats = [flat for one in built for flat in one.plates.flat]
    assert len(flats) == 4
    solids = [flat_solid(flat) for flat in flats]
    for one, solid in zip(flats, solids, strict=True):
        for two, other in zip(flats, solids, strict=True):
            if one is two:
                continue
            apart = solid.distToShape(other)[0]
            assert 0.0 < separation(one, two) <= apart + 1e-6
    moved = replace(flats[0], frame=flats[0].frame @ _shift(0.0, 0.0, 50.0))
    assert separation(flats[0], moved) == pytest.approx(50.0 - flats[0].thickness)


def _shift(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix
