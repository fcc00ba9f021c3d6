# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where texts of NC1 files stand: as those of DXF files, clear of lines, holes and each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..core.lofting import DevelopedPlate
from ..core.patterns.inner_contours import hole_contour, text_field
from .dxf_bevels import beside_edge, chamfer_text, opening_text
from .dxf_inner import about, clear_fields
from .dxf_labels import CHARACTER_WIDTH, Boxes, Room, along, blocks
from .nc1_text import ascii_text
from .plate_fields import centre_of, longest, panels

TEXT_HEIGHT = 12
"""mm, where the plate leaves room for it."""

_PUNCH = 2.0
"""mm; half the size of what is kept clear about a punch."""


class PlacedText(NamedTuple):
    """A text from its lower left corner (2,); angle: degrees; height: whole mm."""

    text: str
    corner: np.ndarray
    angle: float
    height: int


class LineLabel(NamedTuple):
    """A text beside a line (2, 2), from the part `at` of it on."""

    text: str
    flat: np.ndarray
    at: float


def placed_texts(
    plate: DevelopedPlate,
    outline: np.ndarray,
    strokes: Sequence[np.ndarray],
    punches: Sequence[np.ndarray],
    labels: Sequence[LineLabel],
) -> list[PlacedText]:
    """The mark of a plate as it is cut, these labels, the texts asked for, and its chamfers.

    outline (m, 3): of the file, as the arcs of strokes, which are marked; punches: places (2,).
    """
    room = Room()
    room.add_contour(outline)
    room.stay_inside(outline)
    for hole in plate.holes:
        room.add_hole(hole_contour(hole))
    for stroke in strokes:
        room.add_contour(stroke, close=False)
    for u, v in punches:
        room.add_lines(np.array([[[u - _PUNCH, v], [u + _PUNCH, v]]]))
        room.add_lines(np.array([[[u, v - _PUNCH], [u, v + _PUNCH]]]))
    centre = centre_of(plate)
    asked = []
    # Those that stand where they were asked for come first: the others keep clear of them.
    for mark in plate.marks:
        if mark.text and mark.kind != "line":
            text = ascii_text(mark.text)
            boxes = about(text, mark.flat[0], _towards(mark.flat), TEXT_HEIGHT)
            asked.append(_placed(room, text, boxes))
    found = [_mark(room, plate), *asked]
    for label in labels:
        found.append(_beside(room, label, centre))
    for mark in plate.marks:
        if mark.text and mark.kind == "line":
            label = LineLabel(mark.text, np.array([mark.flat[0], mark.flat[-1]]), 0.35)
            found.append(_beside(room, label, centre))
    for bevel in plate.bevels:
        words = chamfer_text(bevel, plate.marking_face) or opening_text(bevel)
        if words:
            text = f"{bevel.edge} {words}"
            boxes = beside_edge(text, plate, bevel, centre, TEXT_HEIGHT)
            if boxes is not None:
                found.append(_placed(room, text, boxes))
    return found


def _mark(room: Room, plate: DevelopedPlate) -> PlacedText:
    text = ascii_text(plate.mark)
    fields = longest(clear_fields(plate, panels(plate))) or [text_field(plate)]
    low, high = (line.mean(axis=0) for line in fields[0])
    reading = (high - low) / np.hypot(*(high - low))
    reading = reading if reading[0] >= 0.0 else -reading
    boxes = blocks(len(text) * CHARACTER_WIDTH, 1.0, TEXT_HEIGHT, reading, fields)
    return _placed(room, text, boxes)


def _beside(room: Room, label: LineLabel, centre: np.ndarray) -> PlacedText:
    text = ascii_text(label.text)
    boxes = along(text, label.flat[0], label.flat[1], centre, TEXT_HEIGHT, label.at)
    return _placed(room, text, boxes)


def _placed(room: Room, text: str, boxes: Boxes) -> PlacedText:
    k = room.clear(boxes)
    angle = math.degrees(math.atan2(boxes.reading[k, 1], boxes.reading[k, 0]))
    return PlacedText(text, boxes.corners[k], angle, int(boxes.text[k]))


def _towards(flat: np.ndarray) -> np.ndarray:
    return flat[-1] if len(flat) > 1 and np.hypot(*(flat[-1] - flat[0])) else flat[0] + (1.0, 0.0)
