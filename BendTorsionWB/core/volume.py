# SPDX-License-Identifier: LGPL-2.1-or-later
"""Volumes enclosed by ruled faces between neighbouring rails and two plane end caps.

By the flux of position/3 (Gauss), exact up to quadrature; the kernel's own volume is good to 1e-6
at best on faces of many knots.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import BSpline

from .piecewise import Piecewise, span_nodes
from .skin import SkinPiece
from .strips import StripRails

_SPLINE_NODES = np.polynomial.legendre.leggauss(5)
_EXACT_NODES = np.polynomial.legendre.leggauss(16)


def skin_volume(pieces: Sequence[SkinPiece]) -> float:
    """Volume, mm3, of the solid written from a skin whose rails are in ring order."""
    ends = np.concatenate([pieces[0].at(pieces[0].knots[:1]), pieces[-1].at(pieces[-1].knots[-1:])])
    total = 0.0
    for piece in pieces:
        spline = BSpline(piece.knots, piece.poles.transpose(1, 0, 2), 3)
        s, weights = _gauss(np.unique(piece.knots), _SPLINE_NODES)
        total += float((weights * _flux(spline(s), spline.derivative()(s), ends)).sum())
    return abs(total + _caps(ends))


def strip_volume(rails: StripRails) -> float:
    """Volume, mm3, of a plate from its exact rails, inner and outer rails paired between folds as
    the solid pairs them."""
    outer_edges = [rails.outer.start, *rails.boundaries, rails.outer.end]
    inner_edges = [rails.inner.start, *rails.inner_folds, rails.inner.end]
    ends = np.stack(
        [
            _ring(rails, np.array([edges[0] for edges in (outer_edges, inner_edges)]))[0],
            _ring(rails, np.array([edges[-1] for edges in (outer_edges, inner_edges)]))[0],
        ]
    )
    total = 0.0
    for k in range(len(outer_edges) - 1):
        parts = []
        for group, edges in ((rails.outer, outer_edges), (rails.inner, inner_edges)):
            breaks = group.breaks
            inside = breaks[(breaks > edges[k]) & (breaks < edges[k + 1])]
            parts.append((inside - edges[k]) / (edges[k + 1] - edges[k]))
        breaks = np.unique(np.concatenate([[0.0, 1.0], *parts]))
        nodes = span_nodes(breaks)
        # A hair inside each span, so that both sides of a fold give their own limit.
        x = (nodes + (nodes.mean(axis=1, keepdims=True) - nodes) * 1e-12).ravel()
        places = np.stack(
            [e[k] + x * (e[k + 1] - e[k]) for e in (outer_edges, inner_edges)]
        )
        ring = Piecewise(breaks, _ring(rails, places).reshape(*nodes.shape, 12))
        s, weights = _gauss(breaks, _EXACT_NODES)
        values, rates = ring(s), ring.derivative(s)
        flux = _flux(values.reshape(-1, 4, 3), rates.reshape(-1, 4, 3), ends)
        total += float((weights * flux).sum())
    return abs(total + _caps(ends))


def _ring(rails: StripRails, places: np.ndarray) -> np.ndarray:
    """Ring (n, 4, 3): outer first, outer second, inner second, inner first."""
    places = places.reshape(2, -1)
    outer = rails.outer(places[0]).reshape(-1, 2, 3)
    inner = rails.inner(places[1]).reshape(-1, 2, 3)
    return np.concatenate([outer, inner[:, ::-1]], axis=1)


def _gauss(
    breaks: np.ndarray, rule: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights (n,) of a Gauss rule on every span."""
    half = 0.5 * np.diff(breaks)
    middle = 0.5 * (breaks[1:] + breaks[:-1])
    return (middle[:, None] + half[:, None] * rule[0]).ravel(), (half[:, None] * rule[1]).ravel()


def _flux(rails: np.ndarray, rates: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Flux (n,) of position/3 per unit of parameter through all faces, about the mean of `ends`."""
    rails = rails - ends.mean(axis=(0, 1))
    across, spread = np.roll(rails, -1, axis=1) - rails, np.roll(rates, -1, axis=1) - rates
    total = np.zeros(len(rails))
    for w in (0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)):
        flux = np.cross(rates + w * spread, across) * (rails + w * across)
        total += flux.sum(axis=(1, 2)) / 6.0
    return total


def _caps(ends: np.ndarray) -> float:
    """Flux through the plane caps, in the sense that closes the faces of `_flux`."""
    total = 0.0
    for ring, side in zip(ends - ends.mean(axis=(0, 1)), (1.0, -1.0), strict=True):
        area = 0.5 * np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)
        total += side * float((area * ring.mean(axis=0)).sum()) / 3.0
    return total
