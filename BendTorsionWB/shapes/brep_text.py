# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact shapes written as B-rep text, which the kernel parses and neither fits, sews nor orients.

The text is Open CASCADE's ASCII form ("BRep Format" in its documentation), version 1.
"""

from __future__ import annotations

import FreeCAD  # noqa: F401  (Part needs it loaded first)
import Part

TOLERANCE = 1e-7
"""mm: of vertices, edges and faces as written (the kernel's own confusion distance)."""

_VERTEX = "Ve\n%r\n%s\n0 0\n\n0101101\n*\n"
_EDGE = "Ed\n 1e-07 1 1 0\n1 %d 0 %s\n%s0\n\n0101000\n+%d 0 -%d 0 *\n"
_WIRE = "Wi\n\n0101100\n%s*\n"
_FACE = "Fa\n0 1e-07 %d 0\n\n0101000\n%s*\n"
_COMPOUND = "Co\n\n1100000\n%s*\n"


class BrepText:
    """The tables of one text. Shapes are numbered downwards from their total, known beforehand;
    the last one is what is parsed."""

    def __init__(self, total: int):
        self.total = total
        self.pcurves, self.curves, self.surfaces, self.shapes = [], [], [], []

    def whole(self) -> str:
        """The text."""
        return "".join(
            [
                "\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\n",
                f"Curve2ds {len(self.pcurves)}\n",
                *self.pcurves,
                f"Curves {len(self.curves)}\n",
                *self.curves,
                "Polygon3D 0\nPolygonOnTriangulations 0\n",
                f"Surfaces {len(self.surfaces)}\n",
                *self.surfaces,
                f"Triangulations 0\n\nTShapes {self.total}\n",
                *self.shapes,
                "\n+1 0 \n",
            ]
        )

    def parsed(self) -> Part.Shape:
        """The shape."""
        shape = Part.Shape()
        shape.importBrepFromString(self.whole(), False)
        return shape

    def shape(self, text: str) -> int:
        """Append a shape; its number."""
        self.shapes.append(text)
        return self.total - len(self.shapes) + 1

    def surface(self, text: str) -> int:
        """Append a surface; its number."""
        self.surfaces.append(text)
        return len(self.surfaces)

    def vertex(self, point: str, tolerance: float = TOLERANCE) -> int:
        """A vertex; point: its coordinates."""
        return self.shape(_VERTEX % (tolerance, point))

    def edge(self, curve: str, limits: str, traces: list, start: int, end: int) -> int:
        """An edge. traces: (pcurve text, surface number) on each face it bounds but for planes."""
        self.curves.append(curve)
        lines = []
        for pcurve, surface in traces:
            self.pcurves.append(pcurve)
            lines.append(f"2 {len(self.pcurves)} {surface} 0 {limits}\n")
        return self.shape(_EDGE % (len(self.curves), limits, "".join(lines), start, end))

    def wire(self, edges: str) -> int:
        """A wire; edges: their numbers with signs, as `+7 0 -5 0 `."""
        return self.shape(_WIRE % edges)

    def face(self, surface: int, wires: str) -> int:
        """A face; wires: their numbers with signs, the outer one first."""
        return self.shape(_FACE % (surface, wires))

    def compound(self, shapes: list[int]) -> int:
        """A compound of shapes."""
        return self.shape(_COMPOUND % "".join(f"+{number} 0 " for number in shapes))
