# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins: rails as cubic B-splines on common stations, the poles solids are written from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from . import tolerances
from .piecewise import Piecewise

FEWEST_INTERVALS = 4
MOST_INTERVALS = 4096


@dataclass(frozen=True, eq=False)
class SkinPiece:
    """Rails over one smooth piece: knots (n + 4,) shared by all, poles (m, n, 3).

    The parameter is arc length on the axis, for the first group of rails exactly."""

    knots: np.ndarray
    poles: np.ndarray

    def at(self, s: np.ndarray) -> np.ndarray:
        """Points (k, m, 3) of all rails at arc lengths s (k,)."""
        return BSpline(self.knots, self.poles.transpose(1, 0, 2), 3)(s)


def skin(
    rails: Sequence[Piecewise],
    folds: Sequence[Sequence[float]] = (),
    spacing: float = 1000.0,
    tolerance: float = tolerances.SKIN_CORNER,
) -> tuple[SkinPiece, ...]:
    """Cubic B-splines through one or more groups of rails s -> (m * 3,), end tangents clamped.

    folds: per group, the places its rails are broken at, the same number in each (a plate's inner
    rails are broken at the mitre, not below the outer fold). Each piece starts with stations no
    farther apart than `spacing` and doubles them until every rail agrees with its spline midway
    between stations to `tolerance` (mm). All rails of a piece share stations and knots:
    separately parameterised edges of one plate never close.
    """
    folds = folds or [()] * len(rails)
    edges = [
        [group.start, *sorted(own), group.end] for group, own in zip(rails, folds, strict=True)
    ]
    return tuple(
        _piece(rails, [(own[k], own[k + 1]) for own in edges], spacing, tolerance)
        for k in range(len(edges[0]) - 1)
    )


def _piece(
    rails: Sequence[Piecewise],
    ranges: Sequence[tuple[float, float]],
    spacing: float,
    tolerance: float,
) -> SkinPiece:
    start, end = ranges[0]
    scales = [(b - a) / (end - start) for a, b in ranges]
    count = max(FEWEST_INTERVALS, int(np.ceil((end - start) / spacing)))
    while True:
        s = np.linspace(start, end, count + 1)
        middle = 0.5 * (s[1:] + s[:-1])
        values, ends, truth = [], [], []
        for group, (a, b), scale in zip(rails, ranges, scales, strict=True):
            own = np.linspace(a, b, count + 1)
            values.append(_inside(group, own))
            ends.append(scale * _inside(group.derivative, own[[0, -1]]))
            truth.append(group(a + (middle - start) * scale))
        values, ends, truth = (np.concatenate(part, axis=1) for part in (values, ends, truth))
        spline = make_interp_spline(s, values, k=3, bc_type=([(1, ends[0])], [(1, ends[1])]))
        miss = (spline(middle) - truth).reshape(count, -1, 3)
        if np.linalg.norm(miss, axis=2).max() <= tolerance or count >= MOST_INTERVALS:
            break
        count *= 2
    poles = spline.c
    poles[0], poles[-1] = values[0], values[-1]
    return SkinPiece(spline.t, poles.reshape(len(poles), -1, 3).transpose(1, 0, 2))


def _inside(function: Piecewise, s: np.ndarray) -> np.ndarray:
    """Values at s from within the piece: the last station belongs to the span before it."""
    return np.concatenate([function(s[:-1]), function(s[-1:], side="earlier")])
