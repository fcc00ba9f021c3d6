# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms at a node as drawn: their flat shapes with sizes and snipes, and where they stand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord
from ..nodes.node_ends import axis_at
from .sheet import Polyline, Text, View, text_box, text_width
from .sheet_inner import label_inner
from .sheet_labels import Labels, as_points, label_along, label_beyond, segments_of
from .sheet_node_joining import Joining, node_frame
from .sheet_pack import Block
from .sheet_pattern import DRAWN_TOLERANCE, dimensions, opening_text, simplified
from .sheet_style import SheetStyle, fixed
from .sheet_tables import Listing

DIAPHRAGMS = ("diaphragm", "t", "length", "width", "snipes", "openings", "mass, kg")
PLACES = ("diaphragm", "on face", "weld length", "x", "y", "z")
MARK = 2.5
SNIPE = 0.3
"""Of the shorter side beside it that a snipe takes at most."""


def inside(through: MemberRecord, joinings: Sequence[Joining]) -> list[DevelopedPlate]:
    """The diaphragms of the member that runs through between the ends of the branches' cuts."""
    ends = [end for own in joinings for end in own.ends]
    if not ends:
        return []
    node = joinings[0].node
    foot, along = axis_at(through, np.array([node.x, node.y, node.z]))
    places = [float(((corner - foot) * along).sum()) for e in ends for corner in e.corners]
    low, high = min(places), max(places)
    return [
        plate
        for plate in through.plates
        if plate.face == "diaphragm"
        and low <= float(((plate.centre_of_gravity - foot) * along).sum()) <= high
    ]


def corners(plate: DevelopedPlate) -> np.ndarray:
    """The corners (n, 2) of a flat part's outline, in order."""
    return np.array([run[0] for run in plate.outline])


def snipes(plate: DevelopedPlate) -> list[tuple[np.ndarray, tuple[float, float]]]:
    """Corners cut off between two sides that are welded to walls: the middle (2,) of each cut, and
    its legs along both sides, mm."""
    ring = corners(plate)
    count, found = len(ring), []
    walls = [side for side, _ in _sides(plate)]
    for k in range(count):
        before, after = (k - 1) % count, (k + 1) % count
        if k in walls or before not in walls or after not in walls:
            continue
        (a, b, c, d) = (ring[j % count] for j in (k - 1, k, k + 1, k + 2))
        u, v = b - a, c - d
        cross = u[0] * v[1] - u[1] * v[0]
        long = min(np.hypot(*u), np.hypot(*v))
        if abs(cross) < 1e-6 * np.hypot(*u) * np.hypot(*v) or np.hypot(*(c - b)) > SNIPE * long:
            continue
        # Where the two sides would meet.
        share = ((c - b)[0] * v[1] - (c - b)[1] * v[0]) / cross
        meet = b + share * u
        found.append((0.5 * (b + c), (float(np.hypot(*(meet - b))), float(np.hypot(*(meet - c))))))
    return found


def _sides(plate: DevelopedPlate) -> list[tuple[int, str]]:
    """Sides of the outline, from their corner on, that are welded, with the face of the wall."""
    ring = corners(plate)
    middles = 0.5 * (ring + np.roll(ring, -1, axis=0))
    back = np.linalg.inv(plate.flat_to_placing) @ plate.placing
    found = []
    for side in plate.welded:
        flat = (back[:2, :3] * side.middle).sum(axis=1) + back[:2, 3]
        found.append((int(np.argmin(((middles - flat) ** 2).sum(axis=1))), side.face))
    return found


def snipe_text(plate: DevelopedPlate, style: SheetStyle) -> str:
    """How many corners are cut off, with their legs: `4 × 30.0 × 30.0`."""
    sizes = [" × ".join(style.length(leg) for leg in legs) for _, legs in snipes(plate)]
    return ", ".join(f"{sizes.count(size)} × {size}" for size in dict.fromkeys(sizes))


def diaphragm_listing(plates: Sequence[DevelopedPlate], style: SheetStyle) -> Listing:
    """The diaphragms with their sizes, snipes, openings and mass."""
    rows = tuple(
        (
            plate.mark,
            style.thickness(plate.thickness),
            style.length(plate.length),
            style.length(plate.width),
            snipe_text(plate, style) or "–",
            ", ".join(style.shape(hole.title) for hole in plate.holes) or "–",
            fixed(plate.mass, 1),
        )
        for plate in plates
    )
    return Listing(style.say("Diaphragms inside"), style.headings(DIAPHRAGMS), rows, "<>>><<>")


def place_listing(
    through: MemberRecord,
    joinings: Sequence[Joining],
    plates: Sequence[DevelopedPlate],
    style: SheetStyle,
) -> Listing:
    """Where each diaphragm stands: the middle of each of its sides at a wall, at mid-thickness,
    from the node; of one without such sides its centre of gravity. Where a wall stands askew, what
    their square edges leave open."""
    node = joinings[0].node
    origin = np.array([node.x, node.y, node.z])
    frame = node_frame(through, origin)
    rows = []
    for plate in plates:
        openings = {bevel.edge: bevel.opening for bevel in plate.bevels if bevel.opening[1]}
        sides = [
            (style.say(one.face), one.length, one.middle, openings.get(one.edge))
            for one in plate.welded
        ]
        whole = (style.say("CG"), None, plate.centre_of_gravity, None)
        for face, long, middle, opening in sides or [whole]:
            place = ((middle - origin) * frame).sum(axis=1)
            size = "–" if long is None else style.length(long)
            edge = opening_text(*opening, style) if opening else style.say("square")
            rows.append((plate.mark, face, size, *map(style.length, place.tolist()), edge))
    title = style.say("Places of diaphragms from the node")
    columns, align = (*PLACES, "edge"), "<<>>>><"
    if all(row[-1] == style.say("square") for row in rows):
        columns, align, rows = PLACES, align[:-1], [row[:-1] for row in rows]
    return Listing(title, style.said(columns), tuple(rows), align)


def diaphragm_block(plate: DevelopedPlate, scale: int, style: SheetStyle) -> Block:
    """The flat shape of a diaphragm, seen from its marking face, with the faces of the walls its
    sides are welded to, snipes, openings and overall sizes."""
    corner = np.concatenate(plate.outline).min(axis=0)
    tolerance = DRAWN_TOLERANCE * scale
    outline = [simplified(run - corner, tolerance) for run in plate.outline]
    inner = [simplified(run - corner, tolerance) for hole in plate.holes for run in hole.runs]
    curves = [*outline, *inner]
    labels = Labels(segments_of(curves) / scale)
    ring = (corners(plate) - corner) / scale
    middle = ring.mean(axis=0)
    size = np.concatenate(outline).max(axis=0)
    cuts: dict[str, list[np.ndarray]] = {}
    for place, legs in snipes(plate):
        cuts.setdefault(" × ".join(map(style.length, legs)), []).append((place - corner) / scale)
    for text, places in cuts.items():
        count = f"{len(places)} × " if len(places) > 1 else ""
        any(label_beyond(labels, count + text, place, middle) for place in places)
    for k, face in _sides(plate):
        ends = ring[[k, (k + 1) % len(ring)]]
        # Inside, as dimensions stand about the shape.
        label_along(labels, style.say(face), ends, 2.0 * ends.mean(axis=0) - middle)
    label_inner(plate, labels, corner, scale, style)
    bounds = np.array([*labels.bounds, (0.0, 0.0, *(size / scale).tolist())])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    lines, figures = dimensions(size, scale, float(low[1]) - 5.5, float(high[0]) + 5.5, style)
    title = f"{plate.mark}  t {style.plate(plate.thickness)}  1:{scale}"
    texts = [*labels.texts, *figures, Text(float(low[0]), float(high[1]) + 2.5, MARK, title)]
    boxes = np.concatenate([text_box(text) for text in texts])
    lines = [*labels.leaders, *lines]
    drawn = np.concatenate([boxes, *(np.array(line.points) for line in lines)])
    (left, bottom), (right, top) = drawn.min(axis=0).tolist(), drawn.max(axis=0).tolist()
    polylines = (
        *(Polyline(as_points(run), "wide") for run in outline),
        *(Polyline(as_points(run), "medium") for run in inner),
    )
    view = View(plate.mark, float(scale), (0.0, 0.0), polylines)
    width = max(right, left + text_width(title, MARK))
    return Block("", (view,), tuple(lines), tuple(texts), (left, bottom - 1.0, width, top + 1.0))
