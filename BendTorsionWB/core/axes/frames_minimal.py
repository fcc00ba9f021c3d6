# SPDX-License-Identifier: LGPL-2.1-or-later
"""Directions across an axis that never turn about it: the rotation-minimising frame."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .. import tolerances
from ..geometry.piecewise import resolve
from .axis import Axis

SHARPEST_TURN = 0.5
"""Cosine of the largest turn of the tangent within one span of the transport."""


def turned(vectors: np.ndarray, about: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) across unit vectors `about` (n, 3), turned about them by angle (n,) rad."""
    angle = np.asarray(angle, float)[..., None]
    return np.cos(angle) * vectors + np.sin(angle) * np.cross(about, vectors)


def reflected(vectors: np.ndarray, mirror_normals: np.ndarray) -> np.ndarray:
    """Each vector reflected in the plane normal to its mirror normal (none where that is zero)."""
    squared = (mirror_normals * mirror_normals).sum(axis=1, keepdims=True)
    along = (vectors * mirror_normals).sum(axis=1, keepdims=True)
    factor = np.divide(2.0 * along, squared, out=np.zeros_like(along), where=squared > 0.0)
    return vectors - factor * mirror_normals


def carried(points: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Each z (n, 3) but the last, carried to the next station by one double reflection, (n-1, 3).

    points, x: (n, 3) positions and unit tangents of the stations (Wang, Jüttler, Zheng & Liu,
    Computation of Rotation Minimizing Frames, 2008).
    """
    step = np.diff(points, axis=0)
    # Between stations at one place the chord is rounding, and has no direction to mirror in.
    step[(step * step).sum(axis=1) < tolerances.SAME_STATION**2] = 0.0
    first = reflected(z[:-1], step)
    out = reflected(first, x[1:] - reflected(x[:-1], step))
    still = ~step.any(axis=1)
    out[still] = z[:-1][still]
    return out


def minimal_direction(axis: Axis, start: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """s (n,) -> unit vectors (n, 3) across the axis, carried from `start` (3,) without turning.

    Within a span the vector follows the least rotation that takes the tangent at the span's start
    x₀ to x; the rotation-minimising frame turns against that one at the rate
    (x₀ × x)·x' / (1 + x₀·x), which is integrated to rounding. No curvature is divided by, so
    straight stretches and inflections need no care.
    """
    breaks = _gentle(axis)
    first = _unit(axis.tangent(breaks[:-1]))
    bend = axis.tangent.derivative

    def span(s: np.ndarray) -> np.ndarray:
        return np.clip(np.searchsorted(breaks, s, side="right") - 1, 0, len(breaks) - 2)

    pieces = [
        resolve(_on_span(rate_of, axis, bend), np.array([a, b]), 1.0 / axis.length)
        for rate_of, a, b in zip(first, breaks[:-1], breaks[1:], strict=True)
    ]
    turns = [piece.antiderivative() for piece in pieces]
    starts = np.empty_like(first)
    z = _unit((start - (start * first[0]).sum() * first[0])[None])[0]
    for k, turn in enumerate(turns):
        starts[k] = z
        end = breaks[k + 1 : k + 2]
        x = _unit(axis.tangent(end))
        z = turned(_least_rotation(first[k : k + 1], x, z[None]), x, turn(end)[:, 0])[0]

    def direction(s: np.ndarray) -> np.ndarray:
        s = np.atleast_1d(np.asarray(s, float))
        where = span(s)
        angle = np.empty(len(s))
        for k in np.unique(where):
            angle[where == k] = turns[k](s[where == k])[:, 0]
        x = _unit(axis.tangent(s))
        return turned(_least_rotation(first[where], x, starts[where]), x, angle)

    return direction


def closing_angle(x: np.ndarray, start: np.ndarray, end: np.ndarray) -> float:
    """Angle (-π, π] about x that takes the direction carried round, `end`, back to `start`."""
    return float(np.arctan2((np.cross(end, start) * x).sum(), (end * start).sum()))


def _on_span(base: np.ndarray, axis: Axis, bend):
    def rate(s: np.ndarray) -> np.ndarray:
        x = _unit(axis.tangent(s))
        across = (np.cross(base, x) * bend(s)).sum(axis=1)
        return (across / (1.0 + (x * base).sum(axis=1)))[:, None]

    return rate


def _gentle(axis: Axis) -> np.ndarray:
    """The axis's breaks, halved until the tangent turns little between neighbours."""
    breaks = np.asarray(axis.position.breaks, float)
    for _ in range(8):
        x = _unit(axis.tangent(breaks))
        sharp = (x[1:] * x[:-1]).sum(axis=1) < SHARPEST_TURN
        if not sharp.any():
            break
        middle = 0.5 * (breaks[1:] + breaks[:-1])[sharp]
        breaks = np.sort(np.concatenate([breaks, middle]))
    return breaks


def _least_rotation(before: np.ndarray, after: np.ndarray, z: np.ndarray) -> np.ndarray:
    """z (n, 3) across `before`, turned by the least rotation that takes `before` to `after`."""
    share = (z * after).sum(axis=1) / (1.0 + (before * after).sum(axis=1))
    return z - share[:, None] * (before + after)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
