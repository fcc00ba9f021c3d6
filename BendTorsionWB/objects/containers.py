# SPDX-License-Identifier: LGPL-2.1-or-later
"""Containers with a Placement (App::Part, a body), and document coordinates in spite of them.

FreeCAD touches nothing in a container that is moved, nor what uses something in it.
"""

from __future__ import annotations

import FreeCAD
import Part

DIGITS = 9
"""Of millimetres and quaternions: a file keeps the last bits of neither."""


def in_document(obj) -> bool:
    """Whether an object is in its document still; an undo, or a deletion, takes it out."""
    try:
        # None of one that is out from FreeCAD 1.0 on, before that an error.
        return obj.Name is not None
    except RuntimeError:
        return False


def outer_placement(obj) -> FreeCAD.Placement:
    """The place of the containers an object is in, in the document; links, which have no global
    placement of their own before FreeCAD 1.0, as well."""
    place = FreeCAD.Placement()
    holder = obj.getParentGeoFeatureGroup()
    while holder is not None:
        place = getattr(holder, "Placement", FreeCAD.Placement()).multiply(place)
        holder = holder.getParentGeoFeatureGroup()
    return place


def places_used(obj) -> str:
    """Where the containers stand that an object and all it uses are in; empty when nowhere else
    than the document."""
    # While something is deleted the window asks what used it.
    there = [one for one in (obj, *obj.OutList) if in_document(one)]
    places = {one.Name: outer_placement(one) for one in there}
    return "; ".join(
        f"{name} {_numbers(place)}"
        for name, place in sorted(places.items())
        if not place.isIdentity()
    )


def _numbers(place: FreeCAD.Placement) -> str:
    numbers = (*place.Base, *place.Rotation.Q)
    return " ".join(f"{round(number, DIGITS) + 0.0:.12g}" for number in numbers)


def sub_shapes(obj, names) -> list[Part.Shape]:
    """The sub-shapes of an object or link by these names, the whole shape when there are none, in
    document coordinates. Raises what FreeCAD does for names that are none."""
    shapes = [obj.Shape.getElement(name) for name in names] or [obj.Shape]
    shapes = [shape.copy() for shape in shapes]
    outer = outer_placement(obj)
    for shape in shapes:
        shape.Placement = outer.multiply(shape.Placement)
    return shapes
