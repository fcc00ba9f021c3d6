# SPDX-License-Identifier: LGPL-2.1-or-later
"""What laying plates flat costs, by kind, and where the stations of two plates miss each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..flattening.development import Development, flat_area
from ..flattening.measure import PanelSamples
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..lofting import DevelopedPlate, FlatteningErrors, PanelMeasure, StationLine

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


def flattening_errors(
    development: Development,
    samples: PanelSamples,
    lines: Sequence[StationLine],
    panels: Sequence[PanelMeasure],
) -> FlatteningErrors:
    """Errors of one plate; those along seams need its neighbours (with_seams)."""
    by_what: dict[str, list[float]] = {}
    for panel in panels:
        by_what.setdefault(panel.what, []).append(panel.flat - panel.arc)
    edges = [each for what, each in by_what.items() if what.startswith("edge")]
    diagonals = [each for what, each in by_what.items() if what.startswith("diagonal")]
    flat, true = _centre_line(development, samples)
    return FlatteningErrors(
        edge=_largest([*(e for each in edges for e in each), *map(sum, edges)]),
        line=_largest([line.length_flat - line.length_3d for line in lines]),
        diagonal=_largest([e for each in diagonals for e in each]),
        centre_line=flat - true,
        area=flat_area(development) - curved_area(development.surface),
    )


def _centre_line(development: Development, samples: PanelSamples) -> tuple[float, float]:
    """Flat and true length of the line half way between the edges, by quadrature; of a corrected
    pattern measured between the lines."""
    if development.correction is not None:
        return tuple(float(lengths.sum()) for lengths in samples.edge(0.5))
    plane, slope = development.plane.values, development.plane.derivative.values
    angle = plane[..., 2]
    cos, sin = np.cos(angle.copy()), np.sin(angle.copy())
    along = cos * slope[..., 0] + sin * slope[..., 1] - 0.5 * plane[..., 3] * slope[..., 2]
    slip = cos * slope[..., 1] - sin * slope[..., 0] + 0.5 * slope[..., 3]
    rate = development.surface.derivative.values
    tangent = 0.5 * (rate[..., :3] + rate[..., 3:])
    speeds = [np.sqrt(along**2 + slip**2), np.sqrt((tangent * tangent).sum(axis=2))]
    both = Piecewise(development.plane.breaks, np.stack(speeds, axis=2)).integral()
    return float(both[0]), float(both[1])


def _largest(errors: Sequence[float]) -> float:
    """The error largest in size, with its sign."""
    return float(max(errors, key=abs, default=0.0))


def curved_area(rails: Piecewise) -> float:
    """Area, mm2, of the ruled surface between rails s -> (6,), by Gauss quadrature across."""
    value, rate = rails.values, rails.derivative.values
    ruling = value[..., 3:] - value[..., :3]
    first = crossed(rate[..., :3], ruling)
    turn = crossed(rate[..., 3:], ruling) - first
    a, b, c = (
        (one * two).sum(axis=2) for one, two in ((first, first), (first, turn), (turn, turn))
    )
    width = 0.0
    for node, weight in zip(0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS, strict=True):
        width = width + weight * np.sqrt(a + 2.0 * node * b + node * node * c)
    return float(Piecewise(rails.breaks, width[..., None]).integral()[0])


def _dots(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a * b).sum(axis=2)


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
