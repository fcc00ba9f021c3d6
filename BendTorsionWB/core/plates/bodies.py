# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of plates: their rails, volumes and ends, square or cut."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, error
from ..geometry.vectors import lengths
from ..joints.lanes import Lane
from ..members.contour import EndCurves, end_curves
from ..members.contour_measure import TrimmedFigures, trimmed_figures
from ..members.member import Member, MemberEnd
from ..members.strips import StripRails, rails_between
from ..members.volume import section_integrals, strip_volumes

_volume_of: WeakKeyDictionary[StripRails, float] = WeakKeyDictionary()
"""Volumes of plates that live; an edit leaves most rails as they are."""


@dataclass(frozen=True, eq=False)
class Body:
    """A plate's rails and volume; where its ends are cut, their curves, rails that reach beyond
    them and the figures of what is left."""

    rails: StripRails
    volume: float
    cuts: tuple[EndCurves | None, EndCurves | None] = (None, None)
    uncut: StripRails | None = None
    figures: TrimmedFigures | None = None


def bodies(
    member: Member,
    spans: Sequence[tuple[int, float, float]],
    lanes: Mapping[int, Sequence[Lane]],
) -> list[Body]:
    """The bodies of plates (strip, start, end), lane by lane; all square ones made together.

    Raises BendTorsionError for an end cut that reaches over a whole plate or does not cut it once.
    """
    ends = [member.ends_of(start, end) for _, start, end in spans]
    spans = [
        (strip, *member.opened(member.law.strips[strip].face, start, end))
        for strip, start, end in spans
    ]
    square = [span for span, at in zip(spans, ends, strict=True) if at == (None, None)]
    whole = rails_between(member, square) if square else ()
    _check_widths(member, square, whole)
    rails = [
        lane.cut(own)
        for own, (strip, *_) in zip(whole, square, strict=True)
        for lane in lanes[strip]
    ]
    made = iter(map(Body, rails, _volumes(member, rails)))
    return [
        next(made) if at == (None, None) else _cut_body(member, span, at, lane)
        for span, at in zip(spans, ends, strict=True)
        for lane in lanes[span[0]]
    ]


def _check_widths(
    member: Member, spans: Sequence[tuple[int, float, float]], made: Sequence[StripRails]
) -> None:
    """Raises BendTorsionError where the faces a plate lies between leave hardly a plate, or cross:
    the section may be wide enough and the mitres of a steep transition not."""
    groups = [group for rails in made for group in (rails.outer, rails.inner)]
    if not groups:
        return
    edges = np.concatenate([group.values.reshape(-1, 6) for group in groups])
    places = np.concatenate([group.nodes.ravel() for group in groups])
    widths = lengths(edges[:, 3:] - edges[:, :3])
    at = int(np.argmin(widths))
    if widths[at] >= tolerances.NARROWEST_STRIP:
        return
    owner = np.repeat(np.arange(len(groups)), [group.nodes.size for group in groups])[at] // 2
    raise BendTorsionError(
        error(
            "strip-too-narrow",
            member.name,
            "the plate between its neighbours is hardly a plate",
            "use a gentler transition, thinner neighbours or a wider section",
            position=f"face {member.law.strips[spans[owner][0]].face}, s = {places[at]:.0f} mm",
            value=float(widths[at]),
            limit=tolerances.NARROWEST_STRIP,
            unit="mm",
        )
    )


def _volumes(member: Member, plates: Sequence[StripRails]) -> list[float]:
    """∫A(1 − κ·e)ds between square ends (Pappus); surface quadrature of plates that are mitred."""
    new = [rails for rails in plates if rails not in _volume_of]
    mitred = [rails for rails in new if rails.boundaries]
    _volume_of.update(zip(mitred, strip_volumes(mitred) if mitred else (), strict=True))
    square = [rails for rails in new if not rails.boundaries]
    _volume_of.update(zip(square, section_integrals(member, square)[:, 0].tolist(), strict=True))
    return [_volume_of[rails] for rails in plates]


def _cut_body(
    member: Member,
    span: tuple[int, float, float],
    ends: tuple[MemberEnd | None, MemberEnd | None],
    lane: Lane,
) -> Body:
    """A plate cut at one end or both."""
    strip, *places = span
    face = member.law.strips[strip].face
    wide, clear = list(places), list(places)
    for k, end in enumerate(ends):
        if end is not None:
            clear[k] = (end.greatest, end.least)[k]
            wide[k] = end.reach[k]
    if clear[1] - clear[0] < tolerances.SHORTEST_PLATE:
        raise BendTorsionError(
            error(
                "end-cut-over-joint",
                member.name,
                "an end cut reaches over the whole first or last plate of a face",
                "move the joint away from the end, or turn the cut across the axis",
                position=f"face {face}, s = {places[0]:.0f} to {places[1]:.0f} mm",
                value=float(clear[1] - clear[0]),
                limit=tolerances.SHORTEST_PLATE,
                unit="mm",
            )
        )
    uncut = lane.cut(rails_between(member, [(strip, *wide)])[0])
    cuts = tuple(
        None if end is None else end_curves(f"{member.name} {face}", uncut, end.surface, k)
        for k, end in enumerate(ends)
    )
    tight = [
        place if cut is None else cut.range[k]
        for k, (place, cut) in enumerate(zip(places, cuts, strict=True))
    ]
    rails = lane.cut(rails_between(member, [(strip, *tight)])[0])
    figures = trimmed_figures(uncut, cuts)
    return Body(rails, figures.volume, cuts, uncut, figures)
