# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the results workbook on patterns: gross figures, errors by kind, edges."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.lofting import DevelopedPlate
from ..core.patterns.gross import as_cut
from .xlsx_file import FINE, STRAIN, TENTH, TEXT, Column

GROSS = (
    Column("gross_length", TENTH, 12),
    Column("gross_width", TENTH, 12),
    Column("gross_area", TENTH, 13),
    Column("gross_mass", TENTH, 11),
    Column("scale_u", STRAIN, 9),
    Column("scale_v", STRAIN, 9),
    Column("green_start", TENTH, 11),
    Column("green_end", TENTH, 10),
    Column("edge_error", FINE, 11),
    Column("line_error", FINE, 11),
    Column("diagonal_error", FINE, 14),
    Column("centre_line_error", FINE, 17),
    Column("area_error", TENTH, 11),
    Column("seam_mismatch", FINE, 14),
    Column("length_error_bound", FINE, 18),
    Column("locked_in_stress", TENTH, 16),
)
"""Columns of the Plates sheet: gross figures and flattening errors."""

EDGES = (
    Column("plate", TEXT, 12),
    Column("edge", TEXT, 8),
    Column("line", TEXT, 8),
    Column("s", TENTH, 11),
    Column("neighbour", TEXT, 10),
    Column("dihedral", FINE, 10),
    Column("bevel", FINE, 10),
    Column("offset_outer", FINE, 12),
    Column("offset_inner", FINE, 12),
    Column("widest", TEXT, 8),
)


def gross_cells(plate: DevelopedPlate) -> tuple:
    """The cells of a plate under GROSS."""
    cut, gross, errors = as_cut(plate), plate.gross, plate.errors
    factors = (1.0, 1.0, 0.0, 0.0)
    if gross is not None:
        factors = gross.scale_u, gross.scale_v, gross.green_start, gross.green_end
    found = (None,) * 6
    if errors is not None:
        found = (
            errors.edge,
            errors.line,
            errors.diagonal,
            errors.centre_line,
            errors.area,
            errors.seam,
        )
    return (
        *(cut.length, cut.width, cut.area, cut.mass),
        *factors,
        *found,
        plate.length_error_bound,
        plate.locked_in_stress,
    )


def edge_rows(plate: DevelopedPlate) -> Iterator[tuple]:
    """A row per line of both edges; angles in degrees."""
    for edge in plate.edges:
        for k, line in enumerate(edge.lines):
            dihedral = float(edge.dihedral[k])
            yield (
                plate.mark,
                edge.edge,
                line,
                float(edge.s[k]),
                edge.neighbour,
                None if math.isnan(dihedral) else math.degrees(dihedral),
                math.degrees(edge.bevel[k]),
                float(edge.offset_outer[k]),
                float(edge.offset_inner[k]),
                edge.widest(k),
            )
