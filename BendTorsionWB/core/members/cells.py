# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law as cells: stretches of the axis over which the section is a polynomial."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..finding import Finding
from ..sections.section import Material, Section
from ..sections.strip_lines import Sites, StripTable, strip_table
from .surface_alignment import Lift
from .thickness import Chamfer, ThicknessChange


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
    """A stretch of the axis over which the section varies smoothly with constant thicknesses,
    chamfers apart.

    label: `d-1` for constant, `b-1` for transition zones. corners (m, 2) and gaps (strips, 2) at
    `start`, their rates per mm of arc length there, and in smooth transitions the coefficients of
    the second and third power of arc length, (2, m, 2) and (2, strips, 2). thickness: (strips,)
    mm, of the stock. lift: what alignment to the surface adds to the corners' z. chamfer:
    (2, strips) how much chamfers thin the plates at `start` and its rate, or None.
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
    lift: Lift | None = None
    chamfer: np.ndarray | None = None

    def corners_at(self, s: np.ndarray) -> np.ndarray:
        """Section corners (n, m, 2) in (y, z) at arc lengths s (n,)."""
        corners = self._unlifted(s)
        if self.lift is not None:
            corners[..., 1] += self.lift.at(s)[0][:, None]
        return corners

    def _unlifted(self, s: np.ndarray) -> np.ndarray:
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
    """The placed section along the axis. joints: arc lengths every face is cut at, because the
    whole section steps there; folds: where faces change slope; changes: thickness joints;
    piece_joints: (strip, place) of stepped ends of delivery pieces."""

    sections: tuple[Section, ...]
    cells: tuple[Cell, ...]
    joints: tuple[float, ...]
    folds: tuple[float, ...]
    face_steps: tuple[FaceSteps, ...]
    findings: tuple[Finding, ...]
    changes: tuple[ThicknessChange, ...] = ()
    piece_joints: tuple[tuple[int, float], ...] = ()

    @property
    def strips(self):
        """The strips of the section; faces and letters are the same in every segment."""
        return self.sections[0].strips

    @property
    def length(self) -> float:
        return self.cells[-1].end

    @property
    def plate_kinds(self) -> set[tuple[float, str]]:
        """Thickness and grade of all plates."""
        return {
            (thickness, grade.name)
            for cell in self.cells
            for thickness, grade in zip(cell.thickness.tolist(), cell.materials, strict=True)
        }

    def cell_at(self, s: float) -> Cell:
        """The cell an arc length lies in, the first of two that meet there; beyond the ends that
        at the end."""
        return next((cell for cell in self.cells if s <= cell.end), self.cells[-1])

    def joints_of(self, strip: int) -> tuple[float, ...]:
        """Arc lengths between the ends at which the section asks a face to be cut."""
        own = {change.place for change in self.changes if change.strip == strip}
        own |= {place for index, place in self.piece_joints if index == strip}
        return tuple(sorted(own.union(self.joints) - {0.0, self.length}))

    @cached_property
    def all_joints(self) -> tuple[float, ...]:
        """Those of all faces."""
        return tuple(sorted(set().union(*map(self.joints_of, range(len(self.strips))))))

    def chamfers_of(
        self, strip: int, start: float, end: float
    ) -> tuple[Chamfer | None, Chamfer | None]:
        """The chamfers at the two ends of a plate from start to end."""
        found: list[Chamfer | None] = [None, None]
        line = self.strips[strip].line
        faces = "both" if line == 0.5 else "outer" if line == 1.0 else "inner"
        for change in self.changes:
            if change.strip == strip and change.chamfer:
                side = int(change.thick_before)
                if change.chamfer[side] == (start, end)[side]:
                    length = change.chamfer[1] - change.chamfer[0]
                    depth = change.depth / 2 if faces == "both" else change.depth
                    found[side] = Chamfer(length, depth, faces)
        return found[0], found[1]

    @cached_property
    def prints(self) -> tuple[bytes, ...] | None:
        """Per cell the bytes of all its strips' lines are made from, its end apart; None where
        they are not polynomials."""
        if any(cell.lift is not None for cell in self.cells):
            return None
        section = repr(self.strips).encode()
        return tuple(
            b"".join(
                [
                    section,
                    np.float64(cell.start).tobytes(),
                    *(
                        b"-" if part is None else np.asarray(part, float).tobytes()
                        for part in (
                            cell.corners,
                            cell.corner_rates,
                            cell.corner_bends,
                            cell.gaps,
                            cell.gap_rates,
                            cell.gap_bends,
                            cell.thickness,
                            cell.chamfer,
                        )
                    ),
                ]
            )
            for cell in self.cells
        )

    @cached_property
    def zone_ends(self) -> np.ndarray:
        """Which boundaries of cells (cells - 1,) are ends of zones."""
        labels = np.array([cell.label for cell in self.cells])
        return labels[1:] != labels[:-1]

    @cached_property
    def felt(self) -> np.ndarray:
        """Whether strips change at the boundaries of cells (cells - 1, strips): everywhere but
        where only strips they do not stop at change their thickness or begin a chamfer."""
        felt = np.ones((len(self.cells) - 1, len(self.strips)), bool)
        for row, before, after in zip(felt, self.cells, self.cells[1:], strict=False):
            if before.label == after.label:
                changed = before.thickness != after.thickness
                for cell in (before, after):
                    if cell.chamfer is not None:
                        changed |= cell.chamfer[1] != 0.0
                row[:] = changed | changed[self.table.neighbour].any(axis=1)
        return felt

    @cached_property
    def lift_breaks(self) -> np.ndarray:
        """Arc lengths where the alignment to a surface is less than smooth."""
        lifts = [cell.lift.breaks for cell in self.cells if cell.lift is not None]
        return np.unique(np.concatenate(lifts)) if lifts else np.empty(0)

    @cached_property
    def table(self) -> StripTable:
        """The strips as arrays."""
        return strip_table(self.strips)

    def sites(self, cell: np.ndarray, s: np.ndarray, ky, kz, twist) -> Sites:
        """The section of cells (n,) at arc lengths s (n,), with the curvatures and twist there."""
        start, corners, gaps, stock, chamfer = self._polynomials
        d = (s - start[cell])[:, None, None]
        if all(one.corner_bends is None for one in self.cells):
            c0, motion, g0, g1 = (p[cell] for p in (*corners[:2], *gaps[:2]))
            place, gap = c0 + d * motion, g0 + d * g1
        else:
            c0, c1, c2, c3 = (part[cell] for part in corners)
            g0, g1, g2, g3 = (part[cell] for part in gaps)
            place, gap = c0 + d * (c1 + d * (c2 + d * c3)), g0 + d * (g1 + d * (g2 + d * g3))
            motion = c1 + d * (2.0 * c2 + 3.0 * d * c3)
        for k, one in enumerate(self.cells):
            if one.lift is not None:
                mine = cell == k
                lift, rate = one.lift.at(s[mine])
                place[mine, :, 1] += lift[:, None]
                motion[mine, :, 1] += rate[:, None]
        thickness = stock = stock[cell]
        if chamfer is not None:
            depth, rate = chamfer
            thickness = stock - depth[cell] - (s - start[cell])[:, None] * rate[cell]
        return Sites(place, motion, thickness, stock, gap, ky, kz, twist)

    @cached_property
    def _polynomials(self) -> tuple[np.ndarray, list, list, np.ndarray, np.ndarray | None]:
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
            self._chamfers(),
        )

    def _chamfers(self) -> np.ndarray | None:
        """Depths and rates (2, cells, strips) of chamfers at the cells' starts."""
        if all(cell.chamfer is None for cell in self.cells):
            return None
        none = np.zeros((2, len(self.strips)))
        return np.stack([none if c.chamfer is None else c.chamfer for c in self.cells], axis=1)


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
