# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ruling development: a two-rail ruled patch laid flat by quadrature along its rulings.

For rails P0(s), P1(s), R = P1 − P0, ρ = |R|, w in [0, 1]: W(s, w) = √(EG − F²)/ρ and
q = P0'·R/ρ. In the plane x = c + wρd, d = (−sin θ, cos θ), d⊥ = (cos θ, sin θ), c' = p d⊥ + q d,
θ' = m/ρ: every ruling stays straight and rigid and shear is zero; p and m are free per station.
`edges` takes p = W(0), m = W(0) − W(1), so that both long edges keep their length exactly. A fold
along a ruling is crossed rigidly, since the ruling belongs to both sides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .finding import BendTorsionError, error
from .piecewise import Piecewise

ACROSS = np.linspace(0.0, 1.0, 5)
"""Places across a plate at which guards and strains are taken."""


@dataclass(frozen=True, eq=False)
class Development:
    """A flat pattern: surface rails s -> (6,), and the plane's c, θ, ρ as s -> (4,).

    The plane is seen from the side of the normal P' × R: s runs along d⊥, w along d.
    """

    surface: Piecewise
    plane: Piecewise

    def point(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Points (n, 3) of the curved surface at (s, w)."""
        rails = self.surface(s)
        return rails[:, :3] + np.asarray(w)[:, None] * (rails[:, 3:] - rails[:, :3])

    def flat(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the plane at (s, w)."""
        value = self.plane(s)
        direction = _ruling_direction(value[:, 2])
        return value[:, :2] + (np.asarray(w) * value[:, 3])[:, None] * direction

    def ruling_crossing(self, s: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """w (n,) where the rulings at s (n,) cross the flat straight lines a-b, each (n, 2)."""
        value = self.plane(s)
        direction = _ruling_direction(value[:, 2])
        along = b - a
        gap = a - value[:, :2]
        across = direction[:, 0] * along[:, 1] - direction[:, 1] * along[:, 0]
        return (gap[:, 0] * along[:, 1] - gap[:, 1] * along[:, 0]) / (across * value[:, 3])


def _ruling_direction(theta: np.ndarray) -> np.ndarray:
    """d = (−sin θ, cos θ), (n, 2). From a copy: numpy's sine of a strided view takes another path
    from run to run, with other last bits."""
    theta = theta.copy()
    return np.column_stack([-np.sin(theta), np.cos(theta)])


def develop(rails: Piecewise, name: str = "plate") -> Development:
    """The `edges` development of a ruled surface given by rails s -> (6,), P0 then P1.

    Both edges and every ruling keep their length. Raises BendTorsionError, with the place, where
    the surface or its pattern folds over itself (W <= 0, p − wm <= 0) or a ruling has no length.
    """
    values = rails.values
    rate = rails.derivative.values
    ruling = values[..., 3:] - values[..., :3]
    width = np.linalg.norm(ruling, axis=2)
    _guard(name, rails, width, "the strip has no width")
    unit = ruling / width[..., None]
    slip = (rate[..., :3] * unit).sum(axis=2)
    first = rate[..., :3] - slip[..., None] * unit
    second = rate[..., 3:] - (rate[..., 3:] * unit).sum(axis=2)[..., None] * unit
    p, p1 = np.linalg.norm(first, axis=2), np.linalg.norm(second, axis=2)
    _guard(name, rails, (first * second).sum(axis=2), "the plate folds over itself")
    theta = Piecewise(rails.breaks, ((p - p1) / width)[..., None]).antiderivative()
    angle = theta.values[..., 0]
    velocity = np.stack(
        [p * np.cos(angle) - slip * np.sin(angle), p * np.sin(angle) + slip * np.cos(angle)],
        axis=2,
    )
    path = Piecewise(rails.breaks, velocity).antiderivative()
    plane = np.concatenate([path.values, angle[..., None], width[..., None]], axis=2)
    return Development(rails, Piecewise(rails.breaks, plane))


def strain(development: Development, s: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Principal strain e = (p − wm)/W − 1 of laying flat, (n, k) at s (n,) and w (k,).

    Recomputed from the finished pattern: area per unit of (s, w), flat over curved. Rulings are
    rigid and shear is zero, so that the ratio is the strain across the rulings.
    """
    plane, slope = development.plane(s), development.plane.derivative(s)
    along = np.column_stack([np.cos(plane[:, 2]), np.sin(plane[:, 2])])
    flat = (slope[:, :2] * along).sum(axis=1)[:, None] - w * (slope[:, 2] * plane[:, 3])[:, None]
    rails, rate = development.surface(s), development.surface.derivative(s)
    ruling = (rails[:, 3:] - rails[:, :3])[:, None, :]
    tangent = rate[:, None, :3] + w[None, :, None] * (rate[:, 3:] - rate[:, :3])[:, None, :]
    area = np.linalg.norm(np.cross(tangent, ruling), axis=2)
    return flat * np.linalg.norm(ruling, axis=2) / area - 1.0


@dataclass(frozen=True, eq=False)
class SurfaceShape:
    """Shape of a ruled surface at (n, k) places: unit normal P' × R, Gaussian curvature (1/mm2)
    and the largest absolute principal curvature (1/mm)."""

    normal: np.ndarray
    gauss: np.ndarray
    sharpest: np.ndarray


def shape_of(rails: Piecewise, s: np.ndarray, w: np.ndarray) -> SurfaceShape:
    """First and second fundamental forms of the ruled surface at s (n,) and w (k,)."""
    value, rate, bend = rails(s), rails.derivative(s), rails.derivative.derivative(s)
    ruling = np.repeat((value[:, 3:] - value[:, :3])[:, None, :], len(w), axis=1)
    twist = np.repeat((rate[:, 3:] - rate[:, :3])[:, None, :], len(w), axis=1)
    weight = np.asarray(w)[None, :, None]
    tangent = rate[:, None, :3] + weight * twist
    second = bend[:, None, :3] + weight * (bend[:, 3:] - bend[:, :3])[:, None, :]
    normal = np.cross(tangent, ruling)
    area = np.linalg.norm(normal, axis=2)
    normal = normal / area[..., None]
    e, f, g = ((a * b).sum(axis=2) for a, b in
               ((tangent, tangent), (tangent, ruling), (ruling, ruling)))
    l, m = (second * normal).sum(axis=2), (twist * normal).sum(axis=2)
    gauss = -((m / area) ** 2)
    mean = (l * g - 2 * m * f) / (2 * area**2)
    sharpest = np.abs(mean) + np.sqrt(np.maximum(mean**2 - gauss, 0.0))
    return SurfaceShape(normal, gauss, sharpest)


def _guard(name: str, rails: Piecewise, positive: np.ndarray, problem: str) -> None:
    if (positive <= 0).any():
        at = np.unravel_index(int(np.argmin(positive)), positive.shape)
        raise BendTorsionError(
            error(
                "plate-folds-over",
                name,
                problem,
                "use a smaller section or a smoother axis",
                position=f"s = {rails.nodes[at]:.0f} mm",
                value=float(positive[at]),
                limit=0.0,
            )
        )
