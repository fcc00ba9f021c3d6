# SPDX-License-Identifier: LGPL-2.1-or-later
"""IFC4: an assembly per delivery piece, a plate per plate with its exact boundary.

Written by hand as STEP physical file text (ISO 10303-21): the few entities needed are plain, the
file has the same bytes for the same input, and every GlobalId follows from project and mark.
"""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.lofting import DevelopedPlate
from ..core.site import AT_ORIGIN, SiteDatum
from ..core.solids.boundary import Boundary, Circle, Cylinder, Line, Plane, SplineSurface
from .dxf_bevels import edge_texts

_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$"


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


def ifc_bytes(
    project: str, assemblies: Sequence[Assembly], site: SiteDatum = AT_ORIGIN, version: str = ""
) -> bytes:
    """The whole file."""
    return _File(project or "BendTorsion", version).whole(assemblies, site).encode("ascii")


def global_id(project: str, *names: str) -> str:
    """An IFC GlobalId (22 characters) that follows from the names alone (RFC 4122, version 5)."""
    space = uuid.uuid5(uuid.NAMESPACE_URL, "bendtorsion")
    number = uuid.uuid5(space, "\x1f".join((project, *names))).int
    digits = []
    for _ in range(22):
        number, digit = divmod(number, 64)
        digits.append(_DIGITS[digit])
    return "".join(reversed(digits))


def _text(value: str) -> str:
    """A string in the file's encoding: characters beyond ASCII as \\X2\\ runs."""
    out, run = [], []

    def close():
        if run:
            out.append("\\X2\\" + "".join(run) + "\\X0\\")
            run.clear()

    for letter in value:
        code = ord(letter)
        if 32 <= code < 127:
            close()
            out.append({"'": "''", "\\": "\\\\"}.get(letter, letter))
        else:
            run.append(letter.encode("utf-16-be").hex().upper())
    close()
    return "'" + "".join(out) + "'"


def _real(value: float) -> str:
    text = repr(float(value))
    if "e" in text:
        head, power = text.split("e")
        return (head if "." in head else head + ".") + "E" + power
    return text[:-1] if text.endswith(".0") else text


def _rounded(values, decimals: int) -> np.ndarray:
    """Without last digits, which saving a document may change, and without negative zeros."""
    return np.round(np.asarray(values, float), decimals) + 0.0


def _reals(values) -> str:
    return "(" + ",".join(map(_real, np.asarray(values, float).tolist())) + ")"


def _list(items) -> str:
    return "(" + ",".join(map(str, items)) + ")"


class _File:
    """The entities of one file, numbered as they come."""

    def __init__(self, project: str, version: str):
        self.project, self.version = project, version
        self.lines: list[str] = []
        self.shared: dict[str, str] = {}
        self.plates: dict[str, list[str]] = {}

    def add(self, entity: str) -> str:
        self.lines.append(entity)
        return f"#{len(self.lines)}"

    def once(self, entity: str) -> str:
        """The same entity once only."""
        if entity not in self.shared:
            self.shared[entity] = self.add(entity)
        return self.shared[entity]

    def identity(self, *names: str) -> str:
        return f"'{global_id(self.project, *names)}'"

    def points(self, xyz) -> list[str]:
        """Points (n, 3), rounded at once: single ones took most of the time of a file."""
        rows = _rounded(xyz, 9).tolist()
        return [self.add(f"IFCCARTESIANPOINT(({','.join(map(_real, row))}))") for row in rows]

    def point(self, xyz) -> str:
        return self.points([xyz])[0]

    def direction(self, xyz) -> str:
        return self.once(f"IFCDIRECTION({_reals(_rounded(xyz, 12))})")

    def placement(self, origin, axis=(0.0, 0.0, 1.0), x=(1.0, 0.0, 0.0)) -> str:
        return self.add(
            f"IFCAXIS2PLACEMENT3D({self.point(origin)},{self.direction(axis)},{self.direction(x)})"
        )

    def whole(self, assemblies: Sequence[Assembly], site: SiteDatum) -> str:
        units = self.add(f"IFCUNITASSIGNMENT({_list(self.units())})")
        model = self.add(
            f"IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,{self.placement((0, 0, 0))},$)"
        )
        body = self.add(
            f"IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,{model},$,.MODEL_VIEW.,$)"
        )
        project = self.add(
            f"IFCPROJECT({self.identity('project')},$,{_text(self.project)},$,$,$,$,"
            f"({model}),{units})"
        )
        x = (np.cos(site.rotation), np.sin(site.rotation), 0.0)
        lies = self.add(f"IFCLOCALPLACEMENT($,{self.placement((site.x, site.y, site.z), x=x)})")
        place = self.add(
            f"IFCSITE({self.identity('site')},$,'Site',$,$,{lies},$,$,.ELEMENT.,$,$,$,$,$)"
        )
        here = self.add(f"IFCLOCALPLACEMENT({lies},{self.placement((0, 0, 0))})")
        building = self.add(
            f"IFCBUILDING({self.identity('building')},$,{_text(self.project)},$,$,{here},"
            "$,$,.ELEMENT.,$,$,$)"
        )
        self.aggregate("project", project, [place])
        self.aggregate("site", place, [building])
        made = [self.assembly(item, here, body) for item in assemblies]
        if made:
            self.add(
                f"IFCRELCONTAINEDINSPATIALSTRUCTURE({self.identity('contained')},$,$,$,"
                f"{_list(made)},{building})"
            )
        self.materials()
        return (
            self.header()
            + "".join(f"#{k}={line};\n" for k, line in enumerate(self.lines, 1))
            + "ENDSEC;\nEND-ISO-10303-21;\n"
        )

    def header(self) -> str:
        name = _text(self.project)
        return (
            "ISO-10303-21;\nHEADER;\n"
            "FILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\n"
            f"FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),"
            f"{_text('BendTorsion ' + self.version)},{_text('BendTorsion ' + self.version)},'');\n"
            "FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n"
        )

    def units(self) -> list[str]:
        return [
            self.add(f"IFCSIUNIT(*,.{kind}.,{prefix},.{name}.)")
            for kind, prefix, name in (
                ("LENGTHUNIT", ".MILLI.", "METRE"),
                ("AREAUNIT", "$", "SQUARE_METRE"),
                ("VOLUMEUNIT", "$", "CUBIC_METRE"),
                ("PLANEANGLEUNIT", "$", "RADIAN"),
                ("MASSUNIT", ".KILO.", "GRAM"),
            )
        ]

    def aggregate(self, name: str, whole: str, parts: Sequence[str]) -> None:
        if parts:
            self.add(
                f"IFCRELAGGREGATES({self.identity('aggregates', name)},$,$,$,{whole},"
                f"{_list(parts)})"
            )

    def assembly(self, item: Assembly, parent: str, body: str) -> str:
        lies = self.add(f"IFCLOCALPLACEMENT({parent},{self.placement((0, 0, 0))})")
        made = self.add(
            f"IFCELEMENTASSEMBLY({self.identity('assembly', item.mark)},$,{_text(item.mark)},$,"
            f"{_text(item.member)},{lies},$,{_text(item.mark)},.FACTORY.,.GIRDER.)"
        )
        self.aggregate(item.mark, made, [self.plate(p, lies, body) for p in item.plates])
        return made

    def plate(self, item: PlateSolid, parent: str, body: str) -> str:
        plate = item.plate
        solid = self.solid(item.boundary)
        self.add(f"IFCSTYLEDITEM({solid},({self.style(item.colour)}),$)")
        shape = self.add(f"IFCSHAPEREPRESENTATION({body},'Body','AdvancedBrep',({solid}))")
        shape = self.add(f"IFCPRODUCTDEFINITIONSHAPE($,$,({shape}))")
        lies = self.add(f"IFCLOCALPLACEMENT({parent},{self.placement((0, 0, 0))})")
        made = self.add(
            f"IFCPLATE({self.identity('plate', plate.mark)},$,{_text(plate.mark)},$,"
            f"{_text(plate.face)},{lies},{shape},{_text(plate.mark)},.SHEET.)"
        )
        self.properties(plate, made)
        return made

    def properties(self, plate: DevelopedPlate, made: str) -> None:
        gross = plate.gross or plate
        quantities = [
            self.add(f"IFCQUANTITY{kind}('{name}',$,$,{_real(value)},$)")
            for kind, name, value in (
                ("LENGTH", "Width", plate.thickness),
                ("AREA", "NetArea", plate.area * 1e-6),
                ("AREA", "GrossArea", gross.area * 1e-6),
                ("VOLUME", "NetVolume", plate.volume * 1e-9),
                ("WEIGHT", "NetWeight", plate.mass),
                ("WEIGHT", "GrossWeight", gross.mass),
            )
        ]
        values = [
            self.add(f"IFCPROPERTYSINGLEVALUE('{name}',$,{value},$)")
            for name, value in (
                ("Part", f"IFCIDENTIFIER({_text(plate.part)})"),
                ("Piece", f"IFCIDENTIFIER({_text(str(plate.piece))})"),
                ("Face", f"IFCLABEL({_text(plate.face)})"),
                ("Forming", f"IFCLABEL({_text(plate.forming or '')})"),
                ("FlatLength", f"IFCLENGTHMEASURE({_real(plate.length)})"),
                ("FlatWidth", f"IFCLENGTHMEASURE({_real(plate.width)})"),
                ("MarkingFace", f"IFCLABEL({_text(plate.marking_face)})"),
                # Grooves are not in the solid: they are told as the cut files tell them.
                ("EdgePreparations", f"IFCTEXT({_text(edge_texts(plate))})"),
            )
        ]
        sets = [
            self.add(
                f"IFCELEMENTQUANTITY({self.identity('quantities', plate.mark)},$,"
                f"'Qto_PlateBaseQuantities',$,$,{_list(quantities)})"
            ),
            self.add(
                f"IFCPROPERTYSET({self.identity('properties', plate.mark)},$,"
                f"'BendTorsion_Plate',$,{_list(values)})"
            ),
        ]
        for k, own in enumerate(sets):
            self.add(
                f"IFCRELDEFINESBYPROPERTIES({self.identity('defines', plate.mark, str(k))},$,$,$,"
                f"({made}),{own})"
            )
        self.plates.setdefault(plate.material, []).append(made)

    def materials(self) -> None:
        for grade, plates in self.plates.items():
            material = self.add(f"IFCMATERIAL({_text(grade)},$,'steel')")
            self.add(
                f"IFCRELASSOCIATESMATERIAL({self.identity('material', grade)},$,$,$,"
                f"{_list(plates)},{material})"
            )

    def style(self, colour: tuple[float, float, float]) -> str:
        rgb = self.once("IFCCOLOURRGB($," + ",".join(map(_real, colour)) + ")")
        shade = self.once(f"IFCSURFACESTYLESHADING({rgb},0.)")
        return self.once(f"IFCSURFACESTYLE($,.BOTH.,({shade}))")

    def solid(self, boundary: Boundary) -> str:
        points = self.points(boundary.vertices)
        vertices = [self.add(f"IFCVERTEXPOINT({point})") for point in points]
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
                oriented = [
                    self.add(f"IFCORIENTEDEDGE(*,*,{edges[e]},{'.T.' if forward else '.F.'})")
                    for e, forward in loop
                ]
                ring = self.add(f"IFCEDGELOOP({_list(oriented)})")
                kind = "IFCFACEBOUND" if k else "IFCFACEOUTERBOUND"
                bounds.append(self.add(f"{kind}({ring},.T.)"))
            faces.append(
                self.add(
                    f"IFCADVANCEDFACE({_list(bounds)},{self.surface(face.surface)},"
                    f"{'.T.' if face.same_sense else '.F.'})"
                )
            )
        return self.add(f"IFCADVANCEDBREP({self.add(f'IFCCLOSEDSHELL({_list(faces)})')})")

    def curve(self, curve) -> str:
        if isinstance(curve, Line):
            vector = self.add(f"IFCVECTOR({self.direction(curve.direction)},1.)")
            return self.add(f"IFCLINE({self.point(curve.origin)},{vector})")
        if isinstance(curve, Circle):
            place = self.placement(curve.centre, curve.axis, curve.x)
            return self.add(f"IFCCIRCLE({place},{_real(curve.radius)})")
        kind, weights = "IFC", ""
        if curve.weights is not None:
            kind, weights = "IFCRATIONAL", f",{_reals(curve.weights)}"
        return self.add(
            f"{kind}BSPLINECURVEWITHKNOTS({curve.degree},"
            f"{_list(self.points(curve.poles))},.UNSPECIFIED.,.F.,.U.,"
            f"{_list(curve.multiplicities)},{_reals(curve.knots)},.UNSPECIFIED.{weights})"
        )

    def surface(self, surface) -> str:
        if isinstance(surface, Plane):
            place = self.placement(surface.origin, surface.normal, surface.x)
            return self.add(f"IFCPLANE({place})")
        if isinstance(surface, Cylinder):
            place = self.placement(surface.origin, surface.axis, surface.x)
            return self.add(f"IFCCYLINDRICALSURFACE({place},{_real(surface.radius)})")
        return self._spline_surface(surface)

    def _spline_surface(self, surface: SplineSurface) -> str:
        points, count = self.points(surface.poles.reshape(-1, 3)), surface.poles.shape[1]
        rows = _list(_list(points[k : k + count]) for k in range(0, len(points), count))
        kind, weights = "IFC", ""
        if surface.weights is not None:
            kind, weights = "IFCRATIONAL", "," + _list(map(_reals, surface.weights))
        return self.add(
            f"{kind}BSPLINESURFACEWITHKNOTS({surface.degrees[0]},{surface.degrees[1]},{rows},"
            f".UNSPECIFIED.,.F.,.F.,.U.,{_list(surface.multiplicities[0])},"
            f"{_list(surface.multiplicities[1])},{_reals(surface.knots[0])},"
            f"{_reals(surface.knots[1])},.UNSPECIFIED.{weights})"
        )
