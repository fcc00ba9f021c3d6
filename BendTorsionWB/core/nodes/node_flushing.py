# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much a branch is lifted and turned before a node to land flush."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..finding import Finding, warning
from ..geometry.vectors import crossed
from ..members.member import Member
from .node_blend import Blend, blend_of, with_blends
from .node_branch import Branch
from .node_flush import flange_steps

FLUSH = 1e-7
"""mm: steps left by a blend."""
_STEPS = 8


def blended(
    node: str,
    through: Member,
    other: Member,
    branch: Branch,
    again: Callable[[Member], Branch | None],
) -> tuple[Branch, tuple[Finding, ...]]:
    """The branch with the blends that bring the steps of its first face in line to nothing, on
    both its edges and each of its sides; again: the branch of a member that has been blended.

    A warning and no blend where no face is in line with one of the through member's.
    """
    faces = {}
    for side in branch.sides:
        own = [s for s in branch.steps if s.way == side.way and not s.on]
        in_line = [s.face for s in own if s.in_line]
        # Both edges: a blend lifts and turns the face as a whole.
        in_line = [face for face in in_line if sum(s.face == face for s in own) == 2]
        if in_line:
            faces[side.way] = in_line[0]
    if not faces:
        return branch, (
            warning(
                "node-blend-nothing",
                branch.member,
                "no flange of the branch is in line with one of the through member's",
                "align the branch with its top or its bottom, or do not blend the node",
                position=f"{node}, s = {branch.s:.0f} mm",
            ),
        )
    blends = {side.way: _start(node, other, branch, side.way) for side in branch.sides}
    blends = {way: blend for way, blend in blends.items() if way in faces}
    made, member = branch, other
    for _ in range(_STEPS):
        steps = flange_steps(through, member, made)
        worst = 0.0
        for way, face in faces.items():
            own = [s for s in steps if s.way == way and s.face == face]
            worst = max(worst, *(abs(s.step) for s in own))
            lift, roll = _correction(through, member, made, way, face, own)
            blends[way] = replace(
                blends[way], lift=blends[way].lift + lift, roll=blends[way].roll + roll
            )
        if worst < FLUSH:
            break
        member = with_blends(other, tuple(blends.values()))
        found = again(member)
        if found is None:
            break
        made = found
    return replace(made, blends=tuple(blends.values())), ()


def _start(node: str, other: Member, branch: Branch, way: int) -> Blend:
    own = next(side for side in branch.sides if side.way == way)
    opposite = [side for side in branch.sides if side.way != way]
    far = None
    if opposite:
        far = opposite[0].low if opposite[0].way > 0 else opposite[0].high
    cell = other.law.cell_at(own.low)
    height = float(np.ptp(cell.corners_at(np.array([0.5 * (own.low + own.high)]))[0, :, 1]))
    return blend_of(node, way, (own.low, own.high), far, height)


def _correction(through, member: Member, branch: Branch, way: int, face: str, own):
    """Lift, mm, and roll, rad, that would close the steps of a face's two edges."""
    side = next(s for s in branch.sides if s.way == way)
    strip = next(s for s in member.law.strips if s.face == face)
    names = list(strip.edges)
    s = np.array([0.5 * (side.low + side.high)])
    at = member.frames.at(s)
    plane = member.law.cell_at(s[0]).corners_at(s)[0]
    faces = side.cut.main.faces
    _, up, _ = faces.plane(faces.names.index(own[0].through_face), branch.s_through)
    rows, right = [], []
    for edge, corner in zip(names, (strip.first, strip.second), strict=True):
        arm = plane[corner, 0] * at.y[0] + plane[corner, 1] * at.z[0]
        rows.append([float((own * up).sum()) for own in (at.z[0], crossed(at.x[0], arm))])
        right.append(-next(step.step for step in own if step.edge == edge))
    (a, b), (c, d) = rows
    below = a * d - b * c
    return (d * right[0] - b * right[1]) / below, (a * right[1] - c * right[0]) / below
