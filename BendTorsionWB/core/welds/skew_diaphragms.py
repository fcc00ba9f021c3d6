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
from .edge_rows import EdgeTreatment, WeldDefaults, last_row, number_of
from .preps import WHOLE_ANGLE, Prep


def is_skew(side: WeldedSide, defaults: WeldDefaults) -> bool:
    """Whether a side stands too sharp to its wall for fillets."""
    return side.dihedral < defaults.fillet_least_angle - math.radians(tolerances.WELD_FIGURE)


def open_groove(side: WeldedSide, thickness: float) -> Prep:
    """The groove a square edge of a plate of this thickness, mm, leaves: its angle in whole
    degrees, its gap that at the root, its side the face it opens to."""
    opening = 0.5 * math.pi - side.dihedral
    root = max(side.gap - thickness * math.tan(opening), 0.0)
    angle = WHOLE_ANGLE * math.floor(opening / WHOLE_ANGLE + 1e-6)
    # A flat part is marked on its outer face.
    open_to = "inner" if side.opens == "down" else "outer"
    return Prep("skew", "bevel", angle, gap=round(root, 1), side=open_to)


def skew_findings(
    flats: Sequence[DevelopedPlate], rows: Sequence[EdgeTreatment], defaults: WeldDefaults
) -> Iterator[Finding]:
    """A warning for each diaphragm with sides too sharp to their walls for fillets, of the row of
    sheet Edges that asks for them there; and for each whose square edge leaves fillets too wide a
    gap."""
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
            row = last_row(rows, (flat.mark.split("-")[-1], "diaphragms"), set())
            number = number_of(row, rows) if row.prep and row.prep.is_fillet else 0
            asked = f"; the {row.prep.type} its row asks for is not made there" if number else ""
            yield warning(
                "diaphragm-skew",
                flat.mark,
                f"the diaphragm stands too sharp to {_opened(skew)} for fillets: its square edge "
                f"leaves {least.gap:.0f} mm there, and is listed as a groove of "
                f"{math.floor(cut + 1e-6)} degrees welded from that side{asked}",
                f"weld it from the wide side before the box is closed, or bevel the edge by "
                f"{cut:.0f} degrees and back it, or set the diaphragms of the node to flanges",
                position=f"edge {number}" if number else "",
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


def _opened(sides: Sequence[WeldedSide]) -> str:
    """Sides with the face each opens to: `right (open at the marked face)`."""
    told = {
        side.face: "open at the other face" if side.opens == "down" else "open at the marked face"
        for side in sides
    }
    return " and ".join(f"{face} ({where})" for face, where in told.items())


def _faces(sides: Sequence[WeldedSide]) -> str:
    return " and ".join(dict.fromkeys(side.face for side in sides))
