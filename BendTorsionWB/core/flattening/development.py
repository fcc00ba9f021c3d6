# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ruling development: a two-rail ruled patch laid flat by quadrature along its rulings.

For rails P0(s), P1(s), R = P1 − P0, ρ = |R|, w in [0, 1]: W(s, w) = √(EG − F²)/ρ and
q = P0'·R/ρ. In the plane x = c + wρd, d = (−sin θ, cos θ), d⊥ = (cos θ, sin θ), c' = p d⊥ + q d,
θ' = m/ρ: every ruling stays straight and rigid and shear is zero; p and m are free per station.
`edges` takes p = W(0), m = W(0) − W(1), so that both long edges keep their length exactly;
`energy` the p and m of least square strain. A fold along a ruling is crossed rigidly, since the
ruling belongs to both sides. A correction (the `elastic` mode) moves points off their rulings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..finding import BendTorsionError, error
from ..geometry.piecewise import (
    Piecewise,
    antiderivatives_together,
    derivatives_together,
    parted,
)
from ..geometry.vectors import dots, lengths

ACROSS = np.linspace(0.0, 1.0, 5)
"""Places across a plate at which guards and strains are taken."""

RULING_MODES = ("edges", "energy")
"""What a ruling development keeps best: the length of both edges, or its strain low."""

_GAUSS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, eq=False)
class Rulings:
    """Rulings of a development at n places: first points (n, 3) and vectors (n, 3) to the second
    edge, the same in the plane (n, 2), and the Legendre coefficients (n, k, 2) of a correction."""

    first: np.ndarray
    ruling: np.ndarray
    flat_first: np.ndarray
    flat_ruling: np.ndarray
    correction: np.ndarray | None

    def of(self, chosen: np.ndarray) -> Rulings:
        """Some of the rulings."""
        return Rulings(*(None if part is None else part[chosen] for part in vars(self).values()))

    def point(self, w: np.ndarray) -> np.ndarray:
        """Points (n, 3) of the curved surface at w (n,)."""
        return self.first + np.asarray(w)[:, None] * self.ruling

    def flat(self, w: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the plane at w (n,)."""
        straight = self.flat_first + np.asarray(w)[:, None] * self.flat_ruling
        if self.correction is None:
            return straight
        return straight + _across(self.correction, legendre(np.asarray(w), self._terms)[0])

    def crossing(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """w (n,) where they cross the flat straight lines a-b, each (n, 2)."""
        along = b - a
        w = _cross(a - self.flat_first, along) / _cross(self.flat_ruling, along)
        for _ in range(0 if self.correction is None else NEWTON_STEPS):
            value, slope = legendre(w, self._terms)
            flat = self.flat_first + w[:, None] * self.flat_ruling
            flat = flat + _across(self.correction, value)
            rate = self.flat_ruling + _across(self.correction, slope)
            w = w + _cross(a - flat, along) / _cross(rate, along)
        return w

    @property
    def _terms(self) -> int:
        return self.correction.shape[1]


def rulings_of(rails: np.ndarray, plane: np.ndarray, correction: np.ndarray | None) -> Rulings:
    """Rulings from the values of a surface (n, 6) and its plane (n, 4), c, θ, ρ."""
    return Rulings(
        rails[:, :3],
        rails[:, 3:] - rails[:, :3],
        plane[:, :2],
        plane[:, 3:] * _ruling_direction(plane[:, 2]),
        correction,
    )


@dataclass(frozen=True, eq=False)
class Development:
    """A flat pattern: surface rails s -> (6,), and the plane's c, θ, ρ as s -> (4,).

    The plane is seen from the side of the normal P' × R: s runs along d⊥, w along d. correction:
    what is added to the plane's points, s -> (2k,), x and y of k Legendre polynomials in 2w − 1.
    """

    surface: Piecewise
    plane: Piecewise
    correction: Piecewise | None = None

    @cached_property
    def _both(self) -> Piecewise:
        """Surface and plane, which have the same breaks, side by side."""
        values = np.concatenate([self.surface.values, self.plane.values], axis=2)
        return Piecewise(self.surface.breaks, values)

    def rulings(self, s: np.ndarray) -> Rulings:
        """The rulings at s (n,)."""
        both, correction = self._both(s), None
        if self.correction is not None:
            correction = self.correction(s).reshape(len(both), -1, 2)
        return rulings_of(both[:, :6], both[:, 6:], correction)

    def point(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Points (n, 3) of the curved surface at (s, w)."""
        rails = self.surface(s)
        return rails[:, :3] + np.asarray(w)[:, None] * (rails[:, 3:] - rails[:, :3])

    def flat(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the plane at (s, w)."""
        value = self.plane(s)
        direction = _ruling_direction(value[:, 2])
        flat = value[:, :2] + (np.asarray(w) * value[:, 3])[:, None] * direction
        if self.correction is None:
            return flat
        correction = self.correction(s).reshape(len(flat), -1, 2)
        return flat + _across(correction, legendre(np.asarray(w), correction.shape[1])[0])

    def ruling_crossing(self, s: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """w (n,) where the rulings at s (n,) cross the flat straight lines a-b, each (n, 2)."""
        return self.rulings(s).crossing(a, b)

    def jacobian(self, s: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dx/ds and dx/dw (n, 2) of the plane's points at (s, w)."""
        value, slope = self.plane(s), self.plane.derivative(s)
        direction = _ruling_direction(value[:, 2])
        normal = np.column_stack([direction[:, 1], -direction[:, 0]])
        w = np.asarray(w)
        by_s = slope[:, :2] + w[:, None] * (
            slope[:, 3:] * direction - (value[:, 3] * slope[:, 2])[:, None] * normal
        )
        by_w = value[:, 3:] * direction
        if self.correction is None:
            return by_s, by_w
        terms = self.correction.values.shape[2] // 2
        poly, steep = legendre(w, terms)
        shape = (len(value), terms, 2)
        by_s = by_s + _across(self.correction.derivative(s).reshape(shape), poly)
        return by_s, by_w + _across(self.correction(s).reshape(shape), steep)


NEWTON_STEPS = 3
"""Steps that find where a corrected ruling crosses a line; the correction is a small one."""


def legendre(w: np.ndarray, terms: int) -> tuple[np.ndarray, np.ndarray]:
    """The first `terms` Legendre polynomials in 2w − 1 and their derivatives by w, (n, terms)."""
    u = 2.0 * w - 1.0
    value, slope = [np.ones_like(u), u], [np.zeros_like(u), np.full_like(u, 2.0)]
    for k in range(2, terms):
        value.append(((2 * k - 1) * u * value[-1] - (k - 1) * value[-2]) / k)
        slope.append(slope[-2] + 2.0 * (2 * k - 1) * value[-2])
    return np.stack(value[:terms], axis=1), np.stack(slope[:terms], axis=1)


def _across(coefficients: np.ndarray, weights: np.ndarray) -> np.ndarray:
    total = np.zeros((len(coefficients), coefficients.shape[2]))
    for k in range(coefficients.shape[1]):
        total += weights[:, k, None] * coefficients[:, k]
    return total


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _ruling_direction(theta: np.ndarray) -> np.ndarray:
    """d = (−sin θ, cos θ), (n, 2). From a copy: numpy's sine of a strided view takes another path
    from run to run, with other last bits."""
    theta = theta.copy()
    direction = np.empty((len(theta), 2))
    direction[:, 0], direction[:, 1] = -np.sin(theta), np.cos(theta)
    return direction


def develop(rails: Piecewise, name: str = "plate", mode: str = "edges") -> Development:
    """The development of a ruled surface given by rails s -> (6,), P0 then P1.

    Every ruling keeps its length; in `edges` both edges do too, in `energy` ∫e²dA is least.
    Raises BendTorsionError, with the place, where the surface or its pattern folds over itself
    (W <= 0, p − wm <= 0) or a ruling has no length.
    """
    return develop_together([rails], [name], mode)[0]


def develop_together(
    rails: Sequence[Piecewise], names: Sequence[str], mode: str = "edges"
) -> list[Development]:
    """`develop` of many surfaces in one sweep; raises BendTorsionError for the first that fails."""
    values = np.concatenate([one.values for one in rails])
    rate = np.concatenate([one.values for one in derivatives_together(rails)])

    def guard(positive: np.ndarray, problem: str, unit: str) -> None:
        if (positive <= 0).any():
            for name, one, own in zip(names, rails, parted(positive, counts), strict=True):
                _guard(name, one, own, problem, unit)

    counts, breaks = [len(one.values) for one in rails], [one.breaks for one in rails]
    ruling = values[..., 3:] - values[..., :3]
    width = lengths(ruling)
    guard(width, "the strip has no width", "mm")
    unit = ruling / width[..., None]
    slip = dots(rate[..., :3], unit)
    first = rate[..., :3] - slip[..., None] * unit
    second = rate[..., 3:] - dots(rate[..., 3:], unit)[..., None] * unit
    one_way = dots(first, second) / lengths(first)
    guard(one_way, "the plate folds over itself: its second edge runs back", "mm/mm")
    p, m = {"edges": _keep_edges, "energy": _least_strain}[mode](first, second)
    edge = np.minimum(p, p - m)
    guard(edge, "the pattern folds over itself: an edge runs back", "mm/mm")
    angle = antiderivatives_together((m / width)[..., None], breaks)[..., 0]
    cos, sin = np.cos(angle), np.sin(angle)
    velocity = np.stack([p * cos - slip * sin, p * sin + slip * cos], axis=2)
    path = antiderivatives_together(velocity, breaks)
    plane = np.concatenate([path, angle[..., None], width[..., None]], axis=2)
    return [
        Development(one, Piecewise(one.breaks, part))
        for one, part in zip(rails, parted(plane, counts), strict=True)
    ]


def _keep_edges(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    p = lengths(first)
    return p, p - lengths(second)


def _least_strain(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """p, m of least ∫((p − wm)/W − 1)²W dw: the normal equations of two unknowns per station."""
    moments = [np.zeros(first.shape[:2]) for _ in range(3)]
    for node, weight in zip(*_GAUSS, strict=True):
        w = 0.5 * (node + 1.0)
        stretched = 0.5 * weight / lengths(first + w * (second - first))
        for k, moment in enumerate(moments):
            moment += stretched * w**k
    i0, i1, i2 = moments
    determinant = i0 * i2 - i1 * i1
    return (i2 - 0.5 * i1) / determinant, (i1 - 0.5 * i0) / determinant


def strain(development: Development, s: np.ndarray, w: np.ndarray) -> np.ndarray:
    """The principal strain of laying flat that is largest in size, (n, k) at s (n,) and w (k,).

    Recomputed from the finished pattern. Rulings that stay rigid and square leave one strain,
    e = (p − wm)/W − 1, the area per unit of (s, w), flat over curved; a corrected pattern has two,
    from its first fundamental form and the surface's.
    """
    if development.correction is not None:
        pair = principal_strains(development, s, w)
        return np.where(np.abs(pair[0]) >= np.abs(pair[1]), pair[0], pair[1])
    return ruling_strain(
        development.plane(s),
        development.plane.derivative(s),
        development.surface(s),
        development.surface.derivative(s),
        w,
    )


def strain_at_nodes(development: Development, w: np.ndarray) -> np.ndarray:
    """strain() at all nodes of the pieces, both sides of a fold each with its own limit."""
    nodes = development.plane.nodes
    if development.correction is not None:
        middle = nodes.mean(axis=1, keepdims=True)
        return strain(development, (nodes + (middle - nodes) * 1e-9).ravel(), w)
    plane, surface = development.plane, development.surface
    return ruling_strain(
        *(
            piece.values.reshape(nodes.size, -1)
            for piece in (plane, plane.derivative, surface, surface.derivative)
        ),
        w,
    )


def ruling_strain(
    plane: np.ndarray, slope: np.ndarray, rails: np.ndarray, rate: np.ndarray, w: np.ndarray
) -> np.ndarray:
    """The strain (n, k) across rigid rulings, from values and rates of plane and surface (n, …)."""
    angle = plane[:, 2].copy()
    along = np.cos(angle) * slope[:, 0] + np.sin(angle) * slope[:, 1]
    flat = along[:, None] - w * (slope[:, 2] * plane[:, 3])[:, None]
    ruling = rails[:, 3:] - rails[:, :3]
    width = lengths(ruling)
    unit = ruling / width[:, None]
    first, second = (one - dots(one, unit)[:, None] * unit for one in (rate[:, :3], rate[:, 3:]))
    across = first[:, None] + w[None, :, None] * (second - first)[:, None]
    return flat / lengths(across) - 1.0


def principal_strains(
    development: Development, s: np.ndarray, w: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The larger and the smaller principal strain, each (n, k), at s (n,) and w (k,)."""
    n, k = len(s), len(w)
    wide = np.tile(w, n)
    by_s, by_w = development.jacobian(np.repeat(s, k), wide)
    rails, rate = np.repeat(development.surface(s), k, 0), development.surface.derivative(s)
    rate = np.repeat(rate, k, 0)
    ruling = rails[:, 3:] - rails[:, :3]
    tangent = rate[:, :3] + wide[:, None] * (rate[:, 3:] - rate[:, :3])
    width = lengths(ruling)
    slip = (tangent * ruling).sum(axis=1) / width
    square = np.sqrt((tangent * tangent).sum(axis=1) - slip**2)
    two = by_w / width[:, None]
    one = (by_s - slip[:, None] * two) / square[:, None]
    e11, e22 = 0.5 * ((one * one).sum(axis=1) - 1.0), 0.5 * ((two * two).sum(axis=1) - 1.0)
    e12 = 0.5 * (one * two).sum(axis=1)
    middle, radius = 0.5 * (e11 + e22), np.sqrt(0.25 * (e11 - e22) ** 2 + e12**2)
    return tuple(
        (np.sqrt(1.0 + 2.0 * green) - 1.0).reshape(n, k)
        for green in (middle + radius, middle - radius)
    )


def flat_area(development: Development) -> float:
    """Area of the flat pattern, mm2, by quadrature of the finished map's Jacobian."""
    plane = development.plane
    if development.correction is None:
        strip = ruling_area(plane.values, plane.derivative.values)
        return float(Piecewise(plane.breaks, strip[..., None]).integral()[0])
    correction = development.correction
    breaks = np.unique(np.concatenate([plane.breaks, correction.breaks]))
    nodes, weights = _GAUSS
    half, middle = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
    s = (middle[:, None] + half[:, None] * nodes).ravel()
    by_s, by_w = development.jacobian(np.repeat(s, 8), np.tile(0.5 * (nodes + 1.0), len(s)))
    density = _cross(by_s, by_w).reshape(len(half), 8, 8)
    return float((density * weights[:, None] * weights * (0.5 * half)[:, None, None]).sum())


def ruling_area(plane: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Area (...) swept in the plane by rigid rulings per unit of s, from values and rates (..., 4)
    of the plane."""
    angle = plane[..., 2].copy()
    along = slope[..., 0] * np.cos(angle) + slope[..., 1] * np.sin(angle)
    return plane[..., 3] * along - 0.5 * plane[..., 3] ** 2 * slope[..., 2]


def _guard(name: str, rails: Piecewise, positive: np.ndarray, problem: str, unit: str) -> None:
    """Raises BendTorsionError where what must be positive, mm or mm per mm of axis, is not."""
    if (positive <= 0).any():
        at = np.unravel_index(int(np.argmin(positive)), positive.shape)
        raise BendTorsionError(
            error(
                "plate-folds-over",
                name,
                problem,
                "use a smaller section or a smoother axis",
                position=f"s = {rails.nodes[at]:.0f} mm",
                value=float(positive[at]),
                limit=0.0,
                unit=unit,
            )
        )
