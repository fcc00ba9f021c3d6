# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms at a node: plane plates inside the through member that continue a branch's plates.

Each lies in the plane of the mid-surface of a plate of the branch: through where it lands on both
sides of a crossing, else tangent to it where it lands. Against walls a side is straight and keeps
the gap over the whole thickness; other sides follow the edges of the branch's plate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..finding import Finding, note, warning
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member
from ..members.strips import rails_between
from ..plates.flat_plate import FlatPlate
from ..plates.flat_room import separation
from ..sections.section import Material
from .node_branch import Branch
from .node_cut import landings
from .node_faces import OuterFaces
from .node_input import NodeRules

FLANGES = ("top", "bottom")
MANHOLE = 0.5
"""Diameter of the manhole in a diaphragm across the box, of its smaller clear size."""
_SAMPLES = np.linspace(0.0, 1.0, 9)
_PASSES = 4


@dataclass(frozen=True, eq=False)
class _Plane:
    """A plane with its frame: origin, x across the through member, y, and normal (3,)."""

    origin: np.ndarray
    x: np.ndarray
    y: np.ndarray

    @property
    def normal(self) -> np.ndarray:
        return crossed(self.x, self.y)

    def at(self, plane: np.ndarray, height: float = 0.0) -> np.ndarray:
        """Points (n, 3) of points (n, 2) of the plane."""
        return self.origin + plane[:, :1] * self.x + plane[:, 1:] * self.y + height * self.normal

    def flat(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) below points (n, 3)."""
        away = points - self.origin
        return np.stack([(away * self.x).sum(axis=1), (away * self.y).sum(axis=1)], axis=1)


def node_diaphragms(
    node: str, through: Member, other: Member, branch: Branch, rules: NodeRules
) -> tuple[tuple[FlatPlate, ...], tuple[Finding, ...]]:
    """The diaphragms a branch asks for, not numbered yet, and warnings for those without room.

    A flange in line with one of the through member's needs none: that one goes on as it is.
    """
    if branch.row.diaphragms == "none":
        return (), ()
    wanted = FLANGES if branch.row.diaphragms == "flanges" else ("top", "bottom", "left", "right")
    if any(side.on_arris for side in branch.sides):
        return (), (
            note(
                "node-diaphragm-arris",
                through.name,
                f"{other.name} lands on an arris; its plates do not go on inside",
                "give the member diaphragms by sheet Diaphragms where they are needed",
                position=f"{node}, s = {branch.s_through:.0f} mm",
            ),
        )
    in_line = {step.face for step in branch.steps if step.in_line}
    flats, findings = [], []
    for index, strip in enumerate(other.law.strips):
        if strip.face not in wanted or strip.face in in_line:
            continue
        made, faults = _diaphragm(node, through, other, branch, index, rules)
        findings += faults
        if made is not None:
            flats.append(made)
    return tuple(flats), tuple(findings)


def _diaphragm(node, through, other, branch, index, rules):
    strip = other.law.strips[index]
    cell = next(c for c in other.law.cells if branch.s <= c.end or c is other.law.cells[-1])
    thickness, material = float(cell.thickness[index]), cell.materials[index]
    edges = _landing_edges(other, branch, index)
    plane = _plane(edges, branch)
    faces = branch.sides[0].cut.main.faces
    walls = np.array(faces.walls)
    name = f"{node}, {strip.face} of {other.name}"
    if strip.face in FLANGES:
        all_faces = {own.face for own in other.law.strips}
        with_webs = branch.row.diaphragms == "flanges and webs"
        webs = [
            _web_line(plane, other, branch, edge, rules)
            if with_webs and edge in all_faces
            else None
            for edge in strip.edges
        ]
        sides = _between_two(plane, faces, branch, edges, webs)
    else:
        sides = _between_all(plane, faces, branch)
    ring = _fitted(plane, faces, walls, sides, thickness, rules)
    if ring is None:
        return None, [_no_room(name, through, branch, 0.0, rules)]
    room = _room(plane, faces, walls, ring, [w for w, _ in sides], thickness)
    findings = []
    if room < rules.access:
        findings.append(_no_room(name, through, branch, room, rules))
    holes, titles = _manhole(ring, strip.face)
    frame = np.eye(4)
    frame[:3, :3] = np.stack([plane.x, plane.y, plane.normal], axis=1)
    frame[:3, 3] = plane.origin
    on_wall = [w is not None for w, _ in sides]
    outline = _sniped(ring, on_wall, rules.snipe)
    welded = _welded(on_wall, [faces.names[w] if w is not None else "" for w, _ in sides], rules)
    return _flat(
        through, thickness, material, frame, outline, branch, holes, titles, welded
    ), findings


def _welded(on_wall: list[bool], names: list[str], rules) -> tuple[tuple[str, int], ...]:
    """The sides of a sniped outline that lie on walls, as `FlatPlate.welded`."""
    found, vertex = [], 0
    for k, name in enumerate(names):
        vertex += rules.snipe > 0.0 and on_wall[k] and on_wall[k - 1]
        if name:
            found.append((name, vertex))
        vertex += 1
    return tuple(found)


def side_by_side(
    node: str, through: Member, flats: list[tuple[Branch, FlatPlate]], rules: NodeRules
) -> tuple[list[tuple[Branch, FlatPlate]], list[Finding]]:
    """The diaphragms of a node's branches without those that run into one of an earlier branch,
    and warnings for these and for such that leave no room to weld between them."""
    kept: list[tuple[Branch, FlatPlate]] = []
    findings = []
    for branch, flat in flats:
        rooms = [separation(flat, other) for own, other in kept if own is not branch]
        room = min(rooms, default=np.inf)
        if room > 0.0:
            kept.append((branch, flat))
        if room >= rules.access:
            continue
        what = "leaves no room to weld beside" if room > 0.0 else "is left out, as it runs into"
        findings.append(
            warning(
                "node-diaphragms-meet",
                through.name,
                f"a diaphragm that continues a plate of {branch.member} {what} one of another "
                "branch",
                "set the diaphragms of one branch to none and give one for both by sheet "
                "Diaphragms, or move the branches apart",
                position=f"{node}, s = {branch.s_through:.0f} mm",
                value=room,
                limit=rules.access,
                unit="mm",
            )
        )
    return kept, findings


def _flat(through, thickness, material: Material, frame, outline, branch, holes, titles, welded):
    return FlatPlate(
        through.name,
        "",
        "diaphragm",
        "D",
        1,
        thickness,
        material,
        frame,
        outline,
        branch.s_through,
        holes,
        titles,
        welded,
    )


def _no_room(name: str, through: Member, branch: Branch, room: float, rules) -> Finding:
    return warning(
        "node-diaphragm-access",
        through.name,
        "there is no room to weld a diaphragm that continues a plate of the branch",
        "align the branch flush, make it lower, or set its diaphragms to none",
        position=f"{name}, s = {branch.s_through:.0f} mm",
        value=room,
        limit=rules.access,
        unit="mm",
    )


def _landing_edges(other: Member, branch: Branch, index: int) -> list[np.ndarray]:
    """Per side the points (3, 3) where the mid-surface of a strip lands: first edge, middle,
    second edge."""
    found = []
    for side in branch.sides:
        span = side.high - side.low + 100.0
        low, high = max(side.low - span, 0.0), min(side.high + span, other.length)
        mid = rails_between(other, [(index, low, high)])[0].mid
        one, two = mid.values[..., :3], mid.values[..., 3:]
        lines = Piecewise(mid.breaks, np.concatenate([one, 0.5 * (one + two), two], axis=2))
        found.append(landings(side.cut.main, lines, 0.5 * (side.low + side.high))[1])
    return found


def _plane(edges: list[np.ndarray], branch: Branch) -> _Plane:
    """The plane through the landings, x from the one of way -1 to that of +1."""
    if len(edges) == 2:
        x = edges[1][1] - edges[0][1]
        across = sum(points[2] - points[0] for points in edges)
        origin = 0.5 * (edges[0][1] + edges[1][1])
    else:
        (side,) = branch.sides
        cut = side.cut.main
        normal = cut.planes[int(cut.part_at(edges[0][1:2])[0])][1]
        across = edges[0][2] - edges[0][0]
        # Into the through member, square to the ruling.
        x = -side.way * normal
        origin = edges[0][1]
    y = across / np.sqrt((across * across).sum())
    x = x - (x * y).sum() * y
    return _Plane(origin, x / np.sqrt((x * x).sum()), y)


# A side of a diaphragm: the index of its wall, or None and the line (2, 2) it follows.
_Side = tuple


def _web_line(plane, other: Member, branch: Branch, face: str, rules) -> np.ndarray:
    """The line (2, 2) that keeps clear of the diaphragm that continues a web of the branch."""
    index = next(k for k, strip in enumerate(other.law.strips) if strip.face == face)
    web = _plane(_landing_edges(other, branch, index), branch)
    cell = next(c for c in other.law.cells if branch.s <= c.end or c is other.law.cells[-1])
    normal = web.normal
    off = float(((plane.origin - web.origin) * normal).sum())
    clear = 0.5 * float(cell.thickness[index]) + rules.wall_gap
    slope = np.array([(normal * plane.x).sum(), (normal * plane.y).sum()])
    point = slope * ((np.copysign(clear, off) - off) / (slope * slope).sum())
    along = np.array([-slope[1], slope[0]])
    # Along +x, as the edges run.
    return np.stack([point, point + along * np.sign(along[0])])


def _between_two(plane, faces: OuterFaces, branch: Branch, edges, webs) -> list[_Side]:
    """Sides of a diaphragm between the wall landed on and the wall across, and along the edges of
    the branch's plate (or clear of the diaphragms of its webs), counter-clockwise from the wall
    behind (−x)."""
    first, last = _across(plane, faces, branch)
    ends = [plane.flat(points) for points in edges]
    lines = []
    for k, web in zip((0, 2), webs, strict=True):
        if web is not None:
            lines.append(web)
        elif len(ends) == 2:
            lines.append(np.stack([ends[0][k], ends[1][k]]))
        else:
            lines.append(np.stack([ends[0][k], ends[0][k] + [1.0, 0.0]]))
    return [(first, None), (None, lines[0]), (last, None), (None, lines[1][::-1])]


def _between_all(plane, faces: OuterFaces, branch: Branch) -> list[_Side]:
    """Sides of a diaphragm against all walls, counter-clockwise from the one behind."""
    first, last = _across(plane, faces, branch)
    rest = [face for face in range(len(faces.names)) if face not in (first, last)]
    rest.sort(key=lambda face: float(faces.plane(face, branch.s_through)[1] @ plane.y))
    return [(first, None), (rest[0], None), (last, None), (rest[-1], None)]


def _across(plane, faces: OuterFaces, branch: Branch) -> tuple[int, int]:
    """The walls that look along −x and along +x most."""
    along = [
        float(faces.plane(face, branch.s_through)[1] @ plane.x) for face in range(len(faces.names))
    ]
    return int(np.argmin(along)), int(np.argmax(along))


def _fitted(plane, faces, walls, sides, thickness, rules) -> np.ndarray | None:
    """The corners (4, 2), each where a side meets the one before, or None without room."""
    lines = []
    for wall, line in sides:
        if wall is None:
            lines.append(line)
            continue
        middle, _ = _wall_line(plane, faces, wall, walls[wall] + rules.wall_gap)
        lines.append(middle)
    for _ in range(_PASSES):
        ring = _corners(lines)
        if ring is None or _area(ring) <= 0.0:
            return None
        for k, (wall, _) in enumerate(sides):
            if wall is not None:
                ends = ring[k], ring[(k + 1) % len(sides)]
                lines[k] = _keeping_clear(
                    plane, faces, wall, walls[wall] + rules.wall_gap, ends, thickness
                )
    ring = _corners(lines)
    return ring if ring is not None and _area(ring) > 0.0 else None


def _wall_line(plane, faces, wall, depth) -> tuple[np.ndarray, np.ndarray]:
    """The line (2, 2) in the plane at a depth behind a wall's plane, as it is near the origin."""
    value, normal = faces.distance(wall, plane.origin[None])
    inward = np.array([(normal[0] * plane.x).sum(), (normal[0] * plane.y).sum()])
    size = np.sqrt((inward * inward).sum())
    away = inward / size
    point = away * (-(value[0] + depth) / size)
    along = np.array([-away[1], away[0]])
    return np.stack([point, point + along]), away


def _keeping_clear(plane, faces, wall, depth, ends, thickness) -> np.ndarray:
    """The line (2, 2) along a wall between two points that keeps the depth behind its outer face
    at both sides of the diaphragm."""
    a, b = ends
    along = (b - a) / np.sqrt(((b - a) ** 2).sum())
    outwards = np.array([along[1], -along[0]])
    points = a + _SAMPLES[:, None] * (b - a)
    room = np.full(len(_SAMPLES), np.inf)
    for height in (-0.5 * thickness, 0.0, 0.5 * thickness):
        value, normal = faces.distance(wall, plane.at(points, height))
        slope = (normal * (outwards[0] * plane.x + outwards[1] * plane.y)).sum(axis=1)
        room = np.minimum(room, -(value + depth) / slope)
    tilt = (room[-1] - room[0]) * _SAMPLES + room[0]
    shift = float((room - tilt).min())
    return np.stack([a + (room[0] + shift) * outwards, b + (room[-1] + shift) * outwards])


def _corners(lines) -> np.ndarray | None:
    corners = []
    for k in range(len(lines)):
        (p, q), (r, t) = lines[k - 1], lines[k]
        one, two = q - p, t - r
        turn = one[0] * two[1] - one[1] * two[0]
        if abs(turn) < 1e-9 * np.sqrt((one * one).sum() * (two * two).sum()):
            return None
        gap = r - p
        corners.append(p + one * ((gap[0] * two[1] - gap[1] * two[0]) / turn))
    return np.array(corners)


def _area(ring: np.ndarray) -> float:
    following = np.roll(ring, -1, axis=0)
    return 0.5 * float((ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]).sum())


def _room(plane, faces, walls, ring, own, thickness) -> float:
    """Least distance, mm, from the diaphragm to the inner face of a wall beside it."""
    least = np.inf
    points = np.concatenate([plane.at(ring, h) for h in (-0.5 * thickness, 0.5 * thickness)])
    for wall in range(len(faces.names)):
        if wall not in own:
            value, _ = faces.distance(wall, points)
            least = min(least, float((-value - walls[wall]).min()))
    return least


def _manhole(ring: np.ndarray, face: str) -> tuple[tuple[np.ndarray, ...], tuple[str, ...]]:
    """A round manhole in a diaphragm that closes the box."""
    if face in FLANGES:
        return (), ()
    middle = ring.mean(axis=0)
    size = np.sqrt(((np.roll(ring, -1, axis=0) - ring) ** 2).sum(axis=1))
    radius = 0.5 * MANHOLE * float(size.min())
    left, right = middle - [radius, 0.0], middle + [radius, 0.0]
    return (np.array([[*left, 1.0], [*right, 1.0]]),), (f"manhole D{2.0 * radius:.0f}",)


def _sniped(ring: np.ndarray, on_wall: list[bool], snipe: float) -> np.ndarray:
    """The contour (m, 3), corners between two walls cut off by legs of `snipe`."""
    points = []
    for k in range(len(ring)):
        if snipe > 0.0 and on_wall[k] and on_wall[k - 1]:
            for other in (ring[k - 1], ring[(k + 1) % len(ring)]):
                leg = other - ring[k]
                points.append(ring[k] + leg * (snipe / np.sqrt((leg * leg).sum())))
        else:
            points.append(ring[k])
    return np.column_stack([points, np.zeros(len(points))])
