# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places along an axis: where it meets or passes another, and where members are cut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, error
from .axis import Axis
from .axis_check import place

LONGEST_MISS = 1000.0
"""mm: axes that pass at more than this do not cross."""
LONGEST_POINT_MISS = 1000.0
"""mm: a point farther than this from an axis is no place on it, unless a member reaches there."""
BESIDE_MEMBER = 1.1
"""How far from the axis a point of a cut may lie, as a part of how far its member reaches."""


@dataclass(frozen=True, eq=False)
class Crossing:
    """Closest approach of two axes: arc lengths first and second (mm), the points (3,) there and
    their distance, mm."""

    first: float
    second: float
    first_point: np.ndarray
    second_point: np.ndarray
    distance: float


def crossings(first: Axis, second: Axis, limit: float = LONGEST_MISS) -> tuple[Crossing, ...]:
    """All local closest approaches of two axes within `limit` mm, by rising place on the first.

    Ends count: an axis that stops short of another is nearest to it at its end.
    """
    s, t = (np.linspace(0.0, axis.length, _count(axis)) for axis in (first, second))
    p, q = first.position(s), second.position(t)
    distance = np.linalg.norm(p[:, None] - q[None], axis=2)
    padded = np.pad(distance, 1, constant_values=np.inf)
    least = np.ones(distance.shape, bool)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            shifted = padded[1 + i : 1 + i + len(s), 1 + j : 1 + j + len(t)]
            least &= distance <= shifted
    step = max(s[1], t[1])
    rows, columns = np.nonzero(least & (distance <= limit + 2 * step))
    if not len(rows):
        return ()
    a, b = _closest(first, second, s[rows], t[columns])
    x, y = first.position(a), second.position(b)
    away = np.linalg.norm(x - y, axis=1)
    found: list[Crossing] = []
    for k in np.lexsort((b, a)):
        new = Crossing(float(a[k]), float(b[k]), x[k], y[k], float(away[k]))
        twin = any(
            abs(old.first - new.first) + abs(old.second - new.second) < 1e-3 for old in found
        )
        if new.distance <= limit and not twin:
            found.append(new)
    return tuple(found)


def cut_place(
    axis: Axis,
    *,
    length: float | None = None,
    ratio: float | None = None,
    point: np.ndarray | None = None,
    crossing: Axis | None = None,
    offset: float = 0.0,
    reach: float = 0.0,
) -> float:
    """Arc length in mm of a cut given by one of: length mm (negative: from the end), ratio 0..1,
    the place nearest to a point (3,), or the place nearest to another axis; plus `offset` mm
    along the axis. reach: how far from the axis the member along it reaches, mm; a point on it is
    near.

    Raises BendTorsionError when the cut is not on the axis, the other axis is more than 1 m away,
    the point more than 1 m and clear of the member, or the other axis passes it several times as
    near.
    """
    if sum(value is not None for value in (length, ratio, point, crossing)) != 1:
        raise BendTorsionError(
            error(
                "cut-place",
                axis.name,
                "a cut needs one of length, ratio, point, crossing axis",
                "give exactly one",
            )
        )
    if length is not None:
        s = length if length >= 0 else axis.length + length
    elif ratio is not None:
        s = ratio * axis.length
    elif point is not None:
        s = _nearest_place(axis, np.asarray(point, float).reshape(1, 3), reach)
    else:
        s = _crossing_place(axis, crossing)
    s = float(s + offset)
    if axis.closed:
        return float(np.mod(s, axis.length))
    if not -tolerances.SAME_STATION <= s <= axis.length + tolerances.SAME_STATION:
        raise BendTorsionError(
            error(
                "cut-beyond-axis",
                axis.name,
                "the cut is not on the axis",
                "move the cut",
                value=s,
                limit=axis.length,
                unit="mm",
            )
        )
    return min(max(s, 0.0), axis.length)


def _nearest_place(axis: Axis, point: np.ndarray, reach: float) -> float:
    s = axis.place_of(point)
    away = float(np.linalg.norm(axis.position(s) - point))
    limit = max(LONGEST_POINT_MISS, BESIDE_MEMBER * reach)
    if not away <= limit:
        raise BendTorsionError(
            error(
                "cut-point-far",
                axis.name,
                "the point of the cut is far from the axis",
                "choose a point near the axis",
                position=place(point[0]),
                value=away,
                limit=limit,
                unit="mm",
            )
        )
    return float(s[0])


def _crossing_place(axis: Axis, other: Axis) -> float:
    found = sorted(crossings(axis, other), key=lambda item: item.distance)
    if not found:
        raise BendTorsionError(
            error(
                "cut-no-crossing",
                axis.name,
                f"axis {other.name} does not come near this one",
                "choose an axis that crosses",
                position=other.name,
                limit=LONGEST_MISS,
                unit="mm",
            )
        )
    near = [item for item in found if item.distance <= found[0].distance + 1.0]
    if len(near) > 1:
        places = ", ".join(f"{item.first:.0f}" for item in sorted(near, key=lambda i: i.first))
        raise BendTorsionError(
            error(
                "cut-crossing-ambiguous",
                axis.name,
                f"axis {other.name} crosses at s = {places} mm",
                "give the cut by length or by a point",
                position=other.name,
                value=len(near),
                limit=1,
            )
        )
    return found[0].first


def _count(axis: Axis) -> int:
    return int(np.clip(6 * len(axis.position.breaks), 100, 500))


def _closest(first: Axis, second: Axis, a: np.ndarray, b: np.ndarray):
    """Places of the nearest approaches from starts a, b (m,): damped Newton within the ends."""
    ta, tb = first.tangent, second.tangent
    reach = 2.0 * max(first.length / (_count(first) - 1), second.length / (_count(second) - 1))
    for _ in range(60):
        gap = first.position(a) - second.position(b)
        x, y = ta(a), tb(b)
        g, h = (gap * x).sum(axis=1), -(gap * y).sum(axis=1)
        # Curvature terms are dropped where they would make the quadratic form indefinite.
        aa = 1.0 + np.maximum((gap * ta.derivative(a)).sum(axis=1), -0.9)
        bb = 1.0 - np.minimum((gap * tb.derivative(b)).sum(axis=1), 0.9)
        ab = -(x * y).sum(axis=1)
        low_a = (a <= 0) & (g > 0) | (a >= first.length) & (g < 0)
        low_b = (b <= 0) & (h > 0) | (b >= second.length) & (h < 0)
        g, h = np.where(low_a, 0.0, g), np.where(low_b, 0.0, h)
        ab = np.where(low_a | low_b, 0.0, ab)
        below = aa * bb - ab**2
        below = np.where(below > 1e-9, below, aa * bb)
        da = np.clip((ab * h - bb * g) / below, -reach, reach)
        db = np.clip((ab * g - aa * h) / below, -reach, reach)
        a, b = np.clip(a + da, 0.0, first.length), np.clip(b + db, 0.0, second.length)
        if max(np.abs(da).max(), np.abs(db).max()) < 1e-9:
            break
    return a, b
