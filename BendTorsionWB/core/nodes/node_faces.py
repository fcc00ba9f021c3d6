# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signed distances to the outer faces of a closed member: what a branch's plates are cut by.

A face is ruled between two neighbouring corner lines. A point's foot on it is found by Newton on
the face itself, continued beyond its edges, so that the distance is smooth, its gradient is the
unit normal at the foot, and a gap measured by it is the true width of the weld gap.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member

NEWTON_STEPS = 30
STRAY = 1.2
"""Of how far a face leaves its plane: the margin within which the face itself is asked."""
FOOT = 1e-4
"""mm: steps of Newton below which a foot point is found: the next would be below 1e-8, and the
distance is off by the square of it over the radius of curvature."""
CONTINUED = 0.1
"""Of the end spans' lengths: how far beyond the ends their polynomials are trusted."""


@dataclass(frozen=True, eq=False)
class OuterFaces:
    """The outer faces of a closed member over a stretch: corners s -> (m * 3,) of its corner
    lines, as a ring; names (m,) of the faces from corner k to k + 1 and the thickness of their
    walls half way along, mm; outward (+1 or -1) turns R × P' of the ring outwards."""

    member: str
    corners: Piecewise
    names: tuple[str, ...]
    walls: tuple[float, ...]
    outward: float

    @cached_property
    def _edges(self) -> tuple[Piecewise, ...]:
        """Per face s -> (12,): first edge and ruling, then their rates."""
        parts = [self.corners.values, self.corners.derivative.values]
        count = len(self.names)
        edges = []
        for k in range(count):
            i, j = 3 * k, 3 * ((k + 1) % count)
            columns = [
                block
                for part in parts
                for block in (part[..., i : i + 3], part[..., j : j + 3] - part[..., i : i + 3])
            ]
            edges.append(Piecewise(self.corners.breaks, np.concatenate(columns, axis=2)))
        return tuple(edges)

    @cached_property
    def _middle(self) -> tuple[float, np.ndarray]:
        """The middle of the stretch, and each face's edge, ruling and their rates there (m, 12)."""
        s = 0.5 * (self.corners.start + self.corners.end)
        return s, np.concatenate([edge(np.array([s])) for edge in self._edges])

    def _continued(self, face: int, s: np.ndarray) -> np.ndarray:
        """Edge, ruling and their rates (n, 12) at s (n,): beyond the stretch on straight lines, a
        little after its ends, since the polynomials of the end spans leave the face soon."""
        breaks = self.corners.breaks
        before = breaks[0] - CONTINUED * (breaks[1] - breaks[0])
        after = breaks[-1] + CONTINUED * (breaks[-1] - breaks[-2])
        within = np.minimum(np.maximum(s, before), after)
        value = self._edges[face](within)
        value[:, :6] += (s - within)[:, None] * value[:, 6:]
        return value

    def foot(self, face: int, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """s and w (n,) of the feet of points (n, 3) on a face, w from its first edge (0) to its
        second (1)."""
        return self._feet(face, points)[:2]

    def distance(self, face: int, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distance (n,), mm, positive outside, of points (n, 3) to a face continued beyond
        its edges, and its gradient (n, 3), the outward unit normal."""
        _, _, at, normal = self._feet(face, points)
        return ((points - at) * normal).sum(axis=1), normal

    def _feet(self, face: int, points: np.ndarray) -> tuple[np.ndarray, ...]:
        """s, w (n,) of the feet, and points and outward normals (n, 3) of the face there.

        By Gauss's form of Newton's steps: what it leaves out, distance times curvature, is small
        about a member. Points and normals are those before the last step: the distance depends on
        its square only.
        """
        middle, at = self._middle
        first, ruling, rate, _ = np.split(at[face], 4)
        away = points - first
        s = middle + (away * rate).sum(axis=1) / (rate * rate).sum()
        w = (away * ruling).sum(axis=1) / (ruling * ruling).sum()
        reach = self.corners.end - self.corners.start
        s = np.minimum(np.maximum(s, middle - reach), middle + reach)
        for _ in range(NEWTON_STEPS):
            value = self._continued(face, s)
            ruling = value[:, 3:6]
            tangent = value[:, 6:9] + w[:, None] * value[:, 9:12]
            foot = value[:, :3] + w[:, None] * ruling
            away = foot - points
            g, h = (away * tangent).sum(axis=1), (away * ruling).sum(axis=1)
            a, c = (tangent * tangent).sum(axis=1), (ruling * ruling).sum(axis=1)
            b = (tangent * ruling).sum(axis=1)
            below = a * c - b * b
            ds = np.minimum(np.maximum((b * h - c * g) / below, -reach), reach)
            dw = (b * g - a * h) / below
            s, w = s + ds, w + dw
            if max(np.abs(ds).max(), (np.abs(dw) * np.sqrt(c)).max()) < FOOT:
                break
        return s, w, foot, crossed(ruling, tangent) * (self.outward / np.sqrt(below))[:, None]

    def at(self, face: int, s: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points and outward unit normals (n, 3) of a face at (s, w)."""
        first, ruling, first1, ruling1 = np.split(self._continued(face, s), 4, axis=1)
        normal = crossed(ruling, first1 + w[:, None] * ruling1) * self.outward
        normal /= np.sqrt((normal * normal).sum(axis=1))[:, None]
        return first + w[:, None] * ruling, normal

    def inside(self, points: np.ndarray, faces: Sequence[int] | None = None) -> np.ndarray:
        """The largest signed distance (n,) of points (n, 3) to the given faces (all of them when
        None): negative inside the member."""
        chosen = range(len(self.names)) if faces is None else faces
        return np.max([self.distance(k, points)[0] for k in chosen], axis=0)

    def plane(self, face: int, s: float) -> tuple[np.ndarray, np.ndarray, float]:
        """Point and outward normal (3,) of a face half way across at s, and how far, mm, the face
        leaves that plane over the stretch."""
        middle = np.array([0.5])
        point, normal = (part[0] for part in self.at(face, np.array([s]), middle))
        places = np.linspace(self.corners.start, self.corners.end, 25)
        s, w = (grid.ravel() for grid in np.meshgrid(places, (-0.5, 0.5, 1.5)))
        away = ((self.at(face, s, w)[0] - point) * normal).sum(axis=1)
        return point, normal, float(np.abs(away).max())

    def roughly_inside(self, points: np.ndarray, s: float) -> tuple[np.ndarray, float]:
        """`inside` by the planes of the faces at s, and how far that may be wrong near the
        member, mm."""
        planes = [self.plane(face, s) for face in range(len(self.names))]
        values = [((points - point) * normal).sum(axis=1) for point, normal, _ in planes]
        return np.max(values, axis=0), STRAY * max(away for *_, away in planes) + 1.0


def wall_thickness(member: Member, s: float) -> dict[str, float]:
    """Thickness, mm, of the plates of a member at s, by face."""
    thickness = member.law.cell_at(s).thickness
    return {strip.face: float(t) for strip, t in zip(member.law.strips, thickness, strict=True)}


def outer_faces(member: Member, start: float, end: float) -> OuterFaces:
    """The outer faces of a closed member from start to end on its axis; beyond its ends the faces
    are those of its end zones, continued."""
    low, high = max(start, 0.0), min(end, member.length)
    section = member.law.sections[0]
    count = len(section.corners)
    ring = np.array(section.corners)
    names = {frozenset((strip.first, strip.second)): strip.face for strip in section.strips}
    following = np.roll(ring, -1, axis=0)
    turn = (ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]).sum()
    ordered = tuple(names[frozenset((k, (k + 1) % count))] for k in range(count))
    thickness = wall_thickness(member, 0.5 * (start + end))
    return OuterFaces(
        member.name,
        member.corners(low, high),
        ordered,
        tuple(thickness[name] for name in ordered),
        1.0 if turn > 0 else -1.0,
    )
