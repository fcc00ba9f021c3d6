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


def stub_findings(through: str, branch: Branch) -> list[Finding]:
    """Errors of stubs whose field joint lies within the through member or too near to it."""
    if branch.row.type != "stub":
        return []
    reach = max(
        side.high - branch.s if side.way > 0 else branch.s - side.low for side in branch.sides
    )
    least = 10.0 * math.ceil((reach + SHORTEST_STUB) / 10.0)
    if branch.row.stub_length >= least:
        return []
    return [
        error(
            "node-stub-short",
            branch.member,
            f"the field joint of the stub on {through} is within {SHORTEST_STUB:g} mm of its cut",
            f"make stub_length {least:.0f} mm or more",
            position=f"s = {branch.s_through:.0f} mm of {through}",
            value=branch.row.stub_length,
            limit=least,
            unit="mm",
        )
    ]
