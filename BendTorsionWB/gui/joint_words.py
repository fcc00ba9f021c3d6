# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joints of a face as one cell of text: `auto`, numbers, or nothing."""

from __future__ import annotations

import math

import FreeCAD

translate = FreeCAD.Qt.translate


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
    """`auto` or rising numbers, all ratios up to 1 or all mm. Raises ValueError."""
    words = text.replace(";", " ").split()
    if words == ["auto"]:
        return "auto"
    try:
        values = [float(word) for word in words]
    except ValueError as problem:
        raise ValueError(
            translate("BendTorsion", "write auto, or numbers such as 4000 8000 or 0.5 1")
        ) from problem
    if any(not math.isfinite(v) or v <= 0.0 for v in values):
        raise ValueError(translate("BendTorsion", "joints must be above 0"))
    if any(b <= a for a, b in zip(values, values[1:], strict=False)):
        raise ValueError(translate("BendTorsion", "joints must rise"))
    if values and min(values) <= 1.0 < max(values):
        raise ValueError(translate("BendTorsion", "ratios up to 1 and mm are mixed"))
    return values
