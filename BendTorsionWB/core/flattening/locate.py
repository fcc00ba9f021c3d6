# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a point of the flat pattern back to its place on the plate."""

from __future__ import annotations

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, error
from .development import ACROSS, Development

GRID = 100.0
MOST_STEPS = 30


def locate(development: Development, flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(s, w), each (n,), of points (n, 2) of the plane, by Newton from the nearest of a grid.

    Points just beside an edge are found at w outside 0 … 1. Raises BendTorsionError for points
    the pattern does not reach.
    """
    flat = np.asarray(flat, float)
    plane = development.plane
    count = max(33, int((plane.end - plane.start) / GRID))
    grid_s = np.repeat(np.linspace(plane.start, plane.end, count), len(ACROSS))
    grid_w = np.tile(ACROSS, count)
    grid = development.flat(grid_s, grid_w)
    nearest = np.argmin(((grid[None] - flat[:, None]) ** 2).sum(axis=2), axis=1)
    s, w = grid_s[nearest], grid_w[nearest]
    for _ in range(MOST_STEPS):
        gap = flat - development.flat(s, w)
        if np.abs(gap).max() < 1e-3 * tolerances.SEAM_LENGTH:
            break
        by_s, by_w = development.jacobian(s, w)
        area = by_s[:, 0] * by_w[:, 1] - by_s[:, 1] * by_w[:, 0]
        step_s = (gap[:, 0] * by_w[:, 1] - gap[:, 1] * by_w[:, 0]) / area
        step_w = (by_s[:, 0] * gap[:, 1] - by_s[:, 1] * gap[:, 0]) / area
        s = np.clip(s + step_s, plane.start, plane.end)
        w = np.clip(w + step_w, -0.5, 1.5)
    gap = np.linalg.norm(flat - development.flat(s, w), axis=1)
    if gap.max() > tolerances.SEAM_LENGTH:
        at = int(np.argmax(gap))
        raise BendTorsionError(
            error(
                "point-off-pattern",
                "pattern",
                "a flat point lies off the plate",
                "move it onto the pattern",
                position=f"x = {flat[at, 0]:.1f}, y = {flat[at, 1]:.1f} mm in the plane",
                value=float(gap[at]),
                limit=tolerances.SEAM_LENGTH,
                unit="mm",
            )
        )
    return s, w
