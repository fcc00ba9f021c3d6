# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object PlateSet: the plates of a member, as solids."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core import detailing, rules, tolerances
from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.joints.stock import stock_of
from BendTorsionWB.core.members.volume import strip_volume
from BendTorsionWB.core.nodes.node_members import nodes_of_member
from BendTorsionWB.core.plates.plate_middles import middle
from BendTorsionWB.core.plates.plates import Joints, Plate
from BendTorsionWB.core.sections.section import BOX_FACES
from BendTorsionWB.objects import colours, plate_parts
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import node as node_object
from BendTorsionWB.objects.proxy import Property, Proxy, add_property, linked
from BendTorsionWB.shapes import brep, cut_solid
from BendTorsionWB.shapes.flat_solid import flat_solid, with_openings


def _joints_property(face: str) -> Property:
    return Property(
        "App::PropertyFloatList",
        f"Joints{face.capitalize()}",
        "Plates",
        "Joints of the face: cumulative ratios (up to 1) or mm from the start",
    )


def _lanes_property(face: str) -> Property:
    return Property(
        "App::PropertyFloatList",
        f"Lanes{face.capitalize()}",
        "Plates",
        "Seams that divide the face along: cumulative ratios (up to 1) or mm of its width",
    )


class PlateSet(Proxy):
    """The plates of one member; its shape is the compound of their solids, in mark order."""

    TYPE = "PlateSet"
    PROPERTIES = (
        Property("App::PropertyLink", "Member", "Plates", "The member cut into plates"),
        Property("App::PropertyLinkList", "Nodes", "Plates", "The nodes the member takes part in"),
        *map(_joints_property, BOX_FACES),
        Property(
            "App::PropertyStringList",
            "AutoJoints",
            "Plates",
            "Faces whose joints are solved by the rule pack, instead of their lists",
        ),
        *map(_lanes_property, BOX_FACES),
        Property(
            "App::PropertyStringList",
            "AutoLanes",
            "Plates",
            "Faces divided into as few lanes as the stock of the rule pack allows",
        ),
        Property(
            "App::PropertyFloatList",
            "NodePlaces",
            "Plates",
            "Places of nodes along the axis, which joints keep clear of, mm",
        ),
        Property(
            "App::PropertyLength",
            "StationSpacing",
            "Plates",
            "Largest distance of measuring lines along any corner line",
            500.0,
        ),
        Property(
            "App::PropertyEnumeration",
            "RulePack",
            "Plates",
            "The rules joints are checked by and solved for, and plates formed by",
            "CN",
            rules.PACKS,
        ),
        Property(
            "App::PropertyString",
            "Stock",
            "Plates",
            "Sheets there are, such as 12000x2500; 16 10000x2000; 30 S460 8000x2200 (thickness and "
            "grade where it is theirs alone); empty: the rule pack's",
        ),
        *plate_parts.PROPERTIES,
        Property(
            "App::PropertyStringList",
            "Pieces",
            "Result",
            "Delivery pieces: number, start and end, mm, and number of parts",
            output=True,
        ),
        Property(
            "App::PropertyFloatList", "PieceMasses", "Result", "Mass of each piece, kg", output=True
        ),
        Property(
            "App::PropertyVectorList",
            "PieceCentres",
            "Result",
            "Centre of gravity of each piece, mm",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "Marks",
            "Result",
            "Position marks, as the solids",
            output=True,
        ),
        Property(
            "App::PropertyIntegerList",
            "MarkPieces",
            "Result",
            "Delivery piece of each mark",
            output=True,
        ),
        Property(
            "App::PropertyVectorList",
            "PlateMiddles",
            "Result",
            "Middle of the outer face of each mark",
            output=True,
        ),
        Property(
            "App::PropertyVectorList",
            "PlateDirections",
            "Result",
            "Outward direction there, as long as the plate is wide",
            output=True,
        ),
        Property("App::PropertyInteger", "PlateCount", "Result", "Number of plates", output=True),
        Property("App::PropertyFloat", "Mass", "Result", "Mass of all plates, kg", output=True),
        Property("App::PropertyVolume", "Volume", "Result", "Volume of all plates", output=True),
        Property(
            "App::PropertyVector",
            "CentreOfGravity",
            "Result",
            "Centre of gravity of all plates, mm",
            output=True,
        ),
        Property(
            "App::PropertyArea",
            "PaintedArea",
            "Result",
            "Area of the member seen from outside, ends apart",
            output=True,
        ),
        *colours.PROPERTIES,
    )

    def build(self, obj):
        plates = value(obj)
        for strip in plates.geometry.member.law.strips:
            add_joints(obj, strip.face)
        made = cut_solid.plate_solids(plates.plates)
        solids = [solid for solid, _ in made]
        findings = list(plates.findings)
        for item, (_, sound) in zip(plates.plates, made, strict=True):
            findings += accepted(item.plate, sound, item.skin_volume)
        for k, plate in enumerate(item.plate for item in plates.plates):
            solids[k], found = with_openings(solids[k], plate.openings, plate.mark)
            findings += found
        solids += [flat_solid(flat) for flat in plates.flat]
        obj.Shape = brep.compound(solids)
        obj.Marks = [item.mark for item in (*(i.plate for i in plates.plates), *plates.flat)]
        shown = detailing.record_of(plates).plates if obj.ColourBy != "none" else ()
        colours.set_colours(obj, obj.Marks, shown)
        obj.MarkPieces = [i.piece for i in (*(i.plate for i in plates.plates), *plates.flat)]
        middles = middles_of(plates)
        obj.PlateMiddles = [FreeCAD.Vector(*place) for place, _ in middles]
        obj.PlateDirections = [FreeCAD.Vector(*outward) for _, outward in middles]
        obj.PlateCount = len(solids)
        obj.CentreOfGravity = FreeCAD.Vector(*detailing.figures_of(plates).centre_of_gravity)
        obj.PaintedArea = detailing.painted_area(plates.geometry)
        pieces = detailing.pieces_of(plates)
        obj.Pieces = [
            f"{own.piece.number} {own.piece.start:.3f} {own.piece.end:.3f} {len(own.marks)}"
            for own in pieces
        ]
        obj.PieceMasses = [own.mass for own in pieces]
        obj.PieceCentres = [FreeCAD.Vector(*own.centre_of_gravity) for own in pieces]
        own = [item.plate for item in plates.plates]
        obj.Volume = sum(p.net_volume for p in own) + sum(f.volume for f in plates.flat)
        obj.Mass = sum(p.net_volume * p.material.density for p in own)
        obj.Mass += sum(flat.mass for flat in plates.flat)
        return findings


def middles_of(plates: detailing.MemberPlates) -> list[tuple]:
    """`plate_middles.middle` of each plate, in the order of Marks."""
    return [middle(part) for part in (*(i.plate for i in plates.plates), *plates.flat)]


def properties_of(face: str) -> tuple[Property, ...]:
    """The properties for joints and lanes of a face, `Joints` and `Lanes` and its name."""
    return _joints_property(face), _lanes_property(face)


def add_joints(obj, face: str) -> None:
    """Give a PlateSet the properties for joints and lanes of a face."""
    for declared in properties_of(face):
        add_property(obj, declared)


def accepted(plate: Plate, sound: bool, volume: float) -> list[Finding]:
    """Errors of a solid that is not sound (`kept_solids`), or whose skin's volume is not the exact
    one of the plate, or of what it is cut from."""
    wanted = strip_volume(plate.uncut) if plate.is_cut else plate.volume
    # A plate turned inside out has a volume below nothing, which its skin shares.
    if sound and abs(volume - wanted) <= tolerances.VOLUME_RELATIVE * wanted:
        return []
    return [
        error(
            "solid-refused",
            plate.mark,
            "the solid is not closed, or has not the volume of the plate",
            "report this with the document",
            value=volume,
            limit=wanted,
            unit="mm3",
        )
    ]


def places_of(obj, kind, face: str, values):
    """Joints or Lanes from a list of numbers: ratios when none is above 1, mm otherwise. Raises
    BendTorsionError for a list that mixes them."""
    values = tuple(float(v) for v in values)
    if min(values) <= 1.0 < max(values):
        raise BendTorsionError(
            error(
                kind.__name__.lower(),
                obj.Label,
                "ratios up to 1 and mm are mixed",
                "give rising ratios up to 1 only, or rising mm only",
                position=f"face {face}",
                value=" ".join(f"{v:g}" for v in values),
                limit=1.0,
            )
        )
    return kind(values, "ratio" if max(values) <= 1.0 else "mm")


def value(obj) -> detailing.MemberPlates:
    """The core plates of a PlateSet; raises BendTorsionError for what cannot be built."""
    geometry = member_object.value(linked(obj, "Member", "Member"))
    if obj.StationSpacing.Value < tolerances.NEAREST_STATIONS:
        raise BendTorsionError(
            error(
                "station-spacing",
                obj.Label,
                "measuring lines stand too near to each other",
                "use a StationSpacing such as 500 mm",
                value=obj.StationSpacing.Value,
                limit=tolerances.NEAREST_STATIONS,
                unit="mm",
            )
        )
    joints, lanes = {}, {}
    for face in (strip.face for strip in geometry.member.law.strips):
        for made, kind, name in ((joints, Joints, "Joints"), (lanes, Lanes, "Lanes")):
            values = getattr(obj, f"{name}{face.capitalize()}", ())
            if face in getattr(obj, f"Auto{name}"):
                made[face] = kind((), "auto")
            elif values:
                made[face] = places_of(obj, kind, face, values)
    member = geometry.member
    nodes = nodes_of_member(node_object.nodes_of(obj.Nodes), member.name, member.length)
    given = detailing.PlatesInput(
        joints,
        obj.StationSpacing.Value,
        rules.joint_rules(obj.RulePack, stock_of(obj.Stock)),
        rules.forming_rules(obj.RulePack),
        welds=rules.weld_defaults(obj.RulePack),
        lanes=lanes,
        nodes=(*obj.NodePlaces, *nodes.places),
        **plate_parts.given_parts(obj),
    )
    return detailing.plates_of(detailing.noded(geometry, nodes), given)
