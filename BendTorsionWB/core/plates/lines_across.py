# SPDX-License-Identifier: LGPL-2.1-or-later
"""The measuring lines of a plate, on its surfaces and in its pattern, straight or along a cut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..flattening import measure
from ..flattening.development import Development, Rulings
from ..flattening.locate import locate
from ..flattening.measure import CornerPanels, PanelSamples
from ..geometry.vectors import lengths
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


def across_of(plate: Plate, pattern: Pattern) -> LinesAcross:
    """The lines of a plate."""
    return (CutLinesAcross if plate.is_cut else LinesAcross)(plate, pattern)


class LinesAcross:
    """What all lofting data reads at the lines across a plate, evaluated once: rulings of the
    mid-surface, corners of the outer face (n, 2, 3), ends in the pattern (n, 2, 2)."""

    def __init__(self, plate: Plate, pattern: Pattern):
        self.plate, self.pattern = plate, pattern
        self.places = np.array([line.s_mid for line in plate.lines])
        self.measured = measure.panel_samples(
            pattern.development, self.places, plate.rails.mid_folds
        )
        self.rulings: Rulings = self.measured.ends
        self.outer = plate.rails.outer(np.array([line.s for line in plate.lines]))
        self.outer = self.outer.reshape(-1, 2, 3)
        self.inner = plate.rails.inner(self.places).reshape(-1, 2, 3)
        self.lengths: PanelSamples | CornerPanels = self.measured
        zero = np.zeros(len(self.places))
        self.flat = np.stack([self.at(zero), self.at(zero + 1.0)], axis=1)

    def at(self, w: np.ndarray) -> np.ndarray:
        """Pattern points (n, 2) at w (n,) of the lines."""
        return turned(self.rulings.flat(w), self.pattern.turn) + self.pattern.shift

    def on_face(self, level: str, inset: np.ndarray) -> np.ndarray:
        """Points (n, 2, 3) of the `outer` or `inner` surface on the lines, at the parts `inset`
        (n,) of their length from the first and from the second edge."""
        face = getattr(self, level)
        step = inset[:, None] * (face[:, 1] - face[:, 0])
        return np.stack([face[:, 0] + step, face[:, 1] - step], axis=1)

    def edge_places(self) -> np.ndarray:
        """Arc lengths (n, 2) of the ends of the lines on the outer face."""
        return self.plate.line_places("outer")

    def true_lengths(self) -> np.ndarray:
        """Lengths (n,) of the lines on the formed mid-surface."""
        return lengths(self.rulings.ruling)

    def panel_areas(self, along: np.ndarray, across: np.ndarray) -> np.ndarray:
        """Areas (n - 1,) of the panels, from the means of their sides along and across."""
        return along * across

    def flat_lengths(self) -> np.ndarray:
        """Lengths (n,) of the lines in the pattern, along their curve when a correction bends
        them."""
        if self.rulings.correction is None:
            return lengths(self.flat[:, 1] - self.flat[:, 0])
        count = len(self.places)
        points = np.stack(
            [self.at(np.full(count, w)) for w in np.linspace(0.0, 1.0, measure.FINEST + 1)], axis=1
        )
        return measure.sampled_lengths(points)


class CutLinesAcross(LinesAcross):
    """Lines across a plate whose first or last line runs along a cut, from corner to corner."""

    def __init__(self, plate: Plate, pattern: Pattern):
        super().__init__(plate, pattern)
        self.corners = plate.line_places("mid")
        self.outer = _corners(plate.rails.outer, plate.line_places("outer"))
        self.inner = _corners(plate.rails.inner, plate.line_places("inner"))
        self.lengths = CornerPanels(pattern.development, self.corners, plate.rails.mid_folds)

    def _along_cut(self, k: int, w: np.ndarray, level: str = "mid") -> np.ndarray:
        return self.plate.cuts[k].at(level, w)

    def _cut_ends(self):
        return [k for k in (0, -1) if self.plate.cuts[k] is not None]

    def at(self, w: np.ndarray) -> np.ndarray:
        flat = super().at(w)
        for k in self._cut_ends():
            flat[k] = self.pattern.flat(self._along_cut(k, w[k : k + 1 or None]), w[[k]])[0]
        return flat

    def on_face(self, level: str, inset: np.ndarray) -> np.ndarray:
        found = super().on_face(level, inset)
        rails = getattr(self.plate.rails, level)
        for k in self._cut_ends():
            w = np.array([inset[k], 1.0 - inset[k]])
            value = rails(self._along_cut(k, w, level))
            found[k] = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
        return found

    def true_lengths(self) -> np.ndarray:
        lengths = super().true_lengths()
        for k in self._cut_ends():
            lengths[k] = self._cut_length(k, self.pattern.development.point)
        return lengths

    def flat_lengths(self) -> np.ndarray:
        lengths = super().flat_lengths()
        for k in self._cut_ends():
            lengths[k] = self._cut_length(k, self.pattern.development.flat)
        return lengths

    def _cut_length(self, k: int, points) -> float:
        total = 0.0
        for low, high in self.plate.cuts[k].stretches:
            w = np.linspace(low, high, measure.FINEST + 1)
            total += float(measure.sampled_lengths(points(self._along_cut(k, w), w)[None])[0])
        return total

    def panel_areas(self, along: np.ndarray, across: np.ndarray) -> np.ndarray:
        one, two = self.flat[1:, 1] - self.flat[:-1, 0], self.flat[1:, 0] - self.flat[:-1, 1]
        return 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def _corners(rails, places: np.ndarray) -> np.ndarray:
    """Points (n, 2, 3) of the first and second rail at places (n, 2)."""
    return np.stack([rails(places[:, 0])[:, :3], rails(places[:, 1])[:, 3:]], axis=1)
