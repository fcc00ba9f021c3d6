# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a node needs of its members: one that runs on through it, and stubs that reach outside."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..finding import Finding, error
from .node_branch import Branch

SHORTEST_STUB = 100.0
"""mm from the far end of a stub's cut to its field joint: room for both welds."""


def through_findings(landing: Branch, branches: Sequence[Branch]) -> list[Finding]:
    """An error of a branch that lands on a member where that member is itself cut by a node."""
    through = landing.through
    low, high = landing.seat
    cut = [own for own in branches if own.member == through]
    ends_on = [own.through for own in cut if own.cut_range[0] < high and low < own.cut_range[1]]
    return [
        error(
            "node-three-through",
            landing.member,
            f"{landing.member} ends on {through} where {through} itself ends on {other}: "
            "nothing runs through there",
            "let one member run through for all that meet there, by ranks or rows of sheet Nodes",
            position=landing.place,
        )
        for other in ends_on[:1]
    ]


def stub_places(branch: Branch) -> tuple[float, ...]:
    """Places of the field joints of a branch's stubs on its axis, mm."""
    return tuple(branch.s_node + side.way * branch.row.stub_length for side in branch.sides)


def stub_limits(
    branch: Branch, length: float, others: Sequence[Branch] = ()
) -> tuple[float, float]:
    """The shortest and the longest a branch's stubs can be, mm, as `stub_findings` counts them."""
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
    return (
        10.0 * math.ceil((reach + SHORTEST_STUB) / 10.0),
        10.0 * math.floor((room - SHORTEST_STUB) / 10.0),
    )


def stub_findings(branch: Branch, length: float, others: Sequence[Branch]) -> list[Finding]:
    """Errors of stubs whose field joint lies within the through member or too near to it, or too
    near to the branch's end or its next node. length: of the branch's axis, mm; others: the same
    member at its other nodes."""
    if branch.row.type != "stub":
        return []
    given = branch.row.stub_length
    least, most = stub_limits(branch, length, others)
    short = given < least
    if not short and given <= most:
        return []
    mend = f"make the stub {least:.0f} mm or more"
    return [
        error(
            "node-stub-short" if short else "node-stub-long",
            branch.member,
            f"the field joint of the stub on {branch.through} is within {SHORTEST_STUB:g} mm of "
            + ("its cut" if short else "the end of the branch or its next node"),
            mend if short else f"make the stub {most:.0f} mm or less, or the node direct",
            position=branch.place,
            value=given,
            limit=least if short else most,
            unit="mm",
        )
    ]
