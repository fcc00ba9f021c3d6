# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a finding is: the objects, faces and edges it is about, and the point in space."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.gui.tree import LINKED_ABOVE
from BendTorsionWB.shapes.brep import as_built

_S = re.compile(r"\bs (?:= |near )(-?[\d.]+)(?: to (-?[\d.]+))?")
_XYZ = re.compile(r"x(?:, y, z)? = (-?[\d.]+), (?:y = )?(-?[\d.]+), (?:z = )?(-?[\d.]+)")
_LONG_EDGE = re.compile(r"^(?:first|second) (\S+), (-?[\d.]+) to (-?[\d.]+) mm on the axis")
_END = re.compile(r"^(start|end) E-\d")
_FACE = re.compile(r"\bface (\S+?)(?:,|$)")
_ROW = re.compile(r"^edge (\d+)$")
_JOINT = re.compile(r"^(\S+)/(\S+)$")


def places_of(
    document, obj, finding: Finding
) -> tuple[list[tuple[object, str]], FreeCAD.Vector | None]:
    """What a finding, found on `obj`, is about: (object, sub-element), '' for a whole object; and
    where it is, None when its position names no place."""
    at = place_on_axis(obj, finding)
    for plates in document.Objects:
        if getattr(plates, "BT_Type", "") == "PlateSet" and finding.object in plates.Marks:
            return _nearest(plates, _of_mark(plates, finding), at or _along_edge(plates, finding))
    named = [item for item in document.Objects if item.Label in finding.objects] or [obj]
    if len(named) == 1:
        for plates in _plates_of(named[0]):
            if names := _of_member(plates, finding):
                return [(plates, name) for name in names], at or _along_row(plates, finding)
    return [(item, "") for item in named], at


def place_on_axis(obj, finding: Finding) -> FreeCAD.Vector | None:
    """Where in space a position says a finding is: coordinates, or the arc length, or the middle of
    two, on the axis of its object; None when it names neither."""
    at = _XYZ.search(finding.position)
    if at:
        return FreeCAD.Vector(*map(float, at.groups()))
    at = _S.search(finding.position)
    if at is None:
        return None
    first, last = float(at[1]), float(at[2] or at[1])
    return _at(obj, 0.5 * (first + last))


def _at(obj, s: float) -> FreeCAD.Vector | None:
    """The point of an object's axis at arc length s, mm."""
    from BendTorsionWB.objects import axis as axis_object

    axis = _axis_of(obj)
    if axis is None:
        return None
    try:
        core = axis_object.value(axis)
    except BendTorsionError:
        return None
    s = min(max(s, 0.0), core.length)
    return FreeCAD.Vector(*map(float, core.position(np.array([s]))[0]))


def _axis_of(obj):
    while obj is not None and getattr(obj, "BT_Type", "") in LINKED_ABOVE:
        obj = getattr(obj, LINKED_ABOVE[obj.BT_Type])
    kind = getattr(obj, "BT_Type", "")
    return obj.Axis if kind == "Member" else obj if kind == "Axis" else None


def _plates_of(obj) -> list:
    """The plates of a member, or those given."""
    users = [obj, *obj.InList] if getattr(obj, "BT_Type", "") in ("Member", "PlateSet") else []
    return [item for item in users if getattr(item, "BT_Type", "") == "PlateSet"]


def _named(plates, wanted: Sequence[tuple[str, str]]) -> list[str]:
    """Names of the faces of plates with a (mark, role), whatever its count; none where they cannot
    be told."""
    from BendTorsionWB import make
    from BendTorsionWB.shapes import roles

    try:
        table = make.roles_of(plates)
    except BendTorsionError:
        return []
    return [
        name
        for name, (mark, role) in table.items()
        if name.startswith("Face") and (mark, roles.base(role)) in wanted
    ]


def _of_mark(plates, finding: Finding) -> list[str]:
    """The faces of a plate's edge or end that a position names, else its outer faces."""
    mark = finding.object
    edge, end = _LONG_EDGE.match(finding.position), _END.match(finding.position)
    role = f"edge {edge[1]}" if edge else f"end {end[1]}" if end else "outer"
    return _named(plates, [(mark, role)]) or _named(plates, [(mark, "outer"), (mark, "side start")])


def _along_edge(plates, finding: Finding) -> FreeCAD.Vector | None:
    """The point of the axis beside the stretch of an edge."""
    edge = _LONG_EDGE.match(finding.position)
    return _at(plates, 0.5 * (float(edge[2]) + float(edge[3]))) if edge else None


def _nearest(plates, names: Sequence[str], at: FreeCAD.Vector | None):
    """The faces, and the place on them: of those of a long edge between folds, the one beside the
    place."""
    if not names:
        return [(plates, "")], at
    built = as_built(plates.Shape)
    faces = [(built.getElement(name), name) for name in names]
    if at is None:
        return [(plates, name) for name in names], None
    found = [(*face.distToShape(Part.Vertex(at))[:2], name) for face, name in faces]
    _, points, name = min(found, key=lambda one: one[0])
    return [(plates, name)], points[0][0]


def _of_member(plates, finding: Finding) -> list[str]:
    """The faces of plates that a position on a member names: those of a face of the box, at a
    place when there is one, or those that a row of edges joins."""
    row = _row(plates, finding)
    if row is not None:
        return _named(plates, list(_joined(plates, row)))
    face = _FACE.search(finding.position)
    if face is None:
        return []
    at = _S.search(finding.position)
    first = float(at[1]) if at else -np.inf
    last = float(at[2] or at[1]) if at else np.inf
    return _named(
        plates,
        [
            (plate.mark, "outer")
            for plate in _plates(plates)
            if plate.face == face[1] and plate.start - 1.0 <= last and first <= plate.end + 1.0
        ],
    )


def _plates(plates) -> list:
    """The plates as they are computed; none in an error."""
    from BendTorsionWB.objects import plate_set

    try:
        return [item.plate for item in plate_set.value(plates).plates]
    except BendTorsionError:
        return []


def _row(plates, finding: Finding):
    """The row of edges a position counts, in mm of the axis; None when it counts none."""
    from BendTorsionWB.objects import plate_set

    number = _ROW.match(finding.position)
    axis = _axis_of(plates)
    if number is None or axis is None or not plates.Marks:
        return None
    try:
        rows = plate_set.value(plates).given.edges
    except BendTorsionError:
        return None
    k = int(number[1]) - 1
    return rows[k].on(axis.Length.Value) if 0 <= k < len(rows) else None


def _joined(plates, row) -> Iterator[tuple[str, str]]:
    """(mark, role) of the narrow faces of plates that a row of edges joins: along a seam, or at a
    joint."""
    own = [plate for plate in _plates(plates) if plate.start < row.end and row.start < plate.end]
    joint = _JOINT.match(row.where)
    if joint:
        for plate in own:
            for short, role in zip(joint.groups(), ("end end", "end start"), strict=True):
                if plate.mark.endswith(f"-{short}"):
                    yield plate.mark, role
        return
    faces = {plate.letter: plate.face for plate in own}
    beside = [faces.get(letter) for letter in row.where]
    if len(beside) == 2:
        for plate in own:
            for face, other in (beside, reversed(beside)):
                if plate.face == face:
                    yield plate.mark, f"edge {other}"


def _along_row(plates, finding: Finding) -> FreeCAD.Vector | None:
    """The middle of the stretch a row of edges is for; None where it is for all of the member."""
    row, axis = _row(plates, finding), _axis_of(plates)
    if row is None or (row.start <= 0.0 and row.end >= axis.Length.Value):
        return None
    return _at(plates, 0.5 * (row.start + row.end))
