# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plane and the outline of a diaphragm at a node.

Against walls a side is straight and keeps the gap over the whole thickness; other sides follow
the edges of the branch's plate, or keep clear of the diaphragms of its webs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.convex_polygon import bounded
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member
from ..members.strips import rails_between
from .node_branch import Branch
from .node_cut import FACING, landings
from .node_faces import OuterFaces

SAMPLES = np.linspace(0.0, 1.0, 9)
"""Of a side: where its distance from a wall is asked."""
_PASSES = 5
_NEAR = 0.6
"""Of the stretch the walls are known over: the farthest a corner of a diaphragm is from it."""
_SNIPED = 0.4
"""Of a side, at most, that a snipe takes at either end."""


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane with its frame: origin, x across the through member, y, and normal (3,)."""

    origin: np.ndarray
    x: np.ndarray
    y: np.ndarray

    @property
    def normal(self) -> np.ndarray:
        return crossed(self.x, self.y)

    @property
    def frame(self) -> np.ndarray:
        """(4, 4): plane -> model."""
        frame = np.eye(4)
        frame[:3, :3] = np.stack([self.x, self.y, self.normal], axis=1)
        frame[:3, 3] = self.origin
        return frame

    def at(self, plane: np.ndarray, height: float = 0.0) -> np.ndarray:
        """Points (n, 3) of points (n, 2) of the plane."""
        return self.origin + plane[:, :1] * self.x + plane[:, 1:] * self.y + height * self.normal

    def flat(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) below points (n, 3)."""
        away = points - self.origin
        return np.stack([(away * self.x).sum(axis=1), (away * self.y).sum(axis=1)], axis=1)

    def line_of(self, other: Plane) -> tuple[np.ndarray, np.ndarray, float] | None:
        """Where another plane cuts this one: a point (2,) of the line nearest to the origin, its
        unit normal (2,), and the sine of the angle of the planes; None of all but parallel ones."""
        normal = other.normal
        slope = np.array([(normal * self.x).sum(), (normal * self.y).sum()])
        size = float(np.sqrt((slope * slope).sum()))
        if size < FACING:
            return None
        off = float(((self.origin - other.origin) * normal).sum())
        return slope * (-off / size**2), slope / size, size


@dataclass(frozen=True, eq=False)
class Outline:
    """Corners (m, 2), counter-clockwise, and what the side from each lies on: a wall by index, the
    role of another diaphragm, or None."""

    corners: np.ndarray
    sides: tuple[int | str | None, ...]

    @property
    def walls(self) -> set[int]:
        return {side for side in self.sides if isinstance(side, int)}

    @property
    def closes(self) -> bool:
        """Whether it shuts the box: every side is at a wall."""
        return all(isinstance(side, int) for side in self.sides)


def landing_edges(other: Member, branch: Branch, index: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Per side the points (3, 3) where the mid-surface of a strip lands: first edge, middle,
    second edge, and the direction (3,) of the middle there, along the branch."""
    found = []
    for side in branch.sides:
        mid = rails_between(other, [(index, *side.about(other.length))])[0].mid
        one, two = mid.values[..., :3], mid.values[..., 3:]
        lines = Piecewise(mid.breaks, np.concatenate([one, 0.5 * (one + two), two], axis=2))
        s, points = landings(side.cut.main, lines, 0.5 * (side.low + side.high))
        along = lines.derivative(s[1:2])[0, 3:6]
        found.append((points, along / np.sqrt((along * along).sum())))
    return found


def plane_of(edges: Sequence[tuple[np.ndarray, np.ndarray]], branch: Branch) -> Plane:
    """The plane through the landings, x from the one of way -1 to that of +1. A branch with one
    side: square to the face it lands on; on an arris in the plane of its own plate."""
    points, along = edges[0]
    if len(edges) == 2:
        x = edges[1][0][1] - points[1]
        across = sum(own[2] - own[0] for own, _ in edges)
        origin = 0.5 * (points[1] + edges[1][0][1])
    else:
        (side,) = branch.sides
        across, origin = points[2] - points[0], points[1]
        if side.on_arris:
            x = -side.way * along
            across = across - (across * x).sum() * x
        else:
            cut = side.cut.main
            # Into the through member, square to the ruling.
            x = -side.way * cut.planes[int(cut.part_at(points[1:2])[0])][1]
    y = across / np.sqrt((across * across).sum())
    x = x - (x * y).sum() * y
    return Plane(origin, x / np.sqrt((x * x).sum()), y)


def edge_lines(plane: Plane, edges: Sequence[tuple[np.ndarray, np.ndarray]]) -> list[np.ndarray]:
    """The lines (2, 2) of a plate's first and second edge across the through member, along +x."""
    ends = [plane.flat(points) for points, _ in edges]
    if len(ends) == 2:
        return [np.stack([ends[0][k], ends[1][k]]) for k in (0, 2)]
    return [np.stack([ends[0][k], ends[0][k] + [1.0, 0.0]]) for k in (0, 2)]


def clear_of(plane: Plane, web: Plane, clear: float) -> np.ndarray | None:
    """The line (2, 2), along +x, that keeps `clear` from the plane of a web, on the side of the
    plane's own origin; None of planes that all but run along each other."""
    found = plane.line_of(web)
    if found is None:
        return None
    point, normal, sine = found
    side = -np.sign(float((point * normal).sum()))
    point = point + normal * (side * clear / sine)
    along = np.array([-normal[1], normal[0]])
    return np.stack([point, point + along * np.sign(along[0])])


def fitted(
    plane: Plane,
    faces: OuterFaces,
    depths: Mapping[int, float],
    free: Sequence[tuple[str | None, np.ndarray]],
    thickness: float,
) -> Outline | None:
    """The outline within the walls that the plane meets, at these depths (mm) behind their outer
    faces, and to the left of free lines; None without room."""
    lines: list[tuple[int | str | None, np.ndarray]] = list(free)
    for wall, depth in depths.items():
        line = _wall_line(plane, faces, wall, depth)
        if line is not None:
            lines.append((wall, line))
    # A plane that runs along the box is bounded far away, where the faces are not known.
    reach = _NEAR * (faces.corners.end - faces.corners.start)
    for _ in range(_PASSES):
        ring = bounded([line for _, line in lines])
        if ring is None or np.abs(ring[0]).max() > reach:
            return None
        corners, made = ring
        for k, which in enumerate(made):
            name = lines[which][0]
            if isinstance(name, int):
                ends = corners[k], corners[(k + 1) % len(corners)]
                line = _keeping_clear(plane, faces, name, depths[name], ends, thickness)
                lines[which] = name, line
    ring = bounded([line for _, line in lines])
    if ring is None:
        return None
    corners, made = ring
    sides = tuple(lines[which][0] for which in made)
    # The side behind (−x) comes first.
    first = [
        -float((faces.distance(side, plane.origin[None])[1][0] * plane.x).sum())
        if isinstance(side, int)
        else -2.0
        for side in sides
    ]
    start = first.index(max(first))
    return Outline(np.roll(corners, -start, axis=0), (*sides[start:], *sides[:start]))


def _wall_line(plane: Plane, faces: OuterFaces, wall: int, depth: float) -> np.ndarray | None:
    """The line (2, 2) in the plane at a depth behind a wall's plane, as it is near the origin, the
    wall on its right; None where they all but run along each other."""
    value, normal = faces.distance(wall, plane.origin[None])
    outward = np.array([(normal[0] * plane.x).sum(), (normal[0] * plane.y).sum()])
    size = np.sqrt((outward * outward).sum())
    if size < FACING:
        return None
    away = outward / size
    point = away * (-(value[0] + depth) / size)
    return np.stack([point, point + [-away[1], away[0]]])


def _keeping_clear(plane, faces, wall, depth, ends, thickness) -> np.ndarray:
    """The line (2, 2) along a wall between two points that keeps the depth behind its outer face
    at both sides of the diaphragm."""
    a, b = ends
    along = (b - a) / np.sqrt(((b - a) ** 2).sum())
    outwards = np.array([along[1], -along[0]])
    points = a + SAMPLES[:, None] * (b - a)
    room = np.full(len(SAMPLES), np.inf)
    for height in (-0.5 * thickness, 0.0, 0.5 * thickness):
        value, normal = faces.distance(wall, plane.at(points, height))
        slope = (normal * (outwards[0] * plane.x + outwards[1] * plane.y)).sum(axis=1)
        room = np.minimum(room, -(value + depth) / slope)
    tilt = (room[-1] - room[0]) * SAMPLES + room[0]
    shift = float((room - tilt).min())
    return np.stack([a + (room[0] + shift) * outwards, b + (room[-1] + shift) * outwards])


def room_beside(plane: Plane, faces: OuterFaces, outline: Outline, thickness: float) -> float:
    """Least distance, mm, from a diaphragm to the inner face of a wall it is not welded to."""
    least = np.inf
    corners = outline.corners
    points = np.concatenate([plane.at(corners, h) for h in (-0.5 * thickness, 0.5 * thickness)])
    for wall, depth in enumerate(faces.walls):
        if wall not in outline.walls:
            value, _ = faces.distance(wall, points)
            least = min(least, float((-value - depth).min()))
    return least


def slant(plane: Plane, faces: OuterFaces, outline: Outline) -> tuple[float, str]:
    """The least sine of the angle between a diaphragm and a wall it is welded to, and which."""
    middle = plane.at(outline.corners.mean(axis=0)[None])
    found = []
    for wall in sorted(outline.walls):
        normal = faces.distance(wall, middle)[1][0]
        inclined = float((normal * plane.normal).sum())
        found.append((np.sqrt(max(1.0 - inclined * inclined, 0.0)), faces.names[wall]))
    return min(found, default=(1.0, ""))


def sniped(outline: Outline, snipe: float) -> tuple[np.ndarray, tuple[int, ...]]:
    """The contour (m, 3), corners between two walls cut off by legs of `snipe`, and the vertex each
    side of the outline begins at."""
    ring, points, starts = outline.corners, [], []
    for k in range(len(ring)):
        legs = ring[k - 1] - ring[k], ring[(k + 1) % len(ring)] - ring[k]
        both = isinstance(outline.sides[k], int) and isinstance(outline.sides[k - 1], int)
        if snipe > 0.0 and both:
            for leg in legs:
                size = float(np.sqrt((leg * leg).sum()))
                points.append(ring[k] + leg * (min(snipe, _SNIPED * size) / size))
        else:
            points.append(ring[k])
        starts.append(len(points) - 1)
    return np.column_stack([points, np.zeros(len(points))]), tuple(starts)
