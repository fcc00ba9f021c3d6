# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member: frames and section law together give the corner lines and the rails of every strip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import tolerances
from .cells import Cell, SectionLaw
from .finding import BendTorsionError, error
from .frames import Frames, FrameStations
from .piecewise import Piecewise, span_nodes

SHARPEST_BEND = 0.05
"""Least 1 − κ·r of any corner: below it the section all but turns about that corner."""


@dataclass(frozen=True, eq=False)
class Member:
    """A member's geometry: its name, frames by arc length and section law."""

    name: str
    frames: Frames
    law: SectionLaw

    @property
    def length(self) -> float:
        """Length of the axis, mm."""
        return self.frames.axis.length

    def smooth_breaks(self, firm: np.ndarray, more: Sequence[float] = ()) -> np.ndarray:
        """Breaks between firm[0] and firm[-1]: the firm ones exactly, then `more` and those of
        the frames where they are clear of the others."""
        breaks = np.asarray(firm, float)
        for group in (more, self.frames.breaks):
            soft = np.asarray(group, float)
            soft = soft[(soft > breaks[0]) & (soft < breaks[-1])]
            if len(soft):
                clear = np.abs(soft[:, None] - breaks[None, :]).min(axis=1)
                soft = soft[clear > tolerances.STATION_AT_PLATE_END]
                breaks = np.sort(np.concatenate([breaks, soft]))
        return breaks

    def corners(self, start: float, end: float) -> Piecewise:
        """All corner lines between two places: s -> (m * 3,), in the order of the section."""

        cells = [c for c in self.law.cells if c.start < end and c.end > start]
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
            s = np.linspace(cell.start, cell.end, 65)
            at = self.frames.at(s)
            fibres = stretch(at, cell_corners(cell, s))
            if fibres.min() <= SHARPEST_BEND:
                i, j = np.unravel_index(int(np.argmin(fibres)), fibres.shape)
                raise BendTorsionError(
                    error(
                        "bend-sharper-than-section",
                        self.name,
                        f"the section folds over itself at corner "
                        f"{self.law.sections[0].corner_names[j]} of {cell.label}",
                        "use a smaller section, another alignment or a smoother axis",
                        position=f"s = {s[i]:.0f} mm",
                        value=float(fibres[i, j]),
                        limit=SHARPEST_BEND,
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
