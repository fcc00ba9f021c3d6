# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids of tubes, kept by the content of their poles: an edit makes only those it changes."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import numpy as np
import Part

from BendTorsionWB.core.members.skin import SkinPiece
from BendTorsionWB.core.memo import Kept
from BendTorsionWB.shapes import brep

_kept = Kept()


def solids_of(
    skins: Sequence[Sequence[SkinPiece]], cuts: Sequence[brep.Cuts] | None = None
) -> list[tuple[Part.Solid, bool]]:
    """The solid of each skin, rails in ring order, and whether it is sound: closed, of plates all
    along a quadrilateral that does not cross itself, and valid where it is cut; cuts: the rings
    of its ends that are cut. Errors as `brep.tube_solids`."""
    cuts = cuts or [(None, None)] * len(skins)
    keys = [_content(pieces, rings) for pieces, rings in zip(skins, cuts, strict=True)]
    solids = {key: _kept.recall(key) for key in keys}
    new = {
        key: (pieces, rings)
        for key, pieces, rings in zip(keys, skins, cuts, strict=True)
        if solids[key] is None
    }
    tubes = [[(p.knots, p.poles) for p in pieces] for pieces, _ in new.values()]
    made = brep.tube_solids(tubes, [rings for _, rings in new.values()])
    for key, solid in zip(new, made, strict=True):
        pieces, rings = new[key]
        sound = solid.isClosed() and _turns_one_way(pieces)
        solids[key] = solid, sound and (tuple(rings) == (None, None) or solid.isValid())
        _kept.keep(key, solids[key])
    return [solids[key] for key in keys]


def _turns_one_way(pieces: Sequence[SkinPiece]) -> bool:
    """False where a ring of four poles is folded or crosses itself."""
    for piece in pieces:
        rings = piece.poles
        if len(rings) != 4:
            continue
        steps = np.roll(rings, -1, axis=0) - rings
        turns = np.cross(steps, np.roll(steps, -1, axis=0))
        if ((turns * turns.sum(axis=0)).sum(axis=2) <= 0.0).any():
            return False
    return True


def _content(pieces: Sequence[SkinPiece], rings: brep.Cuts) -> bytes:
    digest = hashlib.sha256()
    for ring in rings:
        digest.update(b"" if ring is None else ring.surface.encode() + ring.places.tobytes())
    for piece in pieces:
        digest.update(f"{piece.poles.shape}".encode())
        digest.update(piece.knots.tobytes())
        digest.update(piece.poles.tobytes())
    return digest.digest()
