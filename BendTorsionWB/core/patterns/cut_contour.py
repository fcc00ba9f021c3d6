# SPDX-License-Identifier: LGPL-2.1-or-later
"""The contour a plate is cut to: gross, of the face that is asked for, parted where bevels change.

The pattern's outline is the edge of the flattened surface. With bevels the faces end elsewhere, and
the contour of a face is that outline moved square to itself by what `bevels.contour_offset` tells.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..flattening.outline_sides import Sides, sides_of
from ..geometry.arc_fit import fit_runs
from ..lofting import DevelopedPlate, EndPart
from ..welds.bevel_record import EdgeBevel
from ..welds.bevels import contour_offset
from . import gross

FLUSH = 0.02
"""mm; runs that end closer together than this meet in the middle, others by a straight step."""

SAME_PLACE = 1e-7
"""mm; a frame that moves by less than is written of a coordinate stays."""

_TAIL = 200.0
"""mm; how far sides are run on straight to meet at a corner."""

Run = tuple[np.ndarray, EdgeBevel | None]


@dataclass(frozen=True, eq=False)
class CutContour:
    """A plate as cut files show it; bevels: of each run of its outline, None of a square one."""

    plate: DevelopedPlate
    bevels: tuple[EdgeBevel | None, ...]


@lru_cache(maxsize=4)
def cut_arcs(plate: DevelopedPlate, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """The contour a plate is cut to as a closed polyline of arcs (m, 3), and (m,) the number of the
    run each belongs to; as `arc_fit.fit_runs`. The DXF and the NC1 file of a plate share it."""
    arcs, run = fit_runs(cut_contour(plate).plate.outline, tolerance, plate.mark)
    arcs.flags.writeable = False
    return arcs, run


@lru_cache(maxsize=4)
def cut_contour(plate: DevelopedPlate) -> CutContour:
    """The plate with allowances, its outline that of the face `plate.contour`; what lies on the
    pattern is carried along. Ends with green are cut square: they are cut off at the fit-up."""
    given = gross.as_cut(plate)
    if not plate.lines or (not plate.bevels and plate.contour == "mid"):
        return CutContour(given, (None,) * len(given.outline))
    sides = sides_of(plate)
    runs = {name: _side(plate, getattr(sides, name), name, _turn(sides, name)) for name in _NAMES}
    if plate.contour != "mid":
        for corner in _CORNERS:
            _meet(runs, *corner)
    if plate.gross is not None:
        runs = _with_allowances(sides, runs, plate.gross)
    order = _in_order(runs, sides.mirrored)
    points = np.concatenate([run for run, _ in order])
    shift = points.min(axis=0)
    size = points.max(axis=0) - shift
    before = np.zeros(2) if plate.gross is None else plate.gross.shift
    step = -shift - before
    moved = given if np.abs(step).max() < SAME_PLACE else gross.moved(given, step)
    outline = tuple(run - shift for run, _ in order)
    moved = replace(moved, outline=outline, length=float(size[0]), width=float(size[1]))
    return CutContour(moved, tuple(bevel for _, bevel in order))


_NAMES = ("first", "second", "start", "end")

_CORNERS = (("first", 0, "start", 0), ("first", -1, "end", 0))
_CORNERS += (("second", 0, "start", -1), ("second", -1, "end", -1))
"""Each a long edge and an end, and which of their ends meet."""


def _turn(sides: Sides, name: str) -> float:
    """1 when outside lies to the right of the way a side runs, else -1."""
    right = name in ("first", "end")
    return 1.0 if right != sides.mirrored else -1.0


def _side(plate: DevelopedPlate, runs: Sequence[np.ndarray], name: str, turn: float) -> list[Run]:
    bevels = [bevel for bevel in plate.bevels if bevel.side == name]
    if name in ("start", "end"):
        green = 0.0
        if plate.gross is not None:
            green = plate.gross.green_start if name == "start" else plate.gross.green_end
        if green >= gross.LEAST_MARKED:
            own = [(run, None, np.zeros((2, len(run)))) for run in runs]
        else:
            own = _across(plate, runs, plate.ends[name == "end"], bevels)
    else:
        own = _parted(plate, runs, 0 if name == "first" else 1, bevels)
    return _moved(plate, own, turn)


def _parted(plate: DevelopedPlate, runs, number: int, bevels: Sequence[EdgeBevel]) -> list:
    """Runs of a long edge cut where bevels begin and end, each with its bevel, and how far the
    edges of the outer and the inner face lie outside it (2, n)."""
    edge = plate.edges[number]
    flat = np.array([line.flat[number] for line in plate.lines])
    at = np.array([line.s for line in plate.lines])
    points = np.concatenate(runs)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    nearest = np.array([int(np.argmin(((points - p) ** 2).sum(axis=1))) for p in flat])
    # Lines need not end on points of the outline: the rest of the way is along its tangent.
    tangent = points[np.minimum(nearest + 1, len(points) - 1)] - points[np.maximum(nearest - 1, 0)]
    tangent = tangent / np.hypot(*tangent.T)[:, None]
    rest = ((flat - points[nearest]) * tangent).sum(axis=1)
    s = np.interp(along, along[nearest] + rest, at)
    places = sorted({place for bevel in bevels for place in (bevel.start, bevel.end)})
    out, start = [], 0
    for run in runs:
        own = s[start : start + len(run)]
        start += len(run)
        inner = [p for p in places if own[0] + _APART < p < own[-1] - _APART]
        bounds = [own[0], *inner, own[-1]]
        for low, high in zip(bounds[:-1], bounds[1:], strict=True):
            inside = (own > low) & (own < high)
            own_s = np.concatenate([[low], own[inside], [high]])
            ends = [[np.interp(p, own, run[:, k]) for k in (0, 1)] for p in (low, high)]
            part = np.concatenate([[ends[0]], run[inside], [ends[1]]])
            if low == own[0]:
                part[0] = run[0]
            if high == own[-1]:
                part[-1] = run[-1]
            middle = 0.5 * (low + high)
            bevel = next((b for b in bevels if b.start <= middle <= b.end), None)
            reach = np.array(
                [np.interp(own_s, edge.s, o) for o in (edge.offset_outer, edge.offset_inner)]
            )
            out.append((part, bevel, reach))
    return out


def _across(plate: DevelopedPlate, runs, parts: Sequence[EndPart], bevels) -> list:
    """As `_parted`, of an end: its bevels begin and end at lengths from the first edge."""
    points = np.concatenate(runs)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    places = sorted({place for bevel in bevels for place in (bevel.start, bevel.end)})
    out, start = [], 0
    for run in runs:
        own = along[start : start + len(run)]
        start += len(run)
        inner = [p for p in places if own[0] + _APART < p < own[-1] - _APART]
        bounds = [own[0], *inner, own[-1]]
        for low, high in zip(bounds[:-1], bounds[1:], strict=True):
            inside = (own > low) & (own < high)
            at = np.concatenate([[low], own[inside], [high]])
            part = np.column_stack([np.interp(at, own, run[:, k]) for k in (0, 1)])
            middle = 0.5 * (low + high)
            bevel = next((b for b in bevels if b.start <= middle <= b.end), None)
            reach = np.zeros(len(at))
            stretch = next((p for p in parts if p.along[0] <= middle <= p.along[-1]), None)
            if stretch is not None:
                tilt = np.tan(np.interp(at, stretch.along, stretch.bevel))
                reach = 0.5 * plate.thickness * tilt
            out.append((part, bevel, np.array([reach, -reach])))
    return out


_APART = 0.5
"""mm; bevels that change nearer than this to the end of a run change there."""


def _moved(plate: DevelopedPlate, own: list, turn: float) -> list[Run]:
    """Runs moved to the contour's face, head to tail again: those that part by more than FLUSH with
    a straight step between them."""
    if plate.contour == "mid":
        return [(run, bevel) for run, bevel, _ in own]
    out: list[Run] = []
    for run, bevel, (outer, inner) in own:
        offset = contour_offset(
            bevel, outer, inner, plate.thickness, plate.contour, plate.marking_face
        )
        tangent = np.gradient(run, axis=0)
        tangent = tangent / np.hypot(*tangent.T)[:, None]
        outward = turn * np.column_stack([tangent[:, 1], -tangent[:, 0]])
        moved = run + offset[:, None] * outward
        if out:
            before, other = out[-1]
            gap = float(np.hypot(*(moved[0] - before[-1])))
            if gap <= FLUSH or other == bevel:
                before[-1] = moved[0] = 0.5 * (before[-1] + moved[0])
            else:
                out.append((np.array([before[-1], moved[0]]), None))
        out.append((moved, bevel))
    return out


def _meet(runs: dict[str, list[Run]], edge: str, edge_at: int, end: str, end_at: int) -> None:
    """Let a long edge and an end meet where they cross, run on straight where they do not reach."""
    one, two = runs[edge][edge_at], runs[end][end_at]
    a, b = (run if at == -1 else run[::-1] for (run, _), at in ((one, edge_at), (two, end_at)))
    a_long, b_long = _run_on(a), _run_on(b)
    place, i, j = _crossing(a_long, b_long, a[-1])
    a = np.concatenate([a_long[: i + 1], [place]])
    b = np.concatenate([b_long[: j + 1], [place]])
    for name, at, run, bevel in ((edge, edge_at, a, one[1]), (end, end_at, b, two[1])):
        runs[name][at] = (run if at == -1 else run[::-1], bevel)


def _run_on(points: np.ndarray) -> np.ndarray:
    """A run towards its end, run on straight instead of its last point."""
    step = points[-1] - points[-2]
    return np.concatenate([points[:-1], [points[-1] + _TAIL / np.hypot(*step) * step]])


def _crossing(a: np.ndarray, b: np.ndarray, near: np.ndarray) -> tuple[np.ndarray, int, int]:
    """Where two polylines cross nearest to a place, and the segments that do; their last ones,
    run on both ways, when none do."""
    p, r = a[:-1, None], np.diff(a, axis=0)[:, None]
    q, s = b[None, :-1], np.diff(b, axis=0)[None]
    area = _cross(r, s)
    safe = np.where(np.abs(area) < 1e-12, 1.0, area)
    t, u = _cross(q - p, s) / safe, _cross(q - p, r) / safe
    hit = (np.abs(area) >= 1e-12) & (t >= 0.0) & (t <= 1.0) & (u >= 0.0) & (u <= 1.0)
    places = p + t[..., None] * r
    if not hit.any():
        return places[-1, -1], len(a) - 2, len(b) - 2
    away = np.where(hit, ((places - near) ** 2).sum(axis=-1), np.inf)
    i, j = np.unravel_index(int(np.argmin(away)), away.shape)
    return places[i, j], int(i), int(j)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _with_allowances(sides: Sides, runs: dict[str, list[Run]], given) -> dict[str, list[Run]]:
    shapes = {name: tuple(run for run, _ in own) for name, own in runs.items()}
    made = gross.allowed(replace(sides, **shapes), given)
    out = {}
    for name, own in runs.items():
        bevels = [bevel for _, bevel in own]
        if name in ("first", "second"):
            # Green is cut as the edge beside it.
            bevels = [bevels[0]] * bool(given.green_start) + bevels
            bevels += [bevels[-1]] * bool(given.green_end)
        out[name] = list(zip(getattr(made, name), bevels, strict=True))
    return out


def _in_order(runs: dict[str, list[Run]], mirrored: bool) -> list[Run]:
    """The sides as one outline, counter-clockwise, as `Sides.outline`."""
    if mirrored:
        return [*runs["start"], *runs["second"], *_back(runs["end"]), *_back(runs["first"])]
    return [*runs["first"], *runs["end"], *_back(runs["second"]), *_back(runs["start"])]


def _back(runs: list[Run]) -> list[Run]:
    return [(run[::-1], bevel) for run, bevel in reversed(runs)]
