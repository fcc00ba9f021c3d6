# SPDX-License-Identifier: LGPL-2.1-or-later
"""A branch at a node: where it lands on the member that runs through, and whether it can."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import Finding, error
from ..members.member import Member
from ..plates.flat_plate import FlatPlate
from .node_blend import Blend
from .node_cut import NodeCut, NodeCuts, landings, node_cut, outer_lines
from .node_faces import OuterFaces, outer_faces
from .node_input import NodeInput, NodeRules
from .node_record import FlangeStep


@dataclass(frozen=True, eq=False)
class Side:
    """One end of a branch at a node. way: +1 when the branch leaves the node along its +s, else
    -1. low, high: the least and greatest arc length its outer lines end at. seat: the stretch of
    the through member's axis it lands on, mm. faces: names of the faces landed on, with the
    member before those of other branches. on_arris: it lands on several faces of the through
    member."""

    way: int
    cut: NodeCut | NodeCuts
    low: float
    high: float
    seat: tuple[float, float]
    faces: tuple[str, ...]
    on_arris: bool = False


@dataclass(frozen=True, eq=False)
class Branch:
    """A member that ends on another: its place s and the through member's (mm), acute angle (rad)
    and distance of the axes (mm), its one or two sides, what was asked for, its steps to the
    through member's faces, the diaphragms that continue its plates there (not numbered), its
    blends, and the limits of its steps, mm, and of their angles, rad; what its sides (by way) are
    cut by besides the through member."""

    member: str
    s: float
    s_through: float
    angle: float
    distance: float
    sides: tuple[Side, ...]
    row: NodeInput
    gap: float
    at_corner: bool = False
    steps: tuple[FlangeStep, ...] = ()
    diaphragms: tuple[FlatPlate, ...] = ()
    blends: tuple[Blend, ...] = ()
    limits: tuple[float, float] | None = None
    against: tuple[tuple[int, NodeCut], ...] = ()

    @property
    def seat(self) -> tuple[float, float]:
        """The stretch of the through member's axis all sides land on, mm."""
        return min(side.seat[0] for side in self.sides), max(side.seat[1] for side in self.sides)

    @property
    def cut_range(self) -> tuple[float, float]:
        """The stretch of its own axis that the node takes, to the far end of its cuts, mm."""
        low = [side.low for side in self.sides if side.way < 0] or [-math.inf]
        high = [side.high for side in self.sides if side.way > 0] or [math.inf]
        return min(low), max(high)

    def at_node(self, name: str) -> Branch:
        """The branch with the node's name on its cuts."""
        sides = tuple(replace(s, cut=s.cut.named(name)) for s in self.sides)
        return replace(self, sides=sides)


def reach(member: Member) -> float:
    """Largest distance of a corner from the axis, mm."""
    corners = [c.corners_at(np.array([c.start, c.end])) for c in member.law.cells]
    return float(np.linalg.norm(np.concatenate(corners), axis=2).max())


def crossing_angle(one: Member, other: Member, s: float, t: float) -> float:
    """Acute angle, rad, between two axes at s and t."""
    x = one.frames.axis.tangent(np.array([s]))[0]
    y = other.frames.axis.tangent(np.array([t]))[0]
    return math.atan2(float(np.linalg.norm(np.cross(x, y))), abs(float((x * y).sum())))


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
    angle = crossing_angle(through, other, s, t)
    gap = rules.gap if row.gap is None else row.gap
    span = (reach(through) + reach(other)) / math.sin(angle) + 500.0
    faces = outer_faces(through, s - span, s + span)
    lines = outer_lines(other, t - span, t + span)
    tangent = other.frames.axis.tangent(np.array([t]))[0]
    sides, findings = [], []
    for way in (-1, 1):
        cut = node_cut(row.name, faces, s, way * tangent, gap)
        more = [own for side, own in against if side == way]
        cut = NodeCuts((cut, *more)) if more else cut
        ends, points = landings(cut, lines, t)
        # What is left of the branch beyond its cut, at its longest and at its shortest line.
        left = ends if way < 0 else other.length - ends
        if left.max() <= tolerances.SAME_STATION:
            continue
        side, over = _side(way, cut, ends, points)
        seat = side.seat
        if not math.isfinite(seat[0]):
            findings += _both(
                "node-branches-overlap",
                (row.through, row.other),
                f"{row.other} lands on {' and '.join(side.faces)} only and not on {row.through}",
                "end it there by a row of sheet Nodes, or move one of them along",
                f"s = {s:.0f} mm of {row.through}",
            )
            continue
        sides.append(side)
        findings += _side_findings(side, over, other, s, row, rules)
        findings += _length_findings(side, left, through, other, s, row, rules)
        findings += _zone_findings(side, seat, through, other, s, row)
    if not sides:
        findings += _both(
            "node-nothing-left",
            (row.through, row.other),
            f"nothing of {row.other} is left beyond {row.through}",
            "make it longer, or let it run through",
            f"s = {s:.0f} mm of {row.through}",
        )
    if findings:
        return None, findings
    p, q = (m.frames.axis.position(np.array([at]))[0] for m, at in ((through, s), (other, t)))
    low, high = min(x.seat[0] for x in sides), max(x.seat[1] for x in sides)
    breadth = 2.0 * reach(through)
    corner = len(sides) == 1 and (low < breadth or high > through.length - breadth)
    distance = float(np.linalg.norm(p - q))
    made = Branch(other.name, t, s, angle, distance, tuple(sides), row, gap, corner)
    return replace(made, against=against), []


def _side(
    way: int, cut: NodeCut | NodeCuts, ends: np.ndarray, points: np.ndarray
) -> tuple[Side, tuple[float, str]]:
    """The side, and how far, mm, its lines stand over a face they land on, at most, and which."""
    on, parts = cut.part_at(points), cut.parts
    low, high, over = math.inf, -math.inf, (0.0, "")
    names, own = [], []
    for k in sorted(set(on.tolist())):
        part, (face,) = parts[k], parts[k].landing
        s, w = part.faces.foot(face, points[on == k])
        is_main = part.faces is cut.main.faces
        names.append(part.faces.names[face] if is_main else _of_member(part.faces, face))
        landing = [p.landing[0] for p in parts if p.faces is part.faces]
        over = max(over, (_overhang(part.faces, landing, face, s, w), _of_member(part.faces, face)))
        if is_main:
            low, high = min(low, float(s.min())), max(high, float(s.max()))
            own.append(face)
    side = Side(
        way,
        cut,
        float(ends.min()),
        float(ends.max()),
        (low, high),
        tuple(names),
        len(own) > 1,
    )
    return side, over


def _of_member(faces: OuterFaces, face: int) -> str:
    return f"{faces.member} {faces.names[face]}"


def _overhang(faces: OuterFaces, landing, face: int, s: np.ndarray, w: np.ndarray) -> float:
    """How far (s, w) lie beyond the edges of a face where no other landed face goes on, mm."""
    count = len(faces.names)
    one, _ = faces.at(face, s, np.zeros(len(s)))
    two, _ = faces.at(face, s, np.ones(len(s)))
    width = np.linalg.norm(two - one, axis=1)
    over = [0.0]
    if (face - 1) % count not in landing:
        over.append(float((-w * width).max()))
    if (face + 1) % count not in landing:
        over.append(float(((w - 1.0) * width).max()))
    return max(over)


def _both(code, names, message, mend, position, value=None, limit=None, unit="") -> list[Finding]:
    return [
        error(code, name, message, mend, position=position, value=value, limit=limit, unit=unit)
        for name in names
    ]


def _side_findings(
    side: Side, over: tuple[float, str], other: Member, s, row, rules
) -> list[Finding]:
    """A branch that stands over the face it lands on."""
    cell = next((c for c in other.law.cells if c.start <= row_place(side) <= c.end), None)
    cell = cell or other.law.cells[0 if row_place(side) < 0 else -1]
    limit = rules.overhang * float(min(cell.thickness))
    if over[0] <= limit:
        return []
    member, _, face = over[1].rpartition(" ")
    return _both(
        "branch-wider-than-face",
        (member, row.other),
        f"{row.other} stands over the {face} face of {member}",
        "make it lower or narrower, align it, or let it run through",
        f"s = {s:.0f} mm of {row.through}",
        over[0],
        limit,
        "mm",
    )


def row_place(side: Side) -> float:
    """A place on the branch at its cut."""
    return side.low if side.way < 0 else side.high


def _length_findings(side: Side, left, through, other, s, row, rules) -> list[Finding]:
    """A branch that ends in or just beyond the node, a through member that ends at it."""
    findings = []
    place = f"s = {s:.0f} mm of {row.through}"
    short = float(other.length - side.high if side.way > 0 else side.low)
    beyond = float(side.high - other.length if side.way < 0 else -side.low)
    names = (row.through, row.other)
    if short < rules.shortest_branch:
        findings += _both(
            "node-at-end",
            names,
            f"{row.other} ends just beyond {row.through}",
            f"end {row.other} inside {row.through}, or make it "
            f"{rules.shortest_branch - short:.0f} mm longer",
            place,
            short,
            rules.shortest_branch,
            "mm",
        )
    elif beyond > tolerances.SAME_STATION:
        findings += _both(
            "node-at-end",
            names,
            f"{row.other} ends before it lands on {row.through} all round",
            f"make {row.other} {beyond:.0f} mm longer",
            place,
            -beyond,
            0.0,
            "mm",
        )
    room = min(side.seat[0], through.length - side.seat[1])
    if room < rules.end_distance:
        findings += _both(
            "node-at-end",
            names,
            f"{row.other} lands too near the end of {row.through}",
            f"make {row.through} {rules.end_distance - room:.0f} mm longer",
            place,
            room,
            rules.end_distance,
            "mm",
        )
    return findings


def _zone_findings(side: Side, seat, through: Member, other: Member, s, row) -> list[Finding]:
    """A cut in a transition or across a step of either member."""
    findings = []
    for member, (low, high) in ((through, seat), (other, (side.low, side.high))):
        cells = [c for c in member.law.cells if c.is_transition and c.start < high and c.end > low]
        steps = [j for j in member.law.joints if low < j < high]
        if not cells and not steps:
            continue
        start, end = (cells[0].start, cells[-1].end) if cells else (steps[0], steps[0])
        move = max(end - low, 0.0) if low + high > start + end else max(high - start, 0.0)
        what = f"transition {cells[0].label}" if cells else "a change of section"
        findings += _both(
            "node-in-transition",
            (row.through, row.other),
            f"{row.other} meets {row.through} at {what} of {member.name}",
            f"move the transition of {member.name} by {move:.0f} mm or more",
            f"s = {start:.0f} to {end:.0f} mm of {member.name}",
            float(min(high, end) - max(low, start)),
            0.0,
            "mm",
        )
    return findings
