# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law: how a member's section is placed and varies along its axis, zone by zone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from . import tolerances
from .cells import Cell, FaceSteps, SectionLaw, powers, shifted
from .finding import BendTorsionError, Finding, error, note, warning
from .section import Section, Strip

DEFAULT_SLOPE = 2.5
ALIGNMENTS = (
    "centre",
    "top",
    "bottom",
    "left",
    "right",
    "top-left",
    "top-right",
    "bottom-left",
    "bottom-right",
)
ALIGN_TO = ("axis", "previous")
TRANSITION_LENGTHS = ("face", "total")
TRANSITIONS = ("linear", "smooth")
SMOOTH_STEEPEST = 1.5
"""Steepest slope of a smooth transition over its mean slope."""


@dataclass(frozen=True)
class Segment:
    """One row of the Members sheet: a section from its cut (mm on the axis, or a part of its
    length when cut_is_ratio) onwards.

    slope: length of the transition before it per millimetre of step, 0 for a step. align,
    align_to: position of the section on the axis or on the previous segment as placed.
    transition: `linear`, with a fold at each end, or `smooth` (3x² − 2x³), without folds.
    """

    section: Section
    cut: float = 0.0
    slope: float = DEFAULT_SLOPE
    align: str = "centre"
    align_to: str = "axis"
    offset_y: float = 0.0
    offset_z: float = 0.0
    cut_is_ratio: bool = False
    transition: str = "linear"


def section_law(
    member: str,
    segments: Sequence[Segment],
    length: float,
    offset_y: float = 0.0,
    offset_z: float = 0.0,
    transition_length: str = "face",
) -> SectionLaw:
    """The section law of a member of axis length `length`.

    The cut of segment k + 1 starts transition b-k, which reaches L' = slope · d into it, d the
    largest face-to-face step after alignment (`face`) or the larger change of h and b (`total`,
    the paper's). Sizes, gaps and offsets vary linearly in arc length (paper Eq. 4), or smoothly
    over the same length. Thicknesses change at a transition's end on the thinner side. offset_y,
    offset_z: of the whole member. Raises BendTorsionError for a change of type or strips, cuts
    out of order or beyond the axis, and transitions that overlap or run past the end.
    """
    segments = [
        replace(segment, cut=segment.cut * length, cut_is_ratio=False)
        if segment.cut_is_ratio
        else segment
        for segment in segments
    ]
    findings = _segment_findings(member, segments, length)
    if findings:
        raise BendTorsionError(findings)
    centres = _placed(segments, offset_y, offset_z)
    placed = [
        np.asarray(segment.section.corners) + centre
        for segment, centre in zip(segments, centres, strict=True)
    ]
    steps = [
        _face_steps(segments[k], centres[k], segments[k + 1], centres[k + 1])
        for k in range(len(segments) - 1)
    ]
    ends = []
    for k, step in enumerate(steps):
        later = segments[k + 1]
        size = step.largest
        if transition_length == "total":
            before, after = segments[k].section, later.section
            size = max(abs(after.h - before.h), abs(after.b - before.b)) or size
        reach = later.slope * size if step.largest > tolerances.FACES_FLUSH else 0.0
        ends.append(later.cut + reach)
    findings = _overlaps(member, segments, ends, length)
    if findings:
        raise BendTorsionError(findings)

    changes = _thickness_changes(segments, ends)
    zones = _zones(segments, placed, ends, length)
    cells = tuple(_cells(segments, zones, changes))
    joints = {place for place, _, _ in changes}
    warnings = [
        warning(
            "thickness-joints-not-staggered",
            member,
            "all faces change thickness in one section plane",
            "stagger the joints of the faces by hand where the rules ask for it",
            position=f"s = {place:.0f} mm",
        )
        for place in sorted(joints)
    ]
    warnings += [
        note(
            "smooth-transition-steeper",
            member,
            f"transition b-{k} is steepest in its middle",
            f"set its slope to {SMOOTH_STEEPEST * later.slope:g} for 1:{later.slope:g} there",
            position=f"segment {k + 1}",
            value=f"1:{later.slope / SMOOTH_STEEPEST:.3g}",
            limit=f"1:{later.slope:g}",
        )
        for k, later in enumerate(segments[1:], start=1)
        if later.transition == "smooth" and ends[k - 1] > later.cut
    ]
    for k, step in enumerate(steps):
        gaps_differ = not np.allclose(_gaps(segments[k].section), _gaps(segments[k + 1].section))
        abrupt = ends[k] == segments[k + 1].cut
        if abrupt and (step.largest > tolerances.FACES_FLUSH or gaps_differ):
            joints.add(segments[k + 1].cut)
    folds = [
        cell.start
        for before, cell in zip(cells[:-1], cells[1:], strict=True)
        if _slopes_differ(before, cell)
    ]
    return SectionLaw(
        tuple(segment.section for segment in segments),
        cells,
        tuple(sorted(joints)),
        tuple(folds),
        tuple(steps),
        tuple(warnings),
    )


def _segment_findings(member: str, segments: Sequence[Segment], length: float) -> list[Finding]:
    findings = []
    first_type = segments[0].section.type
    first_strips = [_pattern(strip) for strip in segments[0].section.strips]
    previous_cut = 0.0
    for number, segment in enumerate(segments, start=1):
        place = f"segment {number}"
        if segment.section.type != first_type:
            findings.append(
                error(
                    "type-change",
                    member,
                    "section type changes within the member",
                    f"use sections of type {first_type}, or start another member",
                    position=place,
                    value=segment.section.type,
                    limit=first_type,
                )
            )
        elif [_pattern(s) for s in segment.section.strips] != first_strips:
            findings.append(
                error(
                    "strips-change",
                    member,
                    "the strips of the section change within the member",
                    "use sections with the same strips, or start another member",
                    position=place,
                    value=len(segment.section.strips),
                    limit=len(first_strips),
                )
            )
        if segment.transition not in TRANSITIONS:
            findings.append(
                error(
                    "transition-kind",
                    member,
                    f"transition {segment.transition!r} is not known",
                    f"use {' or '.join(TRANSITIONS)}",
                    position=place,
                )
            )
        if segment.align not in ALIGNMENTS or segment.align_to not in ALIGN_TO:
            findings.append(
                error(
                    "alignment",
                    member,
                    f"alignment {segment.align!r} to {segment.align_to!r} is not known",
                    f"use one of {', '.join(ALIGNMENTS)} to {' or '.join(ALIGN_TO)}",
                    position=place,
                )
            )
        if not (np.isfinite(segment.slope) and segment.slope >= 0):
            findings.append(
                error(
                    "slope",
                    member,
                    "slope must be zero (a step) or positive",
                    f"use {DEFAULT_SLOPE}",
                    position=place,
                    value=float(segment.slope),
                    limit=0.0,
                )
            )
        if number == 1:
            continue
        if not previous_cut < segment.cut < length:
            beyond = segment.cut >= length
            findings.append(
                error(
                    "cut-beyond-axis" if beyond else "cut-order",
                    member,
                    "cut lies beyond the end of the axis"
                    if beyond
                    else "cut does not lie after the cut before it",
                    "move the cut",
                    position=place,
                    value=float(segment.cut),
                    limit=float(length if beyond else previous_cut),
                    unit="mm",
                )
            )
        previous_cut = segment.cut
    return findings


def _pattern(strip: Strip) -> tuple:
    """What of a strip must not change along a member."""
    stops = [
        stop and (stop.face, stop.at) for stop in (strip.stops_at_first, strip.stops_at_second)
    ]
    return strip.face, strip.letter, strip.first, strip.second, strip.inward, strip.line, *stops


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


def _overlaps(
    member: str, segments: Sequence[Segment], ends: Sequence[float], length: float
) -> list[Finding]:
    limits = [segment.cut for segment in segments[2:]] + [length]
    findings = []
    for k, (end, limit) in enumerate(zip(ends, limits, strict=False), start=1):
        if end > limit - tolerances.SAME_STATION and end > segments[k].cut:
            last = k == len(segments) - 1
            findings.append(
                error(
                    "transition-past-end" if last else "transitions-overlap",
                    member,
                    f"transition b-{k} runs past "
                    + ("the end of the axis" if last else f"the cut of segment {k + 2}"),
                    f"move the cut back by {end - limit:.1f} mm or more, or use a smaller slope",
                    position=f"segment {k + 1}",
                    value=float(end),
                    limit=float(limit),
                    unit="mm",
                )
            )
    return findings


def _gaps(section: Section) -> np.ndarray:
    """Root gaps (strips, 2) of a section at the first and second ends."""
    return np.array(
        [
            [stop[1] if stop else 0.0 for stop in (strip.stops_at_first, strip.stops_at_second)]
            for strip in section.strips
        ]
    )


def _thickness_changes(
    segments: Sequence[Segment], ends: Sequence[float]
) -> list[tuple[float, int, int]]:
    """(place, strip, later segment) of each change of thickness or material."""
    changes = []
    for k, end in enumerate(ends):
        before, after = segments[k].section, segments[k + 1].section
        for j, (old, new) in enumerate(zip(before.strips, after.strips, strict=True)):
            if old.thickness != new.thickness or before.material != after.material:
                place = end if old.thickness > new.thickness else segments[k + 1].cut
                changes.append((place, j, k + 1))
    return changes


def _zones(
    segments: Sequence[Segment],
    placed: Sequence[np.ndarray],
    ends: Sequence[float],
    length: float,
) -> list[tuple]:
    """(label, start, end, corners and gaps as powers of arc length) of the zones along the axis."""
    zones = []
    start = 0.0
    for k, segment in enumerate(segments):
        if k:
            if ends[k - 1] > segment.cut:
                zones.append((f"b-{k}", segment.cut, ends[k - 1], k - 1, k))
            start = ends[k - 1]
        end = segments[k + 1].cut if k + 1 < len(segments) else length
        zones.append((f"d-{k + 1}", start, end, k, k))
    return [
        (
            label,
            a,
            b,
            powers(placed[i], placed[j], b - a, i != j and segments[j].transition == "smooth"),
            powers(
                _gaps(segments[i].section),
                _gaps(segments[j].section),
                b - a,
                i != j and segments[j].transition == "smooth",
            ),
        )
        for label, a, b, i, j in zones
    ]


def _cells(segments: Sequence[Segment], zones: list, changes: list[tuple[float, int, int]]):
    """The zones, cut where a thickness changes inside one."""
    first = segments[0].section
    for label, start, end, corner_powers, gap_powers in zones:
        inner = {place for place, _, _ in changes if start < place < end}
        edges = [start, *sorted(inner), end]
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            thickness = np.array([strip.thickness for strip in first.strips])
            materials = [first.material] * len(first.strips)
            for place, j, k in changes:
                if place <= a:
                    thickness[j] = segments[k].section.strips[j].thickness
                    materials[j] = segments[k].section.material
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
                thickness,
                tuple(materials),
                corner_bends,
                gap_bends,
            )


def _slopes_differ(before: Cell, after: Cell) -> bool:
    return bool(np.abs(before.end_rates - after.corner_rates).max() > 1e-12)
