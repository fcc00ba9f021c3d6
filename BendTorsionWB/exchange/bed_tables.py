# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Bed, Pins and BedFrames of the results workbook."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..core.beds.bed_record import Bed
from .xlsx_file import FINE, TENTH, TEXT, WHOLE, Column, Table

BED = (
    Column("piece", TEXT, 12),
    Column("face", TEXT, 8),
    Column("saddle", TEXT, 8),
    *(Column(name, TENTH, 11) for name in ("s", "left_x", "left_y", "left_height")),
    *(Column(name, TENTH, 11) for name in ("right_x", "right_y", "right_height")),
    Column("slope", FINE, 10),
    Column("stop", TEXT, 7),
    *(Column(name, TENTH, 11) for name in ("stop_x", "stop_y", "stop_height")),
)
PINS = (
    Column("piece", TEXT, 12),
    Column("column", WHOLE, 8),
    Column("row", WHOLE, 8),
    *(Column(name, TENTH, 11) for name in ("x", "y", "height")),
    Column("tilt", FINE, 10),
)
BED_FRAMES = (
    Column("piece", TEXT, 12),
    Column("frame", TEXT, 14),
    *(Column(f"{axis}{k}", FINE, 14) for axis in "xyz" for k in ("_x", "_y", "_z", "_shift")),
)


def bed_tables(beds: Sequence[Bed]) -> tuple[Table, ...]:
    """Saddles, pins and the frames both ways; mm and degrees."""
    return (
        Table("Bed", BED, ((bed.name, *row) for bed in beds for row in _saddles(bed))),
        Table(
            "Pins",
            PINS,
            (
                (bed.name, pin.column, pin.row, pin.x, pin.y, pin.height, math.degrees(pin.tilt))
                for bed in beds
                for pin in bed.pins
            ),
        ),
        Table(
            "BedFrames",
            BED_FRAMES,
            (
                (bed.name, name, *frame[:3].ravel().tolist())
                for bed in beds
                for name, frame in (("model to bed", bed.to_bed), ("bed to model", bed.to_model))
            ),
        ),
    )


def _saddles(bed: Bed):
    for one in bed.saddles:
        yield (
            bed.face,
            one.label,
            one.s,
            *one.left.place.tolist(),
            *one.right.place.tolist(),
            math.degrees(one.slope),
            one.stop_side,
            *one.stop.tolist(),
        )
