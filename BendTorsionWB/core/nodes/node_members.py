# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the nodes of a project do to one member: what they take, where joints keep clear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import BendTorsionError, error
from ..members.member import Member, MemberEnd, MemberGap
from ..plates.flat_plate import FlatPlate
from ..plates.flat_room import separation
from .node_blend import Blend, check_blends, with_blends
from .node_branch import Branch
from .node_diaphragms import manhole_sizes
from .node_reach import stub_places
from .node_record import NodeRecord, in_order
from .nodes import Found, Node

PLACES_APART = 100.0
"""mm: places joints keep clear of lie no farther apart over the seat of a node."""


@dataclass(frozen=True, eq=False)
class MemberNodes:
    """What nodes do to a member: gaps, rising; places joints keep clear of; places of the field
    joints behind stubs, mm on its axis; diaphragms put inside it, along its axis; records
    of the nodes it ends on others at; blends of its sections before them."""

    gaps: tuple[MemberGap, ...] = ()
    places: tuple[float, ...] = ()
    stubs: tuple[float, ...] = ()
    diaphragms: tuple[FlatPlate, ...] = ()
    records: tuple[NodeRecord, ...] = ()
    blends: tuple[Blend, ...] = ()


def nodes_of_member(nodes: tuple[Node, ...], member: str, length: float) -> MemberNodes:
    """Of all nodes, what they do to the member of this name and axis length."""
    gaps, places, stubs, flats, records, blends = [], [], [], [], [], []
    for node in nodes:
        for branch in node.branches:
            if node.through == member:
                low, high = branch.seat
                count = 2 + int((high - low) / PLACES_APART)
                places += np.linspace(low, high, count).tolist()
                flats += branch.diaphragms
            if branch.member != member:
                continue
            gap = _gap(branch, length)
            gaps.append(gap)
            records.append(_record(node, branch))
            blends += branch.blends
            for end in (gap.before, gap.behind):
                if end is not None:
                    places += [end.least, end.greatest]
            if branch.row.type == "stub":
                stubs += stub_places(branch)
    return MemberNodes(
        tuple(sorted(gaps, key=lambda gap: gap.start)),
        tuple(sorted(places)),
        tuple(sorted(stubs)),
        tuple(sorted(flats, key=lambda flat: flat.s)),
        tuple(sorted(records, key=lambda record: record.s_other)),
        tuple(sorted(blends, key=lambda blend: blend.full)),
    )


def _gap(branch: Branch, length: float) -> MemberGap:
    """The stretch a node takes: between its two cuts, or from its one cut to the member's end."""
    ends = {side.way: MemberEnd(side.cut, side.low, side.high) for side in branch.sides}
    start = 0.5 * (ends[-1].least + ends[-1].greatest) if -1 in ends else 0.0
    end = 0.5 * (ends[1].least + ends[1].greatest) if 1 in ends else length
    return MemberGap(start, end, ends.get(-1), ends.get(1))


def with_nodes(member: Member, given: MemberNodes) -> Member:
    """The member with what nodes take of it; raises BendTorsionError as `check_blends`."""
    check_blends(member, given.blends, given.gaps)
    member = with_blends(member, given.blends)
    edges = {edge for gap in given.gaps for edge in (gap.start, gap.end)} - {0.0, member.length}
    joints = tuple(sorted({*member.law.joints, *edges, *given.stubs}))
    law = replace(member.law, joints=joints)
    return replace(
        member,
        law=law,
        gaps=given.gaps,
        inserts=given.diaphragms,
        node_records=given.records,
        stub_ends=given.stubs,
    )


def numbered(member: Member, others: Sequence[FlatPlate]) -> tuple[FlatPlate, ...]:
    """The diaphragms nodes put inside a member, marked after its others; raises BendTorsionError
    where one runs into another of them."""
    meeting = [
        (own, other)
        for k, own in enumerate(member.inserts)
        for other in (*others, *member.inserts[:k])
        if separation(own, other) <= 0.0
    ]
    if meeting:
        raise BendTorsionError(
            error(
                "diaphragms-meet",
                member.name,
                f"a diaphragm of a node at s = {own.s:.0f} mm runs into "
                f"{other.mark or 'that of another node'} at s = {other.s:.0f} mm",
                "move the row of sheet Diaphragms, or set the diaphragms of the node to none",
                position=f"s = {own.s:.0f} mm",
                value=separation(own, other),
                limit=0.0,
                unit="mm",
            )
            for own, other in meeting
        )
    first = 1 + sum(flat.letter == "D" for flat in others)
    marks = [f"{member.name}-D{first + k}" for k in range(len(member.inserts))]
    by_role = {flat.role: mark for flat, mark in zip(member.inserts, marks, strict=True)}
    faces = {strip.face for strip in member.law.strips}
    return tuple(
        replace(
            flat,
            mark=mark,
            # One that was left out as it ran into another's is not there to be welded to.
            welded=tuple(
                (by_role.get(name, name), k)
                for name, k in flat.welded
                if name in faces or name in by_role
            ),
        )
        for flat, mark in zip(member.inserts, marks, strict=True)
    )


def node_records(found: Found, order: Sequence[str]) -> tuple[NodeRecord, ...]:
    """Of all nodes a record for each branch, and one for each meeting that is none, by the member
    that runs through, in this order, and the place on it."""
    made = [_record(node, branch) for node in found.nodes for branch in node.branches]
    return tuple(in_order((*made, *found.unmade), order))


def _record(node: Node, branch: Branch) -> NodeRecord:
    """The record of one of a node's branches."""
    return NodeRecord(
        node.name,
        node.kind,
        node.through,
        branch.member,
        branch.s_through,
        branch.s,
        *(float(value) for value in node.point),
        branch.angle,
        branch.distance,
        branch.row.type,
        branch.gap,
        branch.row.stub_length,
        tuple(" and ".join(side.faces) for side in branch.sides),
        branch.steps,
        len(branch.diaphragms),
        branch.limits,
        min(manhole_sizes(branch.diaphragms), default=None),
    )
