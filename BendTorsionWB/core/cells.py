# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law as cells: stretches of the axis over which the section is a polynomial."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .finding import Finding
from .section import Material, Section
from .strip_lines import Sites, StripTable, strip_table


@dataclass(frozen=True)
class FaceSteps:
    """Differences of the face positions of two neighbouring segments (paper h1, h2, b1, b2), mm.

    Positive where the later face lies farther along +z (top, bottom) or +y (left, right).
    """

    top: float
    bottom: float
    left: float
    right: float

    @property
    def largest(self) -> float:
        return max(abs(self.top), abs(self.bottom), abs(self.left), abs(self.right))


@dataclass(frozen=True, eq=False)
class Cell:
    """A stretch of the axis over which the section varies smoothly with constant thicknesses.

    label: `d-1` for constant, `b-1` for transition zones. corners (m, 2) and gaps (strips, 2) at
    `start`, their rates per mm of arc length there, and in smooth transitions the coefficients of
    the second and third power of arc length, (2, m, 2) and (2, strips, 2). thickness: (strips,)
    mm.
    """

    label: str
    start: float
    end: float
    corners: np.ndarray
    corner_rates: np.ndarray
    gaps: np.ndarray
    gap_rates: np.ndarray
    thickness: np.ndarray
    materials: tuple[Material, ...]
    corner_bends: np.ndarray | None = None
    gap_bends: np.ndarray | None = None

    def corners_at(self, s: np.ndarray) -> np.ndarray:
        """Section corners (n, m, 2) in (y, z) at arc lengths s (n,)."""
        d = (np.asarray(s, float) - self.start)[:, None, None]
        if self.corner_bends is None:
            return self.corners + d * self.corner_rates
        second, third = self.corner_bends
        return self.corners + d * (self.corner_rates + d * (second + d * third))

    @cached_property
    def end_rates(self) -> np.ndarray:
        """Rates of the corners (m, 2) at the end."""
        if self.corner_bends is None:
            return self.corner_rates
        d = self.end - self.start
        second, third = self.corner_bends
        return self.corner_rates + d * (2.0 * second + 3.0 * d * third)

    @property
    def is_transition(self) -> bool:
        return self.label.startswith("b")


@dataclass(frozen=True, eq=False)
class SectionLaw:
    """The placed section along the axis. joints: arc lengths every face is cut at, because a
    thickness, a material or the whole section steps there; folds: where faces change slope."""

    sections: tuple[Section, ...]
    cells: tuple[Cell, ...]
    joints: tuple[float, ...]
    folds: tuple[float, ...]
    face_steps: tuple[FaceSteps, ...]
    findings: tuple[Finding, ...]

    @property
    def strips(self):
        """The strips of the section; faces and letters are the same in every segment."""
        return self.sections[0].strips

    @property
    def length(self) -> float:
        return self.cells[-1].end

    @cached_property
    def table(self) -> StripTable:
        """The strips as arrays."""
        return strip_table(self.strips)

    def sites(self, cell: np.ndarray, s: np.ndarray, ky, kz, twist) -> Sites:
        """The section of cells (n,) at arc lengths s (n,), with the curvatures and twist there."""
        start, corners, gaps, thickness = self._polynomials
        d = (s - start[cell])[:, None, None]
        if all(one.corner_bends is None for one in self.cells):
            c0, motion, g0, g1 = (p[cell] for p in (*corners[:2], *gaps[:2]))
            place, gap = c0 + d * motion, g0 + d * g1
        else:
            c0, c1, c2, c3 = (part[cell] for part in corners)
            g0, g1, g2, g3 = (part[cell] for part in gaps)
            place, gap = c0 + d * (c1 + d * (c2 + d * c3)), g0 + d * (g1 + d * (g2 + d * g3))
            motion = c1 + d * (2.0 * c2 + 3.0 * d * c3)
        return Sites(place, motion, thickness[cell], gap, ky, kz, twist)

    @cached_property
    def _polynomials(self) -> tuple[np.ndarray, list, list, np.ndarray]:
        corners, gaps = [], []
        for cell in self.cells:
            none = np.zeros((2, *cell.corners.shape)), np.zeros((2, *cell.gaps.shape))
            bends = none if cell.corner_bends is None else (cell.corner_bends, cell.gap_bends)
            corners.append([cell.corners, cell.corner_rates, *bends[0]])
            gaps.append([cell.gaps, cell.gap_rates, *bends[1]])
        return (
            np.array([cell.start for cell in self.cells]),
            [np.array(part) for part in zip(*corners, strict=True)],
            [np.array(part) for part in zip(*gaps, strict=True)],
            np.array([cell.thickness for cell in self.cells]),
        )


def powers(first: np.ndarray, last: np.ndarray, length: float, smooth: bool) -> list[np.ndarray]:
    """Coefficients of the powers of arc length from `first` to `last`: 2 when linear, 4 smooth."""
    change = last - first
    if not smooth:
        return [first, change / length]
    return [first, np.zeros_like(change), 3.0 * change / length**2, -2.0 * change / length**3]


def shifted(coefficients: list[np.ndarray], d: float) -> tuple:
    """The same polynomial about a point d farther on: value, rate, and (second, third) or None."""
    if len(coefficients) == 2:
        return coefficients[0] + d * coefficients[1], coefficients[1], None
    c0, c1, c2, c3 = coefficients
    return (
        c0 + d * (c1 + d * (c2 + d * c3)),
        c1 + d * (2.0 * c2 + 3.0 * d * c3),
        np.array([c2 + 3.0 * d * c3, c3]),
    )
