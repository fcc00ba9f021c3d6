# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steps and angles of flanges at nodes by other means: measured on the solids by the kernel.

The corner is a vertex of the branch's solids. The through member's face is the kernel's B-spline
surface; its rulings, between edge curves at one parameter, are continued as straight lines, and
the one nearest to the corner is searched for. Nothing of the program's own faces, feet or normals
is used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

_GRID = 401


@dataclass(frozen=True)
class Corner:
    """A corner of a branch: what the program tells of it (step mm, angle rad), and the kernel."""

    node: str
    branch: str
    side: str
    face: str
    edge: str
    told: tuple[float, float]
    measured: tuple[float, float]

    def line(self) -> str:
        step, angle = self.told
        other, turn = self.measured
        return (
            f"{self.node:10} {self.branch:4} {self.side:6} {self.face:7} {self.edge:6} "
            f"step {step:8.4f} {other:8.4f} mm   angle {math.degrees(angle):7.4f} "
            f"{math.degrees(turn):7.4f} deg"
        )


def corners(node, branch, through, own, ends) -> list[Corner]:
    """Of every flange in line with the through member's. through: (plate, solid) of its plates;
    own: (plate, solid) of the branch's that end there, ends: which end (0 or 1) of each."""
    found = []
    for step in branch.steps:
        if not step.in_line or step.on:
            continue
        way = 1 if step.way > 0 else -1
        here = [pair for pair, end in zip(own, ends, strict=True) if end == (0 if way > 0 else 1)]
        flange = next(solid for plate, solid in here if plate.face == step.face)
        web = next(solid for plate, solid in here if plate.face == step.edge)
        flat = [solid for plate, solid in through if plate.face == step.through_face]
        near = np.array(node.point)
        up = _outward(flange, [solid for _, solid in here])
        side = _outward(web, [solid for _, solid in here])
        points = np.array([tuple(v.Point) for _, solid in here for v in solid.Vertexes])
        # At the end of the branch at the node, as high and as far out as there is one.
        points = points[((points - near) ** 2).sum(axis=1) < _reach(points, near) ** 2]
        corner = points[np.argmax(points @ (up + side))]
        foot, normal = _on_ruled(min(flat, key=lambda s: _distance(s, corner)), corner, up)
        own_normal = _normal(_face(flange, corner, up), corner)
        cosine = float(normal @ own_normal)
        found.append(
            Corner(
                node.name,
                branch.member,
                "before" if way < 0 else "behind",
                step.face,
                step.edge,
                (step.step, step.angle),
                (float((corner - foot) @ normal), math.acos(min(cosine, 1.0))),
            )
        )
    return found


def _reach(points, near) -> float:
    """Vertices of the end at the node are the nearer half."""
    return float(np.median(np.sqrt(((points - near) ** 2).sum(axis=1)))) + 1.0


def _outward(solid, others) -> np.ndarray:
    """The way from the middle of all solids to the middle of one."""
    middle = np.mean([tuple(other.CenterOfMass) for other in others], axis=0)
    away = np.array(tuple(solid.CenterOfMass)) - middle
    return away / np.linalg.norm(away)


def _vertex(point):
    import FreeCAD
    import Part

    return Part.Vertex(FreeCAD.Vector(*(float(x) for x in point)))


def _distance(shape, point) -> float:
    return shape.distToShape(_vertex(point))[0]


def _face(solid, point, up):
    """The face of a solid that looks up, nearest to a point."""
    looking = [face for face in solid.Faces if _normal(face, point) @ up > 0.8]
    return min(looking, key=lambda face: _distance(face, point))


def _normal(face, point) -> np.ndarray:
    import FreeCAD

    u, v = face.Surface.parameter(FreeCAD.Vector(*(float(x) for x in point)))
    low_u, high_u, low_v, high_v = face.ParameterRange
    normal = face.normalAt(min(max(u, low_u), high_u), min(max(v, low_v), high_v))
    return np.array(tuple(normal))


def _on_ruled(solid, point, up) -> tuple[np.ndarray, np.ndarray]:
    """Foot of a point on the ruled face of a solid that looks up, continued along its rulings, and
    the normal there."""
    face = _face(solid, point, up)
    surface = face.Surface
    low_u, high_u, low_v, high_v = face.ParameterRange
    by_u = surface.VDegree == 1
    low, high = (low_u, high_u) if by_u else (low_v, high_v)
    edges = (low_v, high_v) if by_u else (low_u, high_u)

    def ruling(t: float) -> tuple[np.ndarray, np.ndarray]:
        ends = [surface.value(*((t, e) if by_u else (e, t))) for e in edges]
        one, two = (np.array(tuple(end)) for end in ends)
        return one, two - one

    def away(t: float) -> float:
        one, along = ruling(t)
        w = (point - one) @ along / (along @ along)
        return float(np.linalg.norm(point - one - w * along))

    grid = np.linspace(low, high, _GRID)
    values = [away(t) for t in grid]
    k = int(np.argmin(values))
    span = grid[max(k - 1, 0)], grid[min(k + 1, _GRID - 1)]
    best = minimize_scalar(away, bounds=span, method="bounded", options={"xatol": 1e-12}).x
    one, along = ruling(best)
    w = (point - one) @ along / (along @ along)
    foot = one + w * along
    small = 1e-4 * (high - low)
    ahead, before = ruling(best + small), ruling(best - small)
    tangent = (ahead[0] + w * ahead[1]) - (before[0] + w * before[1])
    normal = np.cross(tangent, along)
    normal /= np.linalg.norm(normal)
    return foot, normal if normal @ up > 0.0 else -normal
