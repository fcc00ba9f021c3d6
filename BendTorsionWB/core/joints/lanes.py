# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lanes: a face wider than the stock, divided along its length into plates side by side.

A face's surfaces are ruled between their two rails, so a seam at the part w of the width is the
line (1 − w)·P0 + w·P1: the rails of a lane are exact, and two lanes share their seam to the digit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..geometry.piecewise import Piecewise
from ..members.member import Member
from ..members.mitres import LEVELS
from ..members.strips import StripRails, rails_between
from .joint_solver import JointRules

LETTERS = "abcdefghijklmnopqrstuvwxyz"


@dataclass(frozen=True)
class Lanes:
    """Seams of one face: rising parts of its width (0 … 1) from the first edge, rising mm at its
    widest place, or `auto`, as few even lanes as the stock allows (no values)."""

    values: tuple[float, ...]
    kind: str = "ratio"


@dataclass(frozen=True)
class Lane:
    """One lane of a plate: its letter and the parts of the width it runs between; the whole
    width has no letter."""

    letter: str = ""
    first: float = 0.0
    second: float = 1.0

    def cut(self, rails: StripRails) -> StripRails:
        """The lane's share of the rails of all surfaces."""
        if not self.letter:
            return rails
        levels = {name: self._between(getattr(rails, name)) for name in LEVELS}
        return replace(rails, **levels)

    def _between(self, rails: Piecewise) -> Piecewise:
        first, second = rails.values[..., :3], rails.values[..., 3:]
        parts = [
            first if w == 0.0 else second if w == 1.0 else (1.0 - w) * first + w * second
            for w in (self.first, self.second)
        ]
        return Piecewise(rails.breaks, np.concatenate(parts, axis=2))

    def edges(self, names: tuple[str, str]) -> tuple[str, str]:
        """Names of the lane's edges: those of the face, or `seam 1`, `seam 2`, … between lanes."""
        if not self.letter:
            return names
        number = LETTERS.index(self.letter)
        return (
            names[0] if self.first == 0.0 else f"seam {number}",
            names[1] if self.second == 1.0 else f"seam {number + 1}",
        )


WHOLE = (Lane(),)


def lanes_between(bounds: Sequence[float]) -> tuple[Lane, ...]:
    """The lanes between bounds 0 … 1."""
    if len(bounds) == 2:
        return WHOLE
    return tuple(
        Lane(letter, first, second)
        for letter, first, second in zip(LETTERS, bounds[:-1], bounds[1:], strict=False)
    )


def bounds_of(
    member: Member, lanes: Mapping[str, Lanes], rules: JointRules
) -> dict[str, tuple[float, ...]]:
    """Bounds of the lanes, 0 … 1, of each face that has any.

    Raises BendTorsionError for seams out of order or off the face, lanes without width, and for
    `auto` where even the narrowest lanes the rules allow are wider than the stock.
    """
    strips = {strip.face: k for k, strip in enumerate(member.law.strips)}
    named = {face: given for face, given in lanes.items() if given.values or given.kind == "auto"}
    unknown = [face for face in named if face not in strips]
    if unknown:
        raise BendTorsionError(
            error(
                "lanes",
                member.name,
                f"there is no face {unknown[0]}",
                f"use one of {', '.join(strips)}",
                position=f"face {unknown[0]}",
            )
        )
    if not named:
        return {}
    cuts = [0.0, *member.law.all_joints, member.length]
    spans = [
        (strips[face], start, end)
        for face in named
        for start, end in zip(cuts[:-1], cuts[1:], strict=True)
    ]
    widest: dict[int, tuple[float, float]] = {}
    for (strip, *_), rails in zip(spans, rails_between(member, spans), strict=True):
        across = rails.outer.values[..., 3:] - rails.outer.values[..., :3]
        width = np.sqrt((across * across).sum(axis=2))
        at = np.unravel_index(int(np.argmax(width)), width.shape)
        here = float(width[at]), float(rails.outer.nodes[at])
        widest[strip] = max(here, widest.get(strip, here))
    return {
        face: _bounds(member, face, given, *widest[strips[face]], rules)
        for face, given in named.items()
    }


def _bounds(
    member: Member, face: str, given: Lanes, width: float, place: float, rules: JointRules
) -> tuple[float, ...]:
    position = f"face {face}, s = {place:.0f} mm"
    if given.kind == "auto":
        count = max(1, int(np.ceil(width / rules.widest_piece - 1e-9)))
        if count > 1 and 1.0 / count < rules.narrowest_lane - 1e-9:
            most = int(1.0 / rules.narrowest_lane + 1e-9)
            raise BendTorsionError(
                error(
                    "stock-too-narrow",
                    member.name,
                    f"{count} lanes would be needed, each narrower than the rules allow",
                    f"use stock {np.ceil(width / most):.0f} mm wide for {most} lanes",
                    position=position,
                    value=rules.widest_piece,
                    limit=width / most,
                    unit="mm",
                )
            )
        return tuple(k / count for k in range(count + 1))
    scale = 1.0 if given.kind == "ratio" else 1.0 / width
    values = np.array(given.values, float)
    bounds = np.concatenate([[0.0], values * scale, [1.0]])
    if given.kind == "ratio" and abs(bounds[-2] - 1.0) < 1e-12:
        bounds = np.delete(bounds, -1)  # the ratio 1 is the second edge
    lengths = np.diff(bounds) * width
    problem, at = "", 0
    if not np.isfinite(values).all():
        problem = "seams must be numbers"
    elif (np.diff(bounds[:-1]) <= 0).any():
        problem, at = "seams must rise", int(np.argmin(np.diff(bounds[:-1])))
    elif bounds[-2] >= 1.0 + 1e-12:
        problem, at = "a seam lies beyond the face", len(lengths) - 1
    elif lengths.min() < tolerances.SHORTEST_PLATE:
        problem, at = "a lane has no width", int(np.argmin(lengths))
    elif len(lengths) > len(LETTERS):
        problem = f"more than {len(LETTERS)} lanes"
    if problem:
        raise BendTorsionError(
            error(
                "lanes",
                member.name,
                problem,
                f"give rising ratios below 1, or rising mm below {width:.0f}, or auto",
                position=position,
                value=float(lengths[at]),
                limit=tolerances.SHORTEST_PLATE,
                unit="mm",
            )
        )
    return tuple(float(b) for b in bounds)


def lane_findings(
    member: str, bounds: Mapping[str, Sequence[float]], rules: JointRules
) -> list[Finding]:
    """Warnings for lanes narrower than the rules allow, as parts of the face's width."""
    findings = []
    for face, given in bounds.items():
        parts = np.diff(given)
        at = int(np.argmin(parts))
        if len(parts) > 1 and parts[at] < rules.narrowest_lane - 1e-9:
            findings.append(
                warning(
                    "lane-too-narrow",
                    member,
                    f"lane {LETTERS[at]} of face {face} is narrower than the rules allow",
                    "move a seam, or take one away",
                    position=f"face {face}",
                    value=float(parts[at]),
                    limit=rules.narrowest_lane,
                    unit="of the width",
                )
            )
    return findings
