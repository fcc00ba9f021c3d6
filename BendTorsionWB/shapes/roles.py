# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces and edges of solids named by what they are, whatever numbers the kernel gives them.

Faces of a plate: `outer`, `inner`, `edge left` and `edge right` (of webs `edge top`, `edge
bottom`; of other strips their own edge names), `end start`, `end end`; what was cut in later is
`chamfer start` (beside an end), `opening` or `cut`. Edges are named by the two faces they part:
`arris outer left`, `arris start inner`, `arris end left`, `fold 1 outer`, `opening outer`. Faces
between folds, and others of one name, are counted along the member: `outer 1`, `outer 2`.

Faces of a flat part: `side start` and `side end` (which way they look along the member), `edge 1`,
`edge 2`, … round its contour, `opening`; its edges `arris start 1`, `arris end 1`, `corner 1 2` and
`opening start`.

Solids as `brep` writes them are known by the order of their faces; solids that were cut after
that by which of the faces as written each of their faces lies on.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import Part

from BendTorsionWB.core.plates.flat_plate import FlatPlate
from BendTorsionWB.shapes import brep

ON_FACE = 0.2
"""mm: a face of a cut solid lies on a face as written when its middles are this near to it."""
_MESH = 0.05


@dataclass(frozen=True, eq=False)
class Body:
    """A solid as it is written: its tube's pieces, and the names of the faces between rail j and
    the next and, of a member's skin, of the rails."""

    pieces: Sequence[brep.Piece]
    sides: tuple[str, ...]
    rails: tuple[str, ...] = ()


def plate_body(pieces: Sequence[brep.Piece], edges: tuple[str, str]) -> Body:
    """A plate: rails outer first, outer second, inner second, inner first."""
    return Body(pieces, ("outer", f"edge {edges[1]}", "inner", f"edge {edges[0]}"))


def face_roles(solid: Part.Shape, body: Body) -> list[str]:
    """The roles of a solid's faces, in their order."""
    count = len(body.sides)
    spans = len(body.pieces)
    written = [*body.sides] * spans + ["end start", "end end"]
    faces = solid.Faces
    if len(faces) != len(written) or not _as_written(faces, body):
        written = _found(solid, body, written)
        order = _places(faces, body)
    else:
        order = [k // count for k in range(count * spans)] + [0, spans]
    return _counted(written, order)


def flat_face_roles(solid: Part.Shape, flat: FlatPlate) -> list[str]:
    """The roles of the faces of a flat part's solid, in their order."""
    frame = np.asarray(flat.frame)
    contours = [flat.outline[:, :2], *(hole[:, :2] for hole in flat.holes)]
    roles, order = [], []
    for face in solid.Faces:
        u0, u1, v0, v1 = face.ParameterRange
        middle = np.array(face.valueAt(0.5 * (u0 + u1), 0.5 * (v0 + v1)))
        tilt = float(np.array(face.normalAt(0.5 * (u0 + u1), 0.5 * (v0 + v1))) @ frame[:3, 2])
        if abs(tilt) > 0.5:
            roles.append("side end" if tilt > 0 else "side start")
            order.append(0)
            continue
        # A face of the contour lies on the middle of one of its segments, or beside it by its sag.
        at = (middle - frame[:3, 3]) @ frame[:3, :2]
        near = [
            np.linalg.norm(0.5 * (ring + np.roll(ring, -1, axis=0)) - at, axis=1)
            for ring in contours
        ]
        ring = min(range(len(near)), key=lambda k: near[k].min())
        roles.append("opening" if ring else "edge")
        order.append(int(np.argmin(near[ring])) + 1000 * ring)
    return _counted(roles, order)


def edge_roles(solid: Part.Shape, faces: Sequence[str], body: Body | None = None) -> list[str]:
    """The roles of a solid's edges, in their order, from those of its faces."""
    edges = solid.Edges
    table: dict[int, list[int]] = {}
    for k, edge in enumerate(edges):
        table.setdefault(edge.hashCode(), []).append(k)
    owners: list[list[str]] = [[] for _ in edges]
    for face, role in zip(solid.Faces, faces, strict=True):
        for edge in face.Edges:
            for k in table[edge.hashCode()]:
                if edges[k].isSame(edge):
                    owners[k].append(role)
    names = [_flat_edge_role(own) if body is None else _edge_role(own, body) for own in owners]
    order = [0.0] * len(edges)
    if body is not None:
        start = np.asarray(body.pieces[0][1])[:, 0].mean(axis=0)
        order = [np.linalg.norm(np.array(edge.CenterOfMass) - start) for edge in edges]
    return _counted(names, order)


def base(role: str) -> str:
    """A role without its count: `outer 2` is an `outer`; `fold 2 inner` stays as it is, and so do
    the edges `arris start 2` and `corner 1 2` of flat parts."""
    head, _, tail = role.rpartition(" ")
    own = head in ("arris start", "arris end") or role.startswith("corner")
    return head if head and tail.isdigit() and not own else role


def _flat_edge_role(owners: Sequence[str]) -> str:
    """`arris start 2` between a side and edge 2, `corner 1 2` between two edges, `opening end`."""
    sides = [owner.removeprefix("side ") for owner in owners if owner.startswith("side")]
    if any(base(owner) == "opening" for owner in owners):
        return " ".join(["opening", *sides]) if sides else "seam opening"
    numbers = sorted(owner.rpartition(" ")[2] for owner in owners if owner.startswith("edge"))
    return " ".join(["arris", *sides, *numbers] if sides else ["corner", *numbers])


def _edge_role(owners: Sequence[str], body: Body) -> str:
    bases = sorted({base(owner) for owner in owners}, key=_rank)
    if len(bases) == 1:
        counts = sorted(int(o.rpartition(" ")[2]) for o in owners if o != base(o))
        if counts and len(set(counts)) == 2:
            return f"fold {counts[0]} {bases[0].removeprefix('edge ')}"
        return f"seam {bases[0]}"
    short = [name.removeprefix("edge ").removeprefix("end ") for name in bases]
    if body.rails and not any(name.startswith("end ") for name in bases):
        pairs = {
            frozenset((body.sides[j - 1], body.sides[j])): name for j, name in enumerate(body.rails)
        }
        return f"arris {pairs[frozenset(bases)]}"
    if bases[0] in ("opening", "cut"):
        return " ".join(short)
    return "arris " + " ".join(short)


def _rank(name: str) -> tuple[int, str]:
    """What comes first in the name of an edge: openings, ends, faces, then edges."""
    heads = ("opening", "cut", "chamfer", "end", "outer", "inner", "edge")
    head = name.split()[0]
    return (heads.index(head) if head in heads else len(heads), name)


def _counted(names: Sequence[str], order: Sequence[float]) -> list[str]:
    """Names that occur more than once with their count, by rising order."""
    total = Counter(names)
    seen: Counter[str] = Counter()
    counted = list(names)
    for k in sorted(range(len(names)), key=lambda k: (order[k], k)):
        if total[names[k]] > 1:
            seen[names[k]] += 1
            counted[k] = f"{names[k]} {seen[names[k]]}"
    return counted


def _as_written(faces: Sequence[Part.Face], body: Body) -> bool:
    """Whether the start and end caps, which come last, are still the rings of the tube's ends."""
    for face, poles in (
        (faces[-2], body.pieces[0][1][:, 0]),
        (faces[-1], body.pieces[-1][1][:, -1]),
    ):
        corners = np.array([tuple(vertex.Point) for vertex in face.Vertexes])
        if len(corners) != len(poles):
            return False
        gap = np.linalg.norm(corners[:, None] - np.asarray(poles)[None], axis=2).min(axis=0)
        if gap.max() > ON_FACE:
            return False
    return True


def _found(solid: Part.Shape, body: Body, written: Sequence[str]) -> list[str]:
    """Roles of the faces of a cut solid, by the faces as written that they lie on."""
    whole = brep.tube_solid(body.pieces)
    roles = [_lies_on(face, whole.Faces, written) for face in solid.Faces]
    kept = {role for role in roles if role}
    rings = {
        "start": np.asarray(body.pieces[0][1])[:, 0].mean(axis=0),
        "end": np.asarray(body.pieces[-1][1])[:, -1].mean(axis=0),
    }
    for k, face in enumerate(solid.Faces):
        if roles[k]:
            continue
        beside = {
            roles[j]
            for j, other in enumerate(solid.Faces)
            if j != k and roles[j] and _share_an_edge(face, other)
        }
        centre = np.array(face.CenterOfMass)
        end = min(rings, key=lambda name: float(np.linalg.norm(rings[name] - centre)))
        if not any(role.startswith("edge") for role in beside):
            roles[k] = "opening" if {"outer", "inner"} <= beside or not beside else "cut"
        else:
            roles[k] = f"chamfer {end}" if f"end {end}" in kept else f"end {end}"
    return roles


def _lies_on(face: Part.Face, written: Sequence[Part.Face], roles: Sequence[str]) -> str:
    """The role of the face as written that the middles of the largest triangles lie on."""
    points, triangles = face.tessellate(_MESH)
    points = np.array([tuple(p) for p in points])[np.array(triangles)]
    size = np.linalg.norm(
        np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1
    )
    middles = points[np.argsort(-size, kind="stable")[:3]].mean(axis=1)
    vertices = [Part.Vertex(*middle) for middle in middles.tolist()]
    for other, role in zip(written, roles, strict=True):
        if all(other.distToShape(vertex)[0] <= ON_FACE for vertex in vertices):
            return role
    return ""


def _share_an_edge(one: Part.Face, other: Part.Face) -> bool:
    return any(a.isSame(b) for a in one.Edges for b in other.Edges)


def _places(faces: Sequence[Part.Face], body: Body) -> list[float]:
    start = np.asarray(body.pieces[0][1])[:, 0].mean(axis=0)
    return [float(np.linalg.norm(np.array(face.CenterOfMass) - start)) for face in faces]
