# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds at nodes: of a branch's plates on the member that runs through.

The groove of a branch plate is that of the rule pack where the plate meets the face at more than
75 degrees on the outside, and half of that angle where it meets it at less (AWS D1.1, prequalified
complete penetration T-, Y- and K-connections, details B and C). Where the plate leans over so far
that its groove is open without being cut back, it is cut square behind the land.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..finding import Finding, warning
from ..lofting import DevelopedPlate, EndPart
from ..plates.plates import SAME_GAP
from .edge_rows import EdgeTreatment, WeldDefaults, last_row, number_of
from .fillet_angle import WIDEST_FILLET, unfit_fillet
from .preps import WHOLE_ANGLE, Prep
from .weld_record import Weld

SHARP = math.radians(75.0)
"""Outer dihedral below which the groove is half of it."""

_ROUNDED = math.radians(0.1)
"""rad; angles are rounded to this before they are stepped, so that ends which are the same but for
the last digits or a slight twist have the same groove."""


def groove(prep: Prep, part: EndPart) -> Prep:
    """The preparation of a plate's end on a face, with the node's root gap."""
    outer = [
        _ROUNDED * round((0.5 * math.pi + float(bevel)) / _ROUNDED)
        for bevel in (part.bevel.min(), part.bevel.max())
    ]
    angle = prep.angle
    if prep.is_cut and outer[0] < SHARP - 0.5 * _ROUNDED:
        angle = min(angle, WHOLE_ANGLE * math.floor(0.5 * outer[0] / WHOLE_ANGLE + 1e-6))
    elif prep.is_cut:
        opening = outer[1] - 0.5 * math.pi
        angle = max(angle, WHOLE_ANGLE * math.ceil(opening / WHOLE_ANGLE - 1e-6))
    return replace(prep, angle=angle, gap=part.gap)


def branch_welds(
    plates: Sequence[DevelopedPlate],
    stubs: Collection[str],
    rows: Sequence[EdgeTreatment],
    defaults: WeldDefaults,
    used: set[EdgeTreatment],
) -> Iterator[Weld]:
    """The welds of plates that end on other members at nodes, plate by plate; of a stub in the
    shop, of a direct branch in the field. The second plate is told by member and face. rows:
    those that hold go to `used`. stubs: nodes with a stub of the member."""
    for plate in plates:
        for parts in plate.ends:
            for part in parts:
                if not part.node:
                    continue
                short = plate.mark.split("-")[-1]
                alike = [p for own in plate.ends for p in own if p.node == part.node]
                more = f".{part.member}.{part.face}" if len(alike) > 1 else ""
                row = last_row(rows, (part.node, "nodes"), used)
                place = row.place or ("shop" if part.node in stubs else "field")
                ndt = defaults.ndt_field if place == "field" else defaults.ndt_shop
                prep = groove(defaults.branch, part)
                dihedral = float(np.mean(part.dihedral))
                by_row = row.prep and unfit_fillet(row.prep, dihedral, defaults) is None
                if by_row:
                    prep = replace(row.prep, gap=part.gap)
                yield Weld(
                    f"{plate.member}-{part.node}-{short}{more}",
                    plate.member,
                    plate.piece,
                    "node",
                    part.node,
                    (plate.mark, f"{part.member} {part.face}"),
                    float(part.s.min()),
                    float(part.s.max()),
                    part.length,
                    (plate.thickness, part.thickness),
                    dihedral,
                    prep,
                    place,
                    row.ndt or ndt,
                    number_of(row, rows) if by_row else 0,
                )


def gaps_not_made(welds: Sequence[Weld], rows: Sequence[EdgeTreatment]) -> Iterator[Finding]:
    """A warning for each row and node whose preparation has another root gap than the node."""
    told = set()
    for weld in welds:
        row = last_row(rows, (weld.name, "nodes"), set())
        if weld.kind != "node" or row.prep is None or row.prep.gap <= 0.0:
            continue
        number = number_of(row, rows)
        if abs(row.prep.gap - weld.prep.gap) <= SAME_GAP or (number, weld.name) in told:
            continue
        told.add((number, weld.name))
        yield warning(
            "node-root-gap",
            weld.member,
            f"the root gap at {weld.name} is the node's, {weld.prep.gap:g} mm: that of the "
            f"preparation, {row.prep.gap:g} mm, does not hold",
            f"write {row.prep.gap:g} in gap of the node in sheet Nodes, or no gap or "
            f"{weld.prep.gap:g} in the preparation",
            position=f"edge {number}",
            value=row.prep.gap,
            limit=weld.prep.gap,
            unit="mm",
        )


def fillets_not_made(
    welds: Sequence[Weld], rows: Sequence[EdgeTreatment], defaults: WeldDefaults
) -> Iterator[Finding]:
    """A warning for each row and node with ends too sharp or too wide to what they land on for the
    fillets it asks for, which have the rule pack's groove instead."""
    found: dict[tuple[int, str], list[tuple[float, Weld]]] = {}
    for weld in welds:
        row = last_row(rows, (weld.name, "nodes"), set())
        if weld.kind == "node" and not weld.row and row.prep:
            angle = unfit_fillet(row.prep, weld.dihedral, defaults)
            found.setdefault((number_of(row, rows), weld.name), []).append((angle, weld))
    for (number, node), own in found.items():
        least = min(angle for angle, _ in own)
        wide = least >= defaults.fillet_least_angle
        marks = ", ".join(weld.mark for _, weld in own)
        yield warning(
            "node-fillet",
            own[0][1].member,
            f"plates at {node} stand too {'wide' if wide else 'sharp'} to what they land on for "
            f"fillets: {marks} {'has' if len(own) == 1 else 'have'} the rule pack's groove",
            "leave it so, or give the row a bevel for all plates at the node",
            position=f"edge {number}",
            value=math.degrees(least),
            limit=math.degrees(WIDEST_FILLET if wide else defaults.fillet_least_angle),
            unit="deg",
        )
