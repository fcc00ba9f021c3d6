# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is wrong with the points or the curve an axis is to be made from."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

import numpy as np
from scipy.spatial import cKDTree

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, note, warning
from ..geometry.curve import Curve
from ..geometry.curve_edit import kinks
from ..geometry.piecewise import Piecewise

SMALLEST_AXIS = 200.0
"""mm: an axis that is smaller as a whole is most likely given in another unit."""
LARGEST_AXIS = 5e6
"""mm: an axis that is larger as a whole is most likely given in another unit."""
WIDE_GAP = 20.0
"""A gap this many times the median gap is where points may be missing."""
CROSSES_ITSELF = 1.0
"""mm: parts of an axis that come this near to each other cross."""
KINK = np.radians(0.1)
"""Tangents that differ by more at a joint of an exact curve make a kink no plate can follow."""
SLIGHT_KINK = np.radians(0.01)
_ENDS_MEET = 1.0
FARTHEST = 1e10
"""mm: no coordinate of a building, survey grids included, is larger."""
WEIGHTS = 1e6
"""Weights of a curve's poles differ by no larger factor."""
KNOTS_SPAN = 1e-9, 1e12
"""Knots of a curve run over no less, and are no larger."""
_KNOTS_ONE = 1e-14


def check_coordinates(
    name: str,
    points: np.ndarray,
    what: str,
    numbers: Sequence[int] | np.ndarray | None = None,
    unit: float = 1.0,
) -> None:
    """Raises BendTorsionError at the first of points (k, 3), in units of `unit` mm, that is not
    finite or farther away than FARTHEST. what, with the point's number if there are numbers: where
    it is."""
    fine = (np.abs(points) <= FARTHEST / unit).all(axis=1)
    if fine.all():
        return
    k = int(np.argmin(fine))
    position = what if numbers is None else f"{what} {numbers[k]}"
    mend = "give x, y and z in mm"
    if not np.isfinite(points[k]).all():
        message = "coordinate is not a finite number"
        raise BendTorsionError(
            error("axis-point-not-a-number", name, message, mend, position=position)
        )
    value = float(np.abs(points[k]).max()) * unit
    raise BendTorsionError(
        error(
            "axis-point-too-far",
            name,
            "coordinate is far beyond any building",
            mend,
            position=position,
            value=value if isfinite(value) else None,
            limit=FARTHEST,
            unit="mm",
        )
    )


def check_curve(name: str, curve: Curve, position: str, unit: float = 1.0) -> None:
    """Raises BendTorsionError for a curve, in units of `unit` mm, with numbers that nothing can be
    computed from: poles as of check_coordinates, weights, knots."""
    check_coordinates(name, curve.poles, position, unit=unit)
    if curve.weights is not None:
        check_weights(name, curve.weights, position)
    if not _knots_rise(curve):
        message = "knots of the curve do not rise, or are too near or too far"
        raise BendTorsionError(
            error("axis-curve-knots", name, message, "rebuild the curve", position=position)
        )


def _knots_rise(curve: Curve) -> bool:
    least, most = KNOTS_SPAN
    if not (np.abs(curve.knots) <= most).all():
        return False
    span, steps = curve.domain[1] - curve.domain[0], np.diff(curve.knots)
    return bool(span >= least and ((steps == 0) | (steps > _KNOTS_ONE * span)).all())


def check_weights(name: str, weights: np.ndarray, position: str) -> None:
    """Raises BendTorsionError for weights (n,) of poles that are not positive, or too different."""
    least, most = float(np.min(weights)), float(np.max(weights))
    if not (0.0 < least <= most <= WEIGHTS * least and isfinite(most)):
        message = "weights of the curve's poles are not positive, or too different"
        raise BendTorsionError(
            error(
                "axis-curve-weights",
                name,
                message,
                "rebuild the curve",
                position=position,
            )
        )


def checked_points(
    name: str, given: np.ndarray, numbers: np.ndarray, closed: bool
) -> list[Finding]:
    """Findings for points (k, 3); raises BendTorsionError when no axis can run through them."""
    check_coordinates(name, given, "point", numbers)
    least = 3 if closed else 2
    gaps = np.linalg.norm(np.diff(given, axis=0), axis=1)
    ends_meet = len(given) > least and (
        np.linalg.norm(given[-1] - given[0]) <= tolerances.POINTS_COINCIDE
    )
    distinct = len(given) - bool(closed and ends_meet)
    if distinct < least:
        raise BendTorsionError(
            error(
                "axis-too-few-points",
                name,
                f"{'a closed' if closed else 'an'} axis needs at least {least} points",
                "add points",
                value=len(given),
                limit=least,
            )
        )
    if (gaps < tolerances.POINTS_COINCIDE).any():
        index = int(np.argmin(gaps))
        raise BendTorsionError(
            error(
                "axis-points-coincide",
                name,
                f"points {numbers[index]} and {numbers[index + 1]} coincide",
                "delete one of them",
                position=f"point {numbers[index + 1]}",
                value=float(gaps[index]),
                limit=tolerances.POINTS_COINCIDE,
                unit="mm",
            )
        )
    findings = checked_size(name, given)
    if ends_meet and not closed:
        findings.append(
            warning(
                "axis-ends-meet",
                name,
                "the first and the last point are one",
                "set closed = yes for a ring",
                position=f"point {numbers[-1]}",
            )
        )
    median = float(np.median(gaps))
    for index in np.flatnonzero(gaps > WIDE_GAP * median) if len(gaps) > 2 else ():
        findings.append(
            warning(
                "axis-gap",
                name,
                "the gap to the next point is far wider than the others; points may be missing",
                "add the missing points, or ignore this when the gap is meant",
                position=f"point {numbers[index]}",
                value=float(gaps[index]),
                limit=WIDE_GAP * median,
                unit="mm",
            )
        )
    return findings


def checked_size(name: str, points: np.ndarray) -> list[Finding]:
    """A warning for a size no axis of a building has in mm, naming the likely unit."""
    size = float(np.ptp(points, axis=0).max())
    if SMALLEST_AXIS <= size <= LARGEST_AXIS:
        return []
    small = size < SMALLEST_AXIS
    return [
        warning(
            "axis-size",
            name,
            f"the whole axis measures {size:.6g} mm; "
            + (
                "the coordinates are likely in metres"
                if small
                else "the coordinates are likely in micrometres, or hold a slip"
            ),
            "give coordinates in mm" + (": multiply by 1000" if small else ""),
            value=size,
            limit=SMALLEST_AXIS if small else LARGEST_AXIS,
            unit="mm",
        )
    ]


def checked_curve(name: str, curve: Curve) -> tuple[bool, list[Finding]]:
    """Whether an exact curve closes smoothly, and findings; raises BendTorsionError at kinks."""
    findings, errors = [], []
    at, angle = kinks(curve)
    points = curve.evaluate(at)[0] if len(at) else np.zeros((0, 3))
    for point, turn in zip(points, angle, strict=True):
        if turn > SLIGHT_KINK:
            sharp = turn > KINK
            (errors if sharp else findings).append(
                (error if sharp else warning)(
                    "axis-kink",
                    name,
                    "the curve has a kink, which no member can follow",
                    "round it, split the curve there, or use its vertices as points",
                    position=place(point),
                    value=float(np.degrees(turn)),
                    limit=float(np.degrees(KINK if sharp else SLIGHT_KINK)),
                    unit="°",
                )
            )
    if errors:
        raise BendTorsionError(errors)
    first, last = curve.domain
    ends, rates = curve.evaluate(np.array([first, last]), 1)
    rates = rates / np.linalg.norm(rates, axis=1, keepdims=True)
    closed = False
    if np.linalg.norm(ends[1] - ends[0]) <= tolerances.POINTS_COINCIDE:
        turn = float(np.arccos(np.clip(rates[0] @ rates[1], -1.0, 1.0)))
        closed = turn <= KINK
        if not closed:
            findings.append(
                warning(
                    "axis-ends-meet",
                    name,
                    "the curve's ends meet with a kink: taken as open",
                    "round the corner for a ring",
                    position=place(ends[0]),
                    value=float(np.degrees(turn)),
                    limit=float(np.degrees(KINK)),
                    unit="°",
                )
            )
    findings += checked_size(name, curve.evaluate(np.linspace(first, last, 201))[0])
    return closed, findings


def checked_shape(name: str, position: Piecewise, closed: bool) -> list[Finding]:
    """Raises BendTorsionError where the axis crosses itself; a note where its ends nearly meet."""
    crossing = self_approach(position, closed)
    if crossing is None:
        return []
    first, second, distance = crossing
    at = position(np.array([first]))[0]
    if not closed and first < _ENDS_MEET and second > position.end - _ENDS_MEET:
        return [
            note(
                "axis-ends-meet",
                name,
                "start and end of the axis meet",
                "set closed = yes for a ring",
                position=place(at),
                value=distance,
                unit="mm",
            )
        ]
    raise BendTorsionError(
        error(
            "axis-crosses-itself",
            name,
            f"the axis crosses itself: s = {first:.0f} mm and s = {second:.0f} mm are one place",
            "check the order of the points",
            position=place(at),
            value=distance,
            limit=CROSSES_ITSELF,
            unit="mm",
        )
    )


def self_approach(position: Piecewise, closed: bool) -> tuple[float, float, float] | None:
    """Two arc lengths and their distance where parts of the axis that are not neighbours come
    nearer than CROSSES_ITSELF, None where they do not."""
    count = int(np.clip(8 * len(position.breaks), 200, 800))
    s = np.linspace(0.0, position.end, count)
    points = position(s)
    step = position.end / (count - 1)
    pairs = cKDTree(points).query_pairs(1.5 * step, output_type="ndarray")
    apart = s[pairs[:, 1]] - s[pairs[:, 0]]
    if closed:
        apart = np.minimum(apart, position.end - apart)
    pairs = pairs[apart > 5 * step]
    if not len(pairs):
        return None
    first, second = s[pairs[:, 0]], s[pairs[:, 1]]
    tangent = position.derivative
    for _ in range(20):
        gap = position(second) - position(first)
        a, b = tangent(first), tangent(second)
        dot = (a * b).sum(axis=1)
        # Beside parallel parts the damping keeps the step along them small.
        below = 1.0 - dot**2 + 1e-6
        along, back = (gap * a).sum(axis=1), (gap * b).sum(axis=1)
        first = np.clip(
            first + np.clip((along - dot * back) / below, -step, step), 0.0, position.end
        )
        second = np.clip(
            second + np.clip((dot * along - back) / below, -step, step), 0.0, position.end
        )
    distance = np.linalg.norm(position(second) - position(first), axis=1)
    apart = second - first
    if closed:
        apart = np.minimum(apart, position.end - apart)
    distance[apart < 2 * step] = np.inf
    best = int(np.argmin(distance))
    if distance[best] > CROSSES_ITSELF:
        return None
    return float(first[best]), float(second[best]), float(distance[best])


def place(point: np.ndarray) -> str:
    """A point in space for a finding."""
    return "at x, y, z = " + ", ".join(f"{value:.0f}" for value in point) + " mm"
