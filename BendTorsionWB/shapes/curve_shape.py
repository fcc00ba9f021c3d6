# SPDX-License-Identifier: LGPL-2.1-or-later
"""Core curves as Part edges."""

from __future__ import annotations

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.curve import Curve


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
