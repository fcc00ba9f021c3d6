# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lengths measured on finished geometry, flat and curved, apart from how it was constructed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .development import Development

FINEST = 32
"""Chords per smooth interval at the finest of the three levels extrapolated from."""


def smooth_intervals(places: np.ndarray, folds: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Intervals (k, 2) between consecutive places, cut at folds, and the panel (k,) of each."""
    inner = [f for f in folds if places[0] < f < places[-1]]
    edges = np.unique(np.concatenate([places, inner]))
    intervals = np.column_stack([edges[:-1], edges[1:]])
    middle = intervals.mean(axis=1)
    return intervals, np.searchsorted(places, middle, side="right") - 1


def curve_lengths(
    curve: Callable[[np.ndarray, np.ndarray], np.ndarray],
    intervals: np.ndarray,
    panels: np.ndarray,
    count: int,
) -> np.ndarray:
    """Length (count,) per panel of curve(s (n,), panel (n,)) -> (n, d).

    Chord sums at 8, 16 and 32 chords per interval, extrapolated to zero (Richardson), so that
    only positions enter and no derivative used in the construction.
    """
    fraction = np.linspace(0.0, 1.0, FINEST + 1)
    s = intervals[:, :1] + (intervals[:, 1:] - intervals[:, :1]) * fraction
    # Just inside the interval, so that both sides of a fold give their own limit.
    span = intervals[:, 1] - intervals[:, 0]
    s[:, 0] += 1e-12 * span
    s[:, -1] -= 1e-12 * span
    owner = np.repeat(panels, FINEST + 1)
    points = curve(s.ravel(), owner).reshape(len(intervals), FINEST + 1, -1)
    sums = [
        np.linalg.norm(np.diff(points[:, :: FINEST // n], axis=1), axis=2).sum(axis=1)
        for n in (FINEST // 4, FINEST // 2, FINEST)
    ]
    first = (4 * sums[1] - sums[0]) / 3
    second = (4 * sums[2] - sums[1]) / 3
    return np.bincount(panels, (16 * second - first) / 15, minlength=count)


def diagonal_lengths(
    development: Development,
    places: np.ndarray,
    folds: tuple[float, ...],
    start_w: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Flat and geodesic length (k,) of the panel diagonals that start at w = start_w (0 or 1).

    The curve on the surface is the preimage of the straight flat diagonal; flat and curved are
    nearly isometric, so that its excess over the geodesic is of second order in the strain.
    """
    intervals, panels = smooth_intervals(places, folds)
    count = len(places) - 1
    a = development.flat(places[:-1], np.full(count, start_w))
    b = development.flat(places[1:], np.full(count, 1.0 - start_w))

    def on_surface(s: np.ndarray, panel: np.ndarray) -> np.ndarray:
        w = development.ruling_crossing(s, a[panel], b[panel])
        return development.point(s, w)

    return np.linalg.norm(b - a, axis=1), curve_lengths(on_surface, intervals, panels, count)


def edge_lengths(
    development: Development, places: np.ndarray, folds: tuple[float, ...], w: float
) -> tuple[np.ndarray, np.ndarray]:
    """Flat and curved length (k,) between consecutive places along the line w = constant."""
    intervals, panels = smooth_intervals(places, folds)
    count = len(places) - 1
    return tuple(
        curve_lengths(lambda s, _, f=function: f(s, np.full(len(s), w)), intervals, panels, count)
        for function in (development.flat, development.point)
    )


def geodesic_lengths(
    development: Development,
    places: np.ndarray,
    folds: tuple[float, ...],
    start_w: float,
    modes: int = 3,
) -> tuple[np.ndarray, np.ndarray]:
    """As diagonal_lengths, with the preimage relaxed to the geodesic by one Newton step.

    The step minimises the length over `modes` sine waves of w per panel, from differences of the
    measured length; its gain is the second-order excess of the preimage.
    """
    intervals, panels = smooth_intervals(places, folds)
    count = len(places) - 1
    a = development.flat(places[:-1], np.full(count, start_w))
    b = development.flat(places[1:], np.full(count, 1.0 - start_w))
    size = 1e-3

    def length(waves: dict[int, float]) -> np.ndarray:
        def on_surface(s: np.ndarray, panel: np.ndarray) -> np.ndarray:
            x = (s - places[panel]) / (places[panel + 1] - places[panel])
            w = development.ruling_crossing(s, a[panel], b[panel])
            for mode, amplitude in waves.items():
                w = w + amplitude * np.sin(mode * np.pi * x)
            return development.point(s, w)

        return curve_lengths(on_surface, intervals, panels, count)

    middle = length({})
    gain = np.zeros(count)
    for mode in range(1, modes + 1):
        up, down = length({mode: size}), length({mode: -size})
        slope, bend = (up - down) / (2 * size), (up - 2 * middle + down) / size**2
        gain += np.where(bend > 0, slope**2 / (2 * np.where(bend > 0, bend, 1.0)), 0.0)
    return np.linalg.norm(b - a, axis=1), middle - gain
