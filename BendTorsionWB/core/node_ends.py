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
"""Stations that the polynomial through an edge takes."""
NEWTON_STEPS = 5


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
    faces = [
        (p.face, _rails(p, node.s_through))
        for p in through.plates
        if p.lines and _near(p, node.s_through, near)
    ]
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
            rails, last = _rails(plate, s), -1 if way < 0 else 0
            feet = [(float(rails[0][last, k]), float(k)) for k in (0, 1)]
            inside = middle_at(branch, inner.mean(axis=0))
            normal = np.array([_away(rails, *foot, inside) for foot in feet])
            names, seats = zip(*(_face_at(point, faces, through) for point in corners), strict=True)
            bevel = np.arcsin((normal * np.array(seats)).sum(axis=1).clip(-1.0, 1.0))
            line = plate.lines[last]
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


def _rails(plate: DevelopedPlate, s: float) -> tuple[np.ndarray, np.ndarray]:
    """Arc lengths (n, 2) and points (n, 2, 3) of a plate's outer edges on the smooth stretch
    between folds that holds s."""
    own: dict[str, list[float]] = {}
    for point in plate.points:
        if point.kind == "arris":
            own.setdefault(point.line, []).append(point.s)
    places = np.array([own[line.label] for line in plate.lines if len(own[line.label]) == 2])
    low = max((fold.s for fold in plate.folds if fold.s <= s), default=-math.inf)
    high = min((fold.s for fold in plate.folds if fold.s > s), default=math.inf)
    middle = places.mean(axis=1)
    kept = (middle > low - 1.0) & (middle < high + 1.0)
    kept = kept if kept.sum() > 1 else np.full(len(kept), True)
    return places[kept], arris(plate)[kept]


def _edge(s: np.ndarray, points: np.ndarray, at: float) -> tuple[np.ndarray, np.ndarray]:
    """Point (3,) and derivative (3,) at a place of a curve through points (n, 3) at s (n,), by
    the polynomial through the nearest of them."""
    _, apart = np.unique(np.round(s), return_index=True)
    s, points = s[apart], points[apart]
    order = np.argsort(np.abs(s - at), kind="stable")[:NEAREST]
    scale = max(float(np.ptp(s[order])), 1.0)
    powers = ((s[order] - at) / scale)[:, None] ** np.arange(len(order))
    found = np.linalg.solve(powers, points[order])
    return found[0], found[1] / scale


def _ruling(rails, s: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and derivatives (2, 3) of both edges at s."""
    both = [_edge(rails[0][:, k], rails[1][:, k], s) for k in (0, 1)]
    return np.array([both[0][0], both[1][0]]), np.array([both[0][1], both[1][1]])


def _away(rails, s: float, w: float, inside: np.ndarray) -> np.ndarray:
    """Unit normal (3,) of the surface ruled between the edges at (s, w), away from a point."""
    ends, rates = _ruling(rails, s)
    across = ends[1] - ends[0]
    normal = np.cross(rates[0] + w * (rates[1] - rates[0]), across)
    normal = normal / np.linalg.norm(normal)
    outwards = ((ends[0] + w * across - inside) * normal).sum()
    return -normal if outwards < 0.0 else normal


def _face_at(point: np.ndarray, faces, through: MemberRecord) -> tuple[str, np.ndarray]:
    """The name of the face whose surface lies nearest to a point, and its unit normal there."""
    best = (math.inf, "", None, 0.0, 0.0)
    for name, rails in faces:
        distance, s, w = _foot(rails, point)
        if distance < best[0]:
            best = (distance, name, rails, s, w)
    _, name, rails, s, w = best
    return name, _away(rails, s, w, middle_at(through, point))


def _foot(rails, point: np.ndarray) -> tuple[float, float, float]:
    """Distance of a point from the surface ruled between the edges, and (s, w) of its foot."""
    middle = rails[1].mean(axis=1)
    s = float(rails[0][int(np.argmin(((middle - point) ** 2).sum(axis=1)))].mean())
    w, low, high = 0.5, float(rails[0].min()), float(rails[0].max())
    for _ in range(NEWTON_STEPS):
        ends, rates = _ruling(rails, s)
        across, along = ends[1] - ends[0], rates[0] + w * (rates[1] - rates[0])
        off = point - ends[0] - w * across
        aa, ab, bb = (along * along).sum(), (along * across).sum(), (across * across).sum()
        ao, bo = (along * off).sum(), (across * off).sum()
        determinant = aa * bb - ab * ab
        s += float((ao * bb - bo * ab) / determinant)
        w += float((bo * aa - ao * ab) / determinant)
        s, w = min(max(s, low), high), min(max(w, 0.0), 1.0)
    ends, _ = _ruling(rails, s)
    off = point - ends[0] - w * (ends[1] - ends[0])
    return float(np.sqrt((off * off).sum())), s, w
