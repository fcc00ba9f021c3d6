# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheet Pieces of the results workbook, and the same in report.json."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.joints.pieces import end_text
from ..core.lofting import MemberRecord
from ..core.members.piece_record import PieceFigures
from .xlsx_file import TENTH, TEXT, WHOLE, Column, Table

PIECES = (
    Column("member", TEXT, 14),
    Column("piece", WHOLE, 7),
    Column("start", TENTH, 11),
    Column("end", TENTH, 11),
    Column("start_end", TEXT, 28),
    Column("end_end", TEXT, 28),
    Column("green_start", TENTH, 12),
    Column("green_end", TENTH, 12),
    Column("gap", TENTH, 8),
    Column("parts", WHOLE, 8),
    Column("mass", TENTH, 11),
    *(Column(f"centre_{axis}", TENTH, 12) for axis in "xyz"),
)


def piece_table(records: Sequence[MemberRecord]) -> Table:
    """A row per delivery piece of every member; mm, kg."""
    rows = ((record.member, *_values(own)) for record in records for own in record.pieces)
    return Table("Pieces", PIECES, rows)


def piece_json(own: PieceFigures) -> dict:
    """A piece as plain JSON data."""
    piece, (start_end, end_end) = own.piece, _ends(own)
    return {
        "piece": piece.number,
        "start_mm": piece.start,
        "end_mm": piece.end,
        "start_end": start_end,
        "end_end": end_end,
        "green_start_mm": piece.green_start,
        "green_end_mm": piece.green_end,
        "gap_mm": piece.gap,
        "mass_kg": own.mass,
        "centre_of_gravity_mm": [float(value) for value in own.centre_of_gravity],
        "marks": list(own.marks),
    }


def _ends(own: PieceFigures) -> tuple[str, str]:
    return end_text(own.piece.start_offsets), end_text(own.piece.end_offsets)


def _values(own: PieceFigures) -> tuple:
    piece = own.piece
    return (
        piece.number,
        piece.start,
        piece.end,
        *_ends(own),
        piece.green_start,
        piece.green_end,
        piece.gap,
        len(own.marks),
        own.mass,
        *(float(value) for value in own.centre_of_gravity),
    )
