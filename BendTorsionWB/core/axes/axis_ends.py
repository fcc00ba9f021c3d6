# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends of an axis brought to a height, extended or trimmed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.optimize import brentq

from ..finding import BendTorsionError, error
from ..geometry.curve import Curve
from ..geometry.curve_edit import joined, parameters_at, piece, turned
from ..geometry.surface import Offset, Surface
from .axis import Axis, arc_length_position
from .axis_check import checked_shape

LONGEST_EXTENSION = 1.0
"""An end may be extended by this times the axis's length."""
SHORTEST_AXIS = 10.0
"""mm that must be left of an axis."""
_STEPS = 64
_SAME_HEIGHT = 1e-7


@dataclass(frozen=True)
class AxisEnd:
    """What is asked of one end: first its height (z mm absolute, or the present one; dz mm is
    added), reached by running on or cutting back along the axis; then `extension` mm along the
    axis, negative to trim."""

    z: float | None = None
    dz: float = 0.0
    extension: float = 0.0


def with_ends(axis: Axis, start: AxisEnd, end: AxisEnd, surface: Surface | None = None) -> Axis:
    """The axis between its new ends; s counts from the new start.

    Extensions keep tangent and geodesic curvature, at the end's distance from the surface when
    one is given, else tangent and curvature vector. Raises
    BendTorsionError for a closed axis, a height that is not reached within the axis's own length,
    and ends that meet.
    """
    if start == AxisEnd() and end == AxisEnd():
        return axis
    if axis.closed:
        raise BendTorsionError(
            error(
                "axis-end-closed",
                axis.name,
                "a closed axis has no ends to move",
                "clear the end heights and extensions",
            )
        )
    late = _growth(axis, end, surface, "end")
    mirrored = axis.turned()
    early = _growth(mirrored, start, surface, "start")
    left = axis.length + early[0] + late[0]
    if left < SHORTEST_AXIS:
        raise BendTorsionError(
            error(
                "axis-too-short",
                axis.name,
                "nothing is left of the axis between its ends",
                "trim less",
                value=left,
                limit=SHORTEST_AXIS,
                unit="mm",
            )
        )
    low, high = max(-early[0], 0.0), axis.length + min(late[0], 0.0)
    first, last = parameters_at(axis.curve, np.array([low, high]))
    body = axis.curve if (low, high) == (0.0, axis.length) else piece(axis.curve, first, last)
    before = [turned(early[1])] if early[0] > 0 else []
    after = [late[1]] if late[0] > 0 else []
    curve = joined([*before, body, *after]) if before or after else body
    position = arc_length_position(curve)
    findings = checked_shape(axis.name, position, False)
    inside = axis.place_of(axis.control)
    control = axis.control[(inside > low + 1e-6) & (inside < high - 1e-6)]
    ends = position(np.array([0.0, position.end]))
    return replace(
        axis,
        curve=curve,
        position=position,
        control=np.vstack([ends[:1], control, ends[1:]]),
        findings=(*axis.findings, *findings),
        trimmed=(axis.trimmed[0] + early[0], axis.trimmed[1] + late[0]),
    )


def _growth(
    axis: Axis, asked: AxisEnd, surface: Surface | None, which: str
) -> tuple[float, Curve | None]:
    """mm by which the far end grows (negative: trims), and the curve beyond it when it grows."""
    here = float(axis.position(np.array([axis.length]))[0, 2])
    growth, target = 0.0, (here if asked.z is None else asked.z) + asked.dz
    slope = float(axis.tangent(np.array([axis.length]))[0, 2])
    moves = abs(target - here) > _SAME_HEIGHT
    outwards = moves and (target - here) * slope > 0
    if outwards:
        growth = _first_at_height(extension(axis, _longest(axis), surface), target)
    elif moves:
        growth = _first_at_height(axis.turned().curve, target)
        growth = None if growth is None else -growth
    if growth is None:
        raise BendTorsionError(
            error(
                "axis-end-height",
                axis.name,
                f"the axis does not reach the height asked of its {which}",
                "choose a height the axis runs through",
                position=which,
                value=target,
                limit=here,
                unit="mm",
            )
        )
    whole = growth + asked.extension
    if whole > _longest(axis):
        raise BendTorsionError(
            error(
                "axis-extension",
                axis.name,
                f"the {which} is extended by more than the axis",
                "extend less, or give points there",
                position=which,
                value=whole,
                limit=_longest(axis),
                unit="mm",
            )
        )
    if not outwards:
        return whole, extension(axis, whole, surface) if whole > 0 else None
    # The height is found anew on the curve that is built: its steps are shorter.
    beyond = extension(axis, 1.05 * max(growth, whole), surface)
    whole = _first_at_height(beyond, target) + asked.extension
    if whole <= 0:
        return whole, None
    return whole, piece(beyond, beyond.domain[0], parameters_at(beyond, np.array([whole]))[0])


def _longest(axis: Axis) -> float:
    return LONGEST_EXTENSION * axis.length


def _first_at_height(curve: Curve, target: float) -> float | None:
    """The first arc length at which the curve has height `target`, None when it never has."""
    position = arc_length_position(curve)
    s = np.linspace(0.0, position.end, 1025)
    above = position(s)[:, 2] - target
    crossed = np.flatnonzero(above[:-1] * above[1:] <= 0)
    crossed = crossed[s[crossed + 1] > _SAME_HEIGHT]
    if not len(crossed):
        return None
    low, high = s[crossed[0]], s[crossed[0] + 1]
    return float(brentq(lambda at: position(np.array([at]))[0, 2] - target, low, high, xtol=1e-10))


def extension(axis: Axis, length: float, surface: Surface | None = None) -> Curve:
    """The curve of `length` mm that runs on from the end of the axis.

    On a surface: constant geodesic curvature, by central differences in which every point is
    brought onto the surface; without one: the end's osculating circle.
    """
    end = np.array([axis.length])
    point, tangent, bend = axis.position(end)[0], axis.tangent(end)[0], axis.curvature(end)[0]
    tangent = tangent / np.linalg.norm(tangent)
    bend = bend - (bend @ tangent) * tangent
    if surface is None:
        curve = _circle(point, tangent, bend, length)
    else:
        curve = _on_surface(point, tangent, bend, length, surface)
    # Cut to length: a chord-length parameter is shorter than the arc.
    last = parameters_at(curve, np.array([length]))[0]
    return piece(curve, curve.domain[0], last)


def _circle(point, tangent, bend, length) -> Curve:
    curvature = float(np.linalg.norm(bend))
    if curvature * length < 1e-12:
        return Curve(
            1, np.array([0.0, 0.0, length, length]), np.array([point, point + length * tangent])
        )
    # A full turn at most: beyond it the circle would run over itself.
    normal, radius = bend / curvature, 1.0 / curvature
    angle = np.linspace(0.0, min(1.01 * length * curvature, 2 * np.pi), _STEPS + 1)[:, None]
    points = point + radius * (np.sin(angle) * tangent + (1 - np.cos(angle)) * normal)
    return _smooth(angle[:, 0] * radius, points, tangent)


def _on_surface(point, tangent, bend, length, surface) -> Curve:
    # At the end's own distance from the surface: an exact curve may not lie in it.
    foot = surface.closest(point[None])
    away = float(foot.distance[0])
    surface = Offset(surface, away) if away else surface
    geodesic = float(bend @ np.cross(foot.normals[0], tangent))
    step = 1.01 * length / _STEPS
    points = [point]
    guess = point + step * tangent + 0.5 * step**2 * bend
    while len(points) <= _STEPS:
        foot = surface.closest(guess[None])
        points.append(foot.points[0])
        along = points[-1] - points[-2]
        across = np.cross(foot.normals[0], along / np.linalg.norm(along))
        guess = points[-1] + along + step**2 * geodesic * across
    return _smooth(step * np.arange(_STEPS + 1), np.array(points), tangent)


def _smooth(parameters: np.ndarray, points: np.ndarray, tangent: np.ndarray) -> Curve:
    """Cubic through points at about arc-length parameters that starts along `tangent`."""
    first, last = np.full(4, parameters[0]), np.full(4, parameters[-1])
    knots = np.concatenate([first, parameters[1:-2], last])
    spline = make_interp_spline(parameters, points, k=3, t=knots, bc_type=([(1, tangent)], None))
    return Curve(3, spline.t, spline.c)
