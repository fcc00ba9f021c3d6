# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points between the model and the frames of the shop: a plate's placing frame, its flat pattern,
a piece's bed."""

from __future__ import annotations

import numpy as np

from ..geometry.rigid import inverse, moved
from ..lofting import DevelopedPlate


def to_placing(plate: DevelopedPlate, xyz: np.ndarray) -> np.ndarray:
    """Model points (n, 3) in the plate's placing frame."""
    return moved(plate.placing, xyz)


def from_placing(plate: DevelopedPlate, local: np.ndarray) -> np.ndarray:
    """Placing frame points (n, 3) in the model."""
    return moved(inverse(plate.placing), local)


def pattern_to_placing(plate: DevelopedPlate, flat: np.ndarray) -> np.ndarray:
    """Pattern points (n, 2) as points (n, 3) of the placing frame's plane z = 0: the flat plate
    laid on the formed one by the same three points."""
    flat = np.atleast_2d(np.asarray(flat, float))
    return moved(plate.flat_to_placing, np.column_stack([flat, np.zeros(len(flat))]))


def placing_to_pattern(plate: DevelopedPlate, local: np.ndarray) -> np.ndarray:
    """Placing frame points (n, 3) over the pattern, (n, 2); their height is dropped."""
    return moved(inverse(plate.flat_to_placing), local)[:, :2]
