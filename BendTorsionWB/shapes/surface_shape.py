# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part shapes that show an analytic surface in the model; members never read them."""

from __future__ import annotations

import math
from collections.abc import Mapping

import FreeCAD
import Part

SHOWN = 20000.0
"""Half size, mm, of the piece shown of an endless surface."""


def shape(
    kind: str,
    sizes: Mapping[str, float],
    origin: tuple[float, float, float],
    face: Part.Shape | None = None,
) -> Part.Shape:
    """A face (or faces) showing the surface; sizes in mm and rad, `face` for kind `face`."""
    if face is not None:
        return face
    made = _MAKERS[kind](sizes)
    made.translate(FreeCAD.Vector(*origin))
    return made


def _ellipsoid(sizes):
    stretch = FreeCAD.Matrix()
    stretch.scale(sizes["a"], sizes["b"], sizes["c"])
    # In halves: the kernel makes no triangles of a whole one with unequal axes, and it is not seen.
    unit = Part.Sphere()
    unit.Radius = 1.0
    pole = 0.5 * math.pi
    halves = [unit.toShape(start, start + math.pi, -pole, pole) for start in (0.0, math.pi)]
    return Part.Compound([half.transformGeometry(stretch) for half in halves])


def _sphere(sizes):
    return Part.makeSphere(sizes["r"]).Faces[0]


def _cylinder(sizes):
    low = FreeCAD.Vector(0, 0, -SHOWN)
    return Part.makeCylinder(sizes["r"], 2 * SHOWN, low).Faces[0]


def _cone(sizes):
    slope = math.tan(sizes["angle"])
    ends = sorted((-sizes["r"] / slope, math.copysign(SHOWN, slope)))
    low, high = (max(-SHOWN, min(SHOWN, end)) for end in ends)
    radii = (max(0.0, sizes["r"] + z * slope) for z in (low, high))
    return Part.makeCone(*radii, high - low, FreeCAD.Vector(0, 0, low)).Faces[0]


def _torus(sizes):
    return Part.makeTorus(sizes["R"], sizes["r"]).Faces[0]


def _plane(sizes):
    low = FreeCAD.Vector(-SHOWN, -SHOWN, 0)
    return Part.makePlane(2 * SHOWN, 2 * SHOWN, low)


_MAKERS = {
    "ellipsoid": _ellipsoid,
    "sphere": _sphere,
    "cylinder": _cylinder,
    "cone": _cone,
    "torus": _torus,
    "plane": _plane,
}
