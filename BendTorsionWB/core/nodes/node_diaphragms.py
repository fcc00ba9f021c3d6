# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms at a node: plane plates inside the through member that continue a branch's plates.

Each lies in the plane of the mid-surface of a plate of the branch: through where it lands on both
sides of a crossing, in its own plane where it lands on an arris, else square to the face it lands
on. Those of webs close the box; those of flanges go from wall to wall, as broad as the flange or
from the diaphragm of one web to that of the other, which they are welded to.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import Finding, warning
from ..members.member import Member
from ..plates.flat_plate import FlatPlate
from ..plates.flat_room import separation
from ..sections.section import Material, Strip
from .node_branch import Branch, up
from .node_diaphragm_shape import (
    Outline,
    Plane,
    clear_of,
    edge_lines,
    fitted,
    landing_edges,
    plane_of,
    room_beside,
    slant,
    sniped,
)
from .node_diaphragm_sides import side_fits
from .node_input import NodeRules
from .node_manhole import manhole

FLANGES = ("top", "bottom")
WEBS = ("left", "right")
MANHOLE = 0.5
"""Diameter of a manhole, of the smaller clear size, where that is more than access asks for."""


@dataclass(frozen=True, eq=False)
class _Plate:
    """A plate of a branch that goes on inside: its strip, thickness and material, where it lands,
    and the plane it goes on in."""

    strip: Strip
    thickness: float
    material: Material
    edges: list[tuple[np.ndarray, np.ndarray]]
    plane: Plane


def node_diaphragms(
    node: str, through: Member, other: Member, branch: Branch, rules: NodeRules
) -> tuple[tuple[FlatPlate, ...], tuple[Finding, ...]]:
    """The diaphragms a branch asks for, not numbered yet, and warnings for those without room or
    access.

    A flange in line with one of the through member's needs none: that one goes on as it is.
    """
    asked = branch.row.diaphragms
    if asked == "none":
        return (), ()
    names = FLANGES + WEBS if asked == "flanges and webs" else FLANGES
    in_line = {step.face for step in branch.steps if step.in_line and not step.on}
    plates = [
        _plate(other, branch, index)
        for index, strip in enumerate(other.law.strips)
        if strip.face in names and strip.face not in in_line
    ]
    made: dict[str, tuple[_Plate, Outline]] = {}
    findings: list[Finding] = []
    webs: dict[str, _Plate] = {}
    # The flanges stop at the webs that are there.
    for plate in sorted(plates, key=lambda own: own.strip.face in FLANGES):
        face = plate.strip.face
        outline, fault = _outline(node, through, other, branch, plate, webs, rules)
        findings += fault
        if outline is not None:
            made[face] = plate, outline
            if face not in FLANGES:
                webs[face] = plate
    beside = {role(node, face, other.name): own.plane for face, own in webs.items()}
    flats, holes = [], {}
    for plate in plates:
        face = plate.strip.face
        if face not in made:
            continue
        _, outline = made[face]
        contour, starts = sniped(outline, rules.snipe)
        hole = None
        if face not in FLANGES and outline.closes:
            hole = _hole(plate, contour, made, rules)
            holes[face] = hole
        fits = side_fits(
            plate.plane, branch.faces, outline, plate.thickness, rules.wall_gap, beside
        )
        flats.append(_flat(node, through, branch, plate, outline, contour, starts, fits, hole))
    findings += _access(node, through, branch, holes, rules)
    return tuple(flats), tuple(findings)


def _plate(other: Member, branch: Branch, index: int) -> _Plate:
    cell = other.law.cell_at(branch.s)
    edges = landing_edges(other, branch, index)
    return _Plate(
        other.law.strips[index],
        float(cell.thickness[index]),
        cell.materials[index],
        edges,
        plane_of(edges, branch),
    )


def role(node: str, face: str, other: str) -> str:
    """What names a diaphragm of a node among the flat parts of a member."""
    return f"{face} of {other} at {node}"


def _outline(
    node, through, other, branch: Branch, plate: _Plate, webs, rules
) -> tuple[Outline | None, list[Finding]]:
    """The outline of a diaphragm, or None, and warnings of one without room."""
    face = plate.strip.face
    plane, faces = plate.plane, branch.faces
    name = f"{node}, {face} of {other.name}"
    depths = {k: wall + rules.wall_gap for k, wall in enumerate(faces.walls)}
    free = []
    if face in FLANGES:
        for edge, line in zip(plate.strip.edges, edge_lines(plane, plate.edges), strict=True):
            side = None
            if edge in webs:
                clear = 0.5 * webs[edge].thickness + rules.wall_gap
                stop = clear_of(plane, webs[edge].plane, clear)
                if stop is not None:
                    side, line = role(node, edge, other.name), stop
            free.append((side, line))
        # The first edge has the plate on its left, seen along +x, the second on its right.
        (one, low), (two, high) = free
        free = [(one, low), (two, high[::-1])]
    outline = fitted(plane, faces, depths, free, plate.thickness)
    if outline is None and face not in FLANGES:
        # A web whose plane runs along the box does not close it: it goes on as broad as it is.
        low, high = edge_lines(plane, plate.edges)
        free = [(None, low), (None, high[::-1])]
        outline = fitted(plane, faces, depths, free, plate.thickness)
    if outline is None:
        return None, [_no_room(name, through, branch, 0.0, rules)]
    sine, wall = slant(plane, faces, outline)
    if sine < math.sin(rules.least_angle):
        return None, [_too_flat(name, through, branch, sine, wall, rules)]
    room = room_beside(plane, faces, outline, plate.thickness)
    faults = [_no_room(name, through, branch, room, rules)] if room < rules.access else []
    return outline, faults


def _hole(plate: _Plate, contour: np.ndarray, made, rules) -> tuple[np.ndarray, float] | None:
    """The manhole of a diaphragm that closes the box, clear of the flanges that land on it."""
    lines = []
    for flange, _ in made.values():
        if flange.strip.face in FLANGES:
            found = plate.plane.line_of(flange.plane)
            if found is not None:
                point, normal, sine = found
                lines.append((point, normal, 0.5 * flange.thickness / sine))
    corners = contour[:, :2]
    low, high = corners.min(axis=0), corners.max(axis=0)
    wanted = max(rules.manhole, MANHOLE * float((high - low).min()))
    return manhole(corners, lines, rules.manhole_edge, wanted)


def _access(node: str, through: Member, branch: Branch, holes, rules) -> list[Finding]:
    """A warning where the manholes in a branch's diaphragms are no access."""
    sizes = {face: 0.0 if hole is None else hole[1] for face, hole in holes.items()}
    short = {face: size for face, size in sizes.items() if size < rules.manhole}
    if not short:
        return []
    least = min(short.values())
    edges = 2.0 * rules.manhole_edge
    return [
        warning(
            "node-manhole",
            through.name,
            f"the manhole in the diaphragms that continue {' and '.join(short)} of "
            f"{branch.member} is no access: it keeps {rules.manhole_edge:g} mm from edges and from "
            "plates that land on them",
            f"leave {up(rules.manhole + edges)} mm clear between the flanges of {branch.member}, "
            f"or between one and the wall, and between the walls of {through.name}, or set the "
            "diaphragms of the node to flanges",
            position=f"{node}, s = {branch.s_through:.0f} mm",
            value=least,
            limit=rules.manhole,
            unit="mm",
        )
    ]


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
                f"the diaphragm that continues the {flat.role.split()[0]} of {branch.member} "
                f"{what} one of another branch",
                "set the diaphragms of one branch to none and give one for both by sheet "
                "Diaphragms, or move the branches apart",
                position=f"{node}, s = {branch.s_through:.0f} mm",
                value=room,
                limit=rules.access,
                unit="mm",
            )
        )
    return kept, findings


def _flat(
    node: str, through: Member, branch: Branch, plate: _Plate, outline, contour, starts, fits, hole
) -> FlatPlate:
    """The part. Its sides on walls and on other diaphragms are welded."""
    holes, titles = (), ()
    if hole is not None:
        centre, diameter = hole
        left, right = centre - [0.5 * diameter, 0.0], centre + [0.5 * diameter, 0.0]
        holes = (np.array([[*left, 1.0], [*right, 1.0]]),)
        titles = (f"manhole D{diameter:.0f}",)
    return FlatPlate(
        through.name,
        "",
        "diaphragm",
        "D",
        1,
        plate.thickness,
        plate.material,
        plate.plane.frame,
        contour,
        branch.s_through,
        holes,
        titles,
        tuple(
            (branch.faces.names[side] if isinstance(side, int) else side, start)
            for side, start in zip(outline.sides, starts, strict=True)
            if side is not None
        ),
        tuple((start, *fit) for start, fit in zip(starts, fits, strict=True) if fit is not None),
        role=role(node, plate.strip.face, branch.member),
    )


def manhole_sizes(flats: Sequence[FlatPlate]) -> tuple[float, ...]:
    """Diameters, mm, of the manholes of diaphragms."""
    return tuple(
        float(np.hypot(*(hole[1, :2] - hole[0, :2]))) for flat in flats for hole in flat.holes
    )


def worst_access(findings: Sequence[Finding]) -> list[Finding]:
    """The findings of a node's diaphragms with one for all of them without room to be welded: the
    one that has least, with the places of all."""
    short = [own for own in findings if own.code == "node-diaphragm-access"]
    if len(short) < 2:
        return list(findings)
    least = min(short, key=lambda own: own.value)
    node, plate, place = least.position.split(", ", 2)
    plates = dict.fromkeys(own.position.split(", ")[1] for own in (least, *short))
    one = replace(least, position=f"{node}, {' and '.join(plates)}, {place}")
    return [one, *(own for own in findings if own not in short)]


def _too_flat(name: str, through: Member, branch: Branch, sine: float, wall: str, rules) -> Finding:
    return warning(
        "node-diaphragm-arris",
        through.name,
        f"the plane of the plate meets the {wall} wall at too small an angle to be welded: it does "
        "not go on inside",
        "turn the branch about its axis, or give the member a diaphragm by sheet Diaphragms",
        position=f"{name}, s = {branch.s_through:.0f} mm",
        value=math.degrees(math.asin(min(sine, 1.0))),
        limit=math.degrees(rules.least_angle),
        unit="deg",
    )


def _no_room(name: str, through: Member, branch: Branch, room: float, rules) -> Finding:
    return warning(
        "node-diaphragm-access",
        through.name,
        "there is no room to weld a diaphragm that continues a plate of the branch",
        f"align the branch flush, put that plate {up(rules.access - room)} mm or more farther "
        "inside, or set its diaphragms to none",
        position=f"{name}, s = {branch.s_through:.0f} mm",
        value=room,
        limit=rules.access,
        unit="mm",
    )
