# SPDX-License-Identifier: LGPL-2.1-or-later
"""The zones of a member as a table, with the paper's groups and the steps of the faces."""

from __future__ import annotations

from itertools import groupby

from .. import tolerances
from ..lofting import ZoneRecord
from .cells import Cell, FaceSteps, SectionLaw


def zone_records(law: SectionLaw) -> tuple[ZoneRecord, ...]:
    """The zones along the axis; a zone in which a thickness changes is one, one that runs through
    the seam of a closed axis is two."""
    runs = [list(cells) for _, cells in groupby(law.cells, key=lambda cell: cell.label)]
    lengths: dict[str, float] = {}
    for cell in law.cells:
        lengths[cell.label] = lengths.get(cell.label, 0.0) + cell.end - cell.start
    return tuple(_record(law, cells, lengths) for cells in runs)


def group_of(label: str) -> str:
    """The paper's group of a zone: B1 = {d-1}, A_k = {b-k, d-(k+1)}."""
    kind, number = label.split("-")
    if kind == "b":
        return f"A{number}"
    return "B1" if number == "1" else f"A{int(number) - 1}"


def _record(law: SectionLaw, cells: list[Cell], lengths: dict[str, float]) -> ZoneRecord:
    label, start, end = cells[0].label, cells[0].start, cells[-1].end
    kind, number = label.split("-")
    # The steps of a cut stand with its transition, or with the segment that begins with a step.
    cut = int(number) - (kind == "d")
    slope = steps = None
    if cut and (kind == "b" or f"b-{cut}" not in lengths):
        own: FaceSteps = law.face_steps[cut - 1]
        if kind == "b" or own.largest > tolerances.FACES_FLUSH:
            steps = own.top, own.bottom, own.left, own.right
        if kind == "b":
            slope = lengths[label] / own.largest
    return ZoneRecord(label, group_of(label), start, end, slope, steps)
