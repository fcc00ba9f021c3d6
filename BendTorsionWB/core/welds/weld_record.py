# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a weld, as lists, maps and drawings show it."""

from __future__ import annotations

from dataclasses import dataclass

from .preps import Prep


@dataclass(frozen=True)
class Weld:
    """One weld. mark: unique in the project. kind: `seam`, `lane` (between lanes of one face),
    `joint`, `node` (of a branch on the member that runs through), `diaphragm` or `end` (of an end
    plate). plates: the first is the one that is cut to fit the other, which at a node is told by
    member and face. start, end: arc length on the axis, mm. length: along the weld, mm.
    thickness: of both plates, mm. dihedral: mean angle between the plates on the inner side, rad.
    place: `shop` or `field`. row: of the edges it is prepared by, from 1; 0 of the rule pack's
    preparation."""

    mark: str
    member: str
    piece: int
    kind: str
    name: str
    plates: tuple[str, str]
    start: float
    end: float
    length: float
    thickness: tuple[float, float]
    dihedral: float
    prep: Prep
    place: str
    ndt: str
    row: int = 0

    @property
    def cut_thickness(self) -> float:
        """Thickness, mm, the groove is cut in: of the plate that is cut; at butt joints of the
        thinner one, which the chamfer of a thicker one ends at."""
        return min(self.thickness) if self.kind == "joint" else self.thickness[0]
