# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law: how a member's section is placed and varies along its axis, zone by zone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, note, warning
from ..geometry.piecewise import Piecewise
from ..sections.section import Section
from .cells import Cell, FaceSteps, SectionLaw, powers, shifted
from .segment import Segment, overlap_findings, segment_findings
from .surface_alignment import Lift, lifted, zone_lift
from .thickness import USUAL_RULES, Span, ThicknessChange, ThicknessRules, thickness_changes

SHORTEST_TRANSITION = 2.0
"""Length of a linear transition, over the thickest plate, below which its two mitres meet."""

SMOOTH_STEEPEST = 1.5
"""Steepest slope of a smooth transition over its mean slope."""


def section_law(
    member: str,
    segments: Sequence[Segment],
    length: float,
    offset_y: float = 0.0,
    offset_z: float = 0.0,
    transition_length: str = "face",
    lifts: Sequence[Piecewise | None] = (),
    closed: bool = False,
    rules: ThicknessRules = USUAL_RULES,
) -> SectionLaw:
    """The section law of a member of axis length `length`.

    The cut of segment k + 1 starts transition b-k, which reaches L' = slope · d into it, d the
    largest face-to-face step after alignment (`face`) or the larger change of h and b (`total`,
    the paper's). Sizes, gaps and offsets vary linearly in arc length (paper Eq. 4), or smoothly
    over the same length. Thicknesses change beside a transition's end on the thinner side
    (`thickness_changes`). offset_y, offset_z: of the whole member. lifts: of the segments, as
    `surface_lifts` gives them.

    closed: the axis is a ring. The cut of segment 1 starts the transition from the last segment
    to the first, which may run through the seam s = 0; without a cut it ends at the seam.

    Raises BendTorsionError for a change of type or strips, cuts out of order or beyond the axis,
    transitions that overlap or run past the end, and as thickness_changes does.
    """
    axis = Span(length, closed)
    segments = [
        replace(segment, cut=segment.cut * length, cut_is_ratio=False)
        if segment.cut_is_ratio
        else segment
        for segment in segments
    ]
    lifts = tuple(lifts or (None,) * len(segments))
    findings = segment_findings(member, segments, axis)
    if findings:
        raise BendTorsionError(findings)
    centres = _placed(segments, offset_y, offset_z)
    if closed and len(segments) > 1:
        cut = segments[0].cut or _closing_cut(segments, centres, lifts, length, transition_length)
        cut += length if cut <= segments[-1].cut else 0.0
        segments = [*segments, replace(segments[0], cut=cut)]
        centres, lifts = [*centres, centres[0]], (*lifts, lifts[0])
    placed = [
        np.asarray(segment.section.corners) + centre
        for segment, centre in zip(segments, centres, strict=True)
    ]
    steps = _all_steps(segments, centres, lifts, length)
    ends = [
        later.cut + _reach(before, later, step, transition_length)
        for before, later, step in zip(segments[:-1], segments[1:], steps, strict=True)
    ]
    findings = overlap_findings(member, segments, ends, axis)
    if findings:
        raise BendTorsionError(findings)

    stepped = [
        end == later.cut and step.largest > tolerances.FACES_FLUSH
        for end, later, step in zip(ends, segments[1:], steps, strict=True)
    ]
    abrupt = [
        end == segments[k + 1].cut
        and (
            stepped[k]
            or not np.allclose(_gaps(segments[k].section), _gaps(segments[k + 1].section))
        )
        for k, end in enumerate(ends)
    ]
    changes, warnings = thickness_changes(member, segments, ends, stepped, abrupt, axis, rules)
    zones = _zones(segments, placed, ends, axis)
    cells = tuple(
        replace(cell, lift=_lift_of(cell, segments, ends, lifts, length)) if any(lifts) else cell
        for cell in _cells(segments, zones, changes, axis)
    )
    smooth = [
        note(
            "smooth-transition-steeper",
            member,
            f"transition b-{k} is steepest in its middle",
            f"set its slope to {SMOOTH_STEEPEST * later.slope:g} for 1:{later.slope:g} there",
            position=f"segment {axis.row(k, segments)}",
            value=f"1:{later.slope / SMOOTH_STEEPEST:.3g}",
            limit=f"1:{later.slope:g}",
        )
        for k, later in enumerate(segments[1:], start=1)
        if later.transition == "smooth" and ends[k - 1] > later.cut
    ]
    thickest = max(strip.thickness for one in segments for strip in one.section.strips)
    short = [
        warning(
            "transition-short",
            member,
            f"transition b-{k} is too short for the mitres of its plates at both its ends",
            "use a greater slope, or slope 0 for a step",
            position=f"segment {axis.row(k, segments)}",
            value=float(ends[k - 1] - later.cut),
            limit=float(SHORTEST_TRANSITION * thickest),
            unit="mm",
        )
        for k, later in enumerate(segments[1:], start=1)
        if 0.0 < ends[k - 1] - later.cut < SHORTEST_TRANSITION * thickest
        and later.transition == "linear"
    ]
    joints = {segments[k + 1].cut for k, every_face in enumerate(abrupt) if every_face}
    if closed:
        joints = {place % length for place in joints} - {0.0}
    folds = [
        cell.start
        for before, cell in zip(cells[:-1], cells[1:], strict=True)
        if _slopes_differ(before, cell)
    ]
    sections = segments[:-1] if len(centres) > 1 and closed else segments
    return SectionLaw(
        tuple(segment.section for segment in sections),
        cells,
        tuple(sorted(joints)),
        tuple(folds),
        tuple(steps),
        (*warnings, *short, *smooth),
        changes,
    )


def _all_steps(segments, centres, lifts, length: float) -> list[FaceSteps]:
    return [
        _face_steps(
            segments[k],
            lifted(centres[k], lifts[k], segments[k + 1].cut % length),
            segments[k + 1],
            lifted(centres[k + 1], lifts[k + 1], segments[k + 1].cut % length),
        )
        for k in range(len(segments) - 1)
    ]


def _reach(before: Segment, after: Segment, step: FaceSteps, transition_length: str) -> float:
    """Length of the transition between two segments."""
    if step.largest <= tolerances.FACES_FLUSH:
        return 0.0
    size = step.largest
    if transition_length == "total":
        one, two = before.section, after.section
        size = max(abs(two.h - one.h), abs(two.b - one.b)) or size
    return after.slope * size


def _closing_cut(segments, centres, lifts, length: float, transition_length: str) -> float:
    """Where the transition from the last segment to the first starts to end at the seam."""
    last, first = segments[-1], replace(segments[0], cut=length)
    [step] = _all_steps([last, first], [centres[-1], centres[0]], [lifts[-1], lifts[0]], length)
    return length - _reach(last, first, step, transition_length)


def _lift_of(cell: Cell, segments, ends, lifts, length: float) -> Lift | None:
    """The lift of a cell; of a transition through the seam, behind the seam too."""
    lift = zone_lift(cell.label, segments, ends, lifts)
    if lift is not None and cell.is_transition and lift.start > cell.end:
        return replace(lift, start=lift.start - length, end=lift.end - length)
    return lift


def _placed(segments: Sequence[Segment], offset_y: float, offset_z: float) -> list[np.ndarray]:
    """Centre (y, z) of each segment's section."""
    centres: list[np.ndarray] = []
    for k, segment in enumerate(segments):
        h, b = segment.section.h, segment.section.b
        if segment.align_to == "previous" and k:
            reference = centres[-1]
            half_b, half_h = segments[k - 1].section.b / 2, segments[k - 1].section.h / 2
        else:
            reference, half_b, half_h = np.array([offset_y, offset_z]), 0.0, 0.0
        y, z = reference
        if "left" in segment.align:
            y += half_b - b / 2
        elif "right" in segment.align:
            y -= half_b - b / 2
        if "top" in segment.align:
            z += half_h - h / 2
        elif "bottom" in segment.align:
            z -= half_h - h / 2
        centres.append(np.array([y + segment.offset_y, z + segment.offset_z]))
    return centres


def _face_steps(
    before: Segment, centre_before: np.ndarray, after: Segment, centre_after: np.ndarray
) -> FaceSteps:
    dy, dz = centre_after - centre_before
    half_b = (after.section.b - before.section.b) / 2
    half_h = (after.section.h - before.section.h) / 2
    return FaceSteps(dz + half_h, dz - half_h, dy + half_b, dy - half_b)


def _gaps(section: Section) -> np.ndarray:
    """Root gaps (strips, 2) of a section at the first and second ends."""
    return np.array(
        [[stop[1] if stop else 0.0 for stop in strip.stops] for strip in section.strips]
    )


def _zones(
    segments: Sequence[Segment], placed: Sequence[np.ndarray], ends: Sequence[float], axis: Span
) -> list[tuple]:
    """(label, start, end, corners and gaps as powers of arc length) of the zones along the axis;
    what runs past the seam of a closed axis comes first."""
    ring = axis.closed and len(segments) > 1
    spans = []
    start = max(0.0, ends[-1] - axis.length) if ring else 0.0
    for k, segment in enumerate(segments):
        if k:
            if ends[k - 1] > segment.cut:
                spans.append((f"b-{k}", segment.cut, ends[k - 1], k - 1, k))
            start = ends[k - 1]
        end = segments[k + 1].cut if k + 1 < len(segments) else axis.length
        if start < end - tolerances.SAME_STATION or not ring:
            spans.append((f"d-{axis.row(k, segments)}", start, end, k, k))
    zones = []
    for label, a, b, i, j in spans:
        smooth = i != j and segments[j].transition == "smooth"
        laws = [
            powers(first, last, b - a, smooth)
            for first, last in (
                (placed[i], placed[j]),
                (_gaps(segments[i].section), _gaps(segments[j].section)),
            )
        ]
        seam = axis.length
        if not ring or b <= seam + tolerances.SAME_STATION:
            zones.append((label, a, min(b, seam), *laws))
        elif a >= seam - tolerances.SAME_STATION:
            zones.append((label, max(0.0, a - seam), b - seam, *laws))
        else:
            zones.append((label, a, seam, *laws))
            behind = [_beyond(law, seam - a) for law in laws]
            zones.append((label, 0.0, b - seam, *behind))
    return sorted(zones, key=lambda zone: zone[1])


def _beyond(law: list[np.ndarray], d: float) -> list[np.ndarray]:
    """Coefficients of powers about a point d farther on."""
    value, rate, bends = shifted(law, d)
    return [value, rate, *(() if bends is None else bends)]


def _cells(
    segments: Sequence[Segment],
    zones: list,
    changes: Sequence[ThicknessChange],
    axis: Span,
):
    """The zones, cut where a thickness changes or a chamfer begins or ends inside one."""
    same = tolerances.SAME_STATION
    breaks = sorted({p for change in changes for p in (change.place, *change.chamfer)})
    strips = range(len(segments[0].section.strips))
    for label, start, end, corner_powers, gap_powers in zones:
        edges = [start, *(p for p in breaks if start + same < p < end - same), end]
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            rows = [_segment_at(changes, j, a + same, axis) for j in strips]
            corners, corner_rates, corner_bends = shifted(corner_powers, a - start)
            gaps, gap_rates, gap_bends = shifted(gap_powers, a - start)
            yield Cell(
                label,
                a,
                b,
                corners,
                corner_rates,
                gaps,
                gap_rates,
                np.array([segments[k].section.strips[j].thickness for j, k in enumerate(rows)]),
                tuple(segments[k].section.material for k in rows),
                corner_bends,
                gap_bends,
                chamfer=_chamfer(changes, len(strips), a, b),
            )


def _segment_at(changes: Sequence[ThicknessChange], strip: int, s: float, axis: Span) -> int:
    """The segment whose thickness a strip has at a place; changes in order of place."""
    own = [change for change in changes if change.strip == strip]
    before = [change for change in own if change.place <= s]
    if before:
        return before[-1].segment
    return own[-1].segment if own and axis.closed else 0


def _chamfer(
    changes: Sequence[ThicknessChange], count: int, start: float, end: float
) -> np.ndarray | None:
    """Depths and rates (2, count) of the chamfers over a stretch without breaks, or None."""
    middle = 0.5 * (start + end)
    chamfer = None
    for change in changes:
        if change.chamfer and change.chamfer[0] < middle < change.chamfer[1]:
            chamfer = np.zeros((2, count)) if chamfer is None else chamfer
            at = change.depth_at(start)
            chamfer[:, change.strip] = at, (change.depth_at(end) - at) / (end - start)
    return chamfer


def _slopes_differ(before: Cell, after: Cell) -> bool:
    change = after.corner_rates - before.end_rates
    for cell, sign in ((before, -1.0), (after, 1.0)):
        if cell.lift is not None:
            change = change + [0.0, sign * cell.lift.at([after.start])[1][0]]
    return bool(np.abs(change).max() > 1e-12)
