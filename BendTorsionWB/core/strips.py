# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rails of a plate strip on its outer, mid and inner surface, mitred where the strip is folded.

Thickness is normal to the plate: where the outer face tilts against the axis by
a = d(outer offset)/ds ÷ (1 − κ·r), the inset in the section plane is t·√(1 + a²), half of it for
the mid-surface. At a fold the insets of the two sides differ, so the surfaces below the outer one
meet a little before or behind it, at the mitre; each rail is broken at its own mitre. What a strip
stops at (the inner face of its neighbour) has its own mitre elsewhere; the strip keeps clear of
both by a relief that fades out on the constant side within RELIEF_LENGTH.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import tolerances
from .frames import FrameStations
from .member import Member, cell_corners, stretch, to_space
from .piecewise import Piecewise, span_nodes
from .zones import Cell

RELIEF_LENGTH = 500.0
LEVELS = {"outer": 0.0, "mid": 0.5, "inner": 1.0}


@dataclass(frozen=True, eq=False)
class StripRails:
    """Rails s -> (6,), first then second edge, of the three surfaces of a strip, and the places
    each is folded at, in the order of `boundaries` (the folds of the outer face)."""

    boundaries: tuple[float, ...]
    outer: Piecewise
    mid: Piecewise
    inner: Piecewise
    mid_folds: tuple[float, ...]
    inner_folds: tuple[float, ...]


@dataclass(frozen=True)
class _Mitre:
    """At one boundary, per edge (first, second): where the surface of a level is folded, and how
    far the limit of the cell before and after is moved inwards there."""

    places: tuple[float, float]
    relief_before: tuple[float, float]
    relief_after: tuple[float, float]

    @property
    def place(self) -> float:
        return 0.5 * sum(self.places)


def strip_rails(member: Member, strip: int, start: float, end: float) -> StripRails:
    """The rails of a strip between two section planes without a joint between them."""
    cells = [c for c in member.law.cells if c.start < end and c.end > start]
    boundaries = tuple(cell.start for cell in cells[1:])
    mitres = {
        level: [_mitre(member, strip, a, b, depth) for a, b in zip(cells, cells[1:], strict=False)]
        for level, depth in LEVELS.items()
    }
    rails = {
        level: _rails(member, strip, cells, mitres[level], start, end, depth)
        for level, depth in LEVELS.items()
    }
    return StripRails(
        boundaries,
        rails["outer"],
        rails["mid"],
        rails["inner"],
        tuple(mitre.place for mitre in mitres["mid"]),
        tuple(mitre.place for mitre in mitres["inner"]),
    )


def _rails(
    member: Member,
    strip: int,
    cells: list[Cell],
    mitres: list[_Mitre],
    start: float,
    end: float,
    depth: float,
) -> Piecewise:
    edges = np.array([start, *(mitre.place for mitre in mitres), end])
    reach = np.minimum(RELIEF_LENGTH, 0.45 * np.diff(edges))
    fades = [edges[k] + reach[k] for k in range(1, len(edges) - 1)]
    fades += [edges[k + 1] - reach[k] for k in range(len(edges) - 2)]
    breaks = member.smooth_breaks(edges, fades)
    nodes = span_nodes(breaks)
    owner = np.searchsorted(edges, 0.5 * (breaks[1:] + breaks[:-1]), side="right") - 1
    values = np.empty((*nodes.shape, 2, 3))
    for index, cell in enumerate(cells):
        mine = owner == index
        s = nodes[mine].ravel()
        fade_start = (1.0 - (s - edges[index]) / reach[index]).clip(0.0) ** 3
        fade_end = (1.0 - (edges[index + 1] - s) / reach[index]).clip(0.0) ** 3
        for edge in (0, 1):
            place, relief = s, np.zeros(len(s))
            if index:
                before = mitres[index - 1]
                place = place + (before.places[edge] - before.place) * fade_start
                relief = relief + before.relief_after[edge] * fade_start
            if index < len(mitres):
                after = mitres[index]
                place = place + (after.places[edge] - after.place) * fade_end
                relief = relief + after.relief_before[edge] * fade_end
            at = member.frames.at(place)
            plane = _edge_point(member, cell, strip, edge, depth, at, relief)
            values[mine, :, edge] = to_space(at, plane[:, None])[:, 0].reshape(-1, nodes.shape[1], 3)
    joined = Piecewise(breaks, values.reshape(*nodes.shape, 6))
    return _closed(joined, edges[1:-1])


def _closed(rails: Piecewise, places: np.ndarray) -> Piecewise:
    """Both sides of each fold on one point; they differ by what the mitre's iteration left."""
    values = rails.values.copy()
    for place in places:
        k = int(np.searchsorted(rails.breaks, place))
        middle = 0.5 * (values[k - 1, -1] + values[k, 0])
        values[k - 1, -1], values[k, 0] = middle, middle
    return Piecewise(rails.breaks, values)


def _mitre(member: Member, strip: int, before: Cell, after: Cell, depth: float) -> _Mitre:
    fold = after.start
    places, relief_before, relief_after = [], [], []
    for edge in (0, 1):
        place = fold
        if depth:
            for _ in range(6):
                at = member.frames.at(np.array([place]))
                point = _edge_point(member, before, strip, edge, depth, at)
                gap = _side(_own_line(member, after, strip, depth, at), point)
                ahead = member.frames.at(np.array([place + 1.0]))
                point = _edge_point(member, before, strip, edge, depth, ahead)
                rate = _side(_own_line(member, after, strip, depth, ahead), point) - gap
                if abs(rate) < 1e-9:
                    place = fold
                    break
                place = place - gap / rate
        at = member.frames.at(np.array([place]))
        one, _ = _limit(member, before, strip, edge, at)
        two, inward = _limit(member, after, strip, edge, at)
        own = _own_line(member, after, strip, depth, at)
        gap = (_crossing(own, two) - _crossing(own, one))[0] @ inward[0]
        # The side whose limit is the farther out gives way.
        places.append(float(place))
        relief_before.append(max(0.0, float(gap)))
        relief_after.append(max(0.0, -float(gap)))
    return _Mitre(tuple(places), tuple(relief_before), tuple(relief_after))


def _edge_point(
    member: Member,
    cell: Cell,
    strip: int,
    edge: int,
    depth: float,
    at: FrameStations,
    relief: np.ndarray | float = 0.0,
) -> np.ndarray:
    """Point (n, 2) of one edge of the strip at a depth (0 outer … 1 inner)."""
    line, inward = _limit(member, cell, strip, edge, at)
    line = line + (np.zeros(len(at.s)) + relief)[:, None, None] * inward[:, None]
    return _crossing(_own_line(member, cell, strip, depth, at), line)


def _own_line(
    member: Member, cell: Cell, strip: int, depth: float, at: FrameStations
) -> np.ndarray:
    """The strip's line (n, 2, 2), from its first to its second corner, at a depth."""
    own = member.law.strips[strip]
    outer = cell_corners(cell, at.s)[:, [own.first, own.second]]
    if not depth:
        return outer
    normal = own.inward * _left_of(outer)
    rate = (normal[:, None] * cell.corner_rates[[own.first, own.second]]).sum(axis=2)
    tilt = rate / stretch(at, outer)
    inset = depth * cell.thickness[strip] * np.sqrt(1.0 + tilt**2)
    return outer + inset[:, :, None] * normal[:, None]


def _limit(
    member: Member, cell: Cell, strip: int, edge: int, at: FrameStations
) -> tuple[np.ndarray, np.ndarray]:
    """The line (n, 2, 2) one edge of the strip ends at, and the unit direction (n, 2) into it."""
    own = member.law.strips[strip]
    stop = (own.stops_at_first, own.stops_at_second)[edge]
    if stop is None:
        outer = cell_corners(cell, at.s)[:, [own.first, own.second]]
        along = outer[:, 1] - outer[:, 0]
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        corner = outer[:, edge]
        line = np.stack([corner, corner + own.inward * _left_of(outer)], axis=1)
        return line, (along if edge == 0 else -along)
    neighbour = next(k for k, s in enumerate(member.law.strips) if s.face == stop[0])
    inner = _own_line(member, cell, neighbour, 1.0, at)
    inward = member.law.strips[neighbour].inward * _left_of(inner)
    gap = cell.gaps[strip, edge] + (at.s - cell.start) * cell.gap_rates[strip, edge]
    return inner + gap[:, None, None] * inward[:, None], inward


def _left_of(line: np.ndarray) -> np.ndarray:
    """Unit normals (n, 2) to the left of lines (n, 2, 2)."""
    along = line[:, 1] - line[:, 0]
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    return np.column_stack([-along[:, 1], along[:, 0]])


def _side(line: np.ndarray, point: np.ndarray) -> float:
    """Signed distance of one point (1, 2) from one line (1, 2, 2)."""
    return float((_left_of(line) * (point - line[:, 0])).sum())


def _crossing(line: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """Where lines (n, 2, 2) cross limits (n, 2, 2), (n, 2)."""
    along, across = line[:, 1] - line[:, 0], limit[:, 1] - limit[:, 0]
    gap = limit[:, 0] - line[:, 0]
    determinant = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    part = (gap[:, 0] * across[:, 1] - gap[:, 1] * across[:, 0]) / determinant
    return line[:, 0] + part[:, None] * along


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
    plane = np.stack([(ring * at.y[:, None]).sum(axis=2), (ring * at.z[:, None]).sum(axis=2)],
                     axis=2)
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
