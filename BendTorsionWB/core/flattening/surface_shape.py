# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curvatures of a ruled surface between two rails: its first and second fundamental forms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.piecewise import Piecewise, parted
from ..geometry.vectors import crossed, dots, lengths


@dataclass(frozen=True, eq=False)
class SurfaceShape:
    """Shape of a ruled surface at (n, k) places: unit normal P' × R, Gaussian curvature (1/mm2),
    the largest absolute principal curvature, the normal curvature across the rulings and the
    twist (geodesic torsion) along them (1/mm); along the ruling there is no curvature."""

    normal: np.ndarray
    gauss: np.ndarray
    sharpest: np.ndarray
    bend: np.ndarray
    twist: np.ndarray

    def parted(self, counts: Sequence[int]) -> list[SurfaceShape]:
        """The shape at so many places each, one after the other."""
        fields = (parted(part, counts) for part in vars(self).values())
        return [SurfaceShape(*own) for own in zip(*fields, strict=True)]


def shape_of(rails: Piecewise, s: np.ndarray, w: np.ndarray) -> SurfaceShape:
    """First and second fundamental forms of the ruled surface at s (n,) and w (k,)."""
    value = rails.with_rates(s)
    return shape_from(value[:, :6], value[:, 6:12], value[:, 12:], w)


def gauss_from(value: np.ndarray, rate: np.ndarray, w: float) -> np.ndarray:
    """Gaussian curvature (n,), 1/mm2, of the ruled surface along w, from values and rates (n, 6)
    of the rails: −(T·n̂)²/W²ρ², T the rate of the ruling."""
    ruling, twist = value[:, 3:] - value[:, :3], rate[:, 3:] - rate[:, :3]
    normal = crossed(rate[:, :3] + w * twist, ruling)
    return -((dots(twist, normal) / dots(normal, normal)) ** 2)


def shape_inside(rails: Piecewise, w: np.ndarray) -> SurfaceShape:
    """shape_of at all nodes inside the pieces."""
    pieces = rails, rails.derivative, rails.derivative.derivative
    return shape_from(*(piece.values[:, 1:-1].reshape(-1, 6) for piece in pieces), w)


def shape_from(
    value: np.ndarray, rate: np.ndarray, bend: np.ndarray, w: np.ndarray
) -> SurfaceShape:
    """As shape_of, from values, rates and second derivatives (n, 6) of the rails."""
    ruling = (value[:, 3:] - value[:, :3])[:, None, :]
    twist = (rate[:, 3:] - rate[:, :3])[:, None, :]
    weight = np.asarray(w)[None, :, None]
    tangent = rate[:, None, :3] + weight * twist
    second = bend[:, None, :3] + weight * (bend[:, 3:] - bend[:, :3])[:, None, :]
    normal = crossed(tangent, ruling)
    area = lengths(normal)
    normal = normal / area[..., None]
    f, g = dots(tangent, ruling), dots(ruling, ruling)
    bent, mixed = dots(second, normal), dots(twist, normal)
    gauss = -((mixed / area) ** 2)
    mean = (bent * g - 2 * mixed * f) / (2 * area**2)
    sharpest = np.abs(mean) + np.sqrt(np.maximum(mean**2 - gauss, 0.0))
    return SurfaceShape(normal, gauss, sharpest, 2.0 * mean, mixed / area)
