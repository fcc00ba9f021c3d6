# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object AssemblyBed: what the pieces of a member lie on while they are put together."""

from __future__ import annotations

import math

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core import detailing
from BendTorsionWB.core.beds.bed_face import PLANES, BedInput
from BendTorsionWB.core.beds.bed_record import Bed
from BendTorsionWB.core.geometry.rigid import moved
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects.proxy import Property, Proxy, linked

USUAL = BedInput()


class AssemblyBed(Proxy):
    """The beds of a member's pieces; its shape shows posts from the floor to the seats, in place
    under the member."""

    TYPE = "AssemblyBed"
    PROPERTIES = (
        Property("App::PropertyLink", "Plates", "Bed", "The plates to be put together"),
        Property(
            "App::PropertyString",
            "Face",
            "Bed",
            "The face that lies down: bottom, top, left, right, …, or auto, the flattest",
            USUAL.face,
        ),
        Property(
            "App::PropertyEnumeration",
            "Plane",
            "Bed",
            "fit: the best plane of the face's edges; middle: the face's plane at mid-length; "
            "normal: square to Normal",
            USUAL.plane,
            PLANES,
        ),
        Property(
            "App::PropertyVector",
            "Normal",
            "Bed",
            "Upward direction of a bed by normal, in the model",
            FreeCAD.Vector(*USUAL.normal),
        ),
        Property(
            "App::PropertyLength",
            "SaddleSpacing",
            "Bed",
            "Largest distance of saddles; they stand at diaphragms besides",
            USUAL.spacing,
        ),
        Property(
            "App::PropertyLength",
            "SeatHeight",
            "Bed",
            "Height of the lowest seat above the floor",
            USUAL.height,
        ),
        Property(
            "App::PropertyLength", "PinPitch", "Pins", "Pitch of the pin grid; 0 for none", 0.0
        ),
        Property(
            "App::PropertyLength",
            "LowestPin",
            "Pins",
            "Height of the lowest pin above the pins' base",
            USUAL.lowest_pin,
        ),
        Property(
            "App::PropertyLength",
            "TemplatePitch",
            "Templates",
            "Largest distance of templates, as far as there are stations",
            USUAL.template_pitch,
        ),
        Property(
            "App::PropertyStringList",
            "TemplateLines",
            "Templates",
            "Station lines that have a template besides: L-3, …",
        ),
        Property(
            "App::PropertyDistance",
            "Clearance",
            "Templates",
            "How much larger than the section templates are cut, all round",
            USUAL.clearance,
        ),
        Property(
            "App::PropertyStringList",
            "DownFaces",
            "Result",
            "The face of each piece that lies down",
            output=True,
        ),
        Property(
            "App::PropertyFloatList",
            "Frames",
            "Result",
            "Model to bed frame of each piece: the sixteen numbers of its matrix, row by row",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "Saddles",
            "Result",
            "Per saddle: piece, label, s, heights of the left and the right seat in mm",
            output=True,
        ),
        Property(
            "App::PropertyFloat",
            "Deviation",
            "Result",
            "Half the height of the down face's edges about the plane, largest of all pieces, mm",
            output=True,
        ),
        Property(
            "App::PropertyFloat",
            "SlopeMax",
            "Result",
            "Steepest slope from seat to seat, degrees",
            output=True,
        ),
    )

    def build(self, obj):
        made = value(obj)
        beds = made.beds
        obj.Shape = Part.Compound([_posts(bed) for bed in beds])
        obj.DownFaces = [bed.face for bed in beds]
        obj.Frames = [float(number) for bed in beds for number in bed.to_bed.ravel()]
        obj.Saddles = [
            f"{bed.name} {one.label} s={one.s:.1f} left={one.left.place[2]:.2f} "
            f"right={one.right.place[2]:.2f}"
            for bed in beds
            for one in bed.saddles
        ]
        obj.Deviation = max(bed.deviation for bed in beds)
        obj.SlopeMax = max(math.degrees(abs(one.slope)) for bed in beds for one in bed.saddles)
        return made.findings


def _posts(bed: Bed) -> Part.Compound:
    """Posts below the seats, a bar across each pair, and the floor's outline, in the model."""
    edges = []
    for saddle in bed.saddles:
        seats = np.array([saddle.left.place, saddle.right.place])
        feet = seats * (1.0, 1.0, 0.0)
        edges += [(feet[0], seats[0]), (feet[1], seats[1]), (feet[0], feet[1])]
    low, high = (f(bed.face_edges.reshape(-1, 3), axis=0) for f in (np.min, np.max))
    floor = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    corners = [np.array([x, y, 0.0]) for x, y in floor]
    edges += list(zip(corners, [*corners[1:], corners[0]], strict=True))
    placed = moved(bed.to_model, np.concatenate(edges)).reshape(-1, 2, 3)
    return Part.Compound(
        [Part.makeLine(*(FreeCAD.Vector(*point) for point in ends)) for ends in placed]
    )


def given_of(obj) -> BedInput:
    """The core input of an AssemblyBed."""
    return BedInput(
        face=obj.Face.strip() or "auto",
        plane=obj.Plane,
        normal=tuple(obj.Normal),
        spacing=obj.SaddleSpacing.Value,
        height=obj.SeatHeight.Value,
        pin_pitch=obj.PinPitch.Value,
        lowest_pin=obj.LowestPin.Value,
        template_pitch=obj.TemplatePitch.Value,
        template_lines=tuple(obj.TemplateLines),
        clearance=obj.Clearance.Value,
    )


def value(obj) -> detailing.MemberBeds:
    """The core beds of an AssemblyBed; raises BendTorsionError for what cannot be built."""
    return detailing.beds_of(plates_object.value(linked(obj, "Plates", "PlateSet")), given_of(obj))
