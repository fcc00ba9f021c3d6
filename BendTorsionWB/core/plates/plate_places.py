# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places (s, w) on the ruled surfaces of a plate, and the openings and marks kept by them: found
along given directions, nearest, and back from the flat pattern.

s: arc length on the axis; w: 0 on the first edge … 1 on the second.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..flattening.development import Development
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed

OVERRUN = 5.0
"""mm; places are looked for up to this far beyond the ends of a plate, then called outside."""
ACCURACY = 1e-7
"""mm; a place is found when it is this near to what was asked for."""
_STEPS = 40
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Spot:
    """A place of a plate with its tangent frame: x towards +s, y along the ruling towards the
    second edge, normal x × y; point and directions (3,)."""

    s: float
    w: float
    point: np.ndarray
    x: np.ndarray
    y: np.ndarray

    @property
    def normal(self) -> np.ndarray:
        return crossed(self.x, self.y)


@dataclass(frozen=True, eq=False)
class PlateOpening:
    """An opening of a plate as cut.

    spot: its middle on the mid-surface, with the tangent frame. contour (m, 3): in that frame.
    runs: its sides as (k, 2) places s, w on the mid-surface. nodes (n, 2), weights (n,): places
    s, w inside and the area they stand for across the spot's normal. reach: from below the inner
    to above the outer surface along the normal, mm. volume mm3, centre (3,): of the steel taken
    away. levels: runs and nodes one after the other (n, 2) as places s, w on each surface.
    """

    label: str
    title: str
    spot: Spot
    contour: np.ndarray
    runs: tuple[np.ndarray, ...]
    nodes: np.ndarray
    weights: np.ndarray
    reach: tuple[float, float]
    volume: float
    centre: np.ndarray
    levels: dict[str, np.ndarray] = field(default_factory=dict)

    def on(self, level: str) -> PlateOpening:
        """The opening with its runs and nodes on the surface `mid`, `outer` or `inner`."""
        ends = np.cumsum([*map(len, self.runs)])
        *runs, nodes = np.split(self.levels[level], ends)
        return replace(self, runs=tuple(runs), nodes=nodes)


@dataclass(frozen=True, eq=False)
class PlateMark:
    """A mark of a plate: places (k, 2) s, w on its mid-surface, below which it stands on the
    marking face. kind and text as of `lofting.FlatMark`."""

    kind: str
    text: str
    places: np.ndarray


def surface_point(rails: Piecewise, s: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Points (n, 3) of the surface at (s, w)."""
    value = rails(s)
    return value[:, :3] + np.asarray(w)[:, None] * (value[:, 3:] - value[:, :3])


def rates(rails: Piecewise, s: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """d/ds and d/dw (n, 3) of the surface at (s, w)."""
    value, slope = rails(s), rails.derivative(s)
    across = np.asarray(w)[:, None]
    return (
        slope[:, :3] + across * (slope[:, 3:] - slope[:, :3]),
        value[:, 3:] - value[:, :3],
    )


def spot_at(rails: Piecewise, s: float, w: float) -> Spot:
    """The place (s, w) with its frame."""
    at, across = np.array([s]), np.array([w])
    along, ruling = (part[0] for part in rates(rails, at, across))
    y = ruling / np.sqrt((ruling * ruling).sum())
    x = along - (along * y).sum() * y
    return Spot(
        float(s), float(w), surface_point(rails, at, across)[0], x / np.sqrt((x * x).sum()), y
    )


def places_along(
    rails: Piecewise,
    origin: np.ndarray,
    one: np.ndarray,
    two: np.ndarray,
    wanted: np.ndarray,
    start: tuple[np.ndarray, np.ndarray],
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """s, w (n,) where (S − origin)·one and (S − origin)·two are as wanted (n, 2), and whether
    each was found (n,); Newton from `start` s and w."""
    s, w = (np.array(np.broadcast_to(part, len(wanted)), float) for part in start)

    def missing():
        off = surface_point(rails, s, w) - origin
        return wanted - np.column_stack([(off * one).sum(axis=1), (off * two).sum(axis=1)])

    miss = missing()
    for _ in range(_STEPS):
        if np.abs(miss).max(initial=0.0) <= _ROUNDING:
            break
        by_s, by_w = rates(rails, s, w)
        step = _solved(
            (by_s * one).sum(axis=1),
            (by_w * one).sum(axis=1),
            (by_s * two).sum(axis=1),
            (by_w * two).sum(axis=1),
            miss,
        )
        s, w = _bounded(rails, s + step[0], w + step[1])
        miss = missing()
    return s, w, np.abs(miss).max(axis=1) <= ACCURACY


def nearest_places(
    rails: Piecewise, points: np.ndarray, start: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """s, w (n,) of the feet of the normals from points (n, 3), near to the surface, on it."""
    s, w = (np.array(np.broadcast_to(part, len(points)), float) for part in start)
    for _ in range(_STEPS):
        off = points - surface_point(rails, s, w)
        by_s, by_w = rates(rails, s, w)
        mixed = (by_s * by_w).sum(axis=1)
        step = _solved(
            (by_s * by_s).sum(axis=1),
            mixed,
            mixed,
            (by_w * by_w).sum(axis=1),
            np.column_stack([(off * by_s).sum(axis=1), (off * by_w).sum(axis=1)]),
        )
        s, w = _bounded(rails, s + step[0], w + step[1])
        if np.abs(step[0]).max(initial=0.0) <= _ROUNDING:
            break
    return s, w


def places_in_pattern(development: Development, plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """s, w (n,) of points (n, 2) of the development's plane: the inverse of `Development.flat`."""
    rails = development.surface
    grid_s = np.repeat(np.linspace(rails.start, rails.end, 65), 5)
    grid_w = np.tile(np.linspace(0.0, 1.0, 5), 65)
    grid = development.flat(grid_s, grid_w)
    near = np.argmin(((plane[:, None] - grid[None]) ** 2).sum(axis=2), axis=1)
    s, w = grid_s[near], grid_w[near]
    for _ in range(_STEPS):
        miss = plane - development.flat(s, w)
        if np.abs(miss).max(initial=0.0) <= _ROUNDING:
            break
        by_s, by_w = development.jacobian(s, w)
        step = _solved(by_s[:, 0], by_w[:, 0], by_s[:, 1], by_w[:, 1], miss)
        s, w = _bounded(rails, s + step[0], w + step[1])
    return s, w


def _solved(a, b, c, d, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    determinant = a * d - b * c
    return (
        (d * right[:, 0] - b * right[:, 1]) / determinant,
        (a * right[:, 1] - c * right[:, 0]) / determinant,
    )


def _bounded(rails: Piecewise, s: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    # Far beyond its range the interpolant means nothing.
    return (
        np.minimum(np.maximum(s, rails.start - OVERRUN), rails.end + OVERRUN),
        np.minimum(np.maximum(w, -1.0), 2.0),
    )
