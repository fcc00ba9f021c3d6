# SPDX-License-Identifier: LGPL-2.1-or-later
"""Iso-curves: the exact NURBS curve of constant u or v on a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline

from ..finding import BendTorsionError, error
from ..geometry.curve import Curve
from ..geometry.curve_edit import piece
from ..geometry.nurbs import NurbsPatch
from ..geometry.patches import PatchSurface
from ..geometry.surface import Ellipsoid, Flipped, Sphere, Surface, Torus


@dataclass(frozen=True)
class IsoCurve:
    """The exact curve of a constant u (or v) of one patch of a NURBS surface, or of a sphere,
    ellipsoid or torus; parameters are fractions 0..1 of the domain. direction: 'u' holds u = `at`
    and runs along v, 'v' the other; first and last: where it starts and ends along the other
    parameter. On a sphere and ellipsoid u is longitude from +x and v latitude from pole to pole;
    on a torus u goes round the axis, v round the tube from its outside upwards."""

    direction: str
    at: float
    first: float = 0.0
    last: float = 1.0
    patch: int = 0


def iso_curve(name: str, rule: IsoCurve, surface: Surface) -> Curve:
    """The curve of constant u or v; raises BendTorsionError for surfaces without such
    parameters (endless ones, offsets) and parameters outside 0..1."""
    if not (0 <= rule.at <= 1 and 0 <= rule.first < rule.last <= 1):
        raise BendTorsionError(
            error(
                "axis-rule-iso",
                name,
                "the iso-curve's parameters are not fractions 0..1",
                "give 0 <= first < last <= 1",
                value=rule.at,
                limit=1.0,
            )
        )
    inner = surface
    while isinstance(inner, Flipped):
        inner = inner.surface
    if isinstance(inner, (Ellipsoid, Sphere, Torus)):
        return _arc(*_ellipse(inner, rule))
    patches = inner.patches if isinstance(inner, PatchSurface) else ()
    if not 0 <= rule.patch < len(patches):
        raise BendTorsionError(
            error(
                "axis-rule-patch",
                name,
                f"the surface has no patch {rule.patch + 1} to follow",
                "choose a face, a sphere, an ellipsoid or a torus, or a plane section",
                value=type(inner).__name__.lower(),
            )
        )
    return _of_patch(patches[rule.patch], rule)


def _of_patch(patch: NurbsPatch, rule: IsoCurve) -> Curve:
    """Iso-curve of a NURBS patch (Piegl & Tiller 1997, ch. 4)."""
    weights = np.ones(patch.poles.shape[:2]) if patch.weights is None else patch.weights
    poles = np.concatenate([patch.poles * weights[..., None], weights[..., None]], axis=2)
    along_v = rule.direction == "u"
    if not along_v:
        poles = poles.transpose(1, 0, 2)
    held, run = (0, 1) if along_v else (1, 0)
    degrees, knots = (patch.degree_u, patch.degree_v), (patch.knots_u, patch.knots_v)
    low, high = patch.domain[held]
    row = BSpline(knots[held], poles, degrees[held])(low + rule.at * (high - low))
    curve = Curve(
        degrees[run],
        knots[run],
        row[:, :3] / row[:, 3:],
        None if np.ptp(row[:, 3]) == 0 else row[:, 3],
    )
    first, last = curve.domain
    return piece(curve, first + rule.first * (last - first), first + rule.last * (last - first))


def _ellipse(surface: Ellipsoid | Sphere | Torus, rule: IsoCurve):
    """Centre, two half-axes (3,) and angle range of the ellipse c + a cos t + b sin t."""
    centre = np.array(surface.origin, float)
    turn = 2.0 * np.pi
    if isinstance(surface, Torus):
        around, tube = turn * rule.at, turn * rule.at
        out = np.array([np.cos(around), np.sin(around), 0.0])
        if rule.direction == "u":
            half = (surface.r * out, np.array([0.0, 0.0, surface.r]))
            return centre + surface.R * out, *half, turn * rule.first, turn * rule.last
        radius = surface.R + surface.r * np.cos(tube)
        centre = centre + [0.0, 0.0, surface.r * np.sin(tube)]
        a, b = np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0])
        return centre, a, b, turn * rule.first, turn * rule.last
    sphere = isinstance(surface, Sphere)
    size = np.array([surface.r] * 3 if sphere else [surface.a, surface.b, surface.c])
    if rule.direction == "u":
        around = turn * rule.at
        a = size * [np.cos(around), np.sin(around), 0.0]
        low, high = (np.pi * (part - 0.5) for part in (rule.first, rule.last))
        return centre, a, size * [0.0, 0.0, 1.0], low, high
    latitude = np.pi * (rule.at - 0.5)
    size_here = size * np.cos(latitude)
    centre = centre + size * [0.0, 0.0, np.sin(latitude)]
    a, b = size_here * [1.0, 0.0, 0.0], size_here * [0.0, 1.0, 0.0]
    return centre, a, b, turn * rule.first, turn * rule.last


def _arc(centre, a, b, low: float, high: float) -> Curve:
    """Elliptic arc as a rational quadratic, a piece per quarter turn (Piegl & Tiller, 7.3)."""
    count = max(1, int(np.ceil((high - low) / (0.5 * np.pi) - 1e-9)))
    ends = np.linspace(low, high, count + 1)
    half = 0.5 * (high - low) / count
    angles = np.sort(np.concatenate([ends, ends[:-1] + half]))
    weights = np.where(np.arange(2 * count + 1) % 2, np.cos(half), 1.0)
    round_trip = np.cos(angles)[:, None] * a + np.sin(angles)[:, None] * b
    poles = centre + round_trip / weights[:, None]
    knots = np.concatenate([[low], np.repeat(ends, 2), [high]])
    return Curve(2, knots, poles, weights)
