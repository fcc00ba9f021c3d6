# SPDX-License-Identifier: LGPL-2.1-or-later
"""The skins solids are written from: of plates, and of a member's corner lines."""

from __future__ import annotations

from collections.abc import Sequence
from weakref import WeakKeyDictionary

import numpy as np

from .. import tolerances
from ..members.member import Member
from ..members.skin import SkinPiece, skin, skins
from ..members.strips import StripRails
from ..members.volume import skin_volumes, strip_volume
from ..plates.plates import Plate

_skin_of: WeakKeyDictionary[StripRails, tuple[tuple[SkinPiece, ...], float]] = WeakKeyDictionary()
"""Skins of plates that live and the volumes inside; an edit leaves most rails as they are."""
_tubes_of: WeakKeyDictionary[Member, dict[tuple[float, float], tuple]] = WeakKeyDictionary()
"""Corner tubes of members that live."""


def plate_skin(plate: Plate) -> tuple[SkinPiece, ...]:
    """The skin in ring order: outer first, outer second, inner second, inner first."""
    return plate_skins([plate])[0]


def plate_skins(plates: Sequence[Plate]) -> list[tuple[SkinPiece, ...]]:
    return skins_and_volumes(plates)[0]


def skins_and_volumes(
    plates: Sequence[Plate],
) -> tuple[list[tuple[SkinPiece, ...]], list[float]]:
    """Skins refined until each holds its plate's volume well within VOLUME_RELATIVE, and those
    volumes; of plates that are cut, of what they are cut from."""
    bodies = [plate.uncut or plate.rails for plate in plates]
    volumes = [
        strip_volume(body) if plate.is_cut else plate.volume
        for plate, body in zip(plates, bodies, strict=True)
    ]
    pending = [i for i, body in enumerate(bodies) if body not in _skin_of]
    tolerance = tolerances.SKIN_CORNER
    while pending:
        groups = [bodies[i] for i in pending]
        made = in_ring_order(
            skins(
                [((r.outer, r.inner), (r.outer_folds, r.inner_folds)) for r in groups],
                tolerance=tolerance,
            )
        )
        _skin_of.update(zip(groups, zip(made, skin_volumes(made), strict=True), strict=True))
        tolerance /= 16.0
        pending = [
            i
            for i in pending
            if abs(_skin_of[bodies[i]][1] / volumes[i] - 1.0) > 0.25 * tolerances.VOLUME_RELATIVE
            and tolerance > tolerances.INTERPOLATION_RELATIVE * 1e6
        ]
    done = [_skin_of[body] for body in bodies]
    return [skin for skin, _ in done], [volume for _, volume in done]


def in_ring_order(made: Sequence[tuple[SkinPiece, ...]]) -> list[tuple[SkinPiece, ...]]:
    return [
        tuple(SkinPiece(piece.knots, piece.poles[[0, 1, 3, 2]]) for piece in pieces)
        for pieces in made
    ]


def corner_tubes(
    member: Member, reach: tuple[float, float] | None = None
) -> tuple[tuple[SkinPiece, ...], ...]:
    """The corner lines between two places (None: the ends): a tube between steps, a piece of it
    between folds and ends of smooth transitions."""
    reach = reach or (0.0, member.length)
    made = _tubes_of.setdefault(member, {})
    if reach not in made:
        made[reach] = _corner_tubes(member, *reach)
    return made[reach]


def _corner_tubes(member: Member, first: float, last: float) -> tuple[tuple[SkinPiece, ...], ...]:
    edges = [first, *_steps(member), last]
    cells = member.law.cells
    # Smooth transitions have no folds, but their curvature begins and ends abruptly.
    folds = sorted(
        {
            *member.law.folds,
            *(
                after.start
                for before, after in zip(cells, cells[1:], strict=False)
                if before.corner_bends is not None or after.corner_bends is not None
            ),
        }
    )
    return tuple(
        skin((member.corners(a, b),), (tuple(f for f in folds if a < f < b),))
        for a, b in zip(edges[:-1], edges[1:], strict=True)
    )


def _steps(member: Member) -> list[float]:
    """Places where the outer skin itself jumps."""
    steps = []
    for before, after in zip(member.law.cells[:-1], member.law.cells[1:], strict=True):
        at_end = before.corners_at(np.array([before.end]))[0]
        at_start = after.corners_at(np.array([after.start]))[0]
        if np.abs(at_start - at_end).max() > tolerances.FACES_FLUSH:
            steps.append(after.start)
    return steps
