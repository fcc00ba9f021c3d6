# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a node needs of its members: one that runs on through it, and stubs that reach outside."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..finding import Finding, error
from .node_branch import Branch

SHORTEST_STUB = 100.0
"""mm from the far end of a stub's cut to its field joint: room for both welds."""


def through_findings(branches: Sequence[tuple[str, Branch]]) -> list[Finding]:
    """An error for each branch that lands on a member where that member is itself cut by a node.
    branches: with the member that runs through."""
    return [
        error(
            "node-three-through",
            branch.member,
            f"{branch.member} ends on {through} where {through} itself ends on {other}: "
            "nothing runs through there",
            "let one member run through for all that meet there, by ranks or rows of sheet Nodes",
            position=f"s = {branch.s_through:.0f} mm of {through}",
        )
        for through, branch in branches
        if (other := _cut_there(branches, through, branch)) is not None
    ]


def _cut_there(branches: Sequence[tuple[str, Branch]], name: str, landing: Branch) -> str | None:
    """The member that `name` ends on over the stretch of its axis another one lands on."""
    low = min(side.seat[0] for side in landing.sides)
    high = max(side.seat[1] for side in landing.sides)
    for through, branch in branches:
        if branch.member == name:
            start, end = branch.cut_range
            if start < high and low < end:
                return through
    return None


def stub_places(branch: Branch) -> tuple[float, ...]:
    """Places of the field joints of a branch's stubs on its axis, mm."""
    return tuple(branch.s_node + side.way * branch.row.stub_length for side in branch.sides)


def stub_findings(
    through: str, branch: Branch, length: float, others: Sequence[Branch]
) -> list[Finding]:
    """Errors of stubs whose field joint lies within the through member or too near to it, or too
    near to the branch's end or its next node. length: of the branch's axis, mm; others: the same
    member at its other nodes."""
    if branch.row.type != "stub":
        return []
    reach = max(
        side.high - branch.s_node if side.way > 0 else branch.s_node - side.low
        for side in branch.sides
    )
    ends = [0.0, length]
    for other in others:
        ends += [place for side in other.sides for place in (side.low, side.high)]
        ends += stub_places(other) if other.row.type == "stub" else ()
    room = min(
        side.way * (end - branch.s_node)
        for side in branch.sides
        for end in ends
        if side.way * (end - 0.5 * (side.low + side.high)) > 0.0
    )
    given = branch.row.stub_length
    least = 10.0 * math.ceil((reach + SHORTEST_STUB) / 10.0)
    most = 10.0 * math.floor((room - SHORTEST_STUB) / 10.0)
    short = given < least
    if not short and given <= most:
        return []
    mend = f"make stub_length {least:.0f} mm or more"
    return [
        error(
            "node-stub-short" if short else "node-stub-long",
            branch.member,
            f"the field joint of the stub on {through} is within {SHORTEST_STUB:g} mm of "
            + ("its cut" if short else "the end of the branch or its next node"),
            mend if short else f"make stub_length {most:.0f} mm or less, or the node direct",
            position=f"s = {branch.s_through:.0f} mm of {through}",
            value=given,
            limit=least if short else most,
            unit="mm",
        )
    ]
