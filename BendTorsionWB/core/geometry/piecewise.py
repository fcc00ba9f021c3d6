# SPDX-License-Identifier: LGPL-2.1-or-later
"""Smooth-by-pieces functions of arc length, held by their values at Chebyshev points of each span.

Axis, frames, rails and flat patterns are all such functions, so that each can be evaluated,
differentiated and integrated to rounding (Trefethen, Approximation Theory and Practice, 2013).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate

import numpy as np

from ..tolerances import INTERPOLATION_RELATIVE

DEGREE = 13
_NODES = -np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
_WEIGHTS = np.where(np.arange(DEGREE + 1) % 2, -1.0, 1.0)
_WEIGHTS[[0, -1]] *= 0.5


FEW = 300
"""Rows up to which one sweep over all nodes is faster than a sweep per node."""


def _differentiation_matrix() -> np.ndarray:
    """Derivative at the nodes from values at the nodes, on [-1, 1] (Berrut & Trefethen 2004)."""
    difference = _NODES[:, None] - _NODES[None, :]
    np.fill_diagonal(difference, 1.0)
    matrix = (_WEIGHTS[None, :] / _WEIGHTS[:, None]) / difference
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix


def _integration_matrix() -> np.ndarray:
    """Integral from -1 to each node, from values at the nodes, exact for the interpolant."""
    chebyshev = np.polynomial.chebyshev
    coefficients = np.linalg.inv(chebyshev.chebvander(_NODES, DEGREE))
    integrals = chebyshev.chebint(coefficients, lbnd=-1, axis=0)
    return chebyshev.chebvander(_NODES, DEGREE + 1) @ integrals


_DIFFERENTIATE = _differentiation_matrix()
_INTEGRATE = _integration_matrix()
_LAST_COEFFICIENTS = np.linalg.inv(np.polynomial.chebyshev.chebvander(_NODES, DEGREE))[-2:]
"""The last two Chebyshev coefficients from values at the nodes."""


def _combined(matrix: np.ndarray, values: np.ndarray) -> np.ndarray:
    """matrix (i, j) applied to values (m, j, d), node by node: (m, i, d).

    Not by BLAS or einsum: their last bits vary with the alignment of memory from run to run, and
    the same input must give the same bytes.
    """
    if len(values) <= FEW // len(matrix):
        columns, nodes = matrix.T[:, None, :, None], values.swapaxes(0, 1)[:, :, None]
        return np.add.reduce(columns * nodes, axis=0)
    total = np.zeros((len(values), len(matrix), values.shape[2]))
    for j in range(values.shape[1]):
        total += matrix[:, j, None] * values[:, None, j]
    return total


def _basis(x: np.ndarray) -> np.ndarray:
    """Barycentric Lagrange basis (DEGREE + 1, m) at x (m,) in [-1, 1]."""
    difference = x - _NODES[:, None]
    if np.count_nonzero(difference) == difference.size:
        basis = _WEIGHTS[:, None] / difference
        basis /= np.add.reduce(basis, axis=0)
        return basis
    hit = difference == 0.0
    difference[hit] = 1.0
    basis = _WEIGHTS[:, None] / difference
    basis /= np.add.reduce(basis, axis=0)
    at_node = hit.any(axis=0)
    basis[:, at_node] = hit[:, at_node]
    return basis


def _weighted(basis: np.ndarray, values: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Values (m, d) at places in spans `where` (m,) of values (k, DEGREE + 1, d), by the basis
    there; a few in one sweep, many node after node."""
    if len(where) <= FEW:
        return np.add.reduce(values.take(where, axis=0).swapaxes(0, 1) * basis[..., None], axis=0)
    total = np.zeros((len(where), values.shape[2]))
    for j in range(DEGREE + 1):
        total += basis[j][:, None] * values[:, j].take(where, axis=0)
    return total


@dataclass(frozen=True, eq=False)
class Piecewise:
    """A function of s on spans between breaks (m + 1,): values (m, DEGREE + 1, d) at the nodes.

    At an inner break the value is the later span's, unless `side` asks for the earlier one's.
    """

    breaks: np.ndarray
    values: np.ndarray

    def __getstate__(self) -> dict[str, np.ndarray]:
        # What is kept beside them follows from them, and makes results three times as large.
        return {"breaks": self.breaks, "values": self.values}

    @property
    def start(self) -> float:
        return float(self.breaks[0])

    @property
    def end(self) -> float:
        return float(self.breaks[-1])

    @cached_property
    def nodes(self) -> np.ndarray:
        """The Chebyshev points of all spans, (m, DEGREE + 1)."""
        return span_nodes(self.breaks)

    @cached_property
    def derivative(self) -> Piecewise:
        """d/ds."""
        scale = 2.0 / (self.breaks[1:] - self.breaks[:-1])
        values = _combined(_DIFFERENTIATE, self.values) * scale[:, None, None]
        return Piecewise(self.breaks, values)

    @cached_property
    def with_rates(self) -> Piecewise:
        """The function, d/ds and d²/ds² side by side, to be evaluated in one sweep."""
        rate = self.derivative
        parts = [self.values, rate.values, rate.derivative.values]
        return Piecewise(self.breaks, np.concatenate(parts, axis=2))

    def antiderivative(self, initial: np.ndarray | float = 0.0) -> Piecewise:
        """The integral from the start, plus `initial`."""
        half = 0.5 * (self.breaks[1:] - self.breaks[:-1])
        values = _combined(_INTEGRATE, self.values) * half[:, None, None]
        steps = np.cumsum(values[:, -1, :], axis=0)
        values[1:] += steps[:-1, None, :]
        return Piecewise(self.breaks, values + initial)

    def integral(self) -> np.ndarray:
        """The integral over the whole range, (d,)."""
        half = 0.5 * (self.breaks[1:] - self.breaks[:-1])
        whole = _combined(_INTEGRATE[-1:], self.values)[:, 0]
        return (whole * half[:, None]).sum(axis=0)

    def __call__(self, s: np.ndarray, side: str = "later") -> np.ndarray:
        """Values (m, d) at s (m,), extrapolated from the end spans outside the range."""
        s = np.atleast_1d(np.asarray(s, float))
        where = np.searchsorted(self.breaks, s, side="right" if side == "later" else "left") - 1
        where = np.minimum(np.maximum(where, 0), len(self.breaks) - 2)
        low, high = self.breaks[where], self.breaks[where + 1]
        return _weighted(_basis((2.0 * s - low - high) / (high - low)), self.values, where)


class Together:
    """Functions of one width, each to be evaluated at places of its own, all in one sweep."""

    def __init__(self, functions: Sequence[Piecewise]):
        self._inner = [f.breaks[1:-1] for f in functions]
        self._base = list(accumulate((len(f.values) for f in functions[:-1]), initial=0))
        self._low = np.concatenate([f.breaks[:-1] for f in functions])
        self._high = np.concatenate([f.breaks[1:] for f in functions])
        self._values = np.concatenate([f.values for f in functions])

    def __call__(self, places: Sequence[np.ndarray], side: str = "later") -> np.ndarray:
        """Values (n, d), function after function, each at its own places (k,). side: as of a call
        of Piecewise, or `inside`: later, but the last place of each belongs to the span before."""
        where = []
        for inner, base, s in zip(self._inner, self._base, places, strict=True):
            own = inner.searchsorted(s, "left" if side == "earlier" else "right")
            if side == "inside":
                own[-1] = inner.searchsorted(s[-1], "left")
            where.append(own + base)
        where, s = np.concatenate(where), np.concatenate(places)
        low, high = self._low[where], self._high[where]
        return _weighted(_basis((2.0 * s - low - high) / (high - low)), self._values, where)


def evaluate_together(
    functions: Sequence[Piecewise], places: Sequence[np.ndarray], side: str = "later"
) -> list[np.ndarray]:
    """[f(s, side)] of functions of one width, each at its own places (n,), in one sweep; side as
    of Together."""
    return parted(Together(functions)(places, side), [len(p) for p in places])


def parted(values: np.ndarray, counts: Sequence[int]) -> list[np.ndarray]:
    """Values (n, …) as views of so many rows each, one after the other."""
    ends = list(accumulate(counts, initial=0))
    return [values[a:b] for a, b in zip(ends, ends[1:])]


def derivatives_together(functions: Sequence[Piecewise]) -> list[Piecewise]:
    """d/ds of functions of one width, in one sweep; each is kept as its function's own."""
    new = [f for f in functions if "derivative" not in vars(f)]
    if new:
        scale = 2.0 / np.concatenate([f.breaks[1:] - f.breaks[:-1] for f in new])
        rates = _combined(_DIFFERENTIATE, np.concatenate([f.values for f in new]))
        rates *= scale[:, None, None]
        for f, part in zip(new, parted(rates, [len(f.values) for f in new]), strict=True):
            vars(f)["derivative"] = Piecewise(f.breaks, part)
    return [f.derivative for f in functions]


def with_rates_together(functions: Sequence[Piecewise]) -> list[Piecewise]:
    """`with_rates` of functions of one width, in one sweep; each is kept as its function's own."""
    new = [f for f in functions if "with_rates" not in vars(f)]
    if new:
        rates = derivatives_together(new)
        levels = new, rates, derivatives_together(rates)
        whole = np.concatenate(
            [np.concatenate([f.values for f in level]) for level in levels], axis=2
        )
        for f, part in zip(new, parted(whole, [len(f.values) for f in new]), strict=True):
            vars(f)["with_rates"] = Piecewise(f.breaks, part)
    return [f.with_rates for f in functions]


def integrals_together(values: np.ndarray, breaks: Sequence[np.ndarray]) -> np.ndarray:
    """Integrals (k, d) of functions of one width given by their values (m, DEGREE + 1, d), span
    after span, and their breaks."""
    half = 0.5 * np.concatenate([own[1:] - own[:-1] for own in breaks])
    whole = _combined(_INTEGRATE[-1:], values)[:, 0] * half[:, None]
    return np.stack([own.sum(axis=0) for own in parted(whole, [len(own) - 1 for own in breaks])])


def antiderivatives_together(values: np.ndarray, breaks: Sequence[np.ndarray]) -> np.ndarray:
    """Values (m, DEGREE + 1, d) of the integrals from the start of each function, given as for
    integrals_together."""
    half = 0.5 * np.concatenate([own[1:] - own[:-1] for own in breaks])
    whole = _combined(_INTEGRATE, values) * half[:, None, None]
    for own in parted(whole, [len(own) - 1 for own in breaks]):
        own[1:] += np.cumsum(own[:, -1], axis=0)[:-1, None]
    return whole


def span_nodes(breaks: np.ndarray) -> np.ndarray:
    """Chebyshev points (m, DEGREE + 1) of the spans between breaks (m + 1,)."""
    breaks = np.asarray(breaks, float)
    half = 0.5 * (breaks[1:] - breaks[:-1])
    middle = 0.5 * (breaks[1:] + breaks[:-1])
    nodes = middle[:, None] + half[:, None] * _NODES
    nodes[:, 0], nodes[:, -1] = breaks[:-1], breaks[1:]
    return nodes


def sample(function: Callable[[np.ndarray], np.ndarray], breaks: np.ndarray) -> Piecewise:
    """`function` (s (n,) -> (n, d), smooth on each span) on the given spans, not refined."""
    nodes = span_nodes(breaks)
    return Piecewise(np.asarray(breaks, float), function(nodes.ravel()).reshape(*nodes.shape, -1))


def resolve(
    function: Callable[[np.ndarray], np.ndarray],
    breaks: np.ndarray,
    size: float,
    deepest: int = 12,
) -> Piecewise:
    """`function` on spans halved until its last Chebyshev coefficients are rounding noise.

    size: magnitude against which INTERPOLATION_RELATIVE counts. `deepest` halvings at most, so
    that a kink inside a span ends in a span too short to matter.
    """
    breaks = np.asarray(breaks, float)
    done: list[tuple[float, float, np.ndarray]] = []
    pending = breaks
    spans = np.column_stack([pending[:-1], pending[1:]])
    for depth in range(deepest + 1):
        half, middle = 0.5 * (spans[:, 1] - spans[:, 0]), 0.5 * spans.sum(axis=1)
        nodes = middle[:, None] + half[:, None] * _NODES
        nodes[:, 0], nodes[:, -1] = spans[:, 0], spans[:, 1]
        values = function(nodes.ravel()).reshape(*nodes.shape, -1)
        tail = np.abs(_combined(_LAST_COEFFICIENTS, values)).max(axis=(1, 2))
        good = (tail <= 20 * INTERPOLATION_RELATIVE * size) | (depth == deepest)
        done += [(a, b, v) for (a, b), v in zip(spans[good], values[good], strict=True)]
        rest = spans[~good]
        if not len(rest):
            break
        middle = 0.5 * rest.sum(axis=1)
        spans = np.concatenate(
            [np.column_stack([rest[:, 0], middle]), np.column_stack([middle, rest[:, 1]])]
        )
    done.sort(key=lambda item: item[0])
    all_breaks = np.array([item[0] for item in done] + [done[-1][1]])
    return Piecewise(all_breaks, np.stack([item[2] for item in done]))


def unresolved(functions: Sequence[Piecewise], size: float) -> list[np.ndarray]:
    """Of functions of one width, the spans in which the last Chebyshev coefficients are larger
    than `size`, so that the function may be elsewhere between their nodes."""
    values = np.concatenate([function.values for function in functions])
    tail = np.abs(_combined(_LAST_COEFFICIENTS, values)).max(axis=(1, 2))
    return [np.flatnonzero(own > size) for own in parted(tail, [len(f.values) for f in functions])]


def merged_breaks(*groups: np.ndarray, start: float, end: float, least: float) -> np.ndarray:
    """Sorted breaks from several groups between start and end, none closer than `least`."""
    inner = np.concatenate([np.ravel(group) for group in groups]) if groups else np.empty(0)
    inner = np.sort(inner[(inner > start + least) & (inner < end - least)])
    if len(inner):
        inner = inner[np.concatenate([[True], np.diff(inner) > least])]
    return np.concatenate([[start], inner, [end]])
