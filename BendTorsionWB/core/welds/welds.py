# SPDX-License-Identifier: LGPL-2.1-or-later
"""The welds of a member: its longitudinal seams and butt joints, with preparation and length.

A seam is named by the letters of its two faces in section order (`TL`), the seams between the
lanes of one face by its letter (`T`), a butt joint by the plates it joins (`T1/T2`), a weld at a
node by the node. A weld runs where one pair of plates meets under one row of the Edges sheet;
where no row applies the rule pack's defaults do.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..finding import BendTorsionError, Finding, error
from ..joints.pieces import LONGEST_GAP
from ..lofting import DevelopedPlate, PlateEdge
from ..sections.section import Strip
from .diaphragm_welds import diaphragm_welds, unwelded
from .edge_rows import (
    SHORTEST_WELD,
    EdgeTreatment,
    WeldDefaults,
    last_row,
    number_of,
    stretches,
)
from .node_welds import branch_welds, fillets_not_made, gaps_not_made
from .seam_corners import SeamCorner
from .skew_diaphragms import skew_findings
from .weld_checks import weld_faults
from .weld_record import Weld

SAME_PLACE = 0.01
"""mm; plates whose ends lie nearer than this along the axis meet there."""


def welds_of(
    member: str,
    plates: Sequence[DevelopedPlate],
    strips: Sequence[Strip],
    rows: Sequence[EdgeTreatment],
    defaults: WeldDefaults,
    stubs: Collection[str] = (),
    gaps: Mapping[str, tuple[np.ndarray, np.ndarray]] | None = None,
    corners: Mapping[str, SeamCorner] | None = None,
) -> tuple[tuple[Weld, ...], tuple[Finding, ...]]:
    """The welds of a member's plates, seams first then joints, those at nodes it ends on others at
    and of diaphragms and end plates, each along +s; warnings of flat parts that are not welded.

    stubs: nodes with a stub of the member. gaps: root gap of each seam along the member, which the
    weld tells whatever its row says (`root_gaps.seam_gaps`). corners: `seam_corners.seam_corners`.
    Raises BendTorsionError, by `edge k`, for preparations that do not fit their plates and rows
    that apply to nothing.
    """
    order = {strip.face: k for k, strip in enumerate(strips)}
    walls = [plate for plate in plates if plate.face in order]
    used: set[EdgeTreatment] = set()
    welds = [*_seams(walls, strips, rows, defaults, used, gaps or {})]
    welds += _joints(walls, rows, defaults, used)
    welds += branch_welds(walls, stubs, rows, defaults, used)
    flats = [plate for plate in plates if plate.face in ("diaphragm", "end")]
    welds += diaphragm_welds(flats, walls, rows, defaults, used)
    welds = [_with_leg(weld, defaults) for weld in welds]
    faces = {plate.mark: plate.face for plate in plates}
    faults = weld_faults(welds, flats, faces, rows, defaults, corners or {})
    faults += [
        _backwards(member, row, number)
        for number, row in enumerate(rows, start=1)
        if row.start >= row.end
    ]
    faults += [
        error(
            "edge-row-unused",
            member,
            f"no weld of the member is {row.where} in that range",
            "name a seam such as TL, a joint such as T1/T2, a node or a diaphragm, or joints, "
            "nodes, diaphragms, end plates for all",
            position=f"edge {number}",
        )
        for number, row in enumerate(rows, start=1)
        if row not in used and row.start < row.end
    ]
    if faults:
        raise BendTorsionError(faults)
    return tuple(welds), (
        *unwelded(flats, welds),
        *skew_findings(flats, rows, defaults),
        *fillets_not_made(welds, rows, defaults),
        *gaps_not_made(welds, rows),
    )


def _backwards(member: str, row: EdgeTreatment, number: int) -> Finding:
    return error(
        "edge-row-order",
        member,
        f"the row of {row.where} ends before it begins, or beyond the member",
        "write the smaller arc length in from, within the member",
        position=f"edge {number}",
        value=row.start,
        limit=row.end,
        unit="mm",
    )


def _with_leg(weld: Weld, defaults: WeldDefaults) -> Weld:
    """The weld with the rule pack's leg where its fillet tells none."""
    if not weld.prep.is_fillet or weld.prep.leg:
        return weld
    return replace(weld, prep=replace(weld.prep, leg=defaults.fillet_leg(weld.thickness)))


def _seams(
    walls, strips: Sequence[Strip], rows, defaults: WeldDefaults, used, gaps
) -> Iterator[Weld]:
    order = {strip.face: k for k, strip in enumerate(strips)}
    stops = {
        (strip.face, stop.face) for strip in strips for stop in strip.stops if stop is not None
    }
    by_face: dict[str, list[DevelopedPlate]] = {}
    for plate in walls:
        by_face.setdefault(plate.face, []).append(plate)
    for plate in walls:
        for edge in plate.edges:
            own, other = order[plate.face], order.get(edge.neighbour, -1)
            in_face = own == other and edge is plate.edges[1]
            if other <= own and not in_face:
                continue
            name = strips[own].letter + ("" if in_face else strips[other].letter)
            for beside in by_face[edge.neighbour]:
                if in_face and beside.edges[0].edge != edge.edge:
                    continue
                start = max(plate.s_start, beside.s_start)
                end = min(plate.s_end, beside.s_end)
                if end - start < SHORTEST_WELD:
                    continue
                cut_second = (edge.neighbour, plate.face) in stops
                pair = (beside, plate) if cut_second else (plate, beside)
                for low, high, row in stretches(rows, name, start, end, used):
                    prep = row.prep or (defaults.joint if in_face else defaults.seam)
                    if not in_face and name in gaps:
                        prep = replace(prep, gap=_told(_mean(*gaps[name], low, high)))
                    yield Weld(
                        f"{plate.member}-{name}-{plate.mark.split('-')[-1]}/"
                        f"{beside.mark.split('-')[-1]}"
                        # Told from the second stretch on: no row changes the marks before it.
                        + (f"@{math.floor(low + 0.5)}" if low > start else ""),
                        plate.member,
                        plate.piece,
                        "lane" if in_face else "seam",
                        name,
                        (pair[0].mark, pair[1].mark),
                        low,
                        high,
                        _edge_length(plate, edge, low, high),
                        (pair[0].thickness, pair[1].thickness),
                        _mean(edge.s, edge.dihedral, low, high),
                        prep,
                        row.place or "shop",
                        row.ndt or defaults.ndt_shop,
                        number_of(row, rows),
                    )


def _joints(walls, rows, defaults: WeldDefaults, used) -> Iterator[Weld]:
    for one in walls:
        for two in walls:
            beside = [tuple(edge.edge for edge in plate.edges) for plate in (one, two)]
            if one.face != two.face or beside[0] != beside[1]:
                continue
            if not _meet(one, two) or not one.lines or not two.lines:
                continue
            if any(_between(plate, one, two) for plate in walls):
                continue
            short = [mark.split("-")[-1] for mark in (one.mark, two.mark)]
            name = "/".join(short)
            field = one.piece != two.piece
            row = last_row(rows, (name, "joints"), used)
            prep = row.prep or defaults.joint
            apart = two.s_start - one.s_end
            if apart > SAME_PLACE:
                prep = replace(prep, gap=_told(apart))
            yield Weld(
                f"{one.member}-{name}",
                one.member,
                two.piece,
                "joint",
                name,
                (one.mark, two.mark),
                one.s_end,
                two.s_start,
                one.lines[-1].length_3d,
                (one.thickness, two.thickness),
                float(np.pi),
                prep,
                row.place or ("field" if field else "shop"),
                row.ndt or (defaults.ndt_field if field else defaults.ndt_shop),
                number_of(row, rows),
            )


def _meet(one: DevelopedPlate, two: DevelopedPlate) -> bool:
    """Whether `two` begins where `one` ends, or across the gap of their joint."""
    apart = two.s_start - one.s_end
    across = apart <= LONGEST_GAP and not one.ends[1] and not two.ends[0]
    return -SAME_PLACE < apart and (apart < SAME_PLACE or across)


def _between(plate: DevelopedPlate, one: DevelopedPlate, two: DevelopedPlate) -> bool:
    """Whether a plate of the face of two others lies between them, however short."""
    within = plate.s_start >= one.s_end - SAME_PLACE and plate.s_end <= two.s_start + SAME_PLACE
    return plate.face == one.face and within


def _told(gap: float) -> float:
    """A gap measured, as it is told, mm."""
    return round(float(gap), 3)


def _edge_length(plate: DevelopedPlate, edge: PlateEdge, low: float, high: float) -> float:
    """Length along an edge between two arc lengths: panels' arcs, in proportion within one."""
    arcs = [panel.arc for panel in plate.panels if panel.what == f"edge {edge.edge}"]
    along = np.concatenate([[0.0], np.cumsum(arcs)])
    return float(np.diff(np.interp([low, high], edge.s, along))[0])


def _mean(s: np.ndarray, values: np.ndarray, low: float, high: float) -> float:
    """The mean of values known at s over a stretch."""
    places = np.unique(np.concatenate([[low, high], s[(s > low) & (s < high)]]))
    at = np.interp(places, s, values)
    return float((0.5 * (at[1:] + at[:-1]) * np.diff(places)).sum() / (places[-1] - places[0]))
