# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels in the 3D view: marks of plates, station lines with their `L`, points with their `P`."""

from __future__ import annotations

import numpy as np
from pivy import coin

from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.gui.label_layer import CORNERS, Label

MARK_LIFT = 0.15
"""A mark floats above the middle of its plate by this part of the plate's width, so that it is
seen from outside; from behind it is left out."""
POINT_LIFT = 12.0
BESIDE = 0.12
"""The name of a line stands this part of the way to the next line behind it."""
MARK_COLOURS = ("1 1 1", "0.1 0.2 0.32")
LINE_COLOURS = ("0.08 0.2 0.35", "0.85 0.92 1")
POINT_COLOURS = ("0.3 0.05 0.05", "1 0.93 0.85")
"""Of text and of the ground it stands on, to be read on light and dark views."""


def mark_labels(obj, middles) -> list[Label]:
    """The mark of each plate of a PlateSet beside the middle of its outer face; middles: (place,
    outward) of each, as `plate_middles.middle`."""
    labels = []
    for mark, (place, outward), solid in zip(obj.Marks, middles, obj.Shape.Solids, strict=False):
        at, direction = np.array(tuple(place)), np.array(tuple(outward))
        room = solid.BoundBox.DiagonalLength
        lifted = at + MARK_LIFT * direction
        normal = unit(direction)
        # Plates of an edge have their middles close together; every one of them is to be told.
        corners = len(CORNERS)
        labels.append(Label(mark, lifted, MARK_COLOURS, 15, room, normal=normal, corners=corners))
    return labels


def unit(direction: np.ndarray) -> np.ndarray:
    """A direction as long as 1."""
    return direction / max(float(np.linalg.norm(direction)), 1e-12)


def point_labels(record: MemberRecord) -> tuple[coin.SoSeparator | None, list[Label]]:
    """The station lines of the plates, on their outer faces, and the labels of lines and points;
    lines before points, as far apart as their neighbours."""
    ends, labels = [], []
    for plate in record.plates:
        normal = plate.placing[2, :3]
        lift = POINT_LIFT * normal
        arris = [point for point in plate.points if point.kind == "arris"]
        room = min(plate.length / max(len(plate.lines) - 1, 1), plate.width)
        labels += [
            Label(p.label, p.xyz + lift, POINT_COLOURS, 8, room, 2, normal=normal) for p in arris
        ]
        pairs = {
            line.label: [point.xyz + lift for point in arris if point.line == line.label]
            for line in plate.lines
        }
        pairs = {name: np.array(pair) for name, pair in pairs.items() if len(pair) == 2}
        ends += [point for pair in pairs.values() for point in pair]
        middles = np.array([pair.mean(axis=0) for pair in pairs.values()]).reshape(-1, 3)
        labels += [
            Label(name, place, LINE_COLOURS, 8, room, 1, normal=normal)
            for name, place in zip(pairs, beside(middles), strict=True)
        ]
    return (_lines(np.array(ends)) if ends else None), labels


def beside(middles: np.ndarray) -> np.ndarray:
    """Places (n, 3) a little behind the middles of lines, so that no line goes through its name."""
    if len(middles) < 2:
        return middles
    steps = np.diff(middles, axis=0)
    return middles + BESIDE * np.concatenate([steps, steps[-1:]])


def _lines(ends: np.ndarray) -> coin.SoSeparator:
    """Straight lines between pairs of (2n, 3) points."""
    group = coin.SoSeparator()
    colour = coin.SoBaseColor()
    colour.rgb.setValue(0.08, 0.2, 0.35)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(ends), ends.tolist())
    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, len(ends) // 2, [2] * (len(ends) // 2))
    for node in (colour, coordinates, lines):
        group.addChild(node)
    return group
