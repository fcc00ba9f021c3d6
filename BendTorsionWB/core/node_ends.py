# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates that end at a node, read off the records: length of the cut, bevel and dihedral along it.

Bevel and dihedral follow from the two outward normals at each corner of the cut: that of the
branch's plate and that of the face of the through member nearest to it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .lofting import DevelopedPlate, MemberRecord
from .node_record import NodeRecord

JOINED = 40.0
"""mm; ends of two plates of a face nearer than this meet at a joint."""
BEYOND = 100.0
"""mm a plate may end farther from the node than both sections reach."""
NEAREST = 4
"""Quads of a face whose centres are nearest to a point, of which the nearest one is looked for."""


@dataclass(frozen=True, eq=False)
class PlateEnd:
    """The end line `E-1` or `E-2` of a branch's plate at a node.

    way: +1 where the branch leaves the node along its +s. corners (2, 3): outer corners of the
    cut. length: mm along the cut. face: of the through member it ends on. bevel (2,): at the
    corners, rad, the angle of the cut against square, positive where the outer face is the longer.
    dihedral (2,): rad, between plate and face on the inner side.
    """

    plate: DevelopedPlate
    line: str
    way: int
    corners: np.ndarray
    length: float
    face: str
    bevel: np.ndarray
    dihedral: np.ndarray


def arris(plate: DevelopedPlate) -> np.ndarray:
    """Points (n, 2, 3) on the outer corner lines of a plate, line by line along +s."""
    found: dict[str, list[np.ndarray]] = {}
    for point in plate.points:
        if point.kind == "arris":
            found.setdefault(point.line, []).append(point.xyz)
    return np.array([found[line.label] for line in plate.lines if len(found[line.label]) == 2])


def ring(plate: DevelopedPlate) -> np.ndarray:
    """The outline (n, 3) in the model of a plate, closed: of a flat part that of its marked side,
    of any other its outer corner lines."""
    if plate.lines:
        lines = arris(plate)
        return np.concatenate([lines[:, 0], lines[::-1, 1], lines[:1, 0]])
    flat = np.concatenate([run[:-1] for run in plate.outline])
    flat = np.column_stack([flat, np.zeros(len(flat)), np.ones(len(flat))])
    space = flat @ (np.linalg.inv(plate.placing) @ plate.flat_to_placing).T
    return space[[*range(len(space)), 0], :3]


def outward(lines: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Unit normals (n - 1, 2, 3) of the quads between lines (n, 2, 3), at their first and second
    edge, away from a point."""
    across = 0.5 * (lines[1:] + lines[:-1])
    across = across[:, 1] - across[:, 0]
    normal = np.cross(lines[1:] - lines[:-1], across[:, None])
    normal = normal / np.linalg.norm(normal, axis=2)[..., None]
    centre = 0.25 * (lines[1:] + lines[:-1]).sum(axis=1)
    away = ((centre - middle) * normal.mean(axis=1)).sum(axis=1)
    return normal * np.where(away < 0.0, -1.0, 1.0)[:, None, None]


def middle_at(record: MemberRecord, point: np.ndarray) -> np.ndarray:
    """The middle (3,) of the section at the station of the axis nearest to a point."""
    axis = record.wireframe["axis"]
    k = int(np.argmin(((axis - point) ** 2).sum(axis=1)))
    lines = list(corner_lines(record).values())
    return np.mean([line[2 * k] for line in lines], axis=0) if lines else axis[k]


def reach(record: MemberRecord) -> float:
    """Largest distance, mm, of a corner line from the axis, its ends apart."""
    axis = record.wireframe["axis"]
    lines = [line[::2] for line in corner_lines(record).values()]
    if not lines:
        return 0.0
    return float(np.linalg.norm(np.stack(lines) - axis, axis=2)[:, 1:-1].max())


def corner_lines(record: MemberRecord) -> dict[str, np.ndarray]:
    """The corner lines of a member's wireframe by name, two points for each of the axis."""
    marks = {"axis", *(plate.mark for plate in record.plates)}
    count = 2 * len(record.wireframe["axis"])
    return {
        name: line
        for name, line in record.wireframe.items()
        if name not in marks and len(line) == count
    }


def axis_at(record: MemberRecord, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The point (3,) of the axis nearest to a point, and the unit tangent (3,) there."""
    axis = record.wireframe["axis"]
    step = np.diff(axis, axis=0)
    length2 = (step * step).sum(axis=1)
    share = (((point - axis[:-1]) * step).sum(axis=1) / length2).clip(0.0, 1.0)
    foot = axis[:-1] + share[:, None] * step
    k = int(np.argmin(((foot - point) ** 2).sum(axis=1)))
    return foot[k], step[k] / math.sqrt(length2[k])


def plate_ends(
    node: NodeRecord, branch: MemberRecord, through: MemberRecord
) -> tuple[PlateEnd, ...]:
    """The ends of a branch's plates at a node, those before it first."""
    near = (reach(through) + reach(branch)) / math.sin(node.angle) + BEYOND
    plates = [p for p in branch.plates if p.lines and _near(p, node.s_other, near)]
    lines = {plate.mark: arris(plate) for plate in plates}
    faces = []
    for plate in through.plates:
        if plate.lines and _near(plate, node.s_through, near):
            own = arris(plate)
            inside = middle_at(through, own[len(own) // 2].mean(axis=0))
            faces.append((plate.face, own, outward(own, inside)))
    found = []
    for plate in plates:
        own = lines[plate.mark]
        for way, corners, inner in ((-1, own[-1], own[-2]), (1, own[0], own[1])):
            middle = corners.mean(axis=0)
            s = plate.lines[-1 if way < 0 else 0].s
            if abs(s - node.s_other) > near or (s - node.s_other) * way < 0.0:
                continue
            others = [
                lines[p.mark][0 if way < 0 else -1].mean(axis=0)
                for p in plates
                if p.face == plate.face and p is not plate
            ]
            if any(np.linalg.norm(other - middle) < JOINED for other in others):
                continue
            inside = middle_at(branch, inner.mean(axis=0))
            quad = np.stack([inner, corners] if way < 0 else [corners, inner])
            normal = outward(quad, inside)[0]
            names, seats = zip(*(_face_at(point, faces) for point in corners), strict=True)
            bevel = np.arcsin((normal * np.array(seats)).sum(axis=1).clip(-1.0, 1.0))
            line = plate.lines[-1 if way < 0 else 0]
            found.append(
                PlateEnd(
                    plate,
                    line.label,
                    way,
                    corners,
                    line.length_3d,
                    " and ".join(dict.fromkeys(names)),
                    bevel,
                    0.5 * math.pi - bevel,
                )
            )
    return tuple(sorted(found, key=lambda end: end.way))


def _near(plate: DevelopedPlate, s: float, reach: float) -> bool:
    return plate.lines[0].s < s + reach and plate.lines[-1].s > s - reach


def _face_at(point: np.ndarray, faces) -> tuple[str, np.ndarray]:
    """The name of the face whose surface lies nearest to a point, and its unit normal there."""
    best = (math.inf, "", np.zeros(3))
    for name, lines, normals in faces:
        centre = 0.25 * (lines[1:] + lines[:-1]).sum(axis=1)
        order = np.argsort(((centre - point) ** 2).sum(axis=1))[:NEAREST]
        for k in order.tolist():
            distance, u, w = _foot(lines[k], lines[k + 1], point)
            if distance < best[0]:
                normal = _normal(lines[k], lines[k + 1], u, w)
                up = normal if normal @ normals[k].mean(axis=0) > 0.0 else -normal
                best = (distance, name, up)
    return best[1], best[2]


def _foot(a: np.ndarray, b: np.ndarray, point: np.ndarray) -> tuple[float, float, float]:
    """Distance of a point from the bilinear quad between lines a and b (2, 3), and where."""
    u = w = 0.5
    for _ in range(6):
        along = (1 - w) * (b[0] - a[0]) + w * (b[1] - a[1])
        across = (1 - u) * (a[1] - a[0]) + u * (b[1] - b[0])
        off = point - ((1 - w) * ((1 - u) * a[0] + u * b[0]) + w * ((1 - u) * a[1] + u * b[1]))
        du, dw = np.linalg.lstsq(np.column_stack([along, across]), off, rcond=None)[0]
        u, w = min(max(u + du, 0.0), 1.0), min(max(w + dw, 0.0), 1.0)
    off = point - ((1 - w) * ((1 - u) * a[0] + u * b[0]) + w * ((1 - u) * a[1] + u * b[1]))
    return float(np.linalg.norm(off)), u, w


def _normal(a: np.ndarray, b: np.ndarray, u: float, w: float) -> np.ndarray:
    along = (1 - w) * (b[0] - a[0]) + w * (b[1] - a[1])
    across = (1 - u) * (a[1] - a[0]) + u * (b[1] - b[0])
    normal = np.cross(along, across)
    return normal / np.linalg.norm(normal)
