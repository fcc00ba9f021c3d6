# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cuts and seats in a transition or over a step of a member, and how far that has to move.

The lengths of both ways out are found by doing it: the zone is moved along, the branch lands
again, on what the section is then, until the node is clear of it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from .. import tolerances
from ..finding import BETWEEN, Finding, error
from ..members.cells import Cell
from ..members.member import Member
from .node_input import NodeInput
from .node_landing import Side, landed, seat_of

_TRIES = 12


@dataclass(frozen=True)
class _Zone:
    """A change of section: where it is, mm, and its name."""

    start: float
    end: float
    name: str


def transition_findings(
    through: Member,
    other: Member,
    s: float,
    t: float,
    row: NodeInput,
    gap: float,
    sides: Sequence[Side],
) -> list[Finding]:
    """Errors of a branch at t that meets a member at s in a zone where either changes."""
    findings = []
    for member, is_through in ((through, True), (other, False)):
        for zone in _zones(member):
            taken = [own for own in _taken(sides, is_through) if _in(zone, own)]
            if not taken:
                continue

            def sides_of(moved: Member, is_through: bool = is_through) -> list[Side]:
                pair = (moved, other) if is_through else (through, moved)
                return [one.side for one in landed(*pair, s, t, row, gap)]

            ways = [_way_out(member, zone, way, is_through, sides_of) for way in (-1, 1)]
            words = [
                f"by at least {length} mm towards the {to}"
                for length, to in zip(ways, ("start", "end"), strict=True)
                if length is not None
            ]
            mend = f"move the cut of {zone.name} of {member.name} " + ", or ".join(words)
            if not words:
                mend = f"there is no room to move {zone.name} of {member.name}: move the members"
            depth = max(min(own[1] - zone.start, zone.end - own[0]) for own in taken)
            findings.append(
                error(
                    "node-in-transition",
                    BETWEEN.join((row.through, row.other)),
                    f"{row.other} meets {row.through} at {zone.name} of {member.name}",
                    mend,
                    position=f"s = {zone.start:.0f} to {zone.end:.0f} mm of {member.name}",
                    value=float(depth),
                    limit=0.0,
                    unit="mm",
                )
            )
    return findings


def _zones(member: Member) -> list[_Zone]:
    """The transitions and steps of a member along its axis."""
    found: dict[str, list[Cell]] = {}
    for cell in member.law.cells:
        if cell.is_transition:
            found.setdefault(cell.label, []).append(cell)
    zones = [
        _Zone(min(c.start for c in own), max(c.end for c in own), f"transition {label}")
        for label, own in found.items()
    ]
    ends = {place for zone in zones for place in (zone.start, zone.end)}
    zones += [
        _Zone(place, place, "the change of section")
        for place in member.law.joints
        if place not in ends
    ]
    return sorted(zones, key=lambda zone: zone.start)


def _taken(sides: Sequence[Side], is_through: bool) -> list[tuple[float, float]]:
    """The stretches of a member's axis that must be clear of changes; between the cut of a plate
    and a fold there has to be some of it."""
    if is_through:
        return [seat_of(sides)]
    least = tolerances.SHORTEST_PLATE
    return [(one.low - least, one.high + least) for one in sides]


def _in(zone: _Zone, taken: tuple[float, float]) -> bool:
    almost = tolerances.SAME_STATION
    return zone.start < taken[1] - almost and zone.end > taken[0] + almost


def _way_out(member: Member, zone: _Zone, way: int, is_through: bool, sides_of) -> int | None:
    """How far, whole mm, a zone moves towards the start (-1) or the end (+1) until no taken
    stretch is in it; None where it meets another zone or the member's end on its way."""
    low, high = _room(member, zone)

    def missing(move: int) -> float:
        """What more, mm, it has to move; none at a place it cannot come to."""
        moved = replace(zone, start=zone.start + way * move, end=zone.end + way * move)
        if move and not (moved.start > low and moved.end < high):
            return math.nan
        sides = sides_of(_with(member, zone, moved) if move else member)
        own = [taken for taken in _taken(sides, is_through) if _in(moved, taken)]
        away = [moved.end - t[0] if way < 0 else t[1] - moved.start for t in own]
        return max(away, default=0.0)

    short, move = 0, 0
    for _ in range(_TRIES):
        more = missing(move)
        if not math.isfinite(more):
            return None
        if more <= 0.0:
            break
        short, move = move, math.ceil(move + more - tolerances.SAME_STATION)
    else:
        return None
    # The last step may have been too long: the section on the way there was another.
    while move - short > 1:
        middle = (short + move) // 2
        if missing(middle) > 0.0:
            short = middle
        else:
            move = middle
    return move


def _room(member: Member, zone: _Zone) -> tuple[float, float]:
    """The stretch a zone may move within, mm."""
    others = [own for own in _zones(member) if own != zone]
    before = [own.end for own in others if own.end <= zone.start]
    behind = [own.start for own in others if own.start >= zone.end]
    return max([0.0, *before]), min([member.length, *behind])


def _with(member: Member, zone: _Zone, moved: _Zone) -> Member:
    """The member with a zone moved; what lies beside it is longer or shorter."""
    shift = moved.start - zone.start
    cells = []
    for cell in member.law.cells:
        if zone.start <= cell.start and cell.end <= zone.end and zone.end > zone.start:
            lift = cell.lift and replace(
                cell.lift, start=cell.lift.start + shift, end=cell.lift.end + shift
            )
            cells.append(replace(cell, start=cell.start + shift, end=cell.end + shift, lift=lift))
        elif cell.end <= zone.start:
            end = moved.start if cell.end == zone.start else min(cell.end, moved.start)
            cells.append(replace(cell, end=end))
        else:
            start = moved.end if cell.start == zone.end else max(cell.start, moved.end)
            cells.append(replace(cell, start=start))
    cells = tuple(cell for cell in cells if cell.end > cell.start)
    return replace(member, law=replace(member.law, cells=cells))
