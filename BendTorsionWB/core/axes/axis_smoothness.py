# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curvature along an axis before and after refinement, as data to plot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.curve import Curve
from ..geometry.curve_edit import arc_length, parameters_at
from .axis import Axis


@dataclass(frozen=True, eq=False)
class Smoothness:
    """Arc length (m,) mm and curvature (m,) 1/mm: before, along the curve through the points as
    given; after, along the axis. polygon: at the inner given points, that of the circle through
    each and its two neighbours. Arc lengths before and polygon are of the curve as given."""

    before: np.ndarray
    before_curvature: np.ndarray
    after: np.ndarray
    after_curvature: np.ndarray
    polygon: np.ndarray
    polygon_curvature: np.ndarray


def smoothness(axis: Axis, samples: int = 401) -> Smoothness:
    """Curvature along an axis before and after it was pulled and refined; in the direction of the
    axis, the parts before its ends were moved included in `before`."""
    after = np.linspace(0.0, axis.length, samples)
    s, points = np.zeros(0), np.zeros((0, 3))
    before, bends = after, None
    if axis.through is not None:
        arc = arc_length(axis.through)
        before = np.linspace(0.0, float(arc(np.array([arc.end]))[0, 0]), samples)
        bends = _curvature(axis.through, parameters_at(axis.through, before))
        points = axis.given
    if len(points) > 2:
        s, polygon = _polygon(points, axis.through)
    else:
        polygon = np.zeros(0)
    own = np.linalg.norm(axis.curvature(after), axis=1)
    return Smoothness(before, own if bends is None else bends, after, own, s, polygon)


def _curvature(curve: Curve, u: np.ndarray) -> np.ndarray:
    _, first, second = curve.evaluate(u, 2)
    return np.linalg.norm(np.cross(first, second), axis=1) / np.linalg.norm(first, axis=1) ** 3


def _polygon(points: np.ndarray, through: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Arc lengths on `through` nearest to the inner points, rising, and circle curvatures there."""
    a, b = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    c = points[2:] - points[:-2]
    sides = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1) * np.linalg.norm(c, axis=1)
    curvature = 2.0 * np.linalg.norm(np.cross(a, b), axis=1) / sides
    u = np.linspace(*through.domain, 2001)
    gap = np.linalg.norm(through.evaluate(u)[0][None] - points[1:-1, None], axis=2)
    arc = arc_length(through)
    s = arc(u[np.argmin(gap, axis=1)])[:, 0]
    order = np.argsort(s)
    return s[order], curvature[order]
