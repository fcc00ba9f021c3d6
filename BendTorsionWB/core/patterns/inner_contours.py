# SPDX-License-Identifier: LGPL-2.1-or-later
"""Openings and marked lines of a pattern as lines and arcs, for the files machines read."""

from __future__ import annotations

import numpy as np

from ..geometry.arc_fit import FIT_TOLERANCE, fit_arcs, fit_outline
from ..lofting import DevelopedPlate, FlatHole, FlatMark


def hole_contour(hole: FlatHole, tolerance: float = FIT_TOLERANCE) -> np.ndarray:
    """(m, 3) closed arc polyline of an opening, counter-clockwise; a circle is two half circles."""
    if hole.circle is None:
        return fit_outline(hole.runs, tolerance, hole.label)
    u, v, diameter = hole.circle
    return np.array([[u + 0.5 * diameter, v, 1.0], [u - 0.5 * diameter, v, 1.0]])


def line_stroke(mark: FlatMark, tolerance: float = FIT_TOLERANCE) -> np.ndarray:
    """(m, 3) open arc polyline of a marked line; its last bulge is 0."""
    return fit_arcs(mark.flat, tolerance)


def text_field(plate: DevelopedPlate) -> tuple[np.ndarray, np.ndarray]:
    """Where a flat part has most room for its text: the left and the right side (2, 2), lower end
    first, of a rectangle over its breadth, below or above its openings."""
    corners = np.concatenate(plate.outline)
    (left, low), (right, high) = corners.min(axis=0), corners.max(axis=0)
    if plate.holes:
        holes = np.concatenate([run for hole in plate.holes for run in hole.runs])
        below, above = holes[:, 1].min() - low, high - holes[:, 1].max()
        if below >= above - 1.0:
            high = low + below
        else:
            low = high - above
    inset = 0.1 * (right - left)
    left, right = left + inset, right - inset
    return np.array([[left, low], [left, high]]), np.array([[right, low], [right, high]])
