# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat parts as Part solids, and openings cut out of the solids of plates."""

from __future__ import annotations

from collections.abc import Sequence

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.finding import Finding, error
from BendTorsionWB.core.plates.flat_plate import FlatPlate
from BendTorsionWB.core.plates.plate_places import PlateOpening

VOLUME_RELATIVE = 1e-4
"""Largest relative difference between the steel cut away and the opening's own volume."""

MESH_DEFLECTION = 0.005
"""mm; of meshes volumes of small solids are taken from."""


def flat_solid(flat: FlatPlate) -> Part.Solid:
    """The part's exact solid: outer side faces, hole side faces, then its two plane faces."""
    at = 0.5 * flat.thickness * flat.frame[:3, 2]
    x, y = flat.frame[:3, 0], flat.frame[:3, 1]
    origin = flat.frame[:3, 3] - at
    wires = [_wire(contour, origin, x, y) for contour in (flat.outline, *flat.holes)]
    face = Part.makeFace(wires, "Part::FaceMakerBullseye")
    return face.extrude(_vector(2.0 * at)).Solids[0]


def with_openings(solid: Part.Solid, openings: Sequence[PlateOpening], name: str):
    """The solid without its openings, and the findings on them: cut away must be what each
    opening's own volume says, and what is left valid, closed and in one piece."""
    if not openings:
        return solid, []
    prisms = [_prism(opening) for opening in openings]
    left, findings = _cut(solid, openings, prisms, name, lambda shape: shape.Volume)
    if findings:
        # On long ruled faces the kernel loses some cuts by planes and cylinders, not by splines;
        # its volumes of rational faces are too coarse to judge by, a fine mesh's are not.
        splines = [prism.toNurbs().Solids[0] for prism in prisms]
        left, findings = _cut(solid, openings, splines, name, _mesh_volume)
    return (solid if findings else left), findings


def _cut(solid, openings: Sequence[PlateOpening], prisms, name: str, volume_of):
    """What prisms leave of a solid, and findings where it is not what the openings say."""
    # One operation parts the solid into what stays and what each prism takes.
    _, parts = solid.generalFuse(prisms)
    left = [p for p in parts[0] if not any(p.isSame(q) for own in parts[1:] for q in own)]
    findings: list[Finding] = []
    mend = "move the opening a little, or give it another size"
    for opening, own in zip(openings, parts[1:], strict=True):
        away = sum(volume_of(p) for p in parts[0] if any(p.isSame(q) for q in own))
        if abs(away / opening.volume - 1.0) > VOLUME_RELATIVE:
            findings.append(
                error(
                    "opening-refused",
                    name,
                    "the kernel does not cut the opening as computed",
                    mend,
                    position=opening.label,
                    value=away,
                    limit=opening.volume,
                    unit="mm3",
                )
            )
    if len(left) != 1 or not (left[0].isValid() and left[0].isClosed()):
        message = "the openings do not leave one closed solid"
        findings.append(error("opening-refused", name, message, mend))
    return (left[0] if left else solid), findings


def _mesh_volume(solid: Part.Solid) -> float:
    points, triangles = solid.tessellate(MESH_DEFLECTION)
    at = np.array([tuple(point) for point in points])
    a, b, c = np.moveaxis((at - at.mean(axis=0))[np.array(triangles)], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6.0)


def _prism(opening: PlateOpening) -> Part.Solid:
    spot, (low, high) = opening.spot, opening.reach
    wire = _wire(opening.contour, spot.point + low * spot.normal, spot.x, spot.y)
    return Part.Face(wire).extrude(_vector((high - low) * spot.normal)).Solids[0]


def _wire(contour: np.ndarray, origin: np.ndarray, x: np.ndarray, y: np.ndarray) -> Part.Wire:
    """A closed contour of lines and arcs in the plane through origin, spanned by x and y."""

    def place(point) -> FreeCAD.Vector:
        return _vector(origin + point[0] * x + point[1] * y)

    edges = []
    for start, end in zip(contour, np.roll(contour, -1, axis=0), strict=True):
        a, b, bulge = start[:2], end[:2], start[2]
        if abs(bulge) < 1e-9:
            edges.append(Part.LineSegment(place(a), place(b)).toShape())
            continue
        # The arc's middle: half the chord times the bulge to the right of the chord.
        right = np.array([(b - a)[1], -(b - a)[0]])
        middle = 0.5 * (a + b) + 0.5 * bulge * right
        edges.append(Part.Arc(place(a), place(middle), place(b)).toShape())
    return Part.Wire(edges)


def _vector(point: np.ndarray) -> FreeCAD.Vector:
    return FreeCAD.Vector(*map(float, point))
