# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds of diaphragms on walls that stand askew to them: no fillets, but the groove that the square
edge leaves open, and warnings.

On the sharp side a fillet has no root, on the wide one its throat is too small (AWS D1.1, skewed
T-joints: fillets from 60 to 135 degrees). The square edge itself is open to the wall by 90 degrees
less the dihedral there: a bevel groove that needs no cut, welded from the wide side alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from .. import tolerances
from ..finding import Finding, warning
from ..lofting import DevelopedPlate, WeldedSide
from ..plates.diaphragm_part import WELDED_GAP
from .edge_rows import WeldDefaults
from .preps import WHOLE_ANGLE, Prep


def is_skew(side: WeldedSide, defaults: WeldDefaults) -> bool:
    """Whether a side stands too sharp to its wall for fillets."""
    return side.dihedral < defaults.fillet_least_angle - math.radians(tolerances.WELD_FIGURE)


def open_groove(side: WeldedSide, thickness: float) -> Prep:
    """The groove a square edge of a plate of this thickness, mm, leaves: its angle in whole
    degrees, its gap that at the root."""
    opening = 0.5 * math.pi - side.dihedral
    root = max(side.gap - thickness * math.tan(opening), 0.0)
    angle = WHOLE_ANGLE * math.floor(opening / WHOLE_ANGLE + 1e-6)
    return Prep("skew", "bevel", angle, gap=round(root, 1))


def skew_findings(flats: Sequence[DevelopedPlate], defaults: WeldDefaults) -> Iterator[Finding]:
    """A warning for each diaphragm with sides too sharp to their walls for fillets, and for each
    whose square edge leaves fillets too wide a gap."""
    for flat in flats:
        walls = [side for side in flat.welded if side.how == "walls"]
        skew = [side for side in walls if is_skew(side, defaults)]
        wide = [
            side
            for side in walls
            if side not in skew and side.gap > WELDED_GAP + tolerances.WELD_FIGURE
        ]
        if skew:
            least = min(skew, key=lambda side: side.dihedral)
            cut = 90.0 - math.degrees(least.dihedral)
            yield warning(
                "diaphragm-skew",
                flat.mark,
                f"the diaphragm stands too sharp to {_faces(skew)} for fillets: its square edge "
                f"leaves {least.gap:.0f} mm at the wide face, and is listed as a groove of "
                f"{math.floor(cut + 1e-6)} degrees welded from that side",
                f"weld it from the wide side before the box is closed, or bevel the edge by "
                f"{cut:.0f} degrees and back it, or set the diaphragms of the node to flanges",
                value=math.degrees(least.dihedral),
                limit=math.degrees(defaults.fillet_least_angle),
                unit="deg",
            )
        if wide:
            most = max(wide, key=lambda side: side.gap)
            yield warning(
                "diaphragm-gap",
                flat.mark,
                f"the square edge of the diaphragm leaves fillets on {_faces(wide)} too wide a "
                "gap, as the wall is askew to it",
                f"bevel the edge by {90.0 - math.degrees(most.dihedral):.0f} degrees when it is "
                "fitted, or make the fillets larger by the gap",
                value=most.gap,
                limit=WELDED_GAP,
                unit="mm",
            )


def _faces(sides: Sequence[WeldedSide]) -> str:
    return " and ".join(dict.fromkeys(side.face for side in sides))
