# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member's segments, the rows of sheet Members, and what can be wrong with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..finding import Finding, error
from ..sections.section import Section, Strip
from .surface_alignment import not_held
from .thickness import Span

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
ALIGN_TO = ("axis", "previous", "surface")
TRANSITION_LENGTHS = ("face", "total")
TRANSITIONS = ("linear", "smooth")


@dataclass(frozen=True)
class Segment:
    """One row of the Members sheet: a section from its cut (mm on the axis, or a part of its
    length when cut_is_ratio) onwards.

    slope: length of the transition before it per millimetre of step, 0 for a step. align,
    align_to: position of the section on the axis, on the previous segment as placed, or its top
    or bottom face at a constant distance (the offsets in z) from the surface itself.
    transition: `linear`, with a fold at each end, or `smooth` (3x² − 2x³), without folds.
    stagger: offsets of its faces' thickness joints: `auto`, `none`, or `top=0 left=200` in mm.
    On a closed axis the cut, slope and transition of segment 1 are those of the transition from
    the last segment to it.
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
    stagger: str = "auto"


def segment_findings(member: str, segments: Sequence[Segment], axis: Span) -> list[Finding]:
    """Errors of segments by themselves; cuts in mm."""
    findings = _first_cut(member, segments, axis)
    length = axis.length
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
        findings += not_held(member, segment, place)
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


def _first_cut(member: str, segments: Sequence[Segment], axis: Span) -> list[Finding]:
    """Errors of the cut of segment 1, which only a closed axis has: it lies after the last cut or
    before the second."""
    cut, others = segments[0].cut, [segment.cut for segment in segments[1:]]
    if not cut:
        return []
    if not axis.closed:
        message, mend = (
            "segment 1 starts with the axis and has no cut",
            "empty it, or close the axis: the cut then starts the closing transition",
        )
        limit = 0.0
    elif others and (others[-1] < cut <= axis.length or 0.0 < cut < others[0]):
        return []
    elif not others:
        message, limit = "a ring of one segment has no closing transition", 0.0
        mend = "empty the cut, or add a segment"
    else:
        message, limit = "the closing cut does not lie after the last cut", others[-1]
        mend = "move it between the last cut and the seam, or between the seam and the next cut"
    return [
        error(
            "cut-on-first-segment",
            member,
            message,
            mend,
            position="segment 1",
            value=float(cut),
            limit=float(limit),
            unit="mm",
        )
    ]


def _pattern(strip: Strip) -> tuple:
    """What of a strip must not change along a member."""
    stops = [stop and (stop.face, stop.at) for stop in strip.stops]
    return strip.face, strip.letter, strip.first, strip.second, strip.inward, strip.line, *stops


def overlap_findings(
    member: str, segments: Sequence[Segment], ends: Sequence[float], axis: Span
) -> list[Finding]:
    """Errors of transitions that run past the next cut or the end; ends: where they end."""
    limits = [segment.cut for segment in segments[2:]]
    limits.append(segments[1].cut + axis.length if axis.closed and ends else axis.length)
    findings = []
    for k, (end, limit) in enumerate(zip(ends, limits, strict=False), start=1):
        if end <= limit - tolerances.SAME_STATION or end <= segments[k].cut:
            continue
        last = k == len(segments) - 1 and not axis.closed
        room = limit - segments[k].cut
        following = axis.row(k + 1, segments) if k + 1 < len(segments) else 2
        findings.append(
            error(
                "transition-past-end" if last else "transitions-overlap",
                member,
                f"transition b-{k} of {end - segments[k].cut:.1f} mm runs past "
                + ("the end of the axis" if last else f"the cut of segment {following}"),
                f"move the cut back by {end - limit:.1f} mm or more, or use a slope below "
                f"{segments[k].slope * max(room, 0.0) / (end - segments[k].cut):.2f}",
                position=f"segment {axis.row(k, segments)}",
                value=float(end),
                limit=float(limit),
                unit="mm",
            )
        )
    return findings
