# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a picked shape gives an axis: an exact curve, ordered points, or loose segments."""

from __future__ import annotations

import FreeCAD  # noqa: F401  Part crashes the interpreter when it is loaded before FreeCAD
import numpy as np
import Part

from ..core.finding import BendTorsionError, error
from ..core.geometry.curve import Curve
from ..core.geometry.curve_edit import polyline_vertices
from . import from_part

USES = ("automatic", "curve", "points")
"""automatic: straight pieces are points to fit through, everything else is an exact curve."""


def source_fields(shape: Part.Shape, use: str = "automatic", object: str = "axis") -> dict:
    """The fields of an AxisInput that a shape stands for: `curve`, `points` or `segments`.

    Vertices without edges are points; straight edges (Draft wires, sketches, DXF polylines) are
    polylines, several of them segments in any order. `points` takes the ends and knots of curved
    edges too. Raises BendTorsionError for a shape without edges or vertices.
    """
    if shape is None or shape.isNull() or not (shape.Edges or shape.Vertexes):
        raise BendTorsionError(
            error(
                "no-edge",
                object,
                "the shape has no edges and no points",
                "choose an edge, a wire or points",
            )
        )
    if not shape.Edges:
        return {"points": np.array([tuple(vertex.Point) for vertex in shape.Vertexes])}
    if use == "curve":
        return {"curve": from_part.curve_from_part(shape, object)}
    edges = [edge for edge in shape.Edges if not edge.Degenerated]
    curves = [from_part.curve_from_part(edge, object) for edge in edges]
    lines = [_vertices(curve) for curve in curves]
    bare = len(lines) == 1 and lines[0] is not None and len(lines[0]) == 2
    if use == "automatic" and (bare or any(line is None for line in lines)):
        return {"curve": from_part.curve_from_part(shape, object)}
    lines = [
        curve.evaluate(curve.breaks)[0] if line is None else line
        for curve, line in zip(curves, lines, strict=True)
    ]
    return {"segments": tuple(lines)}


def _vertices(curve: Curve) -> np.ndarray | None:
    """Vertices of a polyline or a straight edge, None for a curved one."""
    vertices = polyline_vertices(curve, np.pi)
    if vertices is not None:
        return vertices
    ends = curve.poles[[0, -1]]
    run = ends[1] - ends[0]
    away = np.linalg.norm(np.cross(curve.poles - ends[0], run), axis=1)
    return ends if (away <= 1e-9 * max((run * run).sum(), 1e-300)).all() else None
