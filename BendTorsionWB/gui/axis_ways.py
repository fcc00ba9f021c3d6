# SPDX-License-Identifier: LGPL-2.1-or-later
"""What axes are made of, as picked: curves, points, or plane faces that cut the surface."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui import selection
from BendTorsionWB.objects.containers import sub_shapes

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

MEND = QT_TRANSLATE_NOOP(
    "BendTorsion",
    "select one face or surface, then curves, points or a plane face that cuts the surface",
)


def axis_ways(target, curves, points, faces) -> list[dict]:
    """Arguments of make_axis: one axis per curve, one through the points, or one per plane."""
    if curves:
        return [{"edge": curve} for curve in curves]
    if len(points) > 1:
        return [{"points": [tuple(point) for point in points], "order": "nearest"}]
    planes = [_plane_of(face) for face in faces]
    if planes and all(planes):
        return [{"rule": _section_rule(target, *plane)} for plane in planes]
    raise selection.refusal(
        QT_TRANSLATE_NOOP("BendTorsion", "no curve, no two points and no plane are selected"),
        MEND,
    )


def _plane_of(face) -> tuple | None:
    """A point and the normal of a picked plane face."""
    obj, names = face
    faces = sub_shapes(obj, [names] if names and isinstance(names, str) else [])[0].Faces
    if len(faces) != 1 or faces[0].Surface.TypeId != "Part::GeomPlane":
        return None
    return tuple(faces[0].CenterOfMass), tuple(faces[0].normalAt(0.0, 0.0))


def _section_rule(target, origin, normal) -> dict:
    """The plane section of a surface, between the ends of the longest curve the kernel finds."""
    obj, names = target if isinstance(target, tuple) else (target, "")
    shape = sub_shapes(obj, [names] if names and isinstance(names, str) else [])[0]
    direction = FreeCAD.Vector(*normal)
    wires = shape.slice(direction, direction.dot(FreeCAD.Vector(*origin)))
    if not wires:
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "the plane does not cut the surface"),
            QT_TRANSLATE_NOOP("BendTorsion", "move the plane"),
        )
    wire = max(wires, key=lambda item: item.Length)
    edges = wire.OrderedEdges
    start = edges[0].valueAt(edges[0].FirstParameter)
    ends = [start, *(vertex.Point for vertex in wire.OrderedVertexes)]
    return {
        "kind": "plane section",
        "origin": tuple(origin),
        "normal": tuple(normal),
        "start": tuple(ends[1]),
        "end": tuple(ends[-1]),
    }
