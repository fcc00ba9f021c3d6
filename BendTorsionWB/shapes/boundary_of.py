# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a Part solid to its boundary as plain values."""

from __future__ import annotations

import FreeCAD  # noqa: F401  (Part needs it loaded first)
import numpy as np
import Part

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.solids.boundary import (
    Boundary,
    Circle,
    Cylinder,
    Edge,
    Face,
    Line,
    Plane,
    Spline,
    SplineSurface,
)


def boundary_of(solid: Part.Solid, name: str) -> Boundary:
    """The boundary of a solid of one shell; raises BendTorsionError for several shells."""
    if len(solid.Shells) != 1:
        raise BendTorsionError(
            error(
                "solid-shells",
                name,
                "the solid has not one shell",
                "export it after mending the plate",
                value=len(solid.Shells),
                limit=1,
            )
        )
    vertices, edges = _Numbered(), _Numbered()
    points, curves, faces = [], [], []

    def vertex(shape) -> int:
        k, new = vertices.number(shape)
        if new:
            points.append(tuple(shape.Point))
        return k

    def edge(shape) -> int:
        k, new = edges.number(shape)
        if new:
            forward = shape if shape.Orientation == "Forward" else shape.reversed()
            ends = forward.firstVertex(), forward.lastVertex()
            curves.append(Edge(vertex(ends[0]), vertex(ends[1]), _curve(forward), True))
        return k

    for shape in solid.Shells[0].Faces:
        # Wires of a reversed face come reversed edge by edge, but not in their order.
        natural = shape if shape.Orientation == "Forward" else shape.reversed()
        wires = natural.Wires
        if len(wires) > 1:
            outer = natural.OuterWire
            wires = [outer, *(wire for wire in wires if not wire.isSame(outer))]
        loops = tuple(
            tuple((edge(e), e.Orientation == "Forward") for e in wire.OrderedEdges)
            for wire in wires
        )
        if natural is not shape:
            loops = tuple(tuple((e, not forth) for e, forth in loop[::-1]) for loop in loops)
        surface = _surface(shape)
        faces.append(Face(surface, _looks_along(shape, surface), loops))
    return Boundary(np.array(points), tuple(curves), tuple(faces))


class _Numbered:
    """Numbers shapes in the order met; one number whatever the orientation."""

    def __init__(self):
        self.known: dict[int, list] = {}
        self.count = 0

    def number(self, shape) -> tuple[int, bool]:
        bucket = self.known.setdefault(shape.hashCode(), [])
        for other, number in bucket:
            if other.isSame(shape):
                return number, False
        bucket.append((shape, self.count))
        self.count += 1
        return self.count - 1, True


def _curve(edge: Part.Edge) -> Line | Circle | Spline:
    curve = edge.Curve
    if isinstance(curve, Part.Line | Part.LineSegment):
        start, end = (np.array(tuple(v.Point)) for v in (edge.firstVertex(), edge.lastVertex()))
        return Line(start, (end - start) / np.linalg.norm(end - start))
    if isinstance(curve, Part.Circle | Part.ArcOfCircle):
        return Circle(
            *(np.array(tuple(v)) for v in (curve.Center, curve.Axis, curve.XAxis)), curve.Radius
        )
    spline = curve.toBSpline(edge.FirstParameter, edge.LastParameter)
    return Spline(
        spline.Degree,
        _points(spline.getPoles()),
        np.array(spline.getKnots()),
        tuple(spline.getMultiplicities()),
        np.array(spline.getWeights()) if spline.isRational() else None,
    )


def _surface(face: Part.Face) -> Plane | Cylinder | SplineSurface:
    surface = face.Surface
    if isinstance(surface, Part.Plane):
        # The parameter lines, since the kernel's planes may be left-handed.
        x, y = (np.array(tuple(v)) for v in surface.tangent(0.0, 0.0))
        return Plane(np.array(tuple(surface.Position)), np.cross(x, y), x)
    if isinstance(surface, Part.Cylinder):
        x = surface.value(0.0, 0.0) - surface.Center
        values = (surface.Center, surface.Axis, x / x.Length)
        return Cylinder(*(np.array(tuple(v)) for v in values), surface.Radius)
    if not isinstance(surface, Part.BSplineSurface):
        surface = surface.toBSpline()
    return SplineSurface(
        (surface.UDegree, surface.VDegree),
        np.array([_points(row) for row in surface.getPoles()]),
        (np.array(surface.getUKnots()), np.array(surface.getVKnots())),
        (tuple(surface.getUMultiplicities()), tuple(surface.getVMultiplicities())),
        np.array(surface.getWeights()) if surface.isURational() or surface.isVRational() else None,
    )


def _looks_along(face: Part.Face, surface: Plane | Cylinder | SplineSurface) -> bool:
    """True when the face looks to the side of the surface's normal."""
    if isinstance(surface, SplineSurface):
        return face.Orientation == "Forward"
    low_u, high_u, low_v, high_v = face.ParameterRange
    u, v = 0.5 * (low_u + high_u), 0.5 * (low_v + high_v)
    normal = np.array(tuple(face.normalAt(u, v)))
    if isinstance(surface, Plane):
        return bool(normal @ surface.normal > 0.0)
    out = np.array(tuple(face.valueAt(u, v))) - surface.origin
    return bool(normal @ (out - (out @ surface.axis) * surface.axis) > 0.0)


def _points(poles) -> np.ndarray:
    return np.array([tuple(pole) for pole in poles])
