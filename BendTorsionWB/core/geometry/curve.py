# SPDX-License-Identifier: LGPL-2.1-or-later
"""A NURBS curve in space, evaluated in numpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline


@dataclass(frozen=True, eq=False)
class Curve:
    """A NURBS curve: flat knot vector, poles (n, 3) in mm, weights (n,) or None for all one.

    knots has n + degree + 1 entries (Piegl & Tiller 1997, ch. 3-4); the curve runs over
    knots[degree] … knots[-degree - 1].
    """

    degree: int
    knots: np.ndarray
    poles: np.ndarray
    weights: np.ndarray | None = None

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return float(self.knots[self.degree]), float(self.knots[-self.degree - 1])

    @property
    def breaks(self) -> np.ndarray:
        """The distinct knots inside the domain, ends included."""
        first, last = self.domain
        inner = self.knots[(self.knots > first) & (self.knots < last)]
        return np.unique(np.concatenate([[first], inner, [last]]))

    def evaluate(self, u: np.ndarray, order: int = 0) -> list[np.ndarray]:
        """Position and derivatives up to `order` (0 to 2) at parameters u (m,): list of (m, 3)."""
        u = np.asarray(u, float)
        poles = self.poles
        if self.weights is not None:
            poles = np.column_stack([poles * self.weights[:, None], self.weights])
        spline = BSpline(self.knots, poles, self.degree)
        # Its derivative as a spline fails where there are as many knots as the degree; the spline
        # itself gives it there, but must not be asked beyond the degree.
        parts = [
            spline(u, k) if k <= self.degree else np.zeros((len(u), poles.shape[1]))
            for k in range(order + 1)
        ]
        if self.weights is None:
            return parts
        weight = parts[0][:, 3:]
        out = [parts[0][:, :3] / weight]
        if order >= 1:
            out.append((parts[1][:, :3] - parts[1][:, 3:] * out[0]) / weight)
        if order >= 2:
            out.append(
                (parts[2][:, :3] - 2 * parts[1][:, 3:] * out[1] - parts[2][:, 3:] * out[0]) / weight
            )
        return out
