# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Preps and Edges: preparations read, and what is wrong with one on any plate."""

from __future__ import annotations

import math

from ..core.finding import BendTorsionError
from ..core.welds.preps import Prep, own_findings, prep_of
from .schedule_workbook import Place, Record

_COLUMN = {"prep-angle": "angle", "prep-backing": "backing"}
"""Column of sheet Preps a finding is about."""


def prep_of_row(row: Record) -> Prep:
    """The preparation of a row of sheet Preps."""
    angle = math.radians(row["angle"])
    sizes = (row[name] for name in ("land", "gap", "side", "backing", "leg"))
    return Prep(row["prep"], row["type"], angle, *sizes)


def check_preps(records: dict[str, list[Record] | None], faults: list) -> None:
    """Appends what is wrong with every row of Preps, used or not, and with preparations named in
    Edges, which are a row of Preps or words that say what they are."""
    rows = records["Preps"] or []
    for row in rows:
        if not row.bad:
            faults += _own(row.place, prep_of_row(row))
    known = {row["prep"] for row in rows}
    for row in records["Edges"] or []:
        given = row["prep"]
        if not given or given in known:
            continue
        try:
            faults += _own(row.place, prep_of(given), "prep")
        except BendTorsionError as problem:
            finding = row.place.error(
                "prep",
                "unknown-name",
                f"{given!r} is no preparation of sheet Preps: {problem.findings[0].message}",
                "name a row of Preps, or write such as bevel angle=40 land=6 gap=2",
                value=given,
            )
            faults.append((row.place, finding))


def _own(place: Place, prep: Prep, column: str = "") -> list[tuple]:
    return [
        (
            place,
            place.error(
                column or _COLUMN[found.code],
                found.code,
                found.message,
                found.mend,
                value=found.value,
                limit=found.limit,
                unit=found.unit,
            ),
        )
        for found in own_findings(prep, "")
    ]
