# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the rules say of one joint where it stands: each figure beside its limit, kept or not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .. import tolerances
from .joint_solver import JointRules

ON_IT_IS_GOOD = ("fold", "piece_end")
"""Kinds of places a joint may lie on, though not beside."""


@dataclass(frozen=True)
class Margin:
    """One rule at one joint: name as the field of JointRules, figure and limit in mm; about: the
    face or the kind of place it is measured to."""

    rule: str
    figure: float
    limit: float
    about: str = ""

    @property
    def kept(self) -> bool:
        """Whether the rule is kept."""
        if self.rule == "longest_piece":
            return self.figure <= self.limit
        return self.figure >= self.limit


def joint_margins(
    face: str,
    k: int,
    cuts: Mapping[str, Sequence[float]],
    rules: JointRules,
    adjacent: Mapping[str, Sequence[str]],
    folds: Sequence[float] = (),
    keep_outs: Mapping[str, Sequence[float]] | None = None,
) -> tuple[Margin, ...]:
    """The rules at joint k (from 0) of a face.

    cuts: face -> the member's start, its joints, the member's end, rising, mm; adjacent: face ->
    the faces it meets; keep_outs: places to keep clear of, by their kind, as `joint_solver`. The
    plates on both sides are measured, the nearest joint of faces it meets, the nearest fold and the
    nearest place of each kind; what does not exist is left out, and so is a fold or the end of a
    piece the joint lies on.
    """
    edges = list(cuts[face])
    s = edges[k + 1]
    beside = (s - edges[k], edges[k + 2] - s)
    found = [
        Margin("shortest_piece", min(beside), rules.shortest_piece),
        Margin("longest_piece", max(beside), rules.longest_piece),
    ]
    others = [
        (abs(s - place), other)
        for other in adjacent.get(face, ())
        for place in list(cuts.get(other, ()))[1:-1]
    ]
    if others:
        figure, other = min(others)
        found.append(Margin("stagger", figure, rules.stagger, other))
    for kind, places in {"fold": folds, **(keep_outs or {})}.items():
        if len(places):
            figure = min(abs(s - place) for place in places)
            if kind in ON_IT_IS_GOOD and figure <= tolerances.SAME_STATION:
                continue
            found.append(Margin(f"{kind}_clearance", figure, getattr(rules, f"{kind}_clearance")))
    return tuple(found)
