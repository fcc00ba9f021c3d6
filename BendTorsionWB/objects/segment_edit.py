# SPDX-License-Identifier: LGPL-2.1-or-later
"""Segments of a Member added and taken away: the ones behind move up or down."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from BendTorsionWB.core.axes.axis_places import cut_place
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects.member import (
    cut_of,
    reach,
    refuse_many_segments,
    segment_count,
    segment_properties,
)
from BendTorsionWB.objects.proxy import linked

NAMES = tuple(item.name.removesuffix("1") for item in segment_properties(1))
"""Properties of a segment without its number."""


def add_cut(
    member, place: float | Sequence[float], section=None, slope: float | None = None
) -> int:
    """Divide a segment of a Member at a place (mm on the axis), or at the place nearest to a
    point (x, y, z); the number of the new segment, which has the section and the slope given or
    those of the one divided. Raises BendTorsionError for a place that is no use."""
    axis = axis_object.value(linked(member, "Axis", "Axis"))
    if isinstance(place, int | float):
        s = float(place)
    else:
        s = cut_place(axis, point=np.array(tuple(place), float), reach=reach(member))
    if not 0.0 < s < axis.length:
        raise BendTorsionError(
            error(
                "cut-outside",
                member.Label,
                "the cut is not between the ends of the member",
                "give a place between them",
                value=s,
                limit=axis.length,
                unit="mm",
            )
        )
    refuse_many_segments(member, member.Segments + 1)
    before = [cut_length(member, k, axis) for k in range(2, member.Segments + 1)]
    new = 2 + sum(cut < s for cut in before)
    member.Segments += 1
    for k in range(member.Segments, new, -1):
        _copy(member, k - 1, k)
    _copy(member, new - 1, new)
    setattr(member, f"CutBy{new}", "place")
    setattr(member, f"CutRatio{new}", 0.0)
    setattr(member, f"CutOffset{new}", 0.0)
    setattr(member, f"Cut{new}", s)
    if section is not None:
        setattr(member, f"Section{new}", section)
    if slope is not None:
        setattr(member, f"Slope{new}", slope)
    return new


def middle_of(member, number: int) -> float:
    """The middle of a segment between its cut and the next, mm along the axis. Raises
    BendTorsionError for a member whose axis or cuts cannot be."""
    axis = axis_object.value(linked(member, "Axis", "Axis"))
    cuts = [cut_length(member, k, axis) for k in range(2, segment_count(member) + 1)]
    ends = [0.0, *cuts, axis.length]
    return round(0.5 * (ends[number - 1] + ends[number]), 1)


def remove_segment(member, number: int) -> None:
    """Take a segment away: the one before runs on to the next cut; of the first, the second takes
    its place. Raises BendTorsionError for the only segment or a number that is none."""
    if not 1 <= number <= member.Segments or member.Segments == 1:
        raise BendTorsionError(
            error(
                "segments",
                member.Label,
                f"segment {number} cannot be taken away",
                "a member needs one segment",
                value=number,
                limit=member.Segments,
            )
        )
    first_cut = {name: getattr(member, f"{name}1") for name in NAMES if name.startswith("Cut")}
    for k in range(number, member.Segments):
        _copy(member, k + 1, k)
    if number == 1:
        for name, value in first_cut.items():
            setattr(member, f"{name}1", value)
    member.Segments -= 1


def cut_length(member, k: int, axis) -> float:
    """Arc length of the cut before segment k on an axis, mm; raises BendTorsionError for a cut that
    has no place."""
    cut, is_ratio = cut_of(member, k, axis)
    return cut * axis.length if is_ratio else cut


def _copy(member, source: int, target: int) -> None:
    for name in NAMES:
        setattr(member, f"{name}{target}", getattr(member, f"{name}{source}"))
