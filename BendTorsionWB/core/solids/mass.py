# SPDX-License-Identifier: LGPL-2.1-or-later
"""Centres of gravity and surfaces of solids, from the very faces they are written with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from ..geometry.vectors import crossed
from ..members.cells import SectionLaw
from ..members.skin import SkinPiece, values_and_rates
from ..members.strips import StripRails
from ..plates.flat_plate import FlatPlate
from ..plates.plates import Plate
from ..sections.section import Section

# First moments are polynomials of degree 11 along the splines and 3 across: exact with these.
_ALONG = np.polynomial.legendre.leggauss(6)
_ACROSS = np.polynomial.legendre.leggauss(2)


@dataclass(frozen=True, eq=False)
class SolidFigures:
    """volume mm3; centre (3,) of gravity, mm; face_areas (m,) of the ruled faces between rails j
    and j + 1, mm2; end_areas of the two caps."""

    volume: float
    centre: np.ndarray
    face_areas: np.ndarray
    end_areas: tuple[float, float]

    @property
    def surface(self) -> float:
        """Area of the whole solid, mm2."""
        return float(self.face_areas.sum()) + sum(self.end_areas)


def solid_figures(tubes: Sequence[Sequence[SkinPiece]]) -> list[SolidFigures]:
    """Figures of the solids written from skins whose rails, of one number, are in ring order.

    Volume and first moments by Gauss's theorem, ∫x_i dV = ½∮x_i² n_i dA, taken about the middle of
    the end rings; end rings are plane.
    """
    if not tubes:
        return []
    pieces = [piece for tube in tubes for piece in tube]
    nodes, weights = [], []
    for piece in pieces:
        breaks = piece.knots[3:-3]
        half, middle = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
        nodes.append((middle[:, None] + half[:, None] * _ALONG[0]).ravel())
        weights.append((half[:, None] * _ALONG[1]).ravel())
    found = values_and_rates(pieces, nodes)
    values, rates = (np.concatenate([pair[k] for pair in found]) for k in (0, 1))
    rings = np.array([[tube[0].poles[:, 0], tube[-1].poles[:, -1]] for tube in tubes])
    counts = iter(map(len, nodes))
    counts = np.array([sum(next(counts) for _ in tube) for tube in tubes])
    return _figures(values, rates, np.concatenate(weights), rings, counts)


def _figures(values, rates, along, rings, counts) -> list[SolidFigures]:
    """Of tubes with `counts` places each, (n, m, 3), and end rings (tubes, 2, m, 3)."""
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    middle = rings.mean(axis=(1, 2))
    rings = rings - middle[:, None, None]
    values = values - np.repeat(middle, counts, axis=0)[:, None]
    across, spread = np.roll(values, -1, axis=1) - values, np.roll(rates, -1, axis=1) - rates
    volume, first, areas = 0.0, 0.0, 0.0
    for w, part in zip(0.5 + 0.5 * _ACROSS[0], 0.5 * _ACROSS[1], strict=True):
        point = values + w * across
        normal = crossed(rates + w * spread, across)
        weight = part * along[:, None]
        flux = normal * point
        volume += (weight * flux.sum(axis=2)).sum(axis=1) / 3.0
        first += 0.5 * (weight[..., None] * flux * point).sum(axis=1)
        areas += weight * np.sqrt((normal * normal).sum(axis=2))
    volume, first, areas = (np.add.reduceat(part, starts) for part in (volume, first, areas))
    # A fan of triangles about each ring's middle: ∫x² over each from its three mid-sides.
    hub = rings.mean(axis=2)[:, :, None]
    following = np.roll(rings, -1, axis=2)
    corners = np.stack([np.broadcast_to(hub, rings.shape), rings, following])
    vector = 0.5 * crossed(rings - hub, following - hub)
    sides = 0.5 * (corners + np.roll(corners, -1, axis=0))
    sign = np.array([1.0, -1.0])
    volume = volume + ((vector * hub).sum(axis=(2, 3)) * sign).sum(axis=1) / 3.0
    moment = (vector * (sides**2).mean(axis=0)).sum(axis=2) * sign[:, None]
    first = first + 0.5 * moment.sum(axis=1)
    whole = vector.sum(axis=2)
    ends = np.sqrt((whole * whole).sum(axis=2))
    return [
        SolidFigures(abs(float(v)), f / v + m, a, tuple(e))
        for v, f, m, a, e in zip(volume, first, middle, areas, ends.tolist(), strict=True)
    ]


_figures_of: WeakKeyDictionary[StripRails, SolidFigures] = WeakKeyDictionary()
"""Figures of plates that live; an edit leaves most rails as they are."""


@dataclass(frozen=True, eq=False)
class PlateFigures:
    """Per plate the figures of its solid and its painted area, mm2; centre (3,) of all, mm."""

    solids: tuple[SolidFigures, ...]
    painted: tuple[float, ...]
    centre_of_gravity: np.ndarray


def plate_figures(
    section: Section, plates: Sequence[Plate], skins: Sequence[Sequence[SkinPiece]]
) -> PlateFigures:
    """The figures of plates with the skins of their solids, of cut plates of what is left."""
    square = {
        plate.rails: skin for plate, skin in zip(plates, skins, strict=True) if not plate.is_cut
    }
    new = {rails: skin for rails, skin in square.items() if rails not in _figures_of}
    _figures_of.update(zip(new, solid_figures([*new.values()]), strict=True))
    solids = [plate.figures if plate.is_cut else _figures_of[plate.rails] for plate in plates]
    painted = painted_areas(section, [plate.strip for plate in plates], solids)
    masses = [plate.volume * plate.material.density for plate in plates]
    centre = sum(mass * own.centre for mass, own in zip(masses, solids, strict=True)) / sum(masses)
    return PlateFigures(tuple(solids), tuple(painted), centre)


def skin_area(law: SectionLaw, tubes: Sequence[Sequence[SkinPiece]]) -> float:
    """Area, mm2, of a member seen from outside, ends apart: the outer skin of a closed section, of
    an open one its strips (`painted_areas`), in tubes strip by strip between their joints."""
    section, figures = law.sections[0], solid_figures(tubes)
    if section.closed:
        return float(sum(own.face_areas.sum() for own in figures))
    strips = [k for k in range(len(section.strips)) for _ in range(len(law.joints_of(k)) + 1)]
    return sum(painted_areas(section, strips, figures))


def painted_areas(section: Section, strips: Sequence[int], figures) -> list[float]:
    """Area, mm2, of each plate (its strip and SolidFigures) that is seen from outside and painted.

    Of a closed section its outer face, and its edges that run to the corner past a neighbour. Of
    an open section both faces and its free edges; what an edge against another plate covers there
    is taken off the plate with the edge. Ends, which are welded, are not painted.
    """
    areas = []
    for index, own in zip(strips, figures, strict=True):
        strip = section.strips[index]
        outer, second, inner, first = own.face_areas
        area = outer if section.closed else outer + inner
        for edge, stop in ((first, strip.stops_at_first), (second, strip.stops_at_second)):
            if stop is None or (section.closed and stop.at == "outer"):
                area += edge
            elif not section.closed:
                area -= edge
        areas.append(float(area))
    return areas


def net_figures(
    figures: PlateFigures, plates: Sequence[Plate], flats: Sequence[FlatPlate]
) -> PlateFigures:
    """The figures of whole plates with centres of gravity as their openings leave them, and that
    of all plates with the flat parts."""
    solids = tuple(
        replace(own, centre=_net_centre(plate, own.centre))
        for own, plate in zip(figures.solids, plates, strict=True)
    )
    masses = [plate.net_volume * plate.material.density for plate in plates]
    pairs = [
        *zip(masses, (own.centre for own in solids), strict=True),
        *((flat.mass, flat.centre_of_gravity) for flat in flats),
    ]
    centre = sum(mass * own for mass, own in pairs) / sum(mass for mass, _ in pairs)
    return replace(figures, solids=solids, centre_of_gravity=centre)


def _net_centre(plate: Plate, centre: np.ndarray) -> np.ndarray:
    if not plate.openings:
        return centre
    moment = plate.volume * centre
    for opening in plate.openings:
        moment = moment - opening.volume * opening.centre
    return moment / plate.net_volume
