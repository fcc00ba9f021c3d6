# SPDX-License-Identifier: LGPL-2.1-or-later
"""Manholes in diaphragms that close the box: as large as is wanted, clear of the diaphragm's edges
and of the lines other plates land on it along.

The lines divide the diaphragm into bands; a hole of radius r keeps clear where its centre lies in
the band with all its sides moved in by r and the ligament, which is a convex polygon.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.convex_polygon import clipped, nearest

STEP = 10.0
"""mm; diameters are whole steps."""
_HALVINGS = 30
_EXACT = 1e-3
"""mm; holes that just fit do."""


def manhole(
    outline: np.ndarray,
    lines: Sequence[tuple[np.ndarray, np.ndarray, float]],
    ligament: float,
    wanted: float,
) -> tuple[np.ndarray, float] | None:
    """Centre (2,) and diameter, mm, of the hole in a convex outline (n, 2), counter-clockwise: the
    wanted diameter, or the largest that leaves the ligament (mm) to every edge and line; where
    there is room in several bands that of the largest, as near to the middle as may be. None where
    less than a step is left.

    lines: point (2,), unit normal (2,) and half the thickness, mm, of what lands along each.
    """
    sides = _sides(outline)
    middle = outline.mean(axis=0)
    bands = [sides]
    for point, normal, half in lines:
        off = float((point * normal).sum())
        # Half-planes n · p <= d: this side of the line, and beyond it.
        both = [(normal, off - half), (-normal, -off - half)]
        bands = [[*band, half_plane] for band in bands for half_plane in both]
    best, room = None, 0.0
    for band in bands:
        radius = _largest(band, outline, ligament)
        if radius > room + 1e-6:
            best, room = band, radius
    diameter = STEP * np.floor((min(wanted, 2.0 * room) + _EXACT) / STEP)
    if best is None or diameter < STEP:
        return None
    centres = _moved_in(best, outline, 0.5 * diameter + ligament - _EXACT)
    return nearest(centres, middle), float(diameter)


def _sides(outline: np.ndarray) -> list[tuple[np.ndarray, float]]:
    along = np.roll(outline, -1, axis=0) - outline
    normals = np.stack([along[:, 1], -along[:, 0]], axis=1)
    normals /= np.sqrt((normals * normals).sum(axis=1))[:, None]
    return [(n, float((n * p).sum())) for n, p in zip(normals, outline, strict=True)]


def _moved_in(band, outline: np.ndarray, by: float) -> np.ndarray | None:
    ring = outline
    for normal, off in band:
        ring = clipped(ring, normal, off - by)
        if ring is None:
            return None
    return ring


def _largest(band, outline: np.ndarray, ligament: float) -> float:
    """The largest radius, mm, with room in a band, from below."""
    low, high = 0.0, float(np.ptp(outline, axis=0).max())
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if _moved_in(band, outline, middle + ligament) is None:
            high = middle
        else:
            low = middle
    return low
