# SPDX-License-Identifier: LGPL-2.1-or-later
"""Member frames along an axis: tangent x, height z by one of four rules, breadth y."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, error
from ..geometry.piecewise import DEGREE, Piecewise, resolve
from ..geometry.surface import Surface
from ..geometry.vectors import crossed, dots
from .axis import Axis
from .frames_law import GivenDirection, angle_law, ordered_places
from .frames_minimal import carried, closing_angle, minimal_direction, turned
from .frames_screw import FrameStations, running_on

FRAMES = ("surface", "minimal", "fixed", "given")
STEEPEST_NORMAL = 0.1
"""Sine of the least angle between axis and wanted direction that still gives a section plane."""


@dataclass(frozen=True)
class FrameInput:
    """How the section turns along an axis.

    kind: `surface` z on the outward normal; `minimal` from the surface's normal at the start (or
    `direction`) without turning about the axis, on a closed axis with the closing angle spread
    evenly; `fixed` z towards `direction`; `given` angles against the minimal frame, or directions
    of z, at stations. roll and the angles of `twist` (rad, about +x) are added to any of them.
    """

    kind: str = "surface"
    roll: float = 0.0
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    given: tuple[GivenDirection, ...] = ()
    twist: tuple[GivenDirection, ...] = ()


@dataclass(frozen=True, eq=False)
class Frames:
    """The frames of an axis by arc length.

    position_and_z: s -> (6,), the axis point and the unit section z axis.
    """

    axis: Axis
    position_and_z: Piecewise

    @property
    def breaks(self) -> np.ndarray:
        """Arc lengths where the frame is less than smooth."""
        return self.position_and_z.breaks

    def at(self, s: np.ndarray) -> FrameStations:
        """The frames at arc lengths s (n,); beyond the ends of an open axis on the screw that runs
        on with the curvatures and the twist of the end."""
        s = np.asarray(s, float)
        inside = s.clip(self.position_and_z.start, self.position_and_z.end)
        past = np.abs(s - inside) > tolerances.SAME_STATION
        if not past.any():
            return self._inside(s)
        found = self._inside(np.where(past, inside, s))
        return running_on(found, np.where(past, s - inside, 0.0))

    def _inside(self, s: np.ndarray) -> FrameStations:
        value = self._whole(s)
        rate, bend = value[:, 6:12], value[:, 12:]
        x, z = rate[:, :3], value[:, 3:6]
        y = crossed(z, x)
        ky, kz = dots(bend, y), dots(bend, z)
        twist = -dots(rate[:, 3:], y)
        return FrameStations(s, value[:, :3], x, y, z, ky, kz, twist)

    @cached_property
    def _whole(self) -> Piecewise:
        """position_and_z, its rate and the rate of the tangent: s -> (15,), one evaluation."""
        own, bend = self.position_and_z, self.axis.tangent.derivative
        # The last node of a span belongs to it, not to the next.
        rates = bend(own.nodes.ravel()).reshape(*own.nodes.shape, 3)
        rates[:, -1] = bend(own.nodes[:, -1], "earlier")
        return Piecewise(
            own.breaks, np.concatenate([own.values, own.derivative.values, rates], axis=2)
        )


def frames_of(axis: Axis, surface: Surface | None, given: FrameInput = FrameInput()) -> Frames:
    """The frames of an axis.

    z is the wanted direction minus its tangent part, so that it lies in the section plane; its
    sign is carried along the axis. Raises BendTorsionError where the axis runs along the wanted
    direction, and for stations of a law that cannot be.
    """
    length, closed = axis.length, axis.closed
    wanted, places = _wanted(axis, surface, given)
    stations = ordered_places(axis.name, given.twist, length)
    twist = angle_law(
        axis.name, stations, np.array([s.angle or 0.0 for s in given.twist]), length, closed
    )

    def position_and_z(s: np.ndarray) -> np.ndarray:
        x = _tangents(axis, s)
        z = turned(wanted(s, x), x, given.roll + twist(s))
        return np.column_stack([axis.position(s), z * _length_scale])

    # Position and direction are resolved together: scaled so that both matter equally.
    _length_scale = max(length, 1.0)
    breaks = _with_places(axis.position.breaks, np.concatenate([places, stations]))
    resolved = resolve(position_and_z, breaks, max(1.0, _rounding(axis)) * _length_scale)
    values = resolved.values.copy()
    values[..., 3:] /= _length_scale
    flat = values.reshape(-1, 6)
    x = _tangents(axis, resolved.nodes.ravel())
    agree = (carried(flat[:, :3], x, flat[:, 3:]) * flat[1:, 3:]).sum(axis=1)
    if (agree < 0).any():
        sign = np.cumprod(np.concatenate([[1.0], np.where(agree < 0, -1.0, 1.0)]))
        flat[:, 3:] *= sign[:, None]
    return Frames(axis, Piecewise(resolved.breaks, flat.reshape(values.shape)))


def surface_frames(axis: Axis, surface: Surface, roll: float = 0.0) -> Frames:
    """Frames of `axis` from the outward normals of `surface`, turned by `roll` (rad) about x."""
    return frames_of(axis, surface, FrameInput(roll=roll))


def wanted_z(axis: Axis, surface: Surface | None, given: FrameInput, s: np.ndarray) -> np.ndarray:
    """The z axes (n, 3) asked for at rising arc lengths s (n,), worked out afresh.

    `surface` and `fixed` from the direction itself; `minimal` and `given` by double reflections
    between stations, without the frame that `frames_of` integrates.
    """
    length, closed = axis.length, axis.closed
    s = np.asarray(s, float)
    x = _tangents(axis, s)
    if given.kind in ("surface", "fixed"):
        z = _wanted(axis, surface, given)[0](s, x)
    else:
        z = _reflected_to(axis, _start(axis, surface, given), s)
        if closed:
            turn = closing_angle(
                _tangents(axis, np.zeros(1))[0],
                _start(axis, surface, given),
                _reflected_to(axis, _start(axis, surface, given), np.array([length]))[0],
            )
            z = turned(z, x, turn * s / length)
        if given.kind == "given":
            places = ordered_places(axis.name, given.given, length)
            angles = _given_angles(
                axis,
                given,
                places,
                lambda at, _: wanted_z(
                    axis, surface, replace(given, kind="minimal", twist=(), roll=0.0), at
                ),
            )
            z = turned(z, x, angle_law(axis.name, places, angles, length, closed)(s))
    stations = ordered_places(axis.name, given.twist, length)
    twist = angle_law(
        axis.name, stations, np.array([t.angle or 0.0 for t in given.twist]), length, closed
    )
    return turned(z, x, given.roll + twist(s))


def _wanted(axis: Axis, surface: Surface | None, given: FrameInput):
    """(s, x) -> unit z (n, 3) across x as the kind asks for, and the places that shape it."""
    none = np.empty(0)
    if given.kind == "surface":
        if surface is None:
            raise BendTorsionError(
                error(
                    "frame-without-surface",
                    axis.name,
                    "frame surface needs a surface",
                    "choose a surface, or frame minimal, fixed or given",
                )
            )
        return lambda s, x: _across(
            axis,
            s,
            x,
            surface.closest(axis.surface_points(s)).normals,
            "axis-along-normal",
            "the axis runs along the surface normal: no section plane",
            "turn the axis, or choose another surface",
        ), none
    if given.kind == "fixed":
        direction = _fixed_direction(axis, given)
        return lambda s, x: _across(
            axis,
            s,
            x,
            np.broadcast_to(direction, (len(s), 3)),
            "axis-along-direction",
            "the axis runs along the fixed direction: no section plane",
            "give another direction, or use frame minimal",
        ), none
    if given.kind not in FRAMES:
        raise BendTorsionError(
            error(
                "frame-kind",
                axis.name,
                "no such frame",
                f"use {', '.join(FRAMES)}",
                value=given.kind,
            )
        )
    start = _start(axis, surface, given)
    carry = minimal_direction(axis, start)

    def minimal(s: np.ndarray, x: np.ndarray) -> np.ndarray:
        return turned(carry(s), x, closing * s / axis.length)

    closing = 0.0
    if axis.closed:
        end = carry(np.array([axis.length]))[0]
        closing = closing_angle(_tangents(axis, np.zeros(1))[0], start, end)
    if given.kind == "minimal":
        return minimal, none
    places = ordered_places(axis.name, given.given, axis.length)
    angles = _given_angles(axis, given, places, minimal)
    law = angle_law(axis.name, places, angles, axis.length, axis.closed)
    return lambda s, x: turned(minimal(s, x), x, law(s)), places


def _given_angles(axis: Axis, given: FrameInput, places: np.ndarray, minimal) -> np.ndarray:
    """The table's angles against the minimal frame; directions take the turn nearest the last."""
    if not len(places):
        raise BendTorsionError(
            error(
                "frame-table-empty",
                axis.name,
                "frame given needs a table of directions",
                "give angles or z directions at stations, or use another frame",
            )
        )
    x = _tangents(axis, places)
    z = minimal(places, x)
    angles = np.empty(len(places))
    for k, station in enumerate(given.given):
        if station.z is None:
            angles[k] = station.angle or 0.0
            continue
        wanted = _across(
            axis,
            places[k : k + 1],
            x[k : k + 1],
            np.array([station.z], float),
            "frame-direction",
            "the direction given runs along the axis",
            "give a direction across the axis",
        )[0]
        angle = np.arctan2((np.cross(z[k], wanted) * x[k]).sum(), (z[k] * wanted).sum())
        last = angles[k - 1] if k else 0.0
        angles[k] = angle + 2.0 * np.pi * np.round((last - angle) / (2.0 * np.pi))
    return angles


def _start(axis: Axis, surface: Surface | None, given: FrameInput) -> np.ndarray:
    """The z axis (3,) a minimal frame starts from: the surface's, else the fixed direction's."""
    place = np.zeros(1)
    x = _tangents(axis, place)[0]
    wishes = [_fixed_direction(axis, given), np.array([1.0, 0.0, 0.0])]
    if surface is not None:
        wishes.insert(0, surface.closest(axis.surface_points(place)).normals[0])
    for wish in wishes:
        z = wish - (wish * x).sum() * x
        if np.linalg.norm(z) >= STEEPEST_NORMAL:
            break
    return z / np.linalg.norm(z)


def _fixed_direction(axis: Axis, given: FrameInput) -> np.ndarray:
    direction = np.array(given.direction, float)
    size = np.linalg.norm(direction)
    if not np.isfinite(size) or size == 0.0:
        raise BendTorsionError(
            error(
                "frame-direction",
                axis.name,
                "the fixed direction has no length",
                "give a direction such as 0, 0, 1",
                value=str(tuple(given.direction)),
            )
        )
    return direction / size


def _across(axis, s, x, direction, code, message, mend) -> np.ndarray:
    """direction (n, 3) minus its part along x, unit; an error where little is left."""
    length = np.linalg.norm(direction, axis=1, keepdims=True)
    direction = np.divide(direction, length, out=np.zeros_like(direction), where=length > 0)
    z = direction - (direction * x).sum(axis=1, keepdims=True) * x
    size = np.linalg.norm(z, axis=1, keepdims=True)
    if not (size >= STEEPEST_NORMAL).all():
        worst = int(np.argmin(np.nan_to_num(size)))
        raise BendTorsionError(
            error(
                code,
                axis.name,
                message,
                mend,
                position=f"s = {s[worst]:.0f} mm",
                value=float(size[worst, 0]),
                limit=STEEPEST_NORMAL,
            )
        )
    return z / size


def _reflected_to(axis: Axis, start: np.ndarray, s: np.ndarray, step: float = 50.0) -> np.ndarray:
    """`start` (3,) at s = 0 carried to rising s by double reflections no longer than `step` mm."""
    count = max(int(np.ceil(axis.length / step)), 400)
    grid = np.union1d(np.linspace(0.0, axis.length, count + 1), s)
    points, x = axis.position(grid), _tangents(axis, grid)
    # Any vectors across the axis: a double reflection is an isometry of the section planes, so the
    # angles it carries them by add up.
    any_across = np.cross(x, np.eye(3)[np.argmin(np.abs(x), axis=1)])
    any_across /= np.linalg.norm(any_across, axis=1, keepdims=True)
    turn = _angle(carried(points, x, any_across), any_across[1:], x[1:])
    first = _angle(any_across[:1], start[None], x[:1])
    angle = first - np.concatenate([[0.0], np.cumsum(turn)])
    where = np.searchsorted(grid, s)
    return turned(any_across[where], x[where], angle[where])


def _angle(first: np.ndarray, second: np.ndarray, about: np.ndarray) -> np.ndarray:
    """Angles (n,) rad about unit vectors from first to second, (-π, π]."""
    sine = (np.cross(first, second) * about).sum(axis=1)
    return np.arctan2(sine, (first * second).sum(axis=1))


def _with_places(breaks: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The breaks, with places added that are clear of them."""
    clear = np.abs(places[:, None] - breaks).min(axis=1, initial=np.inf) > 1e-3
    return np.unique(np.concatenate([breaks, places[clear]]))


def _rounding(axis: Axis) -> float:
    """Rounding of the axis's tangents over what `resolve` asks for: coordinates are rounded, and
    the shorter the span the more that shows in their derivative. To halve a span for it would
    make it worse."""
    shortest = np.diff(axis.position.breaks).min()
    size = np.abs(axis.position.values).max()
    noise = 2.0 * DEGREE**2 * np.finfo(float).eps * size / shortest
    return noise / (20 * tolerances.INTERPOLATION_RELATIVE)


def _tangents(axis: Axis, s: np.ndarray) -> np.ndarray:
    x = axis.tangent(s)
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def torsion_angle(frames: Frames, stations: int = 113) -> tuple[np.ndarray, np.ndarray]:
    """Stations s (n,) and the torsion angle (n,) rad there, zero at the start.

    θ = unwrap(atan2((R×N)·T, R·N)) against the rotation-minimising frame R with R0 = N0, carried
    by double reflection (Wang, Jüttler, Zheng & Liu 2008). The stations are doubled until two
    counts agree to 1e-8 rad, three times at most.
    """
    last = _torsion_at(frames, stations)
    for _ in range(3):
        stations = 2 * stations - 1
        finer = _torsion_at(frames, stations)
        agree = np.abs(finer[1][::2] - last[1]).max() < 1e-8
        last = finer
        if agree:
            break
    return last


def winding_number(frames: Frames) -> int:
    """Whole turns of the z axis against the rotation-minimising frame, once round a closed axis;
    0 for an open one."""
    if not frames.axis.closed:
        return 0
    return int(np.round(torsion_angle(frames)[1][-1] / (2.0 * np.pi)))


def _torsion_at(frames: Frames, stations: int) -> tuple[np.ndarray, np.ndarray]:
    # A double reflection is an isometry that carries section plane to section plane, so the angle
    # between the carried z axis and the next one adds up to the angle against a carried R.
    s = np.linspace(0.0, frames.axis.length, stations)
    at = frames.at(s)
    before = carried(at.origin, at.x, at.z)
    return s, np.concatenate([[0.0], np.cumsum(_angle(before, at.z[1:], at.x[1:]))])
