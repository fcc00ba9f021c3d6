# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cut ends of plates: what each stretch of them ends on, and the angle it meets it at.

A cut end lies on a surface (a plane, a face of another member less the root gap). That surface
stands at an angle to the plate that changes along the end of a twisted one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..lofting import DevelopedPlate, EndPart
from ..members.contour import EndCurves
from .plates import Plate

PLACES = 17
"""Places along a stretch of an end."""

_INSIDE = 1e-9
"""Of its width: how far inside a stretch its ends are asked for what they lie on."""


def with_ends(plate: Plate, developed: DevelopedPlate) -> DevelopedPlate:
    """The developed plate with the stretches of its two ends; none of an end that is square."""
    if not plate.is_cut:
        return developed
    ends = tuple(() if cut is None else _parts(plate, cut) for cut in plate.cuts)
    return replace(developed, ends=ends)


def _parts(plate: Plate, cut: EndCurves) -> tuple[EndPart, ...]:
    """The stretches of an end from the first edge to the second, each on one surface."""
    mid = (plate.uncut or plate.rails).mid
    found, before = [], 0.0
    for low, high, part in _stretches(cut, mid):
        w = np.linspace(low + _INSIDE, high - _INSIDE, PLACES)
        s = cut.at("mid", w)
        points, outward = _surface(mid, s, w, plate.inward)
        _, away = part.value_and_gradient(points)
        away = away / np.sqrt((away * away).sum(axis=1))[:, None]
        step = np.diff(points, axis=0)
        along = before + np.concatenate([[0.0], np.cumsum(np.sqrt((step * step).sum(axis=1)))])
        before = float(along[-1])
        bevel = np.arcsin((outward * away).sum(axis=1).clip(-1.0, 1.0))
        found.append(EndPart(*_met(part), along, s, bevel, points[[0, -1]]))
    return tuple(found)


def _stretches(cut: EndCurves, mid: Piecewise):
    """From and to (w) and the surface of each stretch of an end."""
    parts = getattr(cut.surface, "parts", (cut.surface,))
    breaks = cut.mid.breaks
    if len(parts) == 1:
        return [(0.0, 1.0, parts[0])]
    w = 0.5 * (breaks[1:] + breaks[:-1])
    points, _ = _surface(mid, cut.at("mid", w), w, 1)
    which = cut.surface.part_at(points)
    # A stretch begins where another surface takes over.
    heads = [0, *(1 + np.flatnonzero(which[1:] != which[:-1])).tolist()]
    tails = [*heads[1:], len(which)]
    return [
        (float(breaks[a]), float(breaks[b]), parts[which[a]])
        for a, b in zip(heads, tails, strict=True)
    ]


def _surface(mid: Piecewise, s: np.ndarray, w: np.ndarray, inward: int):
    """Points and outward unit normals (n, 3) of a plate's mid-surface."""
    value, rate = mid(s), mid.derivative(s)
    ruling = value[:, 3:] - value[:, :3]
    along = rate[:, :3] + w[:, None] * (rate[:, 3:] - rate[:, :3])
    normal = crossed(along, ruling) * -float(inward)
    normal = normal / np.sqrt((normal * normal).sum(axis=1))[:, None]
    return value[:, :3] + w[:, None] * ruling, normal


def _met(part) -> tuple[str, str, str, float, float]:
    """Node, member, face, thickness and root gap of what a stretch ends on."""
    faces = getattr(part, "faces", None)
    if faces is None:
        return "", "", "", 0.0, 0.0
    face = part.landing[0]
    return part.node, faces.member, faces.names[face], faces.walls[face], part.gap
