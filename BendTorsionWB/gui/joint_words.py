# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joints of a face as one cell of text: `auto`, numbers, or nothing."""

from __future__ import annotations

import re

import FreeCAD

from BendTorsionWB.gui.typed_quantity import number_of

translate = FreeCAD.Qt.translate
BETWEEN = re.compile(r"(?<![-+*/(]) (?=[\d.])")
"""Before a number that goes on with no sum."""


def joints_text(plates, face: str) -> str:
    """The joints of a face of a PlateSet."""
    if face in plates.AutoJoints:
        return "auto"
    return " ".join(f"{value:.10g}" for value in getattr(plates, f"Joints{face.capitalize()}", ()))


def set_joints(plates, face: str, text: str) -> None:
    """Write a cell into a PlateSet; raises ValueError with the reason for text that is none."""
    values = parse_joints(text)
    auto = [name for name in plates.AutoJoints if name != face]
    plates.AutoJoints = [*auto, face] if values == "auto" else auto
    setattr(plates, f"Joints{face.capitalize()}", [] if values == "auto" else values)


def parse_joints(text: str) -> list[float] | str:
    """`auto`, or rising places, all ratios up to 1 or all lengths, mm where no unit is given; each
    may be a sum. Raises ValueError."""
    if text.strip().casefold() == "auto":
        return "auto"
    try:
        values = [_place(word) for part in text.split(";") for word in _words(part)]
    except ValueError as problem:
        raise ValueError(
            translate("BendTorsion", "write auto, or numbers such as 4000 8000 or 0.5 1")
        ) from problem
    if any(v <= 0.0 for v in values):
        raise ValueError(translate("BendTorsion", "joints must be above 0"))
    if any(b <= a for a, b in zip(values, values[1:], strict=False)):
        raise ValueError(translate("BendTorsion", "joints must rise"))
    if values and min(values) <= 1.0 < max(values):
        raise ValueError(translate("BendTorsion", "ratios up to 1 and mm are mixed"))
    return values


def _words(part: str) -> list[str]:
    """The places of a text: one quantity, or several with blanks between."""
    part = " ".join(part.split())
    if not part:
        return []
    try:
        number_of(part, "mm")
    except ValueError:
        return BETWEEN.split(part)
    return [part]


def _place(word: str) -> float:
    """A ratio or a length in mm; raises ValueError for what is none."""
    if "," in word:
        # Between numbers, or a decimal mark.
        raise ValueError(word)
    try:
        return number_of(word, "")
    except ValueError:
        length = number_of(word, "mm")
    if 0.0 < length <= 1.0:
        # It would be taken for a ratio.
        raise ValueError(word)
    return length
