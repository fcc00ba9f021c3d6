# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which surface of a plate is laid flat: its middle, or one of its faces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..plates.face_marks import marks_on
from ..plates.plates import Plate

SURFACES = ("mid", "outer", "inner")
"""The neutral fibre of bent plate is its middle; the faces are for templates laid on them."""


def on_surface(plate: Plate, surface: str) -> Plate:
    """The plate with the rails, folds, lines and cuts of a surface in place of the middle's, so
    that it is the one flattened and measured."""
    if surface == "mid":
        return plate
    rails = plate.rails
    folds = getattr(rails, f"{surface}_folds")
    own = iter([f for s, f in zip(rails.boundaries, folds, strict=True) if s in plate.folds])
    cuts = tuple(
        None if cut is None else replace(cut, mid=getattr(cut, surface)) for cut in plate.cuts
    )
    half = np.array([0.5])
    ends = {
        line.label: float(cut.at(surface, half)[0])
        for line, cut in zip((plate.lines[0], plate.lines[-1]), cuts, strict=True)
        if cut is not None
    }
    lines = tuple(
        replace(line, s_mid=next(own))
        if line.label.startswith("F")
        else replace(line, s_mid=ends.get(line.label, line.s_mid))
        for line in plate.lines
    )
    rails = replace(rails, mid=getattr(rails, surface), mid_folds=folds)
    openings = tuple(opening.on(surface) for opening in plate.openings)
    marks = marks_on(plate, surface)
    return replace(plate, rails=rails, lines=lines, cuts=cuts, openings=openings, marks=marks)
