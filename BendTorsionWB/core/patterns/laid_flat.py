# SPDX-License-Identifier: LGPL-2.1-or-later
"""All plates of a member laid flat, with what they owe to each other: edges, seams, allowances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..finding import BendTorsionError, error
from ..lofting import DevelopedPlate
from ..members.member import Member
from ..plates.edge_faces import with_edges
from ..plates.end_faces import with_ends
from ..plates.plates import Plate
from ..welds.bevels import CONTOURS
from .flattened_surface import SURFACES, on_surface
from .flattening_errors import with_seams
from .forming import FormingRules
from .gross import Allowances, check_allowances, with_gross
from .pattern import MODES, develop_plates

MARKING_FACES = ("inside", "outside")


@dataclass(frozen=True)
class PatternInput:
    """How the plates of a member are laid flat (mode: one of MODES; surface: one of SURFACES),
    the face the patterns are seen from, one of MARKING_FACES, what they are cut larger by, and
    the face cut files draw, one of CONTOURS."""

    mode: str = "edges"
    surface: str = "mid"
    marking_face: str = "inside"
    allowances: Allowances = Allowances()
    contour: str = "mid"


PLAIN = PatternInput()
"""Mode `edges` on the mid-surface, marked inside, nothing allowed."""


def laid_flat(
    member: Member,
    plates: Sequence[Plate],
    given: PatternInput = PLAIN,
    rules: FormingRules | None = None,
    diaphragms: Sequence[float] = (),
) -> tuple[DevelopedPlate, ...]:
    """The developed plates of a member, in order, all plates given.

    diaphragms: their places, mm.
    Raises BendTorsionError for input that is none of the known words, allowances out of range,
    and plates that fold over themselves.
    """
    for what, known in (
        ("mode", MODES),
        ("surface", SURFACES),
        ("marking_face", MARKING_FACES),
        ("contour", CONTOURS),
    ):
        if getattr(given, what) not in known:
            raise BendTorsionError(
                error(
                    "pattern-input",
                    member.name,
                    f"unknown {what}",
                    f"use one of {', '.join(known)}",
                    position=what,
                    value=str(getattr(given, what)),
                )
            )
    check_allowances(given.allowances, member.name)
    developed = develop_plates(plates, given.marking_face, given.mode, rules, given.surface)
    developed = [with_ends(plate, own) for plate, own in zip(plates, developed, strict=True)]
    flattened = [on_surface(plate, given.surface) for plate in plates]
    developed = with_seams(with_edges(flattened, developed, member.law.strips))
    closed = member.frames.axis.closed
    green = _green_of_pieces(member, plates)
    if given.surface != "mid":
        developed = [replace(plate, flattened_surface=given.surface) for plate in developed]
    return with_gross(developed, given.allowances, closed, diaphragms, green)


def _green_of_pieces(member: Member, plates: Sequence[Plate]) -> list[tuple[float, float]]:
    """Green, mm, at the start and end of each plate that ends with its delivery piece."""
    greens = {piece.number: (piece.green_start, piece.green_end) for piece in member.pieces}
    reach: dict[tuple[str, int], tuple[float, float]] = {}
    for plate in plates:
        key = plate.face, plate.piece
        low, high = reach.get(key, (plate.start, plate.end))
        reach[key] = min(low, plate.start), max(high, plate.end)
    found = []
    for plate in plates:
        start, end = greens.get(plate.piece, (0.0, 0.0))
        low, high = reach[plate.face, plate.piece]
        found.append((start if plate.start <= low else 0.0, end if plate.end >= high else 0.0))
    return found
