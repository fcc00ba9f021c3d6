# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closest points of an ellipsoid by its secular equation."""

from __future__ import annotations

import numpy as np

_NEWTON_STEPS = 80
_NEWTON_RELATIVE = 4 * np.finfo(float).eps


def ellipsoid_feet(points: np.ndarray, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Closest points of the ellipsoid with half-axes `axes` (3,) mm about the origin.

    Returns x_i / e_i (n, 3) of the feet, unit vectors, and the root s (n,) mm², 0 where several
    feet are equally near. The foot of y is x_i = e_i² y_i / (s + e_i² − e_min²), s the root of
    ‖x_i / e_i‖ = 1 (Eberly, Distance from a Point to an Ellipse, an Ellipsoid, 2013). Newton works
    on 1/‖·‖, concave and nearly linear in s, so it comes from the left without overshoot (Moré &
    Sorensen 1983).
    """
    smallest = axes.min()
    shift = (axes - smallest) * (axes + smallest)
    short = shift == 0
    scaled = axes * points
    # Bracket of the root: to its left one axis, or the short ones, alone give 1 or more.
    least = np.sqrt((scaled[:, short] ** 2).sum(1))
    low = np.maximum(least, (np.abs(scaled) - shift).max(1))
    high = np.maximum(np.sqrt((scaled**2).sum(1)), low)
    terms, norm, _ = _secular(scaled, low, shift)
    middle = (low == 0) & (norm <= 1)
    active = np.flatnonzero(~middle)
    for step in range(_NEWTON_STEPS):
        if not len(active):
            break
        here = low[active]
        if step % 4 == 3:
            # Just off the middle plane Newton only grows by half a step; halve decades there.
            trial = np.sqrt(here) * np.sqrt(high[active])
            left = _secular(scaled[active], trial, shift)[1] >= 1
            here = np.where(left, trial, here)
            high[active] = np.where(left, high[active], trial)
        _, norm, slope = _secular(scaled[active], here, shift)
        low[active] = np.clip(here + norm**2 * (norm - 1) / slope, here, high[active])
        active = active[low[active] - here > _NEWTON_RELATIVE * here]
    terms, _, _ = _secular(scaled, low, shift)
    if middle.any():
        # On the middle plane (or line) two (or a circle of) feet are equally near.
        rest = np.sqrt(np.maximum(1 - (terms[middle] ** 2).sum(1), 0.0))
        terms[middle, np.flatnonzero(short)[-1]] = rest
    terms /= np.sqrt((terms**2).sum(1))[:, None]
    return terms, low


def _secular(
    scaled: np.ndarray, s: np.ndarray, shift: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vectors x_i / e_i of the ellipsoid's foot at s, their norms and Σ terms² / (s + shift)."""
    below = s[:, None] + shift
    below[below == 0] = np.inf
    terms = scaled / below
    square = terms**2
    return terms, np.sqrt(square.sum(1)), (square / below).sum(1)
