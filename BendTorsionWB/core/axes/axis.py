# SPDX-License-Identifier: LGPL-2.1-or-later
"""The member axis by arc length: through given points, on its surface, or along an exact curve."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, note, warning
from ..geometry.curve import Curve
from ..geometry.curve_edit import arc_length, turned
from ..geometry.piecewise import Piecewise, resolve
from ..geometry.surface import Offset, Surface
from .axis_check import checked_curve, checked_points, checked_shape
from .axis_feet import checked_feet, curve_findings, moved_findings
from .axis_fit import (
    NO_RULES,
    Fit,
    Refinement,
    chord_length,
    interpolate,
    merge_close,
    pulled,
    refined_parameters,
)

FITS = ("pull", "keep", "offset")


@dataclass(frozen=True, eq=False)
class Axis:
    """An axis by arc length s (mm, from its trimmed start).

    curve: the NURBS curve; position: s -> (3,). given: (k, 3) the points as given; moved: (k,) how
    far each was pulled (zeros when kept). control: (c, 3) the points the curve interpolates.
    closed: the end is the start, C2 there. offset: mm from the surface it is meant to run at.
    through: the curve through the given points before anything was pulled or added. trimmed: mm
    added at start and end (negative: cut off). A fabrication axis carries the `design` axis it
    was displaced from, and design_place: its own s -> s of the design axis.
    """

    name: str
    curve: Curve
    position: Piecewise
    given: np.ndarray
    moved: np.ndarray
    control: np.ndarray
    findings: tuple[Finding, ...] = field(default=())
    closed: bool = False
    offset: float = 0.0
    through: Curve | None = None
    trimmed: tuple[float, float] = (0.0, 0.0)
    design: Axis | None = None
    design_place: Piecewise | None = None

    @property
    def length(self) -> float:
        """Arc length, mm."""
        return self.position.end

    @cached_property
    def tangent(self) -> Piecewise:
        """Unit tangent dC/ds."""
        return self.position.derivative

    def surface_points(self, s: np.ndarray) -> np.ndarray:
        """Points (m, 3) whose surface normals the frames take: of the design axis if there is
        one, else of the axis itself."""
        if self.design is None:
            return self.position(s)
        return self.design.position(self.design_place(s)[:, 0])

    @property
    def control_design(self) -> np.ndarray:
        """The control points (c, 3) on the design axis; `control` where there is no preset."""
        return self.control if self.design is None else self.design.control

    def distance_to(self, surface: Surface, samples: int = 1001) -> tuple[float, float]:
        """RMS and largest distance of the curve itself to the surface (to its offset where the
        axis has one; of the design axis where there is one), mm, at even parameters."""
        if self.design is not None:
            return self.design.distance_to(surface, samples)
        first, last = self.curve.domain
        points = self.curve.evaluate(np.linspace(first, last, samples))[0]
        distance = np.abs(surface.closest(points).distance - self.offset)
        return float(np.sqrt(np.mean(distance**2))), float(distance.max())

    def curvature(self, s: np.ndarray) -> np.ndarray:
        """Curvature vectors (m, 3), 1/mm, at arc lengths s (m,)."""
        return self.tangent.derivative(s)

    @cached_property
    def least_radius(self) -> tuple[float, float]:
        """The smallest radius of curvature, mm (inf when straight), and where, s in mm."""
        s = np.unique(self.position.nodes.ravel())
        curvature = np.linalg.norm(self.curvature(s), axis=1)
        worst = int(np.argmax(curvature))
        straight = curvature[worst] * self.length < 1e-9
        return (np.inf if straight else float(1.0 / curvature[worst])), float(s[worst])

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

    def turned(self) -> Axis:
        """The axis run through backwards; the given points keep their numbers."""
        ends = self.position
        position = Piecewise(ends.end - ends.breaks[::-1], ends.values[::-1, ::-1].copy())
        return replace(
            self,
            curve=turned(self.curve),
            position=position,
            control=self.control[::-1],
            through=None if self.through is None else turned(self.through),
            trimmed=self.trimmed[::-1],
        )

    def with_findings(self, findings) -> Axis:
        """The axis with these findings before its own."""
        return replace(self, findings=(*findings, *self.findings)) if findings else self


def fit_axis(
    name: str,
    points: np.ndarray,
    surface: Surface | None = None,
    fit: str = "pull",
    tolerance: float = tolerances.AXIS_ON_SURFACE,
    max_spacing: float | None = None,
    *,
    closed: bool = False,
    offset: float | None = None,
    refinement: Refinement = NO_RULES,
    start_tangent: np.ndarray | None = None,
    end_tangent: np.ndarray | None = None,
    numbers: np.ndarray | None = None,
) -> Axis:
    """The axis through ordered points (k, 3) in mm.

    Cubic B-spline, weights 1, chord-length parameters, not-a-knot ends (2 points: line, 3:
    parabola), tangents where given, periodic when closed. `pull` adds points on the first fit,
    never on its chords, and pulls them onto the surface until a quarter, half and three quarters
    of every span are within `tolerance` of it; given points are pulled too. `offset` does the
    same at `offset` mm from the surface along its normals (None: the points' mean). `keep` leaves
    the curve where the points put it. max_spacing and refinement: rules for more control points.
    numbers (k,): how findings call the points, 1, 2, … when None. Raises BendTorsionError for
    points no axis can be made from.
    """
    given = np.array(points, float).reshape(-1, 3)
    numbers = np.arange(1, len(given) + 1) if numbers is None else np.asarray(numbers)
    findings = checked_points(name, given, numbers, closed)
    ring = given[:-1] if closed and _meets(given) else given
    target, distance = _target(name, given, surface, fit, offset, findings)
    findings += checked_feet(name, given, numbers, surface, fit, distance)
    kept, merged = merge_close(ring, closed)
    base = ring[kept]
    if closed:
        base = np.vstack([base, base[:1]])
    if max_spacing:
        refinement = replace(refinement, max_spacing=max_spacing)
    tangents = (start_tangent, end_tangent)
    parameters = chord_length(base)
    through = interpolate(parameters, base, closed, tangents)
    first = Fit(through, parameters, base)
    if refinement != NO_RULES:
        parameters = refined_parameters(name, first, refinement, target)
        control = through.evaluate(parameters)[0]
        if closed:
            control[-1] = control[0]
        first = Fit(through, parameters, control)
    moved = np.zeros(len(given))
    if target is None:
        final = replace(first, curve=interpolate(parameters, first.control, closed, tangents))
    else:
        moved = np.linalg.norm(target.closest(given).points - given, axis=1)
        final, off = pulled(name, first, target, tolerance, closed, tangents)
        _check_collapse(name, final.control)
        # Points on the surface are as good as points on its offset: both say what is meant.
        astray = (
            moved
            if not distance
            else np.minimum(moved, np.linalg.norm(surface.closest(given).points - given, axis=1))
        )
        findings += [*off, *moved_findings(name, given, numbers, astray, tolerance)]
    position = arc_length_position(final.curve, closed)
    findings += _merged_findings(name, position, ring, numbers, merged)
    findings += checked_shape(name, position, closed)
    return Axis(
        name,
        final.curve,
        position,
        given,
        moved,
        final.control,
        tuple(findings),
        closed,
        distance,
        through,
    )


def _merged_findings(name: str, position: Piecewise, points, numbers, merged) -> list[Finding]:
    """One finding per point left out, with how far the axis passes it by."""
    line = position(np.linspace(position.start, position.end, 4001))
    findings = []
    for index in merged:
        away = float(np.linalg.norm(line - points[index], axis=1).min())
        moved = away > tolerances.POINT_MOVED_WARNING
        findings.append(
            (warning if moved else note)(
                "axis-point-merged",
                name,
                "point is closer to its neighbour than 0.15 of the mean gap and was left out",
                "delete it, or move its neighbours closer to it",
                position=f"point {numbers[index]}",
                value=away,
                limit=tolerances.POINT_MOVED_WARNING,
                unit="mm",
            )
        )
    return findings


def _check_collapse(name: str, control: np.ndarray) -> None:
    """Raises BendTorsionError where points pulled onto the surface fall on one place."""
    gaps = np.linalg.norm(np.diff(control, axis=0), axis=1)
    if gaps.min() < tolerances.POINTS_COINCIDE:
        at = control[int(np.argmin(gaps))]
        raise BendTorsionError(
            error(
                "axis-along-normal",
                name,
                "points pulled onto the surface fall on one place: the axis runs along the normal",
                "turn the axis, use fit = keep, or choose another surface",
                position=f"x, y, z = {at[0]:.0f}, {at[1]:.0f}, {at[2]:.0f} mm",
                value=float(gaps.min()),
                limit=tolerances.POINTS_COINCIDE,
                unit="mm",
            )
        )


def fit_uncertainty(
    name: str,
    points: np.ndarray,
    surface: Surface | None = None,
    fit: str = "pull",
    tolerance: float = tolerances.AXIS_ON_SURFACE,
    closed: bool = False,
    offset: float | None = None,
) -> np.ndarray:
    """What the points cannot tell: distance (k,) mm of each from the axis that leaves it out.

    Two fits, each through the ends and every other point. 0 at the ends and where fewer than
    five points leave nothing to compare. The fit through all points is some ten times nearer to
    the curve meant, where that is smooth.
    """
    given = np.array(points, float).reshape(-1, 3)
    ring = given[:-1] if closed and _meets(given) else given
    count = len(ring)
    out = np.zeros(len(given))
    if count < 5:
        return out
    target, _ = _target(name, ring, surface, fit, offset, [])
    for start in (0, 1):
        used = np.zeros(count, bool)
        used[start::2] = True
        if not closed:
            used[[0, -1]] = True
        base = np.vstack([ring[used], ring[used][:1]]) if closed else ring[used]
        parameters = chord_length(base)
        through = Fit(interpolate(parameters, base, closed), parameters, base)
        left = ring[~used]
        if target is not None:
            through, _ = pulled(name, through, target, tolerance, closed)
            left = target.closest(left).points
        half = Axis(
            name,
            through.curve,
            arc_length_position(through.curve, closed),
            base,
            np.zeros(len(base)),
            base,
        )
        nearest = half.position(half.place_of(left))
        out[np.flatnonzero(~used)] = np.linalg.norm(nearest - left, axis=1)
    return out


def axis_from_curve(
    name: str,
    curve: Curve,
    surface: Surface | None = None,
    findings: tuple[Finding, ...] = (),
    fit: str = "pull",
) -> Axis:
    """The axis that runs along an exact curve, used as it is.

    Closed when its ends meet without a kink. Raises BendTorsionError for a curve with kinks or that
    crosses itself, and for one far from the surface where fit is not `keep`.
    """
    closed, found = checked_curve(name, curve)
    found += curve_findings(name, curve, surface, fit)
    position = arc_length_position(curve, closed)
    ends = position(np.array([0.0, position.end]))
    found += checked_shape(name, position, closed)
    return Axis(
        name, curve, position, ends, np.zeros(2), ends, (*findings, *found), closed, through=curve
    )


def arc_length_position(curve: Curve, closed: bool = False) -> Piecewise:
    """Position by arc length: the curve's parameter is inverted by Newton at every node."""
    breaks = curve.breaks
    size = float(np.abs(curve.poles).max()) + 1.0
    arc = arc_length(curve)
    rate = arc.derivative
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

    found = resolve(position, knots_s, size)
    if closed:
        found.values[-1, -1] = found.values[0, 0]
    return found


def _meets(points: np.ndarray) -> bool:
    return bool(np.linalg.norm(points[-1] - points[0]) <= tolerances.POINTS_COINCIDE)


def _target(
    name: str,
    given: np.ndarray,
    surface: Surface | None,
    fit: str,
    offset: float | None,
    findings: list[Finding],
) -> tuple[Surface | None, float]:
    """What the points are pulled onto (None: nothing) and its distance from the surface."""
    if surface is None or fit == "keep":
        return None, 0.0
    if fit == "pull":
        return surface, 0.0
    if offset is None:
        offset = float(surface.closest(given).distance.mean())
        findings.append(
            note(
                "axis-offset-measured",
                name,
                "distance from the surface taken from the points",
                "give the offset to hold another one",
                value=offset,
                unit="mm",
            )
        )
    return Offset(surface, offset), offset
