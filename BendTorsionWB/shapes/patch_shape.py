# SPDX-License-Identifier: LGPL-2.1-or-later
"""NURBS patches of the core as Part faces."""

from __future__ import annotations

from collections.abc import Sequence

import FreeCAD
import numpy as np
import Part

from ..core.geometry.nurbs import NurbsPatch


def faces_of_patches(patches: Sequence[NurbsPatch]) -> Part.Compound:
    """The whole patches as one compound of faces; their trim is left out."""
    return Part.Compound([_face(patch) for patch in patches])


def _face(patch: NurbsPatch) -> Part.Face:
    weights = np.ones(patch.poles.shape[:2]) if patch.weights is None else patch.weights
    knots = [np.unique(given, return_counts=True) for given in (patch.knots_u, patch.knots_v)]
    surface = Part.BSplineSurface()
    surface.buildFromPolesMultsKnots(
        [[FreeCAD.Vector(*pole) for pole in row] for row in patch.poles.tolist()],
        *([int(m) for m in multiplicities] for _, multiplicities in knots),
        *(values.tolist() for values, _ in knots),
        False,
        False,
        patch.degree_u,
        patch.degree_v,
        weights.tolist(),
    )
    return surface.toShape()
