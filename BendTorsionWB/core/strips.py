# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rails of a plate strip on its outer, mid and inner surface, mitred where the strip is folded.

Thickness is normal to the plate (`strip_lines`). At a fold the insets of the two sides differ, so
the surfaces off the strip's line meet a little before or behind it, at the mitre; each rail is
broken at its own mitre. What a strip stops at (the inner face of its neighbour) has its own mitre
elsewhere; the strip keeps clear of both by a relief that fades out on the constant side within
RELIEF_LENGTH.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from . import tolerances
from .frames import FrameStations
from .member import Member, stretch
from .piecewise import Piecewise, span_nodes
from .strip_lines import Sites, crossing, edge_points, left_of, limits, own_lines

RELIEF_LENGTH = 500.0
LEAST_FOLD = 1e-6
"""Angle, rad, below which a strip is not folded: its mitre would be wherever rounding puts it."""
_Arrays = TypeVar("_Arrays", FrameStations, Sites)
LEVELS = {"outer": 0.0, "mid": 0.5, "inner": 1.0}
_DEPTHS = np.array([*LEVELS.values()])


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


@dataclass(frozen=True, eq=False)
class _Mitres:
    """At each boundary, level, strip and edge (b, 3, k, 2): where the surface is folded, and how
    far the limit of the cell before and after is moved inwards there."""

    places: np.ndarray
    relief_before: np.ndarray
    relief_after: np.ndarray


def strip_rails(member: Member, strip: int, start: float, end: float) -> StripRails:
    """The rails of a strip between two section planes without a joint between them."""
    return rails_between(member, [(strip, start, end)])[0]


def rails_between(
    member: Member, spans: Sequence[tuple[int, float, float]]
) -> tuple[StripRails, ...]:
    """The rails of many strips (strip, start, end), as `strip_rails`."""
    law = member.law
    starts = np.array([cell.start for cell in law.cells])
    mitres = _mitres(member)
    blocks, folds, boundaries = [], [], []
    for strip, start, end in spans:
        low = int(np.searchsorted(starts, start, side="right")) - 1
        high = int(np.searchsorted(starts, end, side="left")) - 1
        boundaries.append(tuple(starts[low + 1 : high + 1].tolist()))
        for level in range(3):
            mine = slice(low, high), level, strip
            block = _Block(
                member, mitres, mine, _end_reliefs(law, mitres, strip, start, end), low, start, end
            )
            folds.append(tuple(block.edges[1:-1].tolist()))
            blocks.append(block)
    rails = _evaluated(member, blocks, [span[0] for span in spans])
    return tuple(
        StripRails(boundaries[k], *rails[3 * k : 3 * k + 3], *folds[3 * k : 3 * k + 3])
        for k in range(len(spans))
    )


class _Block:
    """The nodes of one surface of one strip: s (n,), its cell, and per edge the place on the axis
    it is taken at and its relief (n, 2)."""

    def __init__(self, member: Member, mitres: _Mitres, mine, ends, low: int, start, end):
        places = mitres.places[mine]
        middles = 0.5 * (places[:, 0] + places[:, 1])
        edges = np.concatenate([[start], middles, [end]])
        reach = np.minimum(RELIEF_LENGTH, 0.45 * np.diff(edges))
        count = len(middles)
        fades = [*(edges[1:-1] + reach[1:]), *(edges[1:-1] - reach[:-1])] if count else []
        fades += [edges[0] + reach[0]] if ends[0].any() else []
        fades += [edges[-1] - reach[-1]] if ends[1].any() else []
        breaks = member.smooth_breaks(edges, fades)
        nodes = span_nodes(breaks)
        owner = np.searchsorted(edges, 0.5 * (breaks[1:] + breaks[:-1]), side="right") - 1
        self.edges, self.breaks, self.shape = edges, breaks, nodes.shape
        self.s = nodes.ravel()
        owner = np.repeat(owner, nodes.shape[1])
        self.cell = low + owner
        self.shifted = bool(count) and bool((places != middles[:, None]).any())
        self.place = self.relief = None
        if not (count or ends[0].any() or ends[1].any()):
            return
        fade_start = (1.0 - (self.s - edges[owner]) / reach[owner]).clip(0.0) ** 3
        fade_end = (1.0 - (edges[owner + 1] - self.s) / reach[owner]).clip(0.0) ** 3
        nothing = np.zeros((1, 2))

        def faded(at_start, at_end, first=nothing, last=nothing):
            at_start = np.concatenate([first, at_start])[owner]
            at_end = np.concatenate([at_end, last])[owner]
            return at_start * fade_start[:, None] + at_end * fade_end[:, None]

        if self.shifted:
            shift = places - middles[:, None]
            self.place = self.s[:, None] + faded(shift, shift)
        self.relief = faded(mitres.relief_after[mine], mitres.relief_before[mine], *ends)


def _end_reliefs(
    law, mitres: _Mitres, strip: int, start: float, end: float
) -> tuple[np.ndarray, np.ndarray]:
    """Reliefs (1, 2) at the ends of a plate whose joint lies on a fold that its neighbours run
    through: the plate ends square there, but their mitre does not."""
    starts = [cell.start for cell in law.cells[1:]]
    reliefs = [np.zeros((1, 2)), np.zeros((1, 2))]
    for side, (place, given) in enumerate(
        ((start, mitres.relief_after), (end, mitres.relief_before))
    ):
        if place in starts and place not in law.joints:
            reliefs[side] = given[starts.index(place), 0, strip][None]
    return tuple(reliefs)


def _evaluated(member: Member, blocks: Sequence[_Block], strips: Sequence[int]) -> list[Piecewise]:
    """The blocks' rails, all in one sweep; three levels per strip."""
    law = member.law
    sizes = [len(block.s) for block in blocks]
    cell = np.concatenate([block.cell for block in blocks])
    strip = np.repeat(np.repeat(strips, 3), sizes)
    depth = np.repeat(np.tile(_DEPTHS, len(strips)), sizes)
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
        _closed(Piecewise(block.breaks, part.reshape(*block.shape, 6)), block.edges[1:-1])
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


def _mitres(member: Member) -> _Mitres:
    """All mitres of a member: where the edge of a surface before a boundary meets the surface
    behind it, both continued through the boundary."""
    law = member.law
    table, count = law.table, len(law.cells) - 1
    shape = (count, 3, len(law.strips), 2)
    if not count:
        return _Mitres(*(np.zeros(shape) for _ in range(3)))
    boundary, level, strip, edge = (part.ravel() for part in np.indices(shape))
    fold = np.array([cell.start for cell in law.cells[1:]])[boundary]
    depth = _DEPTHS[level]

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
    everything = np.arange(len(fold))
    before, after = sites(everything, place)
    own = own_lines(table, after, strip, depth)
    one, _ = limits(table, before, strip, edge)
    two, into = limits(table, after, strip, edge)
    way = ((crossing(own, two) - crossing(own, one)) * into).sum(axis=1)
    # The side whose limit is the farther out gives way.
    return _Mitres(
        place.reshape(shape), way.clip(0.0).reshape(shape), (-way).clip(0.0).reshape(shape)
    )


def section_integrand(member: Member, rails: StripRails) -> Piecewise:
    """s -> (2,): A·(1 − κ·e) and A of the strip's cross-section, A in mm2; its integral is the
    volume of a strip with ends normal to the axis (Pappus)."""
    breaks = np.unique(np.concatenate([rails.outer.breaks, rails.inner.breaks]))
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > tolerances.SAME_STATION])]
    nodes = span_nodes(breaks)
    # A hair inside each span, so that both sides of a fold give their own limit.
    inside = nodes + (nodes.mean(axis=1, keepdims=True) - nodes) * 1e-12
    s = inside.ravel()
    at = member.frames.at(s)
    outer = rails.outer(s).reshape(-1, 2, 3)
    inner = rails.inner(s).reshape(-1, 2, 3)
    ring = np.stack([outer[:, 0], outer[:, 1], inner[:, 1], inner[:, 0]], axis=1)
    ring = ring - at.origin[:, None]
    plane = np.stack(
        [(ring * at.y[:, None]).sum(axis=2), (ring * at.z[:, None]).sum(axis=2)], axis=2
    )
    area, centroid = _polygon(plane)
    values = np.column_stack([area * stretch(at, centroid), area])
    return Piecewise(breaks, values.reshape(*nodes.shape, 2))


def _polygon(ring: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Area (n,), positive, and centroid (n, 2) of polygons (n, m, 2)."""
    following = np.roll(ring, -1, axis=1)
    cross = ring[:, :, 0] * following[:, :, 1] - ring[:, :, 1] * following[:, :, 0]
    doubled = cross.sum(axis=1)
    centroid = ((ring + following) * cross[:, :, None]).sum(axis=1) / (3.0 * doubled)[:, None]
    return np.abs(doubled) / 2.0, centroid
