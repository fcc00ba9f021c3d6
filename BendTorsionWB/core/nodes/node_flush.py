# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flushness at a node: steps and angles from a branch's outer faces to those of what it lands on,
at each corner the through member or another branch."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from ..finding import Finding, warning
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member
from .node_branch import Branch
from .node_cut import landings
from .node_faces import OuterFaces
from .node_input import NodeRules
from .node_landing import Side
from .node_record import FlangeStep

ALIKE = 0.9
"""Least cosine between the normals of faces that are compared."""


def flange_steps(through: Member, other: Member, branch: Branch) -> tuple[FlangeStep, ...]:
    """Of every face of the branch that looks the way of a face it does not land on, both edges."""
    return tuple(step for side in branch.sides for step in _of_side(through.name, other, side))


def _of_side(through: str, other: Member, side: Side) -> list[FlangeStep]:
    corners = other.corners(*side.about(other.length))
    near = 0.5 * (side.low + side.high)
    parts, found = side.cut.parts, []
    for strip in other.law.strips:
        pair = np.concatenate(
            [corners.values[..., 3 * k : 3 * k + 3] for k in (strip.first, strip.second)], axis=2
        )
        rails = Piecewise(corners.breaks, pair)
        s, points = landings(side.cut, rails, near)
        normals = _normals(rails, s, strip.inward)
        beside: list[tuple[OuterFaces, int, float, float] | None] = []
        for k, part in enumerate(side.cut.part_at(points)):
            faces = parts[part].faces
            landing = {f for own in parts if own.faces is faces for f in own.landing}
            beside.append(_beside(faces, landing, points[k : k + 1], normals[k]))
        for edge, own in zip(strip.edges, beside, strict=True):
            if own is None:
                continue
            faces, face, step, angle = own
            # In line is a plate that is so at every edge that lands on the same face.
            alike = [b[2] for b in beside if b and b[0] is faces and b[1] == face]
            on = "" if faces.member == through else faces.member
            found.append(
                FlangeStep(
                    side.way,
                    strip.face,
                    f"{on} {faces.names[face]}".strip(),
                    edge,
                    step,
                    angle,
                    max(map(abs, alike)) < faces.walls[face],
                    on,
                )
            )
    return found


def _normals(rails: Piecewise, s: np.ndarray, inward: int) -> np.ndarray:
    """Outward unit normals (2, 3) of a strip's outer face on its first edge at s[0] and its second
    at s[1]."""
    value, rate = rails(s), rails.derivative(s)
    along = np.stack([rate[0, :3], rate[1, 3:]])
    normal = crossed(along, value[:, 3:] - value[:, :3]) * -inward
    return normal / np.sqrt((normal * normal).sum(axis=1))[:, None]


def _beside(
    faces: OuterFaces, landing: Collection[int], point: np.ndarray, normal: np.ndarray
) -> tuple[OuterFaces, int, float, float] | None:
    """The face, not landed on, that looks along a normal (3,), with the step, mm, from it to a
    corner (1, 3) and the angle, rad, between them."""
    for face in range(len(faces.names)):
        if face not in landing:
            step, up = faces.distance(face, point)
            cosine = float((normal * up[0]).sum())
            if cosine > ALIKE:
                return faces, face, float(step[0]), math.acos(min(cosine, 1.0))
    return None


def flush_findings(node: str, through: str, branch: Branch, rules: NodeRules) -> list[Finding]:
    """A warning for the largest step and the largest angle beyond the rules, of plates in line."""
    own = [step for step in branch.steps if step.in_line]
    findings = []
    for code, what, sizes, limit, unit, scale in (
        ("node-step", "step", [abs(s.step) for s in own], rules.flange_step, "mm", 1.0),
        (
            "node-flange-angle",
            "angle",
            [s.angle for s in own],
            rules.flange_angle,
            "deg",
            180.0 / math.pi,
        ),
    ):
        if not own or max(sizes) <= limit:
            continue
        worst = own[sizes.index(max(sizes))]
        findings.append(
            warning(
                code,
                branch.member,
                f"the {what} from face {worst.face} to that of {worst.on or through} is too large "
                f"at the {worst.edge} edge",
                "blend the node, align the branch, or turn it",
                position=f"{node}, s = {branch.s:.0f} mm",
                value=max(sizes) * scale,
                limit=limit * scale,
                unit=unit,
            )
        )
    return findings
