# SPDX-License-Identifier: LGPL-2.1-or-later
"""The measuring lines of plates, straight or along a cut, on their surfaces and in patterns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..flattening import measure
from ..flattening.development import Development, Rulings
from ..flattening.developments import Developments
from ..flattening.locate import locate
from ..flattening.measure import CornerPanels
from ..geometry.piecewise import Piecewise, Together, parted
from ..geometry.vectors import lengths
from ..members.contour import EndCurves
from .plate_places import places_in_pattern
from .plates import Plate


@dataclass(frozen=True, eq=False)
class Pattern:
    """A development in the pattern frame: (u, v) = turn @ plane point + shift."""

    development: Development
    turn: np.ndarray
    shift: np.ndarray

    def flat(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Pattern points (n, 2) at (s, w)."""
        return turned(self.development.flat(s, w), self.turn) + self.shift

    def places(self, flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """s, w (n,) of pattern points (n, 2): the inverse of `flat`."""
        return places_in_pattern(self.development, turned(flat - self.shift, self.turn.T))

    def formed(self, flat: np.ndarray) -> np.ndarray:
        """Model points (n, 3) on the flattened surface that pattern points (n, 2) are formed to;
        raises BendTorsionError for points off the pattern."""
        plane = turned(np.asarray(flat, float) - self.shift, self.turn.T)
        return self.development.point(*locate(self.development, plane))


def turned(points: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """turn @ point for points (n, d). Not by BLAS, whose last bits vary with the alignment of
    memory from run to run: the same input must give the same bytes."""
    total = points[:, :1] * turn[:, 0]
    for k in range(1, points.shape[1]):
        total += points[:, k : k + 1] * turn[:, k]
    return total


def turned_each(points: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """As turned, with a matrix (n, k, d) for each point (n, d)."""
    total = points[:, :1] * turns[:, :, 0]
    for k in range(1, points.shape[1]):
        total += points[:, k : k + 1] * turns[:, :, k]
    return total


class LinesAcross:
    """What all lofting data reads at the lines across plates, line after line of plate after
    plate, evaluated once: rulings of the mid-surface, corners of the outer and the inner face
    (n, 2, 3), ends in the pattern (n, 2, 2). A first or last line may run along a cut.

    Figures of panels are (n - 1,): between the last line of a plate and the first of the next they
    mean nothing.
    """

    def __init__(
        self, plates: Sequence[Plate], patterns: Sequence[Pattern], developments: Developments
    ):
        self.plates, self.patterns, self.developments = plates, patterns, developments
        self.counts = [len(plate.lines) for plate in plates]
        self.ends = np.cumsum(self.counts)
        self.starts = self.ends - self.counts
        self.owner = np.repeat(np.arange(len(plates)), self.counts)
        self._turn = np.stack([pattern.turn for pattern in patterns])[self.owner]
        self._shift = np.stack([pattern.shift for pattern in patterns])[self.owner]
        places = [np.array([line.s_mid for line in plate.lines]) for plate in plates]
        folds = [plate.rails.mid_folds for plate in plates]
        self.places = np.concatenate(places)
        self.s = np.array([line.s for plate in plates for line in plate.lines])
        self.measured = measure.samples_together(developments, places, folds)
        self.rulings: Rulings = self.measured.ends
        self._cuts = [
            (k, int(row), cut)
            for k, plate in enumerate(plates)
            for row, cut in zip((self.starts[k], self.ends[k] - 1), plate.cuts, strict=True)
            if cut is not None
        ]
        self._corner_panels = {
            k: CornerPanels(patterns[k].development, plates[k].line_places("mid"), folds[k])
            for k, *_ in self._cuts
        }
        rails = [plate.rails for plate in plates]
        s = parted(self.s, self.counts)
        self.outer = Together([own.outer for own in rails])(s)
        self.inner = Together([own.inner for own in rails])(places)
        self.outer, self.inner = self.outer.reshape(-1, 2, 3), self.inner.reshape(-1, 2, 3)
        for k in self._corner_panels:
            for level in ("outer", "inner"):
                getattr(self, level)[self.of(k)] = _corners(
                    getattr(rails[k], level), plates[k].line_places(level)
                )
        zero = np.zeros(len(self.places))
        self.flat = np.stack([self.at(zero), self.at(zero + 1.0)], axis=1)

    def of(self, k: int) -> slice:
        """The lines of a plate."""
        return slice(int(self.starts[k]), int(self.ends[k]))

    def panels_of(self, k: int) -> slice:
        """The panels of a plate."""
        return slice(int(self.starts[k]), int(self.ends[k]) - 1)

    def at(self, w: np.ndarray) -> np.ndarray:
        """Pattern points (n, 2) at w (n,) of the lines."""
        flat = turned_each(self.rulings.flat(w), self._turn) + self._shift
        for k, row, cut in self._cuts:
            own = w[row : row + 1]
            flat[row] = self.patterns[k].flat(cut.at("mid", own), own)[0]
        return flat

    def on_face(self, level: str, inset: np.ndarray) -> np.ndarray:
        """Points (n, 2, 3) of the `outer` or `inner` surface on the lines, at the parts `inset`
        (n,) of their length from the first and from the second edge."""
        face = getattr(self, level)
        step = inset[:, None] * (face[:, 1] - face[:, 0])
        found = np.stack([face[:, 0] + step, face[:, 1] - step], axis=1)
        for k, row, cut in self._cuts:
            w = np.array([inset[row], 1.0 - inset[row]])
            value = getattr(self.plates[k].rails, level)(cut.at(level, w))
            found[row] = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
        return found

    def edge_places(self) -> np.ndarray:
        """Arc lengths (n, 2) of the ends of the lines on the outer face."""
        places = np.stack([self.s, self.s], axis=1)
        for _, row, cut in self._cuts:
            places[row] = cut.corners("outer")
        return places

    def true_lengths(self) -> np.ndarray:
        """Lengths (n,) of the lines on the formed mid-surface."""
        found = lengths(self.rulings.ruling)
        for k, row, cut in self._cuts:
            found[row] = _cut_length(cut, self.patterns[k].development.point)
        return found

    def flat_lengths(self) -> np.ndarray:
        """Lengths (n,) of the lines in the pattern, along their curve when a correction bends
        them."""
        if not self.developments.corrected:
            found = lengths(self.flat[:, 1] - self.flat[:, 0])
        else:
            even = np.linspace(0.0, 1.0, measure.FINEST + 1)
            points = [self.at(np.full(len(self.places), w)) for w in even]
            found = measure.sampled_lengths(np.stack(points, axis=1))
        for k, row, cut in self._cuts:
            found[row] = _cut_length(cut, self.patterns[k].development.flat)
        return found

    def panel_edges(self, w: float) -> tuple[np.ndarray, np.ndarray]:
        """Flat and curved lengths (n - 1,) of the panels' edges, w 0 or 1."""
        flat, arc = self.measured.edge(w)
        for k, panels in self._corner_panels.items():
            flat[self.panels_of(k)], arc[self.panels_of(k)] = panels.edge(w)
        return flat, arc

    def panel_diagonals(self) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        """Flat and geodesic lengths (n - 1,) of the diagonals that start at w 0 and at w 1."""
        found = self.measured.geodesics()
        for k, panels in self._corner_panels.items():
            for (flat, arc), own in zip(found, panels.geodesics(), strict=True):
                flat[self.panels_of(k)], arc[self.panels_of(k)] = own
        return found

    def panel_areas(self, along: np.ndarray, across: np.ndarray) -> np.ndarray:
        """Areas (n - 1,) of the panels, from the means of their sides along and across."""
        area = along * across
        for k in self._corner_panels:
            flat = self.flat[self.of(k)]
            one, two = flat[1:, 1] - flat[:-1, 0], flat[1:, 0] - flat[:-1, 1]
            area[self.panels_of(k)] = 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
        return area


def _cut_length(cut: EndCurves, points: Callable) -> float:
    """Length of a cut on a surface or in its plane, points(s, w)."""
    total = 0.0
    for low, high in cut.stretches:
        w = np.linspace(low, high, measure.FINEST + 1)
        total += float(measure.sampled_lengths(points(cut.at("mid", w), w)[None])[0])
    return total


def _corners(rails: Piecewise, places: np.ndarray) -> np.ndarray:
    """Points (n, 2, 3) of the first and second rail at places (n, 2)."""
    return np.stack([rails(places[:, 0])[:, :3], rails(places[:, 1])[:, 3:]], axis=1)
