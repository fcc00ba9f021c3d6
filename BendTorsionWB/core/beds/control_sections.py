# SPDX-License-Identifier: LGPL-2.1-or-later
"""Control sections of delivery pieces: cuts at their ends, at folds and at mid-length."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.piecewise import Together
from ..geometry.vectors import dots
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
    sections = []
    for piece in pieces:
        own = [plate for plate in plates if plate.piece == piece.number]
        for label, s in _places(member, piece):
            held = [plate for plate in own if _holds(plate, s, label != "E-2")]
            if held:
                sections.append((piece.number, label, s, held))
    cuts = iter(_cuts(member, [(plate, s) for *_, s, held in sections for plate in held]))
    return tuple(
        ControlSection(number, label, s, tuple(next(cuts) for _ in held))
        for number, label, s, held in sections
    )


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


def _cuts(member: Member, wanted: Sequence[tuple[Plate, float]]) -> list[CutPlate]:
    """The plates cut at places on the axis."""
    if not wanted:
        return []
    at = member.frames.at(np.array([s for _, s in wanted]))
    places = [np.array([min(max(s, plate.start), plate.end)]) for plate, s in wanted]
    outer, inner = (
        Together([getattr(plate.rails, level) for plate, _ in wanted])(places).reshape(-1, 2, 3)
        for level in ("outer", "inner")
    )
    ring = np.concatenate([outer, inner[:, ::-1]], axis=1) - at.origin[:, None]
    in_plane = np.stack([dots(ring, at.y[:, None]), dots(ring, at.z[:, None])], axis=2)
    return [
        CutPlate(plate.mark, plate.face, plate.thickness, own)
        for (plate, _), own in zip(wanted, in_plane, strict=True)
    ]
