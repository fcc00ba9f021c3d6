# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meetings of members that errors leave no node, as records for tables."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from ..finding import Finding
from ..members.member import Member
from .node_input import NodeInput, NodeRules
from .node_landing import crossing_angle
from .node_meetings import Meeting
from .node_record import NodeRecord


def unmade_record(
    meeting: Meeting,
    chosen: NodeInput | None,
    faults: Sequence[Finding],
    made: Collection[tuple[str, str, float]],
    findings: Sequence[Finding],
    members: Mapping[str, Member],
    rules: NodeRules,
) -> NodeRecord | None:
    """The record of a meeting without a node, with the code of the first error as its status; None
    where there is a node, or no error. chosen: what says which member runs through, or None, when
    they are in the order of `members`. faults: of the meeting alone. made: of every branch at a
    node the member that runs through, its own and its place."""
    order = list(members)
    ends = [
        (meeting.one, meeting.at.first, meeting.at.first_point),
        (meeting.other, meeting.at.second, meeting.at.second_point),
    ]
    first = meeting.one if chosen is None else chosen.through
    if chosen is None and order.index(meeting.other) < order.index(meeting.one):
        first = meeting.other
    ends.sort(key=lambda end: end[0] != first)
    (through, s, point), (other, t, _) = ends
    if (through, other, t) in made:
        return None
    errors = [f for f in findings if f.severity == "error"]
    own = [f for f in faults if f in errors]
    own += [f for f in errors if other in f.objects and _is_at(f, through)]
    if not own:
        return None
    row = chosen or NodeInput(through, other, type="")
    return NodeRecord(
        row.name,
        "",
        through,
        other,
        s,
        t,
        *(float(value) for value in point),
        crossing_angle(members[through], members[other], s, t),
        meeting.at.distance,
        row.type,
        rules.gap if row.gap is None else row.gap,
        row.stub_length,
        (),
        (),
        0,
        status=own[0].code,
    )


def _is_at(finding: Finding, through: str) -> bool:
    return through in finding.objects or finding.position.endswith(f" of {through}")
