# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bevels in DXF files: a text beside the edge for each stretch that is cut with one angle."""

from __future__ import annotations

import math

import numpy as np

from ..core.lofting import DevelopedPlate
from ..core.welds.bevel_record import EdgeBevel
from .dxf_labels import CHARACTER_WIDTH, SMALLEST_TEXT, Boxes
from .dxf_text import Pattern

_INSET = 12.0
"""mm; the text stands this far inside the edge."""


def bevel_text(bevel: EdgeBevel, marking_face: str, thickness: float) -> str:
    """Such as `40.0 deg up land 6`: cut back by 40 degrees at the marking face (`down`: at the
    other), 6 mm left as they are; `45.0/45.0 deg up/down land 2` for both faces; `30.0 deg down
    land 2, chamfer 1:4 16x4 up` with a chamfer 16 mm long and 4 mm deep at the marking face;
    `square, open 50.0 deg up` of a side cut square that stands 50 degrees off the wall it is welded
    to, farther from it along the marking face."""
    if bevel.opening[1]:
        return opening_text(bevel)
    groove, chamfer = _groove(bevel, marking_face, thickness), chamfer_text(bevel, marking_face)
    return ", ".join(filter(None, (groove, chamfer)))


def opening_text(bevel: EdgeBevel) -> str:
    """Such as `square, open 50.0 deg up`; empty without an opening."""
    angle, way = bevel.opening
    return f"square, open {_degrees(angle)} deg {way}" if way else ""


def chamfer_text(bevel: EdgeBevel, marking_face: str) -> str:
    """Such as `chamfer 1:4 16x4 up`: slope, length and depth, face; empty without a chamfer."""
    chamfer = bevel.chamfer
    if chamfer is None:
        return ""
    ways = {"both": "up/down", _face_above(marking_face): "up"}.get(chamfer.faces, "down")
    size = f"{round(chamfer.length, 1):g}x{round(chamfer.depth, 1):g}"
    return f"chamfer 1:{round(chamfer.slope, 1):g} {size} {ways}"


def _face_above(marking_face: str) -> str:
    return "inner" if marking_face == "inside" else "outer"


def _groove(bevel: EdgeBevel, marking_face: str, thickness: float) -> str:
    inside = _face_above(marking_face) == "inner"
    up, down = (bevel.inner, bevel.outer) if inside else (bevel.outer, bevel.inner)
    land = bevel.land(thickness)
    if not up[1] and not down[1]:
        if not bevel.natural and bevel.chamfer:
            return ""
        tilt = bevel.natural if inside else -bevel.natural
        return f"{_degrees(abs(tilt))} deg {'up' if tilt > 0.0 else 'down'}"
    given = [(way, one[0]) for way, one in (("up", up), ("down", down)) if one[1]]
    angles = "/".join(_degrees(angle) for _, angle in given)
    ways = "/".join(way for way, _ in given)
    return f"{angles} deg {ways}" + (f" land {land:g}" if land > 0.05 else "")


def edge_texts(plate: DevelopedPlate) -> str:
    """All bevels of a plate in words: `left 0-1520: 45.0 deg down land 6; ...`, places on the axis
    in mm; empty of a plate without."""
    return "; ".join(
        f"{bevel.edge} {bevel.start:.0f}-{bevel.end:.0f}: "
        + bevel_text(bevel, plate.marking_face, plate.thickness)
        for bevel in plate.bevels
    )


def add_bevel_texts(
    drawn: Pattern, plate: DevelopedPlate, layer: str, centre, height: float
) -> None:
    """The texts, each along its stretch of the edge, half the height of other marks."""
    for bevel in plate.bevels:
        text = bevel_text(bevel, plate.marking_face, plate.thickness)
        boxes = beside_edge(text, plate, bevel, centre, 0.5 * height)
        if boxes is not None:
            drawn.text(text, boxes, layer)


def beside_edge(
    text: str, plate: DevelopedPlate, bevel: EdgeBevel, centre, height: float
) -> Boxes | None:
    """Places of a text beside the stretch of a bevel, on the side of `centre`; None beside one
    shorter than 1 mm."""
    ends = _place(plate, bevel)
    way = ends[1] - ends[0]
    reach = float(np.hypot(*way))
    if reach < 1.0:
        return None
    way = way / reach
    inward = np.array([-way[1], way[0]])
    if float(((centre - ends[0]) * inward).sum()) < 0.0:
        inward = -inward
    return _boxes(len(text), ends[0], way, reach, inward, height)


_STEPS = np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9])


def _boxes(letters: int, start, way, reach: float, inward, height: float) -> Boxes:
    """Places of a text of so many letters beside a stretch of an edge, its middle wanted first."""
    letters *= CHARACTER_WIDTH
    size = min(height, 0.7 * reach / letters)
    beside = size >= SMALLEST_TEXT
    # Beside a short stretch the text runs into the plate.
    sizes = [round(max(SMALLEST_TEXT, size * part), 1) for part in (1.0, 0.7)]
    size, step = (grid.ravel() for grid in np.meshgrid(sizes, _STEPS, indexing="ij"))
    middles = start + (step * reach)[:, None] * way + _INSET * inward
    if beside:
        room = (step == 0.5) | (np.minimum(step, 1.0 - step) * reach >= 0.5 * letters * size)
        size, middles = size[room], middles[room]
        reading = way
    else:
        middles = middles + (0.5 * letters * size)[:, None] * inward
        reading = inward
    if reading[0] < -1e-6 or (reading[0] < 1e-6 and reading[1] < 0.0):
        reading = -reading
    up = np.array([-reading[1], reading[0]])
    corners = middles - (0.5 * letters * size)[:, None] * reading - (0.5 * size)[:, None] * up
    return Boxes(corners, np.tile(reading, (len(size), 1)), letters * size, size, size)


def _place(plate: DevelopedPlate, bevel: EdgeBevel) -> np.ndarray:
    """(2, 2) a chord of the stretch, between measuring lines where it is long enough."""
    if bevel.side == "wall":
        return plate.side_ends(bevel.edge)
    if bevel.side in ("start", "end"):
        line = plate.lines[0 if bevel.side == "start" else -1]
        parts = np.array([[bevel.start], [bevel.end]]) / line.length_3d
        return line.flat[0] + parts * (line.flat[1] - line.flat[0])
    number = 0 if bevel.side == "first" else 1
    s = np.array([line.s for line in plate.lines])
    flat = np.array([line.flat[number] for line in plate.lines])
    places = [bevel.start, *s[(s > bevel.start) & (s < bevel.end)], bevel.end]
    lengths = np.diff(places)
    # The first of the long fields: equal lengths may differ in their last bits.
    k = int(np.flatnonzero(lengths >= lengths.max() - 1.0)[0])
    at = np.array(places[k : k + 2])
    return np.column_stack([np.interp(at, s, flat[:, j]) for j in (0, 1)])


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.1f}"
