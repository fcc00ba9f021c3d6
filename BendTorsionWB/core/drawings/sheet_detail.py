# SPDX-License-Identifier: LGPL-2.1-or-later
"""Details of flat patterns: the stretches of a plate too crowded to be labelled, at a larger scale.

A member's patterns have one scale. Where measuring lines then lie too close for their labels, the
plate is drawn again in parts, each between two of its lines and as long as a page is wide.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..lofting import DevelopedPlate
from .sheet_overview import SCALES
from .sheet_pack import Block
from .sheet_pattern import pattern_block
from .sheet_style import SheetStyle

CROWDED = 9.0
"""mm on paper between measuring lines below which their labels find no room."""
CLEAR = 14.0
"""mm on paper between the lines of a detail, where a scale gives it."""
PAGE_ROOM = 40.0
"""mm of a page's height kept for the labels of a detail."""
LEAST_SPACING = 20.0
"""mm; lines closer than this are not what a detail's scale goes by."""


def detail_blocks(
    plates: Sequence[DevelopedPlate],
    scale: int,
    size: tuple[float, float],
    style: SheetStyle,
) -> dict[int, list[Block]]:
    """Scale -> details of plates whose labels found no room at 1:scale. size: of the page, mm."""
    found: dict[int, list[Block]] = {}
    for plate in plates:
        wanted = _scale(plate, scale, size[1])
        tries = [
            (one, room) for one in SCALES if wanted <= one < scale for room in (40.0, 70.0, 100.0)
        ]
        for one, room in tries:
            blocks = _details(plate, scale, one, size[0] - room, style)
            if all(wide <= size[0] and high <= size[1] for wide, high in (b.size for b in blocks)):
                found.setdefault(one, []).extend(blocks)
                break
    return dict(sorted(found.items(), reverse=True))


def _details(
    plate: DevelopedPlate, scale: int, larger: int, width: float, style: SheetStyle
) -> list[Block]:
    """The parts of a plate that are crowded at 1:scale, at 1:larger; all when none is."""
    parts = _parts(plate, larger, width)
    crowded = [part for part in parts if _closest(plate, *part) / scale < CROWDED]
    blocks = []
    for first, last in crowded or parts:
        names = plate.lines[first].label, plate.lines[last].label
        title = style.say("detail {} to {}", *names)
        blocks.append(pattern_block(_between(plate, first, last), larger, style, title))
    return blocks


def _gaps(plate: DevelopedPlate) -> np.ndarray:
    """Distances of neighbouring lines at their closer ends, mm."""
    ends = np.array([line.flat for line in plate.lines], float)
    step = ends[1:] - ends[:-1]
    return np.hypot(step[..., 0], step[..., 1]).min(axis=1)


def _closest(plate: DevelopedPlate, first: int, last: int) -> float:
    return float(_gaps(plate)[first:last].min())


def _scale(plate: DevelopedPlate, scale: int, high: float) -> int:
    """The smallest scale at which no two lines of a plate are too close, that its width allows."""
    gaps = _gaps(plate)
    spacing = float(gaps[gaps >= LEAST_SPACING].min(initial=math.inf))
    if not math.isfinite(spacing):
        return scale
    for larger in reversed([one for one in SCALES if one < scale]):
        if spacing / larger >= CLEAR:
            break
    else:
        larger = SCALES[0]
    across = max(line.length_flat for line in plate.lines)
    fitting = [one for one in SCALES if one >= larger and across / one <= high - PAGE_ROOM]
    return fitting[0] if fitting else scale


def _parts(plate: DevelopedPlate, scale: int, width: float) -> list[tuple[int, int]]:
    """First and last line of each part of a plate, as long as the width of a page allows."""
    middles = np.array([np.mean(line.flat, axis=0) for line in plate.lines])
    step = np.diff(middles, axis=0)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]))])
    count = max(1, math.ceil(along[-1] / scale / width))
    cuts = [int(np.argmin(np.abs(along - along[-1] * k / count))) for k in range(count + 1)]
    return [(a, b) for a, b in zip(cuts, cuts[1:], strict=False) if b > a]


def _between(plate: DevelopedPlate, first: int, last: int) -> DevelopedPlate:
    """The plate with what lies between two of its lines."""
    lines = plate.lines[first : last + 1]
    middle = np.mean([line.flat for line in lines], axis=(0, 1))
    inner = (k for k in (first, last) if 0 < k < len(plate.lines) - 1)
    bounds = [_towards(np.asarray(plate.lines[k].flat, float), middle) for k in inner]

    def inside(points: np.ndarray) -> bool:
        return all((np.mean(points, axis=0) - at) @ normal >= 0.0 for at, normal in bounds)

    outline = list(plate.outline)
    for at, normal in bounds:
        outline = [part for run in outline for part in _clipped(run, (run - at) @ normal)]
    names = {line.label for line in lines}
    low, high = lines[0].s, lines[-1].s
    data = plate.forming_data
    if data is not None:
        rolls = tuple(roll for roll in data.roll_lines if inside(roll.flat))
        data = replace(data, roll_lines=rolls)
    long = ("first", "second")
    return replace(
        plate,
        outline=tuple(outline),
        lines=lines,
        folds=tuple(fold for fold in plate.folds if fold.label in names),
        points=tuple(point for point in plate.points if point.line in names),
        holes=tuple(hole for hole in plate.holes if inside(np.concatenate(hole.runs))),
        marks=tuple(mark for mark in plate.marks if inside(mark.flat)),
        forming_data=data,
        bevels=tuple(
            bevel
            for bevel in plate.bevels
            if (bevel.side in long and bevel.end > low and bevel.start < high)
            or (bevel.side not in long and bevel.edge in names)
        ),
    )


def _towards(line: np.ndarray, middle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A point of a line (2, 2) and its normal towards a point."""
    along = line[1] - line[0]
    normal = np.array([-along[1], along[0]]) / np.hypot(*along)
    return line[0], normal if (middle - line[0]) @ normal > 0.0 else -normal


def _clipped(run: np.ndarray, side: np.ndarray) -> list[np.ndarray]:
    """The stretches of a run (n, 2) where `side` (n,) is positive, cut where it is zero."""
    kept = side > 0.0
    if kept.all() or not kept.any():
        return [run] if len(run) > 1 and kept.all() else []
    found, part = [], []
    side = side.tolist()
    for k in range(len(run)):
        if k and (side[k - 1] > 0.0) != (side[k] > 0.0):
            share = side[k - 1] / (side[k - 1] - side[k])
            part.append(run[k - 1] + share * (run[k] - run[k - 1]))
        if side[k] > 0.0:
            part.append(run[k])
        elif len(part) > 1:
            found.append(np.array(part))
            part = []
        else:
            part = []
    if len(part) > 1:
        found.append(np.array(part))
    return found
