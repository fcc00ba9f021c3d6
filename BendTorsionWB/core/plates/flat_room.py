# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far two flat parts lie apart: the widest gap between them along any separating axis."""

from __future__ import annotations

import numpy as np

from ..geometry import arc_contour
from ..geometry.vectors import crossed
from .flat_plate import FlatPlate


def separation(one: FlatPlate, two: FlatPlate) -> float:
    """Distance, mm, of the convex hulls of two flat parts, or less where an edge of one faces a
    corner of the other; negative by how far they overlap (Gottschalk, Lin, Manocha: OBBTree,
    SIGGRAPH 1996, separating axes, for prisms)."""
    points = [_corners(part) for part in (one, two)]
    sides = [
        np.diff(np.concatenate([p, p[:1]]), axis=0) for p in (a[: len(a) // 2] for a in points)
    ]
    normals = [part.frame[:3, 2] for part in (one, two)]
    axes = [normal[None] for normal in normals]
    axes += [
        crossed(side, np.broadcast_to(n, side.shape))
        for side, n in zip(sides, normals, strict=True)
    ]
    edges = [np.concatenate([side, n[None]]) for side, n in zip(sides, normals, strict=True)]
    first = np.repeat(edges[0], len(edges[1]), axis=0)
    axes.append(crossed(first, np.tile(edges[1], (len(edges[0]), 1))))
    axes = np.concatenate(axes)
    size = np.sqrt((axes * axes).sum(axis=1))
    scale = max(float(size.max()), 1.0)
    axes = axes[size > 1e-9 * scale] / size[size > 1e-9 * scale, None]
    low, high = [], []
    for own in points:
        along = (own[:, None, :] * axes[None]).sum(axis=2)
        low.append(along.min(axis=0))
        high.append(along.max(axis=0))
    return float(np.maximum(low[0] - high[1], low[1] - high[0]).max())


def _corners(part: FlatPlate) -> np.ndarray:
    """Points (2n, 3) of both sides of a part, its arcs by chords."""
    ring = np.concatenate([run[:-1] for run in arc_contour.runs(part.outline, 1.0)])
    half = 0.5 * part.thickness
    return np.concatenate([part.in_model(ring, -half), part.in_model(ring, half)])
