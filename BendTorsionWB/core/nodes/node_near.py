# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members that nearly touch: told where they are there, and not where a node has cut them away."""

from __future__ import annotations

from collections.abc import Sequence

from ..finding import BETWEEN, Finding, warning
from .node_beside import branches_met
from .node_branch import Branch, up
from .node_input import NodeRules
from .node_meetings import Meeting, nearly


def near_findings(
    near: Sequence[tuple[Meeting, float]], branches: Sequence[Branch], rules: NodeRules
) -> list[Finding]:
    """A warning for each approach of two members nearer than `near`. Of two branches that approach
    within the member both end on, one only where they land so near to each other that the welds
    between them cannot be reached."""
    findings = []
    for meeting, apart in near:
        both = branches_met(meeting, branches)
        if both is None:
            findings.append(nearly(meeting, apart, rules))
            continue
        one, other = both
        through = one.through
        room = max(one.seat[0] - other.seat[1], other.seat[0] - one.seat[1])
        if set(one.sides[0].faces).isdisjoint(other.sides[0].faces) or room >= rules.access:
            continue
        findings.append(
            warning(
                "node-branches-near",
                BETWEEN.join((one.member, other.member)),
                f"{one.member} and {other.member} land so near to each other on {through} that "
                "the welds that face each other cannot be reached",
                f"move one of them {up(rules.access - room)} mm or more away along {through}, or "
                "weld the first all round before the second is set",
                position=one.place,
                value=room,
                limit=rules.access,
                unit="mm",
            )
        )
    # Where two run side by side, what is to be done at the node is done along them.
    side_by_side = {own.objects for own in findings if own.code == "node-branches-near"}
    return [
        own
        for own in findings
        if own.code == "node-branches-near" or own.objects not in side_by_side
    ]
