# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meetings of members: where two solids overlap, and which of the two is to run through."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..axes.axis_places import Crossing, crossings
from ..finding import BETWEEN, Finding, error
from ..members.member import Member
from .node_cut import outer_lines
from .node_faces import outer_faces
from .node_input import ALMOST, NodeInput, NodeRules
from .node_landing import crossing_angle, reach

COINCIDENT = 1.0
"""mm; axes nowhere farther apart are the same."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """Two members (names in the order given) whose solids meet at an approach of their axes."""

    one: str
    other: str
    at: Crossing


def meetings_of(
    members: Mapping[str, Member], rules: NodeRules
) -> tuple[list[Meeting], list[tuple[Meeting, float]]]:
    """Every meeting of two members' solids, and those that nearly touch with their distance, mm.
    Of two that run along each other at less than `least_angle` only the first such approach."""
    # In the order of names, so that the same two members give the same numbers in any project.
    names = sorted(members, key=_natural)
    reaches = {name: reach(members[name]) for name in names}
    boxes = {}
    for name in names:
        axis = members[name].frames.axis
        points = axis.position(np.linspace(0.0, axis.length, 65))
        sag = float(np.linalg.norm(np.diff(points, axis=0), axis=1).max())
        margin = reaches[name] + 0.25 * sag
        boxes[name] = points.min(axis=0) - margin, points.max(axis=0) + margin
    meetings, near = [], []
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            (low, high), (low2, high2) = boxes[one], boxes[other]
            if (low > high2 + rules.near).any() or (low2 > high + rules.near).any():
                continue
            limit = reaches[one] + reaches[other] + rules.near
            flat = False
            for at in crossings(members[one].frames.axis, members[other].frames.axis, limit):
                angle = crossing_angle(members[one], members[other], at.first, at.second)
                if flat and angle < rules.least_angle - ALMOST:
                    continue
                apart = _apart(members[one], members[other], at, rules.near)
                if apart < 0.0:
                    meetings.append(Meeting(one, other, at))
                    flat = flat or angle < rules.least_angle - ALMOST
                elif apart < rules.near - ALMOST:
                    near.append((Meeting(one, other, at), apart))
    return meetings, near


def _natural(name: str) -> list[tuple[int, str]]:
    """A key that puts M2 before M10."""
    parts = re.split(r"(\d+)", name)
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts]


def _apart(one: Member, other: Member, at: Crossing, near: float) -> float:
    """Distance, mm, between two members near an approach of their axes, negative when they
    overlap: the least distance of the lines of one from the faces of the other. Where the planes
    of the faces already tell that it is negative or beyond `near`, it is only an estimate."""
    least = math.inf
    for through, branch, s, t in (
        (one, other, at.first, at.second),
        (other, one, at.second, at.first),
    ):
        if not through.law.sections[0].closed:
            continue
        span = 2.0 * (reach(one) + reach(other))
        faces = outer_faces(through, s - span, s + span)
        points = line_points(branch, t, span)
        if s - span >= 0.0 and s + span <= through.length:
            estimate, strayed = faces.roughly_inside(points, s)
            lowest = float(estimate.min())
            if not -strayed <= lowest <= near + strayed:
                least = min(least, lowest + math.copysign(strayed, -lowest))
                continue
            points = points[estimate <= lowest + 2.0 * strayed]
        value = faces.inside(points)
        # Beyond its ends there is no member.
        foot = np.clip(faces.foot(0, points)[0], -1e6, 1e6)
        beyond = np.maximum(-foot, foot - through.length)
        least = min(least, float(np.maximum(value, beyond).min()))
    return least


def nearly(meeting: Meeting, apart: float, rules: NodeRules) -> Finding:
    """The warning of members that pass each other `apart` mm without touching."""
    one, other, at = meeting.one, meeting.other, meeting.at
    return Finding(
        "warning",
        "members-nearly-touch",
        BETWEEN.join((one, other)),
        f"s = {at.first:.0f} mm",
        apart,
        rules.near,
        "mm",
        f"{one} and {other} pass each other without touching",
        f"move one of them {_tenths(rules.near - apart)} mm or more away, or "
        f"{_tenths(apart)} mm or more nearer, so that they meet",
    )


def _tenths(size: float) -> str:
    """A size in tenths that is enough."""
    return f"{math.ceil(10.0 * (size - ALMOST)) / 10.0:.1f}"


def resolved(
    meeting: Meeting,
    ranks: Mapping[str, int | None],
    rows: Sequence[NodeInput],
    meetings: Sequence[Meeting],
    lengths: Mapping[str, float],
) -> tuple[NodeInput | None, int | None, list[Finding]]:
    """The row or rank that says who runs through, and the row's index."""
    pair = {meeting.one, meeting.other}
    others = [m for m in meetings if {m.one, m.other} == pair]
    mine = []
    for index, row in enumerate(rows):
        if {row.through, row.other} != pair:
            continue
        if row.s is not None:
            place = row.place(lengths[row.through])
            off = [abs(place_of(other, row.through) - place) for other in others]
            if others[off.index(min(off))] is not meeting:
                continue
        mine.append(index)
    if len(mine) > 1:
        return (
            None,
            mine[0],
            [
                error(
                    "node-twice",
                    BETWEEN.join((meeting.one, meeting.other)),
                    f"several rows name the meeting of {meeting.one} and {meeting.other}",
                    "keep one of the rows, or give each its place s",
                    position=f"row {mine[1] + 1}",
                )
            ],
        )
    if mine:
        row = rows[mine[0]]
        return (replace(row, name="") if len(others) > 1 and row.s is None else row), mine[0], []
    one, other = ranks.get(meeting.one), ranks.get(meeting.other)
    if one == other:
        return None, None, _unresolved(meeting)
    first = other is None or (one is not None and one < other)
    through, branch = (meeting.one, meeting.other) if first else (meeting.other, meeting.one)
    return NodeInput(through, branch), None, []


def _unresolved(meeting: Meeting) -> list[Finding]:
    x, y, z = meeting.at.first_point
    one, other = meeting.one, meeting.other
    return [
        error(
            "node-unresolved",
            BETWEEN.join((one, other)),
            f"{one} meets {other} and nothing says which of them runs through",
            "give them different ranks, or a row of sheet Nodes",
            position=f"s = {meeting.at.first:.0f} mm of {one}, {meeting.at.second:.0f} mm of "
            f"{other} (x = {x:.0f}, y = {y:.0f}, z = {z:.0f} mm)",
        )
    ]


def place_of(meeting: Meeting, member: str) -> float:
    return meeting.at.first if member == meeting.one else meeting.at.second


def places_of(meeting: Meeting, row: NodeInput) -> tuple[float, float]:
    return place_of(meeting, row.through), place_of(meeting, row.other)


def unfit(
    meeting: Meeting, row: NodeInput, members: Mapping[str, Member], rules: NodeRules
) -> list[Finding]:
    """Errors of a meeting that no cut can be made for."""
    through, other = members[row.through], members[row.other]
    s, t = places_of(meeting, row)
    both = BETWEEN.join((row.through, row.other))
    place = f"{row.name or 'node'}, s = {s:.0f} mm of {row.through}"
    if not through.law.sections[0].closed:
        return [
            error(
                "node-open-section",
                both,
                f"{row.through} cannot run through: its section is not closed",
                f"let {row.other} run through",
                position=place,
                value=through.law.sections[0].type,
            )
        ]
    angle = crossing_angle(through, other, s, t)
    if runs_on(through, other):
        return [
            error(
                "node-angle",
                both,
                f"the axes of {row.through} and {row.other} coincide: {row.other} is a duplicate",
                f"delete {row.other}, or give it an axis of its own",
                position=place,
                value=math.degrees(angle),
                limit=math.degrees(rules.least_angle),
                unit="deg",
            )
        ]
    if angle < rules.least_angle - ALMOST:
        turn = _tenths(math.degrees(rules.least_angle - angle))
        return [
            error(
                "node-angle",
                both,
                f"{row.through} and {row.other} meet at too small an angle",
                f"turn one of them by {turn} degrees or more, or end it before the node",
                position=place,
                value=math.degrees(angle),
                limit=math.degrees(rules.least_angle),
                unit="deg",
            )
        ]
    return []


def runs_on(one: Member, other: Member) -> bool:
    """Whether the axis of `other` is that of `one`, in either direction."""
    length = one.length
    if abs(length - other.length) > COINCIDENT:
        return False
    places = np.linspace(0.0, 1.0, 9)
    mine, theirs = (m.frames.axis.position(places * m.length) for m in (one, other))
    return any(bool((np.abs(mine - line) < COINCIDENT).all()) for line in (theirs, theirs[::-1]))


def line_points(member: Member, s: float, span: float) -> np.ndarray:
    """Points (n, 3) of a member's outer lines and axis around s."""
    lines = outer_lines(member, s - span, s + span)
    places = np.linspace(lines.start, lines.end, 201)
    return np.concatenate([lines(places).reshape(-1, 3), member.frames.axis.position(places)])
