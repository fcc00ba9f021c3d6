# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces of flat patterns, written as text, beside those the kernel makes of the same runs."""

import math

import FreeCAD
import numpy as np
import Part
import pytest

from BendTorsionWB.shapes.pattern_shape import laid_out, plane_faces

CORNERS = np.array([[0.0, 0.0], [4000.0, 0.0], [4100.0, 800.0], [50.0, 820.0]])


def straight(corners):
    return [np.array([a, b]) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]


def bowed(corners, height=30.0):
    """Runs between corners that bow outwards along sines, the ends straight."""
    runs = straight(corners)
    for k in (0, 2):
        (a, b), t = runs[k], np.linspace(0.0, 1.0, 90)
        across = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        rise = np.sin(math.pi * t)[:, None] * height * across
        runs[k] = a + t[:, None] * (b - a) + rise
        runs[k][[0, -1]] = a, b
    return runs


def circle(x, y, radius):
    angle = np.linspace(0.0, 2.0 * math.pi, 65)
    points = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
    points[-1] = points[0]
    return [points]


def backwards(runs):
    return [run[::-1] for run in reversed(runs)]


def of_the_kernel(loops):
    """The face FreeCAD makes of interpolating splines and segments through the same points."""
    wires = []
    for runs in loops:
        edges = []
        for run in runs:
            points = [FreeCAD.Vector(x, y, 0.0) for x, y in run]
            if len(points) == 2:
                edges.append(Part.LineSegment(*points).toShape())
            else:
                spline = Part.BSplineCurve()
                spline.interpolate(points)
                edges.append(spline.toShape())
        wires.append(Part.Wire(edges))
    return Part.makeFace(wires, "Part::FaceMakerBullseye")


@pytest.mark.parametrize("turn", [list, backwards])
@pytest.mark.parametrize("hole", [None, straight(CORNERS * 0.1 + 300.0), circle(1500, 400, 60)])
def test_a_face_is_that_of_the_kernel_whichever_way_its_loops_run(hole, turn):
    loops = [turn(bowed(CORNERS)), *([] if hole is None else [hole])]
    (face,) = plane_faces([loops]).Faces
    other = of_the_kernel(loops)
    assert face.isValid() and face.Area == pytest.approx(other.Area, rel=1e-6)
    assert face.OuterWire.Length == pytest.approx(other.OuterWire.Length, rel=1e-6)
    assert [len(wire.Edges) for wire in face.Wires] == [len(runs) for runs in loops]
    assert tuple(face.normalAt(0, 0)) == (0.0, 0.0, 1.0)
    assert face.isInside(FreeCAD.Vector(2000, 20, 0), 1e-6, True)
    if hole is not None:
        middle = np.concatenate(hole)[:-1].mean(axis=0)
        assert not face.isInside(FreeCAD.Vector(*middle, 0), 1e-6, True)


def test_edges_run_through_the_points_of_their_runs_in_their_order():
    runs = bowed(CORNERS)
    (face,) = plane_faces([[runs]]).Faces
    for edge, run in zip(face.Edges, runs, strict=True):
        for x, y in run[::7]:
            point = Part.Vertex(FreeCAD.Vector(x, y, 0.0))
            assert point.distToShape(edge)[0] < 1e-9
        assert np.allclose(edge.firstVertex(True).Point[:2], run[0], atol=1e-12)


def test_runs_that_end_a_little_apart_make_a_valid_face():
    runs = straight(CORNERS)
    runs[1][0] += 5e-7
    (face,) = plane_faces([[runs]]).Faces
    assert face.isValid() and len(face.Vertexes) == 4


def test_many_faces_from_one_text_are_in_their_order_and_none_is_a_compound_of_nothing():
    faces = plane_faces([[straight(CORNERS + 1e4 * k)] for k in range(5)])
    assert [round(face.BoundBox.XMin) for face in faces.Faces] == [10000 * k for k in range(5)]
    assert laid_out([]).ShapeType == "Compound" and not laid_out([]).Faces
