# SPDX-License-Identifier: LGPL-2.1-or-later
"""The end of a tube cut by a smooth surface, as splines a B-rep is written from.

The end is a cubic spline in w (across the plate) and d (through it), through points of the end
surface found within the tube's own faces; its sides bound both the cap and the faces, so that
they meet by construction. The grid is refined until they do to brep.TOLERANCE.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.interpolate import BSpline

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.members.member import EndSurface
from BendTorsionWB.core.members.skin import SkinPiece, values_and_rates
from BendTorsionWB.shapes import brep

COUNTS = (9, 17, 33, 65)
"""Points across an end, doubled until the faces meet."""
THROUGH = 4
FOUND = 1e-10
"""mm: Newton steps below which a point of the end is found."""
_STEPS = 40
_TRACES = ((0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0))


@dataclass(frozen=True, eq=False)
class CutRing:
    """points (4, 3) of the ring and their parameters places (4,) on the rails; surface: text of
    the cap; sides: texts of the curve, its traces on face and cap, from each rail to the next."""

    points: np.ndarray
    places: np.ndarray
    surface: str
    sides: tuple[tuple[str, str, str], ...]


def cut_ring(piece: SkinPiece, surface: EndSurface, near: float, name: str) -> CutRing:
    """The ring where a piece of a plate's skin (four rails) ends on a surface near a parameter.

    Raises BendTorsionError where the points are not found, or the faces do not come to meet.
    """
    for count in COUNTS:
        u, points = _grid(piece, surface, near, count, name)
        knots = _knots(count), _knots(THROUGH)
        poles = _interpolated(points, knots)
        traces = _interpolated(u[..., None], knots)[..., 0]
        if _apart(piece, knots, poles, traces) <= 0.5 * brep.TOLERANCE:
            return _written(u, points, knots, poles, traces)
    raise BendTorsionError(
        error(
            "solid-refused",
            name,
            "the cut end is too curved for its faces to meet",
            "report this with the document",
            value=_apart(piece, knots, poles, traces),
            limit=0.5 * brep.TOLERANCE,
            unit="mm",
        )
    )


def _grid(piece, surface, near, count, name) -> tuple[np.ndarray, np.ndarray]:
    """Parameters u (count, THROUGH) and points (count, THROUGH, 3) of the end."""
    w, d = np.linspace(0.0, 1.0, count), np.linspace(0.0, 1.0, THROUGH)
    weights = _weights(np.repeat(w, THROUGH), np.tile(d, count))
    first, last = piece.knots[0], piece.knots[-1]
    u = np.full(count * THROUGH, float(near))
    for _ in range(_STEPS):
        points, rate = _on_fibres(piece, u, weights)
        value, gradient = surface.value_and_gradient(points)
        step = value / (gradient * rate).sum(axis=1)
        u = np.minimum(np.maximum(u - step, first), last)
        if np.abs(step).max() < FOUND:
            points, _ = _on_fibres(piece, u, weights)
            return u.reshape(count, THROUGH), points.reshape(count, THROUGH, 3)
    raise BendTorsionError(
        error(
            "solid-refused",
            name,
            "the cut end is not found",
            "report this with the document",
            value=float(np.abs(step).max()),
            limit=FOUND,
            unit="mm",
        )
    )


def _weights(w: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Of the four rails (n, 4) at w and d: outer first, second, inner second, first."""
    return np.stack([(1 - w) * (1 - d), w * (1 - d), w * d, (1 - w) * d], axis=1)


def _on_fibres(piece, u, weights) -> tuple[np.ndarray, np.ndarray]:
    """Points and rates (n, 3) at u (n,) between the rails."""
    both = values_and_rates([piece], [u])[0]
    return tuple((part * weights[..., None]).sum(axis=1) for part in both)


@cache
def _knots(count: int) -> tuple[float, ...]:
    """Cubic knots of a not-a-knot spline through even places on [0, 1]."""
    inner = np.linspace(0.0, 1.0, count)[2:-2].tolist()
    return (*(0.0,) * 4, *inner, *(1.0,) * 4)


@cache
def _collocation(count: int) -> np.ndarray:
    """Poles (count,) from values (count,) at even places on [0, 1]."""
    places = np.linspace(0.0, 1.0, count)
    return np.linalg.inv(BSpline.design_matrix(places, np.array(_knots(count)), 3).toarray())


def _interpolated(values: np.ndarray, knots) -> np.ndarray:
    """Poles of the tensor spline through values (n, m, k). Not by BLAS: the same input must give
    the same bytes."""
    across, through = (_collocation(len(own) - 4) for own in knots)
    rows = sum(across[:, j, None, None] * values[j] for j in range(values.shape[0]))
    return sum(through[:, j, None] * rows[:, j, None, :] for j in range(values.shape[1]))


def _apart(piece, knots, poles, traces) -> float:
    """How far, mm, the sides of the cap lie from their traces on the faces."""
    worst = 0.0
    for rail, (own, t, u) in enumerate(_sides(knots, poles, traces)):
        at = np.linspace(0.0, 1.0, 4 * len(own) + 1)
        place = BSpline(np.array(t), u, 3)(at)
        weights = np.zeros((len(at), 4))
        weights[:, rail], weights[:, (rail + 1) % 4] = 1.0 - at, at
        points, _ = _on_fibres(piece, place, weights)
        miss = BSpline(np.array(t), own, 3)(at) - points
        worst = max(worst, float(np.sqrt((miss * miss).sum(axis=1)).max()))
    return worst


def _sides(knots, poles, traces):
    """Per side from each rail to the next: poles (n, 3), knots, and poles (n,) of u."""
    across, through = knots
    return (
        (poles[:, 0], across, traces[:, 0]),
        (poles[-1], through, traces[-1]),
        (poles[::-1, -1], across, traces[::-1, -1]),
        (poles[0, ::-1], through, traces[0, ::-1]),
    )


def _written(u, points, knots, poles, traces) -> CutRing:
    tables = [_table(own) for own in knots]
    rows = " ".join(" ".join(map(_number, point)) for row in poles for point in row)
    n, m = poles.shape[:2]
    surface = f"9 0 0 0 0 3 3 {n} {m} {n - 2} {m - 2} {rows} \n{tables[0]}\n{tables[1]}\n"
    sides = []
    for (own, t, place), trace in zip(_sides(knots, poles, traces), _TRACES, strict=True):
        count, table = len(own), _table(t)
        curve = " ".join(" ".join(map(_number, point)) for point in own)
        # v runs evenly from rail to rail: its poles are the knots' averages.
        even = [sum(t[k + 1 : k + 4]) / 3.0 for k in range(count)]
        flat = " ".join(f"{_number(a)} {_number(b)}" for a, b in zip(place, even, strict=True))
        sides.append(
            (
                f"7 0 0 3 {count} {count - 2} {curve} \n{table}\n",
                f"7 0 0 3 {count} {count - 2} {flat} \n{table}\n",
                brep.trace(*trace, 1.0),
            )
        )
    ring = [points[0, 0], points[-1, 0], points[-1, -1], points[0, -1]]
    places = np.array([u[0, 0], u[-1, 0], u[-1, -1], u[0, -1]])
    return CutRing(np.array(ring), places, surface, tuple(sides))


def _table(knots) -> str:
    """Distinct knots and how often each stands."""
    inner = "".join(f"{_number(knot)} 1\n" for knot in knots[4:-4])
    return f"0 4\n{inner}1 4"


def _number(value: float) -> str:
    return f"{float(value):.17g}"
