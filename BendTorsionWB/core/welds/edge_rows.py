# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of the Edges sheet and the rule pack's defaults: what tells how a weld is made, and which of
them holds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .preps import Prep

SHORTEST_WELD = 1.0
"""mm; stretches shorter than this, where two plates' ends all but coincide, are no weld."""


@dataclass(frozen=True)
class EdgeTreatment:
    """One row of the Edges sheet: a seam, a joint or `joints` (all of them), a node the member ends
    on another at or `nodes`, a diaphragm (`D1`) or `diaphragms`, `end plates`, between two arc
    lengths (mm; with the ratio flag a part of the axis length), with preparation, place (`shop`,
    `field`) and test; None and empty for the defaults."""

    where: str
    start: float = 0.0
    end: float = np.inf
    prep: Prep | None = None
    place: str = ""
    ndt: str = ""
    start_is_ratio: bool = False
    end_is_ratio: bool = False

    def on(self, length: float) -> EdgeTreatment:
        """The row with its places in mm of an axis of this length."""
        start = self.start * length if self.start_is_ratio else self.start
        end = self.end * length if self.end_is_ratio else self.end
        return replace(
            self, start=start, end=min(end, length), start_is_ratio=False, end_is_ratio=False
        )


@dataclass(frozen=True)
class WeldDefaults:
    """Preparations of seams and joints that no row names, of branches at nodes and of diaphragms
    there, the leg of their fillets over the thinner plate, the step (rad) bevel angles are cut in,
    the largest leg over the thinner plate, the widest root gap, mm and over the thinner plate, the
    least dihedral of fillets on both sides, rad, the largest bevel a cutting head makes, rad, and
    the least clear size of a box that is welded from inside, mm, by the rule pack."""

    seam: Prep = Prep("corner", "bevel", np.radians(45.0), 6.0, 0.0)
    joint: Prep = Prep("butt", "v", np.radians(60.0), 2.0, 2.0)
    ndt_shop: str = ""
    ndt_field: str = ""
    bevel_step: float = np.radians(1.0)
    branch: Prep = Prep("branch", "bevel", np.radians(45.0), 2.0)
    diaphragm: Prep = Prep("diaphragm", "double-fillet")
    leg: float = 0.7
    widest_leg: float = 1.2
    widest_gap: float = 20.0
    gap_over_thickness: float = 2.0
    fillet_least_angle: float = np.radians(60.0)
    largest_bevel: float = np.radians(52.0)
    access: float = 400.0

    def fillet_leg(self, thickness: Sequence[float]) -> float:
        """Leg, mm, of a fillet between plates of these thicknesses, mm."""
        return float(math.ceil(self.leg * min(thickness) - 1e-9))


NO_ROW = EdgeTreatment("")
"""What holds where no row does: tells nothing."""


def last_row(
    rows: Sequence[EdgeTreatment], names: Sequence[str], used: set[EdgeTreatment]
) -> EdgeTreatment:
    """The row that holds for what has these names, the last of them, or NO_ROW; all of them go to
    `used`."""
    own = [row for row in rows if row.where in names]
    used.update(own)
    return own[-1] if own else NO_ROW


def stretches(
    rows: Sequence[EdgeTreatment], name: str, start: float, end: float, used: set[EdgeTreatment]
) -> list[tuple[float, float, EdgeTreatment]]:
    """The stretch from start to end, mm, cut where rows of a seam begin and end, each with the row
    that holds, the last of them, or NO_ROW; all of them go to `used`."""
    own = [row for row in rows if row.where == name and row.start < end and row.end > start]
    used.update(own)
    places = sorted({start, end, *(min(max(p, start), end) for r in own for p in (r.start, r.end))})
    out = []
    for low, high in zip(places[:-1], places[1:], strict=True):
        if high - low < SHORTEST_WELD:
            continue
        middle = 0.5 * (low + high)
        row = next((r for r in reversed(own) if r.start <= middle <= r.end), NO_ROW)
        out.append((low, high, row))
    return out


def number_of(row: EdgeTreatment, rows: Sequence[EdgeTreatment]) -> int:
    """The number of the row that prepares a weld, from 1; 0 where the rule pack does."""
    if row.prep is None:
        return 0
    return next(k for k, own in enumerate(rows, start=1) if own is row)
