# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels in the 3D view: marks of plates, station lines with their `L`, points with their `P`."""

from __future__ import annotations

import numpy as np
from pivy import coin

from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord

MARK_LIFT = 0.15
"""A mark floats above the middle of its plate by this part of the plate's width, so that it is
seen from outside and hidden by the member from behind."""
POINT_LIFT = 12.0
MARK_COLOURS = ("1 1 1", "0.1 0.2 0.32")
LINE_COLOURS = ("0.08 0.2 0.35", "0.85 0.92 1")
POINT_COLOURS = ("0.3 0.05 0.05", "1 0.93 0.85")
"""Of text and of the ground it stands on, to be read on light and dark views."""


def mark_labels(record: MemberRecord) -> coin.SoSeparator:
    """The mark of each plate beside the middle of its outer face."""
    group = coin.SoSeparator()
    for plate in record.plates:
        group.addChild(label(plate.mark, _middle(plate), MARK_COLOURS, 15))
    return group


def point_labels(record: MemberRecord) -> coin.SoSeparator:
    """The station lines of the plates, on their outer faces, and the labels of lines and points."""
    group = coin.SoSeparator()
    ends, texts = [], []
    for plate in record.plates:
        lift = POINT_LIFT * plate.placing[2, :3]
        arris = [point for point in plate.points if point.kind == "arris"]
        texts += [(p.label, p.xyz + lift, POINT_COLOURS) for p in arris]
        for line in plate.lines:
            pair = [point.xyz + lift for point in arris if point.line == line.label]
            if len(pair) == 2:
                ends += pair
                texts.append((line.label, 0.5 * (pair[0] + pair[1]), LINE_COLOURS))
    if ends:
        group.addChild(_lines(np.array(ends)))
    for text, place, colours in texts:
        group.addChild(label(text, place, colours, 8, framed=False))
    return group


def label(text: str, place: np.ndarray, colours: tuple[str, str], size: int, framed=True):
    """Text at a place (3,), always facing the viewer, on a ground of its own (SoSeparator)."""
    made = coin.SoSeparator()
    move = coin.SoTranslation()
    move.translation.setValue(*map(float, place))
    made.addChild(move)
    frame = coin.SoType.fromName("SoFrameLabel").createInstance()
    frame.set(f'string "{text}" textColor {colours[0]} backgroundColor {colours[1]}')
    frame.set(f"size {size} frame {'TRUE' if framed else 'FALSE'}")
    made.addChild(frame)
    return made


def _middle(plate: DevelopedPlate) -> np.ndarray:
    """Above the middle of a plate's outer face."""
    arris = [point for point in plate.points if point.kind == "arris"]
    if not arris:
        return plate.centre_of_gravity
    s = 0.5 * (plate.s_start + plate.s_end)
    middle = min((point.line for point in arris), key=lambda line: _distance(arris, line, s))
    places = [point.xyz for point in arris if point.line == middle]
    return np.mean(places, axis=0) + MARK_LIFT * plate.width * plate.placing[2, :3]


def _distance(arris, line: str, s: float) -> float:
    return min(abs(point.s - s) for point in arris if point.line == line)


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
