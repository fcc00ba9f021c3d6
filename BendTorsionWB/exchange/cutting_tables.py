# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cutting list: parts by thickness and grade, as sheets of the workbook and as nesting.csv."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..core.lofting import DevelopedPlate, MemberRecord
from .csv_folder import csv_bytes
from .report import dxf_name
from .xlsx_file import TENTH, TEXT, WHOLE, Column, Table

ROLLING = "u"
"""Rolling direction of the stock: along the plate, the pattern's u."""

CUTTING = (
    Column("part", TEXT, 14),
    Column("thickness", TENTH, 10),
    Column("material", TEXT, 12),
    Column("quantity", WHOLE, 9),
    Column("length", TENTH, 12),
    Column("width", TENTH, 12),
    *(
        Column(f"{kind}_{what}", TENTH, 13)
        for kind in ("net", "gross")
        for what in ("area", "mass")
    ),
    Column("rolling_direction", TEXT, 10),
    Column("opposite_hand", TEXT, 14),
    Column("marks", TEXT, 40),
    Column("dxf", TEXT, 22),
    *(Column(f"stock_{what}", TENTH, 13) for what in ("length", "width")),
)
TOTALS = (
    Column("thickness", TENTH, 10),
    Column("material", TEXT, 12),
    Column("parts", WHOLE, 8),
    Column("plates", WHOLE, 8),
    *(
        Column(f"{kind}_{what}", TENTH, 13)
        for kind in ("net", "gross")
        for what in ("area", "mass")
    ),
)


def cutting_tables(records: Sequence[MemberRecord]) -> tuple[Table, ...]:
    """Sheet Cutting, a row per part, areas and masses of one; and CuttingTotals, of all plates of
    one thickness and grade. Lengths and widths are gross; mm, mm2, kg."""
    parts = _parts(records)
    return (
        Table("Cutting", CUTTING, (_row(part) for part in parts)),
        Table("CuttingTotals", TOTALS, _totals(parts)),
    )


def nesting_csv(records: Sequence[MemberRecord]) -> bytes:
    """The list nesting programs take: part, thickness, grade, quantity, DXF and rolling direction
    of each part, its gross size and mass, and the marks it is. UTF-8 with a byte order mark, so
    that spreadsheets read any script."""
    parts = _parts(records)
    stocked = any(plates[0].stock for plates in parts)
    rows = [NESTING + NESTING_STOCK if stocked else NESTING]
    for plates in parts:
        one = plates[0]
        gross = one.gross or one
        stock = [f"{size:g}" for size in one.stock or ()] or ["", ""]
        rows.append(
            (
                one.part,
                f"{one.thickness:g}",
                one.material,
                len(plates),
                dxf_name(one.mark),
                ROLLING,
                f"{gross.length:.1f}",
                f"{gross.width:.1f}",
                f"{gross.mass:.2f}",
                " ".join(plate.mark for plate in plates),
                *(stock if stocked else ()),
            )
        )
    return csv_bytes(rows)


NESTING = ("part", "thickness", "material", "quantity", "dxf", "rolling_direction")
NESTING += ("length", "width", "mass", "marks")
"""Headings of the nesting list; mm, kg of one."""
NESTING_STOCK = ("stock_length", "stock_width")
"""More of them where the schedule gives stock."""


def _parts(records: Sequence[MemberRecord]) -> list[list[DevelopedPlate]]:
    """Plates by part, thick ones first, then by grade and in order."""
    groups: dict[str, list[DevelopedPlate]] = {}
    for record in records:
        for plate in record.plates:
            groups.setdefault(plate.part, []).append(plate)
    return sorted(groups.values(), key=lambda own: (-own[0].thickness, own[0].material))


def _figures(plate: DevelopedPlate) -> tuple[float, float, float, float]:
    gross = plate.gross or plate
    return plate.area, plate.mass, gross.area, gross.mass


def _row(plates: list[DevelopedPlate]) -> tuple:
    one = plates[0]
    gross = one.gross or one
    return (
        one.part,
        one.thickness,
        one.material,
        len(plates),
        gross.length,
        gross.width,
        *_figures(one),
        ROLLING,
        one.opposite_hand,
        " ".join(plate.mark for plate in plates),
        dxf_name(one.mark),
        *(one.stock or (None, None)),
    )


def _totals(parts: Sequence[list[DevelopedPlate]]) -> Iterator[tuple]:
    groups: dict[tuple[float, str], list[list[DevelopedPlate]]] = {}
    for plates in parts:
        groups.setdefault((plates[0].thickness, plates[0].material), []).append(plates)
    for (thickness, material), own in groups.items():
        sums = [0.0] * 4
        for plates in own:
            for plate in plates:
                sums = [a + b for a, b in zip(sums, _figures(plate), strict=True)]
        yield (thickness, material, len(own), sum(map(len, own)), *sums)
