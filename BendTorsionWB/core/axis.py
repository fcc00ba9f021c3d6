# SPDX-License-Identifier: LGPL-2.1-or-later
"""The member axis: a curve fitted through given points, pulled onto the surface, by arc length."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.interpolate import make_interp_spline

from . import tolerances
from .curve import Curve
from .finding import BendTorsionError, Finding, error, note, warning
from .piecewise import Piecewise, resolve
from .surface import Surface

LONGEST_PULL = 12
"""Rounds of refinement; each at least halves the spans that miss the tolerance."""


@dataclass(frozen=True, eq=False)
class Axis:
    """An axis by arc length s (mm, from its start).

    curve: the NURBS curve; position: s -> (3,). given: (k, 3) the points as given; moved: (k,) how
    far each was pulled (zeros when kept). control: (c, 3) the points the curve interpolates.
    """

    name: str
    curve: Curve
    position: Piecewise
    given: np.ndarray
    moved: np.ndarray
    control: np.ndarray
    findings: tuple[Finding, ...] = field(default=())

    @property
    def length(self) -> float:
        """Arc length, mm."""
        return self.position.end

    @cached_property
    def tangent(self) -> Piecewise:
        """Unit tangent dC/ds."""
        return self.position.derivative

    def distance_to(self, surface: Surface, samples: int = 1001) -> tuple[float, float]:
        """RMS and largest distance of the curve itself to the surface, mm, at even parameters."""
        first, last = self.curve.domain
        points = self.curve.evaluate(np.linspace(first, last, samples))[0]
        distance = np.abs(surface.closest(points).distance)
        return float(np.sqrt(np.mean(distance**2))), float(distance.max())

    def place_of(self, points: np.ndarray) -> np.ndarray:
        """Arc length (m,) of the point of the axis nearest to each of points (m, 3)."""
        s = np.linspace(0.0, self.length, 50 * len(self.position.breaks))
        curve = self.position(s)
        nearest = np.array([np.argmin(np.sum((curve - p) ** 2, axis=1)) for p in points])
        place = s[nearest]
        second = self.tangent.derivative
        for _ in range(20):
            gap = self.position(place) - points
            slope = self.tangent(place)
            step = np.sum(gap * slope, axis=1) / (1.0 + np.sum(gap * second(place), axis=1))
            place = np.clip(place - step, 0.0, self.length)
            if np.abs(step).max() < tolerances.SAME_STATION:
                break
        return place


def fit_axis(
    name: str,
    points: np.ndarray,
    surface: Surface | None = None,
    fit: str = "pull",
    tolerance: float = tolerances.AXIS_ON_SURFACE,
    max_spacing: float | None = None,
) -> Axis:
    """The axis through ordered points (k, 3) in mm.

    Cubic B-spline, weights 1, chord-length parameters, not-a-knot ends (2 points: line, 3:
    parabola). `pull` adds points on the first fit, never on its chords, and pulls them onto the
    surface until a quarter, half and three quarters of every span are within `tolerance` of it;
    given points are pulled too. `keep` leaves the curve where the points put it. max_spacing:
    largest distance of neighbouring control points (paper Eq. 2 with n = ceil(L/m), the points
    taken on the curve). Raises BendTorsionError for fewer than two distinct finite points.
    """
    given = np.array(points, float).reshape(-1, 3)
    findings = _checked(name, given)
    kept, merged = _merge_close(given)
    findings += [
        note(
            "axis-point-merged",
            name,
            "point is closer to its neighbour than 0.15 of the mean gap and was left out",
            position=f"point {index + 1}",
        )
        for index in merged
    ]
    base = given[kept]
    parameters = _chord_length(base)
    first_fit = _interpolate(parameters, base)
    control, moved = base, np.zeros(len(given))
    if max_spacing:
        counts = np.ceil(np.diff(parameters) / max_spacing).astype(int)
        parameters = _subdivided(parameters, counts)
        control = first_fit.evaluate(parameters)[0]
    curve = _interpolate(parameters, control) if max_spacing else first_fit
    if fit == "pull" and surface is not None:
        moved = np.abs(surface.closest(given).distance)
        curve, control, pulled = _pull(name, first_fit, parameters, surface, tolerance)
        findings += pulled + [
            warning(
                "axis-point-moved",
                name,
                "given point lies off the surface and was pulled onto it",
                "check the point, or use fit = keep",
                position=f"point {index + 1}",
                value=float(moved[index]),
                limit=tolerances.POINT_MOVED_WARNING,
                unit="mm",
            )
            for index in np.flatnonzero(moved > tolerances.POINT_MOVED_WARNING)
        ]
    return Axis(name, curve, arc_length_position(curve), given, moved, control, tuple(findings))


def axis_from_curve(name: str, curve: Curve) -> Axis:
    """The axis that runs along an exact curve, used as it is."""
    position = arc_length_position(curve)
    ends = position(np.array([0.0, position.end]))
    return Axis(name, curve, position, ends, np.zeros(2), ends)


def arc_length_position(curve: Curve) -> Piecewise:
    """Position by arc length: the curve's parameter is inverted by Newton at every node."""
    breaks = curve.breaks
    size = float(np.abs(curve.poles).max()) + 1.0

    def speed(u: np.ndarray) -> np.ndarray:
        return np.linalg.norm(curve.evaluate(u, 1)[1], axis=1)[:, None]

    rate = resolve(speed, breaks, float(speed(breaks).max()))
    arc = rate.antiderivative()
    knots_s = arc(breaks)[:, 0]
    knots_s[0] = 0.0

    def position(s: np.ndarray) -> np.ndarray:
        u = np.interp(s, knots_s, breaks)
        for _ in range(30):
            step = (arc(u)[:, 0] - s) / rate(u)[:, 0]
            u = np.clip(u - step, breaks[0], breaks[-1])
            if np.abs(step).max() < 1e-14 * max(1.0, abs(breaks[-1])):
                break
        return curve.evaluate(u)[0]

    return resolve(position, knots_s, size)


def _checked(name: str, given: np.ndarray) -> list[Finding]:
    if not np.isfinite(given).all():
        bad = int(np.flatnonzero(~np.isfinite(given).all(axis=1))[0]) + 1
        raise BendTorsionError(
            error(
                "axis-point-not-a-number",
                name,
                "coordinate is not a finite number",
                "give x, y and z in mm",
                position=f"point {bad}",
            )
        )
    if len(given) < 2:
        raise BendTorsionError(
            error(
                "axis-too-few-points",
                name,
                "an axis needs at least two points",
                "add points",
                value=len(given),
                limit=2,
            )
        )
    gaps = np.linalg.norm(np.diff(given, axis=0), axis=1)
    if (gaps < tolerances.POINTS_COINCIDE).any():
        index = int(np.argmin(gaps))
        raise BendTorsionError(
            error(
                "axis-points-coincide",
                name,
                f"points {index + 1} and {index + 2} coincide",
                "delete one of them",
                position=f"point {index + 2}",
                value=float(gaps[index]),
                limit=tolerances.POINTS_COINCIDE,
                unit="mm",
            )
        )
    return []


def _merge_close(given: np.ndarray) -> tuple[np.ndarray, list[int]]:
    """Indices kept and left out: inner points closer than 0.15 of the mean gap to the last kept."""
    gaps = np.linalg.norm(np.diff(given, axis=0), axis=1)
    least = tolerances.MERGE_FRACTION_OF_MEAN_GAP * gaps.mean()
    kept, dropped = [0], []
    for index in range(1, len(given) - 1):
        near_last = np.linalg.norm(given[index] - given[kept[-1]]) < least
        near_end = np.linalg.norm(given[index] - given[-1]) < least
        (dropped if near_last or near_end else kept).append(index)
    return np.array([*kept, len(given) - 1]), dropped


def _chord_length(points: np.ndarray) -> np.ndarray:
    """Chord-length parameters in mm (full order: Floater & Surazhsky 2006)."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def _interpolate(parameters: np.ndarray, points: np.ndarray) -> Curve:
    """Interpolating B-spline, not-a-knot ends (paper Eq. 1 with weights 1)."""
    degree = min(3, len(points) - 1)
    spline = make_interp_spline(parameters, points, k=degree)
    return Curve(degree, spline.t, spline.c)


def _subdivided(parameters: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """Parameters with span i cut into counts[i] even parts."""
    parts = [
        np.linspace(a, b, n + 1)[:-1]
        for a, b, n in zip(parameters[:-1], parameters[1:], np.maximum(counts, 1), strict=True)
    ]
    return np.concatenate([*parts, parameters[-1:]])


def _pull(
    name: str, first_fit: Curve, parameters: np.ndarray, surface: Surface, tolerance: float
) -> tuple[Curve, np.ndarray, list[Finding]]:
    """Refine `parameters` and refit through pulled points until all spans are on the surface."""
    fractions = np.array([0.25, 0.5, 0.75])
    for _ in range(LONGEST_PULL):
        control = surface.closest(first_fit.evaluate(parameters)[0]).points
        curve = _interpolate(parameters, control)
        spans = np.diff(parameters)
        checks = parameters[:-1, None] + spans[:, None] * fractions
        distance = np.abs(surface.closest(curve.evaluate(checks.ravel())[0]).distance)
        worst = distance.reshape(checks.shape).max(axis=1)
        counts = np.where(
            worst > tolerance, np.maximum(2, np.ceil((2 * worst / tolerance) ** 0.25)), 1
        ).astype(int)
        if (counts == 1).all():
            return curve, control, []
        parameters = _subdivided(parameters, np.minimum(counts, 8))
    return (
        curve,
        control,
        [
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
        ],
    )
