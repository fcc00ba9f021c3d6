# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bevels flatter than a cutting head is turned: told, as they are cut in another way."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from .. import tolerances
from ..finding import Finding, warning
from ..lofting import DevelopedPlate


def bevels_beyond(plates: Sequence[DevelopedPlate], limit: float) -> Iterator[Finding]:
    """A warning for each edge of a plate with a bevel of more than `limit`, rad, at its steepest
    place."""
    for plate in plates:
        for line in dict.fromkeys(bevel.edge for bevel in plate.bevels):
            own = [bevel for bevel in plate.bevels if bevel.edge == line]
            worst = max(own, key=lambda bevel: max(map(abs, bevel.angles)))
            angle = max(map(abs, worst.angles))
            if angle <= limit + math.radians(tolerances.WELD_FIGURE):
                continue
            place = "mm on the axis" if worst.side in ("first", "second") else "mm along it"
            yield warning(
                "bevel-beyond-head",
                plate.mark,
                f"edge {line} has a bevel that is more than the cutting head makes",
                "cut it in two passes or grind the rest, or cut it square and build the edge up by "
                "welding, or give the weld a preparation with a smaller angle",
                position=f"{worst.side} {line}, {worst.start:.0f} to {worst.end:.0f} {place}",
                value=math.degrees(angle),
                limit=math.degrees(limit),
                unit="deg",
            )
