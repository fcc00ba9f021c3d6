# SPDX-License-Identifier: LGPL-2.1-or-later
"""Openings and marks asked for in DXF files of flat patterns, and the text of flat parts."""

from __future__ import annotations

import numpy as np

from ..core.geometry.arc_contour import inside, polygon
from ..core.lofting import DevelopedPlate
from ..core.patterns.inner_contours import hole_contour, line_stroke
from .dxf_text import CHARACTER_WIDTH, add_line_text, add_text, figure, place


def add_holes(space, plate: DevelopedPlate, layer: str, tolerance: float) -> None:
    """The openings, one closed polyline each."""
    for hole in plate.holes:
        _add_arcs(space, hole_contour(hole, tolerance), True, layer)


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
    space, plate: DevelopedPlate, layers: tuple[str, str, str], centre, height: float, tolerance
) -> None:
    """Lines with their texts, punches and texts; layers: of lines, of texts and of punches."""
    lines, texts, punches = ({"layer": layer} for layer in layers)
    for mark in plate.marks:
        first, last = mark.flat[0], mark.flat[-1]
        if mark.kind == "punch":
            space.add_point(place(first), dxfattribs=punches)
        elif mark.kind == "line":
            _add_arcs(space, line_stroke(mark, tolerance), False, lines["layer"])
            if mark.text:
                start = first + 0.35 * (last - first)
                add_line_text(space, mark.text, start, last, centre, 0.6 * height, texts)
        else:
            reading = (last - first) / np.hypot(*(last - first))
            half = 0.5 * len(mark.text) * CHARACTER_WIDTH * height
            up = np.array([-reading[1], reading[0]])
            corner = first - half * reading - 0.5 * height * up
            add_text(space, mark.text, corner, reading, height, texts)


def add_level_text(space, rows: tuple[str, ...], middle, height: float, pitch: float, layer: str):
    """Rows of text about a point, level, `pitch` text heights apart."""
    for row, text in enumerate(rows):
        half = 0.5 * len(text) * CHARACTER_WIDTH * height
        rise = (0.5 * (len(rows) - 1) - row) * pitch * height - 0.5 * height
        corner = middle + np.array([-half, rise])
        add_text(space, text, corner, np.array([1.0, 0.0]), height, {"layer": layer})


def _add_arcs(space, arcs: np.ndarray, close: bool, layer: str) -> None:
    attributes = {"layer": layer}
    if len(arcs) == 2 and not arcs[:, 2].any():
        space.add_line(place(arcs[0]), place(arcs[1]), dxfattribs=attributes)
        return
    vertices = [(figure(x), figure(y), round(float(b), 12) + 0.0) for x, y, b in arcs]
    space.add_lwpolyline(vertices, format="xyb", close=close, dxfattribs=attributes)
