# SPDX-License-Identifier: LGPL-2.1-or-later
"""The developed strip of a face: the flat patterns of its plates laid end to end in one plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate


@dataclass(frozen=True, eq=False)
class FaceStrip:
    """A face laid flat, by its measuring lines: s (n,) their places on the axis, rising; first and
    second (n, 2) their ends on the face's two edges, mm. The middles of the first and the last line
    lie on a level line."""

    s: np.ndarray
    first: np.ndarray
    second: np.ndarray

    def across(self, s: float) -> np.ndarray:
        """The two ends (2, 2) of the line across the strip at a place on the axis, mm."""
        return np.array(
            [
                [np.interp(s, self.s, edge[:, axis]) for axis in (0, 1)]
                for edge in (self.first, self.second)
            ]
        )

    def place_at(self, point: Sequence[float]) -> float:
        """The place on the axis whose middle lies nearest to a point of the plane, mm."""
        middles = 0.5 * (self.first + self.second)
        start, step = middles[:-1], np.diff(middles, axis=0)
        square = np.maximum((step * step).sum(axis=1), 1e-12)
        away = np.asarray(point, float) - start
        part = np.clip((away * step).sum(axis=1) / square, 0.0, 1.0)
        miss = np.hypot(*(start + part[:, None] * step - np.asarray(point, float)).T)
        k = int(np.argmin(miss))
        return float(self.s[k] + part[k] * (self.s[k + 1] - self.s[k]))


def face_strip(plates: Sequence[DevelopedPlate]) -> FaceStrip | None:
    """The strip of the plates of one face or lane, in any order; each is turned so that its start
    line continues the end line of the plate before it. Lanes of a face are strips of their own;
    None when no plate has two lines."""
    own = sorted(plates, key=lambda plate: (plate.s_start, plate.mark))
    places, firsts, seconds = [], [], []
    for plate in own:
        if len(plate.lines) < 2:
            continue
        lines = sorted(plate.lines, key=lambda line: line.s)
        first = np.array([line.flat[0] for line in lines])
        second = np.array([line.flat[1] for line in lines])
        if firsts:
            first, second = _continued(first, second, firsts[-1][-1], seconds[-1][-1])
        places.append(np.array([line.s for line in lines]))
        firsts.append(first)
        seconds.append(second)
    if not firsts:
        return None
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    middles = 0.5 * (first + second)
    first, second = (
        _turned(edge - middles[0], middles[-1] - middles[0]) for edge in (first, second)
    )
    return FaceStrip(np.concatenate(places), first, second)


def _continued(first, second, end_first, end_second):
    """Two edges moved so that their first line lies on that from end_first to end_second, middle on
    middle."""
    here, there = second[0] - first[0], end_second - end_first
    turn = np.arctan2(there[1], there[0]) - np.arctan2(here[1], here[0])
    middle, onto = 0.5 * (first[0] + second[0]), 0.5 * (end_first + end_second)
    return tuple(_rotated(edge - middle, turn) + onto for edge in (first, second))


def _turned(points: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Points turned so that a direction is level."""
    return _rotated(points, -np.arctan2(along[1], along[0]))


def _rotated(points: np.ndarray, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    x, y = points[:, 0], points[:, 1]
    return np.column_stack([c * x - s * y, s * x + c * y])
