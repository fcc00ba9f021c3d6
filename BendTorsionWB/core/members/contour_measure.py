# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of plates that end at curves: quadrature over their trimmed domain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..flattening.development import Development
from ..geometry.piecewise import Piecewise, span_nodes
from ..geometry.vectors import crossed, lengths
from .contour import EndCurves, bracketed_roots, fibre_cuts
from .member import EndSurface
from .strips import StripRails

_GAUSS = np.polynomial.legendre.leggauss(12)
_PANELS = 4
_CUBIC = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])


def _rule(panels: int) -> tuple[np.ndarray, np.ndarray]:
    """Gauss nodes and weights (n,) on [0, 1]."""
    nodes, weights = _GAUSS
    start = np.arange(panels)[:, None]
    return ((start + 0.5 * (nodes + 1.0)) / panels).ravel(), np.tile(0.5 * weights / panels, panels)


def _across(cut: EndCurves | None, d: float) -> tuple[np.ndarray, np.ndarray]:
    """Gauss nodes w and weights (n,) on [0, 1] at a depth, with panels that end at the corners of
    an end curve."""
    corners = () if cut is None else cut.corners_at(d)
    edges = np.unique(np.concatenate([np.linspace(0.0, 1.0, _PANELS + 1), corners]).clip(0.0, 1.0))
    nodes, weights = _rule(1)
    size = np.diff(edges)[:, None]
    return (edges[:-1, None] + size * nodes).ravel(), (size * weights).ravel()


def _lagrange(x: np.ndarray) -> np.ndarray:
    """Lagrange basis (n, 4) at 0, 1/3, 2/3 and 1."""
    basis = np.ones((len(x), 4))
    for j in range(4):
        for k in range(4):
            if j != k:
                basis[:, j] *= (x - _CUBIC[k]) / (_CUBIC[j] - _CUBIC[k])
    return basis


def trimmed_area(development: Development, cuts: Sequence[EndCurves | None]) -> float:
    """Area, mm2, of the flat pattern between its end curves (None: the end of the rails).

    The map's Jacobian is linear in w where rulings stay straight, and integrated along s once;
    with a correction the boundary is integrated instead (Green).
    """
    plane = development.plane
    rules = [_across(cut, 0.5) for cut in cuts]
    ends = [
        np.full(len(w), (plane.start, plane.end)[k]) if cut is None else cut.at("mid", w)
        for k, (cut, (w, _)) in enumerate(zip(cuts, rules, strict=True))
    ]
    if development.correction is None:
        value, slope = plane.values, plane.derivative.values
        angle = value[..., 2].copy()
        along = slope[..., 0] * np.cos(angle) + slope[..., 1] * np.sin(angle)
        strip = np.stack([value[..., 3] * along, value[..., 3] ** 2 * slope[..., 2]], axis=2)
        whole = Piecewise(plane.breaks, strip).antiderivative()
        found = [
            float((weights * (at[:, 0] - w * at[:, 1])).sum())
            for at, (w, weights) in zip(map(whole, ends), rules, strict=True)
        ]
        return found[1] - found[0]
    total = 0.0
    for k, (cut, (w, weights)) in enumerate(zip(cuts, rules, strict=True)):
        rate = 0.0 if cut is None else cut.mid.derivative(w)[:, :1]
        by_s, by_w = development.jacobian(ends[k], w)
        point, along = development.flat(ends[k], w), by_s * rate + by_w
        total += (1, -1)[k == 0] * _moment(weights, point, along)
    for edge in (0.0, 1.0):
        a, b = (
            (plane.start, plane.end)[k]
            if cut is None
            else float(cut.at("mid", np.array([edge]))[0])
            for k, cut in enumerate(cuts)
        )
        breaks = np.concatenate([plane.breaks, development.correction.breaks])
        inside = breaks[(breaks > a) & (breaks < b)]
        breaks = np.unique(np.concatenate([[a], inside, [b]]))
        s = (breaks[:-1, None] + np.diff(breaks)[:, None] * _rule(1)[0]).ravel()
        step = (np.diff(breaks)[:, None] * _rule(1)[1]).ravel()
        on = np.full(len(s), edge)
        by_s, _ = development.jacobian(s, on)
        total += (1, -1)[edge == 1.0] * _moment(step, development.flat(s, on), by_s)
    return float(abs(total))


def _moment(weights: np.ndarray, point: np.ndarray, rate: np.ndarray) -> float:
    """½∫(x dy − y dx) along one run."""
    return 0.5 * float((weights * (point[:, 0] * rate[:, 1] - point[:, 1] * rate[:, 0])).sum())


class Solid:
    """The inside of a plate: X(s, w, d) between outer (d = 0) and inner surface (1), both linear
    across and through, s of the outer rails, paired with the inner ones between folds."""

    def __init__(self, rails: StripRails):
        self.rails = rails
        self.outer_edges = np.array([rails.outer.start, *rails.outer_folds, rails.outer.end])
        self.inner_edges = np.array([rails.inner.start, *rails.inner_folds, rails.inner.end])

    def _inner_place(self, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        k = np.searchsorted(self.outer_edges, s, side="right") - 1
        k = k.clip(0, len(self.outer_edges) - 2)
        scale = np.diff(self.inner_edges)[k] / np.diff(self.outer_edges)[k]
        return self.inner_edges[k] + (s - self.outer_edges[k]) * scale, scale

    def corners(self, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The rails and their rates (n, 12): outer first, second, inner first, second."""
        place, scale = self._inner_place(s)
        outer, inner = self.rails.outer, self.rails.inner
        values = np.concatenate([outer(s), inner(place)], axis=1)
        rates = [outer.derivative(s), inner.derivative(place) * scale[:, None]]
        return values, np.concatenate(rates, axis=1)

    def breaks(self) -> np.ndarray:
        """Places where the rails are less than smooth."""
        inner = self.rails.inner.breaks
        k = (np.searchsorted(self.inner_edges, inner, side="right") - 1).clip(
            0, len(self.inner_edges) - 2
        )
        scale = np.diff(self.outer_edges)[k] / np.diff(self.inner_edges)[k]
        mapped = self.outer_edges[k] + (inner - self.inner_edges[k]) * scale
        breaks = np.unique(np.concatenate([self.rails.outer.breaks, mapped]))
        return breaks[np.concatenate([[True], np.diff(breaks) > 1e-6])]


def _mixed(values: np.ndarray, w, d) -> np.ndarray:
    """Points (..., n, 3) between corners (n, 12) at w and d (..., n or 1)."""
    w, d = np.asarray(w)[..., None], np.asarray(d)[..., None]
    outer = values[:, 0:3] + w * (values[:, 3:6] - values[:, 0:3])
    inner = values[:, 6:9] + w * (values[:, 9:12] - values[:, 6:9])
    return outer + d * (inner - outer)


@dataclass(frozen=True, eq=False)
class TrimmedFigures:
    """volume mm3; centre (3,) of gravity; face_areas (4,) of the outer face, the second edge, the
    inner face and the first edge, end_areas of both ends, mm2."""

    volume: float
    centre: np.ndarray
    face_areas: np.ndarray
    end_areas: tuple[float, float]


def trimmed_figures(rails: StripRails, cuts: Sequence[EndCurves | None]) -> TrimmedFigures:
    """Volume, centre and surfaces of a plate between its ends (None: square at the rails' end).

    Density and first moments are polynomials of third degree at most in w and d at every s; they
    are integrated along s once, and over w and d between the places where those fibres end.
    """
    solid = Solid(rails)
    breaks = solid.breaks()
    nodes = span_nodes(breaks)
    inside = nodes + (nodes.mean(axis=1, keepdims=True) - nodes) * 1e-12
    values, rates = solid.corners(inside.ravel())
    origin = values[:, :3].mean(axis=0)
    values = values - np.tile(origin, 4)

    def along(fibres: np.ndarray) -> Piecewise:
        stacked = np.moveaxis(fibres, 0, 1)
        return Piecewise(breaks, stacked.reshape(*nodes.shape, -1)).antiderivative()

    w, d = np.repeat(_CUBIC, 4)[:, None], np.tile(_CUBIC, 4)[:, None]
    density = (crossed(*_spans(values, w, d)) * _mixed(rates, w, d)).sum(axis=2)[..., None]
    points = _mixed(values, w, d)
    whole = along(density * np.concatenate([1.0 + 0.0 * density, points], axis=2))
    moments, ends = np.zeros(4), []
    for k, cut in enumerate(cuts):
        w, d, weights = _through(cut)
        basis = (_lagrange(w)[:, :, None] * _lagrange(d)[:, None, :]).reshape(len(w), 16, 1)
        place = _ends_at(solid, cut, k, w, d)
        found = (whole(place).reshape(len(w), 16, 4) * basis).sum(axis=1)
        moments += (-1.0, 1.0)[k] * (weights[:, None] * found).sum(axis=0)
        ends.append(float((weights * _end_density(solid, cut, place, w, d)).sum()))
    areas = []
    for edge, at in ((False, 0.0), (True, 1.0), (False, 1.0), (True, 0.0)):
        own = []
        for k, cut in enumerate(cuts):
            u, by_u = _rule(_PANELS) if edge else _across(cut, at)
            level = np.full(len(u), at)
            w, d = (level, u) if edge else (u, level)
            side = _spans(values, w[:, None], d[:, None])[int(edge)]
            density = lengths(crossed(_mixed(rates, w[:, None], d[:, None]), side))
            found = np.diagonal(along(density)(_ends_at(solid, cut, k, w, d)))
            own.append(float((by_u * found).sum()))
        areas.append(own[1] - own[0])
    return TrimmedFigures(
        float(abs(moments[0])), moments[1:] / moments[0] + origin, np.array(areas), tuple(ends)
    )


def _through(cut: EndCurves | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gauss nodes w and d and weights (n,) over the end of a plate."""
    depths, by_d = _rule(1)
    rules = [_across(cut, float(d)) for d in depths]
    w = np.concatenate([nodes for nodes, _ in rules])
    d = np.repeat(depths, [len(nodes) for nodes, _ in rules])
    weights = np.concatenate([by * own for by, (_, own) in zip(by_d, rules, strict=True)])
    return w, d, weights


def _spans(values: np.ndarray, w, d) -> tuple[np.ndarray, np.ndarray]:
    """The vectors (n, 3) across the plate at depth d and through it at w."""
    return (
        _mixed(values, 1.0, d) - _mixed(values, 0.0, d),
        _mixed(values, w, 1.0) - _mixed(values, w, 0.0),
    )


def _ends_at(solid: Solid, cut: EndCurves | None, end: int, w, d) -> np.ndarray:
    """Where fibres (n,) end."""
    if cut is None:
        return np.full(len(w), (solid.rails.outer.start, solid.rails.outer.end)[end])
    return _met(solid, cut, w, d)


def _end_density(solid: Solid, cut: EndCurves | None, place, w, d) -> np.ndarray:
    """Area (n,) of an end per unit of w and d, where the fibres meet it."""
    values, rates = solid.corners(place)
    across, through = _spans(values, w, d)
    if cut is not None:
        along = _mixed(rates, w, d)
        _, gradient = cut.surface.value_and_gradient(_mixed(values, w, d))
        slope = (gradient * along).sum(axis=1)
        across, through = (
            side - ((gradient * side).sum(axis=1) / slope)[:, None] * along
            for side in (across, through)
        )
    return lengths(crossed(across, through))


def _met(solid: Solid, cut: EndCurves, w: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Where fibres of the plate's inside meet its end."""
    surface: EndSurface = cut.surface

    def step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, rates = solid.corners(s)
        value, gradient = surface.value_and_gradient(_mixed(values, w, d))
        return value, (gradient * _mixed(rates, w, d)).sum(axis=1)

    pad = 0.25 * (cut.range[1] - cut.range[0]) + 5.0
    low = np.full(len(w), max(cut.range[0] - pad, solid.outer_edges[0]))
    high = np.full(len(w), min(cut.range[1] + pad, solid.outer_edges[-1]))
    return bracketed_roots(step, low, high)


def area_beyond(rails: Piecewise, surface: EndSurface, end: int) -> float:
    """Area, mm2, of the ruled surface between two rails s -> (6,) that lies beyond an end surface
    at their start (end 0) or their end (1)."""
    w, weights = _rule(_PANELS)
    cut = fibre_cuts(rails, surface, w, np.full(len(w), rails.start), np.full(len(w), rails.end))
    values, rates = rails.values, rails.derivative.values
    ruling = values[..., 3:] - values[..., :3]
    way = rates[..., None, :3] + w[:, None] * (rates[..., 3:] - rates[..., :3])[..., None, :]
    density = lengths(crossed(way, ruling[..., None, :]))
    whole = Piecewise(rails.breaks, density).antiderivative()
    to = np.diagonal(whole(cut))
    return float((weights * (to if end == 0 else whole(np.array([rails.end]))[0] - to)).sum())
