# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a bevel, as cut files and tables show it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class EdgeBevel:
    """A stretch of one side of a plate that is cut with one bevel.

    side: `first` or `second` long edge, `start` or `end`; edge: its name; weld, prep: that it is
    for, empty without; start, end: arc length on the axis, mm, of a stretch of an end mm from the
    first edge along it. natural: angle (rad) of the edge
    against square where no groove is cut, positive where the outer face is the wider. outer, inner:
    groove cut from that face: angle against square, positive where the face is cut back, and depth
    mm, 0 of none.
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

    @property
    def angles(self) -> tuple[float, float, float]:
        """Of the outer groove, the inner groove, and between them."""
        return self.outer[0], self.inner[0], self.natural

    @property
    def is_cut(self) -> bool:
        """False of a square edge."""
        return bool(self.natural or self.outer[1] or self.inner[1])
