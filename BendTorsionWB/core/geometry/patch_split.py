# SPDX-License-Identifier: LGPL-2.1-or-later
"""A patch with creases inside, as smooth patches that meet there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .nurbs import NurbsPatch

_BESIDE = 1e-7
_PLACES = 65


def smooth_patches(patch: NurbsPatch, crease: float) -> tuple[NurbsPatch, ...]:
    """The patch cut along every knot line where the normal jumps by more than `crease` rad.

    Only knots of full multiplicity can hold a crease, and there the poles of one side simply end:
    the pieces are exact. Each keeps the whole patch's wires.
    """
    pieces = (patch,)
    for direction in (0, 1):
        pieces = tuple(part for piece in pieces for part in _cut(piece, direction, crease))
    return pieces


def _cut(patch: NurbsPatch, direction: int, crease: float) -> list[NurbsPatch]:
    degree = (patch.degree_u, patch.degree_v)[direction]
    knots = (patch.knots_u, patch.knots_v)[direction]
    first, last = patch.domain[direction]
    values, counts = np.unique(knots, return_counts=True)
    inner = (values > first) & (values < last) & (counts >= degree)
    places = [value for value in values[inner] if _jump(patch, direction, value) > crease]
    parts, rest = [], patch
    for place in places:
        before, rest = _at(rest, direction, place)
        parts.append(before)
    return [*parts, rest]


def _jump(patch: NurbsPatch, direction: int, place: float) -> float:
    """Largest angle between the normals of both sides of a knot line, rad."""
    first, last = patch.domain[direction]
    start, end = patch.domain[1 - direction]
    along = start + (end - start) * (np.arange(_PLACES) + 0.5) / _PLACES
    sides = []
    for beside in (-_BESIDE, _BESIDE):
        fixed = np.full(_PLACES, place + beside * (last - first))
        u, v = (fixed, along) if direction == 0 else (along, fixed)
        sides.append(patch.normals(u, v))
    return float(np.arcsin(np.clip(np.linalg.norm(np.cross(*sides), axis=1), 0, 1)).max())


def _at(patch: NurbsPatch, direction: int, place: float) -> tuple[NurbsPatch, NurbsPatch]:
    degree = (patch.degree_u, patch.degree_v)[direction]
    knots = (patch.knots_u, patch.knots_v)[direction]
    start = int(np.searchsorted(knots, place, side="left"))
    stop = int(np.searchsorted(knots, place, side="right"))
    full = np.full(degree + 1, place)
    # The last pole of the first side is the first of the second when the multiplicity is p.
    before = np.concatenate([knots[:start], full])
    after = np.concatenate([full, knots[stop:]])
    return (
        _part(patch, direction, before, slice(0, len(before) - degree - 1)),
        _part(patch, direction, after, slice(stop - degree - 1, None)),
    )


def _part(patch: NurbsPatch, direction: int, knots: np.ndarray, keep: slice) -> NurbsPatch:
    pick = (keep, slice(None)) if direction == 0 else (slice(None), keep)
    weights = None if patch.weights is None else patch.weights[pick]
    named = {("knots_u", "knots_v")[direction]: knots}
    return replace(patch, poles=patch.poles[pick], weights=weights, **named)
