# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object SectionSpec: a section of the schedule."""

from __future__ import annotations

import FreeCAD
import Part

from BendTorsionWB.core import rules
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.sections import section as core_section
from BendTorsionWB.core.sections.section_properties import (
    flat_parts,
    section_properties,
    slenderness_class,
)
from BendTorsionWB.core.sections.section_strips import StripRow
from BendTorsionWB.core.sections.section_types import CORNER_JOINTS, TYPES, section_of
from BendTorsionWB.core.sections.strip_lines import section_polygons
from BendTorsionWB.objects.proxy import Property, Proxy

_LENGTH = "App::PropertyLength"
_FLOAT = "App::PropertyFloat"
DEFAULT = core_section.Material()
AUTOMATIC_JOINT = {"trapezoid": "flanges", "polygon": "mitre"}


PROPERTY_OF_SIZE = {
    "h": "Height",
    "b": "Breadth",
    "b_bottom": "BreadthBottom",
    "t": "Thickness",
    "t_top": "ThicknessTop",
    "t_bottom": "ThicknessBottom",
    "t_web": "ThicknessWeb",
    "gap1": "Gap1",
    "gap2": "Gap2",
    "E": "YoungsModulus",
    "fy": "YieldStrength",
}
"""Names of the schedule's columns as properties."""


class SectionSpec(Proxy):
    """A section; members that use it follow its every change.

    The schedule's h, b, t, ... have names of their own here, because FreeCAD's expressions read
    `h` as hour and `t` as tonne.
    """

    TYPE = "SectionSpec"
    LAID_APART = True
    PROPERTIES = (
        Property(
            "App::PropertyEnumeration",
            "Type",
            "Section",
            "box1: webs full height, flanges between them; box2: flanges full breadth; i: "
            "I or H; tee; channel; trapezoid: box with sloping webs; polygon: ring of plates; "
            "strips: free list",
            "box1",
            TYPES,
        ),
        Property(_LENGTH, "Height", "Section", "Height h over the outer faces", 600.0),
        Property(
            _LENGTH,
            "Breadth",
            "Section",
            "Breadth over the outer faces; of the top where the bottom has its own",
            600.0,
        ),
        Property(
            _LENGTH,
            "BreadthBottom",
            "Section",
            "Breadth of the bottom flange (i) or bottom (trapezoid); 0 for Breadth",
            0.0,
        ),
        Property(_LENGTH, "Thickness", "Section", "Plate thickness where no other is given", 16.0),
        Property(
            _LENGTH, "ThicknessTop", "Section", "Thickness of the top plate; 0 for Thickness", 0.0
        ),
        Property(
            _LENGTH,
            "ThicknessBottom",
            "Section",
            "Thickness of the bottom plate; 0 for Thickness",
            0.0,
        ),
        Property(_LENGTH, "ThicknessWeb", "Section", "Thickness of the webs; 0 for Thickness", 0.0),
        Property(
            _LENGTH,
            "Gap1",
            "Section",
            "Root gap on the left (box1, webs run through) or at the top of the webs; of all "
            "corners of a polygon",
            0.0,
        ),
        Property(
            _LENGTH,
            "Gap2",
            "Section",
            "Root gap on the right (box1, webs run through) or at the bottom of the webs",
            0.0,
        ),
        Property(
            "App::PropertyEnumeration",
            "CornerJoint",
            "Section",
            "Which plates run to the corner (trapezoid, polygon): flanges, webs, each over "
            "the next (ring), or mitred",
            "automatic",
            ("automatic", *CORNER_JOINTS),
        ),
        Property(
            "App::PropertyVectorList",
            "PolygonCorners",
            "Section",
            "Corners of a polygon in turn, as (0, y, z) mm",
        ),
        Property(
            "App::PropertyFloatList",
            "PolygonThicknesses",
            "Section",
            "Thickness of each side of a polygon, mm; empty for Thickness",
        ),
        Property(
            "App::PropertyStringList",
            "StripTable",
            "Section",
            "Free list, a strip per line: face, letter, y1, z1, y2, z2, t, side (left right "
            "middle), stop1, stop2",
        ),
        Property("App::PropertyString", "Material", "Material", "Steel grade", DEFAULT.name),
        Property(_FLOAT, "Density", "Material", "kg/m3", DEFAULT.density * 1e9),
        Property(
            "App::PropertyPressure", "YoungsModulus", "Material", "Young's modulus", DEFAULT.e * 1e3
        ),
        Property(
            "App::PropertyPressure", "YieldStrength", "Material", "Yield strength", DEFAULT.fy * 1e3
        ),
        Property("App::PropertyArea", "Area", "Result", "Area of the plates", output=True),
        Property(
            _FLOAT,
            "Iy",
            "Result",
            "Second moment about the y axis through the centroid, mm4",
            output=True,
        ),
        Property(
            _FLOAT,
            "Iz",
            "Result",
            "Second moment about the z axis through the centroid, mm4",
            output=True,
        ),
        Property(_FLOAT, "Iyz", "Result", "Product moment, mm4", output=True),
        Property(
            _FLOAT,
            "TorsionConstant",
            "Result",
            "Torsion constant, mm4: Bredt when closed, sum of bt³/3 when open",
            output=True,
        ),
        Property(
            "App::PropertyDistance",
            "CentroidY",
            "Result",
            "Centroid from the middle of b",
            output=True,
        ),
        Property(
            "App::PropertyDistance",
            "CentroidZ",
            "Result",
            "Centroid from the middle of h",
            output=True,
        ),
        Property(
            "App::PropertyAngle",
            "PrincipalAngle",
            "Result",
            "Angle from y to the axis of the largest second moment",
            output=True,
        ),
        Property(_FLOAT, "MassPerMetre", "Result", "kg/m", output=True),
        Property(
            _FLOAT,
            "PaintedAreaPerMetre",
            "Result",
            "m2/m; of a closed section its outside",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "Slenderness",
            "Result",
            "Width over thickness of each flat part, and its class in compression by each "
            "rule pack",
            output=True,
        ),
    )

    def build(self, obj):
        section = value(obj)
        rings = [section.corners] if section.closed else section_polygons(section).tolist()
        wires = [
            Part.makePolygon([FreeCAD.Vector(0, y, z) for y, z in (*ring, ring[0])])
            for ring in rings
        ]
        obj.Shape = wires[0] if section.closed else Part.Compound(wires)
        found = section_properties(section)
        obj.Area, obj.Iy, obj.Iz, obj.Iyz = found.area, found.iy, found.iz, found.iyz
        obj.TorsionConstant, obj.PrincipalAngle = (
            found.j,
            FreeCAD.Units.Quantity(f"{found.angle!r} rad"),
        )
        obj.CentroidY, obj.CentroidZ = found.centroid
        obj.MassPerMetre = found.mass_per_length * 1e3
        obj.PaintedAreaPerMetre = found.painted_area * 1e-3
        obj.Slenderness = [_slenderness(part, section.material) for part in flat_parts(section)]
        return ()


def _slenderness(part, material) -> str:
    classes = (
        (pack, slenderness_class(part, rules.load(pack), material.fy, material.e))
        for pack in rules.PACKS
    )
    judged = ", ".join(f"{pack} class {number}" for pack, number in classes if number)
    ratio = f"{part.width:.1f}/{part.thickness:g} = {part.slenderness:.1f}"
    return f"{part.face} {part.kind} {ratio}" + (f": {judged}" if judged else "")


def value(obj) -> core_section.Section:
    """The core section of a SectionSpec; raises BendTorsionError for sizes that make none."""
    t = obj.Thickness.Value
    material = core_section.Material(
        obj.Material,
        obj.Density * 1e-9,
        obj.YoungsModulus.getValueAs("MPa").Value,
        obj.YieldStrength.getValueAs("MPa").Value,
    )
    sizes = {
        "h": obj.Height.Value,
        "b": obj.Breadth.Value,
        "b_bottom": obj.BreadthBottom.Value or obj.Breadth.Value,
        "t_top": obj.ThicknessTop.Value or t,
        "t_bottom": obj.ThicknessBottom.Value or t,
        "t_web": obj.ThicknessWeb.Value or t,
        "gap": obj.Gap1.Value,
        "gap1": obj.Gap1.Value,
        "gap2": obj.Gap2.Value,
    }
    if obj.Type in AUTOMATIC_JOINT:
        chosen = obj.CornerJoint
        sizes["joint"] = AUTOMATIC_JOINT[obj.Type] if chosen == "automatic" else chosen
    if obj.Type == "polygon":
        sizes["corners"] = [(corner.y, corner.z) for corner in obj.PolygonCorners]
        given = list(obj.PolygonThicknesses)
        if given and len(given) != len(obj.PolygonCorners):
            raise BendTorsionError(
                error(
                    "section-thicknesses",
                    obj.Label,
                    "a polygon needs a thickness per side, or none",
                    "fill in PolygonThicknesses for each side, or empty it",
                    position="property PolygonThicknesses",
                    value=len(given),
                    limit=len(obj.PolygonCorners),
                )
            )
        sizes["thickness"] = given or t
    if obj.Type == "strips":
        sizes["rows"] = [
            _strip_row(obj.Label, number, line)
            for number, line in enumerate(obj.StripTable, start=1)
        ]
    return section_of(obj.Label, obj.Type, material, **sizes)


def _strip_row(name: str, number: int, line: str) -> StripRow:
    cells = [cell.strip() for cell in line.split(",")]
    try:
        face, letter, *figures = cells[:7]
        y1, z1, y2, z2, t = map(float, figures)
    except ValueError as problem:
        raise BendTorsionError(
            error(
                "strip-row",
                name,
                f"cannot read the strip: {problem}",
                "write face, letter, y1, z1, y2, z2, t, side, stop1, stop2",
                position=f"strip {number}",
                value=line,
            )
        ) from problem
    return StripRow(face, letter, y1, z1, y2, z2, t, *(cells[7:10] or ["middle"]))
