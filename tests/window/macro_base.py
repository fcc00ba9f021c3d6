# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shapes the macro of macro_session starts from, made alike with and without a window."""

import math

import FreeCAD
import Part


def base(name):
    """A document with a ball and three arcs on it, two of which run to the same place."""
    document = FreeCAD.newDocument(name)
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 20000
    centre = FreeCAD.Vector()
    arcs = (
        Part.makeCircle(20000, centre, FreeCAD.Vector(0, 10, 30), 20, 45),
        Part.makeCircle(20000, centre, FreeCAD.Vector(0, 25, 30), 20, 45),
    )
    for k, arc in enumerate(arcs, start=1):
        document.addObject("Part::Feature", f"Arc{k}").Shape = arc
    # From the middle of the first arc across it, in the plane through the centre.
    middle = arcs[0].valueAt(0.5 * (arcs[0].FirstParameter + arcs[0].LastParameter))
    along = arcs[0].tangentAt(0.5 * (arcs[0].FirstParameter + arcs[0].LastParameter))
    across = Part.Arc(middle, _on(middle, along, 0.12), _on(middle, along, 0.24)).toShape()
    document.addObject("Part::Feature", "Branch").Shape = across
    document.recompute()
    return document


def _on(point, normal, angle):
    """A point of the ball turned about an axis through its centre."""
    return FreeCAD.Rotation(normal, math.degrees(angle)).multVec(point)


def figures(document):
    """By label: the kind of each object of ours, its status and its size."""
    found = {}
    for item in document.Objects:
        if hasattr(item, "BT_Type") and item.BT_Type not in ("PageOutlines", "PageSymbol"):
            shape = getattr(item, "Shape", None)
            size = 0.0
            if shape is not None and not shape.isNull():
                size = shape.Volume or shape.Area or shape.Length
            found[item.Label] = [item.BT_Type, item.Status, size]
    return found
