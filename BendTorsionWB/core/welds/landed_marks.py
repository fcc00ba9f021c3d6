# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates that branches are welded to at nodes, by their marks: known once the members that run
through have their plates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..lofting import DevelopedPlate, EndPart, MemberRecord
from .diaphragm_welds import distance_to
from .weld_record import Weld


def with_landed_marks(records: Sequence[MemberRecord]) -> tuple[MemberRecord, ...]:
    """The records with marks for what is told by member and face in welds at nodes; it stays so
    where that member is not built."""
    plates: dict[tuple[str, str], list[DevelopedPlate]] = {}
    for record in records:
        for plate in record.plates:
            if plate.lines:
                plates.setdefault((record.member, plate.face), []).append(plate)
    return tuple(_marked(record, plates) for record in records)


def _marked(record: MemberRecord, plates) -> MemberRecord:
    if not any(weld.kind == "node" for weld in record.welds):
        return record
    ends: dict[tuple[str, str, str], EndPart] = {}
    for plate in record.plates:
        for part in (part for parts in plate.ends for part in parts):
            ends.setdefault((plate.mark, part.node, f"{part.member} {part.face}"), part)

    def marked(weld: Weld) -> Weld:
        own = ends.get((weld.plates[0], weld.name, weld.plates[1]))
        if weld.kind != "node" or own is None:
            return weld
        middle = own.corners.mean(axis=0)
        on = plates.get((own.member, own.face), ())
        nearest = min(on, key=lambda plate: distance_to(plate, middle), default=None)
        return replace(weld, plates=(weld.plates[0], nearest.mark)) if nearest else weld

    return replace(record, welds=tuple(marked(weld) for weld in record.welds))
