# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is cut out of, marked on and set between the plates of a member, worked out together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..finding import BendTorsionError, Finding
from ..members.member import Member
from .diaphragm_input import Diaphragm
from .diaphragms import flat_parts
from .face_marks import FaceMark, set_marks
from .flat_plate import FlatPlate
from .openings import Opening, cut_openings, located
from .plates import Plate


def with_parts(
    member: Member,
    plates: Sequence[Plate],
    diaphragms: Sequence[Diaphragm] = (),
    openings: Sequence[Opening] = (),
    marks: Sequence[FaceMark] = (),
) -> tuple[tuple[Plate, ...], tuple[FlatPlate, ...]]:
    """The plates with their openings and marks, and the flat parts, in order along +s.

    Raises BendTorsionError with every row that cannot be, by `diaphragm k`, `opening k`, `mark k`.
    """
    findings: list[Finding] = []
    flats, cuts = (), []
    made = list(plates)
    try:
        parts = flat_parts(member, plates, diaphragms)
        flats, cuts = parts.flats, list(parts.cuts)
        for index, mark in parts.marks:
            made[index] = replace(made[index], marks=(*made[index].marks, mark))
    except BendTorsionError as problem:
        findings += problem.findings
    for number, row in enumerate(openings, start=1):
        cut = located(member.name, plates, member.length, row, f"opening {number}")
        if isinstance(cut, Finding):
            findings.append(cut)
        else:
            cuts.append(cut)
    try:
        made = cut_openings(member.name, made, cuts)
    except BendTorsionError as problem:
        findings += problem.findings
    try:
        made = set_marks(member.name, made, member.length, marks)
    except BendTorsionError as problem:
        findings += problem.findings
    if findings:
        raise BendTorsionError(findings)
    return tuple(made), flats
