# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates that end at a node, as records tell: length of the cut, bevel and dihedral along it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate, EndPart, MemberRecord
from .node_record import NodeRecord


@dataclass(frozen=True, eq=False)
class PlateEnd:
    """The end line `E-1` or `E-2` of a branch's plate at a node.

    way: +1 where the branch leaves the node along its +s. corners (k, 3): outer corners of the
    cut, and those between the surfaces it ends on. length: mm along the cut. face: it ends on.
    bevel (2,): at the corners, rad, the angle of the cut against square, positive where the outer
    face is the longer. dihedral (2,): rad, between plate and face on the inner side.
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
        end, start = (_cut_line(plate, which)[1:-1] for which in (1, 0))
        return np.concatenate([lines[:, 0], end, lines[::-1, 1], start[::-1], lines[:1, 0]])
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


def plate_ends(node: NodeRecord, branch: MemberRecord) -> tuple[PlateEnd, ...]:
    """The ends of a branch's plates at a node, those before it first."""
    found = []
    for plate in branch.plates:
        for which, (label, parts) in enumerate(zip(("E-1", "E-2"), plate.ends, strict=True)):
            own = [part for part in parts if part.node == node.node]
            if not own:
                continue
            line = plate.lines[-which]
            bevel = np.array([own[0].bevel[0], own[-1].bevel[-1]])
            found.append(
                PlateEnd(
                    plate,
                    label,
                    -1 if which else 1,
                    _cut_line(plate, which),
                    line.length_3d,
                    " and ".join(dict.fromkeys(_title(part, node) for part in own)),
                    bevel,
                    0.5 * math.pi - bevel,
                )
            )
    return tuple(sorted(found, key=lambda end: end.way))


def _title(part: EndPart, node: NodeRecord) -> str:
    """The face a stretch ends on, with its member where that is another branch."""
    return part.face if part.member == node.through else f"{part.member} {part.face}"


def _cut_line(plate: DevelopedPlate, which: int) -> np.ndarray:
    """The end line (k, 3) on the outer face from the first edge to the second, with the corners
    between the surfaces it ends on."""
    first, second = arris(plate)[-which]
    between = [part.corners[1] for part in plate.ends[which][:-1]]
    return np.array([first, *between, second])
