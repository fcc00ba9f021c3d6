# SPDX-License-Identifier: LGPL-2.1-or-later
"""One flat pattern as a drawing block: outline to scale with labels that never overlap.

A block is laid out around the pattern's own origin (the lower left corner of its bounding box at
(0, 0) page mm) and then moved to its place on a page.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .lofting import DevelopedPlate
from .sheet import Polyline, Text, View, boxes_overlap, text_box, text_width

LABEL_HEIGHT = 1.8
CAPTION_HEIGHT = 2.5
MARK_HEIGHT = 3.5
DRAWN_TOLERANCE = 0.01  # mm on paper between a curve and its drawn polyline
CLEARANCE = 0.4  # mm between a label and what it must not touch
TIERS = (
    1.2,
    4.2,
    7.2,
    10.2,
    13.2,
    16.2,
)  # mm from a line's end to its label; beyond the first with a leader
ALONG = (0.5, 0.36, 0.64, 0.22, 0.78, 0.1, 0.9)  # of a line's length, where its label may stand


@dataclass(frozen=True)
class Block:
    """A laid out pattern. box: (left, bottom, right, top) page mm about the pattern's origin."""

    mark: str
    view: View
    lines: tuple[Polyline, ...]
    texts: tuple[Text, ...]
    box: tuple[float, float, float, float]

    def moved(self, dx: float, dy: float) -> Block:
        """The block shifted on the page."""
        x0, y0 = self.view.origin
        return Block(
            self.mark,
            replace(self.view, origin=(x0 + dx, y0 + dy)),
            tuple(
                Polyline(tuple((x + dx, y + dy) for x, y in line.points), line.style)
                for line in self.lines
            ),
            tuple(replace(text, x=text.x + dx, y=text.y + dy) for text in self.texts),
            (self.box[0] + dx, self.box[1] + dy, self.box[2] + dx, self.box[3] + dy),
        )


def simplified(points: np.ndarray, tolerance: float) -> np.ndarray:
    """The points (n, 2) that keep a polyline within `tolerance` (Douglas and Peucker)."""
    keep = np.zeros(len(points), dtype=bool)
    keep[[0, -1]] = True
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        chord = points[last] - points[first]
        offsets = points[first + 1 : last] - points[first]
        length = np.hypot(*chord)
        if length > 0.0:
            distance = np.abs(chord[0] * offsets[:, 1] - chord[1] * offsets[:, 0]) / length
        else:
            distance = np.hypot(offsets[:, 0], offsets[:, 1])
        worst = int(np.argmax(distance))
        if distance[worst] > tolerance:
            middle = first + 1 + worst
            keep[middle] = True
            spans += [(first, middle), (middle, last)]
    return points[keep]


def as_points(array: np.ndarray) -> tuple[tuple[float, float], ...]:
    """An (n, 2) array as plain points."""
    return tuple((float(x), float(y)) for x, y in array)


class _Labels:
    """Texts placed so far, and the segments they must not cross."""

    def __init__(self, segments: np.ndarray):
        self.segments = segments
        self.texts: list[Text] = []
        self.boxes: list[np.ndarray] = []
        self.bounds: list[tuple[float, float, float, float]] = []
        self.leaders: list[Polyline] = []

    def put(self, text: Text, leader: np.ndarray | None = None) -> bool:
        """Take the text, and its leader (2, 2), as placed; False when they touch anything."""
        box = text_box(text)
        bound = (*box.min(axis=0).tolist(), *box.max(axis=0).tolist())
        left, low, right, high = bound
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
        if _crossed(box, self.segments, CLEARANCE):
            return False
        if leader is not None:
            if any(_crossed(other, leader[None], 0.1) for other in self.boxes):
                return False
            self.leaders.append(Polyline(as_points(leader), "narrow"))
            self.segments = np.concatenate([self.segments, leader[None]])
        self.texts.append(text)
        self.boxes.append(box)
        self.bounds.append(bound)
        return True


def _crossed(box: np.ndarray, segments: np.ndarray, clearance: float) -> bool:
    """True when a segment (n, 2, 2) meets the rectangle grown by `clearance` (slab clipping)."""
    if not len(segments):
        return False
    along, up = box[1] - box[0], box[3] - box[0]
    size = np.array([np.hypot(*along), np.hypot(*up)])
    axes = np.column_stack([along / size[0], up / size[1]])
    local = (segments - box[0]) @ axes
    start, step = local[:, 0], local[:, 1] - local[:, 0]
    low, high = -clearance - start, size + clearance - start
    with np.errstate(divide="ignore", invalid="ignore"):
        enter, leave = low / step, high / step
    enter, leave = np.minimum(enter, leave), np.maximum(enter, leave)
    still = step == 0.0
    inside = (low <= 0.0) & (high >= 0.0)
    enter = np.where(still, np.where(inside, -np.inf, np.inf), enter)
    leave = np.where(still, np.where(inside, np.inf, -np.inf), leave)
    first = np.maximum(enter.max(axis=1), 0.0)
    last = np.minimum(leave.min(axis=1), 1.0)
    return bool(np.any(first <= last))


def pattern_block(plate: DevelopedPlate, scale: float) -> Block:
    """The plate's pattern at 1:scale with caption, labels, folds and overall dimensions."""
    corner = np.concatenate(plate.outline).min(axis=0)
    outline = [simplified(run - corner, DRAWN_TOLERANCE * scale) for run in plate.outline]
    stations = [np.asarray(line.flat, float) - corner for line in plate.lines]
    folds = [np.asarray(fold.flat, float) - corner for fold in plate.folds]
    named = {fold.label for fold in plate.folds}  # folds are among the measuring lines as well
    polylines = (
        *(Polyline(as_points(run), "wide") for run in outline),
        *(
            Polyline(as_points(ends), "narrow")
            for line, ends in zip(plate.lines, stations, strict=True)
            if line.label not in named
        ),
        *(Polyline(as_points(fold), "dashed") for fold in folds),
    )
    edges = np.concatenate([np.stack([run[:-1], run[1:]], axis=1) for run in outline])
    rulings = np.array(stations + folds).reshape(-1, 2, 2)
    crosses = _cross(np.zeros(2), 1.6)
    for point in plate.points:
        if point.kind == "witness":
            crosses += _cross((np.asarray(point.flat, float) - corner) / scale, 0.5)
    labels = _Labels(
        np.concatenate([edges / scale, rulings / scale, [line.points for line in crosses]])
    )
    size = np.concatenate(plate.outline).max(axis=0) - corner
    left_out = _label_points(plate, labels, corner, scale)
    middle = size / 2.0 / scale
    for fold, ends in zip(plate.folds, folds, strict=True):
        text = f"{fold.label} {np.degrees(fold.angle):.1f}°".replace("-0.0°", "0.0°")
        left_out += not (
            _label_along(labels, text, ends / scale, None)
            or _label_beyond(labels, text, ends[0] / scale, ends[1] / scale)
        )
    for line, ends in zip(plate.lines, stations, strict=True):
        if line.label in named:
            continue
        outer = middle if line.label.startswith("E-") else None
        left_out += not (
            _label_along(labels, line.label, ends / scale, outer)
            or _label_beyond(labels, line.label, ends[0] / scale, ends[1] / scale)
            or _label_beyond(labels, line.label, ends[1] / scale, ends[0] / scale)
        )
    lines = [*labels.leaders, *crosses]
    bounds = np.array([*labels.bounds, (0.0, 0.0, *(size / scale))])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    dimensions, figures = _dimensions(size, scale, low[1] - 5.5, high[0] + 5.5)
    caption = _caption(plate, left_out, min(low[0], 0.0), high[1] + 2.5, max(size[0] / scale, 90.0))
    texts = (*labels.texts, *figures, *caption)
    boxes = np.array([[*text_box(text).min(axis=0), *text_box(text).max(axis=0)] for text in texts])
    box = (
        float(min(boxes[:, 0].min(), 0.0)),
        float(min(boxes[:, 1].min(), low[1] - 7.0)),
        float(max(boxes[:, 2].max(), high[0] + 7.0)),
        float(boxes[:, 3].max()),
    )
    view = View(plate.mark, float(scale), (0.0, 0.0), polylines)
    return Block(plate.mark, view, (*lines, *dimensions), texts, box)


def _label_points(plate: DevelopedPlate, labels: _Labels, corner, scale: float) -> int:
    """P labels beyond the ends of their lines, on leaders where crowded; the number that found no
    room."""
    left_out = 0
    lines = {line.label: np.asarray(line.flat, float) - corner for line in plate.lines}
    for point in plate.points:
        if point.kind != "arris" or point.line not in lines:
            continue
        ends = lines[point.line]
        flat = np.asarray(point.flat, float) - corner
        near = int(np.argmin(np.hypot(*(ends - flat).T)))
        left_out += not _label_beyond(
            labels, point.label, ends[near] / scale, ends[1 - near] / scale
        )
    return left_out


def _label_beyond(labels: _Labels, label: str, end: np.ndarray, far: np.ndarray) -> bool:
    """A level label beyond `end` of the line from `far`; False when there is no room."""
    away = end - far
    length = np.hypot(*away)
    if length == 0.0:
        return False
    away = away / length
    half = np.array([text_width(label, LABEL_HEIGHT), LABEL_HEIGHT * 1.32]) / 2.0
    reach = float(np.abs(away) @ half) if abs(away[0]) > 0.5 else half[1] / abs(away[1])
    for gap in TIERS:
        for side in (0.0, -1.0, 1.0) if gap == TIERS[0] else (0.0,):
            middle = end + away * (gap + reach) + (side * half[0], 0.0)
            text = Text(
                float(middle[0]),
                float(middle[1] - LABEL_HEIGHT / 2.0 + 0.16 * LABEL_HEIGHT),
                LABEL_HEIGHT,
                label,
                anchor="middle",
            )
            leader = np.array([end + away * 0.5, end + away * (gap - 0.2)])
            if labels.put(text, leader if gap > TIERS[0] else None):
                return True
    return False


def _label_along(labels: _Labels, label: str, ends: np.ndarray, outer) -> bool:
    """A label beside a line, parallel to it; on the side away from `outer` when that is given."""
    direction = ends[1] - ends[0]
    length = np.hypot(*direction)
    width = text_width(label, LABEL_HEIGHT)
    if length < width + 2 * CLEARANCE:
        return False
    direction = direction / length
    if direction[1] < -1e-9 or (abs(direction[1]) <= 1e-9 and direction[0] < 0.0):
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


def _cross(center: np.ndarray, arm: float) -> list[Polyline]:
    """The origin u = v = 0, or a witness mark, as an upright cross."""
    return [
        Polyline(as_points(np.array([center - step, center + step])), "narrow")
        for step in np.diag((arm, arm))
    ]


def _dimensions(size, scale: float, y: float, x: float) -> tuple[list[Polyline], list[Text]]:
    """Overall length below the pattern at height y, overall width right of it at x."""
    length, width = float(size[0]) / scale, float(size[1]) / scale
    lines = [
        Polyline(((-1.5, y), (length + 1.5, y))),
        Polyline(((x, -1.5), (x, width + 1.5))),
        *(Polyline(((end, y - 1.5), (end, y + 3.0))) for end in (0.0, length)),
        *(Polyline(((x - 3.0, end), (x + 1.5, end))) for end in (0.0, width)),
        *(Polyline(((end - 1.0, y - 1.0), (end + 1.0, y + 1.0)), "medium") for end in (0, length)),
        *(Polyline(((x - 1.0, end - 1.0), (x + 1.0, end + 1.0)), "medium") for end in (0, width)),
    ]
    texts = [
        Text(length / 2.0, y + 0.9, CAPTION_HEIGHT, f"{size[0]:.1f}", anchor="middle"),
        Text(x - 0.9, width / 2.0, CAPTION_HEIGHT, f"{size[1]:.1f}", 90.0, "middle"),
    ]
    return lines, texts


def _caption(plate: DevelopedPlate, left_out: int, x: float, y: float, room: float) -> list[Text]:
    """Mark, plate, size, mass and side, above the pattern in one line or two."""
    parts = (
        f"PL {plate.thickness:g}  {plate.material}".rstrip(),
        f"{plate.length:.1f} × {plate.width:.1f}",
        f"{plate.mass:.1f} kg",
        f"face {plate.face}, seen from {plate.marking_face} (marking face)"
        + (f"; labels left out: {left_out}, see the point table" if left_out else ""),
    )
    start = x + text_width(plate.mark, MARK_HEIGHT) + 5.0
    whole = "    ".join(parts)
    if text_width(whole, CAPTION_HEIGHT) <= room - (start - x):
        return [
            Text(x, y, MARK_HEIGHT, plate.mark),
            Text(start, y, CAPTION_HEIGHT, whole),
        ]
    return [
        Text(x, y + 4.6, MARK_HEIGHT, plate.mark),
        Text(start, y + 4.6, CAPTION_HEIGHT, "    ".join(parts[:3])),
        Text(x, y, CAPTION_HEIGHT, parts[3]),
    ]
