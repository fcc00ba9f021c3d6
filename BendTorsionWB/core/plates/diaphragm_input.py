# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms and end plates as they are asked for, and the words for their closing face."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..finding import BendTorsionError, error
from ..sections.section import Material
from .hole_shape import HoleShape

ENDS = ("start", "end")

SLOT_SIDE = 8.0
"""mm a slot is wider than its plate is thick (AISC 360 J2.3b)."""

SLOT_LENGTH = 100.0
"""mm."""

SLOT_PITCH = 2.5
"""Distance of slots along their line, over their length."""

_NUMBER = r"([0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_CLOSING = re.compile(
    rf"(\S+)\s+(?:(weld)(?:\s+{_NUMBER})?|(slot)(?:\s+{_NUMBER}\s*[x×]\s*{_NUMBER})?"
    rf"(?:\s*@\s*{_NUMBER})?)",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Closing:
    """How the face closed last is joined: `slot`, slots of length by breadth in its plate at the
    diaphragm, `pitch` apart (0: SLOT_LENGTH by the plate's thickness + SLOT_SIDE, SLOT_PITCH); or
    `weld`, the other three sides only, with a gap of its own there (None: that of the others)."""

    face: str
    kind: str
    length: float = 0.0
    breadth: float = 0.0
    pitch: float = 0.0
    gap: float | None = None


@dataclass(frozen=True)
class Diaphragm:
    """A diaphragm at s (mm, or a ratio of the axis length), or an end plate (end `start`/`end`).

    gap: to each wall; of an end plate to the section's outer faces, negative for an overhang.
    snipe: legs of the corners cut off. manhole: about the contour's centroid, moved by
    manhole_offset along breadth and height. material: None for that of the walls.
    """

    s: float
    thickness: float
    gap: float = 0.0
    snipe: float = 0.0
    manhole: HoleShape | None = None
    manhole_offset: tuple[float, float] = (0.0, 0.0)
    closing: Closing | None = None
    material: Material | None = None
    s_is_ratio: bool = False
    end: str = ""


def closing_of(text: str) -> Closing:
    """The closing of a text: `top weld`, `top weld 10`, `top slot`, `top slot 100x24 @ 250`."""
    words = " ".join(str(text).split())
    match = _CLOSING.fullmatch(words)
    if match and match[2]:
        return Closing(match[1], "weld", gap=float(match[3]) if match[3] else None)
    if match:
        length, breadth, pitch = (float(part or 0.0) for part in match.group(5, 6, 7))
        if match[5] is None or length > breadth > 0.0:
            return Closing(match[1], "slot", length, breadth, pitch)
    raise BendTorsionError(
        error(
            "diaphragm-closing",
            words or "closing face",
            "the closing face cannot be read",
            "write top weld, top weld 10, top slot, or top slot 100x24 @ 250",
            value=words,
        )
    )
