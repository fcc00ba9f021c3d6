# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheet Control of the results workbook: what surveyors compare, with room to write."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..core.beds.control_points import control_rows
from ..core.lofting import MemberRecord
from ..core.site import AT_ORIGIN, SiteDatum
from .xlsx_file import FINE, TENTH, TEXT, Column, Table


def _columns(frame: str, width: float = 11, format: str = TENTH, unit="") -> list[Column]:
    return [Column(f"{frame}{axis}", format, width, unit) for axis in "xyz"]


def control_table(records: Sequence[MemberRecord], site: SiteDatum = AT_ORIGIN) -> Table:
    """Points of all pieces: model, site (in the site's unit), on the bed as designed and as set up
    before welding; the measured columns are empty."""
    columns = (
        Column("piece", TEXT, 12),
        Column("line", TEXT, 8),
        Column("corner", TEXT, 8),
        Column("s", TENTH, 11),
        *_columns(""),
        *_columns("site_", 13, TENTH if site.unit == "mm" else FINE, site.unit),
        *_columns("bed_"),
        *_columns("fabrication_", 13),
        *_columns("normal_", 11, FINE),
        *_columns("measured_", 13),
    )
    return Table("Control", columns, _rows(records, site))


def _rows(records: Sequence[MemberRecord], site: SiteDatum) -> Iterator[tuple]:
    for record in records:
        for row in control_rows(record):
            yield (
                row.piece,
                row.line,
                row.corner,
                row.s,
                *row.xyz.tolist(),
                *site.of(row.xyz).tolist(),
                *row.bed.tolist(),
                *row.fabrication.tolist(),
                *([None] * 3 if row.normal is None else row.normal.tolist()),
                *[None] * 3,
            )
