# SPDX-License-Identifier: LGPL-2.1-or-later
"""Openings and marks asked for in DXF files of flat patterns."""

from __future__ import annotations

import numpy as np

from ..core.geometry.arc_contour import inside, polygon
from ..core.lofting import DevelopedPlate
from ..core.patterns.inner_contours import hole_contour, line_stroke
from .dxf_labels import CHARACTER_WIDTH, Boxes
from .dxf_text import Pattern


def add_holes(drawn: Pattern, plate: DevelopedPlate, layer: str, tolerance: float) -> None:
    """The openings, one closed polyline each."""
    for hole in plate.holes:
        contour = hole_contour(hole, tolerance)
        drawn.space.add_polyline(contour, layer)
        drawn.room.add_hole(contour)


def clear_fields(plate: DevelopedPlate, fields: list) -> list:
    """Those of the fields, pairs of (2, 2) lines, that no opening reaches into; all if there are
    none."""
    rings = [np.concatenate(hole.runs) for hole in plate.holes]
    clear = [
        (a, b)
        for a, b in fields
        if not any(inside(polygon(np.array([*a, *b[::-1]])), ring).any() for ring in rings)
    ]
    return clear or fields


def add_face_marks(
    drawn: Pattern, plate: DevelopedPlate, lines: str, punches: str, tolerance: float
) -> None:
    """Marked lines and punches on their layers."""
    for mark in plate.marks:
        if mark.kind == "punch":
            drawn.space.add_point(mark.flat[0], punches)
        elif mark.kind == "line":
            drawn.arcs(line_stroke(mark, tolerance), lines, close=False)


def add_face_texts(
    drawn: Pattern, plate: DevelopedPlate, centre, height: float, layer: str
) -> None:
    """The texts asked for, about their places, and those of marked lines."""
    for mark in plate.marks:
        first, last = mark.flat[0], mark.flat[-1]
        if mark.kind == "line":
            ends = np.array([first, last])
            drawn.line_text(mark.text, ends, centre, 0.6 * height, layer, 0.35)
        elif mark.kind == "text":
            drawn.text(mark.text, about(mark.text, first, last, height), layer)


def about(text: str, place: np.ndarray, towards: np.ndarray, height: float) -> Boxes:
    """The one box of a text with its middle at a place, reading towards another."""
    reading = (towards - place) / np.hypot(*(towards - place))
    wide = len(text) * CHARACTER_WIDTH * height
    up = np.array([-reading[1], reading[0]])
    corner = place - 0.5 * wide * reading - 0.5 * height * up
    sizes = np.array([height])
    return Boxes(corner[None], reading[None], np.array([wide]), sizes, sizes)
