# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mitres: where each surface of a strip is folded, and what strips keep clear of beside it.

What a strip stops at (the inner face of its neighbour) has its own mitre elsewhere; the strip keeps
clear of both sides of it by a relief, which fades out within RELIEF_LENGTH of the mitre, and before
the next one and the joints the section asks for. All of this is the member's: a plate that ends
within a relief ends there as the uncut one runs through.
"""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from .. import tolerances
from ..sections.strip_lines import Sites, crossing, edge_points, left_of, limits, own_lines
from .cells import SectionLaw
from .member import Member

RELIEF_LENGTH = 500.0
LEAST_FOLD = 1e-6
"""Angle, rad, below which a strip is not folded: its mitre would be wherever rounding puts it."""
LEAST_RELIEF = 1e-6
"""mm below which two limits are the same and differ by rounding."""
LEVELS = {"outer": 0.0, "mid": 0.5, "inner": 1.0}
DEPTHS = np.array([*LEVELS.values()])


@dataclass(frozen=True, eq=False)
class Mitres:
    """At each boundary of cells, level, strip and edge (b, 3, k, 2): where the surface is folded,
    and how far the limit of the cell before and after is moved inwards there. Per boundary, level
    and strip (b, 3, k): the lengths over which that fades out, and whether reliefs of others end
    before it, as they do before the end of a zone and where there is one of its own."""

    places: np.ndarray
    relief_before: np.ndarray
    relief_after: np.ndarray
    reach_before: np.ndarray
    reach_after: np.ndarray
    firm: np.ndarray


@dataclass(frozen=True, eq=False)
class Reliefs:
    """Reliefs side by side (n,): per edge the places on the axis they fade out from and their size
    there (n, 2), and the length they fade out over (n, 1). way: +1 along the axis, -1 against."""

    way: int
    origin: np.ndarray
    size: np.ndarray
    reach: np.ndarray

    def at(self, chosen: np.ndarray, s: np.ndarray) -> np.ndarray:
        """Reliefs (m, 2) of those chosen (m,) at places s, (m, 1) or (m, 2)."""
        away = self.way * (s - self.origin[chosen]) / self.reach[chosen]
        return self.size[chosen] * (1.0 - away).clip(0.0, 1.0) ** 3

    def joined(self, origin: np.ndarray, size: np.ndarray, reach: np.ndarray) -> Reliefs:
        """This one and those behind it along their way."""
        parts = zip((self.origin, self.size, self.reach), (origin, size, reach[:, None]))
        return Reliefs(self.way, *(np.concatenate(pair[:: self.way]) for pair in parts))

    @property
    def exist(self) -> bool:
        return bool(self.size.any())

    @property
    def ends(self) -> list[float]:
        """Where those there are end."""
        there = self.size.any(axis=1)
        return (self.origin + self.way * self.reach)[there].ravel().tolist()


_NOTHING = {
    way: Reliefs(way, np.zeros((1, 2)), np.zeros((1, 2)), np.ones((1, 1))) for way in (1, -1)
}
_mitres_of: WeakKeyDictionary[Member, Mitres] = WeakKeyDictionary()
"""Mitres of members that live: asked for with all their plates."""


def mitres(member: Member) -> Mitres:
    """All mitres of a member."""
    if member not in _mitres_of:
        _mitres_of[member] = _made(member)
    return _mitres_of[member]


def reliefs_at(
    law: SectionLaw, made: Mitres, strip: int, place: float, way: int
) -> tuple[Reliefs, ...]:
    """What each surface of a strip keeps clear of where a plate of it starts (way +1) or ends (-1):
    the relief of the boundary there or of the last one beyond, as far as it reaches.

    A plate whose joint lies on a fold that its neighbours run through ends square there, but their
    mitre does not: it keeps clear of that.
    """
    starts = [cell.start for cell in law.cells[1:]]
    beyond = [
        j
        for j, fold in enumerate(starts)
        if 0.0 <= (place - fold) * way <= 2.0 * RELIEF_LENGTH
        and law.felt[j, strip]
        and made.firm[j, 0, strip]
    ]
    nothing = (_NOTHING[way],) * len(DEPTHS)
    if not beyond:
        return nothing
    j = beyond[-1 if way > 0 else 0]
    size, reach = made.relief_before, made.reach_before
    if way > 0:
        size, reach = made.relief_after, made.reach_after
    origin, own, reach = made.places[j, :, strip], size[j, :, strip], reach[j, :, strip, None]
    if starts[j] == place or starts[j] in law.joints_of(strip):
        others = {int(k) for k in law.table.neighbour[strip]}
        if all(starts[j] in law.joints_of(k) for k in others):
            return nothing
        origin, own = np.full_like(origin, starts[j]), np.repeat(own[:1], len(DEPTHS), axis=0)
    near = (((place - origin) * way < reach) & (own > 0.0)).any(axis=1)
    levels = (np.s_[k : k + 1] for k in range(len(DEPTHS)))
    found = (Reliefs(way, origin[k], own[k], reach[k]) for k in levels)
    return tuple(one if close else _NOTHING[way] for one, close in zip(found, near, strict=True))


def _made(member: Member) -> Mitres:
    """All mitres of a member: where the edge of a surface before a boundary meets the surface
    behind it, both continued through the boundary."""
    law = member.law
    table, count = law.table, len(law.cells) - 1
    shape = (count, 3, len(law.strips), 2)
    if not count:
        lengths = (np.zeros(shape[:3]) for _ in range(2))
        return Mitres(*(np.zeros(shape) for _ in range(3)), *lengths, np.zeros(shape[:3], bool))
    boundary, level, strip, edge = (part.ravel() for part in np.indices(shape))
    fold = np.array([cell.start for cell in law.cells[1:]])[boundary]
    depth = DEPTHS[level]

    def sites(chosen, place) -> tuple[Sites, Sites]:
        at = member.frames.at(place)
        return tuple(law.sites(boundary[chosen] + k, place, at.ky, at.kz, at.twist) for k in (0, 1))

    def gap(chosen, place):
        """How far the edge before has passed the surface behind."""
        before, after = sites(chosen, place)
        own, deep = strip[chosen], depth[chosen]
        point = edge_points(table, before, own, edge[chosen], deep)
        line = own_lines(table, after, own, deep)
        return (left_of(line) * (point - line[:, 0])).sum(axis=1)

    place = fold.copy()
    thickness = np.array([cell.thickness for cell in law.cells])
    through = thickness[boundary, strip] == thickness[boundary + 1, strip]
    chosen = np.flatnonzero((depth != table.line[strip]) & np.isin(fold, law.folds) & through)
    if len(chosen):
        last = fold[chosen]
        miss = gap(chosen, last)
        rate = gap(chosen, last + 1.0) - miss
        folded = np.abs(rate) >= LEAST_FOLD
        chosen, last, miss, rate = (part[folded] for part in (chosen, last, miss, rate))
        for _ in range(12):
            if not len(chosen) or np.abs(miss / rate).max() < 1e-10:
                break
            last = last - miss / rate
            miss = gap(chosen, last)
        place[chosen] = last

    def way(chosen):
        """How much farther out the limit behind is than the one before."""
        before, after = sites(chosen, place[chosen])
        own = own_lines(table, after, strip[chosen], depth[chosen])
        one, _ = limits(table, before, strip[chosen], edge[chosen])
        two, into = limits(table, after, strip[chosen], edge[chosen])
        return ((crossing(own, two) - crossing(own, one)) * into).sum(axis=1)

    # The side whose limit is the farther out gives way.
    everything = np.arange(len(fold))
    behind = way(everything)
    before = -behind
    # A neighbour with a joint on the fold ends there, and not at a mitre of its own.
    other = table.neighbour[strip, edge]
    ends = thickness[boundary, other] != thickness[boundary + 1, other]
    ends = np.flatnonzero(ends & (place != fold))
    if len(ends):
        mitred, place[ends] = place[ends], fold[ends]
        at_fold = way(ends)
        place[ends] = mitred
        behind[ends] = np.maximum(behind[ends], at_fold)
        before[ends] = np.maximum(before[ends], -at_fold)
    behind, before = (np.where(part > LEAST_RELIEF, part, 0.0) for part in (behind, before))
    places, before, after = (part.reshape(shape) for part in (place, behind, before))
    own = (before + after).any(axis=(1, 3))
    firm = np.repeat((law.zone_ends[:, None] | own)[:, None], len(DEPTHS), axis=1)
    return Mitres(places, before, after, *_reaches(law, places.mean(axis=3), firm), firm)


def _reaches(
    law: SectionLaw, middles: np.ndarray, firm: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Lengths (b, 3, k) over which reliefs fade out before and behind mitres at middles (b, 3, k):
    they end before the next firm one, the ends of the member and the joints of the strip that its
    section asks for. Where plates are delivered in pieces or cut on request is nothing to them."""
    firm = firm & law.felt[:, None]
    before, after = np.empty(firm.shape), np.empty(firm.shape)
    for strip in range(len(law.strips)):
        changes = [change.place for change in law.changes if change.strip == strip]
        joints = [-np.inf, 0.0, law.length, np.inf, *law.joints, *changes]
        for level in range(len(DEPTHS)):
            mine = np.s_[:, level, strip]
            stops = np.unique(np.concatenate([joints, middles[mine][firm[mine]]]))
            same = tolerances.SAME_STATION
            behind = stops[np.searchsorted(stops, middles[mine] + same)]
            ahead = stops[np.searchsorted(stops, middles[mine] - same) - 1]
            before[mine], after[mine] = middles[mine] - ahead, behind - middles[mine]
    return (0.45 * before).clip(max=RELIEF_LENGTH), (0.45 * after).clip(max=RELIEF_LENGTH)
