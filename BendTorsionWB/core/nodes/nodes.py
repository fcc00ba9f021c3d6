# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes: where members meet, which of them runs through, and what cannot be a node."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import Finding, error
from ..members.member import Member
from .node_beside import Beside, both_pass, branches_met, cut_beside
from .node_blend import with_blends
from .node_branch import Branch, branch_at
from .node_circle import circles
from .node_diaphragms import node_diaphragms, side_by_side, worst_access
from .node_flush import flange_steps, flush_findings
from .node_flushing import blended
from .node_input import NodeInput, NodeRules
from .node_meetings import Meeting, meetings_of, places_of, resolved, unfit
from .node_near import near_findings
from .node_reach import stub_findings, through_findings
from .node_record import NodeRecord
from .node_unmade import unmade_record

DEFAULT_RULES = NodeRules()


@dataclass(frozen=True, eq=False)
class Node:
    """A node: name, the member that runs through and where (s, mm), the point (3,) on its axis,
    kind (`crossing`, `T`, `Y`, `K` or `corner`) and its branches."""

    name: str
    kind: str
    through: str
    s: float
    point: np.ndarray
    branches: tuple[Branch, ...]

    @property
    def members(self) -> tuple[str, ...]:
        """The member that runs through, then the branches."""
        return self.through, *(branch.member for branch in self.branches)


@dataclass(frozen=True, eq=False)
class Found:
    """All nodes of a project in order, what was found on the way, the pairs of members that
    meet, at a node or in error, and the records of meetings that errors leave no node."""

    nodes: tuple[Node, ...] = ()
    findings: tuple[Finding, ...] = ()
    met: frozenset[frozenset[str]] = frozenset()
    unmade: tuple[NodeRecord, ...] = ()

    def of(self, member: str) -> tuple[Node, ...]:
        """The nodes a member takes part in."""
        return tuple(node for node in self.nodes if member in node.members)


def find_nodes(
    members: Mapping[str, Member],
    ranks: Mapping[str, int | None],
    rows: Sequence[NodeInput] = (),
    rules: NodeRules = DEFAULT_RULES,
) -> Found:
    """The nodes of all members.

    Two members whose solids meet make a node; the one a row names, else the one of lower rank
    runs through (one without a rank ends at one that has one). Nodes are named by their row or
    N1, N2 … by the order of the members and the place on the member that runs through. Errors
    name both members; what has an error is no node.
    """
    meetings, near = meetings_of(members, rules)
    findings: list[Finding] = []
    lengths = {name: member.length for name, member in members.items()}
    used: set[int] = set()
    made: list[tuple[Meeting, NodeInput | None, Branch | None, list[Finding]]] = []
    for meeting in meetings:
        chosen, index, faults = resolved(meeting, ranks, rows, meetings, lengths)
        branch = None
        if index is not None:
            used.add(index)
        if chosen is not None:
            faults = unfit(meeting, chosen, members, rules)
        if chosen is not None and not faults:
            through, other = members[chosen.through], members[chosen.other]
            branch, faults = branch_at(through, other, *places_of(meeting, chosen), chosen, rules)
        made.append((meeting, chosen, branch, faults))
    ending = [b for _, _, b, _ in made if b]
    # Those that go round beside a member all end on have a node there.
    apart = [(m, c) for m, c, _, _ in made if c and not branches_met(m, ending)]
    in_circles, rounds = circles(apart, members)
    findings += rounds
    made = [
        (meeting, chosen, None, []) if meeting in in_circles else (meeting, chosen, branch, faults)
        for meeting, chosen, branch, faults in made
    ]
    ending = [b for _, _, b, _ in made if b]
    findings += near_findings(near, ending, rules)
    branches: list[Branch] = []
    pairs: list[Beside] = []
    lost: set[Branch] = set()
    for meeting, chosen, branch, faults in made:
        met = branches_met(meeting, ending)
        if met:
            if all(len(own.sides) == 2 for own in met):
                findings += both_pass(*met)
                lost.update(met)
            else:
                pairs.append(Beside(*met, chosen))
            continue
        findings += faults
        if branch is not None:
            branches.append(branch)
    findings += [
        error(
            "node-not-found",
            row.name or f"{row.through} {row.other}",
            f"{row.through} and {row.other} do not meet"
            + (
                ""
                if row.s is None
                else f" near s = {row.place(lengths.get(row.through, 1.0)):.0f} mm of {row.through}"
            ),
            "choose members that meet, or leave the node out",
            position=f"row {index + 1}",
        )
        for index, row in enumerate(rows)
        if index not in used and not _in_error(row, findings)
    ]
    for branch in branches:
        alike = [own for own in branches if own.member == branch.member and own is not branch]
        faults = through_findings(branch, branches)
        faults += stub_findings(branch, lengths[branch.member], alike)
        findings += faults
        if faults:
            lost.add(branch)
    branches = [branch for branch in branches if branch not in lost]
    named = _named(_grouped(branches, members, rules), list(members))
    nodes = [_detailed(node, members, rules, pairs, findings) for node in named]
    nodes = [node for node in nodes if node.branches]
    met = frozenset(frozenset((m.one, m.other)) for m in meetings)
    made_of = {(node.through, b.member, b.s) for node in nodes for b in node.branches}
    unmade = [
        unmade_record(meeting, chosen, faults, made_of, findings, members, rules)
        for meeting, chosen, _, faults in made
    ]
    found = tuple(dict.fromkeys(findings))
    return Found(tuple(nodes), found, met, tuple(own for own in unmade if own))


def unresolved(members: Mapping[str, Member]) -> Found:
    """The crossings of members that nothing is said about, as errors and records of no node."""
    found = find_nodes(members, {})
    errors = tuple(f for f in found.findings if f.code == "node-unresolved")
    return Found((), errors, found.met, found.unmade)


def _in_error(row: NodeInput, findings: Sequence[Finding]) -> bool:
    names = {row.through, row.other}
    return any(not names.isdisjoint(f.objects) for f in findings if f.severity == "error")


def _detailed(
    node: Node,
    members: Mapping[str, Member],
    rules: NodeRules,
    pairs: Sequence[Beside],
    findings: list[Finding],
) -> Node:
    """The node with its branches cut at each other, with their steps and diaphragms."""
    through, branches = members[node.through], []
    inside: list[Finding] = []
    cut, faults = cut_beside(through, node.branches, members, pairs, node.name, rules)
    findings += faults
    for branch in cut:
        other = members[branch.member]
        branch = replace(branch, steps=flange_steps(through, other, branch))
        if branch.row.blend:

            def again(member: Member, own: Branch = branch) -> Branch | None:
                found, _ = branch_at(
                    through, member, own.s_through, own.s, own.row, rules, own.against
                )
                return found and found.at_node(node.name)

            branch, faults = blended(node.name, through, other, branch, again)
            findings += faults
            other = with_blends(other, branch.blends)
            branch = replace(branch, steps=flange_steps(through, other, branch))
        findings += flush_findings(node.name, node.through, branch, rules)
        made, faults = node_diaphragms(node.name, through, other, branch, rules)
        inside += faults
        limits = (rules.flange_step, rules.flange_angle)
        branches.append(replace(branch, diaphragms=made, limits=limits))
    findings += worst_access(inside)
    flats, faults = side_by_side(
        node.name, through, [(own, flat) for own in branches for flat in own.diaphragms], rules
    )
    findings += faults
    return replace(
        node,
        branches=tuple(
            replace(own, diaphragms=tuple(flat for one, flat in flats if one is own))
            for own in branches
        ),
    )


def _grouped(
    branches: Sequence[Branch], members: Mapping[str, Member], rules: NodeRules
) -> list[Node]:
    """Branches of one through member whose seats overlap or all but touch make one node."""
    groups: list[list[Branch]] = []
    for branch in sorted(branches, key=lambda b: (b.through, b.s_through, b.member)):
        last = groups[-1] if groups else None
        edge = max(b.seat[1] for b in last) + rules.same if last else 0.0
        if last and last[-1].through == branch.through and branch.seat[0] < edge:
            last.append(branch)
        else:
            groups.append([branch])
    nodes = []
    for own in groups:
        through = own[0].through
        names = sorted({b.row.name for b in own if b.row.name})
        s = float(np.mean([b.s_through for b in own]))
        point = members[through].frames.axis.position(np.array([s]))[0]
        nodes.append(Node(names[0] if names else "", _kind(own), through, s, point, tuple(own)))
    return nodes


def _kind(branches: Sequence[Branch]) -> str:
    ending = [branch for branch in branches if len(branch.sides) == 1]
    if len(ending) < len(branches):
        return "crossing"
    if any(branch.at_corner for branch in branches):
        return "corner"
    if len(branches) > 1:
        return "K"
    return "T" if branches[0].angle > math.radians(75.0) else "Y"


def _named(nodes: Sequence[Node], order: Sequence[str]) -> list[Node]:
    nodes = sorted(nodes, key=lambda n: (order.index(n.through), n.s))
    taken = {node.name for node in nodes if node.name}
    free = (name for k in range(1, 10 * len(nodes) + 10) if (name := f"N{k}") not in taken)
    named = [replace(node, name=node.name or next(free)) for node in nodes]
    return [
        replace(node, branches=tuple(b.at_node(node.name) for b in node.branches)) for node in named
    ]
