# SPDX-License-Identifier: LGPL-2.1-or-later
"""Marks on the faces of plates: punches, lines and texts, carried into the flat pattern."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import BendTorsionError, Finding, error
from ..geometry.vectors import lengths
from ..lofting import FlatMark
from .openings import face_spot
from .plate_places import PlateMark, nearest_places, places_along, surface_point
from .plates import Plate

LONGEST_STEP = 20.0
"""mm; points along a marked line are no farther apart."""

_READING = 10.0  # mm of a text's direction that are carried into the pattern
_NUMBER = r"([0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_LINE = re.compile(
    rf"line\s+{_NUMBER}(?:\s+([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))\s*deg)?", re.IGNORECASE
)


@dataclass(frozen=True)
class FaceMark:
    """A mark asked for: on a face, at s (mm, or a ratio of the axis length), offset mm from the
    middle of the plate's breadth towards its second edge.

    kind: `punch`, `line` (its middle there, `length` mm at `angle` rad from +s towards the second
    edge) or `text` (its middle there, reading along `angle`).
    """

    face: str
    s: float
    offset: float = 0.0
    kind: str = "punch"
    text: str = ""
    length: float = 0.0
    angle: float = 0.0
    s_is_ratio: bool = False


def mark_words(text: str) -> tuple[str, str, float, float]:
    """kind, text, length (mm) and angle (rad) of what a table says: `punch`, `line 200 90deg`, or
    a text. Raises BendTorsionError for a line without a length."""
    words = " ".join(str(text).split())
    if words.lower() == "punch":
        return "punch", "", 0.0, 0.0
    if match := _LINE.fullmatch(words):
        length, angle = float(match[1]), np.radians(float(match[2] or 0.0))
        if 0.0 < length < 1e5:
            return "line", "", length, float(angle)
    if not words or re.match(r"line\s+[-+.\d]", words, re.IGNORECASE):
        mend = "write punch, line 200, line 200 90deg, or a text"
        raise BendTorsionError(
            error("mark-text", words or "mark", "the mark cannot be read", mend, value=words)
        )
    return "text", words, 0.0, 0.0


def set_marks(
    member: str, plates: Sequence[Plate], length: float, given: Sequence[FaceMark]
) -> tuple[Plate, ...]:
    """The plates with the marks asked for added; raises BendTorsionError for marks that leave
    their plate."""
    findings: list[Finding] = []
    made = list(plates)
    for number, row in enumerate(given, start=1):
        source = f"mark {number}"
        found = face_spot(member, made, length, row, source, "mark")
        if isinstance(found, Finding):
            findings.append(found)
            continue
        index, at = found
        plate = made[index]
        reach = 0.5 * (row.length if row.kind == "line" else _READING)
        if row.kind == "punch":
            share = np.zeros(1)
        elif row.kind == "text":
            share = np.array([0.0, 2.0])
        else:
            share = np.linspace(-1.0, 1.0, 1 + max(2, int(np.ceil(row.length / LONGEST_STEP))))
        way = np.array([np.cos(row.angle), np.sin(row.angle)])
        wanted = reach * share[:, None] * way
        s, w, exact = places_along(plate.rails.mid, at.point, at.x, at.y, wanted, (at.s, at.w))
        on_plate = exact & (s >= plate.start) & (s <= plate.end) & (w >= 0.0) & (w <= 1.0)
        if row.kind == "text":
            on_plate = on_plate[:1]
        if not on_plate.all():
            outer = plate.rails.outer(np.array([at.s]))[0]
            findings.append(
                error(
                    "mark-outside",
                    member,
                    f"the mark leaves plate {plate.mark}",
                    "move it, or make it shorter",
                    position=source,
                    value=float(row.offset),
                    limit=float(0.5 * lengths(outer[3:] - outer[:3])),
                    unit="mm",
                )
            )
            continue
        mark = PlateMark(row.kind, row.text, np.column_stack([s, w]))
        made[index] = replace(plate, marks=(*plate.marks, mark))
    if findings:
        raise BendTorsionError(findings)
    return tuple(made)


def marks_on(plate: Plate, surface: str) -> tuple[PlateMark, ...]:
    """The plate's marks with their places on its `outer`, `mid` or `inner` surface instead of the
    middle's, along the plate's normals."""
    rails, moved = getattr(plate.rails, surface), []
    for mark in plate.marks:
        s, w = mark.places[:, 0].copy(), mark.places[:, 1].copy()
        feet = nearest_places(rails, surface_point(plate.rails.mid, s, w), (s, w))
        moved.append(PlateMark(mark.kind, mark.text, np.column_stack(feet)))
    return tuple(moved)


def flat_marks(plate: Plate, pattern) -> tuple[FlatMark, ...]:
    """The plate's marks in the pattern (`pattern.Pattern`)."""
    return tuple(
        FlatMark(
            mark.kind, mark.text, pattern.flat(mark.places[:, 0].copy(), mark.places[:, 1].copy())
        )
        for mark in plate.marks
    )
