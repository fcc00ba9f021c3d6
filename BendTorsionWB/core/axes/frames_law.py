# SPDX-License-Identifier: LGPL-2.1-or-later
"""Angles given at stations of an axis, as one smooth function of arc length."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from .. import tolerances
from ..finding import BendTorsionError, error

WHOLE_TURN = 1e-6
"""How far (rad) the last angle of a closed axis may be from the first plus whole turns."""


@dataclass(frozen=True)
class GivenDirection:
    """A given direction at a place of the axis: an angle in rad, or the direction z asks for.

    place: mm of arc length, or a ratio of the length when is_ratio.
    """

    place: float
    angle: float | None = None
    z: tuple[float, float, float] | None = None
    is_ratio: bool = False

    def at(self, length: float) -> float:
        """Arc length, mm, on an axis of this length."""
        return self.place * length if self.is_ratio else self.place


def ordered_places(name: str, stations: Sequence[GivenDirection], length: float) -> np.ndarray:
    """Arc lengths of the stations (n,); raises BendTorsionError unless they rise on the axis."""
    places = np.array([station.at(length) for station in stations], float)
    slack = tolerances.SAME_STATION + 1e-9 * length
    for k, place in enumerate(places):
        if not -slack <= place <= length + slack:
            raise BendTorsionError(
                error(
                    "frame-station-outside",
                    name,
                    "the station is not on the axis",
                    "give mm between the ends of the axis, or a ratio between 0 and 1",
                    position=f"station {k + 1}",
                    value=float(place),
                    limit=float(length),
                    unit="mm",
                )
            )
        if k and place - places[k - 1] <= tolerances.STATION_AT_PLATE_END:
            raise BendTorsionError(
                error(
                    "frame-stations-order",
                    name,
                    "stations do not rise along the axis",
                    "put them in order, at least 1 mm apart",
                    position=f"station {k + 1}",
                    value=float(place),
                    limit=float(places[k - 1]),
                    unit="mm",
                )
            )
    return np.clip(places, 0.0, length)


def angle_law(
    name: str, places: np.ndarray, angles: np.ndarray, length: float, closed: bool
) -> Callable[[np.ndarray], np.ndarray]:
    """s (n,) -> angle (n,) rad: a cubic spline through the angles, twice smooth between stations.

    Beyond the first and last station the angle is held, and the rate runs out to zero there. On a
    closed axis the law is periodic, plus whole turns when the last station at the seam asks for
    them; raises BendTorsionError when it asks for another angle than the first.
    """
    if len(places) == 0:
        return lambda s: np.zeros(len(s))
    if len(places) == 1:
        return lambda s: np.full(len(s), float(angles[0]))
    if closed:
        return _periodic(name, places, angles, length)
    ends = [
        "not-a-knot" if abs(place - end) <= tolerances.SAME_STATION else (1, 0.0)
        for place, end in ((places[0], 0.0), (places[-1], length))
    ]
    spline = CubicSpline(places, angles, bc_type=tuple(ends))
    return lambda s: spline(np.clip(s, places[0], places[-1]))


def _periodic(name, places, angles, length):
    turns = 0.0
    if length - (places[-1] - places[0]) <= tolerances.SAME_STATION:
        turns = 2.0 * np.pi * np.round((angles[-1] - angles[0]) / (2.0 * np.pi))
        if abs(angles[-1] - angles[0] - turns) > WHOLE_TURN:
            raise BendTorsionError(
                error(
                    "frame-does-not-close",
                    name,
                    "the angle at the seam of the closed axis differs from the one at its start",
                    "make both equal, or a whole turn apart",
                    position="last station",
                    value=float(np.degrees(angles[-1])),
                    limit=float(np.degrees(angles[0])),
                    unit="°",
                )
            )
        places, angles = places[:-1], angles[:-1]
    rest = angles - turns * places / length
    if len(places) == 1:
        return lambda s: rest[0] + turns * s / length
    spline = CubicSpline(
        np.append(places, places[0] + length), np.append(rest, rest[0]), bc_type="periodic"
    )
    return lambda s: spline(s) + turns * s / length
