# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds at nodes: of a branch's plates on the member that runs through, of diaphragms inside it.

The groove of a branch plate is that of the rule pack where the plate meets the face at more than
75 degrees on the outside, and half of that angle where it meets it at less (AWS D1.1, prequalified
complete penetration T-, Y- and K-connections, details B and C). Where the plate leans over so far
that its groove is open without being cut back, it is cut square behind the land.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..lofting import DevelopedPlate, EndPart, WeldedSide
from .preps import Prep
from .weld_record import Weld

SHARP = math.radians(75.0)
"""Outer dihedral below which the groove is half of it."""

_WHOLE = math.radians(1.0)
"""rad; groove angles are told in steps of this."""


def groove(prep: Prep, part: EndPart) -> Prep:
    """The preparation of a plate's end on a face, with the node's root gap."""
    outer = 0.5 * math.pi + float(part.bevel.min()), 0.5 * math.pi + float(part.bevel.max())
    angle = prep.angle
    if prep.is_cut and outer[0] < SHARP:
        angle = min(angle, _WHOLE * math.floor(0.5 * outer[0] / _WHOLE + 1e-6))
    elif prep.is_cut:
        angle = max(angle, _WHOLE * math.ceil((outer[1] - 0.5 * math.pi) / _WHOLE - 1e-6))
    return replace(prep, angle=angle, gap=part.gap)


def branch_welds(
    plates: Sequence[DevelopedPlate], stubs: Collection[str], rows, defaults, used: set
) -> Iterator[Weld]:
    """The welds of plates that end on other members at nodes, plate by plate; of a stub in the
    shop, of a direct branch in the field. The second plate is told by member and face. rows:
    `welds.EdgeTreatment`s, those that hold go to `used`; defaults: `welds.WeldDefaults`. stubs:
    nodes with a stub of the member."""
    for plate in plates:
        for parts in plate.ends:
            for part in parts:
                if not part.node:
                    continue
                short = plate.mark.split("-")[-1]
                alike = [p for own in plate.ends for p in own if p.node == part.node]
                more = f".{part.member}.{part.face}" if len(alike) > 1 else ""
                row = next((r for r in reversed(rows) if r.where in (part.node, "nodes")), None)
                if row is not None:
                    used.add(row)
                place = "shop" if part.node in stubs else "field"
                place = row.place if row and row.place else place
                ndt = defaults.ndt_field if place == "field" else defaults.ndt_shop
                prep = groove(defaults.branch, part)
                if row and row.prep:
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
                    row.ndt if row and row.ndt else ndt,
                )


def diaphragm_welds(
    flats: Sequence[DevelopedPlate], walls: Sequence[DevelopedPlate], defaults
) -> Iterator[Weld]:
    """Fillet welds on both sides of each side of a diaphragm that meets a wall."""
    by_face: Mapping[str, list[DevelopedPlate]] = {}
    for wall in (*walls, *flats):
        by_face.setdefault(wall.face if wall.lines else wall.mark, []).append(wall)
    for flat in flats:
        for side in flat.welded:
            wall = _nearest(by_face.get(side.face, ()), side, flat)
            if wall is None:
                continue
            thin = min(flat.thickness, wall.thickness)
            prep = replace(defaults.diaphragm, leg=math.ceil(defaults.leg * thin - 1e-9))
            short = [plate.mark.split("-")[-1] for plate in (flat, wall)]
            yield Weld(
                f"{flat.member}-{short[0]}/{short[1]}",
                flat.member,
                flat.piece,
                "diaphragm",
                flat.mark.split("-")[-1],
                (flat.mark, wall.mark),
                flat.s_start,
                flat.s_end,
                side.length,
                (flat.thickness, wall.thickness),
                0.5 * math.pi,
                prep,
                "shop",
                defaults.ndt_shop,
            )


def _nearest(
    walls: Sequence[DevelopedPlate], side: WeldedSide, flat: DevelopedPlate
) -> DevelopedPlate | None:
    """The plate of a face whose outer edges come nearest to the middle of a side, of those that
    reach its place along the member."""
    own = [wall for wall in walls if wall.s_start <= flat.s_end and wall.s_end >= flat.s_start]
    return min(own, key=lambda wall: _distance(wall, side.middle), default=None)


def _distance(wall: DevelopedPlate, point: np.ndarray) -> float:
    """Distance of a point from the measuring lines of a plate, from their ends at least."""
    ends: dict[str, list[np.ndarray]] = {}
    for place in wall.points:
        if place.kind == "arris":
            ends.setdefault(place.line, []).append(place.xyz)
    least = math.inf
    for one, two in (pair for pair in ends.values() if len(pair) == 2):
        across = two - one
        part = ((point - one) * across).sum() / (across * across).sum()
        foot = one + min(max(float(part), 0.0), 1.0) * across
        least = min(least, float(np.sqrt(((point - foot) ** 2).sum())))
    return least
