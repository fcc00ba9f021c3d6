# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object SectionSpec: a section of the schedule."""

from __future__ import annotations

import FreeCAD
import Part

from BendTorsionWB.core import section as core_section
from BendTorsionWB.objects.proxy import Property, Proxy

_LENGTH = "App::PropertyLength"
DEFAULT = core_section.Material()


class SectionSpec(Proxy):
    """A box section; members that use it follow its every change."""

    TYPE = "SectionSpec"
    PROPERTIES = (
        Property("App::PropertyEnumeration", "Type", "Section",
                 "box1: webs full height, flanges between them; box2: flanges full breadth",
                 "box1", core_section.BOX_TYPES),
        Property(_LENGTH, "h", "Section", "Height over the outer faces", 600.0),
        Property(_LENGTH, "b", "Section", "Breadth over the outer faces", 600.0),
        Property(_LENGTH, "t", "Section", "Plate thickness where no other is given", 16.0),
        Property(_LENGTH, "t_top", "Section", "Thickness of the top plate; 0 for t", 0.0),
        Property(_LENGTH, "t_bottom", "Section", "Thickness of the bottom plate; 0 for t", 0.0),
        Property(_LENGTH, "t_web", "Section", "Thickness of the webs; 0 for t", 0.0),
        Property(_LENGTH, "gap1", "Section", "Root gap on the left (box1) or top (box2)", 0.0),
        Property(_LENGTH, "gap2", "Section", "Root gap on the right (box1) or bottom (box2)", 0.0),
        Property("App::PropertyString", "Material", "Material", "Steel grade", DEFAULT.name),
        Property("App::PropertyFloat", "Density", "Material", "kg/m3", DEFAULT.density * 1e9),
        Property("App::PropertyPressure", "E", "Material", "Young's modulus", DEFAULT.e * 1e3),
        Property("App::PropertyPressure", "fy", "Material", "Yield strength", DEFAULT.fy * 1e3),
    )

    def build(self, obj):
        section = value(obj)
        corners = [FreeCAD.Vector(0, y, z) for y, z in section.corners]
        obj.Shape = Part.makePolygon([*corners, corners[0]])
        return ()


def value(obj) -> core_section.Section:
    """The core section of a SectionSpec; raises BendTorsionError for sizes that make no box."""
    t = obj.t.Value
    material = core_section.Material(
        obj.Material, obj.Density * 1e-9, obj.E.getValueAs("MPa").Value,
        obj.fy.getValueAs("MPa").Value,
    )
    return core_section.box(
        obj.Label,
        obj.Type,
        obj.h.Value,
        obj.b.Value,
        obj.t_top.Value or t,
        obj.t_bottom.Value or t,
        obj.t_web.Value or t,
        obj.gap1.Value,
        obj.gap2.Value,
        material,
    )
