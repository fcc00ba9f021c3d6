# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels on a drawing: placed one after the other so that none touches a line or another label."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from .sheet import Polyline, Text, boxes_overlap, text_box, text_width

LABEL_HEIGHT = 1.8
CLEARANCE = 0.4  # mm between a label and what it must not touch
TIERS = (
    1.2,
    4.2,
    7.2,
    10.2,
    13.2,
    16.2,
)  # mm from a line's end to its label; beyond the first with a leader
SLANTS = (4.0, -4.0, 8.0, -8.0, 12.0, -12.0, 18.0, -18.0)  # mm a label on a leader may stand aside
WORD_SPACE = 0.5  # mm kept free before and behind a label, beyond the clearance
MOST_CROWDED = 6
"""Labels without room after which no more slanting leaders are tried on a drawing."""
ALONG = (0.5, 0.36, 0.64, 0.22, 0.78, 0.1, 0.9)  # of a line's length, where its label may stand


def as_points(array: np.ndarray) -> tuple[tuple[float, float], ...]:
    """An (n, 2) array as plain points."""
    return tuple((float(x), float(y)) for x, y in array)


def segments_of(runs: Iterable) -> np.ndarray:
    """The segments (n, 2, 2) between the points, each run (k, 2), of lines."""
    parts = [np.asarray(run) for run in runs]
    return np.concatenate([np.stack([part[:-1], part[1:]], axis=1) for part in parts])


class Labels:
    """Texts placed so far, and the segments they must not cross; crowded: how many found no room
    beyond a line's end."""

    def __init__(self, segments: np.ndarray):
        self.segments = np.zeros((0, 2, 2))
        self._low = self._high = np.zeros((0, 2))
        self.keep_off(segments)
        self.texts: list[Text] = []
        self.boxes: list[np.ndarray] = []
        self.bounds: list[tuple[float, float, float, float]] = []
        self.leaders: list[Polyline] = []
        self.crowded = 0

    def keep_off(self, segments: np.ndarray) -> None:
        """Have no further text cross these segments (n, 2, 2)."""
        self.segments = np.concatenate([self.segments, segments])
        self._low = np.concatenate([self._low, segments.min(axis=1)])
        self._high = np.concatenate([self._high, segments.max(axis=1)])

    def _near(self, low: tuple[float, float], high: tuple[float, float]) -> np.ndarray:
        """The segments that come near a box given by its lower left and upper right corner."""
        (x0, y0), (x1, y1) = low, high
        near = self._low[:, 0] < x1 + CLEARANCE
        near &= self._low[:, 1] < y1 + CLEARANCE
        near &= self._high[:, 0] > x0 - CLEARANCE
        near &= self._high[:, 1] > y0 - CLEARANCE
        return self.segments[near]

    def put(self, text: Text, leader: np.ndarray | None = None) -> bool:
        """Take the text, and its leader (2, 2), as placed; False when they touch anything."""
        body = text_box(text)
        box = _with_space(body)
        left, low, right, high = bound = _bounds(box)
        grown = (left - CLEARANCE, low - CLEARANCE, right + CLEARANCE, high + CLEARANCE)
        for other, taken in zip(self.boxes, self.bounds, strict=True):
            apart = (
                grown[0] >= taken[2]
                or taken[0] >= grown[2]
                or grown[1] >= taken[3]
                or taken[1] >= grown[3]
            )
            if not apart and boxes_overlap(box, other, CLEARANCE):
                return False
        if _crossed(body, self._near(bound[:2], bound[2:]), CLEARANCE):
            return False
        if leader is not None:
            if _crossed(body, leader[None], 0.0):
                return False
            (x0, y0), (x1, y1) = leader.min(axis=0) - 0.1, leader.max(axis=0) + 0.1
            for other, taken in zip(self.boxes, self.bounds, strict=True):
                apart = x0 > taken[2] or taken[0] > x1 or y0 > taken[3] or taken[1] > y1
                if not apart and _crossed(other, leader[None], 0.1):
                    return False
            self.leaders.append(Polyline(as_points(leader), "narrow"))
            self.keep_off(leader[None])
        self.texts.append(text)
        self.boxes.append(box)
        self.bounds.append(bound)
        return True

    def clear_of_texts(self, segments: np.ndarray) -> bool:
        """True when segments (n, 2, 2) cross no text placed so far."""
        return not any(_crossed(box, segments, 0.1) for box in self.boxes)

    def put_group(self, box: np.ndarray, texts: list[Text], leader: np.ndarray) -> bool:
        """Take texts that fill a rectangle (4, 2), and the segments (n, 2, 2) of a leader to it
        that may cross lines, as placed; False when the rectangle touches anything or the leader a
        text."""
        if any(boxes_overlap(box, other, CLEARANCE) for other in self.boxes):
            return False
        bound = _bounds(box)
        if _crossed(box, self._near(bound[:2], bound[2:]), CLEARANCE):
            return False
        if not self.clear_of_texts(leader):
            return False
        self.keep_off(leader)
        self.texts += texts
        self.boxes.append(box)
        self.bounds.append(bound)
        return True


def _with_space(box: np.ndarray) -> np.ndarray:
    """The box of a text longer at both ends, so that two texts do not read as one."""
    along = box[1] - box[0]
    step = along / np.hypot(*along) * WORD_SPACE
    return box + np.array([-step, step, step, -step])


def _bounds(box: np.ndarray) -> tuple[float, float, float, float]:
    """Left, low, right and high of a rectangle (4, 2)."""
    xs, ys = zip(*box.tolist())
    return min(xs), min(ys), max(xs), max(ys)


def _crossed(box: np.ndarray, segments: np.ndarray, clearance: float) -> bool:
    """True when a segment (n, 2, 2) meets the rectangle grown by `clearance` (slab clipping)."""
    # There are a few segments near a text at most: plain numbers are faster than arrays of them.
    (x0, y0), (x1, y1), _, (x3, y3) = box.tolist()
    sides = ((x1 - x0, y1 - y0), (x3 - x0, y3 - y0))
    sizes = [math.hypot(*side) for side in sides]
    if not all(sizes):
        return False
    slabs = [(x / size, y / size, size) for (x, y), size in zip(sides, sizes)]
    for (px, py), (qx, qy) in segments.tolist():
        first, last = 0.0, 1.0
        for x, y, size in slabs:
            start = (px - x0) * x + (py - y0) * y
            step = (qx - x0) * x + (qy - y0) * y - start
            low, high = -clearance - start, size + clearance - start
            if step == 0.0:
                if low > 0.0 or high < 0.0:
                    last = -math.inf
                continue
            enter, leave = (low / step, high / step) if step > 0.0 else (high / step, low / step)
            first, last = max(first, enter), min(last, leave)
        if first <= last:
            return True
    return False


def label_beyond(labels: Labels, label: str, end: np.ndarray, far: np.ndarray) -> bool:
    """A level label beyond `end` of the line from `far`; False when there is no room."""
    away = end - far
    length = np.hypot(*away)
    if length == 0.0:
        return False
    away = away / length
    half = np.array([text_width(label, LABEL_HEIGHT), LABEL_HEIGHT * 1.32]) / 2.0
    reach = float(np.abs(away) @ half) if abs(away[0]) > 0.5 else half[1] / abs(away[1])
    level = abs(away[0]) > 0.5
    for gap in TIERS:
        for side in (0.0, -half[0], half[0]) if gap == TIERS[0] and not level else (0.0,):
            middle = end + away * (gap + reach) + (side, 0.0)
            leader = np.array([end + away * 0.5, end + away * (gap - 0.2)])
            if labels.put(_about(middle, label), leader if gap > TIERS[0] else None):
                return True
    if labels.crowded >= MOST_CROWDED:
        return False
    # No room straight on: a slanting leader.
    for gap in TIERS[1:]:
        for side in SLANTS:
            middle = end + away * (gap + reach) + ((0.0, side) if level else (side, 0.0))
            way = np.sign(away) * (half + 0.3) * ((1.0, 0.0) if level else (0.0, 1.0))
            if labels.put(_about(middle, label), np.array([end + away * 0.5, middle - way])):
                return True
    labels.crowded += 1
    return False


def _about(middle: np.ndarray, label: str) -> Text:
    """A level text whose box has this middle."""
    y = float(middle[1] - LABEL_HEIGHT / 2.0 + 0.16 * LABEL_HEIGHT)
    return Text(float(middle[0]), y, LABEL_HEIGHT, label, anchor="middle")


def label_along(labels: Labels, label: str, ends: np.ndarray, outer) -> bool:
    """A label beside a line, parallel to it; on the side away from `outer` when that is given."""
    direction = ends[1] - ends[0]
    length = np.hypot(*direction)
    width = text_width(label, LABEL_HEIGHT)
    if length < width + 2 * CLEARANCE:
        return False
    direction = direction / length
    # Steep texts read from the right, all others from below.
    if (direction[1] if abs(direction[1]) >= abs(direction[0]) else direction[0]) < 0.0:
        direction = -direction
    left = np.array([-direction[1], direction[0]])
    # The body of a text lies left of its base line, so the far side needs the whole height.
    above, below = left * (CLEARANCE + 0.85), -left * (LABEL_HEIGHT + CLEARANCE + 0.4)
    offsets = [above, below]
    if outer is not None and (outer - ends.mean(axis=0)) @ left > 0.0:
        offsets = [below, above]
    angle = float(np.degrees(np.arctan2(direction[1], direction[0])))
    for offset in offsets:
        for share in ALONG:
            x, y = ends[0] + (ends[1] - ends[0]) * share + offset
            text = Text(float(x), float(y), LABEL_HEIGHT, label, angle, "middle")
            if labels.put(text):
                return True
    return False
