# SPDX-License-Identifier: LGPL-2.1-or-later
"""Net and gross: the allowances a plate is cut with, so that it has its net size after welding.

Shrinkage along and across scales the pattern with everything on it. What a butt joint shrinks is
shared by the two plates that meet: with the joint spliced flat, before forming, each end that is
spliced is longer by half of it; spliced after forming, in the box, the weld pulls at whole pieces
and its allowance is spread over the length of the plate, as that of diaphragms always is. Green is
left beyond the end line and cut off at the fit-up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np

from .. import tolerances
from ..columns import Columns
from ..finding import BendTorsionError, error
from ..flattening.outline_sides import Sides, sides_of
from ..lofting import DevelopedPlate, FlatHole, GrossPattern

SPLICES = ("before forming", "after forming")

LARGEST_SHRINKAGE = 20.0
"""mm per m; no weld shrinks a member by more."""

LARGEST_ALLOWANCE = 50.0
"""mm per weld; what is more is a slip of the pen."""

LARGEST_GREEN = 1000.0
"""mm."""


@dataclass(frozen=True)
class Allowances:
    """What the plates of a member are cut larger by: shrinkage along and across in mm per m, mm
    per butt joint, mm per diaphragm, and green in mm at the two ends of the member; splice: one
    of SPLICES."""

    shrinkage_along: float = 0.0
    shrinkage_across: float = 0.0
    joint: float = 0.0
    diaphragm: float = 0.0
    green_start: float = 0.0
    green_end: float = 0.0
    splice: str = "after forming"


def check_allowances(given: Allowances, name: str) -> None:
    """Raises BendTorsionError for allowances that are negative, or too large to be meant."""
    limits = {
        "shrinkage_along": (LARGEST_SHRINKAGE, "mm/m"),
        "shrinkage_across": (LARGEST_SHRINKAGE, "mm/m"),
        "joint": (LARGEST_ALLOWANCE, "mm"),
        "diaphragm": (LARGEST_ALLOWANCE, "mm"),
        "green_start": (LARGEST_GREEN, "mm"),
        "green_end": (LARGEST_GREEN, "mm"),
    }
    findings = [
        error(
            "allowance",
            name,
            f"{key} is not between 0 and {limit:g} {unit}",
            f"write a number from 0 to {limit:g}",
            position=key,
            value=float(getattr(given, key)),
            limit=limit,
            unit=unit,
        )
        for key, (limit, unit) in limits.items()
        if not 0.0 <= getattr(given, key) <= limit
    ]
    if given.splice not in SPLICES:
        findings.append(
            error(
                "allowance",
                name,
                "no such order of splicing and forming",
                f"write {' or '.join(SPLICES)}",
                position="splice",
                value=given.splice,
            )
        )
    if findings:
        raise BendTorsionError(findings)


def with_gross(
    plates: Sequence[DevelopedPlate],
    given: Allowances,
    closed: bool = False,
    diaphragms: Sequence[float] = (),
    green: Sequence[tuple[float, float]] | None = None,
) -> tuple[DevelopedPlate, ...]:
    """The plates of a member with their gross patterns; as they are where nothing is allowed.

    closed: the member's two ends are a joint. diaphragms: their places, mm. green: per plate, mm
    at its ends besides that of the member's ends.
    """
    extra = green if green is not None else [(0.0, 0.0)] * len(plates)
    reach: dict[str, tuple[float, float]] = {}
    for plate in plates:
        low, high = reach.get(plate.face, (plate.s_start, plate.s_end))
        reach[plate.face] = min(low, plate.s_start), max(high, plate.s_end)
    return tuple(
        _with_gross(plate, given, reach[plate.face], closed, diaphragms, own)
        for plate, own in zip(plates, extra, strict=True)
    )


def _with_gross(plate, given, reach, closed, diaphragms, green) -> DevelopedPlate:
    at_start = plate.s_start <= reach[0] + tolerances.SAME_STATION
    at_end = plate.s_end >= reach[1] - tolerances.SAME_STATION
    butts = (closed or not at_start, closed or not at_end)
    seams = sum(edge.edge.startswith("seam") for edge in plate.edges)
    inside = sum(plate.s_start < place < plate.s_end for place in diaphragms)
    along, across = 0.5 * given.joint * sum(butts), 0.5 * given.joint * seams
    splice_flat = given.splice == "before forming"
    spread = given.diaphragm * inside + (0.0 if splice_flat else along)
    ends = [
        (given_green if is_end and not closed else 0.0)
        + own
        + (0.5 * given.joint if splice_flat and butt else 0.0)
        for given_green, is_end, own, butt in zip(
            (given.green_start, given.green_end), (at_start, at_end), green, butts, strict=True
        )
    ]
    scale_u = 1.0 + 1e-3 * given.shrinkage_along + spread / plate.length
    scale_v = 1.0 + 1e-3 * given.shrinkage_across + across / _mean_width(plate)
    if scale_u == scale_v == 1.0 and not any(ends):
        return plate
    return replace(plate, gross=gross_pattern(plate, scale_u, scale_v, *ends))


def _mean_width(plate: DevelopedPlate) -> float:
    """Mean width along the lines, mm: seams shrink the strip, which is narrower than the pattern
    of a plate with a bow."""
    return sum(line.length_flat for line in plate.lines) / len(plate.lines)


def gross_pattern(
    plate: DevelopedPlate,
    scale_u: float,
    scale_v: float,
    green_start: float = 0.0,
    green_end: float = 0.0,
) -> GrossPattern:
    """The net pattern scaled along u and v and longer by green (mm along the edges) at its ends."""
    scale = np.array([scale_u, scale_v])
    sides = _allowed(sides_of(plate), scale, green_start, green_end)
    outline = sides.outline() if green_start or green_end else _each(plate.outline, scale)
    corners = np.concatenate(outline)
    shift = -corners.min(axis=0)
    outline = tuple(run + shift for run in outline)
    net = np.concatenate(plate.outline)
    # Holes keep their size.
    holes = sum(hole.area for hole in plate.holes)
    area = (plate.area + holes) * scale_u * scale_v - holes
    area += polygon_area(np.concatenate(outline)) - polygon_area(net * scale)
    size = corners.max(axis=0) + shift
    return GrossPattern(
        outline,
        float(size[0]),
        float(size[1]),
        area,
        plate.mass * area / plate.area,
        scale_u,
        scale_v,
        shift,
        green_start,
        green_end,
    )


def allowed(sides: Sides, gross: GrossPattern) -> Sides:
    """Net sides with the allowances of a gross pattern, not shifted yet."""
    scale = np.array([gross.scale_u, gross.scale_v])
    return _allowed(sides, scale, gross.green_start, gross.green_end)


def _allowed(sides: Sides, scale: np.ndarray, green_start: float, green_end: float) -> Sides:
    return _lengthened(_scaled(sides, scale), green_start, green_end)


def _each(runs: Sequence[np.ndarray], scale: np.ndarray) -> tuple[np.ndarray, ...]:
    return tuple(run * scale for run in runs)


def _scaled(sides: Sides, scale: np.ndarray) -> Sides:
    parts = {name: _each(getattr(sides, name), scale) for name in _NAMES}
    return replace(sides, **parts)


_NAMES = ("first", "second", "start", "end")


def _lengthened(sides: Sides, start: float, end: float) -> Sides:
    """The edges run on straight and the ends moved out with them."""
    first, second = list(sides.first), list(sides.second)
    ends = {"start": sides.start, "end": sides.end}
    for name, green in (("start", start), ("end", end)):
        if not green:
            continue
        at = 0 if name == "start" else -1
        tips = [edge[at][at] for edge in (first, second)]
        before = [edge[at][1 if at == 0 else -2] for edge in (first, second)]
        away = [_unit(tip - inner) for tip, inner in zip(tips, before, strict=True)]
        middle = _unit(away[0] + away[1])
        # Both edges advance by the green along their common direction.
        moves = [green / float((way * middle).sum()) * way for way in away]
        for edge, tip, move in zip((first, second), tips, moves, strict=True):
            if name == "start":
                edge.insert(0, np.array([tip + move, tip]))
            else:
                edge.append(np.array([tip, tip + move]))
        ends[name] = _moved(ends[name], *moves)
    return replace(sides, first=tuple(first), second=tuple(second), **ends)


def _moved(runs: Sequence[np.ndarray], one: np.ndarray, two: np.ndarray) -> tuple[np.ndarray, ...]:
    """Runs of an end whose first and last point move by `one` and `two`, evenly between."""
    steps = [np.hypot(*np.diff(run, axis=0).T) for run in runs]
    whole = sum(float(step.sum()) for step in steps)
    moved, done = [], 0.0
    for run, step in zip(runs, steps, strict=True):
        part = (done + np.concatenate([[0.0], np.cumsum(step)]))[:, None] / whole
        moved.append(run + (1.0 - part) * one + part * two)
        done += float(step.sum())
    return tuple(moved)


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.hypot(*vector)


def polygon_area(ring: np.ndarray) -> float:
    """Area of a closed polygon (n, 2), positive counter-clockwise."""
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def as_cut(plate: DevelopedPlate) -> DevelopedPlate:
    """The plate as its cut files show it: the gross outline and size, with everything that lies
    on the pattern carried along; the plate itself without allowances."""
    gross = plate.gross
    if gross is None:
        return plate
    placed = {name: _carried(getattr(plate, name), gross) for name in _CARRIED}
    return replace(
        plate,
        **placed,
        outline=gross.outline,
        holes=tuple(_moved_hole(hole, gross) for hole in plate.holes),
        length=gross.length,
        width=gross.width,
        area=gross.area,
        mass=gross.mass,
    )


def moved(plate: DevelopedPlate, shift: np.ndarray) -> DevelopedPlate:
    """The plate with everything that lies on its pattern moved by shift (2,), but its outline."""
    step = GrossPattern((), 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, shift, 0.0, 0.0)
    placed = {name: _carried(getattr(plate, name), step) for name in _CARRIED}
    return replace(plate, **placed, holes=tuple(_moved_hole(hole, step) for hole in plate.holes))


LEAST_MARKED = 5.0
"""mm; an end line is marked on the plate where it lies this far inside the contour."""


def marked_ends(plate: DevelopedPlate) -> tuple[str, ...]:
    """Labels of the end lines that are no part of the contour: green is cut off there."""
    if plate.gross is None:
        return ()
    greens = {"E-1": plate.gross.green_start, "E-2": plate.gross.green_end}
    return tuple(label for label, green in greens.items() if green >= LEAST_MARKED)


_CARRIED = ("lines", "folds", "points", "marks", "edges", "forming_data")
_FLAT = ("flat", "flat_outer", "flat_inner")
"""Fields of the records of a plate that hold pattern coordinates."""


def _moved_hole(hole: FlatHole, gross: GrossPattern) -> FlatHole:
    """A hole keeps its size and moves with the middle of its bounding box."""
    points = np.concatenate(hole.runs)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    move = gross.map(middle) - middle
    circle = hole.circle
    if circle is not None:
        circle = (circle[0] + float(move[0]), circle[1] + float(move[1]), circle[2])
    return replace(hole, runs=tuple(run + move for run in hole.runs), circle=circle)


def _carried(value, gross: GrossPattern):
    """A value of a plate with the pattern coordinates in it mapped."""
    if isinstance(value, tuple):
        return tuple(_carried(item, gross) for item in value)
    if isinstance(value, Columns):
        named = zip(fields(value.kind), value.columns, strict=True)
        columns = tuple(gross.map(own) if field.name in _FLAT else own for field, own in named)
        return replace(value, columns=columns)
    if not is_dataclass(value):
        return value
    changes = {}
    for field in fields(value):
        old = getattr(value, field.name)
        if field.name in _FLAT:
            new = gross.map(old)
        elif isinstance(old, tuple) or is_dataclass(old):
            new = _carried(old, gross)
        else:
            continue
        if new is not old:
            changes[field.name] = new
    return replace(value, **changes) if changes else value
