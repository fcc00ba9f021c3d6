# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms at nodes: manholes clear of what lands beside them, those of branches on an arris."""

import math

import FreeCAD  # noqa: F401 - Part needs it loaded first
import numpy as np
import pytest
from meeting_members import along_x, at_angle, straight, twisted_pair
from test_node_parts import built

from BendTorsionWB.core.geometry import arc_contour
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.nodes.node_diaphragms import FLANGES, manhole_sizes
from BendTorsionWB.core.nodes.node_faces import outer_faces
from BendTorsionWB.core.nodes.node_input import NodeInput, NodeRules
from BendTorsionWB.core.nodes.node_manhole import manhole
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.shapes import cut_solid
from BendTorsionWB.shapes.flat_solid import flat_solid

BOTH = "flanges and webs"


def node_of(members, row, rules=None):
    found = find_nodes(members, {}, (row,), rules or NodeRules())
    assert not [f.line() for f in found.findings if f.severity == "error"]
    (node,) = found.nodes
    return node, found.findings


def face(flat):
    return flat.role.split()[0]


def hole_to_solid(web, flange):
    """Distance, mm, of the rim of a manhole from another diaphragm, by points."""
    a, b = web.holes[0][:, :2]
    turn = np.linspace(0.0, 2.0 * math.pi, 721)
    radius = 0.5 * np.hypot(*(b - a))
    rim = 0.5 * (a + b) + radius * np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([web.in_model(rim, z) for z in (-0.5 * web.thickness, 0.0)])
    away = points - flange.frame[:3, 3]
    return float(np.abs((away * flange.frame[:3, 2]).sum(axis=1)).min()) - 0.5 * flange.thickness


def hole_to_edge(flat):
    a, b = flat.holes[0][:, :2]
    corners = flat.outline[:, :2]
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.hypot(*along.T)[:, None]
    away = 0.5 * (a + b) - corners
    return float(
        (along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]).min() - 0.5 * np.hypot(*(b - a))
    )


@pytest.mark.parametrize("align", ["centre", "top", "bottom"])
@pytest.mark.parametrize("sizes", [(800, 800, 600, 400), (1500, 1400, 1100, 590)])
def test_manholes_keep_clear_of_the_flanges_that_land_beside_them(align, sizes):
    """Twisted boxes, the lower branch aligned so that its flange lands across the middle."""
    big, wide, low, narrow = sizes
    members = twisted_pair(
        first=[Segment(box("A", "box1", big, wide, 20), align=align)],
        second=[Segment(box("B", "box1", low, narrow, 14), align=align)],
    )
    rules = NodeRules(flange_step=1e9, flange_angle=math.pi, overhang=2.0)
    node, findings = node_of(members, NodeInput("M1", "M2", diaphragms=BOTH), rules)
    flats = node.branches[0].diaphragms
    webs = [flat for flat in flats if face(flat) not in FLANGES]
    flanges = [flat for flat in flats if face(flat) in FLANGES]
    assert len(webs) == 2 and flanges
    for web in webs:
        assert hole_to_edge(web) > rules.manhole_edge - 2e-3
        assert min(hole_to_solid(web, flange) for flange in flanges) > rules.manhole_edge - 0.5
    least = min(manhole_sizes(flats))
    told = [f for f in findings if f.code == "node-manhole"]
    assert bool(told) == (least < rules.manhole)
    for finding in told:
        assert (finding.value, finding.limit, finding.unit) == (least, 400.0, "mm")
        assert finding.object == "M1" and "N1, s = " in finding.position and finding.mend
    assert not told or sizes[0] < 1000


def test_the_mend_of_a_manhole_that_is_no_access_gives_access():
    """A small box has none; with the clear size its mend asks for it has."""
    small = {m.name: m for m in (along_x(), at_angle(90, section=box("L", "box1", 300, 250, 12)))}
    _, findings = node_of(small, NodeInput("X", "Y", diaphragms=BOTH))
    (finding,) = [f for f in findings if f.code == "node-manhole"]
    assert (finding.value, finding.limit) == (170.0, 400.0)
    assert "leave 500 mm clear" in finding.mend
    _, findings = node_of(small, NodeInput("X", "Y", diaphragms="flanges"))
    assert not findings
    # 500 between the flanges of the branch, and between the walls less the gaps of 2.
    big = {
        "X": along_x(section=box("A", "box1", 900, 536, 16)),
        "Y": at_angle(90, section=box("L", "box1", 524, 420, 12)),
    }
    node, findings = node_of(big, NodeInput("X", "Y", diaphragms=BOTH))
    assert "node-manhole" not in {f.code for f in findings}
    assert manhole_sizes(node.branches[0].diaphragms) == (400.0, 400.0)


def test_a_manhole_is_the_largest_that_fits_beside_a_line():
    """In a rectangle 1000 x 600 a line at a height of 150 leaves a band of 450 - 6 above it."""
    ring = np.array([[0.0, 0.0], [1000.0, 0.0], [1000.0, 600.0], [0.0, 600.0]])
    up = np.array([0.0, 1.0])
    centre, diameter = manhole(ring, [(np.array([0.0, 150.0]), up, 6.0)], 50.0, 1e9)
    assert diameter == 340.0
    assert centre[0] == pytest.approx(500.0)
    # As near to the middle as may be: just above the line.
    assert centre[1] == pytest.approx(156.0 + 50.0 + 170.0, abs=2e-3)
    assert manhole(ring, [], 50.0, 400.0)[1] == 400.0
    assert manhole(ring, [], 50.0, 400.0)[0] == pytest.approx([500.0, 300.0])
    assert manhole(ring, [(np.array([0.0, 300.0]), up, 200.0)], 50.0, 400.0) is None


@pytest.mark.parametrize(
    ("start", "asked", "count"),
    [
        ((0, 3000, 3000), "flanges", 2),
        ((0, 3000, 3000), BOTH, 4),
        ((900, 2600, 2900), "flanges", 2),
        ((-700, 3000, 2400), BOTH, 4),
    ],
)
def test_branches_on_an_arris_go_on_inside(start, asked, count):
    """In the planes of their plates, within the walls, as far from each as the gap, and sound."""
    strut = straight("Y", start, (0, 0, 0), section=box("S", "box1", 220, 240, 10))
    members = {"X": along_x(), "Y": strut}
    node, _ = node_of(members, NodeInput("X", "Y", diaphragms=asked))
    (branch,) = node.branches
    assert branch.sides[0].on_arris
    assert len(branch.diaphragms) == count
    faces = outer_faces(members["X"], 3000.0, 9000.0)
    tangent = strut.frames.axis.tangent(np.array([branch.s]))[0]
    for flat in branch.diaphragms:
        ring = arc_contour.runs(flat.outline)
        points = np.concatenate(ring)
        for z in (-0.5, 0.5):
            space = flat.in_model(points, z * flat.thickness)
            depth = faces.inside(space)
            # 16 of wall and a gap of 2, kept over the thickness and reached somewhere.
            assert depth.max() < -18.0 + 1e-6
        assert max(
            faces.inside(flat.in_model(points, z * flat.thickness)).max() for z in (-0.5, 0.5)
        ) == pytest.approx(-18.0, abs=0.05)
        # In the plane of the plate it continues.
        assert abs(float((flat.frame[:3, 2] * tangent).sum())) < 1e-9
        assert len({name for name, _ in flat.welded}) >= 2
        solid = flat_solid(flat)
        assert solid.isValid() and solid.Volume == pytest.approx(flat.volume, rel=1e-9)
    solids = [flat_solid(flat) for flat in branch.diaphragms]
    for k, one in enumerate(solids):
        for two in solids[k + 1 :]:
            assert one.common(two).Volume < 1e-3


def test_a_strut_on_an_arris_of_a_twisted_box_goes_on_inside():
    """Askew, with the webs along the box: all four plates, each 2 mm off the twisted walls it ends
    at, measured by the kernel on the walls' solids."""
    members = twisted_pair()
    at = members["M1"].frames.at(np.array([13000.0]))
    end = at.origin[0]
    start = end + 2500.0 * at.z[0] + 2300.0 * at.y[0] + 400.0 * at.x[0]
    strut = straight("Y", start, end, section=box("S", "box1", 300, 250, 12))
    members = {"M1": members["M1"], "Y": strut}
    node, _ = node_of(members, NodeInput("M1", "Y", diaphragms=BOTH))
    through = built(members, "M1", (node,), (12200.0, 13900.0))
    near = [item for item in through.plates if item.plate.start == 12200.0]
    solids = {
        item.plate.face: solid
        for item, (solid, _) in zip(near, cut_solid.plate_solids(near), strict=True)
    }
    flats = through.flat
    assert [face(flat) for flat in flats] == ["top", "bottom", "left", "right"]
    # Flanges across the box stop at the webs, which run along it from wall to wall.
    assert {name for name, _ in flats[0].welded} >= {"M1-D3", "M1-D4"}
    assert len(flats[2].welded) == len(flats[3].welded) == 2
    for flat in flats:
        own = flat_solid(flat)
        assert own.isValid()
        for name, _ in flat.welded:
            if name in solids:
                assert own.distToShape(solids[name])[0] == pytest.approx(2.0, abs=0.01)
        for wall in solids.values():
            assert own.common(wall).Volume < 1e-3
    for k, one in enumerate(flats):
        for two in flats[k + 1 :]:
            assert flat_solid(one).common(flat_solid(two)).Volume < 1e-3


def test_an_arris_plate_too_flat_to_a_wall_is_told():
    """A strut rolled so that its flange all but runs along a wall is not continued there."""
    strut = straight("Y", (200, 3000, 900), (0, 0, 150), section=box("S", "box1", 200, 200, 10))
    found = find_nodes({"X": along_x(), "Y": strut}, {"X": 1})
    (finding,) = [f for f in found.findings if f.code == "node-diaphragm-arris"]
    # The flange rises by 750 on 3000 across, to the top wall.
    assert finding.value == pytest.approx(math.degrees(math.atan2(750.0, 3000.0)), abs=0.1)
    assert (finding.limit, finding.unit) == (pytest.approx(30.0), "deg") and finding.mend
    assert "top of Y" in finding.position
    (node,) = found.nodes
    assert [face(flat) for flat in node.branches[0].diaphragms] == ["bottom"]
