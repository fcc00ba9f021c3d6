# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a finished member can miss its place by, source by source, the largest first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .lofting import DevelopedPlate, MemberRecord

SEAM_SHRINKAGE = 0.6
"""mm per m along four longitudinal seams, webs up to 1 m and plate up to 25 mm (handbook value,
to be verified by the shop)."""

JOINT_SHRINKAGE = 1.5
"""mm across a butt joint (handbook value 1 to 2, to be verified by the shop)."""

MESH_LIMIT = 1e-9


@dataclass(frozen=True)
class ErrorSource:
    """One source. size: mm, the worst over all members; where: member or plate; kind: `given` (in
    what we were given), `fabrication` (in the shop) or `computed` (ours); note: what it means."""

    name: str
    kind: str
    size: float
    where: str
    note: str


def error_sources(
    records: Sequence[MemberRecord], uncertainty: Mapping[str, float] | None = None
) -> tuple[ErrorSource, ...]:
    """All sources of the records, the largest first; those that do not apply are left out.

    uncertainty: of each member's axis, mm: what its points cannot tell.
    """
    built = [record for record in records if record.plates]
    plates = [plate for record in built for plate in record.plates if plate.lines]
    found = [
        _worst(
            "axis between the given points",
            "given",
            [(value, name) for name, value in (uncertainty or {}).items()],
            "distance of a given point from the axis through every other point",
        ),
        _worst(
            "axis to surface",
            "computed",
            [(r.axis_to_surface_max, r.member) for r in built if r.axis_to_surface_max],
            "largest distance of the axis from the architectural surface",
        ),
        _worst(
            "torsion",
            "computed",
            [(r.torsion_error_max * _reach(r), r.member) for r in built if r.torsion_error_max],
            "torsion error times the distance of the farthest corner from the axis",
        ),
        _worst(
            "flat pattern",
            "computed",
            [(p.length_error_max, p.mark) for p in plates],
            "flat minus true length of edges, lines and diagonals; a bound no pattern can beat "
            "stands beside it in the tables",
        ),
        _worst(
            "seam shrinkage",
            "fabrication",
            [(_seam_shrinkage(r), r.member) for r in built],
            f"{SEAM_SHRINKAGE:g} mm per m of welded seams, not covered by the allowances given",
        ),
        _worst(
            "joint shrinkage",
            "fabrication",
            [(_joint_shrinkage(r), r.member) for r in built],
            f"{JOINT_SHRINKAGE:g} mm per butt joint, not covered by the allowances given",
        ),
    ]
    real = [source for source in found if source is not None and source.size > MESH_LIMIT]
    return tuple(sorted(real, key=lambda source: -source.size))


def _worst(name: str, kind: str, sizes, note: str) -> ErrorSource | None:
    if not sizes:
        return None
    size, where = max(sizes)
    return ErrorSource(name, kind, float(size), where, note)


def _reach(record: MemberRecord) -> float:
    """Distance of the farthest corner line from the axis, mm."""
    axis = record.wireframe.get("axis")
    lines = [line for line in record.wireframe.values() if axis is not None]
    starts = [line[0] for line in lines if len(line) == 2 * len(axis)]
    return max((float(np.linalg.norm(start - axis[0])) for start in starts), default=0.0)


def _seam_shrinkage(record: MemberRecord) -> float:
    """Shrinkage of the member's length that the plates' gross length does not make up for."""
    return max((max(_expected(p) - _allowed(p), 0.0) for p in record.plates if p.lines), default=0)


def _expected(plate: DevelopedPlate) -> float:
    return SEAM_SHRINKAGE * plate.length / 1000.0


def _allowed(plate: DevelopedPlate) -> float:
    return 0.0 if plate.gross is None else (plate.gross.scale_u - 1.0) * plate.length


def _joint_shrinkage(record: MemberRecord) -> float:
    """Of the face with the most joints; covered joints are those of plates with green ends."""
    joints: dict[str, int] = {}
    for plate in record.plates:
        covered = plate.gross is not None and plate.gross.green_end + plate.gross.green_start > 0
        if plate.lines and not covered:
            joints[plate.face] = joints.get(plate.face, 0) + 1
    return JOINT_SHRINKAGE * max((count - 1 for count in joints.values()), default=0)
