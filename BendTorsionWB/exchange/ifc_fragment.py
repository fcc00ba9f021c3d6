# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a member gives to an IFC4 file: an assembly per delivery piece, a plate per plate with its
exact boundary, quantities and properties."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.lofting import DevelopedPlate
from ..core.solids.boundary import Boundary, Circle, Cylinder, Line, Plane, SplineSurface
from .dxf_bevels import edge_texts
from .ifc_entities import Entities, Written, listed, place_of, quoted, real, reals, reference

OUTSIDE = 2
"""Given from outside: the placement of the building, and the context of bodies."""


@dataclass(frozen=True, eq=False)
class PlateSolid:
    """A plate, its boundary in the model, and its colour (r, g, b) 0 … 1."""

    plate: DevelopedPlate
    boundary: Boundary
    colour: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Assembly:
    """A delivery piece: its mark, the member it is of, and its plates."""

    mark: str
    member: str
    plates: tuple[PlateSolid, ...]


@dataclass(frozen=True)
class IfcFragment:
    """Entities of a member; assemblies: their places; plates: by material, those of its plates."""

    entities: Entities
    assemblies: tuple[int, ...]
    plates: tuple[tuple[str, tuple[int, ...]], ...]


def ifc_fragment(project: str, assemblies: Sequence[Assembly]) -> IfcFragment:
    """The fragment of a member's assemblies. project: its name."""
    member = _Member(project)
    made = [place_of(member.assembly(item)) for item in assemblies]
    plates = tuple((grade, tuple(own)) for grade, own in member.plates.items())
    return IfcFragment(member.done(), tuple(made), plates)


def plate_facts(plate: DevelopedPlate) -> tuple[tuple, tuple]:
    """What is told of a plate: (type, name, value) of its quantities, in m and kg, and (name,
    value) of its properties as they are written."""
    gross = plate.gross or plate
    return (
        ("LENGTH", "Width", plate.thickness),
        ("AREA", "NetArea", plate.area * 1e-6),
        ("AREA", "GrossArea", gross.area * 1e-6),
        ("VOLUME", "NetVolume", plate.volume * 1e-9),
        ("WEIGHT", "NetWeight", plate.mass),
        ("WEIGHT", "GrossWeight", gross.mass),
    ), (
        ("Part", f"IFCIDENTIFIER({quoted(plate.part)})"),
        ("Piece", f"IFCIDENTIFIER({quoted(str(plate.piece))})"),
        ("Face", f"IFCLABEL({quoted(plate.face)})"),
        ("Forming", f"IFCLABEL({quoted(plate.forming or '')})"),
        ("FlatLength", f"IFCLENGTHMEASURE({real(plate.length)})"),
        ("FlatWidth", f"IFCLENGTHMEASURE({real(plate.width)})"),
        ("MarkingFace", f"IFCLABEL({quoted(plate.marking_face)})"),
        # Grooves are not in the solid: they are told as the cut files tell them.
        ("EdgePreparations", f"IFCTEXT({quoted(edge_texts(plate))})"),
    )


class _Member(Written):
    """The entities of a member as they are written."""

    def __init__(self, project: str):
        super().__init__(project, OUTSIDE)
        self.here, self.body = map(reference, range(OUTSIDE))
        self.plates: dict[str, list[int]] = {}

    def assembly(self, item: Assembly) -> str:
        lies = self.add(f"IFCLOCALPLACEMENT({self.here},{self.placement((0, 0, 0))})")
        made = self.add(
            f"IFCELEMENTASSEMBLY({self.identity('assembly', item.mark)},$,{quoted(item.mark)},$,"
            f"{quoted(item.member)},{lies},$,{quoted(item.mark)},.FACTORY.,.GIRDER.)"
        )
        self.aggregate(item.mark, made, [self.plate(own, lies) for own in item.plates])
        return made

    def plate(self, item: PlateSolid, parent: str) -> str:
        plate = item.plate
        solid = self.solid(item.boundary)
        self.add(f"IFCSTYLEDITEM({solid},({self.style(item.colour)}),$)")
        shape = self.add(f"IFCSHAPEREPRESENTATION({self.body},'Body','AdvancedBrep',({solid}))")
        shape = self.add(f"IFCPRODUCTDEFINITIONSHAPE($,$,({shape}))")
        lies = self.add(f"IFCLOCALPLACEMENT({parent},{self.placement((0, 0, 0))})")
        made = self.add(
            f"IFCPLATE({self.identity('plate', plate.mark)},$,{quoted(plate.mark)},$,"
            f"{quoted(plate.face)},{lies},{shape},{quoted(plate.mark)},.SHEET.)"
        )
        self.properties(plate, made)
        return made

    def properties(self, plate: DevelopedPlate, made: str) -> None:
        quantities, properties = plate_facts(plate)
        quantities = [
            self.add(f"IFCQUANTITY{kind}('{name}',$,$,{real(value)},$)")
            for kind, name, value in quantities
        ]
        values = [
            self.add(f"IFCPROPERTYSINGLEVALUE('{name}',$,{value},$)") for name, value in properties
        ]
        sets = [
            self.add(
                f"IFCELEMENTQUANTITY({self.identity('quantities', plate.mark)},$,"
                f"'Qto_PlateBaseQuantities',$,$,{listed(quantities)})"
            ),
            self.add(
                f"IFCPROPERTYSET({self.identity('properties', plate.mark)},$,"
                f"'BendTorsion_Plate',$,{listed(values)})"
            ),
        ]
        for k, own in enumerate(sets):
            self.add(
                f"IFCRELDEFINESBYPROPERTIES({self.identity('defines', plate.mark, str(k))},$,$,$,"
                f"({made}),{own})"
            )
        self.plates.setdefault(plate.material, []).append(place_of(made))

    def style(self, colour: tuple[float, float, float]) -> str:
        rgb = self.once("IFCCOLOURRGB($," + ",".join(map(real, colour)) + ")")
        shade = self.once(f"IFCSURFACESTYLESHADING({rgb},0.)")
        return self.once(f"IFCSURFACESTYLE($,.BOTH.,({shade}))")

    def solid(self, boundary: Boundary) -> str:
        points = self.points(boundary.vertices)
        vertices = self.add_all([f"IFCVERTEXPOINT({point})" for point in points])
        edges = [
            self.add(
                f"IFCEDGECURVE({vertices[e.start]},{vertices[e.end]},{self.curve(e.curve)},"
                f"{'.T.' if e.same_sense else '.F.'})"
            )
            for e in boundary.edges
        ]
        faces = []
        for face in boundary.faces:
            bounds = []
            for k, loop in enumerate(face.loops):
                oriented = self.add_all(
                    [
                        f"IFCORIENTEDEDGE(*,*,{edges[e]},{'.T.' if forward else '.F.'})"
                        for e, forward in loop
                    ]
                )
                ring = self.add(f"IFCEDGELOOP({listed(oriented)})")
                kind = "IFCFACEBOUND" if k else "IFCFACEOUTERBOUND"
                bounds.append(self.add(f"{kind}({ring},.T.)"))
            faces.append(
                self.add(
                    f"IFCADVANCEDFACE({listed(bounds)},{self.surface(face.surface)},"
                    f"{'.T.' if face.same_sense else '.F.'})"
                )
            )
        return self.add(f"IFCADVANCEDBREP({self.add(f'IFCCLOSEDSHELL({listed(faces)})')})")

    def curve(self, curve) -> str:
        if isinstance(curve, Line):
            vector = self.add(f"IFCVECTOR({self.direction(curve.direction)},1.)")
            return self.add(f"IFCLINE({self.point(curve.origin)},{vector})")
        if isinstance(curve, Circle):
            place = self.placement(curve.centre, curve.axis, curve.x)
            return self.add(f"IFCCIRCLE({place},{real(curve.radius)})")
        kind, weights = "IFC", ""
        if curve.weights is not None:
            kind, weights = "IFCRATIONAL", f",{_numbers(curve.weights)}"
        return self.add(
            f"{kind}BSPLINECURVEWITHKNOTS({curve.degree},"
            f"{listed(self.points(curve.poles))},.UNSPECIFIED.,.F.,.U.,"
            f"{listed(curve.multiplicities)},{_numbers(curve.knots)},.UNSPECIFIED.{weights})"
        )

    def surface(self, surface) -> str:
        if isinstance(surface, Plane):
            place = self.placement(surface.origin, surface.normal, surface.x)
            return self.add(f"IFCPLANE({place})")
        if isinstance(surface, Cylinder):
            place = self.placement(surface.origin, surface.axis, surface.x)
            return self.add(f"IFCCYLINDRICALSURFACE({place},{real(surface.radius)})")
        return self._spline_surface(surface)

    def _spline_surface(self, surface: SplineSurface) -> str:
        points, count = self.points(surface.poles.reshape(-1, 3)), surface.poles.shape[1]
        rows = listed(listed(points[k : k + count]) for k in range(0, len(points), count))
        kind, weights = "IFC", ""
        if surface.weights is not None:
            kind, weights = "IFCRATIONAL", "," + listed(map(_numbers, surface.weights))
        return self.add(
            f"{kind}BSPLINESURFACEWITHKNOTS({surface.degrees[0]},{surface.degrees[1]},{rows},"
            f".UNSPECIFIED.,.F.,.F.,.U.,{listed(surface.multiplicities[0])},"
            f"{listed(surface.multiplicities[1])},{_numbers(surface.knots[0])},"
            f"{_numbers(surface.knots[1])},.UNSPECIFIED.{weights})"
        )


def _numbers(values) -> str:
    return listed(reals(np.asarray(values, float).tolist()))
