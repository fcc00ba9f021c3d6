# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties of a section from its strips: area, inertia, torsion, mass, paint, slenderness.

Area and second moments are those of the plates as cut, root gaps left out. mm, kg, rad.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .section import Section
from .strip_lines import crossing, own_lines, section_polygons, section_site, strip_table

EPSILON_YIELD = 235.0
"""Yield strength, MPa, that ε = √(235/fy) refers to."""


@dataclass(frozen=True)
class SectionProperties:
    """About axes through the centroid, parallel to y and z unless said otherwise.

    area mm2; centroid (y, z) mm in section coordinates; iy = ∫z²dA, iz = ∫y²dA, iyz = ∫yz dA,
    principal i1 >= i2, mm4; angle from +y to axis 1 towards +z, rad, in (−π/2, π/2]; torsion
    constant j mm4; mass_per_length kg/mm; painted_area mm2/mm, of a closed section outside only.
    """

    area: float
    centroid: tuple[float, float]
    iy: float
    iz: float
    iyz: float
    i1: float
    i2: float
    angle: float
    j: float
    mass_per_length: float
    painted_area: float


def section_properties(section: Section) -> SectionProperties:
    """The properties of a section.

    j: Bredt's 4A²/∮ds/t along the middle lines of a closed section, Σ bt³/3 over the strips of an
    open one.
    """
    plates = section_polygons(section)
    following = np.roll(plates, -1, axis=1)
    cross = plates[..., 0] * following[..., 1] - plates[..., 1] * following[..., 0]
    signs = np.sign(cross.sum(axis=1))
    cross = cross * signs[:, None]
    area = float(cross.sum() / 2.0)
    first = ((plates + following) * cross[..., None]).sum(axis=(0, 1)) / 6.0
    (y, z), (y1, z1) = np.moveaxis(plates, 2, 0), np.moveaxis(following, 2, 0)
    iy = float(((z * z + z * z1 + z1 * z1) * cross).sum() / 12.0)
    iz = float(((y * y + y * y1 + y1 * y1) * cross).sum() / 12.0)
    iyz = float(((y * z1 + 2 * y * z + 2 * y1 * z1 + y1 * z) * cross).sum() / 24.0)
    cy, cz = (first / area).tolist()
    iy, iz, iyz = iy - area * cz * cz, iz - area * cy * cy, iyz - area * cy * cz
    middle, half = 0.5 * (iy + iz), float(np.hypot(0.5 * (iy - iz), iyz))
    # Axis 1 lies where ∫(distance to it)² is largest: tan 2φ = −2 iyz / (iy − iz).
    angle = 0.5 * float(np.arctan2(-2.0 * iyz, iy - iz)) if half > 1e-12 * middle else 0.0
    angle += np.pi if angle < 1e-9 - np.pi / 2 else 0.0
    return SectionProperties(
        area,
        (cy, cz),
        iy,
        iz,
        iyz,
        middle + half,
        middle - half,
        angle,
        _bredt(section) if section.closed else _open_torsion(section, plates),
        area * section.material.density,
        _painted(section, plates),
    )


def _bredt(section: Section) -> float:
    table, site = strip_table(section.strips), section_site(section)
    count = len(section.strips)
    k = np.arange(count)
    middle = own_lines(table, site[np.zeros(count, int)], k, np.full(count, 0.5))
    ring, thickness = [], []
    for corner in range(len(section.corners)):
        here = [i for i, s in enumerate(section.strips) if corner in (s.first, s.second)]
        one, other = (middle[i : i + 1] for i in here)
        ring.append(crossing(one, other)[0])
        ahead = (corner + 1) % len(section.corners)
        thickness.append(
            next(s.thickness for s in section.strips if {corner, ahead} == {s.first, s.second})
        )
    ring = np.array(ring)
    following = np.roll(ring, -1, axis=0)
    enclosed = 0.5 * (ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]).sum()
    lengths = np.linalg.norm(following - ring, axis=1)
    return float(4.0 * enclosed**2 / (lengths / thickness).sum())


def _open_torsion(section: Section, plates: np.ndarray) -> float:
    thickness = np.array([strip.thickness for strip in section.strips])
    middle = 0.5 * (plates[:, :2] + plates[:, [3, 2]])
    return float((np.linalg.norm(middle[:, 1] - middle[:, 0], axis=1) * thickness**3 / 3.0).sum())


def _painted(section: Section, plates: np.ndarray) -> float:
    if section.closed:
        corners = np.array(section.corners)
        return float(np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1).sum())
    around = np.linalg.norm(np.roll(plates, -1, axis=1) - plates, axis=2)
    # An edge against another plate covers itself and as much of that plate.
    covered = sum(
        2.0 * around[k, side]
        for k, strip in enumerate(section.strips)
        for side, stop in ((3, strip.stops_at_first), (1, strip.stops_at_second))
        if stop is not None
    )
    return float(around.sum() - covered)


@dataclass(frozen=True)
class FlatPart:
    """A flat part of a strip: `internal` between two neighbours or `outstand` beyond one; its
    clear width and thickness, mm."""

    face: str
    kind: str
    width: float
    thickness: float

    @property
    def slenderness(self) -> float:
        """Width over thickness."""
        return self.width / self.thickness


def flat_parts(section: Section) -> tuple[FlatPart, ...]:
    """The parts of all strips between and beyond their neighbours, in strip order."""
    plates = section_polygons(section)
    parts = []
    for k, strip in enumerate(section.strips):
        origin = 0.5 * (plates[k, 0] + plates[k, 3])
        along = 0.5 * (plates[k, 1] + plates[k, 2]) - origin
        width = float(np.linalg.norm(along))
        along = along / width
        supports = []
        for j, other in enumerate(section.strips):
            if j != k and _meet(strip, other):
                supports.append(_support(plates[j] - origin, along))
        supports.sort()
        if not supports:
            parts.append(FlatPart(strip.face, "outstand", width, strip.thickness))
            continue
        pieces = [("outstand", supports[0][0])]
        pieces += [("internal", b[0] - a[1]) for a, b in zip(supports, supports[1:], strict=False)]
        pieces.append(("outstand", width - supports[-1][1]))
        parts += [
            FlatPart(strip.face, kind, float(clear), strip.thickness)
            for kind, clear in pieces
            if clear > strip.thickness
        ]
    return tuple(parts)


def _support(plate: np.ndarray, along: np.ndarray) -> list[float]:
    """From where to where on the line through the origin a neighbour (4, 2) holds it: where the
    line runs through it, else at its two nearest corners."""
    place, off = plate @ along, plate @ np.array([-along[1], along[0]])
    ahead, off_ahead = np.roll(place, -1), np.roll(off, -1)
    through = (off > 0) != (off_ahead > 0)
    if through.any():
        part = off[through] / (off[through] - off_ahead[through])
        return sorted((place[through] + part * (ahead[through] - place[through])).tolist())
    return sorted(place[np.argsort(np.abs(off), kind="stable")[:2]].tolist())


def _meet(one, other) -> bool:
    return bool({one.first, one.second} & {other.first, other.second}) or any(
        stop is not None and stop.face == face
        for strip, face in ((one, other.face), (other, one.face))
        for stop in strip.stops
    )


def slenderness_class(
    part: FlatPart, rules: Mapping[str, Mapping], fy: float, e: float
) -> int | None:
    """Class of a flat part in uniform compression by the rules of a pack (`rules.load`): 1 for the
    first limit it keeps, one more than the last for none, None when the pack has no limits.

    Limits are `slenderness_internal_1` …, `slenderness_outstand_1` …, in units of `eps`
    √(235/fy) or of `sqrt(E/fy)`.
    """
    number = 0
    while rule := rules.get(f"slenderness_{part.kind}_{number + 1}"):
        number += 1
        unit = np.sqrt(EPSILON_YIELD / fy) if rule["unit"] == "eps" else np.sqrt(e / fy)
        if part.slenderness <= float(rule["value"]) * unit:
            return number
    return number + 1 if number else None
