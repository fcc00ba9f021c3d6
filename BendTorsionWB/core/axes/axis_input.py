# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an axis is made from, and the way from there to the finished axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, note
from ..geometry.curve import Curve
from ..geometry.curve_edit import polyline_vertices
from ..geometry.surface import Surface
from .axis import Axis, Refinement, axis_from_curve, fit_axis, fit_uncertainty
from .axis_ends import AxisEnd, with_ends
from .axis_iso import IsoCurve
from .axis_order import chain_points, chain_segments, rule_turns
from .axis_preset import Preset, with_preset
from .axis_rule import Geodesic, PlaneSection, curve_by_rule

ORDERS = ("given", "nearest")
DIRECTIONS = ("given", "rule")
SHARPEST_VERTEX = np.radians(45.0)
"""A polyline that turns by more at a vertex is no row of points on a smooth curve."""


@dataclass(frozen=True, eq=False)
class AxisInput:
    """What an axis is made from: one of points, segments, curve or rule, and how.

    points (k, 3) mm, in order (`order` given) or loose (nearest: shortest nearest-neighbour
    chain); segments: polylines (m, 3), shuffled and turned at will, chained by their ends;
    curve: exact, used as it is; rule: PlaneSection, IsoCurve or Geodesic on the surface.
    fit: `pull`, `keep` or `offset` (`offset` mm from the surface along its normals; None: the
    points' mean distance). refinement: rules for more control points. tangents at the ends, any
    length. direction: `given`, or `rule` (low end to high, else −x to +x, else −y to +y; closed
    counter-clockwise from above); `reversed` turns the result, point numbers stay. ends: heights
    and extensions, of the directed axis. preset: displacements that make the fabrication axis.
    """

    name: str
    points: np.ndarray | None = None
    curve: Curve | None = None
    fit: str = "pull"
    tolerance: float = tolerances.AXIS_ON_SURFACE
    max_spacing: float | None = None
    segments: tuple[np.ndarray, ...] | None = None
    rule: PlaneSection | IsoCurve | Geodesic | None = None
    order: str = "given"
    closed: bool = False
    direction: str = "given"
    reversed: bool = False
    offset: float | None = None
    refinement: Refinement = Refinement()
    start_tangent: tuple[float, float, float] | None = None
    end_tangent: tuple[float, float, float] | None = None
    start: AxisEnd = AxisEnd()
    end: AxisEnd = AxisEnd()
    preset: Preset | None = None


@dataclass(frozen=True, eq=False)
class AxisUncertainty:
    """What the given points cannot tell: distance (k,) mm of every given point from the axis
    fitted through every other point; 0 at points that both such fits need."""

    distance: np.ndarray

    @property
    def largest(self) -> float:
        """Largest distance, mm."""
        return float(self.distance.max(initial=0.0))

    @property
    def rms(self) -> float:
        """Root mean square of the distances that are not 0 by construction, mm."""
        inner = self.distance[self.distance > 0]
        return float(np.sqrt(np.mean(inner**2))) if len(inner) else 0.0


@dataclass(frozen=True, eq=False)
class OrderedPoints:
    """Points (k, 3) in order, what findings call them (k,), whether they close, and what was
    found while they were put in order."""

    points: np.ndarray
    numbers: np.ndarray
    closed: bool
    findings: tuple[Finding, ...] = ()


def axis_from(given: AxisInput, surface: Surface | None) -> Axis:
    """The finished axis; raises BendTorsionError for input no axis can be made from."""
    row = ordered_points(given)
    if row is not None:
        axis = fit_axis(
            given.name,
            row.points,
            surface,
            given.fit,
            given.tolerance,
            given.max_spacing,
            closed=row.closed,
            offset=given.offset,
            refinement=given.refinement,
            start_tangent=given.start_tangent,
            end_tangent=given.end_tangent,
            numbers=row.numbers,
        ).with_findings(row.findings)
    elif given.curve is not None:
        _check_exact(given)
        axis = axis_from_curve(given.name, given.curve, surface, fit=given.fit)
    else:
        _check_exact(given)
        axis = axis_from_curve(given.name, *curve_by_rule(given.name, given.rule, surface))
    if (given.direction == "rule" and rule_turns(axis)) != given.reversed:
        axis = axis.turned()
    axis = with_ends(axis, given.start, given.end, surface if given.fit != "keep" else None)
    return axis if given.preset is None else with_preset(axis, given.preset)


def _check_exact(given: AxisInput) -> None:
    """Raises BendTorsionError where a curve used as it is is asked to be another."""
    if given.fit == "offset":
        raise BendTorsionError(
            error(
                "axis-exact-curve",
                given.name,
                "a curve is used as it is: it cannot be held at a distance from the surface",
                "give points, or choose a surface at that offset",
                value="fit = offset",
            )
        )


def ordered_points(given: AxisInput) -> OrderedPoints | None:
    """The points the axis is fitted to; None where it runs along an exact curve or a rule.

    A polyline given as a curve counts as its vertices, unless it turns too sharply for that.
    """
    if given.segments is not None:
        chain = chain_segments(given.name, given.segments)
        numbers = np.arange(1, len(chain.points) + 1)
        return OrderedPoints(chain.points, numbers, given.closed or chain.closed, chain.findings)
    if given.points is not None and given.order == "nearest":
        chain = chain_points(given.name, given.points, given.closed)
        return OrderedPoints(chain.points, chain.order + 1, given.closed, chain.findings)
    if given.points is not None:
        points = np.asarray(given.points, float).reshape(-1, 3)
        return OrderedPoints(points, np.arange(1, len(points) + 1), given.closed)
    vertices = None if given.curve is None else polyline_vertices(given.curve, SHARPEST_VERTEX)
    if vertices is None:
        return None
    closed = given.closed or bool(
        np.linalg.norm(vertices[-1] - vertices[0]) <= tolerances.POINTS_COINCIDE
    )
    repair = note(
        "axis-polyline",
        given.name,
        "the curve is a polyline: the axis is a smooth curve through its vertices",
        value=len(vertices),
    )
    return OrderedPoints(vertices, np.arange(1, len(vertices) + 1), closed, (repair,))


def axis_uncertainty(given: AxisInput, surface: Surface | None) -> AxisUncertainty:
    """What the given points leave open; nothing for exact curves and rules."""
    row = ordered_points(given)
    if row is None:
        return AxisUncertainty(np.zeros(0))
    return AxisUncertainty(
        fit_uncertainty(
            given.name, row.points, surface, given.fit, given.tolerance, row.closed, given.offset
        )
    )
