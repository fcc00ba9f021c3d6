# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member: frames and section law together give the corner lines and the rails of every strip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol
from weakref import WeakKeyDictionary

import numpy as np

from .. import tolerances
from ..axes.frames import Frames, FrameStations
from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, span_nodes
from .cells import Cell, SectionLaw
from .piece_record import Piece

if TYPE_CHECKING:
    from ..nodes.node_record import NodeRecord
    from ..plates.flat_plate import FlatPlate

SHARPEST_BEND = 0.05
"""Least 1 − κ·r of any corner: below it the section all but turns about that corner."""
BEYOND_CUT = 30.0
"""mm a strip reaches beyond an end that is cut, to be cut there."""


class EndSurface(Protocol):
    """What a member or a plate ends at."""

    def value_and_gradient(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """At points (n, 3): the signed distance or another function with the same zeros (n,),
        positive where the member stays, and its gradient (n, 3)."""


@dataclass(frozen=True, eq=False)
class MemberEnd:
    """What a member ends at, and the least and the greatest arc length its section is cut at."""

    surface: EndSurface
    least: float
    greatest: float

    @property
    def reach(self) -> tuple[float, float]:
        """Arc lengths well before and behind the cut, for what it is cut from."""
        pad = 0.25 * (self.greatest - self.least) + BEYOND_CUT
        return self.least - pad, self.greatest + pad


@dataclass(frozen=True, eq=False)
class MemberGap:
    """A stretch of a member, from start to end on its axis, that a member it meets takes: what the
    plates before it end at and those behind it start at (None where nothing of it is left)."""

    start: float
    end: float
    before: MemberEnd | None
    behind: MemberEnd | None

    def takes(self, s: float) -> bool:
        """True for a place within the stretch or on its cuts."""
        low = self.start if self.before is None else self.before.least
        high = self.end if self.behind is None else self.behind.greatest
        return low <= s <= high


_corners_of: WeakKeyDictionary[Member, dict[tuple[float, float], Piecewise]] = WeakKeyDictionary()
"""Corner lines of members that live: asked for again and again between the same places."""


@dataclass(frozen=True, eq=False)
class Member:
    """A member's geometry: its name, frames by arc length, section law and what its start and its
    end are cut by; None where they are square. gaps: what nodes take of it, rising; inserts:
    diaphragms nodes put inside it, not numbered; node_records: of the nodes it ends on others at;
    rolled: s -> (1,), rad, what blends at nodes turned it by; stub_ends: field joints behind stubs,
    mm. pieces: it is delivered in, along +s. root_gaps: (face, place, mm) of joints within it."""

    name: str
    frames: Frames
    law: SectionLaw
    ends: tuple[MemberEnd | None, MemberEnd | None] = (None, None)
    gaps: tuple[MemberGap, ...] = ()
    inserts: tuple[FlatPlate, ...] = ()
    node_records: tuple[NodeRecord, ...] = ()
    rolled: Piecewise | None = None
    stub_ends: tuple[float, ...] = ()
    pieces: tuple[Piece, ...] = ()
    root_gaps: tuple[tuple[str, float, float], ...] = ()

    def ends_of(self, start: float, end: float) -> tuple[MemberEnd | None, MemberEnd | None]:
        """What a plate from start to end is cut by; None where it is square."""
        first = self.ends[0] if start == 0.0 else None
        last = self.ends[1] if end == self.length else None
        for gap in self.gaps:
            first = gap.behind if gap.end == start else first
            last = gap.before if gap.start == end else last
        return first, last

    def opened(self, face: str, start: float, end: float) -> tuple[float, float]:
        """Start and end of a plate of a face between joints, half a field gap short of the end
        of its piece, half a root gap short of its other joints."""
        open_joints = [(p.end_of(face), p.gap) for p in self.pieces if p.gap]
        open_joints += [(at, gap) for own, at, gap in self.root_gaps if own == face]
        first, last = start, end
        for at, gap in open_joints:
            first = at + 0.5 * gap if start == at else first
            last = at - 0.5 * gap if end == at else last
        return first, last

    def piece_at(self, face: str, s: float) -> int:
        """Number of the piece a face belongs to at s; 1 without pieces."""
        for piece in self.pieces:
            if s < piece.end_of(face):
                return piece.number
        return self.pieces[-1].number if self.pieces else 1

    @property
    def length(self) -> float:
        """Length of the axis, mm."""
        return self.frames.axis.length

    @property
    def reach(self) -> tuple[float, float]:
        """Arc lengths the skin runs between: the ends, or well beyond one that is cut."""
        start, end = self.ends
        return (
            0.0 if start is None else min(0.0, start.reach[0]),
            self.length if end is None else max(self.length, end.reach[1]),
        )

    def smooth_breaks(self, firm: np.ndarray, more: Sequence[float] = ()) -> np.ndarray:
        """Breaks between firm[0] and firm[-1]: the firm ones exactly, then `more` and those of
        the frames and of alignment to a surface where they are clear of the others."""
        breaks = np.asarray(firm, float)
        for group in (more, self.frames.breaks, self.law.lift_breaks):
            soft = np.asarray(group, float)
            soft = soft[(soft > breaks[0]) & (soft < breaks[-1])]
            if len(soft):
                clear = np.abs(soft[:, None] - breaks[None, :]).min(axis=1)
                soft = soft[clear > tolerances.STATION_AT_PLATE_END]
                breaks = np.sort(np.concatenate([breaks, soft]))
        return breaks

    def corners(self, start: float, end: float) -> Piecewise:
        """All corner lines between two places: s -> (m * 3,), in the order of the section."""
        made = _corners_of.setdefault(self, {})
        if (start, end) not in made:
            made[start, end] = self._corners(start, end)
        return made[start, end]

    def _corners(self, start: float, end: float) -> Piecewise:
        # Beyond its ends a member runs on as its first or last cell.
        cells = [c for c in self.law.cells if c.start < end and c.end > start]
        cells = cells or [self.law.cells[0 if end <= 0.0 else -1]]
        edges = np.array([start, *(cell.start for cell in cells[1:]), end])
        breaks = self.smooth_breaks(edges)
        nodes = span_nodes(breaks)
        owner = np.searchsorted(edges, 0.5 * (breaks[1:] + breaks[:-1]), side="right") - 1
        at = self.frames.at(nodes.ravel())
        plane = np.concatenate(
            [cell_corners(cell, nodes[owner == k].ravel()) for k, cell in enumerate(cells)]
        )
        return Piecewise(breaks, to_space(at, plane).reshape(*nodes.shape, -1))

    @cached_property
    def corner_lengths(self) -> np.ndarray:
        """Length of each corner line, (m,) mm; steps across the axis do not count."""
        rate = self.corners(0.0, self.length).derivative
        speed = np.linalg.norm(rate.values.reshape(*rate.values.shape[:2], -1, 3), axis=3)
        return Piecewise(rate.breaks, speed).integral()

    def stations(self, spacing: float) -> np.ndarray:
        """Station arc lengths k·L/n, k = 0 … n: n the smallest count, not below that of the
        longest corner line, that leaves no interval of any corner line longer than `spacing`."""
        rate = self.corners(0.0, self.length).derivative
        speed = np.linalg.norm(rate.values.reshape(*rate.values.shape[:2], -1, 3), axis=3)
        along = Piecewise(rate.breaks, speed).antiderivative()
        count = max(1, int(np.ceil(self.corner_lengths.max() / spacing - 1e-9)))
        while True:
            s = np.linspace(0.0, self.length, count + 1)
            if np.diff(along(s), axis=0).max() <= spacing * (1 + 1e-9):
                return s
            count += 1

    def check_bend(self) -> None:
        """Raises BendTorsionError where the axis bends more sharply than the section allows."""
        for cell in self.law.cells:
            # In every span of the frames: a bend may be far shorter than its cell.
            s = span_nodes(self.smooth_breaks(np.array([cell.start, cell.end]))).ravel()
            at = self.frames.at(s)
            fibres = stretch(at, cell_corners(cell, s))
            if fibres.min() <= SHARPEST_BEND:
                i, j = np.unravel_index(int(np.argmin(fibres)), fibres.shape)
                raise BendTorsionError(
                    error(
                        "bend-sharper-than-section",
                        self.name,
                        f"the section folds over itself at corner "
                        f"{self.law.sections[0].corner_names[j]} of {cell.label}: its length there "
                        "per length of axis",
                        "use a smaller section, another alignment or a smoother axis",
                        position=f"s = {s[i]:.0f} mm",
                        value=float(fibres[i, j]),
                        limit=SHARPEST_BEND,
                        unit="mm/mm",
                    )
                )


def cell_corners(cell: Cell, s: np.ndarray) -> np.ndarray:
    """Section corners (n, m, 2) in (y, z) at arc lengths s of the cell."""
    return cell.corners_at(s)


def stretch(at: FrameStations, points: np.ndarray) -> np.ndarray:
    """1 − κ·r, the arc length of a fibre per arc length of the axis, for points (n, …, 2)."""
    extra = (1,) * (points.ndim - 2)
    ky, kz = at.ky.reshape(-1, *extra), at.kz.reshape(-1, *extra)
    return 1.0 - ky * points[..., 0] - kz * points[..., 1]


def to_space(at: FrameStations, plane: np.ndarray) -> np.ndarray:
    """Points (n, m, 3) of section points (n, m, 2)."""
    return (
        at.origin[:, None, :]
        + plane[:, :, :1] * at.y[:, None, :]
        + plane[:, :, 1:] * at.z[:, None, :]
    )
