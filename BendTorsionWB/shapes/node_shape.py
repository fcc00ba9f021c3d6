# SPDX-License-Identifier: LGPL-2.1-or-later
"""The root lines of a branch on the member that runs through, as wires."""

from __future__ import annotations

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.geometry.piecewise import Piecewise
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.nodes.node_branch import Branch
from BendTorsionWB.core.nodes.node_cut import landings

_ACROSS = np.linspace(0.0, 1.0, 9)


def root_lines(member: Member, branch: Branch) -> Part.Compound:
    """Where the outer faces of the branch's strips end, a polyline per strip and side."""
    wires = []
    for side in branch.sides:
        span = side.high - side.low + 100.0
        corners = member.corners(max(side.low - span, 0.0), min(side.high + span, member.length))
        for strip in member.law.strips:
            first, second = (
                corners.values[..., 3 * k : 3 * k + 3] for k in (strip.first, strip.second)
            )
            lines = np.concatenate([first + w * (second - first) for w in _ACROSS], axis=2)
            _, points = landings(
                side.cut, Piecewise(corners.breaks, lines), 0.5 * (side.low + side.high)
            )
            wires.append(Part.makePolygon([FreeCAD.Vector(*point) for point in points]))
    return Part.Compound(wires)
