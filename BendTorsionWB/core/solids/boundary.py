# SPDX-License-Identifier: LGPL-2.1-or-later
"""The boundary of a solid as plain values, for exchange formats that take exact geometry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Line:
    """A straight edge through origin (3,) along direction (3,), of length one."""

    origin: np.ndarray
    direction: np.ndarray


@dataclass(frozen=True, eq=False)
class Circle:
    """A circular edge: centre (3,), axis and x direction (3,), radius mm."""

    centre: np.ndarray
    axis: np.ndarray
    x: np.ndarray
    radius: float


@dataclass(frozen=True, eq=False)
class Spline:
    """A B-spline edge: poles (n, 3), distinct knots (k,) with multiplicities (k,), weights (n,) or
    None. It begins and ends on the edge's vertices."""

    degree: int
    poles: np.ndarray
    knots: np.ndarray
    multiplicities: tuple[int, ...]
    weights: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane: origin, normal and x direction (3,)."""

    origin: np.ndarray
    normal: np.ndarray
    x: np.ndarray


@dataclass(frozen=True, eq=False)
class Cylinder:
    """A circular cylinder: origin, axis and x direction (3,), radius mm; normal outward."""

    origin: np.ndarray
    axis: np.ndarray
    x: np.ndarray
    radius: float


@dataclass(frozen=True, eq=False)
class SplineSurface:
    """A B-spline surface: poles (n, m, 3), knots and multiplicities of both directions, weights
    (n, m) or None."""

    degrees: tuple[int, int]
    poles: np.ndarray
    knots: tuple[np.ndarray, np.ndarray]
    multiplicities: tuple[tuple[int, ...], tuple[int, ...]]
    weights: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Edge:
    """An edge from vertex `start` to `end`; same_sense: the curve runs from start to end."""

    start: int
    end: int
    curve: Line | Circle | Spline
    same_sense: bool


@dataclass(frozen=True, eq=False)
class Face:
    """A face: same_sense when it looks to the side of its surface's normal; loops, the outer one
    first, each (edge, forward) in order, counter-clockwise about the face's own normal."""

    surface: Plane | Cylinder | SplineSurface
    same_sense: bool
    loops: tuple[tuple[tuple[int, bool], ...], ...]


@dataclass(frozen=True, eq=False)
class Boundary:
    """A closed shell: vertices (n, 3), edges and faces that look outwards."""

    vertices: np.ndarray
    edges: tuple[Edge, ...]
    faces: tuple[Face, ...]
