# SPDX-License-Identifier: LGPL-2.1-or-later
"""Control points of delivery pieces, as designed and as set up before welding.

Welding makes a piece smaller. Before it the axis is longer by the plates' shrinkage along, the
section larger by that across; a uniform shrinkage keeps the shape of the axis, so the set-up is the
designed piece with its axis scaled about the middle of the first line, and each section about its
own middle.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord
from .bed_record import Bed, ControlPoint

FACE = "face"


@dataclass(frozen=True, eq=False)
class ControlRow:
    """A point of a piece: an outer corner at a line, or FACE, the middle of an end face with its
    outward normal (3,) in the model. xyz: model; bed, fabrication: on the bed, as designed and as
    set up; (3,) mm."""

    piece: str
    line: str
    corner: str
    s: float
    xyz: np.ndarray
    bed: np.ndarray
    fabrication: np.ndarray
    normal: np.ndarray | None = None


def control_rows(record: MemberRecord) -> Iterator[ControlRow]:
    """The points of all pieces of a member, line by line, the ends' faces after their corners."""
    for bed in record.beds:
        own = [p for p in record.plates if p.lines and (not bed.piece or p.piece == bed.piece)]
        along, across = _scale(own, "scale_u"), _scale(own, "scale_v")
        lines: dict[str, list[ControlPoint]] = {}
        for point in bed.points:
            lines.setdefault(point.line, []).append(point)
        first = None
        for name, points in lines.items():
            middle = np.mean([point.bed for point in points], axis=0)
            first = middle if first is None else first
            set_up = first + along * (middle - first)
            for point in points:
                place = set_up + across * (point.bed - middle)
                yield ControlRow(bed.name, name, point.corner, point.s, point.xyz, point.bed, place)
            if name.startswith("E-") and len(points) > 2:
                yield _face(bed, name, points, middle, set_up)


def _face(bed: Bed, name: str, points: Sequence[ControlPoint], middle, set_up) -> ControlRow:
    """The middle of an end face and its outward normal, by its diagonals."""
    xyz = np.array([point.xyz for point in points])
    half = len(points) // 2
    normal = np.cross(xyz[half] - xyz[0], xyz[-1] - xyz[half - 1])
    normal = normal / np.sqrt((normal * normal).sum())
    # Outward: away from the piece, whose other lines lie along +s of the first.
    away = bed.points[-1].xyz - bed.points[0].xyz
    outward = -1.0 if name == "E-1" else 1.0
    if outward * float((normal * away).sum()) < 0.0:
        normal = -normal
    s = float(np.mean([point.s for point in points]))
    return ControlRow(bed.name, name, FACE, s, xyz.mean(axis=0), middle, set_up, normal)


def _scale(plates: Sequence[DevelopedPlate], name: str) -> float:
    """Mean of the plates' gross over net, by length; 1 without allowances."""
    if not plates:
        return 1.0
    lengths = np.array([plate.length for plate in plates])
    scales = np.array([1.0 if p.gross is None else getattr(p.gross, name) for p in plates])
    return float((lengths * scales).sum() / lengths.sum())
