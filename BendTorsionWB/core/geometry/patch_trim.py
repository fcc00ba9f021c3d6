# SPDX-License-Identifier: LGPL-2.1-or-later
"""The wires of a face on its patch: what lies inside them, and how far outside the rest is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

_CHUNK = 2_000_000


@dataclass(frozen=True, eq=False)
class Trim:
    """The wires of a face as polylines (m, 2) in u, v, in any order and direction.

    Together they bound the face: a point is inside when a ray from it crosses them an odd number
    of times.
    """

    lines: tuple[np.ndarray, ...]

    @cached_property
    def _segments(self) -> tuple[np.ndarray, np.ndarray]:
        return (
            np.concatenate([line[:-1] for line in self.lines]),
            np.concatenate([line[1:] for line in self.lines]),
        )

    def contains(self, places: np.ndarray) -> np.ndarray:
        """Whether places (n, 2) in u, v are inside, (n,) bool."""
        first, last = self._segments
        run = last - first
        inside = np.zeros(len(places), bool)
        for rows in _chunks(len(places), len(first)):
            u, v = places[rows, :1], places[rows, 1:]
            crosses = (first[:, 1] > v) != (last[:, 1] > v)
            rise = np.where(run[:, 1] == 0, 1.0, run[:, 1])
            at = first[:, 0] + (v - first[:, 1]) / rise * run[:, 0]
            inside[rows] = np.count_nonzero(crosses & (u < at), axis=1) % 2 == 1
        return inside

    def nearest(self, places: np.ndarray, scale: np.ndarray) -> np.ndarray:
        """The nearest places on the wires (n, 2); scale (2,): mm per unit of u and of v."""
        first, last = (end * scale for end in self._segments)
        run = last - first
        squared = np.maximum((run * run).sum(axis=1), 1e-300)
        out = np.empty_like(places)
        for rows in _chunks(len(places), len(first)):
            away = places[rows, None] * scale - first
            share = np.clip((away * run).sum(axis=2) / squared, 0.0, 1.0)
            gap = away - share[..., None] * run
            best = np.argmin((gap * gap).sum(axis=2), axis=1)
            pick = np.arange(len(best))
            out[rows] = (first[best] + share[pick, best, None] * run[best]) / scale
        return out


def trim_gap(patch, u: np.ndarray, v: np.ndarray, feet: np.ndarray) -> np.ndarray:
    """How far feet (n, 3) at u, v lie outside the wires of `patch`, mm; 0 inside or untrimmed."""
    gap = np.zeros(len(u))
    if patch.trim is None or not len(u):
        return gap
    places = np.column_stack([u, v])
    beyond = np.flatnonzero(~patch.trim.contains(places))
    if len(beyond):
        border = patch.trim.nearest(places[beyond], _scale(patch))
        points = patch.evaluate(border[:, 0], border[:, 1])[0]
        gap[beyond] = np.linalg.norm(points - feet[beyond], axis=1)
    return gap


def inside(patch, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Whether u, v (n,) are inside the wires of the patch, (n,) bool."""
    if patch.trim is None:
        return np.ones(len(u), bool)
    return patch.trim.contains(np.column_stack([u, v]))


def trim_border(patch, count: int) -> tuple[np.ndarray, ...]:
    """About `count` samples of the wires, evenly spaced: points, direction along, direction into
    the face, normal, each (m, 3), as `NurbsPatch.border` gives them for a side."""
    lines = [np.asarray(line, float) for line in patch.trim.lines]
    spaces = [patch.evaluate(line[:, 0], line[:, 1])[0] for line in lines]
    arcs = [
        np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        for points in spaces
    ]
    spacing = sum(arc[-1] for arc in arcs) / count
    places, headings = [], []
    for line, arc in zip(lines, arcs, strict=True):
        if arc[-1] < 1e-6 * spacing:
            continue
        number = max(3, int(round(arc[-1] / spacing)))
        at = (np.arange(number) + 0.5) / number * arc[-1]
        where = np.clip(np.searchsorted(arc, at, side="right") - 1, 0, len(arc) - 2)
        share = (at - arc[where]) / np.maximum(arc[where + 1] - arc[where], 1e-300)
        step = line[where + 1] - line[where]
        places.append(line[where] + share[:, None] * step)
        headings.append(step)
    place, heading = np.concatenate(places), np.concatenate(headings)
    derivatives = patch.evaluate(place[:, 0], place[:, 1])
    points, su, sv = derivatives[:3]
    normals = patch.normals(place[:, 0], place[:, 1], derivatives)
    along = heading[:, :1] * su + heading[:, 1:] * sv
    size = np.linalg.norm(along, axis=1)
    sound = size > 0
    into = np.cross(normals, along / np.where(sound, size, 1.0)[:, None])
    # The same direction in u, v, short against the samples' spacing, to see which side is inside.
    uu, uv, vv = ((a * b).sum(axis=1) for a, b in ((su, su), (su, sv), (sv, sv)))
    determinant = np.maximum(uu * vv - uv * uv, 1e-300)
    pu, pv = (into * su).sum(axis=1), (into * sv).sum(axis=1)
    move = np.column_stack([vv * pu - uv * pv, uu * pv - uv * pu]) / determinant[:, None]
    move *= 1e-2 * spacing
    forward = patch.trim.contains(place + move)
    backward = patch.trim.contains(place - move)
    sound &= forward != backward
    low, high = patch.domain.T
    slack = 1e-9 * (high - low)
    sound &= ((place >= low - slack) & (place <= high + slack)).all(axis=1)
    into = np.where(forward, 1.0, -1.0)[:, None] * into
    return points[sound], along[sound], into[sound], normals[sound]


def _scale(patch) -> np.ndarray:
    """Millimetres per unit of u and of v, in the mean over the patch."""
    u, v, *_ = patch.samples
    _, su, sv, *_ = patch.evaluate(u, v)
    lengths = np.array([np.linalg.norm(rate, axis=1).mean() for rate in (su, sv)])
    return np.maximum(lengths, 1e-12 * lengths.max())


def _chunks(rows: int, columns: int):
    step = max(1, _CHUNK // max(columns, 1))
    return [slice(k, k + step) for k in range(0, rows, step)]
