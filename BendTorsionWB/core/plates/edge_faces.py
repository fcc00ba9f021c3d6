# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the edges of both thickness faces come to lie in the flat pattern: bevels, dihedrals.

A point of a face lies square above a foot on the flattened surface and stays above it when the
plate is flat. The foot is found by a Newton step of the closest point, from the edge of the
flattened surface at the same section; the metric alone tells how far outside that edge it lies.
All edges of a member are worked out in one sweep, one row per end of a measuring line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .. import tolerances
from ..flattening.outline_sides import sides_of
from ..geometry.piecewise import Piecewise, Together, evaluate_together
from ..geometry.vectors import crossed, dots, lengths
from ..lofting import DevelopedPlate, PlateEdge
from ..sections.section import Strip
from .plates import Plate

BESIDE_FOLD = tolerances.STATION_AT_FOLD
"""At a fold line the neighbour, folded a little before or behind, is read this far to both
sides."""

AMID = 0.4
"""Of its width: a neighbour met this near its middle, or nearer, runs on to both sides."""


def with_edges(
    plates: Sequence[Plate], developed: Sequence[DevelopedPlate], strips: Sequence[Strip]
) -> tuple[DevelopedPlate, ...]:
    """The developed plates of a member with their two PlateEdges each.

    plates: in the same order, all plates of the member; strips: of its section.
    """
    rows = _Rows(plates)
    outer, inner = (rows.offset(rows.evaluated(level)) for level in ("outer", "inner"))
    met = _met(plates, strips)
    dihedral = _dihedrals(plates, rows, met)
    thickness = np.repeat([plate.thickness for plate in plates], rows.lines)
    bevel = np.arctan((outer - inner) / np.tile(thickness, 2))
    flat, outward = _flat(plates, developed, rows)
    flat_outer, flat_inner = (flat + offset[:, None] * outward for offset in (outer, inner))
    made = []
    for k, (plate, pattern) in enumerate(zip(plates, developed, strict=True)):
        labels = tuple(line.label for line in plate.lines)
        s = np.array([line.s for line in plate.lines])
        edges = []
        for edge in (0, 1):
            own = rows.of(k, edge)
            name, other = plate.edges[edge], met[k][edge]
            neighbour = plate.face if _is_seam(name) else other[1] if other else ""
            arrays = (bevel, dihedral, outer, inner, flat_outer, flat_inner)
            edges.append(PlateEdge(name, neighbour, labels, s, *(a[own].copy() for a in arrays)))
        made.append(replace(pattern, edges=tuple(edges)))
    return tuple(made)


def _is_seam(edge: str) -> bool:
    return edge.startswith("seam")


class _Rows:
    """The ends of all lines of all plates, n on first edges, then n on second: per row the edge's
    point, rate and second rate, the ruling and its rate, (2n, 3) each; which way is outside (2n,);
    the side of the section (2n,); places on the three surfaces (2n,)."""

    def __init__(self, plates: Sequence[Plate]):
        self.plates = plates
        places = [_places(plate) for plate in plates]
        self.lines = np.array([len(own["mid"]) for own in places])
        self.ends = np.cumsum(self.lines)
        self.at = {
            level: np.concatenate([own[level][:, edge] for edge in (0, 1) for own in places])
            for level in ("outer", "mid", "inner")
        }
        self.is_fold = np.tile(
            [line.label.startswith("F") for plate in plates for line in plate.lines], 2
        )
        count = int(self.ends[-1])
        self.outside = np.repeat([-1.0, 1.0], count)
        self.inward = np.tile(np.repeat([float(p.inward) for p in plates], self.lines), 2)
        value = self._frames().reshape(2 * count, 3, 2, 3)
        edge = np.repeat([0, 1], count)
        row = np.arange(2 * count)
        self.point, self.rate, self.bend = (value[row, k, edge] for k in range(3))
        self.ruling, self.turn = (value[:, k, 1] - value[:, k, 0] for k in range(2))
        area = crossed(self.rate, self.ruling)
        self.along = _unit(self.rate)
        self.normal = self.inward[:, None] * _unit(area)
        self.reach = np.sqrt(dots(area, area) / dots(self.rate, self.rate))

    def of(self, plate: int, edge: int) -> slice:
        """The rows of one edge of one plate."""
        end = int(self.ends[plate]) + edge * int(self.ends[-1])
        return slice(end - int(self.lines[plate]), end)

    def _frames(self) -> np.ndarray:
        """Both rails of the flattened surfaces, their first and second rates, (2n, 18); at a fold
        the mean of both sides."""
        functions = [plate.rails.mid.with_rates for plate in self.plates]
        value = self._swept(functions, "mid", "inside")
        folded = [k for k, plate in enumerate(self.plates) if plate.folds]
        if folded:
            rows = [self.of(k, edge) for edge in (0, 1) for k in folded]
            at = [self.at["mid"][own] for own in rows]
            earlier = evaluate_together([functions[k] for k in folded * 2], at, "earlier")
            for own, other in zip(rows, earlier, strict=True):
                value[own] = 0.5 * (value[own] + other)
        return value

    def _swept(self, functions: Sequence[Piecewise], level: str, side: str) -> np.ndarray:
        """Functions of the plates at the places of their rows; once for both edges unless an end
        is cut."""
        parts = [self.at[level][self.of(k, 0)] for k in range(len(self.plates))]
        first = Together(functions)(parts, side)
        second = first.copy()
        for k, plate in enumerate(self.plates):
            if plate.is_cut:
                second[self.of(k, 0)] = functions[k](self.at[level][self.of(k, 1)])
        return np.concatenate([first, second])

    def evaluated(self, level: str) -> np.ndarray:
        """Points (2n, 3) of the edges of the `outer` or `inner` face."""
        rails = [getattr(plate.rails, level) for plate in self.plates]
        value = self._swept(rails, level, "later")
        return np.concatenate([value[: len(value) // 2, :3], value[len(value) // 2 :, 3:]])

    def offset(self, points: np.ndarray) -> np.ndarray:
        """How far (2n,) the feet of points (2n, 3) lie outside the edges."""
        away, rate, ruling = points - self.point, self.rate, self.ruling
        e = dots(rate, rate) - dots(away, self.bend)
        f = dots(rate, ruling) - dots(away, self.turn)
        g = dots(ruling, ruling)
        one, two = dots(away, rate), dots(away, ruling)
        return self.outside * self.reach * (e * two - f * one) / (e * g - f * f)


def _places(plate: Plate) -> dict[str, np.ndarray]:
    """Arc lengths (n, 2) of the ends of a plate's lines on its three surfaces."""
    rails = plate.rails
    places = {level: plate.line_places(level) for level in ("outer", "mid", "inner")}
    if plate.folds:
        own = [k for k, s in enumerate(rails.boundaries) if s in plate.folds]
        at = [k for k, line in enumerate(plate.lines) if line.label.startswith("F")]
        for level in ("outer", "inner"):
            folds = getattr(rails, f"{level}_folds")
            places[level][at] = np.array([folds[k] for k in own])[:, None]
    return places


def _flat(
    plates: Sequence[Plate], developed: Sequence[DevelopedPlate], rows: _Rows
) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the lines in the pattern and the ways square to the edges there, outwards (2n, 2)."""
    flat = np.array([line.flat for pattern in developed for line in pattern.lines])
    across = flat[:, 1] - flat[:, 0]
    across = across / np.hypot(across[:, 0], across[:, 1])[:, None]
    # The way square to the rulings, towards +s: the same hand on the whole of a plate.
    first = rows.ends - rows.lines
    step = flat[first + 1].mean(axis=1) - flat[first].mean(axis=1)
    hand = np.sign(step[:, 0] * across[first, 1] - step[:, 1] * across[first, 0])
    square = np.column_stack([across[:, 1], -across[:, 0]])
    square = np.tile(np.repeat(hand, rows.lines)[:, None] * square, (2, 1))
    skew = dots(rows.along, _unit(rows.ruling))[:, None]
    level = np.sqrt(1.0 - skew * skew)
    outward = rows.outside[:, None] * (level * np.tile(across, (2, 1)) - skew * square)
    for k, (plate, pattern) in enumerate(zip(plates, developed, strict=True)):
        if plate.is_cut:
            # A cut end line need be no ruling: square to the outline instead.
            sides = sides_of(pattern)
            for edge, runs in enumerate((sides.first, sides.second)):
                own = rows.of(k, edge)
                for at, tangent in (
                    (own.start, runs[0][1] - runs[0][0]),
                    (own.stop - 1, runs[-1][-1] - runs[-1][-2]),
                ):
                    way = np.array([tangent[1], -tangent[0]]) / np.hypot(*tangent)
                    outward[at] = way * np.sign((way * outward[at]).sum())
    return np.concatenate([flat[:, 0], flat[:, 1]]), outward


def _met(plates: Sequence[Plate], strips: Sequence[Strip]):
    """Per plate and edge: (strip, face) of the neighbour, or None for a free edge."""
    by_face = {strip.face: k for k, strip in enumerate(strips)}
    found = {}
    for k, strip in enumerate(strips):
        for edge, (stop, corner) in enumerate(
            ((strip.stops_at_first, strip.first), (strip.stops_at_second, strip.second))
        ):
            others = [j for j, o in enumerate(strips) if j != k and corner in (o.first, o.second)]
            other = by_face[stop.face] if stop else others[0] if others else None
            found[k, edge] = None if other is None else (other, strips[other].face)
    return [[found[plate.strip, edge] for edge in (0, 1)] for plate in plates]


def _dihedrals(plates: Sequence[Plate], rows: _Rows, met) -> np.ndarray:
    """Angles (2n,) to the neighbours: pi at a seam, NaN at a free edge."""
    spans: dict[int, list[int]] = {}
    for k, plate in enumerate(plates):
        spans.setdefault(plate.strip, []).append(k)
    angle = np.full(len(rows.point), np.nan)
    asked: list[tuple[Piecewise, np.ndarray]] = []
    for k, plate in enumerate(plates):
        for edge in (0, 1):
            own = rows.of(k, edge)
            if _is_seam(plate.edges[edge]):
                angle[own] = np.pi
            elif met[k][edge] is not None:
                asked += _beside(plates, spans.get(met[k][edge][0], ()), rows, own)
    if not asked:
        return angle
    chosen = np.concatenate([lines for _, lines in asked])
    functions = [surface.with_rates for surface, _ in asked]
    sides = []
    for sign in (-1.0, 1.0) if rows.is_fold[chosen].any() else (0.0,):
        at = [
            rows.at["mid"][lines] + sign * BESIDE_FOLD * rows.is_fold[lines] for _, lines in asked
        ]
        at = [
            s.clip(surface.start - BESIDE_FOLD, surface.end + BESIDE_FOLD)
            for s, (surface, _) in zip(at, asked, strict=True)
        ]
        sides.append(_dihedral(rows, chosen, Together(functions)(at)))
    angle[chosen] = np.mean(sides, axis=0)
    return angle


def _beside(plates, candidates, rows: _Rows, own: slice):
    """(rails of the flattened surface, rows) of the candidates that lie beside the lines of an
    edge: of several lanes those that come nearest. Where none lies beside a line, since an edge
    reaches a little farther at a cut, or into the root gap between two, the nearest one is
    continued."""
    s = rows.at["mid"][own]
    lanes = sorted({plates[c].lane.letter for c in candidates})
    if len(lanes) > 1:
        middle = len(s) // 2
        gaps = {}
        for c in candidates:
            if plates[c].start <= s[middle] <= plates[c].end:
                rails = plates[c].rails.mid(s[middle : middle + 1]).reshape(2, 3)
                away = rails - rows.point[own][middle]
                gaps[plates[c].lane.letter] = float(dots(away, away).min())
        nearest = min(gaps, key=gaps.get) if gaps else lanes[0]
        candidates = [c for c in candidates if plates[c].lane.letter == nearest]
    left = np.ones(len(s), bool)
    found = []
    for c in candidates:
        inside = left & (s >= plates[c].start - 1e-9) & (s <= plates[c].end + 1e-9)
        if inside.any():
            left &= ~inside
            found.append((plates[c].rails.mid, own.start + np.flatnonzero(inside)))
    beyond = np.flatnonzero(left)
    if len(beyond) and len(candidates):
        away = [np.maximum(plates[c].start - s, s - plates[c].end)[beyond] for c in candidates]
        nearest = np.argmin(away, axis=0)
        for k in sorted({*nearest.tolist()}):
            plate = plates[candidates[k]]
            surface = (plate.uncut or plate.rails).mid
            found.append((surface, own.start + beyond[nearest == k]))
    return found


def _dihedral(rows: _Rows, chosen: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Angles (m,) from the plates to their neighbours, on the inner side, about the edges."""
    first, second = other[:, :3], other[:, 3:6]
    ruling = second - first
    part = dots(rows.point[chosen] - first, ruling) / dots(ruling, ruling)
    part = part.clip(0.0, 1.0)[:, None]
    normal = crossed(other[:, 6:9] + part * (other[:, 9:12] - other[:, 6:9]), ruling)
    along, own = rows.along[chosen], rows.normal[chosen]
    # Into the neighbour, away from the end of its width that the edge lies at; amid its width
    # to the inner side.
    into = _unit(crossed(along, normal))
    towards = np.where(part[:, 0] < 0.5, 1.0, -1.0) * dots(into, ruling)
    amid = np.abs(part[:, 0] - 0.5) < AMID
    towards = np.where(amid, dots(own, into), towards)
    into = into * np.sign(towards)[:, None]
    inside = crossed(own, along)
    inside = inside * np.sign(-rows.outside[chosen] * dots(inside, rows.ruling[chosen]))[:, None]
    return np.arctan2(dots(own, into), dots(inside, into)) % (2.0 * np.pi)


def face_outline(plate: DevelopedPlate, face: str) -> tuple[np.ndarray, ...]:
    """Outline of the `outer` or `inner` face in the net pattern, runs as those of the outline:
    the long edges moved by their offsets, linear between the lines, the ends run on to them."""
    sides = sides_of(plate)
    moved = {}
    for number, name in enumerate(("first", "second")):
        edge = plate.edges[number]
        offset = edge.offset_outer if face == "outer" else edge.offset_inner
        flat = np.array([line.flat[number] for line in plate.lines])
        moved[name] = _moved_out(getattr(sides, name), flat, offset, sides.mirrored ^ (number == 1))
    one, two = moved["first"], moved["second"]
    for name, at in (("start", 0), ("end", -1)):
        runs = list(getattr(sides, name))
        runs[0] = np.concatenate([one[at][at][None], runs[0][1:]])
        runs[-1] = np.concatenate([runs[-1][:-1], two[at][at][None]])
        moved[name] = tuple(runs)
    return replace(sides, **moved).outline()


def _moved_out(
    runs: Sequence[np.ndarray], flat: np.ndarray, offset: np.ndarray, to_left: bool
) -> tuple[np.ndarray, ...]:
    """Runs of an edge, moved square to themselves by offsets given at points (n, 2) of it."""
    points = np.concatenate(runs)
    step = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(step)])
    nearest = [int(np.argmin(((points - p) ** 2).sum(axis=1))) for p in flat]
    offsets = np.interp(along, along[nearest], offset)
    moved, start = [], 0
    for run in runs:
        tangent = np.gradient(run, axis=0)
        tangent = tangent / np.hypot(tangent[:, 0], tangent[:, 1])[:, None]
        outward = np.column_stack([tangent[:, 1], -tangent[:, 0]]) * (-1.0 if to_left else 1.0)
        moved.append(run + offsets[start : start + len(run), None] * outward)
        start += len(run)
    for before, after in zip(moved[:-1], moved[1:], strict=True):
        before[-1] = after[0] = 0.5 * (before[-1] + after[0])
    return tuple(moved)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / lengths(vectors)[:, None]
