# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins: rails as cubic B-splines on common stations, the poles solids are written from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..geometry.piecewise import Piecewise, derivatives_together, evaluate_together

FEWEST_INTERVALS = 4
MOST_INTERVALS = 4096


@dataclass(frozen=True, eq=False)
class SkinPiece:
    """Rails over one smooth piece: knots (n + 4,) shared by all, poles (m, n, 3).

    The parameter is arc length on the axis, for the first group of rails exactly."""

    knots: np.ndarray
    poles: np.ndarray

    def at(self, s: np.ndarray) -> np.ndarray:
        """Points (k, m, 3) of all rails at arc lengths s (k,)."""
        return at_places([self], [np.asarray(s, float)])[0]


@dataclass(frozen=True, eq=False)
class _Work:
    """A piece to be made: per group of rails, its range; the stations of the first group."""

    groups: tuple[int, ...]
    ranges: tuple[tuple[float, float], ...]
    count: int

    def places(self, shift: float, number: int) -> list[np.ndarray]:
        """Per group, `number` places from the start on, `shift` intervals off the stations."""
        steps = np.arange(number) + shift
        return [a + steps * ((b - a) / self.count) for a, b in self.ranges]


def skin(
    rails: Sequence[Piecewise],
    folds: Sequence[Sequence[float]] = (),
    spacing: float = 1000.0,
    tolerance: float = tolerances.SKIN_CORNER,
) -> tuple[SkinPiece, ...]:
    """Cubic B-splines through one or more groups of rails s -> (m * 3,), end tangents clamped.

    folds: per group, the places its rails are broken at, the same number in each (a plate's inner
    rails are broken at the mitre, not below the outer fold). Each piece starts with stations no
    farther apart than `spacing` and doubles them until every rail agrees with its spline midway
    between stations to `tolerance` (mm). All rails of a piece share stations and knots:
    separately parameterised edges of one plate never close.
    """
    return skins([(rails, folds or [()] * len(rails))], spacing, tolerance)[0]


def skins(
    tubes: Sequence[tuple[Sequence[Piecewise], Sequence[Sequence[float]]]],
    spacing: float = 1000.0,
    tolerance: float = tolerances.SKIN_CORNER,
) -> list[tuple[SkinPiece, ...]]:
    """The skins of many tubes (rails, folds), all groups of one width, made together."""
    functions = [group for rails, _ in tubes for group in rails]
    if not functions:
        return []
    rates = derivatives_together(functions)
    work, owner, first = [], [], 0
    for index, (rails, folds) in enumerate(tubes):
        groups = tuple(range(first, first + len(rails)))
        first += len(rails)
        edges = [
            [functions[g].start, *sorted(own), functions[g].end]
            for g, own in zip(groups, folds, strict=True)
        ]
        for k in range(len(edges[0]) - 1):
            ranges = tuple((own[k], own[k + 1]) for own in edges)
            length = ranges[0][1] - ranges[0][0]
            count = max(FEWEST_INTERVALS, int(np.ceil(length / spacing)))
            work.append(_Work(groups, ranges, count))
            owner.append(index)
    done: dict[int, SkinPiece] = {}
    pending = dict(enumerate(work))
    while pending:
        made = dict(zip(pending, _interpolated([*pending.values()], functions, rates), strict=True))
        truth = _joined(
            evaluate_together,
            [*pending.values()],
            functions,
            lambda item: item.places(0.5, item.count),
        )
        middles = [(p.knots[3:-4] + p.knots[4:-3]) * 0.5 for p in made.values()]
        again, accepted = {}, {}
        for index, exact, built in zip(
            pending, truth, at_places([*made.values()], middles), strict=True
        ):
            miss = exact.reshape(built.shape) - built
            item = pending[index]
            good = (miss * miss).sum(axis=2).max() <= tolerance**2
            if good or item.count >= MOST_INTERVALS:
                accepted[index] = miss
            else:
                again[index] = _Work(item.groups, item.ranges, 2 * item.count)
        done.update(_balanced({index: made[index] for index in accepted}, accepted))
        pending = again
    tubes_of: list[list[SkinPiece]] = [[] for _ in tubes]
    for index, tube in enumerate(owner):
        tubes_of[tube].append(done[index])
    return [tuple(pieces) for pieces in tubes_of]


def _balanced(pieces: dict[int, SkinPiece], misses: dict[int, np.ndarray]) -> dict[int, SkinPiece]:
    """The pieces with half their error midway between stations moved to the stations.

    A cubic through even stations errs to one side, f⁗h⁴/384 midway and nothing at the stations;
    shared between both, the largest error is half of it. The ends stay where they are.
    """
    done = {}
    for count in sorted({len(miss) for miss in misses.values()}):
        mine = [index for index, miss in misses.items() if len(miss) == count]
        miss = np.stack([misses[index] for index in mine], axis=1)
        at_stations = np.zeros((count + 1, *miss.shape[1:]))
        at_stations[1:-1] = 0.25 * (miss[1:] + miss[:-1])
        poles = _poles(at_stations, np.zeros((2, *miss.shape[1:])))
        for column, index in enumerate(mine):
            piece = pieces[index]
            done[index] = SkinPiece(piece.knots, piece.poles + poles[:, column].transpose(1, 0, 2))
    return done


def at_places(pieces: Sequence[SkinPiece], places: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Points (k, m, 3) of each piece at its own places (k,)."""
    return [values for values, _ in values_and_rates(pieces, places, rates=False)]


def values_and_rates(
    pieces: Sequence[SkinPiece], places: Sequence[np.ndarray], rates: bool = True
) -> list[tuple[np.ndarray, np.ndarray | None]]:
    """Points and their rates per unit of parameter (k, m, 3) of each piece at its own places."""
    if not pieces:
        return []
    spans, base = [], 0
    for piece, u in zip(pieces, places, strict=True):
        spans.append(base + 3 + np.searchsorted(piece.knots[4:-4], u, side="right"))
        base += len(piece.knots)
    # Poles are counted like the knots, so that one index serves both.
    padding = np.zeros((4, pieces[0].poles.shape[0], 3))
    poles = np.concatenate([part for p in pieces for part in (p.poles.swapaxes(0, 1), padding)])
    span, u = np.concatenate(spans), np.concatenate(places)
    basis, slopes = _basis(np.concatenate([p.knots for p in pieces]), span, u)
    nearby = [poles[span - 3 + j] for j in range(4)]
    ends = np.cumsum([len(s) for s in places])[:-1]
    values = np.split(sum(b[:, None, None] * p for b, p in zip(basis, nearby, strict=True)), ends)
    if not rates:
        return [(value, None) for value in values]
    slopes = np.split(sum(b[:, None, None] * p for b, p in zip(slopes, nearby, strict=True)), ends)
    return list(zip(values, slopes, strict=True))


def _basis(knots: np.ndarray, span: np.ndarray, u: np.ndarray) -> tuple[list, list]:
    """The four cubic B-splines at u (k,) of knot spans (k,), and their slopes (Piegl & Tiller
    1997, A2.2)."""
    left = [None, *(u - knots[span + 1 - j] for j in (1, 2, 3))]
    right = [None, *(knots[span + j] - u for j in (1, 2, 3))]
    basis = [np.ones_like(u)]
    parts: list = []
    for degree in (1, 2, 3):
        parts = [basis[r] / (right[r + 1] + left[degree - r]) for r in range(degree)]
        basis = (
            [right[1] * parts[0]]
            + [
                left[degree + 1 - r] * parts[r - 1] + right[r + 1] * parts[r]
                for r in range(1, degree)
            ]
            + [left[1] * parts[-1]]
        )
    a, b, c = parts
    return basis, [-3.0 * a, 3.0 * (a - b), 3.0 * (b - c), 3.0 * c]


def _joined(evaluate, work, functions, places_of) -> list[np.ndarray]:
    """Values of all groups of each piece side by side (k, m * 3)."""
    places = [place for item in work for place in places_of(item)]
    values = iter(evaluate([functions[g] for item in work for g in item.groups], places))
    return [np.concatenate([next(values) for _ in item.groups], axis=1) for item in work]


def _interpolated(
    work: Sequence[_Work], functions: Sequence[Piecewise], rates: Sequence[Piecewise]
) -> list[SkinPiece]:
    """Cubics through even stations with clamped ends, by one elimination per count of stations."""

    def from_inside(chosen, places):
        return evaluate_together(chosen, places, side="inside")

    values = _joined(
        from_inside,
        work,
        functions,
        lambda item: [np.linspace(a, b, item.count + 1) for a, b in item.ranges],
    )
    slopes = _joined(
        from_inside, work, rates, lambda item: [np.array(ends) for ends in item.ranges]
    )
    pieces: dict[int, SkinPiece] = {}
    for count in sorted({item.count for item in work}):
        mine = [i for i, item in enumerate(work) if item.count == count]
        stations = np.stack([values[i] for i in mine], axis=1)
        # Rates per interval: of each group by its own length.
        lengths = np.array(
            [
                np.repeat(
                    [(b - a) / count for a, b in work[i].ranges],
                    values[i].shape[1] // len(work[i].ranges),
                )
                for i in mine
            ]
        )
        ends = np.stack([slopes[i] for i in mine], axis=1) * lengths
        poles = _poles(stations, ends)
        for column, i in enumerate(mine):
            a, b = work[i].ranges[0]
            s = np.linspace(a, b, count + 1)
            knots = np.concatenate([[a] * 3, s, [b] * 3])
            own = poles[:, column].reshape(count + 3, -1, 3).transpose(1, 0, 2)
            pieces[i] = SkinPiece(knots, np.ascontiguousarray(own))
    return [pieces[i] for i in range(len(work))]


def _poles(values: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Poles (n + 3, …) of the clamped cubics through values (n + 1, …) at even stations with
    rates per interval `ends` (2, …); n >= 4. The rows are 1/6 4/6 1/6, next to the ends
    1/4 7/12 1/6."""
    n = len(values) - 1
    poles = np.empty((n + 3, *values.shape[1:]))
    poles[0], poles[-1] = values[0], values[-1]
    poles[1], poles[-2] = values[0] + ends[0] / 3.0, values[-1] - ends[1] / 3.0
    low, middle, high = np.full((3, n - 1), 1.0 / 6.0)
    middle *= 4.0
    middle[[0, -1]] = 7.0 / 12.0
    low[0] = high[-1] = 0.25
    right = values[1:-1].copy()
    right[0] -= low[0] * poles[1]
    right[-1] -= high[-1] * poles[-2]
    for i in range(1, n - 1):
        factor = low[i] / middle[i - 1]
        middle[i] -= factor * high[i - 1]
        right[i] -= factor * right[i - 1]
    poles[n] = right[-1] / middle[-1]
    for i in range(n - 3, -1, -1):
        poles[i + 2] = (right[i] - high[i] * poles[i + 3]) / middle[i]
    return poles
