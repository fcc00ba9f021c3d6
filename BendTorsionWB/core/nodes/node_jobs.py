# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes between the members of a project's jobs: found once, then given to every job they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..detailing import MemberJob, axis_of, member_of
from ..finding import BendTorsionError, Finding
from ..members.member import Member
from .node_input import NodeInput, NodeRules
from .node_members import node_records, nodes_of_member
from .node_record import NodeRecord
from .nodes import Found, find_nodes, unresolved


def jobs_with_nodes(
    jobs: Mapping[str, MemberJob],
    ranks: Mapping[str, int | None],
    rows: Sequence[NodeInput],
    rules: NodeRules,
) -> tuple[dict[str, MemberJob], Found]:
    """The jobs with what nodes do to each member, and all nodes. Members that cannot be built are
    left out: what is wrong with them is found when their job is done."""
    members: dict[str, Member] = {}
    for name, job in jobs.items():
        try:
            members[name] = member_of(
                job.member, axis_of(job.axis, job.surface), job.surface
            ).member
        except BendTorsionError:
            continue
    found = find_nodes(members, ranks, rows, rules)
    return {
        name: _with(job, found, members[name]) if name in members else job
        for name, job in jobs.items()
    }, found


def all_records(
    found: Found, findings: Sequence[Finding], members: Mapping[str, Member], order: Sequence[str]
) -> tuple[NodeRecord, ...]:
    """The records of `node_records` that take in a member of `order`, with those of crossings only
    their solids told: of errors that nothing says which member runs through."""
    more: list[NodeRecord] = []
    for pair in dict.fromkeys(f.objects for f in findings if f.code == "node-unresolved"):
        if frozenset(pair) not in found.met and all(name in members for name in pair):
            more += unresolved({name: members[name] for name in pair}).unmade
    made = node_records(replace(found, unmade=(*found.unmade, *more)), order)
    return tuple(own for own in made if own.through in order or own.other in order)


def _with(job: MemberJob, found: Found, member: Member) -> MemberJob:
    nodes = nodes_of_member(found.nodes, member.name, member.length)
    plates = replace(job.plates, nodes=nodes.places)
    return replace(job, plates=plates, nodes=nodes, meets=found.of(member.name))
