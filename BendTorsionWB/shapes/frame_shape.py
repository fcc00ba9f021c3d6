# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that show an axis's control points, curvature and frames."""

from __future__ import annotations

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.axes.axis import Axis
from BendTorsionWB.core.axes.frames import Frames

STATIONS = 101
LONGEST_TOOTH = 0.08
"""A comb's longest tooth and a ribbon's width, as a part of the axis's length."""


def comb(axis: Axis, scale: float = 0.0) -> list[Part.Edge]:
    """The curvature comb: teeth against the curvature vector and the line through their tips.

    scale: mm² of tooth per 1/mm of curvature; 0 for one that suits the axis. A straight axis has
    no comb.
    """
    s = np.linspace(0.0, axis.length, STATIONS)
    feet, bend = axis.position(s), axis.curvature(s)
    largest = np.linalg.norm(bend, axis=1).max()
    if largest * axis.length < 1e-9:
        return []
    return _teeth(feet, feet - (scale or LONGEST_TOOTH * axis.length / largest) * bend)


def ribbon(frames: Frames, height: float = 0.0) -> list[Part.Edge]:
    """The frame ribbon: the z axis at even stations and the line through its ends; height in mm,
    0 for one that suits the axis."""
    at = frames.at(np.linspace(0.0, frames.axis.length, STATIONS))
    return _teeth(at.origin, at.origin + (height or LONGEST_TOOTH * frames.axis.length) * at.z)


def points(places: np.ndarray) -> list[Part.Vertex]:
    """Vertices at (n, 3)."""
    return [Part.Vertex(*map(float, place)) for place in places]


def _teeth(feet: np.ndarray, tips: np.ndarray) -> list[Part.Edge]:
    starts = [FreeCAD.Vector(*map(float, place)) for place in feet]
    ends = [FreeCAD.Vector(*map(float, place)) for place in tips]
    edges = [
        Part.makeLine(a, b)
        for a, b in zip(starts, ends, strict=True)
        if a.distanceToPoint(b) > 1e-6
    ]
    return [*edges, *Part.makePolygon(ends).Edges]
