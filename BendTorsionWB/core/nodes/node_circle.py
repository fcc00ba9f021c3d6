# SPDX-License-Identifier: LGPL-2.1-or-later
"""Three members that meet in one place where each is to end on another: nothing runs through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

from ..finding import BETWEEN, Finding, error
from ..members.member import Member
from .node_input import NodeInput
from .node_landing import reach
from .node_meetings import Meeting, place_of


def circles(
    chosen: Sequence[tuple[Meeting, NodeInput]], members: Mapping[str, Member]
) -> tuple[set[Meeting], list[Finding]]:
    """The meetings, each with what says who runs through, that go round in a circle in one place,
    and an error for each circle."""
    found: set[Meeting] = set()
    findings = []
    for three in combinations(chosen, 3):
        ends = {row.other: row.through for _, row in three}
        if len(ends) != 3 or set(ends) != set(ends.values()):
            continue
        if not all(_in_one_place(name, [m for m, _ in three], members) for name in ends):
            continue
        found.update(meeting for meeting, _ in three)
        names = sorted(ends, key=list(members).index)
        at = three[0][0].at
        x, y, z = at.first_point
        said = ", ".join(f"{other} on {through}" for other, through in ends.items())
        findings.append(
            error(
                "node-three-through",
                BETWEEN.join(names),
                f"nothing runs through where these members meet: {said}",
                "let one of them run through for both others: turn round one of the rows of sheet "
                "Nodes, or delete them and give ranks",
                position=f"s = {at.first:.0f} mm of {three[0][0].one} "
                f"(x = {x:.0f}, y = {y:.0f}, z = {z:.0f} mm)",
                value=0,
                limit=1,
            )
        )
    return found, findings


def _in_one_place(name: str, three: Sequence[Meeting], members: Mapping[str, Member]) -> bool:
    """Whether a member meets two others nearer together than these are large."""
    own = [m for m in three if name in (m.one, m.other)]
    places = [place_of(m, name) for m in own]
    others = {n for m in own for n in (m.one, m.other)} - {name}
    return abs(places[0] - places[1]) < sum(reach(members[n]) for n in others)
