# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Bevels and Bars of the results workbook."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..core.lofting import MemberRecord
from ..core.welds.backing import backing_bars
from .xlsx_file import TENTH, TEXT, WHOLE, Column, Table

BEVELS = (
    Column("plate", TEXT, 14),
    Column("side", TEXT, 8),
    Column("edge", TEXT, 10),
    Column("from", TENTH, 11),
    Column("to", TENTH, 11),
    *(
        Column(name, TENTH, 13)
        for name in ("angle_outer", "depth_outer", "angle_inner", "depth_inner", "land", "natural")
    ),
    *(Column(name, TENTH, 15) for name in ("chamfer_slope", "chamfer_length", "chamfer_depth")),
    Column("chamfer_face", TEXT, 13),
    Column("angle_opening", TENTH, 13),
    Column("opening_face", TEXT, 13),
    Column("prep", TEXT, 14),
    Column("weld", TEXT, 24),
)
BARS = (
    Column("member", TEXT, 14),
    Column("bar", TEXT, 14),
    Column("piece", WHOLE, 7),
    Column("section", TEXT, 10),
    *(Column(name, TENTH, 11) for name in ("width", "thickness", "length")),
    Column("material", TEXT, 12),
    Column("mass", TENTH, 10),
    Column("weld", TEXT, 24),
)


def bevel_tables(records: Sequence[MemberRecord]) -> tuple[Table, ...]:
    """Every stretch of an edge with its bevel, and the backing bars; mm, degrees, kg."""
    plates = [plate for record in records for plate in record.plates]
    return (
        Table("Bevels", BEVELS, (_bevel(plate, own) for plate in plates for own in plate.bevels)),
        Table("Bars", BARS, (_bar(bar) for record in records for bar in backing_bars(record))),
    )


def _bevel(plate, bevel) -> tuple:
    (outer, outer_depth), (inner, inner_depth) = bevel.outer, bevel.inner
    chamfer = bevel.chamfer
    return (
        plate.mark,
        bevel.side,
        bevel.edge,
        bevel.start,
        bevel.end,
        math.degrees(outer) if outer_depth else None,
        outer_depth or None,
        math.degrees(inner) if inner_depth else None,
        inner_depth or None,
        bevel.land(plate.thickness),
        math.degrees(bevel.natural),
        *(
            (chamfer.slope, chamfer.length, chamfer.depth, chamfer.faces)
            if chamfer
            else (None,) * 4
        ),
        math.degrees(bevel.opening[0]) if bevel.opening[1] else None,
        bevel.opening[1],
        bevel.prep,
        bevel.weld,
    )


def _bar(bar) -> tuple:
    section = f"{bar.width:g}x{bar.thickness:g}"
    sizes = bar.width, bar.thickness, bar.length
    return bar.member, bar.mark, bar.piece, section, *sizes, bar.material, bar.mass, bar.weld
