# SPDX-License-Identifier: LGPL-2.1-or-later
"""Backing bars as parts: flat bars the preparations of welds ask for, marked K.

A bar is told by its section and length alone. It is in no solid, file of a plate or mass of a
member: bars are cut from flat stock and bent along the seam by hand.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..lofting import MemberRecord

LETTER = "K"


@dataclass(frozen=True)
class BackingBar:
    """A bar `M1-K3` behind a weld; width, thickness, length mm; mass kg."""

    mark: str
    member: str
    piece: int
    weld: str
    width: float
    thickness: float
    length: float
    material: str
    mass: float


def backing_bars(record: MemberRecord) -> tuple[BackingBar, ...]:
    """The bars of a member in the order of its welds, of the grade and density of the plate that
    is cut."""
    plates = {plate.mark: plate for plate in record.plates}
    bars = []
    for weld in record.welds:
        plate = plates.get(weld.plates[0])
        if weld.prep.backing is None or plate is None:
            continue
        width, thickness = weld.prep.backing
        density = plate.mass / plate.volume
        bars.append(
            BackingBar(
                f"{record.member}-{LETTER}{len(bars) + 1}",
                record.member,
                weld.piece,
                weld.mark,
                width,
                thickness,
                weld.length,
                plate.material,
                density * width * thickness * weld.length,
            )
        )
    return tuple(bars)
