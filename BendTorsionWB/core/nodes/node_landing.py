# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a branch lands: its sides, each with the cut that ends it and the faces it ends on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..members.member import Member
from .node_cut import NodeCut, NodeCuts, landings, node_cut, outer_lines
from .node_faces import OuterFaces, outer_faces
from .node_input import NodeInput


@dataclass(frozen=True, eq=False)
class Side:
    """One end of a branch at a node. way: +1 when the branch leaves the node along its +s, else
    -1. low, high: the least and greatest arc length its outer lines end at. seat: the stretch of
    the through member's axis it lands on, mm. faces: names of the faces landed on, with the
    member before those of other branches. on_arris: it lands on several faces of the through
    member."""

    way: int
    cut: NodeCut | NodeCuts
    low: float
    high: float
    seat: tuple[float, float]
    faces: tuple[str, ...]
    on_arris: bool = False

    def about(self, length: float) -> tuple[float, float]:
        """A stretch of its axis, of this length, that its cut lies well within, mm."""
        span = self.high - self.low + 100.0
        return max(self.low - span, 0.0), min(self.high + span, length)


@dataclass(frozen=True, eq=False)
class Landing:
    """A side; left (k,): mm of the branch beyond its cut along each of its outer lines; over: how
    far, mm, it stands over a face it lands on, at most, and which."""

    side: Side
    left: np.ndarray
    over: tuple[float, str]


def seat_of(sides: Sequence[Side]) -> tuple[float, float]:
    """The stretch of the through member's axis all of these sides land on, mm."""
    return min(side.seat[0] for side in sides), max(side.seat[1] for side in sides)


def reach(member: Member) -> float:
    """Largest distance of a corner from the axis, mm."""
    corners = [c.corners_at(np.array([c.start, c.end])) for c in member.law.cells]
    return float(np.linalg.norm(np.concatenate(corners), axis=2).max())


def crossing_angle(one: Member, other: Member, s: float, t: float) -> float:
    """Acute angle, rad, between two axes at s and t."""
    x = one.frames.axis.tangent(np.array([s]))[0]
    y = other.frames.axis.tangent(np.array([t]))[0]
    return math.atan2(float(np.linalg.norm(np.cross(x, y))), abs(float((x * y).sum())))


def landed(
    through: Member,
    other: Member,
    s: float,
    t: float,
    row: NodeInput,
    gap: float,
    against: tuple[tuple[int, NodeCut], ...] = (),
) -> tuple[Landing, ...]:
    """The one or two sides of the branch `other` at t that meets `through` at s. against: what its
    sides, by way, are cut by besides."""
    span = (reach(through) + reach(other)) / math.sin(crossing_angle(through, other, s, t)) + 500.0
    faces = outer_faces(through, s - span, s + span)
    lines = outer_lines(other, t - span, t + span)
    tangent = other.frames.axis.tangent(np.array([t]))[0]
    found = []
    for way in (-1, 1):
        cut = node_cut(row.name, faces, s, way * tangent, gap)
        more = [own for side, own in against if side == way]
        cut = NodeCuts((cut, *more)) if more else cut
        ends, points = landings(cut, lines, t)
        # What is left of the branch beyond its cut, at its longest and at its shortest line.
        left = ends if way < 0 else other.length - ends
        if left.max() > tolerances.SAME_STATION:
            side, over = _side(way, cut, ends, points)
            found.append(Landing(side, left, over))
    return tuple(found)


def _side(
    way: int, cut: NodeCut | NodeCuts, ends: np.ndarray, points: np.ndarray
) -> tuple[Side, tuple[float, str]]:
    """The side, and how far, mm, its lines stand over a face they land on, at most, and which."""
    on, parts = cut.part_at(points), cut.parts
    low, high, over = math.inf, -math.inf, (0.0, "")
    names, own = [], []
    for k in sorted(set(on.tolist())):
        part, (face,) = parts[k], parts[k].landing
        s, w = part.faces.foot(face, points[on == k])
        is_main = part.faces is cut.main.faces
        names.append(part.faces.names[face] if is_main else _of_member(part.faces, face))
        landing = [p.landing[0] for p in parts if p.faces is part.faces]
        over = max(over, (_overhang(part.faces, landing, face, s, w), _of_member(part.faces, face)))
        if is_main:
            low, high = min(low, float(s.min())), max(high, float(s.max()))
            own.append(face)
    side = Side(
        way,
        cut,
        float(ends.min()),
        float(ends.max()),
        (low, high),
        tuple(names),
        len(own) > 1,
    )
    return side, over


def _of_member(faces: OuterFaces, face: int) -> str:
    return f"{faces.member} {faces.names[face]}"


def _overhang(faces: OuterFaces, landing, face: int, s: np.ndarray, w: np.ndarray) -> float:
    """How far (s, w) lie beyond the edges of a face where no other landed face goes on, mm."""
    count = len(faces.names)
    one, _ = faces.at(face, s, np.zeros(len(s)))
    two, _ = faces.at(face, s, np.ones(len(s)))
    width = np.linalg.norm(two - one, axis=1)
    over = [0.0]
    if (face - 1) % count not in landing:
        over.append(float((-w * width).max()))
    if (face + 1) % count not in landing:
        over.append(float(((w - 1.0) * width).max()))
    return max(over)
