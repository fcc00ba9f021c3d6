# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the faces and the corner lines of a delivery piece begin and end, skew ends included."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..members.member import Member
from .plates import Plate


def whole_faces(plates: Sequence[Plate]) -> dict[str, tuple[float, float]]:
    """The stretch each face is whole on between the ends of its plates, skew ones included."""
    found: dict[str, tuple[float, float]] = {}
    for plate in plates:
        before, behind = plate.cuts
        start = plate.start if before is None else before.range[1]
        end = plate.end if behind is None else behind.range[0]
        first, last = found.get(plate.face, (start, end))
        found[plate.face] = min(first, start), max(last, end)
    return found


def corner_ends(member: Member, plates: Sequence[Plate]) -> tuple[dict, dict]:
    """Where corner lines begin and end: those of plates that run to the corner, the farthest."""
    found: tuple[dict[int, float], dict[int, float]] = ({}, {})
    for plate in plates:
        strip = member.law.strips[plate.strip]
        before, behind = plate.cuts
        start, end = np.full(2, plate.start), np.full(2, plate.end)
        start = start if before is None else before.corners("outer")
        end = end if behind is None else behind.corners("outer")
        edges = ((strip.first, strip.stops_at_first), (strip.second, strip.stops_at_second))
        for side, (corner, stop) in enumerate(edges):
            if stop is None:
                first, last = found[0].get(corner, np.inf), found[1].get(corner, -np.inf)
                found[0][corner] = float(min(first, start[side]))
                found[1][corner] = float(max(last, end[side]))
    return found
