# SPDX-License-Identifier: LGPL-2.1-or-later
"""Branches of one node that overlap beside the member that runs through: the later one ends on
the outer faces of the earlier one as well."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..finding import BETWEEN, Finding, error
from ..members.member import Member
from .node_branch import Branch, branch_at
from .node_cut import NodeCut, node_cut, outer_lines
from .node_faces import outer_faces
from .node_input import NodeInput, NodeRules
from .node_landing import reach
from .node_meetings import Meeting

LEAST_DEPTH = 1e-3
"""mm; branches that overlap by less do not touch."""

_COARSE, _FINE = 201, 41
_PASSES = 4


@dataclass(frozen=True, eq=False)
class Beside:
    """Two branches that meet within a node, and the row or the ranks that say which of them is the
    earlier (`row.through`); None where nothing does."""

    one: Branch
    other: Branch
    row: NodeInput | None


def branches_met(meeting: Meeting, branches: Sequence[Branch]) -> tuple[Branch, Branch] | None:
    """The two branches, ending on one member, that a meeting is of, where it lies within their
    node; None of any other."""
    for one in branches:
        if one.member != meeting.one or not one.takes(meeting.at.first):
            continue
        for other in branches:
            alike = other.through == one.through and other.member == meeting.other
            if alike and other.takes(meeting.at.second):
                return one, other
    return None


def both_pass(one: Branch, other: Branch) -> list[Finding]:
    """Errors of two branches that both pass through one place of a third member."""
    return _errors(
        "node-three-through",
        f"{one.member}, {other.member} and {one.through} all pass through one place",
        "end one of them at the node, or move it along",
        (one, other),
        3,
        2,
    )


def cut_beside(
    through: Member,
    branches: Sequence[Branch],
    members: Mapping[str, Member],
    pairs: Sequence[Beside],
    node: str,
    rules: NodeRules,
) -> tuple[tuple[Branch, ...], list[Finding]]:
    """The branches of a node, those that overlap an earlier one ending on it as well; branches
    that cannot are left out, with errors."""
    by_key = {_key(branch): branch for branch in branches}
    order: dict[tuple, list[tuple[tuple, int]]] = {}
    findings: list[Finding] = []
    for pair in pairs:
        one, other = by_key.get(_key(pair.one)), by_key.get(_key(pair.other))
        if one is None or other is None or one.through != through.name:
            continue
        depths = overlaps(one, other, members)
        if not depths:
            continue
        if pair.row is None:
            findings += _unordered(one, other, max(depths.values()))
            continue
        first, later = (one, other) if pair.row.through == one.member else (other, one)
        for ways in depths:
            way = ways[1] if later is other else ways[0]
            order.setdefault(_key(later), []).append((_key(first), way))
    made: dict[tuple, Branch] = {}
    waiting = list(by_key)
    while waiting:
        ready = [k for k in waiting if all(first in made for first, _ in order.get(k, ()))]
        if not ready:
            break
        for key in ready:
            waiting.remove(key)
            branch = by_key[key]
            against, faults = _against(node, branch, order.get(key, ()), made, members, rules)
            if against and not faults:
                branch, faults = branch_at(
                    through,
                    members[branch.member],
                    branch.s_through,
                    branch.s,
                    branch.row,
                    rules,
                    against,
                )
                branch = branch and branch.at_node(node)
            findings += faults
            made[key] = branch or by_key[key]
    findings += _in_circles([by_key[key] for key in waiting])
    failed = {name for finding in findings for name in finding.objects}
    return tuple(made[k] for k in by_key if k in made and k[0] not in failed), findings


def _key(branch: Branch) -> tuple[str, float]:
    return branch.member, branch.s


def _against(node, branch, order, made, members, rules) -> tuple[tuple, list[Finding]]:
    """What a branch is cut by besides the member that runs through: (way, cut) each."""
    cuts: list[tuple[int, NodeCut]] = []
    findings: list[Finding] = []
    own = members[branch.member]
    tangent = own.frames.axis.tangent(np.array([branch.s]))[0]
    for key, way in order:
        first = made[key]
        if first.row.blend:
            findings += _errors(
                "node-blend-overlap",
                f"{branch.member} ends on {first.member}, which is blended",
                "do not blend the node, or move one of them along",
                (branch, first),
            )
            continue
        sharpest = _angle(members[first.member], first, own, branch, way)
        if sharpest < rules.least_angle:
            findings += _errors(
                "node-angle",
                f"{branch.member} ends on {first.member} at too small an angle",
                "turn one of them, or move it along",
                (branch, first),
                math.degrees(sharpest),
                math.degrees(rules.least_angle),
                "deg",
            )
            continue
        span = _span(first, branch, members)
        faces = outer_faces(members[first.member], first.s - span, first.s + span)
        cuts.append((way, node_cut(node, faces, first.s, way * tangent, branch.gap)))
    return tuple(cuts), findings


def _angle(one: Member, first: Branch, other: Member, later: Branch, way: int) -> float:
    """The least angle, rad, between the side of the later branch and those of the first."""
    y = way * other.frames.axis.tangent(np.array([later.s]))[0]
    x = one.frames.axis.tangent(np.array([first.s]))[0]
    cosines = [float((side.way * x * y).sum()) for side in first.sides]
    return math.acos(min(1.0, max(cosines)))


def _span(one: Branch, other: Branch, members: Mapping[str, Member]) -> float:
    return 4.0 * (reach(members[one.member]) + reach(members[other.member]))


def overlaps(
    one: Branch, other: Branch, members: Mapping[str, Member]
) -> dict[tuple[int, int], float]:
    """How deep, mm, two branches overlap beyond the node, by the ways of their sides; none where
    they do not."""
    found: dict[tuple[int, int], float] = {}
    for turned, (a, b) in enumerate(((one, other), (other, one))):
        if not members[b.member].law.sections[0].closed:
            continue
        span = _span(a, b, members)
        faces = outer_faces(members[b.member], b.s - span, b.s + span)
        lines = outer_lines(members[a.member], a.s - span, a.s + span)
        for near in a.sides:
            for far in b.sides:

                def depth(points: np.ndarray, near=near, far=far, faces=faces) -> np.ndarray:
                    kept = [s.cut.value_and_gradient(points)[0] for s in (near, far)]
                    return np.minimum.reduce([-faces.inside(points), *kept])

                deepest = _deepest(lines, depth)
                if deepest > LEAST_DEPTH:
                    ways = (far.way, near.way) if turned else (near.way, far.way)
                    found[ways] = max(deepest, found.get(ways, 0.0))
    return found


def _deepest(lines, depth) -> float:
    """The greatest depth along any of the lines, looked at ever more closely about it."""
    count = lines.values.shape[2] // 3
    low, high = np.full(count, lines.start), np.full(count, lines.end)
    places = _COARSE
    best = -math.inf
    for _ in range(_PASSES):
        s = np.linspace(low, high, places)
        k = np.arange(count)
        points = np.stack([lines(row).reshape(count, count, 3)[k, k] for row in s])
        value = depth(points.reshape(-1, 3)).reshape(places, count)
        top = np.argmax(value, axis=0)
        best = max(best, float(value.max()))
        step = (high - low) / (places - 1)
        middle = s[top, k]
        low = np.maximum(middle - step, lines.start)
        high = np.minimum(middle + step, lines.end)
        places = _FINE
    return best


def _unordered(one: Branch, other: Branch, depth: float) -> list[Finding]:
    return _errors(
        "node-branches-overlap",
        f"{one.member} and {other.member} overlap where they land on {one.through}, and nothing "
        "says which of them ends on the other",
        "give them different ranks or a row of sheet Nodes, or move one of them along",
        (one, other),
        depth,
        0.0,
        "mm",
    )


def _in_circles(branches: Sequence[Branch]) -> list[Finding]:
    if not branches:
        return []
    names = ", ".join(branch.member for branch in branches)
    return _errors(
        "node-three-through",
        f"{names} each run through another of them on {branches[0].through}",
        "delete one of the rows between them",
        branches,
        len(branches),
        1,
    )


def _errors(code, message, mend, branches, value=None, limit=None, unit="") -> list[Finding]:
    return [
        error(
            code,
            BETWEEN.join(branch.member for branch in branches),
            message,
            mend,
            position=branches[0].place,
            value=value,
            limit=limit,
            unit=unit,
        )
    ]
