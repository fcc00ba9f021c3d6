# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Forming and FormingLines of the results workbook."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ..core.lofting import DevelopedPlate
from ..core.patterns.forming_record import FormingRecord
from .xlsx_file import FINE, STRAIN, TENTH, TEXT, Column, Table

FORMING = (
    Column("plate", TEXT, 12),
    Column("forming", TEXT, 9),
    Column("rule", TEXT, 22),
    Column("value", FINE, 12),
    Column("limit", FINE, 12),
    Column("unit", TEXT, 7),
    Column("advice", TEXT, 44),
    Column("bending_radius_min", TENTH, 19),
    Column("twist_per_metre", FINE, 16),
    Column("flat_deviation", FINE, 14),
    Column("flat_tolerance", FINE, 14),
    Column("may_stay_flat", TEXT, 13),
    Column("strain_max", STRAIN, 11),
    Column("strain_u", TENTH, 10),
    Column("strain_v", TENTH, 10),
    Column("locked_in_stress", TENTH, 16),
    Column("stress_max", TENTH, 11),
    Column("stress_u", TENTH, 10),
    Column("stress_v", TENTH, 10),
    Column("moment", FINE, 10),
    Column("torque", FINE, 10),
    Column("corner_force", FINE, 13),
    Column("clamp_middle", FINE, 13),
    Column("clamp_corner", FINE, 13),
)

FORMING_LINES = (
    Column("plate", TEXT, 12),
    Column("line", TEXT, 8),
    Column("kind", TEXT, 7),
    *(Column(name, TENTH, 10) for name in ("s", "u_first", "v_first", "u_second", "v_second")),
    *(Column(f"radius_{place}", TENTH, 14) for place in ("first", "middle", "second")),
    Column("skew", FINE, 10),
    Column("angle", FINE, 10),
    Column("direction", TEXT, 10),
)


def forming_tables(plates: Sequence[DevelopedPlate]) -> tuple[Table, Table]:
    """One row per plate, and one per roll and fold line; mm, degrees, MPa, kN, kNm, degrees/m."""
    known = [(plate.mark, plate.forming_data) for plate in plates if plate.forming_data is not None]
    return (
        Table("Forming", FORMING, (_row(mark, data) for mark, data in known)),
        Table(
            "FormingLines",
            FORMING_LINES,
            (row for mark, data in known for row in _line_rows(mark, data)),
        ),
    )


def _row(mark: str, data: FormingRecord) -> tuple:
    kind, down = data.forming_class, data.pull_down
    return (
        mark,
        kind.name,
        kind.rule,
        kind.value,
        kind.limit,
        kind.unit,
        data.advice,
        data.bending_radius_min,
        math.degrees(1e3 * data.twist_max),
        data.flat_deviation,
        data.flat_tolerance,
        "yes" if data.may_stay_flat else "no",
        data.strain.value,
        *data.strain.flat.tolist(),
        data.locked_in_stress,
        data.stress.value,
        *data.stress.flat.tolist(),
        down.moment,
        down.torque,
        down.corner_force,
        down.clamp_middle,
        down.clamp_corner,
    )


def _line_rows(mark: str, data: FormingRecord) -> Iterator[tuple]:
    for roll in data.roll_lines:
        yield (
            mark,
            roll.label,
            "roll",
            roll.s,
            *roll.flat.ravel().tolist(),
            *roll.radius.tolist(),
            math.degrees(roll.skew),
            None,
            None,
        )
    for fold in data.fold_lines:
        yield (
            mark,
            fold.label,
            "fold",
            fold.s,
            *fold.flat.ravel().tolist(),
            *(None,) * 4,
            math.degrees(fold.angle),
            fold.direction,
        )
