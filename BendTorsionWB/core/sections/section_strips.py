# SPDX-License-Identifier: LGPL-2.1-or-later
"""A section from a free list of strips, as a table gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import BendTorsionError, Finding, error
from .section import STEEL, Material, Section, Stop, Strip, size_findings
from .section_checks import centred, refuse, unknown

SIDES = {"left": (1, 0.0), "right": (-1, 0.0), "middle": (1, 0.5)}


@dataclass(frozen=True)
class StripRow:
    """A row of a free strip list: a plate from (y1, z1) to (y2, z2), mm.

    side: where the plate lies from its line, walking it seen along -x: `left`, `right`, or
    `middle`. stop1, stop2: what its ends stop at: `face`, on the side the strip comes from, or
    `face inner`, `face outer`, `face mitre`, each with a gap as `face 3`; empty to end square.
    """

    face: str
    letter: str
    y1: float
    z1: float
    y2: float
    z2: float
    t: float
    side: str = "middle"
    stop1: str = ""
    stop2: str = ""


def strip_list(name: str, rows: Sequence[StripRow], material: Material = STEEL) -> Section:
    """A section from a table of strips; ends at the same place share a corner. Raises
    BendTorsionError naming the row for what makes no section."""
    findings: list[Finding] = []
    faces = [row.face for row in rows]
    letters = [row.letter for row in rows]
    points: list[tuple[float, float]] = []
    strips = []
    for number, row in enumerate(rows, start=1):
        place = f"strip {number}"
        if row.side not in SIDES:
            findings.append(replace(unknown(name, "side", row.side, SIDES), position=place))
        if not row.face or faces.count(row.face) > 1 or letters.count(row.letter) > 1:
            findings.append(
                error(
                    "strip-name",
                    name,
                    "two strips have the same face or letter, or one has none",
                    "give each strip its own",
                    position=place,
                    value=f"{row.face} {row.letter}",
                )
            )
        stops = []
        for text, far in ((row.stop1, (row.y2, row.z2)), (row.stop2, (row.y1, row.z1))):
            try:
                stops.append(_stop(text, [other for other in rows if other is not row], far))
            except ValueError as problem:
                findings.append(
                    error(
                        "strip-stop",
                        name,
                        str(problem),
                        "write a face of the list, then outer or mitre if not its inner face, then "
                        "a gap in mm",
                        position=place,
                        value=text,
                    )
                )
        ends = []
        for end in ((float(row.y1), float(row.z1)), (float(row.y2), float(row.z2))):
            if end not in points:
                points.append(end)
            ends.append(points.index(end))
        if row.side in SIDES and len(stops) == 2:
            inward, line = SIDES[row.side]
            strips.append(
                Strip(row.face, row.letter, *ends, row.t, inward, ("first", "second"), *stops, line)
            )
    if findings or not strips:
        raise BendTorsionError(
            findings
            or error("section-strips", name, "the section has no strips", "add a row per plate")
        )
    refuse(size_findings(name, **{f"t of {row.face}": row.t for row in rows}))
    names = tuple(f"C{k + 1}" for k in range(len(points)))
    return centred(name, "strips", np.array(points), names, strips, material, False)


def _stop(text: str, rows: Sequence[StripRow], far: tuple[float, float]) -> Stop | None:
    words = text.split()
    if not words:
        return None
    other = next((row for row in rows if row.face == words[0]), None)
    if other is None:
        raise ValueError(f"there is no other strip {words[0]!r} to stop at")
    if len(words) > 1 and words[1] in ("inner", "outer", "mitre"):
        at, rest = words[1], words[2:]
    else:
        y, z, dy, dz = other.y1, other.z1, other.y2 - other.y1, other.z2 - other.z1
        left = dy * (far[1] - z) - dz * (far[0] - y) > 0
        at = "inner" if left == (SIDES.get(other.side, (1,))[0] > 0) else "outer"
        rest = words[1:]
    try:
        gap = float(rest[0]) if rest else 0.0
    except ValueError:
        raise ValueError(f"{rest[0]!r} is no gap") from None
    return Stop(words[0], gap, at)
