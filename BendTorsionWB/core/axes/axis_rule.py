# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes by rule: plane sections, iso-curves and geodesics of a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from ..finding import BendTorsionError, Finding, error, warning
from ..geometry.curve import Curve
from ..geometry.curve_edit import curve_through
from ..geometry.surface import Surface
from .axis_check import place
from .axis_iso import IsoCurve, iso_curve

RULE_TOLERANCE = 1e-6
"""mm: curves by rule are followed to this."""
ON_PLANE = 1000.0
"""mm: given ends farther from the plane or the surface are a slip."""

_LARGEST_TURN = np.radians(4.0)
_MOST_STEPS = 5000


@dataclass(frozen=True)
class PlaneSection:
    """The curve in which the plane through `origin`, normal `normal`, cuts the surface, from the
    point nearest `start` to the one nearest `end` (both (x, y, z) mm). The curve leaves the start
    towards the end. closed: the whole ring through `start`, counter-clockwise about `normal`
    where that is seen from outside; `end` is then not used."""

    origin: tuple[float, float, float]
    normal: tuple[float, float, float]
    start: tuple[float, float, float]
    end: tuple[float, float, float] | None = None
    closed: bool = False


@dataclass(frozen=True)
class Geodesic:
    """The geodesic of the surface between the points nearest `start` and `end`, the one that is
    found from the straight chord."""

    start: tuple[float, float, float]
    end: tuple[float, float, float]


def curve_by_rule(
    name: str, rule: PlaneSection | IsoCurve | Geodesic, surface: Surface | None
) -> tuple[Curve, Surface | None, tuple[Finding, ...]]:
    """The curve of a rule, the surface, and findings; raises BendTorsionError where the rule
    gives no curve."""
    if surface is None:
        raise BendTorsionError(
            error("axis-rule-surface", name, "an axis by rule needs a surface", "name a surface")
        )
    if isinstance(rule, IsoCurve):
        return iso_curve(name, rule, surface), surface, ()
    make = plane_section if isinstance(rule, PlaneSection) else geodesic
    curve, miss = make(name, rule, surface)
    if miss <= RULE_TOLERANCE:
        return curve, surface, ()
    return (
        curve,
        surface,
        (
            warning(
                "axis-rule-tolerance",
                name,
                "the curve is followed less closely than asked",
                "split the axis at the creases of the surface",
                value=miss,
                limit=RULE_TOLERANCE,
                unit="mm",
            ),
        ),
    )


def plane_section(name: str, rule: PlaneSection, surface: Surface) -> tuple[Curve, float]:
    """Curve where a plane cuts the surface, and how closely it is followed, mm.

    Traced by predictor and corrector (Newton on the signed distance, within the plane), then
    followed by a spline through corrected points.
    """
    origin, axis = np.asarray(rule.origin, float), np.asarray(rule.normal, float)
    size = np.linalg.norm(axis)
    if not (np.isfinite(origin).all() and np.isfinite(size)) or size == 0:
        raise BendTorsionError(
            error("axis-rule-plane", name, "the plane has no normal", "give a normal that is not 0")
        )
    axis = axis / size

    def corrected(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points on both plane and surface, and the unit direction of the section there."""
        points = points - ((points - origin) @ axis)[:, None] * axis
        for _ in range(30):
            foot = surface.closest(points)
            flat = foot.normals - (foot.normals @ axis)[:, None] * axis
            squared = (flat**2).sum(axis=1)
            if (squared < 1e-6).any():
                bad = int(np.argmin(squared))
                raise BendTorsionError(
                    error(
                        "axis-rule-tangent",
                        name,
                        "the plane touches the surface there",
                        "tilt or move the plane",
                        position=place(points[bad]),
                    )
                )
            points = points - (foot.distance / squared)[:, None] * flat
            if np.abs(foot.distance).max() < 1e-9:
                break
        foot = surface.closest(points)
        if (np.abs(foot.distance) > 1e-5).any() or foot.outside.any():
            bad = int(np.argmax(np.maximum(np.abs(foot.distance), 1e9 * foot.outside)))
            raise BendTorsionError(
                error(
                    "axis-rule-leaves",
                    name,
                    "the section leaves the surface",
                    "choose ends inside the surface's border",
                    position=place(points[bad]),
                )
            )
        along = np.cross(axis, foot.normals)
        return points, along / np.linalg.norm(along, axis=1, keepdims=True)

    start = _given(name, rule.start, "start", corrected)
    end = start if rule.closed else _given(name, rule.end, "end", corrected)
    trace = _traced(name, corrected, start, end, rule.closed)
    parameters = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(trace, axis=0), axis=1))])
    # The points on the spline of the trace are corrected across it: smooth in the parameter.
    if rule.closed:
        guide = make_interp_spline(parameters, trace, k=5, bc_type="periodic")
    else:
        guide = make_interp_spline(parameters, trace, k=min(5, len(trace) - 1))
    breaks = parameters[:: max(1, len(parameters) // 12)]
    breaks = np.append(breaks[breaks < 0.98 * parameters[-1]], parameters[-1])
    return curve_through(lambda u: corrected(guide(u))[0], breaks, RULE_TOLERANCE)


def _given(name, point, which, corrected) -> np.ndarray:
    point = np.asarray(point if point is not None else np.full(3, np.nan), float)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise BendTorsionError(
            error(
                "axis-rule-end",
                name,
                f"the {which} is no point",
                "give x, y, z in mm",
                position=which,
            )
        )
    found = corrected(point[None])[0][0]
    away = float(np.linalg.norm(found - point))
    if away > ON_PLANE:
        raise BendTorsionError(
            error(
                "axis-rule-end",
                name,
                f"the {which} is far from the curve",
                "give a point near the plane and the surface",
                position=which,
                value=away,
                limit=ON_PLANE,
                unit="mm",
            )
        )
    return found


def _traced(name, corrected, start, end, closed) -> np.ndarray:
    """Points from start to end along the section; both ways at once when open, the first to
    arrive is taken."""
    point, direction = corrected(start[None])
    # Scale of the first step: where the direction has turned by the largest turn.
    step = 100.0
    for _ in range(40):
        _, ahead = corrected(point + step * direction)
        turn = np.arccos(np.clip((ahead @ direction[0])[0], -1, 1))
        if turn > 0.5 * _LARGEST_TURN or step > 2000.0:
            break
        step *= 1.5
    ways = [1.0] if closed else [1.0, -1.0]
    runs = {way: [start] for way in ways}
    heads = {way: (start, way * direction[0], step) for way in ways}
    for _ in range(_MOST_STEPS):
        for way in list(heads):
            at, along, step = heads[way]
            gap = end - at
            # The end is reached when it lies ahead, within a step.
            near = np.linalg.norm(gap) <= 1.5 * step and gap @ along > 0
            if near and len(runs[way]) > (4 if closed else 0):
                return np.array([*runs[way], end])
            try:
                new, ahead, step = _stepped(corrected, at, along, step, way)
            except BendTorsionError:
                if len(heads) == 1:
                    raise
                del heads[way]
                continue
            if (
                not closed
                and len(runs[way]) > 8
                and (np.linalg.norm(start - new) <= step and (start - new) @ ahead > 0)
            ):
                raise BendTorsionError(
                    error(
                        "axis-rule-end",
                        name,
                        "start and end lie on different branches",
                        "choose ends on one branch of the section",
                        position=place(end),
                    )
                )
            runs[way].append(new)
            heads[way] = new, ahead, step
    raise BendTorsionError(
        error(
            "axis-rule-end",
            name,
            "the section does not lead from the start to the end",
            "choose ends on one branch of the section",
            position=place(end),
        )
    )


def _stepped(corrected, at, along, step, way):
    for _ in range(30):
        new, ahead = corrected((at + step * along)[None])
        ahead = way * ahead[0]
        turn = float(np.arccos(np.clip(ahead @ along, -1, 1)))
        if turn <= _LARGEST_TURN:
            break
        step *= 0.5
    return new[0], ahead, min(step * (1.5 if turn < 0.4 * _LARGEST_TURN else 1.0), 2000.0)


def geodesic(name: str, rule: Geodesic, surface: Surface) -> tuple[Curve, float]:
    """Geodesic between two points, and how closely it is followed, mm.

    Collocation at Chebyshev points: the second derivative has no part in the surface, which also
    makes the speed even. Newton moves the points in their tangent planes and brings them back
    onto the surface; the number of points is doubled until the curve stays.
    """
    ends = np.array([rule.start, rule.end], float)
    if not np.isfinite(ends).all():
        raise BendTorsionError(
            error("axis-rule-end", name, "an end is no point", "give x, y, z in mm")
        )
    foot = surface.closest(ends)
    away = np.linalg.norm(foot.points - ends, axis=1)
    if away.max() > ON_PLANE or foot.ambiguous.any():
        which = ("start", "end")[int(np.argmax(away))]
        raise BendTorsionError(
            error(
                "axis-rule-end",
                name,
                f"the {which} is far from the surface",
                "give a point near the surface",
                position=which,
                value=float(away.max()),
                limit=ON_PLANE,
                unit="mm",
            )
        )
    ends = foot.points
    chord = float(np.linalg.norm(ends[1] - ends[0]))
    if chord < 1.0:
        raise BendTorsionError(
            error(
                "axis-rule-end",
                name,
                "start and end are one point",
                "move one of them",
                value=chord,
                unit="mm",
            )
        )
    count, before = 12, None
    points = ends[0] + np.linspace(0, 1, count + 1)[:, None] * (ends[1] - ends[0])
    points = points[0] + (0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count))[:, None] * (
        points[-1] - points[0]
    )
    miss = np.inf
    while count <= 192:
        points = _relaxed(name, surface, points, ends)
        finer = _chebyshev_values(points, 2 * count)
        if before is not None:
            miss = float(np.linalg.norm(points - before, axis=1).max())
            if miss <= 0.1 * RULE_TOLERANCE:
                break
        before = finer
        points, count = finer, 2 * count
    found = points

    def on_surface(u: np.ndarray) -> np.ndarray:
        feet = surface.closest(_chebyshev_at(found, u / chord)).points
        feet[u <= 0], feet[u >= chord] = ends[0], ends[1]
        return feet

    curve, follow = curve_through(on_surface, np.linspace(0.0, chord, 9), RULE_TOLERANCE)
    return curve, max(miss, follow)


def _relaxed(name, surface, points, ends) -> np.ndarray:
    count = len(points) - 1
    second = _second_derivative(count)
    delta = 1e-4 * float(np.linalg.norm(ends[1] - ends[0]))
    for _ in range(40):
        foot = surface.closest(points)
        if foot.ambiguous[1:-1].any() or foot.outside.any():
            bad = int(np.argmax(foot.ambiguous | foot.outside))
            raise BendTorsionError(
                error(
                    "axis-rule-leaves",
                    name,
                    "the geodesic leaves the surface or meets a crease",
                    "choose nearer ends",
                    position=place(points[bad]),
                )
            )
        points = foot.points
        points[0], points[-1] = ends
        n = foot.normals
        e = np.cross(n, np.eye(3)[np.argmin(np.abs(n), axis=1)])
        e /= np.linalg.norm(e, axis=1, keepdims=True)
        basis = np.stack([e, np.cross(n, e)], axis=1)
        bend = second @ points
        inner = slice(1, count)
        force = np.einsum("iaj,ij->ia", basis[inner], bend[inner])
        turn = np.stack(
            [
                (
                    surface.closest(points + delta * basis[:, a]).normals
                    - surface.closest(points - delta * basis[:, a]).normals
                )
                / (2 * delta)
                for a in range(2)
            ],
            axis=2,
        )
        matrix = np.einsum("iaj,ik,kbj->iakb", basis[inner], second[inner, inner], basis[inner])
        pressure = (bend * n).sum(axis=1)
        local = np.einsum("iaj,ijb->iab", basis, turn) * pressure[:, None, None]
        index = np.arange(count - 1)
        matrix[index, :, index, :] -= local[inner]
        size = 2 * (count - 1)
        step = np.linalg.solve(matrix.reshape(size, size), -force.ravel()).reshape(-1, 2)
        move = np.einsum("ia,iaj->ij", step, basis[inner])
        largest = float(np.linalg.norm(move, axis=1).max())
        limit = 0.25 * float(np.linalg.norm(ends[1] - ends[0]))
        points[inner] += move * min(1.0, limit / largest if largest else 1.0)
        if largest < 1e-8:
            break
    else:
        raise BendTorsionError(
            error(
                "axis-rule-geodesic",
                name,
                "no geodesic was found from the chord",
                "choose nearer ends, or go by an intermediate point",
                value=largest,
                unit="mm",
            )
        )
    return surface.closest(points).points


def _second_derivative(count: int) -> np.ndarray:
    """d²/dx² on [0, 1] at the Chebyshev points (Berrut & Trefethen 2004)."""
    x = 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count)
    weights = np.where(np.arange(count + 1) % 2, -1.0, 1.0)
    weights[[0, -1]] *= 0.5
    difference = x[:, None] - x[None, :]
    np.fill_diagonal(difference, 1.0)
    first = (weights[None, :] / weights[:, None]) / difference
    np.fill_diagonal(first, 0.0)
    np.fill_diagonal(first, -first.sum(axis=1))
    return first @ first


def _chebyshev_at(values: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The polynomial with `values` (n + 1, 3) at the Chebyshev points of [0, 1], at x (m,)."""
    count = len(values) - 1
    nodes = 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count)
    weights = np.where(np.arange(count + 1) % 2, -1.0, 1.0)
    weights[[0, -1]] *= 0.5
    difference = x[:, None] - nodes
    hit = np.abs(difference) < 1e-15
    difference[hit] = 1.0
    basis = weights / difference
    basis /= basis.sum(axis=1, keepdims=True)
    rows = hit.any(axis=1)
    basis[rows] = hit[rows]
    return basis @ values


def _chebyshev_values(values: np.ndarray, count: int) -> np.ndarray:
    return _chebyshev_at(values, 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count))
