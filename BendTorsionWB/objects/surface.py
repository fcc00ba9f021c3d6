# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Surface: an architectural surface, analytic or a Part face."""

from __future__ import annotations

import math

import Part

from BendTorsionWB.core.axes.surface_check import size_findings
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.geometry import surface as core_surface
from BendTorsionWB.objects.containers import sub_shapes
from BendTorsionWB.objects.proxy import Property, Proxy, check_linked, type_of
from BendTorsionWB.shapes import from_part, surface_shape

KINDS = (*core_surface.KINDS, "face")
_LENGTH = "App::PropertyLength"
_DISTANCE = "App::PropertyDistance"


class Surface(Proxy):
    """The surface members follow: its outward normals turn their sections."""

    TYPE = "Surface"
    PROPERTIES = (
        Property(
            "App::PropertyEnumeration", "Kind", "Surface", "Kind of surface", "ellipsoid", KINDS
        ),
        Property(
            "App::PropertyLinkSub",
            "Source",
            "Surface",
            "The face, or a whole shape of faces, for kind `face`",
        ),
        Property(_LENGTH, "a", "Surface", "Half-axis along x (ellipsoid)", 40000.0),
        Property(_LENGTH, "b", "Surface", "Half-axis along y (ellipsoid)", 30000.0),
        Property(_LENGTH, "c", "Surface", "Half-axis along z (ellipsoid)", 20000.0),
        Property(_LENGTH, "R", "Surface", "Radius of the circle the tube follows (torus)", 0.0),
        Property(
            _LENGTH, "r", "Surface", "Radius (sphere, cylinder, cone at z = 0, torus tube)", 0.0
        ),
        Property("App::PropertyAngle", "angle", "Surface", "Half angle (cone)", 0.0),
        Property(_DISTANCE, "x", "Surface", "Origin", 0.0),
        Property(_DISTANCE, "y", "Surface", "Origin", 0.0),
        Property(_DISTANCE, "z", "Surface", "Origin", 0.0),
        Property(_DISTANCE, "Offset", "Surface", "Distance along the outward normals", 0.0),
        Property("App::PropertyBool", "Flip", "Surface", "Reverse the outward side", False),
    )

    def build(self, obj):
        surface = value(obj)
        shown = surface_shape.shape(obj.Kind, _sizes(obj), _origin(obj), source_shape(obj))
        # FreeCAD puts a shape it is given where the object is, whatever place the shape has.
        obj.Placement = obj.Placement.multiply(shown.Placement)
        obj.Shape = shown
        return size_findings(surface, obj.Label)


def value(obj) -> core_surface.Surface:
    """The core surface of a Surface object; raises BendTorsionError for what it cannot be."""
    if obj.Kind != "face":
        return core_surface.analytic_surface(
            obj.Kind, _sizes(obj), _origin(obj), obj.Offset.Value, obj.Flip, obj.Label
        )
    surface = from_part.surface_from_part(source_shape(obj), obj.Label)
    if obj.Flip:
        surface = core_surface.Flipped(surface)
    if obj.Offset.Value:
        surface = core_surface.Offset(surface, obj.Offset.Value)
    return surface


def source_shape(obj) -> Part.Shape | None:
    """The picked face (or whole shape) in document coordinates, for kind `face`."""
    if obj.Kind != "face":
        return None
    if obj.Source is None:
        raise BendTorsionError(
            error(
                "link-missing",
                obj.Label,
                "the face is not set",
                "choose a face",
                position="property Source",
            )
        )
    return picked_shape(obj, obj.Source, "face")


def picked_shape(obj, source, what: str) -> Part.Shape:
    """The sub-shape of a LinkSub (object, (names…)) in document coordinates."""
    target, names = source
    shown = target.getLinkedObject()
    if type_of(shown):
        check_linked(shown)
    if not hasattr(target, "Shape") or target.Shape.isNull():
        raise BendTorsionError(
            error(
                "source-without-shape",
                obj.Label,
                f"{target.Label} has no shape",
                f"choose a {what}",
                position="property Source",
            )
        )
    names = [name for name in names if name]
    try:
        shapes = sub_shapes(target, names)
    except Exception as problem:
        raise BendTorsionError(
            error(
                "source-lost",
                obj.Label,
                f"{target.Label} no longer has {' '.join(names)}",
                f"choose the {what} again",
                position="property Source",
            )
        ) from problem
    return shapes[0] if len(shapes) == 1 else Part.Compound(shapes)


def _sizes(obj) -> dict[str, float]:
    if obj.Kind == "face":
        return {}
    sizes = {}
    for name in core_surface.parameter_names(obj.Kind):
        quantity = getattr(obj, name)
        sizes[name] = math.radians(quantity.Value) if name == "angle" else quantity.Value
    return sizes


def _origin(obj) -> tuple[float, float, float]:
    return obj.x.Value, obj.y.Value, obj.z.Value
