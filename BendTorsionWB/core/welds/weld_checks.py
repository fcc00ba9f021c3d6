# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a weld cannot be made as where it is: grooves at corners, fillets without room, gaps."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from .. import tolerances
from ..finding import Finding, error
from ..lofting import DevelopedPlate
from ..plates.diaphragm_part import WELDED_GAP
from .diaphragm_welds import groove_of_flat
from .edge_rows import EdgeTreatment, WeldDefaults
from .fillet_angle import WIDEST_FILLET, unfit_fillet
from .preps import prep_findings
from .seam_corners import SeamCorner
from .weld_record import Weld


def weld_faults(
    welds: Sequence[Weld],
    flats: Sequence[DevelopedPlate],
    faces: Mapping[str, str],
    rows: Sequence[EdgeTreatment],
    defaults: WeldDefaults,
    corners: Mapping[str, SeamCorner],
) -> list[Finding]:
    """Errors of welds that cannot be made, one of a kind for each row, by `edge k`. flats:
    diaphragms and end plates; faces: of plates by their marks; corners: of the seams by their
    names."""
    rooms = {(flat.mark, side.face): side.room for flat in flats for side in flat.welded}
    faults: dict[tuple, Finding] = {}
    for weld in welds:
        where = f"edge {weld.row}" if weld.row else ""
        own = [*prep_findings(weld.prep, weld.cut_thickness, weld.member, where)]
        if weld.kind in ("diaphragm", "end") and weld.prep.is_cut and weld.row:
            own.append(groove_of_flat(weld))
        if weld.row:
            room = rooms.get((weld.plates[0], faces.get(weld.plates[1], "")), 0.0)
            own += _groove_faults(weld, where, corners)
            own += _fillet_faults(weld, where, corners, defaults, room)
        own += _gap_faults(weld, where, rows, defaults)
        for finding in own:
            faults.setdefault((finding.code, weld.row or weld.prep), finding)
    return list(faults.values())


def _groove_faults(weld: Weld, where: str, corners) -> Iterator[Finding]:
    """A v where one plate alone ends: it would be cut off half the angle, or the other plate where
    nothing meets it."""
    if weld.prep.type not in ("v", "double-v") or weld.kind not in ("seam", "node"):
        return
    corner = corners.get(weld.name)
    if weld.kind == "seam" and (corner is None or corner.mitred):
        return
    bevel = weld.prep.type.replace("v", "bevel")
    yield error(
        "prep-corner",
        weld.member,
        f"at {weld.name} plate {weld.plates[0]} alone ends at the weld: a {weld.prep.type} would "
        f"be cut into {weld.plates[1]} too, where nothing meets it",
        f"use {bevel} with the whole angle of the groove; v and double-v are for butt joints, "
        "lanes and mitres",
        position=where,
        value=weld.prep.type,
        limit=bevel,
    )


def _fillet_faults(weld: Weld, where: str, corners, defaults, room: float) -> Iterator[Finding]:
    prep = weld.prep
    if not prep.is_fillet:
        return
    if weld.kind in ("joint", "lane", "seam") and weld.dihedral > WIDEST_FILLET:
        yield error(
            "fillet-angle",
            weld.member,
            f"the plates at {weld.name} lie too nearly in one plane for a fillet",
            "use bevel, v or square",
            position=where,
            value=math.degrees(weld.dihedral),
            limit=math.degrees(WIDEST_FILLET),
            unit="degrees",
        )
        return
    sharp = unfit_fillet(prep, weld.dihedral, defaults) if weld.kind == "seam" else None
    if sharp is not None:
        wide = sharp > defaults.fillet_least_angle
        yield error(
            "fillet-angle",
            weld.member,
            f"the plates at {weld.name} stand too {'wide' if wide else 'sharp'} to each other "
            "there for a fillet",
            "use bevel or square, or a fillet on the other side",
            position=where,
            value=math.degrees(sharp),
            limit=math.degrees(WIDEST_FILLET if wide else defaults.fillet_least_angle),
            unit="degrees",
        )
        return
    limit = defaults.widest_leg * min(weld.thickness)
    if prep.leg > limit + tolerances.WELD_FIGURE:
        yield error(
            "fillet-leg",
            weld.member,
            f"the fillet of {weld.name} is too big for the thinner plate",
            "give a smaller leg, or a groove",
            position=where,
            value=prep.leg,
            limit=limit,
            unit="mm",
        )
    sides = ("outer", "inner") if prep.type == "double-fillet" else (prep.side,)
    if weld.kind == "seam" and weld.name in corners:
        corner = corners[weld.name]
        ledge = min(corner.least(side, weld.start, weld.end) for side in sides)
    elif weld.kind == "end":
        ledge = room
    else:
        return
    if ledge < prep.leg - tolerances.WELD_FIGURE:
        yield error(
            "fillet-ledge",
            weld.member,
            f"plate {weld.plates[1]} does not stand far enough over {weld.plates[0]} for the "
            f"fillet of {weld.name}",
            "use bevel or square, side inner, a smaller leg, or a section whose plate stands out",
            position=where,
            value=ledge,
            limit=prep.leg,
            unit="mm",
        )


def _gap_faults(weld: Weld, where: str, rows, defaults) -> Iterator[Finding]:
    if weld.kind not in ("seam", "joint", "lane"):
        return
    row = rows[weld.row - 1].prep if weld.row else None
    # The gap of a joint between delivery pieces is that of sheet Pieces, not of its row.
    gap = weld.prep.gap if weld.kind == "seam" else row.gap if row else 0.0
    limit = min(defaults.widest_gap, defaults.gap_over_thickness * min(weld.thickness))
    if weld.prep.is_fillet:
        limit = min(limit, WELDED_GAP)
    if gap <= limit + tolerances.WELD_FIGURE:
        return
    yield error(
        "root-gap-too-wide",
        weld.member,
        f"the root gap of {weld.name} is too wide to be welded",
        "give a smaller gap",
        position=where,
        value=gap,
        limit=limit,
        unit="mm",
    )
