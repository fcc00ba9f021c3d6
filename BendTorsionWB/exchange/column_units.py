# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units of the results workbook's columns, shown behind their names."""

from __future__ import annotations

import re
from dataclasses import replace

from .xlsx_file import TEXT, WHOLE, Table

_UNITS = (
    (r"scale_|value$|limit$|strain_max$|normal_|[xyz]_[xyz]$", ""),
    (r".*mass$", "kg"),
    (r".*area(_error)?$", "mm²"),
    (r"twist_per_metre$", "°/m"),
    (r"angle|.*_angle_|dihedral|bevel|natural|tilt|skew|total_torsion|torsion_error_max", "°"),
    (r"stress_max|locked_in_stress", "MPa"),
    (r"moment|torque", "kNm"),
    (r"clamp_|corner_force", "kN"),
    (r"", "mm"),
)
"""Pattern of names, from their start, and unit; the first that fits holds."""

_SLOPES = {"Zones": "", "Bed": "°"}
"""Of columns `slope`: a ratio of a transition, an angle of a saddle."""


def with_units(table: Table) -> Table:
    """The table with a unit at each column of figures that has none of its own."""
    columns = []
    for column in table.columns:
        if column.format not in (TEXT, WHOLE) and not column.unit:
            unit = next(unit for names, unit in _UNITS if re.match(names, column.name))
            unit = _SLOPES.get(table.name, unit) if column.name == "slope" else unit
            column = replace(column, unit=unit)
        if column.unit:
            shown = len(column.name) + len(column.unit) + 6
            column = replace(column, width=max(column.width, shown))
        columns.append(column)
    return replace(table, columns=tuple(columns))
