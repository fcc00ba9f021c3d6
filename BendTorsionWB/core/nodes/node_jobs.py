# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes between the members of a project's jobs: found once, then given to every job they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..detailing import MemberJob, axis_of, member_of
from ..finding import BendTorsionError
from ..members.member import Member
from .node_input import NodeInput, NodeRules
from .node_members import nodes_of_member
from .nodes import Found, find_nodes


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


def _with(job: MemberJob, found: Found, member: Member) -> MemberJob:
    nodes = nodes_of_member(found.nodes, member.name, member.length)
    plates = replace(job.plates, nodes=nodes.places)
    return replace(job, plates=plates, nodes=nodes, meets=found.of(member.name))
