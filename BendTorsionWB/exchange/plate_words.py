# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a plate says of itself in every cut file: identity, marking face, face of its contour."""

from __future__ import annotations

from ..core.lofting import DevelopedPlate


def identity(plate: DevelopedPlate) -> tuple[str, ...]:
    """Rows of text: mark, where it belongs, part, thickness and grade, faces, contour."""
    up = plate.marking_face.upper()
    down = {"INSIDE": "OUTSIDE", "OUTSIDE": "INSIDE"}.get(up, "-S")
    part = () if plate.quantity < 2 else (f"part {plate.part}, {plate.quantity} off",)
    return (
        plate.mark,
        f"{plate.member} {plate.face} {plate.piece}",
        *part,
        f"t{plate.thickness:g} {plate.material}",
        f"marking face {up}",
        f"{down} below",
        f"contour {plate.contour_face.upper()}",
    )
