# SPDX-License-Identifier: LGPL-2.1-or-later
"""Thickness changes: where each face's plates change, and the chamfer of the thicker plate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..sections.section import Strip, strips_meet

if TYPE_CHECKING:
    from .segment import Segment

STAGGER_WORDS = ("auto", "none")


@dataclass(frozen=True)
class ThicknessRules:
    """Limits of thickness joints (rule pack): stagger between those of adjacent faces and
    distance of staggered ones from folds, mm; chamfer_slope: length of the chamfer over its
    depth, 0 for none."""

    stagger: float = 200.0
    fold_clearance: float = 100.0
    chamfer_slope: float = 4.0


USUAL_RULES = ThicknessRules()


@dataclass(frozen=True)
class ThicknessChange:
    """A joint of one strip, at arc length `place`, where its thickness or material changes to
    that of segment `segment` (index).

    chamfer: arc lengths between which the thicker plate is chamfered, its depth growing towards
    the joint to `depth`, the difference of thickness; empty and 0 for none.
    """

    place: float
    strip: int
    segment: int
    thick_before: bool
    chamfer: tuple[float, float] | tuple[()] = ()
    depth: float = 0.0

    def depth_at(self, s: float) -> float:
        """How much the thicker plate is thinned at a place of the chamfer, mm."""
        start, end = self.chamfer
        part = (s - start) / (end - start)
        return self.depth * (part if self.thick_before else 1.0 - part)


@dataclass(frozen=True)
class Chamfer:
    """The chamfer at an end of a plate: its length along the axis and its depth, mm; faces: the
    face machined, `inner` or `outer`, or `both`, half the difference of thickness off each."""

    length: float
    depth: float
    faces: str = "inner"

    @property
    def slope(self) -> float:
        """Length over depth."""
        return self.length / self.depth

    @property
    def depths(self) -> tuple[float, float]:
        """What it takes off the outer and off the inner face at the end of the plate, mm."""
        return tuple(
            self.depth if self.faces in (face, "both") else 0.0 for face in ("outer", "inner")
        )


@dataclass(frozen=True, eq=False)
class Span:
    """The axis of a member: length, mm, and whether it closes on itself."""

    length: float
    closed: bool = False

    def row(self, k: int, segments: Sequence[Segment]) -> int:
        """Number of the row of segments[k]; the first one stands at the end of a ring once more."""
        return 1 if self.closed and k == len(segments) - 1 else k + 1


def stagger_offsets(text: str) -> Mapping[str, float] | None:
    """Offset per face, mm, that `face=offset …` asks for; none for `none`, None for `auto`. Raises
    ValueError, saying why, for any other text."""
    words = text.split()
    if words in (["auto"], []):
        return None
    if words == ["none"]:
        return {}
    offsets: dict[str, float] = {}
    for word in words:
        face, equals, figure = word.partition("=")
        try:
            offset = float(figure)
        except ValueError:
            offset = np.nan
        if not (face and equals and np.isfinite(offset) and offset >= 0.0):
            raise ValueError(f"cannot read {word!r}")
        if face in offsets:
            raise ValueError(f"face {face} is given twice")
        offsets[face] = offset
    return offsets


def thickness_changes(
    member: str,
    segments: Sequence[Segment],
    ends: Sequence[float],
    stepped: Sequence[bool],
    abrupt: Sequence[bool],
    axis: Span,
    rules: ThicknessRules,
) -> tuple[tuple[ThicknessChange, ...], tuple[Finding, ...]]:
    """The thickness changes of a member in order of place, and warnings.

    ends: where the transition into segments[k + 1] ends; its plates are the thicker (of the same
    thickness the stronger) of both sides, up to its end on the thinner side, and farther by the
    offset of the face. Offsets `auto`: in the order of the strips, the least that keep joint and
    chamfer clear of the transition and the stagger from the joints of the faces a face meets.
    stepped, abrupt: transitions without length at which a face, or a face or a gap, steps; there
    every face is cut, without offset. On a closed axis segments end with the first again and
    places may lie beyond its length; the changes returned lie on the axis. Raises BendTorsionError
    for offsets that cannot be, and chamfers longer than their plate.
    """
    findings: list[Finding] = []
    placed: list[ThicknessChange] = []
    for k, end in enumerate(ends):
        place = f"segment {axis.row(k + 1, segments)}"
        given = _given_offsets(member, place, segments[k], segments[k + 1], findings)
        for j, before in enumerate(_changing(segments[k], segments[k + 1])):
            if before is None:
                continue
            base = end if before else segments[k + 1].cut
            room = _room(segments, ends, k, before, axis)
            face = segments[k].section.strips[j].face
            if abrupt[k] or _at_seam(base, axis):
                offset = 0.0
            elif given is None:
                clear = _clear_of_fold(segments, k, j, rules) if end > segments[k + 1].cut else 0.0
                offset = _least_offset(segments, placed, j, base, before, room, clear, rules)
            else:
                offset = given.get(face, 0.0)
                if offset > room - tolerances.SHORTEST_PLATE:
                    findings.append(
                        error(
                            "stagger",
                            member,
                            f"the thickness joint of face {face} leaves its segment",
                            f"use at most {max(0.0, room - tolerances.SHORTEST_PLATE):.0f} mm",
                            position=place,
                            value=float(offset),
                            limit=float(max(0.0, room - tolerances.SHORTEST_PLATE)),
                            unit="mm",
                        )
                    )
            joint = base + (offset if before else -offset)
            same = [p for p in (base, *(c.place for c in placed)) if _same(p, joint)]
            placed.append(ThicknessChange(same[0] if same else joint, j, k + 1, before))
    _refuse(findings)
    findings += _too_close(member, segments, placed, abrupt, axis, rules)
    placed = _chamfered(member, segments, ends, stepped, placed, axis, rules, findings)
    _refuse(findings)
    on_axis = [_wrapped(change, axis) for change in placed]
    return tuple(sorted(on_axis, key=lambda change: change.place)), tuple(findings)


def _refuse(findings: Sequence[Finding]) -> None:
    if any(f.severity == "error" for f in findings):
        raise BendTorsionError(findings)


def _changing(before: Segment, after: Segment) -> list[bool | None]:
    """Per strip whether its thicker (or stronger) plate lies before the change; None without."""
    old, new = before.section, after.section
    thick_before: list[bool | None] = []
    for one, other in zip(old.strips, new.strips, strict=True):
        if one.thickness == other.thickness and old.material == new.material:
            thick_before.append(None)
        else:
            mine, its = (one.thickness, old.material.fy), (other.thickness, new.material.fy)
            thick_before.append(mine > its)
    return thick_before


def _given_offsets(member, place, before, after, findings) -> Mapping[str, float] | None:
    try:
        given = stagger_offsets(after.stagger)
    except ValueError as problem:
        findings.append(
            error(
                "stagger",
                member,
                f"stagger: {problem}",
                "write auto, none, or offsets in mm such as top=0 left=200",
                position=place,
                value=after.stagger,
            )
        )
        return {}
    changing = _changing(before, after)
    faces = {
        strip.face: change for strip, change in zip(before.section.strips, changing, strict=True)
    }
    for face in given or ():
        if face not in faces:
            findings.append(
                error(
                    "stagger",
                    member,
                    f"stagger: the section has no face {face!r}",
                    f"use {', '.join(faces)}",
                    position=place,
                    value=after.stagger,
                )
            )
        elif faces[face] is None:
            findings.append(
                warning(
                    "stagger-without-change",
                    member,
                    f"face {face} has an offset but does not change its thickness",
                    "leave the face out of stagger",
                    position=place,
                    value=given[face],
                    unit="mm",
                )
            )
    return given


def _room(segments, ends, k: int, thick_before: bool, axis: Span) -> float:
    """Length of the thinner segment beyond the transition into segments[k + 1], up to the next
    transition, the end of the axis or the seam."""
    if thick_before:
        start = ends[k]
        end = segments[k + 2].cut if k + 2 < len(segments) else axis.length
        if axis.closed and k + 2 == len(segments):
            end = segments[1].cut + axis.length
        borders = [b for b in (axis.length, 2 * axis.length) if b > start + tolerances.SAME_STATION]
        return min([end, *borders]) - start
    end = segments[k + 1].cut
    start = ends[k - 1] if k else (ends[-1] - axis.length if axis.closed else 0.0)
    borders = [b for b in (0.0, axis.length) if b < end - tolerances.SAME_STATION]
    return end - max([start, *borders])


def _same(one: float, other: float) -> bool:
    return abs(one - other) <= tolerances.SAME_STATION


def _at_seam(place: float, axis: Span) -> bool:
    past = place % axis.length if axis.closed else np.inf
    return min(past, axis.length - past) < tolerances.SAME_STATION if axis.closed else False


def _meeting(segments, placed, strip: int) -> np.ndarray:
    """Places of the changes of the strips a strip meets."""
    strips = segments[0].section.strips
    return np.array(
        [
            change.place
            for change in placed
            if change.strip != strip and strips_meet(strips[strip], strips[change.strip])
        ]
    )


def _clear_of_fold(segments, k: int, strip: int, rules: ThicknessRules) -> float:
    """Offset that leaves the whole transition unchamfered and the joint clear of its fold."""
    pair = [segment.section.strips[strip] for segment in segments[k : k + 2]]
    return max(rules.fold_clearance, _chamfer_length(*pair, rules) + _thickest(segments))


def _chamfer_length(one: Strip, other: Strip, rules: ThicknessRules) -> float:
    depth = abs(one.thickness - other.thickness)
    return rules.chamfer_slope * depth * max(1.0 - one.line, one.line)


def _thickest(segments: Sequence[Segment]) -> float:
    return max(strip.thickness for segment in segments for strip in segment.section.strips)


def _least_offset(segments, placed, j, base, thick_before, room, clear, rules) -> float:
    """The least offset, `clear` of the fold, that keeps the stagger; on the fold for want of room,
    also where nothing keeps it."""
    others = _meeting(segments, placed, j)
    way = 1.0 if thick_before else -1.0
    near = [way * (p + side * rules.stagger - base) for p in others for side in (1.0, -1.0)]
    slack = tolerances.SAME_STATION
    for offset in sorted({clear, *near}):
        apart = np.abs(base + way * offset - others)
        fits = clear - slack <= offset and offset <= max(0.0, room - rules.fold_clearance)
        if fits and (apart >= rules.stagger - slack).all():
            return float(offset)
    return 0.0


def _too_close(member, segments, placed, abrupt, axis, rules) -> list[Finding]:
    """One warning for each transition whose thickness joints are too close to an adjacent
    face's."""
    worst: dict[int, tuple[float, ThicknessChange, ThicknessChange]] = {}
    strips = segments[0].section.strips
    for i, one in enumerate(placed):
        for other in placed[:i]:
            if one.strip == other.strip or not strips_meet(strips[one.strip], strips[other.strip]):
                continue
            gap = abs(one.place - other.place)
            if axis.closed:
                gap = min(gap % axis.length, -gap % axis.length)
            every = gap < tolerances.SAME_STATION and (
                abrupt[one.segment - 1] or _at_seam(one.place, axis)
            )
            if not every and gap < min(
                rules.stagger - tolerances.SAME_STATION, worst.get(one.segment, (np.inf,))[0]
            ):
                worst[one.segment] = gap, other, one
    return [
        warning(
            "thickness-joints-not-staggered",
            member,
            f"thickness joints of faces {strips[one.strip].face} and {strips[other.strip].face} "
            "are too close",
            "give them a stagger, or move the cut for more room",
            position=f"segment {axis.row(k, segments)}, "
            f"s = {other.place % axis.length if axis.closed else other.place:.0f} mm",
            value=float(gap),
            limit=rules.stagger,
            unit="mm",
        )
        for k, (gap, one, other) in sorted(worst.items())
    ]


def _chamfered(member, segments, ends, stepped, placed, axis, rules, findings):
    """The changes with their chamfers: slope or flatter, so that none begins beside a fold, where
    the mitres are, or a hair from another break."""
    transitions = [(after.cut, end) for after, end in zip(segments[1:], ends, strict=True)]
    folds = [edge for span in transitions if span[1] > span[0] for edge in span]
    folds += [f + way * axis.length for f in folds for way in (-1, 1)] if axis.closed else []
    breaks = [change.place for change in placed]
    done: list[ThicknessChange] = []
    for change in placed:
        old, new = (segments[change.segment + way].section.strips[change.strip] for way in (-1, 0))
        depth = abs(old.thickness - new.thickness)
        length = _chamfer_length(old, new, rules)
        if not length or stepped[change.segment - 1]:
            done.append(change)
            continue
        way = -1.0 if change.thick_before else 1.0
        begin = change.place + way * length
        for places, clear in (
            (folds, _thickest(segments)),
            (breaks, tolerances.STATION_AT_PLATE_END),
        ):
            for place in sorted(places, key=lambda p: way * p):
                if tolerances.SAME_STATION < abs(begin - place) < clear:
                    begin = place + way * clear
        same = [p for p in breaks if _same(p, begin)]
        begin = same[0] if same else begin
        breaks.append(begin)
        chamfer = (begin, change.place) if change.thick_before else (change.place, begin)
        done.append(replace(change, chamfer=chamfer, depth=depth))
    findings += _too_long(member, segments, done, axis)
    return done


def _too_long(member, segments, changes, axis) -> list[Finding]:
    """Errors of chamfers that leave nothing of the full thickness between two joints."""
    findings = []
    for j, strip in enumerate(segments[0].section.strips):
        own = sorted((c for c in changes if c.strip == j), key=lambda c: c.place)
        borders = (0.0, axis.length, *((2 * axis.length,) if axis.closed else ()))
        edges = np.unique([*borders, *(c.place for c in own)])
        for start, end in zip(edges[:-1], edges[1:], strict=True):
            inside = [
                c
                for c in own
                if c.chamfer and (c.place == end if c.thick_before else c.place == start)
            ]
            total = sum(c.chamfer[1] - c.chamfer[0] for c in inside)
            if not inside or total <= end - start - tolerances.SHORTEST_PLATE:
                continue
            findings.append(
                error(
                    "chamfer-too-long",
                    member,
                    f"the plate of face {strip.face} is shorter than its chamfers",
                    "move the cut or the stagger, or make the difference of thickness smaller",
                    position=f"segment {axis.row(inside[0].segment, segments)}, "
                    f"s = {start:.0f} … {end:.0f} mm",
                    value=float(total),
                    limit=float(end - start - tolerances.SHORTEST_PLATE),
                    unit="mm",
                )
            )
    return findings


def _wrapped(change: ThicknessChange, axis: Span) -> ThicknessChange:
    """The change on the axis of a closed member; at the seam it lies at 0, its chamfer before."""
    if not axis.closed or change.place < axis.length - tolerances.SAME_STATION:
        return change
    place = change.place - axis.length
    place = 0.0 if abs(place) < tolerances.SAME_STATION else place
    chamfer = change.chamfer
    if chamfer and not (change.thick_before and place == 0.0):
        chamfer = (chamfer[0] - axis.length, chamfer[1] - axis.length)
    return replace(change, place=place, chamfer=chamfer)
