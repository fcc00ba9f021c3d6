# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strain of laying a plate flat, as a field over its pattern."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..colour_scale import ColourScale
from ..flattening.development import strain
from ..plates.plates import Plate
from .flattened_surface import on_surface
from .pattern import pattern_and_outline

STEP = 100.0
"""Length of a cell along the plate, mm, at most."""
CELLS_ACROSS = 12


@dataclass(frozen=True, eq=False)
class StrainMap:
    """flat (n + 1, m + 1, 2): corners of the cells in the pattern, mm; strain (n, m): signed
    principal strain largest in size, at the middle of each cell (flat over formed length, less
    one); outline: runs (k, 2); lines (j, 2, 2): measuring lines; scale: of the sizes."""

    mark: str
    mode: str
    flat: np.ndarray
    strain: np.ndarray
    outline: tuple[np.ndarray, ...]
    lines: np.ndarray
    scale: ColourScale


def strain_map(
    plate: Plate, mode: str = "edges", marking_face: str = "inside", surface: str = "mid"
) -> StrainMap:
    """The strain field of a plate over its pattern; cells beside cut ends reach beyond the
    outline. Raises BendTorsionError when the plate folds over itself."""
    plate = on_surface(plate, surface)
    pattern, outline = pattern_and_outline(plate, mode, marking_face)
    development = pattern.development
    start, end = development.plane.start, development.plane.end
    folds = [fold for fold in plate.rails.mid_folds if start < fold < end]
    edges = [start, *folds, end]
    s = np.concatenate(
        [
            np.linspace(a, b, max(2, int(np.ceil((b - a) / STEP)) + 1))[:-1]
            for a, b in zip(edges[:-1], edges[1:], strict=True)
        ]
        + [[end]]
    )
    w = np.linspace(0.0, 1.0, CELLS_ACROSS + 1)
    flat = pattern.flat(np.repeat(s, len(w)), np.tile(w, len(s))).reshape(len(s), len(w), 2)
    values = strain(development, 0.5 * (s[1:] + s[:-1]), 0.5 * (w[1:] + w[:-1]))
    places = np.array([line.s_mid for line in plate.lines])
    ends = [pattern.flat(places, np.full(len(places), at)) for at in (0.0, 1.0)]
    return StrainMap(
        plate.mark,
        mode,
        flat,
        values,
        outline,
        np.stack(ends, axis=1),
        ColourScale(0.0, float(np.abs(values).max())),
    )
