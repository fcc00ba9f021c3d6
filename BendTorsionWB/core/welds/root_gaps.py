# SPDX-License-Identifier: LGPL-2.1-or-later
"""Root gaps: one figure for each seam and joint, which the plates, the weld list and the drawings
follow.

The gap of a seam is what the section leaves between the two plates (`gap1`, `gap2`, gaps of
stops). Where the section tells none, the gap of the preparation is taken off the plate that stops
at the other, over the whole seam, since its edge is one cut. Both may tell it, alike.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..members.cells import Cell, SectionLaw
from ..members.member import Member
from ..plates.plates import SAME_GAP
from ..sections.section import Section
from ..sections.section_checks import checked
from ..sections.strip_lines import section_polygons
from .edge_rows import EdgeTreatment, number_of, stretches
from .seam_corners import SeamEnds, seam_ends


def seam_gaps(law: SectionLaw) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Root gap, mm, of each seam at arc lengths along the member: (s (n,), gap (n,))."""
    places, gaps = [], []
    for cell in law.cells:
        at = np.linspace(cell.start, cell.end, 2 if cell.gap_bends is None else 9)
        d = (at - cell.start)[:, None, None]
        own = cell.gaps + d * cell.gap_rates
        if cell.gap_bends is not None:
            own = own + d * d * (cell.gap_bends[0] + d * cell.gap_bends[1])
        places.append(at)
        gaps.append(own)
    s, gap = np.concatenate(places), np.concatenate(gaps)
    return {
        seam.name: (s, sum(gap[:, strip, edge] for strip, edge in seam.edges))
        for seam in seam_ends(law.strips)
    }


def joint_gaps(rows: Sequence[EdgeTreatment]) -> tuple[tuple[str, float, str], ...]:
    """Joint (`T1/T2`, `joints` of all), root gap mm and `edge k` of the rows about joints, in
    their order; none where no gap is told."""
    found = [
        (row.where, row.prep.gap if row.prep else 0.0, f"edge {number}")
        for number, row in enumerate(rows, start=1)
        if row.where == "joints" or "/" in row.where
    ]
    return tuple(found) if any(gap for _, gap, _ in found) else ()


def with_root_gaps(
    member: Member, rows: Sequence[EdgeTreatment]
) -> tuple[Member, tuple[Finding, ...]]:
    """The member with the gaps its rows ask for where its sections tell none, and warnings of rows
    that ask for more than they name. Raises BendTorsionError, by `edge k`, for gaps that
    contradict each other or the section, and where they leave nothing of a plate."""
    told = [row.on(member.length) for row in rows]
    errors: list[Finding] = []
    warnings: list[Finding] = []
    wanted: dict[tuple[int, int], float] = {}
    askers: dict[int, int] = {}
    for seam in seam_ends(member.law.strips):
        held = [row for *_, row in stretches(told, seam.name, 0.0, member.length, set())]
        asked = [(number_of(row, told), row.prep.gap) for row in held if _asks(row)]
        if not asked:
            continue
        number, gap = asked[0]
        other = next((own for own in asked if abs(own[1] - gap) > SAME_GAP), None)
        if other is not None:
            errors.append(_two_rows(member.name, seam.name, number, gap, *other))
            continue
        clash = _of_sections(member.law.sections, seam, gap)
        if clash is not None:
            errors.append(_against_section(member.name, seam.name, number, gap, *clash))
            continue
        if len(asked) < len(held):
            warnings.append(_beyond_row(member.name, seam.name, number, gap))
        wanted |= {end: s * gap for end, s in zip(seam.edges, seam.shares, strict=True)}
        askers |= {strip: number for strip, _ in seam.edges}
    letters = {strip.letter for strip in member.law.strips}
    for number, row in enumerate(told, start=1):
        if _asks(row) and row.where in letters:
            warnings.append(_between_lanes(member.name, row.where, number, row.prep.gap))
    if errors:
        raise BendTorsionError(errors)
    if not wanted:
        return member, tuple(warnings)
    sections = tuple(_with_gaps(section, wanted) for section in member.law.sections)
    _check_room(member.name, sections, askers)
    cells = tuple(_cell_with_gaps(cell, wanted) for cell in member.law.cells)
    return replace(member, law=replace(member.law, sections=sections, cells=cells)), tuple(warnings)


def _asks(row: EdgeTreatment) -> bool:
    return row.prep is not None and row.prep.gap > 0.0


def _of_sections(
    sections: Sequence[Section], seam: SeamEnds, gap: float
) -> tuple[str, float] | None:
    """The first section that tells another gap for a seam, and that gap."""
    for section in sections:
        stops = [section.strips[strip].stops[edge] for strip, edge in seam.edges]
        own = sum(stop.gap for stop in stops if stop is not None)
        if own > 0.0 and abs(own - gap) > SAME_GAP:
            return section.name, own
    return None


def _with_gaps(section: Section, wanted: Mapping[tuple[int, int], float]) -> Section:
    strips = []
    for k, strip in enumerate(section.strips):
        stops = [
            stop._replace(gap=wanted[k, edge]) if stop and (k, edge) in wanted else stop
            for edge, stop in enumerate(strip.stops)
        ]
        strips.append(replace(strip, stops_at_first=stops[0], stops_at_second=stops[1]))
    return replace(section, strips=tuple(strips))


def _cell_with_gaps(cell: Cell, wanted: Mapping[tuple[int, int], float]) -> Cell:
    parts = [cell.gaps.copy(), cell.gap_rates.copy()]
    bends = None if cell.gap_bends is None else np.array(cell.gap_bends)
    for (strip, edge), gap in wanted.items():
        parts[0][strip, edge], parts[1][strip, edge] = gap, 0.0
        if bends is not None:
            bends[:, strip, edge] = 0.0
    return replace(cell, gaps=parts[0], gap_rates=parts[1], gap_bends=bends)


def _check_room(member: str, sections: Sequence[Section], askers: Mapping[int, int]) -> None:
    """askers: by strip the number of a row that asks for a gap at one of its edges."""
    first = min(askers.values())
    for section in sections:
        try:
            plates = section_polygons(checked(section))
        except BendTorsionError as problem:
            raise BendTorsionError(
                replace(found, object=member, position=f"edge {first}")
                for found in problem.findings
            ) from problem
        breadths = np.sqrt(((plates[:, 1] - plates[:, 0]) ** 2).sum(axis=1))
        narrow = int(np.argmin(breadths))
        if breadths[narrow] < tolerances.NARROWEST_STRIP:
            raise BendTorsionError(
                error(
                    "gap-too-wide",
                    member,
                    f"the root gap leaves too little of plate {section.strips[narrow].face}",
                    "use a smaller gap, or a wider section",
                    position=f"edge {askers.get(narrow, first)}",
                    value=float(breadths[narrow]),
                    limit=tolerances.NARROWEST_STRIP,
                    unit="mm",
                )
            )


def _two_rows(member: str, seam: str, number: int, gap: float, other: int, differs: float):
    return error(
        "root-gap-differs",
        member,
        f"seam {seam} has a root gap of {differs:g} mm here and of {gap:g} mm by another row: the "
        "edge of its plate is one cut",
        "give all rows of the seam the same gap, or none to all but one",
        position=f"edge {other}" if other != number else f"edge {number}",
        value=float(differs),
        limit=float(gap),
        unit="mm",
    )


def _against_section(member: str, seam: str, number: int, gap: float, section: str, own: float):
    return error(
        "root-gap-differs",
        member,
        f"the preparation has a root gap of {gap:g} mm, section {section} leaves {own:g} mm "
        f"between the plates of seam {seam}",
        "make them the same, or leave one of them empty: the other holds then",
        position=f"edge {number}",
        value=float(gap),
        limit=float(own),
        unit="mm",
    )


def _beyond_row(member: str, seam: str, number: int, gap: float) -> Finding:
    return warning(
        "root-gap-whole-seam",
        member,
        f"the root gap of {gap:g} mm holds along the whole of seam {seam}: the edge of its plate "
        "is one cut",
        "give the rest of the seam a preparation for this gap",
        position=f"edge {number}",
        value=float(gap),
        unit="mm",
    )


def _between_lanes(member: str, face: str, number: int, gap: float) -> Finding:
    return warning(
        "root-gap-lanes",
        member,
        f"the root gap between the lanes of face {face} is not taken off the plates",
        "set it where shrinkage closes it, or allow for it by shrinkage_across",
        position=f"edge {number}",
        value=float(gap),
        unit="mm",
    )
