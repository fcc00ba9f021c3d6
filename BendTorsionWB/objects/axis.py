# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Axis: a member axis through points, or along a picked curve."""

from __future__ import annotations

import numpy as np

from BendTorsionWB.core import axis as core_axis
from BendTorsionWB.core import detailing, tolerances
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects.proxy import Property, Proxy, linked
from BendTorsionWB.shapes import curve_shape, from_part

FRAMES = ("surface",)
FITS = ("pull", "keep")


class Axis(Proxy):
    """The line a member follows."""

    TYPE = "Axis"
    PROPERTIES = (
        Property("App::PropertyLink", "Surface", "Axis", "The surface that turns the sections"),
        Property("App::PropertyVectorList", "Points", "Axis",
                 "Points in order, mm; used when no curve is picked"),
        Property("App::PropertyLinkSub", "Source", "Axis", "A picked curve, used as it is"),
        Property("App::PropertyEnumeration", "Frame", "Axis",
                 "Where the section's height points: the surface normal", "surface", FRAMES),
        Property("App::PropertyEnumeration", "Fit", "Axis",
                 "pull: the axis through the points is pulled onto the surface; keep: left there",
                 "pull", FITS),
        Property("App::PropertyLength", "Tolerance", "Axis",
                 "A pulled axis leaves the surface by no more than this",
                 tolerances.AXIS_ON_SURFACE),
        Property("App::PropertyLength", "MaxSpacing", "Axis",
                 "Largest distance of control points; 0 for no limit", 0.0),
        Property("App::PropertyLength", "Length", "Result", "Length of the axis", output=True),
        Property("App::PropertyLength", "SurfaceDistanceRMS", "Result",
                 "Root mean square distance of the axis to its surface", output=True),
        Property("App::PropertyLength", "SurfaceDistanceMax", "Result",
                 "Largest distance of the axis to its surface", output=True),
    )

    def build(self, obj):
        axis = value(obj)
        rms, largest = axis.distance_to(surface_value(obj))
        obj.Shape = curve_shape.edge(axis.curve)
        obj.Length = axis.length
        obj.SurfaceDistanceRMS, obj.SurfaceDistanceMax = rms, largest
        return axis.findings


def value(obj) -> core_axis.Axis:
    """The core axis of an Axis object; raises BendTorsionError for what it cannot be."""
    if obj.Source is not None:
        shape = surface_object.picked_shape(obj, obj.Source, "curve")
        given = detailing.AxisInput(obj.Label, curve=from_part.curve_from_part(shape, obj.Label))
    else:
        given = detailing.AxisInput(
            obj.Label,
            np.array([tuple(point) for point in obj.Points]).reshape(-1, 3),
            fit=obj.Fit,
            tolerance=obj.Tolerance.Value,
            max_spacing=obj.MaxSpacing.Value or None,
        )
    return detailing.axis_of(given, surface_value(obj))


def surface_value(obj):
    """The core surface of the Surface an Axis object links to."""
    return surface_object.value(linked(obj, "Surface", "Surface"))
