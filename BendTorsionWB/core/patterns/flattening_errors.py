# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the stations of two plates laid flat miss each other, and the worst errors of many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..lofting import DevelopedPlate


def with_seams(plates: Sequence[DevelopedPlate]) -> tuple[DevelopedPlate, ...]:
    """The plates of a member with the largest seam mismatch of each.

    Two plates meet along a seam at the stations they share. Between any two of these, each flat
    edge differs from its formed edge by its own error; the mismatch is the difference of the two
    errors. plates: with edges, whose neighbours are named.
    """
    sides = [[_cumulative(plate, edge) for edge in (0, 1)] for plate in plates]
    worst = [0.0] * len(plates)
    for i, j, edge, other in _pairs(plates):
        one, two = sides[i][edge], sides[j][other]
        common = [s for s in one if s in two]
        if len(common) > 1:
            gaps = [one[s] - two[s] for s in common]
            miss = max(gaps) - min(gaps)
            worst[i], worst[j] = max(worst[i], miss), max(worst[j], miss)
    return tuple(
        plate if plate.errors is None else replace(plate, errors=replace(plate.errors, seam=miss))
        for plate, miss in zip(plates, worst, strict=True)
    )


def worst_errors(plates: Sequence[DevelopedPlate]) -> dict[str, float]:
    """The largest error of each kind among plates, by size."""
    errors = [plate.errors for plate in plates if plate.errors is not None]
    kinds = {
        "EdgeError": "edge",
        "LineError": "line",
        "DiagonalError": "diagonal",
        "CentreLineError": "centre_line",
        "AreaError": "area",
        "SeamMismatch": "seam",
    }
    return {
        name: max((abs(getattr(each, kind)) for each in errors), default=0.0)
        for name, kind in kinds.items()
    }


def _cumulative(plate: DevelopedPlate, edge: int) -> dict[float, float]:
    """Flat minus true length along an edge from the first line to each line, by its s, mm; lines
    of the same station have the same s."""
    name = f"edge {plate.edges[edge].edge}" if plate.edges else ""
    errors = [panel.flat - panel.arc for panel in plate.panels if panel.what == name]
    places = [round(line.s, 6) for line in plate.lines]
    return dict(zip(places, np.concatenate([[0.0], np.cumsum(errors)]).tolist(), strict=False))


def _pairs(plates: Sequence[DevelopedPlate]):
    """(plate, plate, edge, edge) that meet along a seam, each once."""
    for i, one in enumerate(plates):
        for j in range(i + 1, len(plates)):
            two = plates[j]
            if one.s_start >= two.s_end or two.s_start >= one.s_end:
                continue
            for edge, a in enumerate(one.edges):
                for other, b in enumerate(two.edges):
                    met = a.neighbour == two.face and b.neighbour == one.face
                    if met and (one.face != two.face or a.edge == b.edge):
                        yield i, j, edge, other
