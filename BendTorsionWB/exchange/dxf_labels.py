# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where texts stand on a flat pattern: clear of its lines, its contour and of each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.geometry.arc_contour import inside, polygon, runs

SMALLEST_TEXT = 2.5  # mm; below this no plotter marks legibly
CHARACTER_WIDTH = 1.0  # width over height of a letter, on the safe side
CLEARANCE = 0.2
"""Free way about a text, in its heights."""

_SIZES = (1.0, 0.8, 0.64, 0.5)
_STARTS = (0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4, -0.4)
# Places along a line in the order they are wanted: sizes, sides, and steps from the first.
_SIZE, _SIDE, _STEP = (
    grid.ravel().copy()
    for grid in np.meshgrid(range(len(_SIZES)), (1.0, -1.0), _STARTS, indexing="ij")
)
_SAGITTA = 1.0  # mm; how far chords may be off the arcs they stand for


@dataclass(frozen=True, eq=False)
class Boxes:
    """Rectangles: lower left corners (k, 2), unit vectors along their lower sides (k, 2), widths
    and heights (k,), heights of their text (k,)."""

    corners: np.ndarray
    reading: np.ndarray
    widths: np.ndarray
    heights: np.ndarray
    text: np.ndarray

    def those(self, which: np.ndarray | slice) -> Boxes:
        """The boxes chosen by an index, a mask or a slice."""
        return Boxes(
            self.corners[which],
            self.reading[which],
            self.widths[which],
            self.heights[which],
            self.text[which],
        )

    def all_corners(self) -> np.ndarray:
        """(k, 4, 2)"""
        right = self.widths[:, None] * self.reading
        top = self.heights[:, None] * self.up
        low = self.corners
        return np.stack([low, low + right, low + right + top, low + top], axis=1)

    @property
    def up(self) -> np.ndarray:
        return np.column_stack([-self.reading[:, 1], self.reading[:, 0]])


@dataclass
class Room:
    """The lines of a pattern that texts keep clear of: the first `count` of lines (n, 2, 2); sheet:
    the contour (m, 3) texts stay inside, chords for arcs, if any."""

    lines: np.ndarray = field(default_factory=lambda: np.zeros((256, 2, 2)))
    count: int = 0
    sheet: np.ndarray | None = None

    def add_lines(self, lines: np.ndarray) -> None:
        """Straight lines (m, 2, 2)."""
        more = np.asarray(lines, float).reshape(-1, 2, 2)
        end = self.count + len(more)
        if end > len(self.lines):
            self.lines = np.concatenate([self.lines, np.zeros((end, 2, 2))])
        self.lines[self.count : end] = more
        self.count = end

    def add_contour(self, arcs: np.ndarray, close: bool = True) -> None:
        """A polyline of arcs (m, 3)."""
        sides = runs(arcs, _SAGITTA)
        for side in sides if close else sides[:-1]:
            self.add_lines(np.stack([side[:-1], side[1:]], axis=1))

    def stay_inside(self, contour: np.ndarray) -> None:
        """Keep texts on the sheet with the contour (m, 3), one of those they keep clear of."""
        sides = runs(contour, _SAGITTA)
        self.sheet = polygon(np.concatenate([side[:-1] for side in sides]))

    def add_hole(self, contour: np.ndarray) -> None:
        """A contour (m, 3) with nothing inside: texts keep clear of it all."""
        self.add_contour(contour)
        points = np.concatenate(runs(contour, _SAGITTA))
        # Lines across it, so close that no text finds room between them.
        levels = np.arange(points[:, 1].min(), points[:, 1].max(), SMALLEST_TEXT)
        ring = np.vstack([points, points[:1]])
        a, b = ring[:-1], ring[1:]
        across = []
        for level in levels.tolist():
            cut = (a[:, 1] > level) != (b[:, 1] > level)
            part = (level - a[cut, 1]) / (b[cut, 1] - a[cut, 1])
            x = np.sort(a[cut, 0] + part * (b[cut, 0] - a[cut, 0]))
            across += [[(p, level), (q, level)] for p, q in zip(x[::2], x[1::2], strict=True)]
        if across:
            self.add_lines(np.array(across))

    def clear(self, boxes: Boxes) -> int:
        """Number of the first box that nothing reaches into, else of the one fewest lines do, of
        those on the sheet if any; it is taken from then on."""
        chosen, reached = self._freest(boxes)
        if self.sheet is not None and not self._is_on_sheet(boxes, chosen, reached):
            whole = np.flatnonzero(self._on_sheet(boxes))
            if len(whole):
                chosen = int(whole[self._freest(boxes.those(whole))[0]])
        corner, reading, up = boxes.corners[chosen], boxes.reading[chosen], boxes.up[chosen]
        high = float(boxes.heights[chosen])
        # Lines along it, close enough that no other text finds room between them.
        count = max(1, round(high / float(boxes.text[chosen])))
        feet = corner + np.arange(count + 1)[:, None] * (high / count) * up
        self.add_lines(np.stack([feet, feet + boxes.widths[chosen] * reading], axis=1))
        return chosen

    def _is_on_sheet(self, boxes: Boxes, number: int, reached: int) -> bool:
        one = slice(number, number + 1)
        if reached:
            return bool(self._on_sheet(boxes.those(one))[0])
        # The contour does not cross it: one corner tells.
        return bool(inside(self.sheet, boxes.corners[one])[0])

    def _on_sheet(self, boxes: Boxes) -> np.ndarray:
        corners = boxes.all_corners()
        within = inside(self.sheet, corners.reshape(-1, 2))
        return within.reshape(len(corners), 4).all(axis=1)

    def _freest(self, boxes: Boxes) -> tuple[int, int]:
        """The box that fewest lines reach into, the first of them, and how many."""
        lines = self.lines[: self.count]
        # Mostly the first is free, then one as large: the others need not be looked at.
        near = _near_first(boxes, lines)
        chosen, fewest = 0, int(_reaching(boxes, near, slice(0, 1))[0]) if len(near) else 0
        if not fewest:
            return 0, 0
        sizes = np.flatnonzero(np.diff(boxes.text)) + 1
        edges = np.unique([1, *sizes, len(boxes.text)])
        for start, stop in zip(edges[:-1], edges[1:], strict=True):
            hits = _reaching(boxes, lines, slice(start, stop))
            best = int(np.argmin(hits))
            if hits[best] < fewest:
                chosen, fewest = int(start) + best, int(hits[best])
            if not fewest:
                break
        return chosen, fewest


def along(
    text: str, start: np.ndarray, end: np.ndarray, centre: np.ndarray, height: float, at: float
) -> Boxes:
    """Places of a text along a line, beside it, wanted first: with its beginning at the part `at`
    of the line, on the side of `centre`, in the given height or as large as the line allows."""
    across = end - start
    length = float(np.hypot(*across))
    fitting = 0.8 * length / (len(text) * CHARACTER_WIDTH)
    sizes = _heights(max(SMALLEST_TEXT, min(height, fitting)))
    way = across / length
    reading = way if way[1] > 0.0 or (way[1] == 0.0 and way[0] > 0.0) else -way
    left = np.array([-reading[1], reading[0]])
    here = 1.0 if float(((centre - start) * left).sum()) > -0.01 else -1.0
    size = np.array(sizes)[_SIZE]
    wide = len(text) * CHARACTER_WIDTH * size
    first = (at + _STEP) * length
    may = (_STEP == 0.0) | ((first >= 0.0) & (first <= length - wide))
    size, side, first, wide = size[may], here * _SIDE[may], first[may], wide[may]
    foot = first if reading is way else first + wide
    beside = np.where(side > 0.0, 0.4, -1.4) * size
    corners = start + foot[:, None] * way + beside[:, None] * left
    return Boxes(corners, np.broadcast_to(reading, corners.shape), wide, size, size)


def blocks(
    wide: float,
    high: float,
    height: float,
    reading: np.ndarray,
    fields: Sequence[tuple[np.ndarray, np.ndarray]],
) -> Boxes:
    """Places of a block of text `wide` and `high` text heights large, in fields between two lines
    (2, 2) each, wanted first: in the middle of the first field, in the given height."""
    steps = np.array([0.5, 0.35, 0.65, 0.2, 0.8])
    a, b = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    order = np.argsort(np.maximum(abs(a - 0.5), abs(b - 0.5)), kind="stable")
    a, b = a[order, None], b[order, None]
    middles = np.concatenate(
        [
            (1.0 - a) * ((1.0 - b) * low[0] + b * low[1]) + a * ((1.0 - b) * top[0] + b * top[1])
            for low, top in fields
        ]
    )
    sizes = _heights(height)
    heights = np.repeat(sizes, len(middles))
    places = np.tile(middles, (len(sizes), 1))
    up = np.array([-reading[1], reading[0]])
    corners = places - heights[:, None] * 0.5 * (wide * reading + high * up)
    return Boxes(
        corners, np.tile(reading, (len(heights), 1)), wide * heights, high * heights, heights
    )


def _heights(height: float) -> list[float]:
    """Text heights to try, mm, rounded as they are written."""
    return [round(max(SMALLEST_TEXT, height * part), 1) for part in _SIZES]


def _near_first(boxes: Boxes, lines: np.ndarray) -> np.ndarray:
    """Those of the lines (m, 2, 2) that are not wholly on one side of the first box."""
    gap = CLEARANCE * boxes.text[0] + 1e-6
    (x, y), (across, along) = boxes.corners[0], boxes.reading[0]
    right, up = lines[..., 0] - x, lines[..., 1] - y
    near = True
    for own, size in (
        (right * across + up * along, boxes.widths[0]),
        (up * across - right * along, boxes.heights[0]),
    ):
        one, other = own[:, 0], own[:, 1]
        near &= (np.maximum(one, other) >= -gap) & (np.minimum(one, other) <= size + gap)
    return lines[near]


def _reaching(boxes: Boxes, lines: np.ndarray, which: slice) -> np.ndarray:
    """(k,) how many of the lines (m, 2, 2) reach into each of the boxes, clearance included."""
    away = lines[None] - boxes.corners[which, None, None]
    gap = (CLEARANCE * boxes.text[which])[:, None]
    first, last = 0.0, 1.0
    for axis, size in ((boxes.reading, boxes.widths), (boxes.up, boxes.heights)):
        own = away[..., 0] * axis[which, None, None, 0] + away[..., 1] * axis[which, None, None, 1]
        step = own[..., 1] - own[..., 0]
        step = np.where(np.abs(step) < 1e-9, 1e-9, step)
        enter, leave = (-gap - own[..., 0]) / step, (size[which, None] + gap - own[..., 0]) / step
        first = np.maximum(first, np.minimum(enter, leave))
        last = np.minimum(last, np.maximum(enter, leave))
    return (first <= last).sum(axis=1)
