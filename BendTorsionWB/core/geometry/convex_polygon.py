# SPDX-License-Identifier: LGPL-2.1-or-later
"""Convex polygons cut by half-planes, each side with what made it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

LEAST_SIDE = 1e-6
"""mm; sides shorter than this are none."""


def clipped(ring: np.ndarray, normal: np.ndarray, off: float) -> np.ndarray | None:
    """What of a ring (n, 2) lies where normal · p <= off, or None (Sutherland, Hodgman: Reentrant
    polygon clipping, CACM 1974)."""
    points, _ = _cut(list(ring), [0] * len(ring), normal, off, 0)
    return np.array(points) if points else None


def bounded(lines: Sequence[np.ndarray]) -> tuple[np.ndarray, tuple[int, ...]] | None:
    """The polygon to the left of all directed lines (2, 2): its corners (m, 2), counter-clockwise,
    and which line the side from each corner lies on; None where there is none, or no end to it."""
    reach = 1e5 + 2.0 * max(float(np.abs(line).max()) for line in lines)
    points = [np.array(p) * reach for p in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))]
    made = [-1] * 4
    for k, (one, two) in enumerate(lines):
        along = (two - one) / np.sqrt(((two - one) ** 2).sum())
        normal = np.array([along[1], -along[0]])
        points, made = _cut(points, made, normal, float((normal * one).sum()), k)
        if not points:
            return None
    if -1 in made:
        return None
    ring = np.array(points)
    size = np.sqrt(((np.roll(ring, -1, axis=0) - ring) ** 2).sum(axis=1))
    kept = size > LEAST_SIDE
    if kept.sum() < 3:
        return None
    return ring[kept], tuple(k for k, keep in zip(made, kept, strict=True) if keep)


def _cut(points, made, normal, off, which):
    """The ring cut by a half-plane; made: what the side from each point was made by."""
    depth = [off - float((normal * point).sum()) for point in points]
    out, by = [], []
    for k, point in enumerate(points):
        following = (k + 1) % len(points)
        a, b = depth[k], depth[following]
        if a >= 0.0:
            out.append(point)
            by.append(made[k])
        if (a >= 0.0) != (b >= 0.0):
            out.append(point + (points[following] - point) * (a / (a - b)))
            # Leaving, the new side begins here; coming back, the old one goes on.
            by.append(which if a >= 0.0 else made[k])
    return (out, by) if len(out) > 2 else ([], [])


def nearest(ring: np.ndarray, point: np.ndarray) -> np.ndarray:
    """The point (2,) of a convex ring (n, 2), inside included, nearest to a point."""
    following = np.roll(ring, -1, axis=0)
    along = following - ring
    away = point - ring
    left = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    if (left >= 0.0).all():
        return point
    length2 = np.maximum((along * along).sum(axis=1), 1e-30)
    share = np.minimum(np.maximum((away * along).sum(axis=1) / length2, 0.0), 1.0)
    feet = ring + share[:, None] * along
    return feet[int(np.argmin(((feet - point) ** 2).sum(axis=1)))]
