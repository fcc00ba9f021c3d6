# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cubic curves through ordered points: chord-length fit, open or closed, pulled onto a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import trapezoid
from scipy.interpolate import make_interp_spline

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..geometry.curve import Curve
from ..geometry.curve_edit import piece
from ..geometry.surface import Surface

LONGEST_PULL = 12
"""Rounds of refinement; each at least halves the spans that miss the tolerance."""

MOST_POINTS = 4000
"""Control points an axis may have: one every few millimetres is a slip of the pen."""

LEAST_TOLERANCE = 1e-5
"""mm; what a pull onto a surface can be asked for."""

_SAMPLES = 9


@dataclass(frozen=True)
class Refinement:
    """Rules for control points beyond those given; None: no such rule.

    max_spacing: mm along the axis (paper Eq. 2 with n = ceil(L/m), the points taken on the
    curve). chord_sag: mm between the curve and its chord, spacing sqrt(8 R sag). tangent_turn:
    rad the tangent turns from one control point to the next. twist_step: rad the surface normal
    turns about the axis from one to the next.
    """

    max_spacing: float | None = None
    chord_sag: float | None = None
    tangent_turn: float | None = None
    twist_step: float | None = None


NO_RULES = Refinement()


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted curve with its parameters (c,) and the points (c, 3) it interpolates."""

    curve: Curve
    parameters: np.ndarray
    control: np.ndarray


def chord_length(points: np.ndarray) -> np.ndarray:
    """Chord-length parameters in mm (full order: Floater & Surazhsky 2006)."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def interpolate(
    parameters: np.ndarray,
    points: np.ndarray,
    closed: bool = False,
    tangents: tuple[np.ndarray | None, np.ndarray | None] = (None, None),
) -> Curve:
    """Interpolating cubic B-spline (paper Eq. 1 with weights 1), C2.

    Ends not-a-knot (2 points: line, 3: parabola), along `tangents` where given, or periodic when
    closed: then the last point repeats the first, and the curve comes back clamped at its seam.
    """
    if closed:
        spline = make_interp_spline(parameters, points, k=3, bc_type="periodic")
        curve = piece(Curve(3, spline.t, spline.c), parameters[0], parameters[-1])
        curve.poles[-1] = curve.poles[0]
        return curve
    if all(tangent is None for tangent in tangents):
        spline = make_interp_spline(parameters, points, k=min(3, len(points) - 1))
        return Curve(spline.k, spline.t, spline.c)
    # One derivative more at an end: one knot more than not-a-knot keeps.
    degree = min(3, len(points) - 1 + sum(tangent is not None for tangent in tangents))
    inner = parameters[1 if tangents[0] is not None else 2 : -1 if tangents[1] is not None else -2]
    knots = np.concatenate(
        [np.full(degree + 1, parameters[0]), inner, np.full(degree + 1, parameters[-1])]
    )
    conditions = [
        None if tangent is None else [(1, np.asarray(tangent, float) / np.linalg.norm(tangent))]
        for tangent in tangents
    ]
    spline = make_interp_spline(parameters, points, k=degree, t=knots, bc_type=tuple(conditions))
    return Curve(spline.k, spline.t, spline.c)


def refined_parameters(
    name: str, fit: Fit, rules: Refinement, surface: Surface | None
) -> np.ndarray:
    """The fit's parameters with its spans cut into even parts until every rule is kept; raises
    BendTorsionError for rules that ask for more than MOST_POINTS."""
    parameters, spans = fit.parameters, np.diff(fit.parameters)
    u = parameters[:-1, None] + spans[:, None] * np.linspace(0.0, 1.0, _SAMPLES)
    points, first, second = (part.reshape(*u.shape, 3) for part in fit.curve.evaluate(u.ravel(), 2))
    speed = np.linalg.norm(first, axis=2)
    curvature = np.linalg.norm(np.cross(first, second), axis=2) / speed**3
    length = trapezoid(speed, u, axis=1)
    need = [np.ones(len(spans))]
    if rules.max_spacing:
        need.append(length / rules.max_spacing)
    if rules.chord_sag:
        need.append(length * np.sqrt(curvature.max(axis=1) / (8.0 * rules.chord_sag)))
    if rules.tangent_turn:
        need.append(trapezoid(curvature * speed, u, axis=1) / rules.tangent_turn)
    if rules.twist_step and surface is not None:
        normal = surface.closest(points.reshape(-1, 3)).normals.reshape(points.shape)
        across = np.cross(first / speed[..., None], normal)
        middle = 0.5 * (across[:, 1:] + across[:, :-1])
        turn = np.abs((np.diff(normal, axis=1) * middle).sum(axis=2)).sum(axis=1)
        need.append(turn / rules.twist_step)
    # A span that keeps its rule to rounding is not cut.
    wanted = np.ceil(np.max(need, axis=0) * (1 - 1e-9))
    if not wanted.sum() <= MOST_POINTS:
        raise BendTorsionError(
            error(
                "axis-too-many-points",
                name,
                "the refinement rules ask for too many control points",
                "use a larger spacing, sag, turn or twist step",
                value=float(wanted.sum()),
                limit=MOST_POINTS,
            )
        )
    counts = wanted.astype(int)
    return _subdivided(parameters, counts)


def pulled(
    name: str,
    first: Fit,
    surface: Surface,
    tolerance: float,
    closed: bool,
    tangents: tuple[np.ndarray | None, np.ndarray | None] = (None, None),
) -> tuple[Fit, list[Finding]]:
    """The fit with its points pulled onto the surface, and more of them, taken on the first fit,
    until a quarter, half and three quarters of every span are within `tolerance` of it."""
    if not tolerance >= LEAST_TOLERANCE:
        raise BendTorsionError(
            error(
                "axis-tolerance",
                name,
                "the tolerance of the pull is too small",
                "use 0.005 mm",
                value=float(tolerance),
                limit=LEAST_TOLERANCE,
                unit="mm",
            )
        )
    fractions = np.array([0.25, 0.5, 0.75])
    parameters = first.parameters
    for _ in range(LONGEST_PULL):
        control = surface.closest(first.curve.evaluate(parameters)[0]).points
        if closed:
            control[-1] = control[0]
        curve = interpolate(parameters, control, closed, tangents)
        spans = np.diff(parameters)
        checks = parameters[:-1, None] + spans[:, None] * fractions
        distance = np.abs(surface.closest(curve.evaluate(checks.ravel())[0]).distance)
        worst = distance.reshape(checks.shape).max(axis=1)
        # Half the tolerance is aimed at: the error falls with the fourth power of the span.
        parts = np.ceil((2 * worst / tolerance) ** 0.25)
        counts = np.where(worst > tolerance, np.clip(parts, 2, 8), 1).astype(int)
        fit = Fit(curve, parameters, control)
        if (counts == 1).all():
            return fit, []
        if counts.sum() > MOST_POINTS:
            break
        parameters = _subdivided(parameters, counts)
    return fit, [
        warning(
            "axis-off-surface",
            name,
            "the axis could not be pulled onto the surface within tolerance",
            "add points where the surface bends sharply",
            position=f"s near {checks[int(np.argmax(worst)), 1]:.0f} mm",
            value=float(worst.max()),
            limit=tolerance,
            unit="mm",
        )
    ]


def merge_close(given: np.ndarray, closed: bool) -> tuple[np.ndarray, list[int]]:
    """Indices kept and left out: inner points closer than 0.15 of the mean gap to the last kept.

    The ends of an open axis are kept, of a closed one the first point.
    """
    following = np.vstack([given[1:], given[:1]]) if closed else given[1:]
    gaps = np.linalg.norm(following - given[: len(following)], axis=1)
    least = tolerances.MERGE_FRACTION_OF_MEAN_GAP * gaps.mean()
    end = given[0] if closed else given[-1]
    kept, dropped = [0], []
    for index in range(1, len(given) if closed else len(given) - 1):
        near_last = np.linalg.norm(given[index] - given[kept[-1]]) < least
        near_end = np.linalg.norm(given[index] - end) < least
        (dropped if near_last or near_end else kept).append(index)
    return np.array(kept if closed else [*kept, len(given) - 1]), dropped


def _subdivided(parameters: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """Parameters with span i cut into counts[i] even parts."""
    parts = [
        np.linspace(a, b, n + 1)[:-1]
        for a, b, n in zip(parameters[:-1], parameters[1:], np.maximum(counts, 1), strict=True)
    ]
    return np.concatenate([*parts, parameters[-1:]])
