# SPDX-License-Identifier: LGPL-2.1-or-later
"""Core curves and polylines as Part edges."""

from __future__ import annotations

from collections.abc import Sequence

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.geometry.curve import Curve


def edge(curve: Curve) -> Part.Edge:
    """The same NURBS curve as a Part edge."""
    knots, multiplicities = np.unique(curve.knots, return_counts=True)
    weights = np.ones(len(curve.poles)) if curve.weights is None else curve.weights
    spline = Part.BSplineCurve()
    spline.buildFromPolesMultsKnots(
        [FreeCAD.Vector(*pole) for pole in curve.poles],
        [int(m) for m in multiplicities],
        [float(knot) for knot in knots],
        False,
        curve.degree,
        [float(weight) for weight in weights],
    )
    return spline.toShape()


def polylines(lines: Sequence[np.ndarray]) -> Part.Compound:
    """Polylines (m, 3) as one edge each, by chord length."""
    edges = []
    for line in lines:
        line = np.asarray(line, float)
        steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        edges.append(edge(Curve(1, np.concatenate([[0.0], arc, arc[-1:]]), line)))
    return Part.Compound(edges)
