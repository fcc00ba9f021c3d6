# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat patterns as Part wires and faces."""

from __future__ import annotations

from collections.abc import Sequence

import FreeCAD
import numpy as np
import Part
from scipy.interpolate import make_interp_spline

from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.lofting import DevelopedPlate
from BendTorsionWB.shapes.curve_shape import edge

ROW_GAP = 200.0
"""Clear distance between patterns laid out one above the other, mm."""


def wire(plate: DevelopedPlate, shift: tuple[float, float] = (0.0, 0.0)) -> Part.Wire:
    """The closed outline of a pattern in the XY plane: an edge per smooth run."""
    return Part.Wire([_edge(run + np.asarray(shift)) for run in plate.outline])


def laid_out(plates: Sequence[DevelopedPlate]) -> Part.Compound:
    """The patterns of all plates as faces with their openings, in order, each row starting above
    the one before."""
    faces, height = [], 0.0
    for plate in plates:
        shift = np.array([0.0, height])
        inner = [Part.Wire([_edge(run + shift) for run in hole.runs]) for hole in plate.holes]
        outer = wire(plate, (0.0, height))
        faces.append(Part.makeFace([outer, *inner], "Part::FaceMakerBullseye"))
        height += plate.width + ROW_GAP
    return Part.Compound(faces)


def _edge(run: np.ndarray) -> Part.Edge:
    points = np.column_stack([run, np.zeros(len(run))])
    if len(run) == 2:
        return Part.LineSegment(*(FreeCAD.Vector(*p) for p in points)).toShape()
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(run, axis=0), axis=1))])
    spline = make_interp_spline(length, points, k=min(3, len(run) - 1))
    spline.c[[0, -1]] = points[[0, -1]]
    return edge(Curve(spline.k, spline.t, spline.c))
