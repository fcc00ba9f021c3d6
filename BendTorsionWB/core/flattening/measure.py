# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lengths measured on finished geometry, flat and curved, apart from how it was constructed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.vectors import lengths
from .development import Development, Rulings
from .developments import Developments

FINEST = 16
"""Chords per smooth interval at the finest of the three levels extrapolated from: lengths of panels
of real plates are within 1e-7 mm of their limit."""

MODES = 3
"""Sine waves per panel that the preimage of a flat diagonal is relaxed by to the geodesic."""


def smooth_intervals(places: np.ndarray, folds: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Intervals (k, 2) between consecutive places, cut at folds, and the panel (k,) of each."""
    known = set(places.tolist())
    inner = [f for f in folds if places[0] < f < places[-1] and f not in known]
    if not inner and (places[1:] > places[:-1]).all():
        return np.stack([places[:-1], places[1:]], axis=1), np.arange(len(places) - 1)
    edges = np.unique(np.concatenate([places, inner]))
    intervals = np.column_stack([edges[:-1], edges[1:]])
    middle = 0.5 * (edges[:-1] + edges[1:])
    return intervals, np.searchsorted(places, middle, side="right") - 1


def curve_lengths(
    curve: Callable[[np.ndarray, np.ndarray], np.ndarray],
    intervals: np.ndarray,
    panels: np.ndarray,
    count: int,
) -> np.ndarray:
    """Length (count,) per panel of curve(s (n,), panel (n,)) -> (n, d).

    Chord sums at 4, 8 and 16 chords per interval, extrapolated to zero (Richardson), so that
    only positions enter and no derivative used in the construction.
    """
    points = curve(_sampled(intervals), np.repeat(panels, FINEST + 1))
    each = sampled_lengths(points.reshape(len(intervals), FINEST + 1, -1))
    return np.bincount(panels, each, minlength=count)


def _sampled(intervals: np.ndarray) -> np.ndarray:
    fraction = np.arange(FINEST + 1) / FINEST
    s = intervals[:, :1] + (intervals[:, 1:] - intervals[:, :1]) * fraction
    # Just inside the interval, so that both sides of a fold give their own limit.
    span = intervals[:, 1] - intervals[:, 0]
    s[:, 0] += 1e-12 * span
    s[:, -1] -= 1e-12 * span
    return s.ravel()


def sampled_lengths(points: np.ndarray) -> np.ndarray:
    """Lengths (n,) of smooth curves given by FINEST + 1 even samples each, (n, FINEST + 1, d)."""
    sums = []
    for n in (FINEST // 4, FINEST // 2, FINEST):
        level = points[:, :: FINEST // n]
        sums.append(lengths(level[:, 1:] - level[:, :-1]).sum(axis=1))
    return _extrapolated(sums)


def _extrapolated(sums: list[np.ndarray]) -> np.ndarray:
    first = (4 * sums[1] - sums[0]) / 3
    second = (4 * sums[2] - sums[1]) / 3
    return (16 * second - first) / 15


@dataclass(frozen=True, eq=False)
class PanelSamples:
    """The rulings of developments at the sample places of the panels between `places` (k + 1,),
    sampled once for every length of the panels. The places of several developments follow each
    other; between the last of one and the first of the next lies no panel, and its figures mean
    nothing."""

    places: np.ndarray
    ends: Rulings
    panels: np.ndarray
    rulings: Rulings
    wave: np.ndarray

    @property
    def count(self) -> int:
        """Number of panels, those that are none included."""
        return len(self.places) - 1

    def edge(self, w: float) -> tuple[np.ndarray, np.ndarray]:
        """Flat and curved length (k,) between consecutive places along the line w = constant."""
        at = np.full(len(self.wave), w)
        return self._length(self.rulings.flat(at)), self._length(self.rulings.point(at))

    def diagonal(self, start_w: float) -> tuple[np.ndarray, np.ndarray]:
        """Flat and preimage length (k,) of the panel diagonals that start at w = start_w."""
        flat, w = self._diagonal(start_w)
        return flat, self._length(self.rulings.point(w))

    def geodesics(
        self, starts: tuple[float, ...] = (0.0, 1.0), modes: int = MODES
    ) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        """Per start, as diagonal, with the preimage relaxed to the geodesic by a Newton step.

        The step minimises the chord sums over `modes` sine waves of w per panel; its gain is the
        second-order excess of the preimage.
        """
        flat, w = zip(*(self._diagonal(start) for start in starts), strict=True)
        rulings = self.rulings
        points = self._shaped(np.stack([rulings.point(one) for one in w]))[:, None]
        phases = np.pi * np.arange(1, modes + 1)[:, None] * self.wave
        waves = self._shaped(np.sin(phases)[:, :, None] * rulings.ruling)[None]
        sizes, slopes, bends = [], [], []
        for n in (FINEST // 4, FINEST // 2, FINEST):
            level = slice(None, None, FINEST // n)
            chord, change = (
                values[:, :, :, level][:, :, :, 1:] - values[:, :, :, level][:, :, :, :-1]
                for values in (points, waves)
            )
            length = lengths(chord)
            pulled = (chord * change).sum(axis=4) / length
            sizes.append(length.sum(axis=3)[:, 0])
            slopes.append(pulled.sum(axis=3))
            bends.append((((change * change).sum(axis=4) - pulled**2) / length).sum(axis=3))
        slope, bend = self._per_panel(slopes), self._per_panel(bends)
        gain = np.where(bend > 0, slope**2 / (2 * np.where(bend > 0, bend, 1.0)), 0.0).sum(axis=1)
        return tuple(zip(flat, self._per_panel(sizes) - gain, strict=True))

    def _per_panel(self, sums: list[np.ndarray]) -> np.ndarray:
        """Extrapolated sums of the intervals (..., m), added up per panel (..., k)."""
        each = _extrapolated(sums)
        flat = [
            np.bincount(self.panels, row, minlength=self.count)
            for row in each.reshape(-1, len(self.panels))
        ]
        return np.array(flat).reshape(*each.shape[:-1], self.count)

    def _diagonal(self, start_w: float) -> tuple[np.ndarray, np.ndarray]:
        both = np.full(self.count + 1, start_w)
        a, b = self.ends.flat(both)[:-1], self.ends.flat(1.0 - both)[1:]
        owner = np.repeat(self.panels, FINEST + 1)
        return lengths(b - a), self.rulings.crossing(a[owner], b[owner])

    def _shaped(self, points: np.ndarray) -> np.ndarray:
        """Points (..., n, d) as (..., intervals, FINEST + 1, d)."""
        return points.reshape(*points.shape[:-2], len(self.panels), FINEST + 1, points.shape[-1])

    def _length(self, points: np.ndarray) -> np.ndarray:
        each = sampled_lengths(self._shaped(points))
        return np.bincount(self.panels, each, minlength=self.count)


@dataclass(frozen=True, eq=False)
class CornerPanels:
    """Panels by the places of their corners (k + 1, 2) on the first and second edge, so that a
    line need be no ruling: a cut end. Diagonals are traced by the inverse of the flat map."""

    development: Development
    corners: np.ndarray
    folds: tuple[float, ...]

    @property
    def count(self) -> int:
        """Number of panels."""
        return len(self.corners) - 1

    def edge(self, w: float) -> tuple[np.ndarray, np.ndarray]:
        """Flat and curved length (k,) between consecutive corners on the edge w (0 or 1)."""
        places = np.ascontiguousarray(self.corners[:, int(w)])
        intervals, panels = smooth_intervals(places, self.folds)
        return tuple(
            curve_lengths(
                lambda s, _, points=points: points(s, np.full(len(s), float(w))),
                intervals,
                panels,
                self.count,
            )
            for points in (self.development.flat, self.development.point)
        )

    def geodesics(
        self, starts: tuple[float, ...] = (0.0, 1.0)
    ) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
        """Per start, as PanelSamples.geodesics: flat and geodesic length (k,) of the diagonals."""
        return tuple(self._diagonal(start) for start in starts)

    def _diagonal(self, start: float) -> tuple[np.ndarray, np.ndarray]:
        one, other = int(start), 1 - int(start)
        s = np.stack([self.corners[:-1, one], self.corners[1:, other]], axis=1)
        w = np.full(self.count, start), np.full(self.count, 1.0 - start)
        a, b = (self.development.flat(s[:, k].copy(), w[k]) for k in (0, 1))
        along = b - a
        length = np.sqrt((along * along).sum(axis=1))
        part = np.linspace(0.0, 1.0, FINEST + 1)
        target = (a[:, None] + part[:, None] * along[:, None]).reshape(-1, 2)
        place = (s[:, :1] + part * (s[:, 1:] - s[:, :1])).ravel()
        across = (w[0][:, None] + part * (w[1] - w[0])[:, None]).ravel()
        for _ in range(20):
            miss = target - self.development.flat(place, across)
            by_s, by_w = self.development.jacobian(place, across)
            determinant = by_s[:, 0] * by_w[:, 1] - by_s[:, 1] * by_w[:, 0]
            ds = (miss[:, 0] * by_w[:, 1] - miss[:, 1] * by_w[:, 0]) / determinant
            dw = (by_s[:, 0] * miss[:, 1] - by_s[:, 1] * miss[:, 0]) / determinant
            place, across = place + ds, across + dw
            if np.abs(miss).max() < 1e-8:
                break
        # Sine waves square to the diagonal in the plane, carried to the surface.
        unit = np.repeat(along / length[:, None], FINEST + 1, axis=0)
        square = np.column_stack([-unit[:, 1], unit[:, 0]])
        by_s, by_w = self.development.jacobian(place, across)
        determinant = by_s[:, 0] * by_w[:, 1] - by_s[:, 1] * by_w[:, 0]
        ds = (square[:, 0] * by_w[:, 1] - square[:, 1] * by_w[:, 0]) / determinant
        dw = (by_s[:, 0] * square[:, 1] - by_s[:, 1] * square[:, 0]) / determinant
        surface = self.development.surface
        rails, rate = surface(place), surface.derivative(place)
        ruling = rails[:, 3:] - rails[:, :3]
        tangent = rate[:, :3] + across[:, None] * (rate[:, 3:] - rate[:, :3])
        shape = (self.count, FINEST + 1, 3)
        points = self.development.point(place, across).reshape(shape)
        sideways = (ds[:, None] * tangent + dw[:, None] * ruling).reshape(shape)
        waves = np.sin(np.pi * np.arange(1, MODES + 1)[:, None] * part)[:, None, :, None] * sideways
        sizes, slopes, bends = [], [], []
        for n in (FINEST // 4, FINEST // 2, FINEST):
            chord = np.diff(points[:, :: FINEST // n], axis=1)
            change = np.diff(waves[:, :, :: FINEST // n], axis=2)
            size = np.sqrt((chord * chord).sum(axis=2))
            pulled = (chord * change).sum(axis=3) / size
            sizes.append(size.sum(axis=1))
            slopes.append(pulled.sum(axis=2))
            bends.append((((change * change).sum(axis=3) - pulled**2) / size).sum(axis=2))
        slope, bend = _extrapolated(slopes), _extrapolated(bends)
        gain = (slope**2 / (2.0 * np.where(bend > 0, bend, np.inf))).sum(axis=0)
        return length, _extrapolated(sizes) - gain


def panel_samples(
    development: Development, places: np.ndarray, folds: tuple[float, ...]
) -> PanelSamples:
    """Samples for the lengths of the panels between places (k + 1,), smooth apart from folds."""
    return samples_together(Developments((development,)), [places], [folds])


def samples_together(
    developments: Developments,
    places: Sequence[np.ndarray],
    folds: Sequence[tuple[float, ...]],
) -> PanelSamples:
    """panel_samples of many developments, each with its places (n,) and folds."""
    parts = [smooth_intervals(*own) for own in zip(places, folds, strict=True)]
    # Evaluated per development: its places, then the samples between them.
    samples = [_sampled(intervals) for intervals, _ in parts]
    first = np.cumsum([0, *(len(own) for own in places[:-1])])
    panels = np.concatenate([own + start for (_, own), start in zip(parts, first, strict=True)])
    whole = developments.rulings(
        [np.concatenate(both) for both in zip(places, samples, strict=True)]
    )
    sizes = np.array([[len(own), len(one)] for own, one in zip(places, samples, strict=True)])
    is_place = np.repeat(np.tile([True, False], len(places)), sizes.ravel())
    every, s = np.concatenate(places), np.concatenate(samples)
    owner = np.repeat(panels, FINEST + 1)
    wave = (s - every[owner]) / (every[owner + 1] - every[owner])
    return PanelSamples(every, whole.of(is_place), panels, whole.of(~is_place), wave)


def diagonal_lengths(
    development: Development,
    places: np.ndarray,
    folds: tuple[float, ...],
    start_w: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Flat and geodesic length (k,) of the panel diagonals that start at w = start_w (0 or 1).

    The curve on the surface is the preimage of the straight flat diagonal; flat and curved are
    nearly isometric, so that its excess over the geodesic is of second order in the strain.
    """
    return panel_samples(development, places, folds).diagonal(start_w)
