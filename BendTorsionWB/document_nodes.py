# SPDX-License-Identifier: LGPL-2.1-or-later
"""The nodes of a document as records, with the meetings that errors leave no node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.nodes.node_record import NodeRecord, in_order
from BendTorsionWB.core.nodes.nodes import unresolved
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import node as node_object


def nodes_told(
    nodes: Iterable,
    members: Mapping[str, Member],
    records: Mapping[str, MemberRecord],
    findings: Iterable[Finding],
) -> tuple[NodeRecord, ...] | None:
    """The nodes of the records, and one for each Node in error and each crossing without a Node,
    with the code of its error; None where there is neither. members: those without errors of their
    own, by name."""
    more: list[NodeRecord] = []
    for obj in nodes:
        try:
            node_object.value(obj)
        except BendTorsionError as problem:
            more += _unmade(obj, problem)
    told = {frozenset((own.through, own.other)) for own in more}
    for pair in dict.fromkeys(f.objects for f in findings if f.code == "node-unresolved"):
        if len(pair) == 2 and frozenset(pair) not in told and all(n in members for n in pair):
            more += unresolved({name: members[name] for name in pair}).unmade
    if not more:
        return None
    own = [node for record in records.values() for node in record.nodes]
    return tuple(in_order([*own, *more], list(records)))


def _unmade(obj, problem: BendTorsionError) -> list[NodeRecord]:
    """The meeting a Node in error is at, nearest to its place on the member that runs through;
    nothing of members that are in error or do not meet."""
    linked = [item for item in (obj.Through, obj.Other) if item is not None]
    try:
        members = {item.Label: member_object.value(item).member for item in linked}
    except BendTorsionError:
        return []
    meetings = unresolved(members).unmade if len(members) == 2 else ()
    found = sorted(meetings, key=lambda own: abs(own.s_through - obj.Place.Value))
    status = next((f.code for f in problem.findings if f.severity == "error"), "error")
    row = (obj.Type, obj.Gap.Value, obj.StubLength.Value)
    return [
        replace(own, node=obj.Node, status=status, type=row[0], gap=row[1], stub_length=row[2])
        for own in found[:1]
    ]
