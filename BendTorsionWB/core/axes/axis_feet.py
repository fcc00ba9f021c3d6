# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is wrong with the points or the curve of an axis beside the surface it belongs to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, note, warning
from ..geometry.curve import Curve
from ..geometry.surface import Surface
from .axis_check import LARGEST_AXIS, SMALLEST_AXIS, place

UNITS = {"metres": 1000.0, "centimetres": 10.0, "inches": 25.4, "feet": 304.8}
FAR_FROM_SURFACE = 1000.0
FAR_FROM_SURFACE_RELATIVE = 0.02
"""A point farther from the surface than the larger of 1 m and 2 % of the axis's size was meant
for another surface."""
FITS = 0.01
"""An axis fits a surface when it is nearer than this share of its size."""
PART_OF_SURFACE = 0.05
"""An axis made smaller fits when it is no smaller than this share of the surface: next to nothing
lies on any surface."""
_BEYOND = 1e11
"""mm: from here all of a surface lies one way, unless it is endless."""


def checked_feet(
    name: str,
    given: np.ndarray,
    numbers: np.ndarray,
    surface: Surface | None,
    fit: str,
    offset: float,
) -> list[Finding]:
    """Findings for points against their surface; raises BendTorsionError when they are so far
    away (fit pull or offset) that another surface or unit was meant."""
    if surface is None:
        return []
    foot = surface.closest(given)
    beyond = np.linalg.norm(given - foot.points, axis=1)
    away, limit = _away(foot, given, offset)
    findings = _far_findings(
        name, given, surface, fit, away, limit, lambda worst: f"point {numbers[worst]}"
    )
    for index in np.flatnonzero(foot.outside & (away <= limit)):
        findings.append(
            warning(
                "axis-past-border",
                name,
                "given point lies past the border of the surface",
                "extend the surface or shorten the axis",
                position=f"point {numbers[index]}",
                value=float(beyond[index]),
                unit="mm",
            )
        )
    for index in np.flatnonzero(foot.ambiguous):
        findings.append(
            warning(
                "axis-foot-ambiguous",
                name,
                "given point has no single nearest point and normal on the surface",
                "move the point towards the surface, off its creases",
                position=f"point {numbers[index]}",
            )
        )
    return findings


def _away(foot, points: np.ndarray, offset: float) -> tuple[np.ndarray, float]:
    """How far points are from where they belong beside a surface, mm, and from where on that is
    far. foot: their closest points; offset: of an axis beside it."""
    away = np.minimum(np.abs(foot.distance - offset), np.abs(foot.distance))
    beyond = np.linalg.norm(points - foot.points, axis=1)
    away = np.where(foot.outside, np.maximum(away, beyond), away)
    size = float(np.ptp(points, axis=0).max())
    return away, max(FAR_FROM_SURFACE, FAR_FROM_SURFACE_RELATIVE * size)


def _far_findings(
    name: str,
    points: np.ndarray,
    surface: Surface,
    fit: str,
    away: np.ndarray,
    limit: float,
    position: Callable[[int], str],
) -> list[Finding]:
    """What is told of points far from their surface, whatever they come from: raises
    BendTorsionError but for fit keep, of which it is a warning."""
    worst = int(np.argmax(away))
    if away[worst] <= limit:
        return []
    likely = likely_unit(points, surface)
    if likely is None:
        message = "the axis is far from its surface"
        mend = "choose the surface the axis lies on, or check the coordinates"
    else:
        unit, factor = likely.unit, UNITS[likely.unit]
        if likely.of_surface and likely.taken_for_mm:
            message = (
                f"the axis is far from its surface; the surface is likely in {unit} and taken for "
                "mm"
            )
            mend = f"export the surface in mm: it must be {factor:g} times larger"
        elif likely.of_surface:
            message = (
                "the axis is far from its surface; the surface is likely in mm and taken for "
                f"{unit}"
            )
            mend = f"set the unit of its file to mm: it must be {factor:g} times smaller"
        elif likely.taken_for_mm:
            message = f"the axis is far from its surface; the coordinates are likely in {unit}"
            mend = f"give coordinates in mm: multiply by {factor:g}"
        else:
            message = (
                "the axis is far from its surface; the coordinates are likely in mm and taken for "
                f"{unit}"
            )
            mend = f"set the unit of their file to mm, or divide them by {factor:g}"
    finding = error(
        "axis-far-from-surface",
        name,
        message,
        mend,
        position=position(worst),
        value=float(away[worst]),
        limit=limit,
        unit="mm",
    )
    if fit != "keep":
        raise BendTorsionError(finding)
    return [replace(finding, severity="warning")]


def moved_findings(
    name: str, given: np.ndarray, numbers: np.ndarray, moved: np.ndarray, tolerance: float
) -> list[Finding]:
    """A warning for every point pulled by more than 1 mm; one note for the others pulled by more
    than `tolerance`, saying when they were rounded to whole mm."""
    findings = [
        warning(
            "axis-point-moved",
            name,
            "given point lies off the surface and was pulled onto it",
            "check the point, or use fit = keep",
            position=f"point {numbers[index]}",
            value=float(moved[index]),
            limit=tolerances.POINT_MOVED_WARNING,
            unit="mm",
        )
        for index in np.flatnonzero(moved > tolerances.POINT_MOVED_WARNING)
    ]
    small = (moved > tolerance) & (moved <= tolerances.POINT_MOVED_WARNING)
    if small.any():
        rounded = bool((given == np.round(given)).all())
        findings.append(
            note(
                "axis-points-pulled",
                name,
                f"{int(small.sum())} of {len(given)} given points lie off the surface by less "
                f"than 1 mm and were pulled onto it"
                + ("; the coordinates are rounded to 1 mm" if rounded else ""),
                "give more decimals" if rounded else "",
                value=float(moved[small].max()),
                limit=tolerance,
                unit="mm",
            )
        )
    return findings


@dataclass(frozen=True)
class LikelyUnit:
    """Why an axis and a surface do not fit: one of them, the surface or the axis, is in `unit` and
    taken for mm, or in mm and taken for `unit`."""

    unit: str
    of_surface: bool
    taken_for_mm: bool


def likely_unit(points: np.ndarray, surface: Surface) -> LikelyUnit | None:
    """The unit, wrong for the points or for the surface, in which they would lie on it; None when
    in none. The one of them is wrong whose own size is that of no building; when both could be,
    the smaller is too small."""
    size, whole = float(np.ptp(points, axis=0).max()), _size(surface)
    best = None
    for unit, times in UNITS.items():
        for factor in (times, 1.0 / times):
            scaled, length = factor * points, factor * size
            if factor < 1.0 and whole is not None and length < PART_OF_SURFACE * whole:
                continue
            away = np.linalg.norm(surface.closest(scaled).points - scaled, axis=1).max()
            if away < FITS * length and (best is None or away / length < best[0]):
                best = away / length, unit, factor > 1.0
    if best is None:
        return None
    _, unit, axis_smaller = best
    axis_good = SMALLEST_AXIS <= size <= LARGEST_AXIS
    surface_good = whole is None or SMALLEST_AXIS <= whole <= LARGEST_AXIS
    of_surface = axis_good if axis_good != surface_good else not axis_smaller
    if whole is None:
        of_surface = False
    return LikelyUnit(unit, of_surface, axis_smaller != of_surface)


def _size(surface: Surface) -> float | None:
    """The length, mm, of the longest side of the box about a surface, roughly; None for an endless
    one."""
    foot = surface.closest(_BEYOND * np.vstack([np.eye(3), -np.eye(3)]))
    size = float(np.ptp(foot.points, axis=0).max())
    return size if size < 0.1 * _BEYOND else None


def curve_findings(name: str, curve: Curve, surface: Surface | None, fit: str) -> list[Finding]:
    """Findings for an exact curve against its surface; raises BendTorsionError when it is so far
    away (but for fit keep) that another surface or unit was meant."""
    if surface is None:
        return []
    samples = curve.evaluate(np.linspace(*curve.domain, 201))[0]
    foot = surface.closest(samples)
    away, limit = _away(foot, samples, 0.0)
    far = _far_findings(
        name, samples, surface, fit, away, limit, lambda worst: place(samples[worst])
    )
    distance = np.abs(foot.distance)
    worst = int(np.argmax(distance))
    if far or distance[worst] <= tolerances.POINT_MOVED_WARNING:
        return far
    return [
        warning(
            "axis-far-from-surface",
            name,
            "the curve lies off its surface; the axis keeps to the curve",
            "leave it where the curve is meant; else project the curve onto the surface, give "
            "points, which are pulled onto it, or choose the surface the curve lies on",
            position=place(samples[worst]),
            value=float(distance[worst]),
            limit=tolerances.POINT_MOVED_WARNING,
            unit="mm",
        )
    ]
