# SPDX-License-Identifier: LGPL-2.1-or-later
"""Delivery pieces as records: where they lie, how they end, what they weigh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Piece:
    """A delivery piece: from start to end on the axis; the offsets of its faces there (none when
    square); green lengths of its plates at both ends; gap: mm open to the next piece."""

    number: int
    start: float
    end: float
    start_offsets: tuple[tuple[str, float], ...] = ()
    end_offsets: tuple[tuple[str, float], ...] = ()
    green_start: float = 0.0
    green_end: float = 0.0
    gap: float = 0.0

    def start_of(self, face: str) -> float:
        """Where the piece starts on a face, on the axis."""
        return self.start + dict(self.start_offsets).get(face, 0.0)

    def end_of(self, face: str) -> float:
        """Where the piece ends on a face, on the axis."""
        return self.end + dict(self.end_offsets).get(face, 0.0)


@dataclass(frozen=True, eq=False)
class PieceFigures:
    """A piece with the marks of its plates and flat parts, their mass, kg, and the centre of
    gravity (3,) of them all, mm."""

    piece: Piece
    marks: tuple[str, ...]
    mass: float
    centre_of_gravity: np.ndarray


def piece_figures(
    pieces: Sequence[Piece], parts: Sequence[tuple[str, int, float, np.ndarray]]
) -> tuple[PieceFigures, ...]:
    """The pieces with what parts (mark, piece, mass, centre of gravity) they hold."""
    found = []
    for piece in pieces:
        own = [part for part in parts if part[1] == piece.number]
        mass = sum(part[2] for part in own)
        centre = sum(part[2] * part[3] for part in own) / mass if own else np.full(3, np.nan)
        found.append(PieceFigures(piece, tuple(part[0] for part in own), float(mass), centre))
    return tuple(found)
