# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a schedule wants the plates of a member laid flat: its own cells, else the settings."""

from __future__ import annotations

from BendTorsionWB.core.patterns.gross import Allowances
from BendTorsionWB.core.patterns.laid_flat import PatternInput
from BendTorsionWB.exchange.schedule_columns import PATTERN_COLUMNS


def pattern_input(row, settings) -> PatternInput:
    """Of the row of a member's first segment, by column, and the schedule's settings."""
    names = [column.name for column in PATTERN_COLUMNS]
    own = {name: row[name] for name in names if row[name] is not None}
    values = {name: own.get(name, getattr(settings, name)) for name in names}
    return PatternInput(
        values["mode"],
        values["flattened_surface"],
        values["marking_face"],
        Allowances(
            values["shrinkage_along"],
            values["shrinkage_across"],
            values["joint_allowance"],
            values["diaphragm_allowance"],
            values["green_start"],
            values["green_end"],
            values["splice"],
        ),
        values["contour"],
    )


def check_split(record, report) -> None:
    """A row of sheet Splits gives joints, lanes or both."""
    if record["joints"] is None and record["lanes"] is None and not record.bad & _SPLIT:
        report(
            record,
            "joints",
            "value-missing",
            "a split without joints and lanes",
            "fill in joints, lanes or both, or delete the row",
        )


_SPLIT = {"joints", "lanes"}
