# SPDX-License-Identifier: LGPL-2.1-or-later
"""Angles between plates that a fillet holds in, from the rule's least to WIDEST_FILLET.

In a sharper corner it has no root, in a wider one too small a throat (AWS D1.1, skewed T-joints:
fillets from 60 to 135 degrees).
"""

from __future__ import annotations

import math

from .. import tolerances
from .edge_rows import WeldDefaults
from .preps import Prep

WIDEST_FILLET = math.radians(135.0)
"""Angle between the plates above which no fillet holds (AWS D1.1 clause 4, skewed T-joints)."""


def unfit_fillet(prep: Prep, dihedral: float, defaults: WeldDefaults) -> float | None:
    """The angle, rad, of a side of a plate on which the fillet asked for does not hold, None where
    it holds on all. dihedral: rad, between the plates on the inner side; on the outer side there is
    what is left of 180 degrees."""
    if not prep.is_fillet:
        return None
    sides = ("outer", "inner") if prep.type == "double-fillet" else (prep.side,)
    angles = [math.pi - dihedral if side == "outer" else dihedral for side in sides]
    slack = math.radians(tolerances.WELD_FIGURE)
    low, high = defaults.fillet_least_angle - slack, WIDEST_FILLET + slack
    return next((angle for angle in sorted(angles) if not low <= angle <= high), None)
