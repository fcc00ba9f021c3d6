# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Joints and Welds of the results workbook."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ..core.lofting import MemberRecord
from ..core.welds.preps import prep_text
from ..core.welds.weld_record import Weld
from .figures import degrees
from .xlsx_file import FINE, TENTH, TEXT, WHOLE, Column, Table

JOINTS = (
    Column("member", TEXT, 14),
    Column("joint", TEXT, 14),
    Column("face", TEXT, 10),
    Column("s", TENTH, 11),
    Column("plate_1", TEXT, 14),
    Column("plate_2", TEXT, 14),
    *(Column(name, TENTH, 12) for name in ("thickness_1", "thickness_2", "length")),
    Column("place", TEXT, 8),
    Column("weld", TEXT, 20),
)
WELDS = (
    Column("member", TEXT, 14),
    Column("weld", TEXT, 22),
    Column("piece", WHOLE, 7),
    Column("kind", TEXT, 8),
    Column("seam", TEXT, 10),
    Column("plate_1", TEXT, 14),
    Column("plate_2", TEXT, 14),
    *(Column(name, TENTH, 12) for name in ("from", "to", "length", "thickness_1", "thickness_2")),
    Column("dihedral", FINE, 10),
    Column("prep", TEXT, 14),
    Column("type", TEXT, 13),
    *(Column(name, TENTH, 10) for name in ("angle", "land", "gap", "depth", "leg")),
    Column("side", TEXT, 8),
    Column("backing", TEXT, 10),
    Column("place", TEXT, 8),
    Column("ndt", TEXT, 14),
)


def weld_tables(records: Sequence[MemberRecord]) -> tuple[Table, ...]:
    """Butt joints, and all welds with their preparation; mm and degrees."""
    faces = {plate.mark: plate.face for record in records for plate in record.plates}
    welds = [weld for record in records for weld in record.welds]
    return (
        Table("Joints", JOINTS, (_joint(w, faces) for w in welds if w.kind == "joint")),
        Table("Welds", WELDS, _welds(welds)),
    )


def weld_json(weld: Weld) -> dict:
    """A weld as plain JSON data."""
    return {
        "weld": weld.mark,
        "kind": weld.kind,
        "plates": list(weld.plates),
        "from_mm": weld.start,
        "to_mm": weld.end,
        "length_mm": weld.length,
        "dihedral_deg": degrees(weld.dihedral),
        "prep": prep_text(weld.prep),
        "place": weld.place,
        "ndt": weld.ndt,
    }


def _joint(weld: Weld, faces: dict[str, str]) -> tuple:
    return (
        weld.member,
        weld.name,
        faces.get(weld.plates[0], ""),
        weld.start,
        *weld.plates,
        *weld.thickness,
        weld.length,
        weld.place,
        weld.mark,
    )


def _welds(welds: Sequence[Weld]) -> Iterator[tuple]:
    for weld in welds:
        prep = weld.prep
        yield (
            weld.member,
            weld.mark,
            weld.piece,
            weld.kind,
            weld.name,
            *weld.plates,
            weld.start,
            weld.end,
            weld.length,
            *weld.thickness,
            math.degrees(weld.dihedral),
            prep.name,
            prep.type,
            math.degrees(prep.angle),
            prep.land,
            prep.gap,
            prep.depth(weld.cut_thickness),
            prep.leg or None,
            prep.side,
            "{:g}x{:g}".format(*prep.backing) if prep.backing else "",
            weld.place,
            weld.ndt,
        )
