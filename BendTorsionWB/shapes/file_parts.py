# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curves and surfaces of a shape from a file: chosen by number in the file's order, or by
name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import FreeCAD  # noqa: F401  Part crashes the interpreter when it is loaded before FreeCAD
import Part

from .iges_names import IgesEntity

_FORMS = {
    "BSplineCurve": "spline",
    "BezierCurve": "spline",
    "BSplineSurface": "spline",
    "BezierSurface": "spline",
    "Toroid": "torus",
    "SurfaceOfRevolution": "revolved",
    "SurfaceOfExtrusion": "extruded",
}
LISTED = 12
"""Parts named in a finding."""


@dataclass(frozen=True)
class FilePiece:
    """A curve or surface of a file: kind `curve` or `surface`, its number among those of its kind
    from 1, and what it is called."""

    kind: str
    number: int
    shape: Part.Shape
    names: tuple[str, ...] = ()

    def told(self) -> str:
        """`curve2 (circle, 138230 mm, RIB)`, `surface1 (sphere, 40000 x 40000 x 20000 mm)`."""
        words = ", ".join([_form(self), _size(self.shape, self.kind), *self.names])
        return f"{self.kind}{self.number} ({words})"


def pieces_of(shape: Part.Shape, named: Sequence[IgesEntity] = ()) -> tuple[FilePiece, ...]:
    """The curves (edges, wires) and surfaces (faces, shells, solids) of a shape, in its order.
    named: what the file calls them, used only where it tells of the same kinds in the same
    order."""
    count = {"curve": 0, "surface": 0}
    pieces = []
    for part in _parts(shape):
        if part.ShapeType == "Vertex":
            continue
        kind = "curve" if part.ShapeType in ("Edge", "Wire") else "surface"
        count[kind] += 1
        pieces.append(FilePiece(kind, count[kind], part))
    if [piece.kind for piece in pieces] != [entity.kind for entity in named]:
        return tuple(pieces)
    return tuple(replace(p, names=entity.names) for p, entity in zip(pieces, named))


def chosen(pieces: Sequence[FilePiece], name: str) -> Part.Shape | None:
    """All pieces of this name, or the one of this kind and number; None without any."""
    called = [piece for piece in pieces if name in piece.names]
    if not called:
        plain = name.lower()
        called = [piece for piece in pieces if plain in [own.lower() for own in piece.names]]
    if not called:
        called = [piece for piece in pieces if f"{piece.kind}{piece.number}" == plain]
    if not called:
        return None
    return called[0].shape if len(called) == 1 else Part.Compound([p.shape for p in called])


def told(pieces: Sequence[FilePiece]) -> str:
    """What there is to choose from, in words."""
    words = "; ".join(piece.told() for piece in pieces[:LISTED])
    return f"{words}; ..." if len(pieces) > LISTED else words or "nothing"


def _parts(shape: Part.Shape) -> list[Part.Shape]:
    if shape.ShapeType != "Compound":
        return [shape]
    return [part for own in shape.SubShapes for part in _parts(own)]


def _form(piece: FilePiece) -> str:
    """What kind of curve or surface: `line`, `circle`, `spline`, `sphere`, ..., `wire`,
    `shell`."""
    shape = piece.shape
    if shape.ShapeType not in ("Edge", "Face"):
        return shape.ShapeType.lower()
    try:
        own = shape.Curve if shape.ShapeType == "Edge" else shape.Surface
    except (Part.OCCError, TypeError, AttributeError):
        return shape.ShapeType.lower()
    name = type(own).__name__
    return _FORMS.get(name, name.lower())


def _size(shape: Part.Shape, kind: str) -> str:
    if kind == "curve":
        return f"{shape.Length:.0f} mm"
    box = shape.BoundBox
    return f"{box.XLength:.0f} x {box.YLength:.0f} x {box.ZLength:.0f} mm"
