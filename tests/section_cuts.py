# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates cut by section planes, and how deep the cuts overlap, without any section law."""

import numpy as np


def sections_at(built, plates, s):
    """Per place the quadrilaterals (k, 4, 2) of the plates there, in section coordinates."""
    at = built.frames.at(s)
    found = [[] for _ in s]
    for plate in plates:
        mine = np.flatnonzero((s > plate.start) & (s < plate.end))
        if not len(mine):
            continue
        origin, x = at.origin[mine], at.x[mine]
        corners = []
        for rail, half in (
            (plate.rails.outer, slice(0, 3)),
            (plate.rails.outer, slice(3, 6)),
            (plate.rails.inner, slice(3, 6)),
            (plate.rails.inner, slice(0, 3)),
        ):
            u = s[mine].copy()
            for _ in range(20):
                off = ((rail(u)[:, half] - origin) * x).sum(axis=1)
                speed = (rail.derivative(u)[:, half] * x).sum(axis=1)
                u = np.clip(u - off / speed, rail.start, rail.end)
            corners.append(rail(u)[:, half] - origin)
        ring = np.stack(corners, axis=1)
        plane = np.stack(
            [(ring * frame[mine][:, None]).sum(axis=2) for frame in (at.y, at.z)], axis=2
        )
        for i, own in zip(mine, plane, strict=True):
            found[i].append(own)
    return [np.array(rings) for rings in found]


def penetration(rings):
    """Largest depth, mm, by which two of convex quadrilaterals (k, 4, 2) overlap (separating
    axes); 0 or less when none do."""
    worst = -np.inf
    for i, one in enumerate(rings):
        for other in rings[:i]:
            gaps = []
            for ring in (one, other):
                edge = np.roll(ring, -1, axis=0) - ring
                normal = np.column_stack([edge[:, 1], -edge[:, 0]])
                normal /= np.linalg.norm(normal, axis=1, keepdims=True)
                a, b = one @ normal.T, other @ normal.T
                gaps.append(
                    np.maximum(b.min(axis=0) - a.max(axis=0), a.min(axis=0) - b.max(axis=0))
                )
            worst = max(worst, -float(np.max(gaps)))
    return worst
