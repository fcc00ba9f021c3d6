# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blends: a branch lifted and turned a little before a node, so that it lands flush.

Over the last 2h before its cut the section moves along its height and turns about the axis, by
laws that start with no value, slope or curvature. They are laws of the member itself, so that
rails, patterns and solids follow them exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..axes.frames import Frames
from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, merged_breaks, resolve, sample
from ..members.cells import Cell
from ..members.member import Member, MemberGap
from ..members.surface_alignment import Lift

BLEND_LENGTH = 2.0
"""Of the branch's height: how far before its cut a blend starts."""
_BEYOND = 100.0
"""mm a blend holds its full value behind the cut, for what is cut there."""


@dataclass(frozen=True)
class Blend:
    """lift (mm along the height) and roll (rad about +x) of a branch: none at `start`, full from
    `full` to `held`, none again at `gone`, all on its axis, mm; gone may be none (to its end)."""

    node: str
    start: float
    full: float
    held: float
    gone: float | None
    lift: float
    roll: float

    @property
    def places(self) -> tuple[float, ...]:
        """Where the laws are less than smooth."""
        return tuple(p for p in (self.start, self.full, self.held, self.gone) if p is not None)

    def part(self, s: np.ndarray) -> np.ndarray:
        """What of the full values (n,) is there at s (n,)."""
        rise = _smooth((s - self.start) / (self.full - self.start))
        if self.gone is None:
            return rise
        return rise * _smooth((self.gone - s) / (self.gone - self.held))


def _smooth(x: np.ndarray) -> np.ndarray:
    x = np.minimum(np.maximum(x, 0.0), 1.0)
    return x * x * x * (10.0 + x * (6.0 * x - 15.0))


def blend_of(
    node: str, way: int, cut: tuple[float, float], other: float | None, height: float
) -> Blend:
    """A blend without lift or roll, before a cut between two places (its side leaves along `way`);
    other: where the cut on the far side of the node begins, or None."""
    reach = BLEND_LENGTH * height
    near, far = (cut[0], cut[1]) if way < 0 else (cut[1], cut[0])
    held = far - way * _BEYOND
    gone = None if other is None else other + way * _BEYOND
    if gone is not None and (gone - held) * -way < _BEYOND:
        # No room between the cuts: half way to each.
        middle = 0.5 * (far + other)
        held, gone = far + 0.25 * (middle - far), middle
    return Blend(node, near + way * reach, near, held, gone, 0.0, 0.0)


def law_of(member: Member, blends: Sequence[Blend], what: str) -> Piecewise:
    """The sum of the blends' `lift` or `roll` over the whole axis, s -> (1,)."""
    places = np.array([place for blend in blends for place in blend.places])
    breaks = merged_breaks(
        places, start=0.0, end=member.length, least=tolerances.STATION_AT_PLATE_END
    )
    return sample(
        lambda s: sum(getattr(blend, what) * blend.part(s) for blend in blends)[:, None], breaks
    )


def with_blends(member: Member, blends: Sequence[Blend]) -> Member:
    """The member lifted and turned by its blends."""
    blends = [blend for blend in blends if blend.lift or blend.roll]
    if not blends:
        return member
    lift, roll = (law_of(member, blends, what) for what in ("lift", "roll"))
    summed: dict[int, Piecewise] = {}
    cells = tuple(replace(cell, lift=_lifted(cell, lift, summed)) for cell in member.law.cells)
    frames = _turned(member.frames, roll)
    return replace(member, frames=frames, law=replace(member.law, cells=cells), rolled=roll)


def _lifted(cell: Cell, lift: Piecewise, summed: dict[int, Piecewise]) -> Lift:
    old = cell.lift
    if old is None:
        return Lift(lift, lift, cell.start, cell.end)

    def plus(one: Piecewise | None) -> Piecewise:
        if one is None:
            return lift
        if id(one) not in summed:
            breaks = np.unique(np.concatenate([one.breaks, lift.breaks]))
            breaks = breaks[np.concatenate([[True], np.diff(breaks) > tolerances.SAME_STATION])]
            summed[id(one)] = sample(lambda s: one(s) + lift(s), breaks)
        return summed[id(one)]

    return replace(old, first=plus(old.first), last=plus(old.last))


def _turned(frames: Frames, roll: Piecewise) -> Frames:
    own = frames.position_and_z
    scale = max(own.end, 1.0)

    def position_and_z(s: np.ndarray) -> np.ndarray:
        at, angle = frames.at(s), roll(s)
        return np.concatenate(
            [at.origin, (at.z * np.cos(angle) - at.y * np.sin(angle)) * scale], axis=1
        )

    breaks = np.unique(np.concatenate([own.breaks, roll.breaks]))
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > tolerances.SAME_STATION])]
    turned = resolve(position_and_z, breaks, scale)
    values = turned.values.copy()
    values[..., 3:] /= scale
    return replace(frames, position_and_z=Piecewise(turned.breaks, values))


def check_blends(member: Member, blends: Sequence[Blend], gaps: Sequence[MemberGap]) -> None:
    """Raises BendTorsionError for a blend that reaches beyond the member or into another node."""
    findings = []
    for blend in blends:
        way = 1.0 if blend.full > blend.start else -1.0
        limits = [0.0 if way > 0 else member.length]
        for gap in gaps:
            edge = gap.behind.greatest if way > 0 and gap.behind else None
            edge = gap.before.least if way < 0 and gap.before else edge
            if edge is not None and (blend.full - edge) * way > 0:
                limits.append(edge)
        limit = max(limits) if way > 0 else min(limits)
        if (blend.start - limit) * way < 0:
            findings.append(
                error(
                    "node-blend-too-long",
                    member.name,
                    "there is no room for the blend before the node",
                    "do not blend the node, or make the branch lower",
                    position=f"{blend.node}, s = {blend.full:.0f} mm",
                    value=abs(blend.full - blend.start),
                    limit=abs(blend.full - limit),
                    unit="mm",
                )
            )
    if findings:
        raise BendTorsionError(findings)
