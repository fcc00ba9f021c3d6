# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic optimum of a flat pattern: a ruling development relaxed to least membrane energy.

The correction to the ruling development is a cubic B-spline along the plate, its knots refined
towards ends and folds, times Legendre polynomials across. Energy is that of the Green strain
against the exact metric of the surface, plane stress; Gauss-Newton steps with the banded matrix
of the ruling development, taken anew only where they stall. Every sum and the factorisation are
written out: BLAS and LAPACK vary in the last bits from run to run, and these reach files.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline

from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, span_nodes
from .development import Development, legendre

TERMS = 5
POISSON = 0.3
STEP_TOLERANCE = 1e-7
"""mm: the relaxation ends when the steps still to come are smaller than this."""
MOST_STEPS = 40
_ALONG = np.polynomial.legendre.leggauss(4)
_FINEST_SPAN, _COARSEST_SPAN, _GROWTH = 0.12, 0.5, 1.7


def relaxed(
    development: Development,
    folds: tuple[float, ...] = (),
    name: str = "plate",
    refinement: int = 1,
    terms: int = TERMS,
) -> Development:
    """The development of least membrane energy, starting from a ruling development.

    folds: places the mid-surface is folded at. refinement halves the knot spans that often over.
    Raises BendTorsionError when the steps do not settle.
    """
    spline = _spline(development, folds, refinement, terms)
    fields = _fields(development, spline)
    coefficients = np.zeros((spline.count, terms, 2))
    factor = _factorised(fields, spline, coefficients)
    before = np.inf
    for _ in range(MOST_STEPS):
        step = _solved(factor, _gradient(fields, spline, coefficients)).reshape(coefficients.shape)
        coefficients = coefficients - step
        size = float(np.abs(step).max())
        ratio = size / before
        if size * min(1.0, ratio) < STEP_TOLERANCE:
            return replace(development, correction=_as_pieces(spline, coefficients))
        if ratio > 0.2 and np.isfinite(before):
            factor, size = _factorised(fields, spline, coefficients), np.inf
        before = size
    raise BendTorsionError(
        error(
            "elastic-not-settled",
            name,
            "the elastic pattern does not settle",
            "use the mode edges or energy",
            value=before,
            limit=STEP_TOLERANCE,
            unit="mm",
        )
    )


def membrane_energy(
    development: Development, folds: tuple[float, ...] = (), poisson: float = POISSON
) -> float:
    """Membrane energy of laying flat over E·t, mm2: ½∫(E11² + E22² + 2νE11E22 + 2(1−ν)E12²)dA
    ÷ (1 − ν²), E the Green strain; 24 × 9 Gauss points a width."""
    plain = replace(development, correction=None)
    spline = _spline(plain, folds, 4, 9)
    fields = _fields(plain, spline)
    one, two = fields.one, fields.two
    if development.correction is not None:
        s, w = np.repeat(fields.s, len(fields.w)), np.tile(fields.w, len(fields.s))
        one, two = _unit_gradients(development, s, w, fields)
    e11, e22, e12 = _green(one, two)
    density = e11**2 + e22**2 + 2 * poisson * e11 * e22 + 2 * (1 - poisson) * e12**2
    return float(0.5 * (fields.weight * density).sum() / (1 - poisson**2))


def distance(one: Development, other: Development) -> float:
    """Largest distance, mm, between two patterns of one plate after the best rigid alignment of
    a grid of 129 x 5 points."""
    s = np.repeat(np.linspace(one.plane.start, one.plane.end, 129), 5)
    w = np.tile(np.linspace(0.0, 1.0, 5), 129)
    a, b = one.flat(s, w), other.flat(s, w)
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    turn = np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    cos, sin = np.cos(turn), np.sin(turn)
    turned = np.column_stack([cos * a[:, 0] - sin * a[:, 1], sin * a[:, 0] + cos * a[:, 1]])
    return float(np.sqrt(((turned - b) ** 2).sum(axis=1)).max())


@dataclass(frozen=True, eq=False)
class _Spline:
    """Cubic B-splines along: knots, spans (n, 2) that are not empty, first spline of each."""

    knots: np.ndarray
    spans: np.ndarray
    first: np.ndarray
    terms: int

    @property
    def count(self) -> int:
        return len(self.knots) - 4

    def local(self, s: np.ndarray, derivative: int = 0) -> np.ndarray:
        """The four splines of each span at s (n, q), (n, q, 4)."""
        whole = BSpline(self.knots, np.eye(self.count), 3)
        values = (whole.derivative() if derivative else whole)(s.ravel())
        values = values.reshape(*s.shape, self.count)
        return np.take_along_axis(values, (self.first[:, None] + np.arange(4))[:, None], axis=2)


@dataclass(frozen=True, eq=False)
class _Fields:
    """At the Gauss points of n spans: places s (n·q,) and w (k,); the shape functions' rates
    (n, q·k, 4·terms) along both unit directions of the surface; the flat unit vectors (n, q·k, 2)
    of the ruling development; area weights (n, q·k)."""

    s: np.ndarray
    w: np.ndarray
    along: np.ndarray
    across: np.ndarray
    one: np.ndarray
    two: np.ndarray
    weight: np.ndarray


def _spline(
    development: Development, folds: tuple[float, ...], refinement: int, terms: int
) -> _Spline:
    plane = development.plane
    width = float(plane.values[..., 3].mean())
    edges = [plane.start, *(f for f in folds if plane.start < f < plane.end), plane.end]
    knots = [np.repeat(edges[0], 4)]
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        knots += [_graded(a, b, width, refinement)[1:-1], np.repeat(b, 3)]
    knots = np.concatenate([*knots, [edges[-1]]])
    first = np.flatnonzero(np.diff(knots) > 0)
    return _Spline(knots, np.column_stack([knots[first], knots[first + 1]]), first - 3, terms)


def _graded(a: float, b: float, width: float, refinement: int) -> np.ndarray:
    """Breaks from a to b, spans growing from both ends to COARSEST_SPAN widths in the middle."""
    half, sizes = 0.5 * (b - a) / width, []
    size = _FINEST_SPAN
    while sum(sizes) + size < half and size < _COARSEST_SPAN:
        sizes.append(size)
        size *= _GROWTH
    rest = 2.0 * (half - sum(sizes))
    middle = max(1, int(np.ceil(rest / _COARSEST_SPAN)))
    spans = np.array([*sizes, *[rest / middle] * middle, *sizes[::-1]])
    spans = np.repeat(spans / refinement, refinement)
    breaks = a + np.concatenate([[0.0], np.cumsum(spans)]) * width
    breaks[-1] = b
    return breaks


def _fields(development: Development, spline: _Spline) -> _Fields:
    nodes, weights = _ALONG
    half = 0.5 * (spline.spans[:, 1] - spline.spans[:, 0])
    s = 0.5 * spline.spans.sum(axis=1)[:, None] + half[:, None] * nodes
    across, weights_w = np.polynomial.legendre.leggauss(spline.terms + 1)
    w = 0.5 * (across + 1.0)
    n, q, k = len(s), len(nodes), len(w)
    poly, steep = legendre(w, spline.terms)
    value, rate = spline.local(s), spline.local(s, 1)
    rails, slope = development.surface(s.ravel()), development.surface.derivative(s.ravel())
    ruling = rails[:, 3:] - rails[:, :3]
    width = np.sqrt((ruling * ruling).sum(axis=1))
    unit = ruling / width[:, None]
    tangent = slope[:, None, :3] + w[None, :, None] * (slope[:, 3:] - slope[:, :3])[:, None]
    slip = (tangent * unit[:, None]).sum(axis=2)
    square = np.sqrt((tangent * tangent).sum(axis=2) - slip**2)
    by_w = (value[:, :, None, :, None] * steep[:, None]).reshape(n * q, k, -1)
    by_s = (rate[:, :, None, :, None] * poly[:, None]).reshape(n * q, k, -1)
    two = by_w / width[:, None, None]
    one = (by_s - slip[..., None] * two) / square[..., None]
    wide = np.tile(w, n * q)
    flat_s, flat_w = development.jacobian(np.repeat(s.ravel(), k), wide)
    flat_two = flat_w / np.repeat(width, k)[:, None]
    flat_one = (flat_s - slip.ravel()[:, None] * flat_two) / square.ravel()[:, None]
    area = square * width[:, None] * 0.5 * weights_w * (half[:, None] * weights).reshape(-1, 1)
    shape = (n, q * k, -1)
    return _Fields(
        s.ravel(),
        w,
        one.reshape(shape),
        two.reshape(shape),
        flat_one.reshape(shape),
        flat_two.reshape(shape),
        area.reshape(n, -1),
    )


def _unit_gradients(
    development: Development, s: np.ndarray, w: np.ndarray, fields: _Fields
) -> tuple[np.ndarray, np.ndarray]:
    """The flat images of both unit directions of the surface for a corrected development."""
    rails, slope = development.surface(fields.s), development.surface.derivative(fields.s)
    k = len(fields.w)
    rails, slope = np.repeat(rails, k, axis=0), np.repeat(slope, k, axis=0)
    ruling = rails[:, 3:] - rails[:, :3]
    width = np.sqrt((ruling * ruling).sum(axis=1))
    tangent = slope[:, :3] + w[:, None] * (slope[:, 3:] - slope[:, :3])
    slip = (tangent * ruling).sum(axis=1) / width
    square = np.sqrt((tangent * tangent).sum(axis=1) - slip**2)
    by_s, by_w = development.jacobian(s, w)
    two = by_w / width[:, None]
    one = (by_s - slip[:, None] * two) / square[:, None]
    return one.reshape(fields.one.shape), two.reshape(fields.two.shape)


def _green(one: np.ndarray, two: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return (
        0.5 * ((one * one).sum(axis=2) - 1.0),
        0.5 * ((two * two).sum(axis=2) - 1.0),
        0.5 * (one * two).sum(axis=2),
    )


def _moved(
    fields: _Fields, spline: _Spline, coefficients: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The flat images of both unit directions with the correction added."""
    mine = coefficients[spline.first[:, None] + np.arange(4)].reshape(len(spline.spans), -1, 2)
    one, two = fields.one.copy(), fields.two.copy()
    for m in range(mine.shape[1]):
        one += fields.along[:, :, m, None] * mine[:, None, m]
        two += fields.across[:, :, m, None] * mine[:, None, m]
    return one, two


def _gradient(fields: _Fields, spline: _Spline, coefficients: np.ndarray) -> np.ndarray:
    """Derivative of the energy by the coefficients, flat, zero where they are pinned."""
    one, two = _moved(fields, spline, coefficients)
    e11, e22, e12 = _green(one, two)
    s11, s22 = fields.weight * (e11 + POISSON * e22), fields.weight * (e22 + POISSON * e11)
    s12 = fields.weight * (1.0 - POISSON) * e12
    pull_one = s11[..., None] * one + s12[..., None] * two
    pull_two = s22[..., None] * two + s12[..., None] * one
    mine = np.zeros((len(one), fields.along.shape[2], 2))
    for point in range(one.shape[1]):
        mine += fields.along[:, point, :, None] * pull_one[:, point, None]
        mine += fields.across[:, point, :, None] * pull_two[:, point, None]
    mine = mine.reshape(len(one), 4, spline.terms, 2)
    total = np.zeros((spline.count, spline.terms, 2))
    for span, first in enumerate(spline.first):
        total[first : first + 4] += mine[span]
    total = total.ravel()
    total[_PINNED] = 0.0
    return total


_PINNED = [0, 1, 2]
"""Both shifts of the first ruling, and its end's step along d⊥ (x, as θ starts at 0)."""


def _factorised(fields: _Fields, spline: _Spline, coefficients: np.ndarray) -> np.ndarray:
    """Upper triangle of the Gauss-Newton matrix as LDLᵀ, banded rows (N, band): D, then L."""
    one, two = _moved(fields, spline, coefficients)
    root = np.sqrt(fields.weight)[..., None, None]
    in_one = fields.along[..., None] * one[:, :, None]
    in_two = fields.across[..., None] * two[:, :, None]
    shear = fields.along[..., None] * two[:, :, None] + fields.across[..., None] * one[:, :, None]
    rows = [
        np.sqrt(0.5 * (1 + POISSON)) * root * (in_one + in_two),
        np.sqrt(0.5 * (1 - POISSON)) * root * (in_one - in_two),
        np.sqrt(0.5 * (1 - POISSON)) * root * shear,
    ]
    n, band = len(one), 8 * spline.terms
    local = np.zeros((n, band, band))
    for row in rows:
        row = row.reshape(n, -1, band)
        for point in range(row.shape[1]):
            local += row[:, point, :, None] * row[:, point, None]
    size = 2 * spline.terms
    matrix = np.zeros((spline.count * size, spline.count * size))
    for span, first in enumerate(spline.first):
        block = slice(first * size, first * size + band)
        matrix[block, block] += local[span]
    matrix[_PINNED] = 0.0
    matrix[:, _PINNED] = 0.0
    matrix[_PINNED, _PINNED] = 1.0
    for k in range(len(matrix)):
        row = matrix[k, k + 1 : k + band]
        scaled = row / matrix[k, k]
        matrix[k + 1 : k + band, k + 1 : k + band] -= scaled[:, None] * row
        matrix[k, k + 1 : k + band] = scaled
    return matrix


def _solved(factor: np.ndarray, right: np.ndarray) -> np.ndarray:
    """The solution of LDLᵀx = right, by elementwise steps."""
    x = right.copy()
    band = int(np.flatnonzero(factor[3])[-1]) if len(factor) > 3 else len(factor)
    for k in range(len(x)):
        x[k + 1 : k + 1 + band] -= factor[k, k + 1 : k + 1 + band] * x[k]
    x /= np.diagonal(factor)
    for k in range(len(x) - 1, 0, -1):
        low = max(0, k - band)
        x[low:k] -= factor[low:k, k] * x[k]
    return x


def _as_pieces(spline: _Spline, coefficients: np.ndarray) -> Piecewise:
    """The correction s -> (2·terms,) by its values at the nodes of each span."""
    breaks = np.append(spline.spans[:, 0], spline.spans[-1, 1])
    nodes = span_nodes(breaks)
    local = spline.local(nodes + (nodes.mean(axis=1, keepdims=True) - nodes) * 1e-13)
    mine = coefficients.reshape(spline.count, -1)[spline.first[:, None] + np.arange(4)]
    values = np.zeros((*nodes.shape, mine.shape[2]))
    for j in range(4):
        values += local[:, :, j, None] * mine[:, None, j]
    return Piecewise(breaks, values)
