# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheet Zones of the results workbook, and the same in report.json."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.lofting import MemberRecord, ZoneRecord
from ..core.sections.section import BOX_FACES
from .xlsx_file import TENTH, TEXT, Column, Table

ZONES = (
    Column("member", TEXT, 14),
    Column("zone", TEXT, 7),
    Column("group", TEXT, 7),
    Column("start", TENTH, 11),
    Column("end", TENTH, 11),
    Column("length", TENTH, 11),
    Column("slope", TENTH, 8),
    *(Column(f"d_{face}", TENTH, 9) for face in BOX_FACES),
)


def zone_table(records: Sequence[MemberRecord]) -> Table:
    """A row per zone of every member; mm."""
    return Table(
        "Zones", ZONES, (_row(record.member, zone) for record in records for zone in record.zones)
    )


def zone_json(zone: ZoneRecord) -> dict:
    """A zone as plain JSON data."""
    steps = zone.steps or (None,) * 4
    return {
        "zone": zone.label,
        "group": zone.group,
        "start_mm": zone.start,
        "end_mm": zone.end,
        "slope": zone.slope,
        **{f"d_{face}_mm": step for face, step in zip(BOX_FACES, steps, strict=True)},
    }


def _row(member: str, zone: ZoneRecord) -> tuple:
    return (
        member,
        zone.label,
        zone.group,
        zone.start,
        zone.end,
        zone.length,
        zone.slope,
        *(zone.steps or (None,) * 4),
    )
