# SPDX-License-Identifier: LGPL-2.1-or-later
"""Volumes enclosed by ruled faces between neighbouring rails and two plane end caps.

By the flux of position/3 (Gauss), exact up to quadrature; the kernel's own volume is good to 1e-6
at best on faces of many knots.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .. import tolerances
from ..geometry.piecewise import (
    DEGREE,
    Piecewise,
    Together,
    derivatives_together,
    evaluate_together,
    integrals_together,
    span_nodes,
)
from ..geometry.vectors import crossed, dots
from .member import Member, stretch
from .skin import SkinPiece, values_and_rates
from .strips import StripRails

_SPLINE_NODES = np.polynomial.legendre.leggauss(5)
_EXACT_NODES = np.polynomial.legendre.leggauss(10)


def skin_volume(pieces: Sequence[SkinPiece]) -> float:
    """Volume, mm3, of the solid written from a skin whose rails are in ring order."""
    return skin_volumes([pieces])[0]


def skin_volumes(tubes: Sequence[Sequence[SkinPiece]]) -> list[float]:
    """Volumes of many skins of one number of rails, as `skin_volume`."""
    pieces = [piece for tube in tubes for piece in tube]
    nodes = [_gauss(piece.knots[3:-3], _SPLINE_NODES) for piece in pieces]
    values = values_and_rates(pieces, [s for s, _ in nodes])
    counts, k = [], 0
    for tube in tubes:
        counts.append(sum(len(nodes[i][0]) for i in range(k, k + len(tube))))
        k += len(tube)
    rails, rates = (np.concatenate([pair[part] for pair in values]) for part in (0, 1))
    ends = np.array([[tube[0].poles[:, 0], tube[-1].poles[:, -1]] for tube in tubes])
    return _enclosed(rails, rates, np.concatenate([w for _, w in nodes]), counts, ends)


def strip_volume(rails: StripRails) -> float:
    """Volume, mm3, of a plate from its exact rails, inner and outer rails paired between folds as
    the solid pairs them."""
    return strip_volumes([rails])[0]


def strip_volumes(strips: Sequence[StripRails]) -> list[float]:
    """Volumes of many plates, as `strip_volume`."""
    functions, places, weights, scales, ends = [], [], [], [], []
    for rails in strips:
        edges = [
            [group.start, *folds, group.end]
            for group, folds in ((rails.outer, rails.outer_folds), (rails.inner, rails.inner_folds))
        ]
        parts = [
            _paired(rails, [own[k] for own in edges], [own[k + 1] for own in edges])
            for k in range(len(edges[0]) - 1)
        ]
        x, w = ([part[i] for part in parts] for i in (0, 1))
        for side, group in enumerate((rails.outer, rails.inner)):
            lengths = np.diff(edges[side])
            functions.append(group)
            places.append(
                np.concatenate([edges[side][k] + x[k] * lengths[k] for k in range(len(parts))])
            )
            scales.append(np.repeat(lengths, [len(part) for part in x]))
        weights.append(np.concatenate(w))
        ends.append(np.stack([_ring_at(rails, 0), _ring_at(rails, -1)]))
    both = [
        Piecewise(f.breaks, np.concatenate([f.values, rate.values], axis=2))
        for f, rate in zip(functions, derivatives_together(functions), strict=True)
    ]
    found = evaluate_together(both, places)
    outer, inner = np.concatenate(found[::2]), np.concatenate(found[1::2])
    rails, rates = (
        np.concatenate(
            [
                one[:, part].reshape(-1, 2, 3) * by[:, None, None]
                for one, by in ((outer, a), (inner, b))
            ],
            axis=1,
        )[:, [0, 1, 3, 2]]
        for part, a, b in (
            (slice(0, 6), np.ones(len(outer)), np.ones(len(inner))),
            (slice(6, 12), np.concatenate(scales[::2]), np.concatenate(scales[1::2])),
        )
    )
    counts = [len(w) for w in weights]
    return _enclosed(rails, rates, np.concatenate(weights), counts, np.array(ends))


def _paired(rails: StripRails, starts, ends) -> tuple[np.ndarray, np.ndarray]:
    """Gauss nodes and weights (n,) on [0, 1] between two folds, smooth on each span of both."""
    parts = [np.array([0.0, 1.0])]
    for group, a, b in zip((rails.outer, rails.inner), starts, ends, strict=True):
        inside = group.breaks[(group.breaks > a) & (group.breaks < b)]
        parts.append((inside - a) / (b - a))
    breaks = np.unique(np.concatenate(parts))
    return _gauss(breaks[np.concatenate([[True], np.diff(breaks) > 1e-12])], _EXACT_NODES)


def _ring_at(rails: StripRails, end: int) -> np.ndarray:
    """Ring (4, 3) at the start (0) or end (-1): outer first, outer second, inner second, first."""
    outer, inner = (g.values[end, end].reshape(2, 3) for g in (rails.outer, rails.inner))
    return np.concatenate([outer, inner[::-1]])


def _gauss(
    breaks: np.ndarray, rule: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights (n,) of a Gauss rule on every span."""
    half = 0.5 * np.diff(breaks)
    middle = 0.5 * (breaks[1:] + breaks[:-1])
    return (middle[:, None] + half[:, None] * rule[0]).ravel(), (half[:, None] * rule[1]).ravel()


def _enclosed(
    rails: np.ndarray,
    rates: np.ndarray,
    weights: np.ndarray,
    counts: Sequence[int],
    ends: np.ndarray,
) -> list[float]:
    """Volumes of solids with end rings (k, 2, m, 3), from their rails and rates (n, m, 3) at
    weighted places, `counts` of them each: flux of position/3 about the mean of the ends."""
    middle = ends.mean(axis=(1, 2))
    flux = weights * _flux(rails - np.repeat(middle, counts, axis=0)[:, None], rates)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    through = np.add.reduceat(flux, starts)
    rings = ends - middle[:, None, None]
    area = 0.5 * crossed(rings, np.roll(rings, -1, axis=2)).sum(axis=2)
    caps = (area * rings.mean(axis=2)).sum(axis=2) / 3.0
    return np.abs(through + caps[:, 0] - caps[:, 1]).tolist()


def _flux(rails: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """Flux (n,) of position/3 per unit of parameter through all faces."""
    across, spread = np.roll(rails, -1, axis=1) - rails, np.roll(rates, -1, axis=1) - rates
    total = np.zeros(len(rails))
    for w in (0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)):
        flux = crossed(rates + w * spread, across) * (rails + w * across)
        total += flux.sum(axis=(1, 2)) / 6.0
    return total


def section_integrals(member: Member, strips: Sequence[StripRails]) -> np.ndarray:
    """∫A·(1 − κ·e)ds and ∫A·ds (k, 2) of strips, A the area of the cross-section, mm2, e its
    centre: the first is the volume of a strip with ends normal to the axis (Pappus)."""
    if not strips:
        return np.empty((0, 2))
    breaks, places = [], []
    for rails in strips:
        own = np.unique(np.concatenate([rails.outer.breaks, rails.inner.breaks]))
        own = own[np.concatenate([[True], np.diff(own) > tolerances.SAME_STATION])]
        nodes = span_nodes(own)
        # A hair inside each span, so that both sides of a fold give their own limit.
        places.append((nodes + (nodes.mean(axis=1, keepdims=True) - nodes) * 1e-12).ravel())
        breaks.append(own)
    s = np.concatenate(places)
    at = member.frames.at(s)
    outer, inner = (
        Together(rails)(places).reshape(-1, 2, 3)
        for rails in ([rails.outer for rails in strips], [rails.inner for rails in strips])
    )
    ring = np.stack([outer[:, 0], outer[:, 1], inner[:, 1], inner[:, 0]], axis=1)
    ring = ring - at.origin[:, None]
    plane = np.stack([dots(ring, at.y[:, None]), dots(ring, at.z[:, None])], axis=2)
    area, centroid = _polygon(plane)
    values = np.stack([area * stretch(at, centroid), area], axis=1)
    return integrals_together(values.reshape(-1, DEGREE + 1, 2), breaks)


def _polygon(ring: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Area (n,), positive, and centroid (n, 2) of polygons (n, m, 2)."""
    following = np.roll(ring, -1, axis=1)
    cross = ring[:, :, 0] * following[:, :, 1] - ring[:, :, 1] * following[:, :, 0]
    doubled = cross.sum(axis=1)
    centroid = ((ring + following) * cross[:, :, None]).sum(axis=1) / (3.0 * doubled)[:, None]
    return np.abs(doubled) / 2.0, centroid
