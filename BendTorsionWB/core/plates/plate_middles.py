# SPDX-License-Identifier: LGPL-2.1-or-later
"""The middle of a plate's outer face, where its mark is shown, without laying it flat."""

from __future__ import annotations

import numpy as np

from ..geometry.vectors import crossed, lengths
from .flat_plate import FlatPlate
from .plates import Plate

NEAR_THE_MIDDLE = 0.01
"""Part of the plate's length over which its direction is taken."""


def middle(plate: Plate | FlatPlate) -> tuple[np.ndarray, np.ndarray]:
    """A place (3,) and the outward direction there (3,), as long as the plate is wide, mm; of a
    flat part its centre of gravity and its axis."""
    if isinstance(plate, FlatPlate):
        return plate.centre_of_gravity, np.asarray(plate.frame)[:3, 2].copy()
    step = NEAR_THE_MIDDLE * (plate.end - plate.start)
    half = 0.5 * (plate.start + plate.end)
    rails = np.asarray(plate.rails.outer(np.array([half - step, half, half + step])))
    first, second = rails[:, :3], rails[:, 3:]
    centres, across = 0.5 * (first + second), second[1] - first[1]
    square = crossed(centres[2] - centres[0], across)
    outward = -plate.inward * square / lengths(square)
    return centres[1], lengths(across) * outward
