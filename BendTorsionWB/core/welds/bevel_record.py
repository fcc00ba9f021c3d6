# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a bevel, as cut files and tables show it."""

from __future__ import annotations

from dataclasses import dataclass

from ..members.thickness import Chamfer


@dataclass(frozen=True)
class EdgeBevel:
    """A stretch of one side of a plate that is cut with one bevel.

    side: `first` or `second` long edge, `start` or `end`, `wall` of a flat part; edge: its name;
    weld, prep: that it is for, empty without; start, end: arc length on the axis, mm, of a stretch
    of an end or a wall's side mm along it from the first edge or corner. natural: angle (rad) of
    the edge against square where no groove is cut, positive where the outer face is the wider.
    outer, inner: groove cut from that face: angle against square, positive where the face is cut
    back, and depth mm, 0 of none, from the chamfered face where there is a chamfer: of a plate
    thicker than the other at a joint, machined after cutting. opening: of a side of a flat part
    that is cut square, the angle (rad) it leaves to a wall askew, and the face it opens to (`up`
    or `down`).
    """

    side: str
    edge: str
    weld: str
    prep: str
    start: float
    end: float
    natural: float
    outer: tuple[float, float] = (0.0, 0.0)
    inner: tuple[float, float] = (0.0, 0.0)
    chamfer: Chamfer | None = None
    opening: tuple[float, str] = (0.0, "")

    @property
    def angles(self) -> tuple[float, float, float]:
        """Of the outer groove, the inner groove, and between them."""
        return self.outer[0], self.inner[0], self.natural

    @property
    def is_cut(self) -> bool:
        """False of a square edge."""
        return bool(self.natural or self.outer[1] or self.inner[1] or self.chamfer)

    @property
    def cut_depths(self) -> tuple[float, float]:
        """Depths of the outer and the inner groove from the faces of the plate before it is
        chamfered, mm, 0 of none."""
        off = self.chamfer.depths if self.chamfer else (0.0, 0.0)
        grooves = zip((self.outer[1], self.inner[1]), off, strict=True)
        return tuple(depth + more if depth else 0.0 for depth, more in grooves)

    def land(self, thickness: float) -> float:
        """What grooves and chamfer leave of the edge of a plate of a thickness, mm."""
        off = sum(self.chamfer.depths) if self.chamfer else 0.0
        return thickness - self.outer[1] - self.inner[1] - off
