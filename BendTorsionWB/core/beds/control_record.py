# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a control section: what a cut across a delivery piece shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class CutPlate:
    """A plate in a section: ring (4, 2) in (y, z) of the section plane, its outer face first."""

    mark: str
    face: str
    thickness: float
    ring: np.ndarray


@dataclass(frozen=True, eq=False)
class ControlSection:
    """The section of a piece at s: the plates in (y, z), the axis at (0, 0). label: `E-1` and
    `E-2` at the piece's ends, `F` and its number at folds, `M` at mid-length."""

    piece: int
    label: str
    s: float
    plates: tuple[CutPlate, ...]

    @property
    def reach(self) -> tuple[float, float, float, float]:
        """How far the section reaches from the axis: left (+y), right, up (+z), down."""
        points = np.concatenate([plate.ring for plate in self.plates])
        (y_low, z_low), (y_high, z_high) = points.min(axis=0), points.max(axis=0)
        return float(y_high), -float(y_low), float(z_high), -float(z_low)
