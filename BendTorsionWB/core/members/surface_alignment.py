# SPDX-License-Identifier: LGPL-2.1-or-later
"""Alignment to the surface itself: how far a section is lifted off the axis to keep a face at a
constant distance from the surface, where the axis is not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..axes.frames import Frames
from ..finding import BendTorsionError, Finding, error, warning
from ..geometry.piecewise import Piecewise, resolve
from ..geometry.surface import Surface

if TYPE_CHECKING:
    from .segment import Segment

FLATTEST = 0.2
"""Least cosine between the surface normal and the section's height: below it, moving the section
along its height hardly changes its distance from the surface."""
SETTLED = 1e-7
"""mm: Newton steps below this are followed by one more, which leaves rounding."""
RESOLVED = 5e4
"""Size, mm, the lift is resolved against: to 1e-7 mm."""


@dataclass(frozen=True, eq=False)
class Lift:
    """What is added to the heights (z) of a section between two places, mm: that of the segment
    before going over to that of the segment after, linearly or smoothly; None where a segment
    has none. Defined beyond both ends too, for mitres."""

    first: Piecewise | None
    last: Piecewise | None
    start: float
    end: float
    smooth: bool = False

    def at(self, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The lift and its rate per mm of arc length, (n,) each, at s (n,)."""
        s = np.atleast_1d(np.asarray(s, float))
        first = _value_and_rate(self.first, s)
        if self.first is self.last:
            return first
        last = _value_and_rate(self.last, s)
        length = self.end - self.start
        x = (s - self.start) / length
        part, rate = (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)) if self.smooth else (x, 1.0)
        return (
            (1.0 - part) * first[0] + part * last[0],
            (1.0 - part) * first[1] + part * last[1] + (last[0] - first[0]) * rate / length,
        )

    @cached_property
    def breaks(self) -> np.ndarray:
        """Where the lift is less than smooth."""
        parts = [one.breaks for one in (self.first, self.last) if one is not None]
        return np.unique(np.concatenate(parts)) if parts else np.empty(0)


def _value_and_rate(lift: Piecewise | None, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if lift is None:
        return np.zeros(len(s)), np.zeros(len(s))
    # Beyond the ends of the axis, where cut plates reach, it runs on straight.
    inside = s.clip(lift.start, lift.end)
    rate = lift.derivative(inside)[:, 0]
    return lift(inside)[:, 0] + (s - inside) * rate, rate


def surface_lifts(
    member: str,
    segments: Sequence[Segment],
    frames: Frames,
    surface: Surface,
    offset_y: float = 0.0,
    offset_z: float = 0.0,
) -> tuple[tuple[Piecewise | None, ...], tuple[Finding, ...]]:
    """Per segment the lift s -> (1,) over the whole axis that holds it to the surface, or None,
    and findings.

    A segment aligned to the surface by its top (bottom) face keeps the middle of that face's
    outer line, in every section plane, at the distance offset_z + its own offset from the surface
    (positive outwards), measured along the surface's normal. A segment aligned to one before
    it keeps that one's lift. With a preset the distance is kept on the design axis. Raises
    BendTorsionError where the surface has no single normal or runs along the section's height.
    """
    made: dict[tuple[float, float], Piecewise] = {}
    lifts: list[Piecewise | None] = []
    findings: list[Finding] = []
    for number, segment in enumerate(segments, start=1):
        if segment.align_to == "previous" and lifts:
            lifts.append(lifts[-1])
        elif segment.align_to == "surface" and held_face(segment.align):
            side = ("left" in segment.align) - ("right" in segment.align)
            y = offset_y + segment.offset_y - side * segment.section.b / 2
            distance = offset_z + segment.offset_z
            if (y, distance) not in made:
                made[y, distance] = _lift(
                    member, f"segment {number}", frames, surface, y, distance, findings
                )
            lifts.append(made[y, distance])
        else:
            lifts.append(None)
    return tuple(lifts), tuple(findings)


def held_face(align: str) -> str:
    """The face of an alignment that a surface can hold: `top`, `bottom`, or none."""
    return next((face for face in ("top", "bottom") if face in align), "")


def not_held(member: str, segment: Segment, position: str) -> list[Finding]:
    """The error of an alignment to the surface that names no face a surface can hold."""
    if segment.align_to != "surface" or held_face(segment.align):
        return []
    return [
        error(
            "alignment",
            member,
            f"a surface cannot hold alignment {segment.align!r}: only the top or the bottom face "
            "can stay at a distance from it",
            "align top or bottom, with left or right if need be, or align to the axis",
            position=position,
            value=segment.align,
        )
    ]


def lifted(centre: np.ndarray, lift: Piecewise | None, place: float) -> np.ndarray:
    """The centre (y, z) of a section with its lift at a place."""
    return centre if lift is None else centre + [0.0, float(lift(place)[0, 0])]


def zone_lift(
    label: str,
    segments: Sequence[Segment],
    ends: Sequence[float],
    lifts: Sequence[Piecewise | None],
) -> Lift | None:
    """The lift of the cells of zone `d-k` or `b-k`; ends: where the transitions end."""
    kind, number = label.split("-")
    last = int(number) - (kind == "d")
    first = last - (kind == "b")
    if lifts[first] is None and lifts[last] is None:
        return None
    start, end = (segments[last].cut, ends[first]) if first != last else (0.0, 1.0)
    return Lift(lifts[first], lifts[last], start, end, segments[last].transition == "smooth")


def _lift(
    member: str,
    position: str,
    frames: Frames,
    surface: Surface,
    y: float,
    distance: float,
    findings: list[Finding],
) -> Piecewise:
    axis = frames.axis
    outside: list[float] = []

    def lift(s: np.ndarray) -> np.ndarray:
        at = frames.at(s)
        start = axis.surface_points(s) + y * at.y
        height = np.full(len(s), distance)
        settled = False
        for _ in range(30):
            foot = surface.closest(start + height[:, None] * at.z)
            slope = (foot.normals * at.z).sum(axis=1)
            _refuse_aside(member, position, s, slope, foot.ambiguous)
            step = (foot.distance - distance) / slope
            height = height - step
            if settled:
                outside.extend(s[foot.outside].tolist())
                return height - distance
            settled = bool(np.abs(step).max() < SETTLED)
        worst = int(np.argmax(np.abs(step)))
        raise _no_place(
            member,
            f"{position}, s = {s[worst]:.0f} mm",
            "no height of the section keeps the face at its distance",
            float(distance),
            "mm",
        )

    found = resolve(
        lift, frames.breaks, max(RESOLVED, float(np.abs(frames.at([0.0]).origin).max()))
    )
    if outside:
        findings.append(
            warning(
                "alignment-surface-border",
                member,
                "the aligned face lies past the border of the surface",
                "shorten the member, or extend the surface",
                position=f"{position}, s = {min(outside):.0f} mm",
            )
        )
    return found


def _refuse_aside(member, position, s, slope, ambiguous) -> None:
    bad = ambiguous | ~(np.abs(slope) >= FLATTEST)
    if not bad.any():
        return
    worst = int(np.argmin(np.where(ambiguous, -1.0, np.abs(slope))))
    raise _no_place(
        member,
        f"{position}, s = {s[worst]:.0f} mm",
        "the surface has no single normal at the aligned face"
        if ambiguous[worst]
        else "the section's height runs along the surface, not towards it",
        float(slope[worst]),
        "",
    )


def _no_place(member, position, message, value, unit) -> BendTorsionError:
    return BendTorsionError(
        error(
            "alignment-to-surface",
            member,
            message,
            "align to the axis, use frame surface, or bring the axis nearer to the surface",
            position=position,
            value=value,
            limit=None if unit else FLATTEST,
            unit=unit,
        )
    )
