# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flushness at a node: steps and angles from a branch's outer faces to the through member's."""

from __future__ import annotations

import math

import numpy as np

from ..finding import Finding, warning
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member
from .node_branch import Branch, Side
from .node_cut import landings
from .node_faces import OuterFaces, wall_thickness
from .node_input import NodeRules
from .node_record import FlangeStep

ALIKE = 0.9
"""Least cosine between the normals of faces that are compared."""


def flange_steps(through: Member, other: Member, branch: Branch) -> tuple[FlangeStep, ...]:
    """Of every face of the branch that looks the way of a face it does not land on, both edges."""
    return tuple(
        step for side in branch.sides for step in _of_side(through, other, side, branch.s_through)
    )


def _of_side(through: Member, other: Member, side: Side, s_through: float) -> list[FlangeStep]:
    span = side.high - side.low + 100.0
    corners = other.corners(max(side.low - span, 0.0), min(side.high + span, other.length))
    near = 0.5 * (side.low + side.high)
    faces, found = side.cut.main.faces, []
    thickness = wall_thickness(through, s_through)
    for strip in other.law.strips:
        pair = np.concatenate(
            [corners.values[..., 3 * k : 3 * k + 3] for k in (strip.first, strip.second)], axis=2
        )
        rails = Piecewise(corners.breaks, pair)
        s, points = landings(side.cut, rails, near)
        normals = _normals(rails, s, strip.inward)
        face = _alike(faces, side, s_through, normals.mean(axis=0))
        if face is None:
            continue
        step, up = faces.distance(face, points)
        cosine = (normals * up).sum(axis=1).clip(-1.0, 1.0)
        for k, edge in enumerate(strip.edges):
            found.append(
                FlangeStep(
                    side.way,
                    strip.face,
                    faces.names[face],
                    edge,
                    float(step[k]),
                    math.acos(float(cosine[k])),
                    bool(np.abs(step).max() < thickness[faces.names[face]]),
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


def _alike(faces: OuterFaces, side: Side, s: float, normal: np.ndarray) -> int | None:
    """The face, not landed on, that looks along the normal."""
    for face in range(len(faces.names)):
        if face not in side.cut.main.landing and float(faces.plane(face, s)[1] @ normal) > ALIKE:
            return face
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
                f"the {what} from face {worst.face} to that of {through} is too large at the "
                f"{worst.edge} edge",
                "blend the node, align the branch, or turn it",
                position=f"{node}, s = {branch.s:.0f} mm",
                value=max(sizes) * scale,
                limit=limit * scale,
                unit=unit,
            )
        )
    return findings
