# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rails of a plate strip on its outer, mid and inner surface, mitred where the strip is folded.

Thickness is normal to the plate (`strip_lines`). At a fold the insets of the two sides differ, so
the surfaces off the strip's line meet a little before or behind it, at the mitre; each rail is
broken at its own mitre. What a strip stops at (the inner face of its neighbour) has its own mitre
elsewhere; the strip keeps clear of both by a relief that fades out beside the mitre (`mitres`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from .. import tolerances
from ..axes.frames import FrameStations
from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, span_nodes, unresolved
from ..memo import Kept, content_hash, made_from
from ..sections.strip_lines import Sites, edge_points
from .member import Member
from .mitres import DEPTHS, Mitres, mitres, reliefs_at

TURN_LENGTH = 500.0
"""mm within which the rulings beside a mitre turn back into section planes."""
MOST_HALVINGS = 6
"""Of spans that do not hold a rail to tolerances.RAILS_RESOLVED."""
_Arrays = TypeVar("_Arrays", FrameStations, Sites)
_kept = Kept()


@dataclass(frozen=True, eq=False)
class StripRails:
    """Rails s -> (6,), first then second edge, of the three surfaces of a strip, and the places
    each is folded at, in the order of `boundaries` (where the section law changes)."""

    boundaries: tuple[float, ...]
    outer: Piecewise
    mid: Piecewise
    inner: Piecewise
    outer_folds: tuple[float, ...]
    mid_folds: tuple[float, ...]
    inner_folds: tuple[float, ...]


def strip_rails(member: Member, strip: int, start: float, end: float) -> StripRails:
    """The rails of a strip between two section planes without a joint between them."""
    return rails_between(member, [(strip, start, end)])[0]


def rails_between(
    member: Member, spans: Sequence[tuple[int, float, float]]
) -> tuple[StripRails, ...]:
    """The rails of many strips (strip, start, end), as `strip_rails`."""
    law = member.law
    starts = np.array([cell.start for cell in law.cells])
    found = mitres(member)
    rails: dict[int, StripRails] = {}
    new, keys, blocks = [], [], []
    for number, (strip, start, end) in enumerate(spans):
        low = max(0, int(np.searchsorted(starts, start, side="right")) - 1)
        high = int(np.searchsorted(starts, end, side="left")) - 1
        felt = low + np.flatnonzero(law.felt[low:high, strip])
        ends = reliefs_at(law, found, strip, start, 1), reliefs_at(law, found, strip, end, -1)
        key = _content(member, found, (strip, start, end), low, high, felt, ends)
        known = _kept.recall(key) if key else None
        if known is not None:
            rails[number] = known
            continue
        new.append(number)
        keys.append(key)
        cells = np.concatenate([[low], felt + 1])
        # Without a fold or a relief the three surfaces are broken alike.
        plain = not len(felt) and not any(one.exist for side in ends for one in side)
        levels = [
            _Block(member, found, (felt, level, strip), both, cells, start, end)
            for level, both in enumerate([*zip(*ends, strict=True)][: 1 if plain else 3])
        ]
        blocks += levels * 3 if plain else levels
    made = _resolved(member, blocks, [spans[number][0] for number in new]) if new else []
    for k, (number, key) in enumerate(zip(new, keys, strict=True)):
        own = slice(3 * k, 3 * k + 3)
        folds = [tuple(block.edges[1:-1].tolist()) for block in blocks[own]]
        rails[number] = StripRails(blocks[own][0].boundaries, *made[own], *folds)
        if key:
            _kept.keep(key, rails[number])
    return tuple(rails[number] for number in range(len(spans)))


def _content(member: Member, found: Mitres, span, low, high, felt, ends) -> str:
    """Hash of all the rails of a span are made from; empty when it is not known."""
    frames, prints = made_from(member.frames), member.law.prints
    if not frames or prints is None:
        return ""
    strip = span[0]
    parts = [part[felt, :, strip] for part in vars(found).values()]
    parts += [one for side in ends for one in side if one.exist]
    return content_hash(frames, span, *prints[low : high + 1], felt - low, *parts)


def _check_order(member: Member, edges: np.ndarray) -> None:
    """Raises BendTorsionError where the mitre of a fold lies beyond that of the next one, or beyond
    the plate's end: the plate is too thick for so short a piece between them."""
    crossed = np.flatnonzero(np.diff(edges) <= 0.0)
    if len(crossed):
        at = float(edges[crossed[0]])
        raise BendTorsionError(
            error(
                "mitres-cross",
                member.name,
                "mitres cross: the plates are too thick for a piece so short",
                "lengthen the transition by its slope, move its cut or the joint, or take thinner"
                " plates",
                position=f"at {at:.0f} mm",
                value=float(-np.diff(edges)[crossed[0]]),
                limit=0.0,
                unit="mm",
            )
        )


class _Block:
    """The nodes of one surface of one strip: s (n,), its cell, and per edge the place on the axis
    it is taken at and its relief (n, 2)."""

    def __init__(self, member: Member, found: Mitres, mine, ends, cells, start, end, more=()):
        self._made_from = member, found, mine, ends, cells, start, end
        starts = [cell.start for cell in member.law.cells]
        self.boundaries = tuple(starts[k + 1] for k in mine[0])
        places = found.places[mine]
        middles = 0.5 * (places[:, 0] + places[:, 1])
        edges = np.concatenate([[start], middles, [end]])
        _check_order(member, edges)
        self.shifted = bool((places != middles[:, None]).any())
        reach = np.minimum(TURN_LENGTH, 0.45 * np.diff(edges))
        # Reliefs fade through the beginnings and ends of chamfers, which have none.
        firm = found.firm[mine]
        relieved = np.concatenate([[start], middles[firm], [end]])
        behind, ahead = (
            [part[mine][firm] for part in (found.places, size, length)]
            for size, length in (
                (found.relief_after, found.reach_after),
                (found.relief_before, found.reach_before),
            )
        )
        reliefs = ends[0].joined(*behind), ends[1].joined(*ahead)
        fades = reliefs[0].ends + reliefs[1].ends
        if self.shifted:
            fades += [*(edges[1:-1] + reach[1:]), *(edges[1:-1] - reach[:-1])]
        breaks = member.smooth_breaks(edges, [*_apart(fades), *more])
        nodes = span_nodes(breaks)
        self.edges, self.breaks, self.shape = edges, breaks, nodes.shape
        self.s = nodes.ravel()
        owner = self._owner(edges)
        self.cell = cells[owner]
        self.place = self.relief = None
        if self.shifted:
            nothing, shift = np.zeros((1, 2)), places - middles[:, None]
            self.place = self.s[:, None] + _faded(
                self.s, owner, edges, reach, [nothing, shift], [shift, nothing]
            )
        if any(one.exist for one in reliefs):
            owner = self._owner(relieved)
            place = self.s[:, None] if self.place is None else self.place
            self.relief = reliefs[0].at(owner, place) + reliefs[1].at(owner, place)

    def _owner(self, edges: np.ndarray) -> np.ndarray:
        """The stretch between edges that each node lies in."""
        spans = 0.5 * (self.breaks[1:] + self.breaks[:-1])
        return np.repeat(np.searchsorted(edges, spans, side="right") - 1, self.shape[1])

    def with_breaks(self, more: Sequence[float]) -> _Block:
        """The block with nodes between more breaks."""
        return _Block(*self._made_from, more)


def _apart(places: Sequence[float]) -> list[float]:
    """The places without those a hair behind another."""
    rising = np.unique(places)
    gap = np.diff(rising, prepend=-np.inf)
    return rising[gap > tolerances.STATION_AT_PLATE_END].tolist()


def _faded(s, owner, edges, reach, at_start, at_end) -> np.ndarray:
    """Values (n, 2) at s (n,) in stretches `owner`: those at the start and the end of each
    stretch, in two parts to be joined, fading out within its reach."""
    from_start = (1.0 - (s - edges[owner]) / reach[owner]).clip(0.0) ** 3
    from_end = (1.0 - (edges[owner + 1] - s) / reach[owner]).clip(0.0) ** 3
    start, end = np.concatenate(at_start)[owner], np.concatenate(at_end)[owner]
    return start * from_start[:, None] + end * from_end[:, None]


def _resolved(member: Member, blocks: list[_Block], strips: Sequence[int]) -> list[Piecewise]:
    """The rails of the blocks, three per strip. Where spans are too long for what happens in them,
    as in a short transition of thick plates, they are halved, and the blocks replaced."""
    made = _evaluated(member, blocks, strips)
    pending = list(range(len(blocks)))
    halves: list[list[float]] = [[] for _ in blocks]
    for _ in range(MOST_HALVINGS):
        spans = unresolved([made[k] for k in pending], tolerances.RAILS_RESOLVED)
        rough = dict(zip(pending, spans, strict=True))
        pending = [k for k in pending if len(rough[k])]
        if not pending:
            break
        for k in pending:
            breaks, own = blocks[k].breaks, rough[k]
            halves[k] += (0.5 * (breaks[own] + breaks[own + 1])).tolist()
            blocks[k] = blocks[k].with_breaks(halves[k])
        again = sorted({k // 3 for k in pending})
        pending = [3 * number + level for number in again for level in range(3)]
        better = _evaluated(member, [blocks[k] for k in pending], [strips[i] for i in again])
        for k, rails in zip(pending, better, strict=True):
            made[k] = rails
    # Closed last: what a mitre leaves open is no roughness that shorter spans would mend.
    return [_closed(own, block.edges[1:-1]) for own, block in zip(made, blocks, strict=True)]


def _evaluated(member: Member, blocks: Sequence[_Block], strips: Sequence[int]) -> list[Piecewise]:
    """The blocks' rails, all in one sweep; three levels per strip. Open at their folds."""
    if not blocks:
        return []
    law = member.law
    sizes = [len(block.s) for block in blocks]
    cell = np.concatenate([block.cell for block in blocks])
    strip = np.repeat(np.repeat(strips, 3), sizes)
    depth = np.repeat(np.tile(DEPTHS, len(strips)), sizes)
    s = np.concatenate([block.s for block in blocks])
    at = member.frames.at(s)
    values = np.empty((len(s), 2, 3))
    relief = np.concatenate(
        [np.zeros((len(b.s), 2)) if b.relief is None else b.relief for b in blocks]
    )
    moved = np.repeat([block.shifted for block in blocks], sizes)
    base = law.sites(cell, s, at.ky, at.kz, at.twist)
    for edge in (0, 1):
        own, sites = at, base
        if moved.any():
            place = np.concatenate([b.place[:, edge] for b in blocks if b.shifted])
            new = member.frames.at(place)
            own = _replaced(at, moved, new)
            sites = _replaced(base, moved, law.sites(cell[moved], place, new.ky, new.kz, new.twist))
        plane = edge_points(law.table, sites, strip, np.full(len(s), edge), depth, relief[:, edge])
        values[:, edge] = own.origin + plane[:, :1] * own.y + plane[:, 1:] * own.z
    ends = np.cumsum(sizes)[:-1]
    return [
        Piecewise(block.breaks, part.reshape(*block.shape, 6))
        for block, part in zip(blocks, np.split(values, ends), strict=True)
    ]


def _replaced(old: _Arrays, where: np.ndarray, new: _Arrays) -> _Arrays:
    """A record of arrays with those of another at some places."""
    parts = {name: part.copy() for name, part in vars(old).items()}
    for name, part in parts.items():
        part[where] = getattr(new, name)
    return type(old)(**parts)


def _closed(rails: Piecewise, places: np.ndarray) -> Piecewise:
    """Both sides of each fold on one point; they differ by what the mitre's iteration left."""
    values = rails.values
    for place in places:
        k = int(np.searchsorted(rails.breaks, place))
        middle = 0.5 * (values[k - 1, -1] + values[k, 0])
        values[k - 1, -1], values[k, 0] = middle, middle
    return rails
