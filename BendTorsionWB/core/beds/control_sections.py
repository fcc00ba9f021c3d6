# SPDX-License-Identifier: LGPL-2.1-or-later
"""Control sections of delivery pieces: cuts at their ends, at folds and at mid-length."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..members.member import Member
from ..members.piece_record import Piece
from ..plates.plates import Plate
from .control_record import ControlSection, CutPlate

NEAREST = 50.0
"""mm; a fold nearer to an end is shown by the end's section, and mid-length by a fold's."""


def control_sections(
    member: Member, pieces: Sequence[Piece], plates: Sequence[Plate]
) -> tuple[ControlSection, ...]:
    """The control sections of all pieces, along +s; plates cut askew are shown as far as their
    section planes reach."""
    found = []
    for piece in pieces:
        own = [plate for plate in plates if plate.piece == piece.number]
        for label, s in _places(member, piece):
            later = label != "E-2"
            cut = tuple(_cut(member, plate, s) for plate in own if _holds(plate, s, later))
            if cut:
                found.append(ControlSection(piece.number, label, s, cut))
    return tuple(found)


def _places(member: Member, piece: Piece) -> list[tuple[str, float]]:
    start, end = max(piece.start, 0.0), min(piece.end, member.length)
    inside = [
        (f"F{k}", float(fold))
        for k, fold in enumerate(sorted(set(member.law.folds)), start=1)
        if start + NEAREST < fold < end - NEAREST
    ]
    middle = 0.5 * (start + end)
    if all(abs(fold - middle) > NEAREST for _, fold in inside):
        inside.append(("M", middle))
    return [("E-1", start), *sorted(inside, key=lambda place: place[1]), ("E-2", end)]


def _holds(plate: Plate, s: float, later: bool) -> bool:
    if later:
        return plate.start - 1e-6 <= s < plate.end - 1e-6
    return plate.start + 1e-6 < s <= plate.end + 1e-6


def _cut(member: Member, plate: Plate, s: float) -> CutPlate:
    at = member.frames.at(np.array([s]))
    place = np.array([min(max(s, plate.start), plate.end)])
    outer, inner = (
        rail(place).reshape(2, 3) - at.origin for rail in (plate.rails.outer, plate.rails.inner)
    )
    ring = np.concatenate([outer, inner[::-1]])
    in_plane = np.stack([(ring * at.y).sum(axis=1), (ring * at.z).sum(axis=1)], axis=1)
    return CutPlate(plate.mark, plate.face, plate.thickness, in_plane)
