# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds at nodes: of a branch's plates on the member that runs through.

The groove of a branch plate is that of the rule pack where the plate meets the face at more than
75 degrees on the outside, and half of that angle where it meets it at less (AWS D1.1, prequalified
complete penetration T-, Y- and K-connections, details B and C). Where the plate leans over so far
that its groove is open without being cut back, it is cut square behind the land.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..lofting import DevelopedPlate, EndPart
from .edge_rows import EdgeTreatment, WeldDefaults, last_row, number_of
from .preps import WHOLE_ANGLE, Prep
from .weld_record import Weld

SHARP = math.radians(75.0)
"""Outer dihedral below which the groove is half of it."""

_ROUNDED = math.radians(0.1)
"""rad; angles are rounded to this before they are stepped, so that ends which are the same but for
the last digits or a slight twist have the same groove."""


def groove(prep: Prep, part: EndPart) -> Prep:
    """The preparation of a plate's end on a face, with the node's root gap."""
    outer = [
        _ROUNDED * round((0.5 * math.pi + float(bevel)) / _ROUNDED)
        for bevel in (part.bevel.min(), part.bevel.max())
    ]
    angle = prep.angle
    if prep.is_cut and outer[0] < SHARP - 0.5 * _ROUNDED:
        angle = min(angle, WHOLE_ANGLE * math.floor(0.5 * outer[0] / WHOLE_ANGLE + 1e-6))
    elif prep.is_cut:
        opening = outer[1] - 0.5 * math.pi
        angle = max(angle, WHOLE_ANGLE * math.ceil(opening / WHOLE_ANGLE - 1e-6))
    return replace(prep, angle=angle, gap=part.gap)


def branch_welds(
    plates: Sequence[DevelopedPlate],
    stubs: Collection[str],
    rows: Sequence[EdgeTreatment],
    defaults: WeldDefaults,
    used: set[EdgeTreatment],
) -> Iterator[Weld]:
    """The welds of plates that end on other members at nodes, plate by plate; of a stub in the
    shop, of a direct branch in the field. The second plate is told by member and face. rows:
    those that hold go to `used`. stubs: nodes with a stub of the member."""
    for plate in plates:
        for parts in plate.ends:
            for part in parts:
                if not part.node:
                    continue
                short = plate.mark.split("-")[-1]
                alike = [p for own in plate.ends for p in own if p.node == part.node]
                more = f".{part.member}.{part.face}" if len(alike) > 1 else ""
                row = last_row(rows, (part.node, "nodes"), used)
                place = row.place or ("shop" if part.node in stubs else "field")
                ndt = defaults.ndt_field if place == "field" else defaults.ndt_shop
                prep = groove(defaults.branch, part)
                if row.prep:
                    prep = replace(row.prep, gap=part.gap)
                yield Weld(
                    f"{plate.member}-{part.node}-{short}{more}",
                    plate.member,
                    plate.piece,
                    "node",
                    part.node,
                    (plate.mark, f"{part.member} {part.face}"),
                    float(part.s.min()),
                    float(part.s.max()),
                    part.length,
                    (plate.thickness, part.thickness),
                    float(np.mean(part.dihedral)),
                    prep,
                    place,
                    row.ndt or ndt,
                    number_of(row, rows),
                )
