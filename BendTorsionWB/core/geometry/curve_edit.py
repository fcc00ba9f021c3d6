# SPDX-License-Identifier: LGPL-2.1-or-later
"""NURBS curves cut, joined, turned and raised in degree, exactly; their arc length and kinks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from .curve import Curve
from .piecewise import Piecewise, resolve

CURVE_DEGREE = 5
"""Degree of curves fitted to a function."""

_MOST_POINTS = 2000


def piece(curve: Curve, first: float, last: float, degree: int | None = None) -> Curve:
    """The part of a curve between two parameters, clamped, at its own or a higher degree.

    The clamped spline space on the same breaks holds the curve, so that collocation at the
    Greville points gives it back to rounding (Piegl & Tiller 1997, ch. 5).
    """
    degree = curve.degree if degree is None else degree
    inner, counts = np.unique(curve.knots, return_counts=True)
    inside = (inner > first) & (inner < last)
    repeats = np.minimum(counts[inside] + degree - curve.degree, degree)
    knots = np.concatenate(
        [np.full(degree + 1, first), np.repeat(inner[inside], repeats), np.full(degree + 1, last)]
    )
    at = np.array([knots[k + 1 : k + degree + 1].mean() for k in range(len(knots) - degree - 1)])
    at[0], at[-1] = first, last
    weights = np.ones(len(curve.poles)) if curve.weights is None else curve.weights
    homogeneous = np.column_stack([curve.poles * weights[:, None], weights])
    values = BSpline(curve.knots, homogeneous, curve.degree)(at)
    found = make_interp_spline(at, values, k=degree, t=knots).c
    if curve.weights is None:
        return Curve(degree, knots, found[:, :3])
    return Curve(degree, knots, found[:, :3] / found[:, 3:], found[:, 3])


def turned(curve: Curve) -> Curve:
    """The curve run through backwards, over the same parameters."""
    first, last = curve.domain
    return Curve(
        curve.degree,
        first + last - curve.knots[::-1],
        curve.poles[::-1],
        None if curve.weights is None else curve.weights[::-1],
    )


def joined(curves: list[Curve], lengths: list[float] | None = None) -> Curve:
    """Curves that meet end to end as one, a full knot at each joint, one parameter after another.

    Each parameter is scaled to run over the length given, mm, or, without lengths, so that the
    speed is the same on both sides of a joint.
    """
    degree = max(curve.degree for curve in curves)
    parts = [piece(curve, *curve.domain, degree) for curve in curves]
    knots, poles, weights = [np.full(degree + 1, parts[0].domain[0])], [], []
    place, speed = parts[0].domain[0], None
    for k, part in enumerate(parts):
        first, last = part.domain
        ends = np.linalg.norm(part.evaluate(np.array([first, last]), 1)[1], axis=1)
        scale = 1.0 if speed is None else ends[0] / speed
        if lengths is not None:
            scale = lengths[k] / (last - first)
        speed = ends[1] / scale
        weight = np.ones(len(part.poles)) if part.weights is None else part.weights
        if k:
            weight = weight * (weights[-1][-1] / weight[0])
        knots.append(place + scale * (part.knots[degree + 1 : -degree - 1] - first))
        place += scale * (last - first)
        knots.append(np.full(degree + 1 if k == len(parts) - 1 else degree, place))
        poles.append(part.poles if k == 0 else part.poles[1:])
        weights.append(weight if k == 0 else weight[1:])
    all_weights = np.concatenate(weights)
    return Curve(
        degree,
        np.concatenate(knots),
        np.concatenate(poles),
        None if np.ptp(all_weights) == 0 else all_weights,
    )


def arc_length(curve: Curve) -> Piecewise:
    """Arc length in mm from the start, over the curve's parameter."""

    def speed(u: np.ndarray) -> np.ndarray:
        return np.linalg.norm(curve.evaluate(u, 1)[1], axis=1)[:, None]

    return resolve(speed, curve.breaks, float(speed(curve.breaks).max())).antiderivative()


def parameters_at(curve: Curve, s: np.ndarray) -> np.ndarray:
    """Parameters (m,) at arc lengths s (m,) mm from the start."""
    arc = arc_length(curve)
    u = np.interp(s, arc(arc.breaks)[:, 0], arc.breaks)
    for _ in range(30):
        step = (arc(u)[:, 0] - s) / arc.derivative(u)[:, 0]
        u = np.clip(u - step, arc.start, arc.end)
        if np.abs(step).max(initial=0.0) < 1e-14 * max(1.0, abs(arc.end)):
            break
    return u


def curve_through(
    function: Callable[[np.ndarray], np.ndarray],
    breaks: np.ndarray,
    tolerance: float,
    degree: int = CURVE_DEGREE,
) -> tuple[Curve, float]:
    """A spline that leaves `function` (u (m,) -> (m, 3)) by no more than `tolerance` mm.

    It interpolates at the breaks, which are halved where the function at the quarter points of a
    span is missed, with their neighbours, so that spans stay graded. Returns the curve and the
    largest miss at the points checked last.
    """
    u = np.asarray(breaks, float)
    while len(u) < degree + 1:
        u = np.sort(np.concatenate([u, 0.5 * (u[1:] + u[:-1])]))
    values = function(u)
    while True:
        spline = make_interp_spline(u, values, k=degree)
        checks = (u[:-1, None] + np.diff(u)[:, None] * [0.25, 0.5, 0.75]).ravel()
        truth = function(checks)
        miss = np.linalg.norm(spline(checks) - truth, axis=1).reshape(-1, 3).max(axis=1)
        bad = miss > tolerance
        if not bad.any() or len(u) > _MOST_POINTS:
            return Curve(degree, spline.t, spline.c), float(miss.max())
        bad |= np.concatenate([bad[1:], [False]]) | np.concatenate([[False], bad[:-1]])
        middle = checks.reshape(-1, 3)[bad, 1]
        place = np.searchsorted(u, middle)
        values = np.insert(values, place, truth.reshape(-1, 3, 3)[bad, 1], axis=0)
        u = np.insert(u, place, middle)


def kinks(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Parameters (k,) inside the curve where it may kink, and the angle (k,) rad turned there."""
    inner, counts = np.unique(curve.knots, return_counts=True)
    first, last = curve.domain
    at = inner[(counts >= curve.degree) & (inner > first) & (inner < last)]
    if not len(at):
        return at, np.zeros(0)
    # One-sided tangents: each smooth piece by itself.
    edges = np.concatenate([[first], at, [last]])
    parts = [piece(curve, a, b) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    ends = np.array([part.evaluate(np.array(part.domain), 1)[1] for part in parts])
    ends /= np.linalg.norm(ends, axis=2, keepdims=True)
    sine = np.linalg.norm(np.cross(ends[:-1, 1], ends[1:, 0]), axis=1)
    return at, np.arctan2(sine, (ends[:-1, 1] * ends[1:, 0]).sum(axis=1))


def polyline_vertices(curve: Curve, sharpest: float) -> np.ndarray | None:
    """Vertices (k, 3) of a curve that is straight between kinks of `sharpest` rad at most; None
    for any other curve."""
    at, angle = kinks(curve)
    if not len(at) or not 1e-9 < angle.max() <= sharpest:
        return None
    first, last = curve.domain
    edges = np.concatenate([[first], at, [last]])
    vertices = curve.evaluate(edges)[0]
    inner = (edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.1, 0.9, 5)).ravel()
    points = curve.evaluate(inner)[0].reshape(len(edges) - 1, 5, 3)
    along = np.diff(vertices, axis=0)
    away = np.linalg.norm(np.cross(points - vertices[:-1, None], along[:, None]), axis=2)
    # Areas against length times size: rounding of the coordinates is no bend.
    straight = away <= 1e-9 * np.linalg.norm(along, axis=1)[:, None] * np.abs(vertices).max()
    return vertices if straight.all() else None
