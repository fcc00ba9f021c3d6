# SPDX-License-Identifier: LGPL-2.1-or-later
"""The four sides of a flat pattern's outline: its two long edges and its two ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate


@dataclass(frozen=True, eq=False)
class Sides:
    """Runs (k, 2) of each side, head to tail: edges along +s, ends from the first edge to the
    second. mirrored: counter-clockwise is against +s on the first edge."""

    first: tuple[np.ndarray, ...]
    second: tuple[np.ndarray, ...]
    start: tuple[np.ndarray, ...]
    end: tuple[np.ndarray, ...]
    mirrored: bool

    def outline(self) -> tuple[np.ndarray, ...]:
        """The sides as one outline, counter-clockwise."""
        if self.mirrored:
            return (*self.start, *self.second, *_back(self.end), *_back(self.first))
        return (*self.first, *self.end, *_back(self.second), *_back(self.start))


def sides_of(plate: DevelopedPlate) -> Sides:
    """The sides of a net outline, parted at the corners, where its end lines meet its edges."""
    runs = plate.outline
    heads = np.array([run[0] for run in runs])
    corners = [plate.lines[at].flat[edge] for at, edge in ((0, 0), (-1, 0), (-1, 1), (0, 1))]
    at = [int(np.argmin(((heads - corner) ** 2).sum(axis=1))) for corner in corners]
    mirrored = (at[1] - at[0]) % len(runs) > (at[3] - at[0]) % len(runs)
    order = at if not mirrored else [at[0], at[3], at[2], at[1]]
    parts = [
        _cyclic(runs, head, tail) for head, tail in zip(order, [*order[1:], order[0]], strict=True)
    ]
    if mirrored:
        start, second, end, first = parts
        return Sides(_back(first), second, start, _back(end), True)
    first, end, second, start = parts
    return Sides(first, _back(second), _back(start), end, False)


def _cyclic(runs: Sequence[np.ndarray], head: int, tail: int) -> tuple[np.ndarray, ...]:
    count = (tail - head) % len(runs)
    return tuple(runs[(head + k) % len(runs)] for k in range(count))


def _back(runs: Sequence[np.ndarray]) -> tuple[np.ndarray, ...]:
    return tuple(run[::-1] for run in reversed(runs))
