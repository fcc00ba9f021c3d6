# SPDX-License-Identifier: LGPL-2.1-or-later
"""Member frames along an axis: tangent, outward surface normal less its tangent part, breadth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .axis import Axis
from .finding import BendTorsionError, error
from .piecewise import Piecewise, resolve
from .surface import Surface

STEEPEST_NORMAL = 0.1
"""Sine of the least angle between axis and surface normal that still gives a section plane."""


@dataclass(frozen=True, eq=False)
class FrameStations:
    """Frames at stations s (n,): origin, x, y, z (n, 3) and curvatures ky, kz, twist (n,).

    x' = ky y + kz z, y' = -ky x + twist z, z' = -kz x - twist y (rates per mm).
    """

    s: np.ndarray
    origin: np.ndarray
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    ky: np.ndarray
    kz: np.ndarray
    twist: np.ndarray


@dataclass(frozen=True, eq=False)
class Frames:
    """The Darboux frame of an axis on a surface, by arc length.

    position_and_z: s -> (6,), the axis point and the unit section z axis.
    """

    axis: Axis
    position_and_z: Piecewise

    @property
    def breaks(self) -> np.ndarray:
        """Arc lengths where the frame is less than smooth."""
        return self.position_and_z.breaks

    def at(self, s: np.ndarray) -> FrameStations:
        """The frames at arc lengths s (n,)."""
        value = self.position_and_z(s)
        rate = self.position_and_z.derivative(s)
        bend = self.axis.tangent.derivative(s)
        x, z = rate[:, :3], value[:, 3:]
        y = np.cross(z, x)
        ky, kz = (bend * y).sum(axis=1), (bend * z).sum(axis=1)
        twist = -(rate[:, 3:] * y).sum(axis=1)
        return FrameStations(np.asarray(s, float), value[:, :3], x, y, z, ky, kz, twist)


def surface_frames(axis: Axis, surface: Surface, roll: float = 0.0) -> Frames:
    """Frames of `axis` from the outward normals of `surface`, turned by `roll` (rad) about x.

    z is the normal at the foot point minus its tangent part, so that it lies in the section
    plane; its sign is the surface's, carried along the axis. Raises BendTorsionError where the
    axis runs along the normal.
    """

    def position_and_z(s: np.ndarray) -> np.ndarray:
        points = axis.position(s)
        x = axis.tangent(s)
        x /= np.linalg.norm(x, axis=1, keepdims=True)
        normal = surface.closest(points).normals
        z = normal - (normal * x).sum(axis=1, keepdims=True) * x
        size = np.linalg.norm(z, axis=1, keepdims=True)
        if (size < STEEPEST_NORMAL).any():
            worst = int(np.argmin(size))
            raise BendTorsionError(
                error(
                    "axis-along-normal",
                    axis.name,
                    "the axis runs along the surface normal: no section plane",
                    "turn the axis, or choose another surface",
                    position=f"s = {s[worst]:.0f} mm",
                    value=float(size[worst, 0]),
                    limit=STEEPEST_NORMAL,
                )
            )
        z /= size
        if roll:
            z = np.cos(roll) * z + np.sin(roll) * np.cross(x, z)
        return np.column_stack([points, z * _length_scale])

    # Position and direction are resolved together: scaled so that both matter equally.
    _length_scale = max(axis.length, 1.0)
    resolved = resolve(position_and_z, axis.position.breaks, _length_scale)
    values = resolved.values.copy()
    values[..., 3:] /= _length_scale
    flat = values.reshape(-1, 6)
    jump = (flat[1:, 3:] * flat[:-1, 3:]).sum(axis=1)
    if (jump < 0).any():
        sign = np.cumprod(np.concatenate([[1.0], np.sign(jump)]))
        flat[:, 3:] *= sign[:, None]
    return Frames(axis, Piecewise(resolved.breaks, flat.reshape(values.shape)))


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


def _torsion_at(frames: Frames, stations: int) -> tuple[np.ndarray, np.ndarray]:
    # A double reflection is an isometry that carries section plane to section plane, so the angle
    # between the carried z axis and the next one adds up to the angle against a carried R.
    s = np.linspace(0.0, frames.axis.length, stations)
    at = frames.at(s)
    step = np.diff(at.origin, axis=0)
    carried = _reflected(at.z[:-1], step)
    carried = _reflected(carried, at.x[1:] - _reflected(at.x[:-1], step))
    sine = (np.cross(carried, at.z[1:]) * at.x[1:]).sum(axis=1)
    cosine = (carried * at.z[1:]).sum(axis=1)
    return s, np.concatenate([[0.0], np.cumsum(np.arctan2(sine, cosine))])


def _reflected(vectors: np.ndarray, mirror_normals: np.ndarray) -> np.ndarray:
    """Each vector reflected in the plane normal to its mirror normal (none where that is zero)."""
    squared = (mirror_normals * mirror_normals).sum(axis=1, keepdims=True)
    along = (vectors * mirror_normals).sum(axis=1, keepdims=True)
    factor = np.divide(2.0 * along, squared, out=np.zeros_like(along), where=squared > 0.0)
    return vectors - factor * mirror_normals
