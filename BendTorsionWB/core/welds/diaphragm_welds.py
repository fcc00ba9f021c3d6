# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds of diaphragms and end plates on the walls of their member.

A diaphragm has fillets on both sides of each side that meets a wall. Behind a face closed last none
can be made: its slots, wider than the diaphragm is thick, are filled on its edge. An end plate has
a fillet round the section, where it stands over the walls, or they over it, by the leg.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..finding import Finding, error, warning
from ..lofting import DevelopedPlate, WeldedSide
from .edge_rows import EdgeTreatment, WeldDefaults, last_row, number_of
from .preps import SLOT, Prep
from .skew_diaphragms import is_skew, open_groove
from .weld_record import Weld

END_FILLET = Prep("end plate", "fillet")
END_SQUARE = Prep("end plate", "square")

_REACH = 0.01
"""mm along the axis; walls that come as near to a flat part reach it."""


def diaphragm_welds(
    flats: Sequence[DevelopedPlate],
    walls: Sequence[DevelopedPlate],
    rows: Sequence[EdgeTreatment],
    defaults: WeldDefaults,
    used: set[EdgeTreatment],
) -> Iterator[Weld]:
    """The welds of each side of the flat parts that meets a wall, with legs of the rule pack over
    the thinner plate where no row tells them. rows: of a part (`D1`) or of all (`diaphragms`,
    `end plates`), those that hold go to `used`."""
    by_face: Mapping[str, list[DevelopedPlate]] = {}
    for wall in (*walls, *flats):
        by_face.setdefault(wall.face if wall.lines else wall.mark, []).append(wall)
    for flat in flats:
        name = flat.mark.split("-")[-1]
        names = (name, "end plates" if flat.face == "end" else "diaphragms")
        row = last_row(rows, names, used)
        for side in flat.welded:
            wall = _nearest(by_face.get(side.face, ()), side, flat)
            if wall is None or side.how == "open":
                continue
            thickness = flat.thickness, wall.thickness
            by_row = row.prep is not None and side.slot is None
            by_row = by_row and not (row.prep.is_fillet and is_skew(side, defaults))
            short = [plate.mark.split("-")[-1] for plate in (flat, wall)]
            yield Weld(
                f"{flat.member}-{short[0]}/{short[1]}",
                flat.member,
                flat.piece,
                "end" if side.how == "end" else "diaphragm",
                name,
                (flat.mark, wall.mark),
                flat.s_start,
                flat.s_end,
                side.length,
                thickness,
                side.dihedral,
                replace(row.prep, gap=side.gap) if by_row else _prep(side, thickness, defaults),
                row.place or "shop",
                row.ndt or defaults.ndt_shop,
                number_of(row, rows) if by_row else 0,
            )


def _prep(side: WeldedSide, thickness: tuple[float, float], defaults: WeldDefaults) -> Prep:
    leg = defaults.fillet_leg(thickness)
    if side.how == "end":
        return replace(END_FILLET, leg=leg) if side.room >= leg else END_SQUARE
    if side.slot:
        return Prep("slot {:g}x{:g}".format(*side.slot), SLOT, gap=side.gap)
    if is_skew(side, defaults):
        return open_groove(side, thickness[0])
    # In whole mm where a wall stands askew, so that a slight twist makes no other kind of weld.
    gap = side.gap if side.dihedral == 0.5 * math.pi else float(round(side.gap))
    return replace(defaults.diaphragm, leg=leg, gap=gap)


def groove_of_flat(weld: Weld) -> Finding:
    """The error of a groove at a diaphragm or end plate, which is cut square."""
    return error(
        "prep-flat",
        weld.member,
        f"diaphragms and end plates are cut square: preparation {weld.prep.name} asks for a groove",
        "use fillet, double-fillet or square",
        position=f"edge {weld.row}",
        value=weld.prep.type,
    )


def unwelded(flats: Sequence[DevelopedPlate], welds: Sequence[Weld]) -> Iterator[Finding]:
    """Warnings of flat parts that stand too far from a wall for a weld, and of end plates that
    leave no room for a fillet."""
    for flat in flats:
        far = [side for side in flat.welded if side.how == "open"]
        if far:
            yield warning(
                "diaphragm-not-welded",
                flat.mark,
                f"the gap to {', '.join(side.face for side in far)} is too wide for a weld: none "
                "is in the weld list",
                "give a smaller gap, or leave it if the plate is not to be welded there",
                value=max(side.gap for side in far),
                unit="mm",
            )
        bare = [w for w in welds if w.plates[0] == flat.mark and w.prep == END_SQUARE]
        if bare:
            yield warning(
                "end-plate-weld",
                flat.mark,
                "the end plate leaves no room for a fillet beside the walls: its welds are "
                "listed as square, without a size",
                "give it an overhang of the leg, such as gap -20, or say the weld on the drawing",
                value=max(side.room for side in flat.welded),
                unit="mm",
            )


def _nearest(
    walls: Sequence[DevelopedPlate], side: WeldedSide, flat: DevelopedPlate
) -> DevelopedPlate | None:
    """The plate of a face whose outer edges come nearest to the middle of a side, of those that
    reach its place along the member."""
    low, high = flat.s_start - _REACH, flat.s_end + _REACH
    own = [wall for wall in walls if wall.s_start <= high and wall.s_end >= low]
    return min(own, key=lambda wall: distance_to(wall, side.middle), default=None)


def distance_to(wall: DevelopedPlate, point: np.ndarray) -> float:
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
