# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part faces and edges as exact core surfaces and curves."""

from __future__ import annotations

import math
from dataclasses import replace

import FreeCAD  # noqa: F401  Part crashes the interpreter when it is loaded before FreeCAD
import numpy as np
import Part

from ..core.axes.axis_check import check_curve
from ..core.finding import BendTorsionError, error
from ..core.geometry.curve import Curve
from ..core.geometry.curve_edit import joined, turned
from ..core.geometry.nurbs import NurbsPatch
from ..core.geometry.patch_split import smooth_patches
from ..core.geometry.patch_trim import Trim
from ..core.geometry.patches import CREASE, PatchSurface

# Ends of edges that meet in a chain, mm.
CHAIN_GAP = 1e-3
# A face's range this near to its surface's, relative, is the whole range.
_RANGE = 1e-9
# Wires this near to the border of the u, v rectangle, relative, run along it.
_ALONG_BORDER = 1e-6
# Polylines of wires keep this near to them, mm; and have no more points than this per edge.
_WIRE_SAG = 0.002
_MOST_WIRE_POINTS = 2049
SMALLEST_FACE = 1.0
"""mm2."""


def surface_from_part(shape: Part.Shape, object: str = "surface") -> PatchSurface:
    """All faces of a shape as one surface, exactly, oriented by `PatchSurface`'s rule.

    Each face is exact over its whole u, v rectangle; its wires tell what lies outside it. Faces
    are cut at creases inside them. object: name used in findings. Raises BendTorsionError for a
    shape without faces.
    """
    if shape is None or shape.isNull() or not shape.Faces:
        raise BendTorsionError(
            error("no-face", object, "the shape has no faces", "choose a face, shell or solid")
        )
    patches = [patch_from_face(face, object, f"Face{k + 1}") for k, face in enumerate(shape.Faces)]
    return PatchSurface(tuple(part for patch in patches for part in smooth_patches(patch, CREASE)))


def patch_from_face(face: Part.Face, object: str = "surface", position: str = "") -> NurbsPatch:
    """One face as a patch over its u, v range, non-periodic, sense by the face's orientation."""
    try:
        converted = face.toNurbs().Faces[0]
        surface = converted.Surface
        u0, u1, v0, v1 = converted.ParameterRange
        if not all(map(math.isfinite, (u0, u1, v0, v1))) or max(map(abs, (u0, u1, v0, v1))) > 1e99:
            raise ValueError("the face is unbounded")
        # Open CASCADE 7.8 reads a whole sphere from IGES as a half circle.
        if not face.Area >= SMALLEST_FACE:
            raise ValueError(f"its area is {face.Area:.3g} mm2, less than {SMALLEST_FACE:g}")
        wanted = np.array([[u0, u1], [v0, v1]])
        bounds = np.reshape(surface.bounds(), (2, 2))
        extent = np.ptp(bounds, axis=1)[:, None]
        # Ends within rounding of the surface's own would be refused by `segment`.
        wanted = np.where(np.abs(wanted - bounds) <= _RANGE * extent, bounds, wanted)
        full = np.ptp(wanted, axis=1) >= (1 - _RANGE) * extent[:, 0]
        wanted[full] = bounds[full]
        if not full.all():
            surface.segment(*wanted.ravel())
        surface.setUNotPeriodic()
        surface.setVNotPeriodic()
        poles = np.array([[tuple(p) for p in row] for row in surface.getPoles()], float)
        weights = np.array(surface.getWeights(), float)
    except (Part.OCCError, RuntimeError, ValueError, AttributeError, IndexError) as problem:
        raise BendTorsionError(
            error(
                "face-conversion",
                object,
                f"the face is no usable surface: {problem}",
                "rebuild the face or choose another",
                position=position,
            )
        ) from problem
    patch = NurbsPatch(
        surface.UDegree,
        surface.VDegree,
        np.repeat(surface.getUKnots(), surface.getUMultiplicities()).astype(float),
        np.repeat(surface.getVKnots(), surface.getVMultiplicities()).astype(float),
        poles,
        None if np.ptp(weights) == 0 else weights,
        -1 if converted.Orientation == "Reversed" else 1,
    )
    return replace(patch, trim=_trim(converted, patch))


def _trim(face: Part.Face, patch: NurbsPatch) -> Trim | None:
    """The wires of a face in its u, v; None when they run round the whole rectangle."""
    lines, done = [], []
    for edge in face.Edges:
        if any(edge.isSame(other) for other in done):
            continue
        done.append(edge)
        index = 0
        # A seam has two curves in u, v, and both bound the rectangle.
        while (found := edge.curveOnSurface(index)) is not None:
            lines.append(_polyline(patch, found[0], found[-2], found[-1]))
            index += 1
    low, high = patch.domain.T
    near = _ALONG_BORDER * (high - low)
    along = [
        any(
            np.ptp(line[:, k]) <= near[k]
            and min(abs(line[0, k] - end[k]) for end in (low, high)) <= near[k]
            for k in (0, 1)
        )
        for line in lines
    ]
    return None if all(along) else Trim(tuple(lines))


def _polyline(patch: NurbsPatch, curve, first: float, last: float) -> np.ndarray:
    """Points (m, 2) on a curve in u, v, as many as keep its chords on the surface near to it."""
    count = 17
    while True:
        points = [curve.value(t) for t in np.linspace(first, last, 2 * count - 1)]
        line = np.array([(point.x, point.y) for point in points])
        middle = 0.5 * (line[:-1:2] + line[2::2])
        exact = patch.evaluate(line[1::2, 0], line[1::2, 1])[0]
        sag = np.linalg.norm(patch.evaluate(middle[:, 0], middle[:, 1])[0] - exact, axis=1).max()
        if sag <= _WIRE_SAG or 2 * count - 1 >= _MOST_WIRE_POINTS:
            return line
        count = 2 * count - 1


def curve_from_part(shape: Part.Shape, object: str = "axis") -> Curve:
    """An edge, a wire or a compound of edges that form one open or closed chain, exactly.

    The direction is that of the edge, or of the chain as Part sorts it. Several edges give one
    curve of their highest degree with a full knot at each joint; its parameter is about arc
    length. Raises BendTorsionError for no edges, several chains or a branch.
    """
    if shape is None or shape.isNull() or not shape.Edges:
        raise BendTorsionError(
            error("no-edge", object, "the shape has no edges", "choose an edge or a wire")
        )
    edges = [edge for edge in shape.Edges if not edge.Degenerated]
    if len(edges) == 1:
        return _core_curve(_spline(edges[0], object, "Edge1"), object, "Edge1")
    chains = Part.sortEdges(edges)
    if len(chains) != 1:
        raise BendTorsionError(
            error(
                "edge-chain",
                object,
                f"the edges form {len(chains)} chains, not one",
                "select single edges, or edges that meet end to end",
                value=len(chains),
                limit=1,
            )
        )
    splines = [_spline(edge, object, f"Edge{k + 1}") for k, edge in enumerate(chains[0])]
    degree = max(spline.Degree for spline in splines)
    for spline in splines:
        spline.increaseDegree(degree)
    curves = [_core_curve(spline, object, f"Edge{k + 1}") for k, spline in enumerate(splines)]
    return joined(_oriented(curves, object), [spline.length() for spline in splines])


def _spline(edge: Part.Edge, object: str, position: str) -> Part.BSplineCurve:
    """The edge's own piece of its curve, in the edge's direction, not periodic."""
    try:
        converted = edge.toNurbs().Edges[0]
        spline = converted.Curve
        if not isinstance(spline, Part.BSplineCurve):
            spline = spline.toBSpline(*converted.ParameterRange)
        first, last = converted.ParameterRange
        low, high = spline.FirstParameter, spline.LastParameter
        if abs(first - low) > 1e-12 * (high - low) or abs(last - high) > 1e-12 * (high - low):
            spline.segment(first, last)
        if spline.isPeriodic():
            spline.setNotPeriodic()
    except (Part.OCCError, RuntimeError, ValueError, AttributeError, IndexError) as problem:
        raise BendTorsionError(
            error(
                "edge-conversion",
                object,
                f"the edge is no usable curve: {problem}",
                "rebuild the edge or choose another",
                position=position,
            )
        ) from problem
    if edge.Orientation == "Reversed":
        spline.reverse()
    return spline


def _core_curve(spline: Part.BSplineCurve, object: str, position: str) -> Curve:
    weights = np.array(spline.getWeights(), float)
    curve = Curve(
        spline.Degree,
        np.repeat(spline.getKnots(), spline.getMultiplicities()).astype(float),
        np.array([tuple(pole) for pole in spline.getPoles()], float),
        None if np.ptp(weights) == 0 else weights,
    )
    check_curve(object, curve, position)
    return curve


def _oriented(curves: list[Curve], object: str) -> list[Curve]:
    """Curves in turn, each turned so that it starts where the one before ends."""
    start, end = curves[0].poles[0], curves[0].poles[-1]
    ends = curves[1].poles[[0, -1]]
    first_is_back = (
        np.linalg.norm(ends - end, axis=1).min() > np.linalg.norm(ends - start, axis=1).min()
    )
    chain = [turned(curves[0]) if first_is_back else curves[0]]
    for k, curve in enumerate(curves[1:], start=2):
        gaps = np.linalg.norm(curve.poles[[0, -1]] - chain[-1].poles[-1], axis=1)
        if gaps.min() > CHAIN_GAP:
            raise BendTorsionError(
                error(
                    "edge-chain",
                    object,
                    "the edges do not meet end to end",
                    "close the gap or select single edges",
                    position=f"Edge{k}",
                    value=float(gaps.min()),
                    limit=CHAIN_GAP,
                    unit="mm",
                )
            )
        chain.append(turned(curve) if gaps[1] < gaps[0] else curve)
    return chain
