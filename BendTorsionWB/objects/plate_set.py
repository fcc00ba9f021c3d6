# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object PlateSet: the plates of a member, as solids."""

from __future__ import annotations

from BendTorsionWB.core import detailing, rules, tolerances
from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.core.plates import Joints, Plate
from BendTorsionWB.core.section import BOX_FACES
from BendTorsionWB.core.volume import skin_volumes
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects.proxy import Property, Proxy, add_property, linked
from BendTorsionWB.shapes import brep


def _joints_property(face: str) -> Property:
    return Property(
        "App::PropertyFloatList",
        f"Joints{face.capitalize()}",
        "Plates",
        f"Joints of the {face} face: cumulative ratios (up to 1) or mm from the start",
    )


class PlateSet(Proxy):
    """The plates of one member; its shape is the compound of their solids, in mark order."""

    TYPE = "PlateSet"
    PROPERTIES = (
        Property("App::PropertyLink", "Member", "Plates", "The member cut into plates"),
        *map(_joints_property, BOX_FACES),
        Property(
            "App::PropertyStringList",
            "AutoJoints",
            "Plates",
            "Faces whose joints are solved by the rule pack, instead of their lists",
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
            "App::PropertyStringList",
            "Marks",
            "Result",
            "Position marks, as the solids",
            output=True,
        ),
        Property("App::PropertyInteger", "PlateCount", "Result", "Number of plates", output=True),
        Property("App::PropertyFloat", "Mass", "Result", "Mass of all plates, kg", output=True),
        Property("App::PropertyVolume", "Volume", "Result", "Volume of all plates", output=True),
    )

    def build(self, obj):
        plates = value(obj)
        for strip in plates.geometry.member.law.strips:
            add_joints(obj, strip.face)
        solids = brep.tube_solids([[(p.knots, p.poles) for p in i.skin] for i in plates.plates])
        findings = list(plates.findings)
        volumes = skin_volumes([item.skin for item in plates.plates])
        for item, solid, volume in zip(plates.plates, solids, volumes, strict=True):
            findings += accepted(item.plate, solid, volume)
        obj.Shape = brep.compound(solids)
        obj.Marks = [item.plate.mark for item in plates.plates]
        obj.PlateCount = len(solids)
        obj.Volume = sum(item.plate.volume for item in plates.plates)
        obj.Mass = sum(i.plate.volume * i.plate.material.density for i in plates.plates)
        return findings


def add_joints(obj, face: str) -> None:
    """Give a PlateSet the property for joints of a face, `Joints` and its name."""
    add_property(obj, _joints_property(face))


def accepted(plate: Plate, solid, volume: float) -> list[Finding]:
    """Errors of a solid that is not closed, not valid, or whose skin's volume is not the plate's
    exact one."""
    miss = abs(volume - plate.volume) / plate.volume
    if solid.isValid() and solid.isClosed() and miss <= tolerances.VOLUME_RELATIVE:
        return []
    return [
        error(
            "solid-refused",
            plate.mark,
            "the solid is not closed, or has not the volume of the plate",
            "report this with the document",
            value=volume,
            limit=plate.volume,
            unit="mm3",
        )
    ]


def joints_of(values) -> Joints:
    """Joints from a list of numbers: ratios when none is above 1, mm otherwise."""
    values = tuple(float(v) for v in values)
    return Joints(values, "ratio" if all(v <= 1.0 for v in values) else "mm")


def value(obj) -> detailing.MemberPlates:
    """The core plates of a PlateSet; raises BendTorsionError for what cannot be built."""
    geometry = member_object.value(linked(obj, "Member", "Member"))
    if obj.StationSpacing.Value <= 0:
        raise BendTorsionError(
            error(
                "station-spacing",
                obj.Label,
                "station spacing must be positive",
                "use 500 mm",
                value=obj.StationSpacing.Value,
                limit=0.0,
                unit="mm",
            )
        )
    joints = {}
    for face in (strip.face for strip in geometry.member.law.strips):
        values = getattr(obj, f"Joints{face.capitalize()}", ())
        if face in obj.AutoJoints:
            joints[face] = Joints((), "auto")
        elif values:
            joints[face] = joints_of(values)
    given = detailing.PlatesInput(
        joints,
        obj.StationSpacing.Value,
        rules.joint_rules(obj.RulePack),
        rules.forming_rules(obj.RulePack),
    )
    return detailing.plates_of(geometry, given)
