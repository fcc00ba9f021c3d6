# SPDX-License-Identifier: LGPL-2.1-or-later
"""The diaphragms and end plates of a member of closed section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error
from ..members.member import Member
from .diaphragm_input import ENDS, Diaphragm
from .diaphragm_part import FlatPart
from .flat_plate import FlatPlate
from .openings import Cut
from .plate_places import PlateMark
from .plates import Plate


@dataclass(frozen=True, eq=False)
class FlatParts:
    """Diaphragms and end plates, and what they ask of the walls: cuts, and marks by plate."""

    flats: tuple[FlatPlate, ...] = ()
    cuts: tuple[Cut, ...] = ()
    marks: tuple[tuple[int, PlateMark], ...] = ()


def flat_parts(member: Member, plates: Sequence[Plate], rows: Sequence[Diaphragm]) -> FlatParts:
    """The flat parts asked for, `D1` … and `E1` … along +s, named in findings by their row.

    Raises BendTorsionError for open sections and for parts that leave the member, meet, have no
    room for their snipes or manhole, or name no face of the section.
    """
    if not rows:
        return FlatParts()
    findings = _refused(member, rows)
    if findings:
        raise BendTorsionError(findings)
    places = [_place(member, row) for row in rows]
    flats, cuts, marks = [], [], []
    numbers = {"D": 0, "E": 0}
    for index in sorted(range(len(rows)), key=lambda k: places[k]):
        row, source = rows[index], f"diaphragm {index + 1}"
        letter = "E" if row.end else "D"
        numbers[letter] += 1
        mark = f"{member.name}-{letter}{numbers[letter]}"
        try:
            part = FlatPart(member, plates, row, places[index], mark, source)
            flats.append(part.flat)
            cuts += part.cuts
            marks += part.marks
        except BendTorsionError as problem:
            findings += problem.findings
    if findings:
        raise BendTorsionError(findings)
    return FlatParts(tuple(flats), tuple(cuts), tuple(marks))


def _place(member: Member, row: Diaphragm) -> float:
    """Arc length of the middle of the part's thickness."""
    if row.end:
        half = 0.5 * row.thickness
        return -half if row.end == "start" else member.length + half
    return row.s * (member.length if row.s_is_ratio else 1.0)


def _refused(member: Member, rows: Sequence[Diaphragm]) -> list[Finding]:
    section = member.law.sections[0]
    findings = []
    if not section.closed:
        findings.append(
            error(
                "diaphragm-section",
                member.name,
                f"diaphragms and end plates of open sections ({section.type}) are not supported",
                "use a box, or model the stiffeners as members",
                position="diaphragm 1",
                value=section.type,
            )
        )
    letters = {strip.letter for strip in member.law.strips}
    if letters & {"D", "E"}:
        findings.append(
            error(
                "diaphragm-letter",
                member.name,
                "the letters D and E are those of diaphragms and end plates",
                "give the section's strips other letters",
                position="diaphragm 1",
                value=" ".join(sorted(letters)),
            )
        )
    faces = [strip.face for strip in member.law.strips]
    spans = []
    for number, row in enumerate(rows, start=1):
        source = f"diaphragm {number}"

        def fault(code, message, mend, value=None, limit=None, unit="mm", source=source):
            return error(
                code,
                member.name,
                message,
                mend,
                position=source,
                value=value,
                limit=limit,
                unit="" if value is None or isinstance(value, str) else unit,
            )

        if not (np.isfinite(row.thickness) and row.thickness > 0.0):
            mend = "give a thickness in mm"
            findings.append(
                fault("diaphragm-thickness", "it has no thickness", mend, row.thickness, 0.0)
            )
            continue
        if not row.end and row.gap < 0.0:
            mend = "give a gap of zero or more; only end plates stand over the section"
            findings.append(fault("diaphragm-gap", "the gap is negative", mend, row.gap, 0.0))
        if row.closing and (row.end or row.closing.face not in faces):
            problem = "an end plate closes no face" if row.end else "the section has no such face"
            mend = "empty the cell" if row.end else f"use {', '.join(faces)}"
            findings.append(fault("diaphragm-closing", problem, mend, row.closing.face))
        place = _place(member, row)
        low, high = place - 0.5 * row.thickness, place + 0.5 * row.thickness
        if row.end:
            if member.ends[ENDS.index(row.end)] is not None:
                findings.append(
                    fault(
                        "end-plate-on-cut",
                        "end plates of ends that are not square are not supported",
                        "cut the end square, or leave the end plate out",
                    )
                )
        elif not (low >= 0.0 and high <= member.length):
            findings.append(
                fault(
                    "diaphragm-outside",
                    "it does not lie between the member's ends over its whole thickness",
                    f"give a place from {0.5 * row.thickness:g} to "
                    f"{member.length - 0.5 * row.thickness:.1f} mm, or start or end",
                    float(place),
                    float(member.length),
                )
            )
        for other, (start, end) in spans:
            if min(high, end) - max(low, start) > -tolerances.SAME_STATION:
                findings.append(
                    fault(
                        "diaphragms-meet",
                        f"it lies on {other}",
                        "move one of them",
                        float(place),
                    )
                )
        spans.append((source, (low, high)))
    return findings
