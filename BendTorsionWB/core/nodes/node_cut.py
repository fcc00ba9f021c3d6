# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cut of a branch at a node: it ends on the through member's outer faces, less the root gap."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.piecewise import Piecewise
from ..members.member import Member
from .node_faces import STRAY, OuterFaces

FACING = 0.2
"""A face the branch leaves by less than this (the cosine to its normal) is not landed on."""
LANDED = 1e-9
"""mm: steps of Newton along a line below which its end is found."""


@dataclass(frozen=True, eq=False)
class NodeCut:
    """What a branch is cut by on one side of a node: the faces (by index) of the through member
    it lands on, and the root gap kept clear of them.

    planes (k, 2, 3): point and outward normal of each face at the node; strayed (k,): how far the
    face leaves that plane about the node, mm. Beyond that the plane tells the side.
    """

    node: str
    faces: OuterFaces
    landing: tuple[int, ...]
    gap: float
    planes: np.ndarray
    strayed: np.ndarray

    def value_and_gradient(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distance (n,), mm, of points (n, 3) beyond the gap, positive where the branch
        stays, and its gradient (n, 3); away from the faces those of their planes."""
        values, normals = [], []
        for face, (point, normal), strayed in zip(
            self.landing, self.planes, self.strayed, strict=True
        ):
            value = ((points - point) * normal).sum(axis=1)
            gradient = np.repeat(normal[None], len(points), axis=0)
            near = np.abs(value - self.gap) <= strayed
            if near.any():
                value[near], gradient[near] = self.faces.distance(face, points[near])
            values.append(value - self.gap)
            normals.append(gradient)
        if len(values) == 1:
            return values[0], normals[0]
        most = np.argmax(values, axis=0)
        n = np.arange(len(points))
        return np.stack(values)[most, n], np.stack(normals)[most, n]

    @property
    def main(self) -> NodeCut:
        """The cut by the member that runs through."""
        return self

    def named(self, node: str) -> NodeCut:
        """The cut with the node's name."""
        return replace(self, node=node)

    @property
    def parts(self) -> tuple[NodeCut, ...]:
        """The cut at each of its faces; where they meet it has a corner."""
        if len(self.landing) == 1:
            return (self,)
        return tuple(
            NodeCut(
                self.node,
                self.faces,
                self.landing[k : k + 1],
                self.gap,
                self.planes[k : k + 1],
                self.strayed[k : k + 1],
            )
            for k in range(len(self.landing))
        )

    def part_at(self, points: np.ndarray) -> np.ndarray:
        """Which of the parts (n,), by index, governs at points (n, 3)."""
        values = [self.faces.distance(face, points)[0] for face in self.landing]
        return np.argmax(values, axis=0)


@dataclass(frozen=True, eq=False)
class NodeCuts:
    """What a branch is cut by that ends on other branches besides the member that runs through:
    the first cut is that by the member that runs through. What stays is beyond all of them."""

    cuts: tuple[NodeCut, ...]

    @property
    def main(self) -> NodeCut:
        return self.cuts[0]

    def named(self, node: str) -> NodeCuts:
        """The cuts with the node's name."""
        return NodeCuts(tuple(cut.named(node) for cut in self.cuts))

    def value_and_gradient(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `NodeCut`, of the cut farthest beyond which a point is."""
        found = [cut.value_and_gradient(points) for cut in self.cuts]
        values = np.stack([value for value, _ in found])
        least = np.argmin(values, axis=0)
        n = np.arange(len(points))
        return values[least, n], np.stack([gradient for _, gradient in found])[least, n]

    @property
    def parts(self) -> tuple[NodeCut, ...]:
        """The parts of all cuts."""
        return tuple(part for cut in self.cuts for part in cut.parts)

    def part_at(self, points: np.ndarray) -> np.ndarray:
        """Which of the parts (n,), by index, governs at points (n, 3)."""
        values = np.stack([cut.value_and_gradient(points)[0] for cut in self.cuts])
        counts = [len(cut.parts) for cut in self.cuts]
        first = np.concatenate([[0], np.cumsum(counts)[:-1]])
        within = np.stack([cut.part_at(points) for cut in self.cuts]) + first[:, None]
        return within[np.argmin(values, axis=0), np.arange(len(points))]


def node_cut(
    node: str, faces: OuterFaces, s_through: float, away: np.ndarray, gap: float
) -> NodeCut:
    """The cut of a branch that leaves the node in direction `away` (3,), with no gap less than 0.

    It lands on the faces that look its way at s_through; raises ValueError when none does.
    """
    planes = [faces.plane(face, s_through) for face in range(len(faces.names))]
    landing = tuple(
        face for face, (_, normal, _) in enumerate(planes) if float(normal @ away) > FACING
    )
    if not landing:
        raise ValueError("no face of the through member looks towards the branch")
    strayed = np.array([STRAY * planes[face][2] + 1.0 for face in landing])
    planes = np.array([planes[face][:2] for face in landing])
    return NodeCut(node, faces, landing, gap, planes, strayed)


def landings(
    cut: NodeCut | NodeCuts,
    lines: Piecewise,
    start: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Where lines s -> (m * 3,) end on a cut: s (m,) and the points (m, 3).

    Along a branch that leaves the node the distance only grows, so that Newton from `start` finds
    the one end of each line; ends may lie beyond the lines' range.
    """
    count = lines.values.shape[2] // 3
    s = np.full(count, float(start))
    k = np.arange(count)
    rate = lines.derivative
    for _ in range(60):
        points = lines(s).reshape(count, count, 3)[k, k]
        along = rate(s).reshape(count, count, 3)[k, k]
        value, gradient = cut.value_and_gradient(points)
        step = value / (gradient * along).sum(axis=1)
        s = s - step
        if np.abs(step).max() < LANDED:
            break
    return s, lines(s).reshape(count, count, 3)[k, k]


def outer_lines(member: Member, start: float, end: float) -> Piecewise:
    """Corner lines of a member over a stretch, and the lines along the middle of the faces
    between them: s -> (2m * 3,)."""
    corners = member.corners(max(start, 0.0), min(end, member.length))
    table = member.law.table
    first = np.concatenate([corners.values[..., 3 * i : 3 * i + 3] for i in table.first], axis=2)
    second = np.concatenate([corners.values[..., 3 * i : 3 * i + 3] for i in table.second], axis=2)
    return Piecewise(
        corners.breaks, np.concatenate([corners.values, 0.5 * (first + second)], axis=2)
    )
