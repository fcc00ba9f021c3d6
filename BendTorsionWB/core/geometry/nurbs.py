# SPDX-License-Identifier: LGPL-2.1-or-later
"""A NURBS patch: evaluation with two derivatives, and Newton to its closest points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .patch_trim import Trim

# Poles nearer than this, relative to the patch's size, coincide: a pole point or a seam.
COINCIDENT = 1e-9
# Newton ends with the step that is shorter than this, relative to the patch's size and to its
# domain; the next one would be its square. Beside a pole point short steps may still turn far:
# there the length alone ends it, when it is down to rounding.
_LAST_STEP = 1e-9
_LAST_TURN = 1e-7
_ROUNDING = 1e-15
_NEWTON_STEPS = 40
# A foot keeps this much of its distance to a pole point in one step, so that it can still turn
# around the pole, until it is this near (relative to the domain).
_POLE_FRACTION = 0.02
_POLE_NEAR = 1e-13
# 1 − κd below which the point is at a centre of curvature.
_FOCAL = 1e-7
_CHUNK = 4096


@dataclass(frozen=True, eq=False)
class NurbsPatch:
    """A tensor-product NURBS patch over the rectangle of its clamped or unclamped knots.

    poles (nu, nv, 3) mm; weights (nu, nv) or None for all one; knots are flat, n + degree + 1 each
    (Piegl & Tiller 1997, ch. 4). sense +1 or -1: the normal is sense · S_u × S_v. trim: the
    face's wires, None when the face is the whole rectangle; geometry never stops at them.
    """

    degree_u: int
    degree_v: int
    knots_u: np.ndarray
    knots_v: np.ndarray
    poles: np.ndarray
    weights: np.ndarray | None = None
    sense: int = 1
    trim: Trim | None = None

    @cached_property
    def domain(self) -> np.ndarray:
        """[[first u, last u], [first v, last v]]."""
        return np.array(
            [
                [self.knots_u[self.degree_u], self.knots_u[-self.degree_u - 1]],
                [self.knots_v[self.degree_v], self.knots_v[-self.degree_v - 1]],
            ],
            float,
        )

    @cached_property
    def size(self) -> float:
        """Largest extent of the poles, mm."""
        return float(np.ptp(self.poles.reshape(-1, 3), axis=0).max())

    @cached_property
    def closed(self) -> tuple[bool, bool]:
        """Whether the patch closes on itself in u, in v."""
        (u0, u1), (v0, v1) = self.domain
        along_u, along_v = np.linspace(u0, u1, 9), np.linspace(v0, v1, 9)
        ends_u = [self.evaluate(np.full(9, u), along_v)[0] for u in (u0, u1)]
        ends_v = [self.evaluate(along_u, np.full(9, v))[0] for v in (v0, v1)]
        near = COINCIDENT * self.size
        return tuple(bool(np.abs(first - last).max() <= near) for first, last in (ends_u, ends_v))

    @cached_property
    def degenerate(self) -> np.ndarray:
        """(2, 2) bool: the border at first and last u, first and last v is a single point."""
        found = np.zeros((2, 2), bool)
        for side in range(4):
            points = self.border(side, 9)[0]
            found.flat[side] = np.ptp(points, axis=0).max() <= COINCIDENT * self.size
        return found

    @cached_property
    def _homogeneous(self) -> np.ndarray:
        weights = np.ones(self.poles.shape[:2]) if self.weights is None else self.weights
        return np.concatenate([self.poles * weights[..., None], weights[..., None]], axis=2)

    def evaluate(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
        """S, S_u, S_v, S_uu, S_uv, S_vv at parameters u, v (m,), each (m, 3)."""
        p, q = self.degree_u, self.degree_v
        span_u, basis_u = _basis(self.knots_u, p, u)
        span_v, basis_v = _basis(self.knots_v, q, v)
        count = len(span_u)
        rows = span_u[:, None] + np.arange(-p, 1)
        columns = span_v[:, None] + np.arange(-q, 1)
        flat = rows[:, :, None] * self._homogeneous.shape[1] + columns[:, None, :]
        local = self._homogeneous.reshape(-1, 4)[flat].reshape(count, p + 1, (q + 1) * 4)
        across = np.matmul(basis_u, local).reshape(count, 3, q + 1, 4)
        grid = np.matmul(basis_v[:, None], across)
        w = grid[..., 3:]
        s = grid[:, 0, 0, :3] / w[:, 0, 0]
        if self.weights is None:
            return (
                s,
                grid[:, 1, 0, :3],
                grid[:, 0, 1, :3],
                grid[:, 2, 0, :3],
                grid[:, 1, 1, :3],
                grid[:, 0, 2, :3],
            )
        w00, w10, w01 = w[:, 0, 0], w[:, 1, 0], w[:, 0, 1]
        su = (grid[:, 1, 0, :3] - w10 * s) / w00
        sv = (grid[:, 0, 1, :3] - w01 * s) / w00
        suu = (grid[:, 2, 0, :3] - 2 * w10 * su - w[:, 2, 0] * s) / w00
        suv = (grid[:, 1, 1, :3] - w10 * sv - w01 * su - w[:, 1, 1] * s) / w00
        svv = (grid[:, 0, 2, :3] - 2 * w01 * sv - w[:, 0, 2] * s) / w00
        return s, su, sv, suu, suv, svv

    def side(self, side: int, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Parameters u, v (count,) inside a border. Sides: first u, last u, first v, last v."""
        direction, last = divmod(side, 2)
        first_along, last_along = self.domain[1 - direction]
        along = first_along + (np.arange(count) + 0.5) / count * (last_along - first_along)
        fixed = np.full(count, self.domain[direction, last])
        return (fixed, along) if direction == 0 else (along, fixed)

    def border(self, side: int, count: int) -> tuple[np.ndarray, ...]:
        """Points at `side`, direction along it, direction into the patch, normal (count, 3)."""
        direction, last = divmod(side, 2)
        u, v = self.side(side, count)
        derivatives = self.evaluate(u, v)
        into = derivatives[1 + direction] * (-1 if last else 1)
        return derivatives[0], derivatives[2 - direction], into, self.normals(u, v, derivatives)

    def normals(self, u: np.ndarray, v: np.ndarray, derivatives=None) -> np.ndarray:
        """Unit normals (m, 3); at a pole point the limit of the normals around it."""
        _, su, sv, suu, suv, svv = self.evaluate(u, v) if derivatives is None else derivatives
        (u0, u1), (v0, v1) = self.domain
        cross = np.cross(su, sv)
        length = np.sqrt((cross**2).sum(1))
        # S_u vanishes with the distance to the pole line: there S_uv takes its place (and S_uu or
        # S_vv where the rates at a corner vanish too).
        scale = (self.size**2) / ((u1 - u0) * (v1 - v0))
        for first, second, forward in (
            (suv, sv, np.where(v < (v0 + v1) / 2, 1.0, -1.0)),
            (su, suv, np.where(u < (u0 + u1) / 2, 1.0, -1.0)),
            (suu, sv, np.where(u < (u0 + u1) / 2, 1.0, -1.0)),
            (su, svv, np.where(v < (v0 + v1) / 2, 1.0, -1.0)),
        ):
            weak = np.flatnonzero(length <= 1e-6 * scale)
            if not len(weak):
                break
            limit = np.cross(first[weak], second[weak]) * forward[weak, None]
            strength = np.sqrt((limit**2).sum(1))
            better = strength > 1e-6 * scale
            cross[weak[better]] = limit[better]
            length[weak[better]] = strength[better]
        length = np.where(length > 0, length, 1.0)
        return self.sense * cross / length[:, None]

    @cached_property
    def samples(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
        """Start points u, v (m,), points (m, 3) and how far any point of the patch is from one.

        Cell centres of a grid that keeps to the knot spans, so that no start is on a pole point.
        """
        centres_u, half_u = _cells(self.knots_u, self.degree_u)
        centres_v, half_v = _cells(self.knots_v, self.degree_v)
        u, v = (grid.ravel() for grid in np.meshgrid(centres_u, centres_v, indexing="ij"))
        wide, high = (grid.ravel() for grid in np.meshgrid(half_u, half_v, indexing="ij"))
        points, su, sv, *_ = self.evaluate(u, v)
        # The margin covers curvature and uneven parameters.
        reach = np.linalg.norm(su, axis=1) * wide + np.linalg.norm(sv, axis=1) * high
        return u, v, points, 1.25 * reach

    @cached_property
    def half_cells(self) -> tuple[np.ndarray, np.ndarray]:
        """Half the cells' extents in u and in v at the samples (m,)."""
        _, half_u = _cells(self.knots_u, self.degree_u)
        _, half_v = _cells(self.knots_v, self.degree_v)
        return np.repeat(half_u, len(half_v)), np.tile(half_v, len(half_u))

    @cached_property
    def area(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Area elements at the samples (m,), their points and unit normals (m, 3)."""
        u, v, points, _ = self.samples
        half_u, half_v = self.half_cells
        cell = 4 * half_u * half_v
        derivatives = self.evaluate(u, v)
        element = np.linalg.norm(np.cross(derivatives[1], derivatives[2]), axis=1) * cell
        return element, points, self.normals(u, v, derivatives)

    def refine(self, points: np.ndarray, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
        """Feet of points (n, 3) by damped Newton from starts u, v (n,).

        Returns u, v, feet (n, 3), unit normals (n, 3), focal (n,) bool: the point is at a centre
        of curvature, and bound (n,) bool: the foot is held by a border that is not a pole point.
        """
        parts = [
            self._refine(points[k : k + _CHUNK], u[k : k + _CHUNK], v[k : k + _CHUNK])
            for k in range(0, max(len(points), 1), _CHUNK)
        ]
        return tuple(np.concatenate(part) for part in zip(*parts, strict=True))

    def _refine(self, points, u, v):
        place = np.column_stack([u, v]).astype(float)
        data = np.stack(self.evaluate(u, v))
        damping = np.zeros(len(points))
        active = np.arange(len(points))
        for _ in range(_NEWTON_STEPS):
            if not len(active):
                break
            here = data[:, active]
            residual = here[0] - points[active]
            target, step, turn, whole = self._propose(
                here, residual, place[active], damping[active]
            )
            found = np.stack(self.evaluate(target[:, 0], target[:, 1]))
            after = found[0] - points[active]
            before = (residual**2).sum(1)
            small = step <= 1e-5 * self.size
            good = ((after**2).sum(1) <= before) | (small & whole)
            kept = active[good]
            place[kept] = target[good]
            data[:, kept] = found[:, good]
            damping[kept] = 0.0
            rejected = active[~good]
            damping[rejected] = np.maximum(4 * damping[rejected], 0.5)
            last = (step <= _LAST_STEP * self.size) & (turn <= _LAST_TURN)
            last |= (step <= _ROUNDING * self.size) & (turn < 1)
            active = active[~last]
        residual = data[0] - points
        metric, hessian, gradient = _quadratic(data, residual)
        free, border = self._free(place, gradient)
        spread = metric[0] * metric[2] - metric[1] ** 2
        determinant = hessian[0] * hessian[2] - hessian[1] ** 2
        regular = spread > 1e-12 * (self.size**2 / np.prod(np.ptp(self.domain, axis=1))) ** 2
        spread = np.where(regular, spread, 1.0)
        half_trace = (
            metric[0] * hessian[2] - 2 * metric[1] * hessian[1] + metric[2] * hessian[0]
        ) / (2 * spread)
        least = half_trace - np.sqrt(np.maximum(half_trace**2 - determinant / spread, 0.0))
        focal = regular & free.all(1) & (least <= _FOCAL)
        normals = self.normals(place[:, 0], place[:, 1], data)
        return place[:, 0], place[:, 1], data[0], normals, focal, border

    def _free(self, place, gradient):
        """Which parameters may move (n, 2), and which points a true border holds (n,)."""
        free = np.ones_like(place, bool)
        border = np.zeros(len(place), bool)
        for k in range(2):
            if self.closed[k]:
                continue
            first, last = self.domain[k]
            held_first = (place[:, k] <= first) & (gradient[k] >= 0)
            held_last = (place[:, k] >= last) & (gradient[k] <= 0)
            free[:, k] = ~(held_first | held_last)
            if not self.degenerate[k, 0]:
                border |= held_first
            if not self.degenerate[k, 1]:
                border |= held_last
        return free, border

    def _propose(self, data, residual, place, damping):
        """Next parameters, the step in mm and relative to the domain, and whether it is whole.

        A step cut short on its way to a pole point counts as the whole domain: it is not the last.
        """
        metric, hessian, gradient = _quadratic(data, residual)
        free, _ = self._free(place, gradient)
        whole = damping == 0
        spread = metric[0] * metric[2] - metric[1] ** 2
        determinant = hessian[0] * hessian[2] - hessian[1] ** 2
        convex = (hessian[0] > 0) & (hessian[2] > 0) & (determinant > 1e-14 * spread)
        a, b, c = (np.where(convex, h, m) for h, m in zip(hessian, metric, strict=True))
        a = a + damping * metric[0]
        c = c + damping * metric[2]
        single_u, single_v = free[:, 0] & ~free[:, 1], free[:, 1] & ~free[:, 0]
        # On a border only the free parameter moves.
        a = np.where(single_u & (hessian[0] > 0), hessian[0] + damping * metric[0], a)
        c = np.where(single_v & (hessian[2] > 0), hessian[2] + damping * metric[2], c)
        b = np.where(free.all(1), b, 0.0)
        gradient_u = np.where(free[:, 0], gradient[0], 0.0)
        gradient_v = np.where(free[:, 1], gradient[1], 0.0)
        below = a * c - b * b
        safe = below > 1e-300
        below = np.where(safe, below, 1.0)
        du = np.where(safe, (b * gradient_v - c * gradient_u) / below, 0.0)
        dv = np.where(safe, (b * gradient_u - a * gradient_v) / below, 0.0)
        # At a pole point one metric coefficient vanishes; the other parameter still moves.
        du = np.where(~safe & (a > 1e-300), -gradient_u / np.maximum(a, 1e-300), du)
        dv = np.where(~safe & (c > 1e-300), -gradient_v / np.maximum(c, 1e-300), dv)
        target = place + np.column_stack([du, dv])
        low, high, nearing = self._approach(place, target)
        for k in range(2):
            # On a step cut short before a pole point the other parameter turns by itself: with its
            # share of the whole step it would arrive there unturned.
            other = 1 - k
            alone = nearing[:, other] & free[:, k] & (hessian[2 * k] > 0)
            single = gradient[k] / np.where(alone, hessian[2 * k], 1.0)
            target[:, k] = np.where(alone, place[:, k] - single, target[:, k])
        for k in range(2):
            first, last = self.domain[k]
            extent = last - first
            if self.closed[k]:
                # A whole turn says nothing; half of one is the most a step may mean.
                move = np.clip(target[:, k] - place[:, k], -extent / 4, extent / 4)
                target[:, k] = first + np.mod(place[:, k] + move - first, extent)
            else:
                target[:, k] = np.clip(target[:, k], low[:, k], high[:, k])
        moved = target - place
        for k in range(2):
            if self.closed[k]:
                extent = np.ptp(self.domain[k])
                moved[:, k] -= extent * np.round(moved[:, k] / extent)
        step = np.sqrt(
            np.maximum(
                metric[0] * moved[:, 0] ** 2
                + 2 * metric[1] * moved[:, 0] * moved[:, 1]
                + metric[2] * moved[:, 1] ** 2,
                0.0,
            )
        )
        turn = np.abs(moved / np.ptp(self.domain, axis=1)).max(1)
        turn[nearing.any(1)] = 1.0
        return target, step, turn, whole

    def _approach(self, place, target):
        """Lowest and highest next parameters, and which are held back from a pole point (n, 2)."""
        low, high = (np.repeat(ends[None], len(place), 0) for ends in self.domain.T)
        for k, (first, last) in enumerate(self.domain):
            near = _POLE_NEAR * (last - first)
            if self.degenerate[k, 0]:
                gap = place[:, k] - first
                low[:, k] += np.where(gap > near, _POLE_FRACTION * gap, 0.0)
            if self.degenerate[k, 1]:
                gap = last - place[:, k]
                high[:, k] -= np.where(gap > near, _POLE_FRACTION * gap, 0.0)
        inner = (low > self.domain[:, 0]) & (target < low)
        outer = (high < self.domain[:, 1]) & (target > high)
        return low, high, inner | outer


def _quadratic(data, residual):
    """First fundamental form, Hessian and gradient of half the squared distance."""

    def dot(a, b):
        return np.einsum("ij,ij->i", a, b)

    _, su, sv, suu, suv, svv = data
    metric = dot(su, su), dot(su, sv), dot(sv, sv)
    hessian = tuple(
        first + dot(second, residual) for first, second in zip(metric, (suu, suv, svv), strict=True)
    )
    return metric, hessian, (dot(su, residual), dot(sv, residual))


def _basis(knots: np.ndarray, degree: int, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Knot spans (m,) and the degree + 1 basis functions with two derivatives (m, 3, degree + 1).

    Cox and de Boor's triangle; derivatives from the degrees below (Piegl & Tiller 1997, eq. 2.7).
    """
    u = np.asarray(u, float)
    count = len(knots) - degree - 1
    span = np.clip(np.searchsorted(knots, u, side="right") - 1, degree, count - 1)
    # A span of no length at the end of the domain is stepped over.
    last = np.searchsorted(knots, knots[count], side="left") - 1
    span = np.minimum(span, last)
    # Columns of one number per parameter: numpy is several times slower along a short last axis.
    near = [knots[span + k] for k in range(1 - degree, degree + 1)]
    tables = [[np.ones(len(u))]]
    for p in range(1, degree + 1):
        shares = _shares(tables[-1], near, degree, p)
        values = [np.zeros(len(u)) for _ in range(p + 1)]
        for k, share in enumerate(shares):
            values[k] += share * (near[degree + k] - u)
            values[k + 1] += share * (u - near[degree - p + k])
        tables.append(values)
    out = np.zeros((len(u), 3, degree + 1))
    for order in range(min(degree, 2) + 1):
        rates = tables[degree - order]
        for p in range(degree - order + 1, degree + 1):
            shares = _shares(rates, near, degree, p)
            rates = [np.zeros(len(u)) for _ in range(p + 1)]
            for k, share in enumerate(shares):
                rates[k] -= p * share
                rates[k + 1] += p * share
        for k, rate in enumerate(rates):
            out[:, order, k] = rate
    return span, out


def _shares(values: list[np.ndarray], near: list[np.ndarray], degree: int, p: int):
    """Values of degree p - 1 over the lengths of their supports."""
    return [value / (near[degree + k] - near[degree - p + k]) for k, value in enumerate(values)]


def _cells(knots: np.ndarray, degree: int) -> tuple[np.ndarray, np.ndarray]:
    """Centres and half widths of the cells that start points are taken from."""
    first, last = knots[degree], knots[-degree - 1]
    breaks = np.unique(np.concatenate([[first], knots[(knots > first) & (knots < last)], [last]]))
    spans = len(breaks) - 1
    pieces = max(int(np.ceil(8 / spans)), 2 * degree if spans < 8 else degree)
    edges = np.concatenate(
        [np.linspace(breaks[k], breaks[k + 1], pieces, endpoint=False) for k in range(spans)]
        + [[last]]
    )
    return (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
