# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts of flat patterns, each where there is room for it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .dxf_file import Space
from .dxf_labels import Boxes, Room, along, blocks

LINE_PITCH = 1.6
"""Distance of text lines over their height."""


@dataclass
class Pattern:
    """A flat pattern as it is drawn: its entities and the room left for texts."""

    space: Space
    room: Room = field(default_factory=Room)

    def line(self, start, end, layer: str) -> None:
        """A straight line texts keep clear of."""
        self.space.add_line(start, end, layer)
        self.room.add_lines(np.array([[start, end]]))

    def arcs(self, arcs: np.ndarray, layer: str, close: bool = True) -> None:
        """A polyline of arcs (m, 3) texts keep clear of; a single chord is a line."""
        if len(arcs) == 2 and not arcs[:, 2].any():
            self.line(arcs[0, :2], arcs[1, :2], layer)
            return
        self.space.add_polyline(arcs, layer, close)
        self.room.add_contour(arcs, close)

    def text(self, text: str, boxes: Boxes, layer: str) -> None:
        """A text in the first of the boxes with room, else where it disturbs least."""
        if not text:
            return
        k = self.room.clear(boxes)
        height = float(boxes.text[k])
        self.space.add_text(text, boxes.corners[k], boxes.reading[k], height, layer)

    def line_text(self, text: str, line, centre, height: float, layer: str, at: float) -> None:
        """Text beside a line (2, 2), beginning at the part `at` of it, on the side of `centre`."""
        if text:
            self.text(text, along(text, line[0], line[1], centre, height, at), layer)

    def block(self, rows, wide: float, height: float, reading, fields, layer: str, below: int = 0):
        """Rows of text, `below` rows left free under them. Returns the middle of the first row
        below, the direction up, and the height of the text."""
        high = (len(rows) + below) * LINE_PITCH
        boxes = blocks(wide, high, height, reading, fields)
        k = self.room.clear(boxes)
        size, up, corner = float(boxes.text[k]), boxes.up[k], boxes.corners[k]
        pitch = LINE_PITCH * size
        for row, text in enumerate(rows):
            rise = (len(rows) + below - row - 0.8) * pitch
            self.space.add_text(text, corner + rise * up, reading, size, layer)
        middle = corner + 0.5 * boxes.widths[k] * reading + 0.5 * pitch * up
        return middle, up, size
