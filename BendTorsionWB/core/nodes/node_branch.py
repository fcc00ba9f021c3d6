# SPDX-License-Identifier: LGPL-2.1-or-later
"""A branch at a node: where it lands on the member that runs through, and whether it can."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BETWEEN, Finding, error
from ..members.member import Member
from ..plates.flat_plate import FlatPlate
from .node_blend import Blend
from .node_cut import NodeCut
from .node_faces import OuterFaces, wall_thickness
from .node_input import ALMOST, NodeInput, NodeRules
from .node_landing import Landing, Side, crossing_angle, landed, seat_of
from .node_record import FlangeStep
from .node_transition import transition_findings


@dataclass(frozen=True, eq=False)
class Branch:
    """A member that ends on another: its place s and the through member's (mm), acute angle (rad)
    and distance of the axes (mm), its one or two sides, what was asked for, the place on its axis,
    continued straight, beside the through member's axis, which stubs are measured from (s_node,
    mm), its steps to the faces it is in line with, the diaphragms that continue its plates there
    (not numbered), its blends, and the limits of its steps, mm, and of their angles, rad; what its
    sides (by way) are cut by besides the through member."""

    member: str
    s: float
    s_through: float
    angle: float
    distance: float
    sides: tuple[Side, ...]
    row: NodeInput
    gap: float
    s_node: float
    at_corner: bool = False
    steps: tuple[FlangeStep, ...] = ()
    diaphragms: tuple[FlatPlate, ...] = ()
    blends: tuple[Blend, ...] = ()
    limits: tuple[float, float] | None = None
    against: tuple[tuple[int, NodeCut], ...] = ()

    @property
    def through(self) -> str:
        """The member that runs through."""
        return self.row.through

    @property
    def place(self) -> str:
        """Where it is, for findings."""
        return _place(self.row, self.s_through)

    @property
    def faces(self) -> OuterFaces:
        """The outer faces of the through member."""
        return self.sides[0].cut.main.faces

    @property
    def seat(self) -> tuple[float, float]:
        """The stretch of the through member's axis all sides land on, mm."""
        return seat_of(self.sides)

    @property
    def cut_range(self) -> tuple[float, float]:
        """The stretch of its own axis that the node takes, to the far end of its cuts, mm."""
        low = [side.low for side in self.sides if side.way < 0] or [-math.inf]
        high = [side.high for side in self.sides if side.way > 0] or [math.inf]
        return min(low), max(high)

    def takes(self, place: float) -> bool:
        """Whether a place on its axis, mm, lies within what the node takes."""
        low, high = self.cut_range
        return low <= place <= high

    def at_node(self, name: str) -> Branch:
        """The branch with the node's name on its cuts."""
        sides = tuple(replace(s, cut=s.cut.named(name)) for s in self.sides)
        return replace(self, sides=sides)


def branch_at(
    through: Member,
    other: Member,
    s: float,
    t: float,
    row: NodeInput,
    rules: NodeRules,
    against: tuple[tuple[int, NodeCut], ...] = (),
) -> tuple[Branch | None, list[Finding]]:
    """The branch `other` at t that meets `through` at s, or errors that name both members.
    against: what its sides, by way, are cut by besides."""
    gap = rules.gap if row.gap is None else row.gap
    findings = _gap_findings(through, other, gap, s, t, row, rules)
    if findings:
        return None, findings
    sides, landings = [], landed(through, other, s, t, row, gap, against)
    for one in landings:
        side = one.side
        if not math.isfinite(side.seat[0]):
            findings.append(
                _both(
                    "node-branches-overlap",
                    row,
                    f"{row.other} lands on {' and '.join(side.faces)} only and not on "
                    f"{row.through}",
                    "end it there by a row of sheet Nodes, or move one of them along",
                    _place(row, s),
                )
            )
            continue
        sides.append(side)
        findings += _length_findings(side, through, other, s, row, rules)
    findings = _worst(findings)
    findings += _overhang_findings(landings, other, s, row, rules)
    findings += transition_findings(through, other, s, t, row, gap, sides)
    if not sides:
        findings.append(
            _both(
                "node-nothing-left",
                row,
                f"nothing of {row.other} is left beyond {row.through}",
                "make it longer, or let it run through",
                _place(row, s),
            )
        )
    if findings:
        return None, findings
    p, q = (m.frames.axis.position(np.array([at]))[0] for m, at in ((through, s), (other, t)))
    low, high = seat_of(sides)
    depth = float(np.ptp(through.law.cell_at(s).corners_at(np.array([s]))[0][:, 1]))
    corner = len(sides) == 1 and (low < depth or high > through.length - depth)
    tangent = other.frames.axis.tangent(np.array([t]))[0]
    branch = Branch(
        other.name,
        t,
        s,
        crossing_angle(through, other, s, t),
        float(np.linalg.norm(p - q)),
        tuple(sides),
        row,
        gap,
        t + float(((p - q) * tangent).sum()),
        corner,
        against=against,
    )
    return branch, []


def _worst(findings: Sequence[Finding]) -> list[Finding]:
    """Of errors that say the same of both sides of a branch only the one that misses most."""
    worst: dict[tuple[str, str], Finding] = {}
    for own in findings:
        last = worst.setdefault((own.code, own.message), own)
        if own.value is not None and last.limit - last.value < own.limit - own.value:
            worst[own.code, own.message] = own
    return list(worst.values())


def _both(
    code, row: NodeInput, message, mend, position, value=None, limit=None, unit="", on=""
) -> Finding:
    """An error that names both members of a row; on: instead of the one that runs through."""
    names = BETWEEN.join((on or row.through, row.other))
    return error(code, names, message, mend, position=position, value=value, limit=limit, unit=unit)


def _place(row: NodeInput, s: float) -> str:
    return f"s = {s:.0f} mm of {row.through}"


def up(length: float) -> int:
    """A length in whole mm that is enough."""
    return math.ceil(length - ALMOST)


def _overhang_findings(landings: Sequence[Landing], other: Member, s, row, rules) -> list[Finding]:
    """A branch that stands over the faces it lands on: where it does so most, of each member."""
    worst: dict[str, tuple[float, float, str]] = {}
    for one in landings:
        over, on = one.over
        side = one.side
        cell = other.law.cell_at(side.low if side.way < 0 else side.high)
        limit = rules.overhang * float(min(cell.thickness))
        member, _, face = on.rpartition(" ")
        if over > limit + ALMOST and over > worst.get(member, (0.0,))[0]:
            worst[member] = over, limit, face
    return [
        _both(
            "branch-wider-than-face",
            row,
            f"{row.other} stands over the {face} face of {member}",
            f"make it lower or narrower, or align it, by {up(over - limit)} mm or more on that "
            "side, or let it run through",
            _place(row, s),
            over,
            limit,
            "mm",
            member,
        )
        for member, (over, limit, face) in worst.items()
    ]


def widest_gap(
    through: Member, other: Member, s: float, t: float, rules: NodeRules
) -> tuple[float, float]:
    """The widest root gap that can be welded where two members meet, and the thinnest plate there,
    mm."""
    thin = min(min(wall_thickness(one, at).values()) for one, at in ((through, s), (other, t)))
    return min(rules.widest_gap, rules.gap_over_thickness * thin), thin


def _gap_findings(through, other, gap, s, t, row, rules) -> list[Finding]:
    """A root gap that is none, or too wide to be welded."""
    limit, thin = widest_gap(through, other, s, t, rules)
    if 0.0 <= gap <= limit:
        return []
    below = gap < 0.0
    return [
        _both(
            "node-gap",
            row,
            "a root gap cannot be negative"
            if below
            else f"the root gap is too wide to be welded to plates of {thin:g} mm",
            "write 0 or more" if below else f"write {limit:g} mm or less",
            _place(row, s),
            gap,
            0.0 if below else limit,
            "mm",
        )
    ]


def _length_findings(side: Side, through, other, s, row, rules) -> list[Finding]:
    """A branch that ends in or just beyond the node, a through member that ends at it."""
    findings = []
    place = _place(row, s)
    short = float(other.length - side.high if side.way > 0 else side.low)
    beyond = float(side.high - other.length if side.way < 0 else -side.low)
    far, near = ("end", "start") if side.way > 0 else ("start", "end")
    if short < rules.shortest_branch:
        findings.append(
            _both(
                "node-at-end",
                row,
                f"{row.other} ends just beyond {row.through}",
                f"end {row.other} inside {row.through}, or make it "
                f"{up(rules.shortest_branch - short)} mm longer at its {far}",
                place,
                short,
                rules.shortest_branch,
                "mm",
            )
        )
    elif beyond > tolerances.SAME_STATION:
        findings.append(
            _both(
                "node-at-end",
                row,
                f"{row.other} ends before it lands on {row.through} all round",
                f"make {row.other} {up(beyond)} mm longer at its {near}",
                place,
                -beyond,
                0.0,
                "mm",
            )
        )
    room = min(side.seat[0], through.length - side.seat[1])
    if room < rules.end_distance:
        end = "start" if side.seat[0] == room else "end"
        findings.append(
            _both(
                "node-at-end",
                row,
                f"{row.other} lands too near the end of {row.through}",
                f"make {row.through} {up(rules.end_distance - room)} mm longer at its {end}",
                place,
                room,
                rules.end_distance,
                "mm",
            )
        )
    return findings
