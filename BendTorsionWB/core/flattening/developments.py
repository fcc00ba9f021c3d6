# SPDX-License-Identifier: LGPL-2.1-or-later
"""The developments of many plates, evaluated, measured and integrated in one sweep."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.piecewise import (
    Piecewise,
    Together,
    derivatives_together,
    integrals_together,
    parted,
    with_rates_together,
)
from ..geometry.vectors import crossed, dots
from .development import (
    Development,
    Rulings,
    flat_area,
    ruling_area,
    ruling_strain,
    rulings_of,
    strain_at_nodes,
)
from .surface_shape import SurfaceShape, shape_from

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, eq=False)
class Developments:
    """Developments in order; what is given per development comes in the same order, and rows of
    several follow each other. All of them have corrections, or none."""

    each: tuple[Development, ...]

    @property
    def corrected(self) -> bool:
        """Whether points are moved off their rulings."""
        return self.each[0].correction is not None

    @cached_property
    def pieces(self) -> list[int]:
        """Number of pieces of each."""
        return [len(one.surface.values) for one in self.each]

    @cached_property
    def _rails(self) -> list[Piecewise]:
        return with_rates_together([one.surface for one in self.each])

    @cached_property
    def surface(self) -> np.ndarray:
        """Values, rates and second rates (m, nodes, 18) of the rails of all."""
        return np.concatenate([one.values for one in self._rails])

    @cached_property
    def plane(self) -> np.ndarray:
        """Values and rates (m, nodes, 8) of the planes of all."""
        planes = [one.plane for one in self.each]
        levels = planes, derivatives_together(planes)
        return np.concatenate(
            [np.concatenate([one.values for one in level]) for level in levels], axis=2
        )

    @cached_property
    def _both(self) -> Together:
        whole = np.concatenate([self.surface[..., :6], self.plane[..., :4]], axis=2)
        parts = parted(whole, self.pieces)
        return Together(
            [Piecewise(one.plane.breaks, part) for one, part in zip(self.each, parts, strict=True)]
        )

    @cached_property
    def _corrections(self) -> Together:
        return Together([one.correction for one in self.each])

    def rulings(self, places: Sequence[np.ndarray]) -> Rulings:
        """The rulings at places (n,) of each."""
        both, correction = self._both(places), None
        if self.corrected:
            correction = self._corrections(places).reshape(len(both), -1, 2)
        return rulings_of(both[:, :6], both[:, 6:], correction)

    def flat(self, places: Sequence[np.ndarray], w: np.ndarray) -> np.ndarray:
        """Points (m, 2) of the planes at places (n,) of each and w (m,) of all."""
        return self.rulings(places).flat(w)

    def shape_inside(self, w: np.ndarray) -> SurfaceShape:
        """shape_of at all nodes inside the pieces."""
        inside = self.surface[:, 1:-1].reshape(-1, 18)
        return shape_from(inside[:, :6], inside[:, 6:12], inside[:, 12:], w)

    @cached_property
    def _rails_together(self) -> Together:
        return Together(self._rails)

    def rails_at(self, places: Sequence[np.ndarray]) -> np.ndarray:
        """Values, rates and second rates (m, 18) of the rails at places (n,) of each."""
        return self._rails_together(places)

    def strain_at_nodes(self, w: np.ndarray) -> np.ndarray:
        """strain() at all nodes of the pieces, both sides of a fold each with its own limit."""
        if self.corrected:
            return np.concatenate([strain_at_nodes(one, w) for one in self.each])
        plane, surface = self.plane.reshape(-1, 8), self.surface.reshape(-1, 18)
        return ruling_strain(plane[:, :4], plane[:, 4:], surface[:, :6], surface[:, 6:12], w)

    def flat_areas(self) -> np.ndarray:
        """Areas of the flat patterns, mm2."""
        if self.corrected:
            return np.array([flat_area(one) for one in self.each])
        return self._integrals(ruling_area(self.plane[..., :4], self.plane[..., 4:]))

    def curved_areas(self) -> np.ndarray:
        """Areas of the ruled surfaces, mm2, by Gauss quadrature across."""
        ruling = self.surface[..., 3:6] - self.surface[..., :3]
        first = crossed(self.surface[..., 6:9], ruling)
        turn = crossed(self.surface[..., 9:12], ruling) - first
        a, b, c = dots(first, first), dots(first, turn), dots(turn, turn)
        width = 0.0
        for node, weight in zip(0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS, strict=True):
            width = width + weight * np.sqrt(a + 2.0 * node * b + node * node * c)
        return self._integrals(width)

    def centre_lines(self) -> tuple[np.ndarray, np.ndarray]:
        """Flat and true lengths of the lines half way between the edges, without corrections."""
        plane, slope = self.plane[..., :4], self.plane[..., 4:]
        angle = plane[..., 2].copy()
        cos, sin = np.cos(angle), np.sin(angle)
        along = cos * slope[..., 0] + sin * slope[..., 1] - 0.5 * plane[..., 3] * slope[..., 2]
        slip = cos * slope[..., 1] - sin * slope[..., 0] + 0.5 * slope[..., 3]
        tangent = 0.5 * (self.surface[..., 6:9] + self.surface[..., 9:12])
        return (
            self._integrals(np.sqrt(along**2 + slip**2)),
            self._integrals(np.sqrt(dots(tangent, tangent))),
        )

    def _integrals(self, values: np.ndarray) -> np.ndarray:
        """Integrals of values (m, nodes) at the nodes, of each."""
        breaks = [one.plane.breaks for one in self.each]
        return integrals_together(values[..., None], breaks)[:, 0]
