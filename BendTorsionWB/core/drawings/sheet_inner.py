# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels of what lies within a pattern: openings with their size and place, texts of marks."""

from __future__ import annotations

import numpy as np

from ..lofting import DevelopedPlate, FlatHole
from .sheet import Polyline, Text
from .sheet_labels import LABEL_HEIGHT, Labels, as_points, label_along, label_beyond
from .sheet_style import SheetStyle


def hole_middle(hole: FlatHole) -> np.ndarray:
    """Middle (2,) of the bounding box of an opening."""
    points = np.concatenate(hole.runs)
    return 0.5 * (points.min(axis=0) + points.max(axis=0))


def label_inner(
    plate: DevelopedPlate, labels: Labels, corner, scale: float, style: SheetStyle
) -> int:
    """Openings with their size and the u, v of their middle, and the texts of marks; the number
    that found no room."""
    left_out = 0
    outline = (np.concatenate(plate.outline) - corner) / scale
    for hole in plate.holes:
        middle = hole_middle(hole) - corner
        place = ", ".join(map(style.fine, middle.tolist()))
        text = f"{hole.label} {style.shape(hole.title)} {style.say('at')} {place}"
        x, y = middle / scale
        high = 0.5 * float(np.ptp(np.concatenate(hole.runs)[:, 1])) / scale
        left_out += not any(
            labels.put(Text(float(x), float(y + up), LABEL_HEIGHT, text, 0.0, "middle"))
            for up in (1.4, -3.2, high + 1.0, -high - 2.8, high + 4.0, -high - 5.8)
        ) and not _label_outside(labels, text, middle / scale, outline)
    for mark in plate.marks:
        if not mark.text:
            continue
        ends = (mark.flat[[0, -1]] - corner) / scale
        if mark.kind == "line":
            left_out += not (
                label_along(labels, mark.text, ends, None)
                or label_beyond(labels, mark.text, ends[0], ends[1])
                or label_beyond(labels, mark.text, ends[1], ends[0])
            )
            continue
        reading = ends[1] - ends[0]
        angle = float(np.degrees(np.arctan2(reading[1], reading[0])))
        x, y = ends[0]
        left_out += not any(
            labels.put(Text(float(x), float(y + up), LABEL_HEIGHT, mark.text, angle, "middle"))
            for up in (-0.5 * LABEL_HEIGHT, 1.5, -3.5)
        ) and not _label_outside(labels, mark.text, ends[0], outline)
    return left_out


def _label_outside(labels: Labels, label: str, start: np.ndarray, outline: np.ndarray) -> bool:
    """A level label above or below the pattern, with a leader from `start` within it."""
    for aside in (0.0, 3.5, -3.5, 7.0, -7.0):
        across = start[0] + aside
        near = outline[np.argsort(np.abs(outline[:, 0] - across))[:6], 1]
        for edge in (near.max(), near.min()):
            end, far = np.array([across, edge]), np.array([across, start[1]])
            leader = np.array([start, end])
            if abs(edge - start[1]) <= 0.5 or not labels.clear_of_texts(leader[None]):
                continue
            if label_beyond(labels, label, end, far):
                labels.leaders.append(Polyline(as_points(leader), "narrow"))
                labels.keep_off(leader[None])
                return True
    return False
