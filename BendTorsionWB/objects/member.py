# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Member: sections along an axis, with their cuts, transitions and alignments."""

from __future__ import annotations

import math

import numpy as np

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis import Axis
from BendTorsionWB.core.axes.axis_places import cut_place
from BendTorsionWB.core.axes.frames import torsion_angle
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.members import segment
from BendTorsionWB.core.members.thickness import USUAL_RULES, ThicknessRules
from BendTorsionWB.core.members.zone_table import zone_records
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import end_cuts
from BendTorsionWB.objects import section_spec as section_object
from BendTorsionWB.objects.proxy import Property, Proxy, add_property, linked
from BendTorsionWB.shapes import brep, cut_solid

_DISTANCE = "App::PropertyDistance"


CUT_BY = ("place", "crossing", "point")
MOST_SEGMENTS = 200
"""Of a member. Each has properties of its own, and FreeCAD adds a thousand in seconds, then in
minutes."""


class Member(Proxy):
    """A member: its outer skin (of open sections its strips) is the shape."""

    TYPE = "Member"
    PROPERTIES = (
        Property("App::PropertyLink", "Axis", "Member", "The axis the member follows"),
        Property("App::PropertyInteger", "Segments", "Member", "Number of segments", 1),
        Property(
            _DISTANCE, "OffsetY", "Member", "Offset of the whole member along its breadth", 0.0
        ),
        Property(
            _DISTANCE, "OffsetZ", "Member", "Offset of the whole member along its height", 0.0
        ),
        Property("App::PropertyAngle", "Roll", "Member", "Turn about the axis", 0.0),
        Property(
            "App::PropertyEnumeration",
            "TransitionLength",
            "Member",
            "Transition length from the largest step of a face, or from the total change",
            "face",
            segment.TRANSITION_LENGTHS,
        ),
        Property(
            "App::PropertyLength",
            "JointStagger",
            "Thickness changes",
            "Least distance between the thickness joints of adjacent faces",
            USUAL_RULES.stagger,
        ),
        Property(
            "App::PropertyLength",
            "FoldClearance",
            "Thickness changes",
            "Least distance of a staggered thickness joint from a fold",
            USUAL_RULES.fold_clearance,
        ),
        Property(
            "App::PropertyFloat",
            "ChamferSlope",
            "Thickness changes",
            "Length of the chamfer of the thicker plate over its depth; 0 for none",
            USUAL_RULES.chamfer_slope,
        ),
        Property(
            "App::PropertyInteger",
            "Rank",
            "Member",
            "Where members meet the lower rank runs through",
            0,
        ),
        *end_cuts.PROPERTIES,
        Property("App::PropertyLength", "Length", "Result", "Length of the axis", output=True),
        Property(
            "App::PropertyArea",
            "PaintedArea",
            "Result",
            "Area seen from outside, ends apart",
            output=True,
        ),
        Property(
            "App::PropertyAngle",
            "TotalTorsion",
            "Result",
            "Torsion angle from start to end",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "Zones",
            "Result",
            "Constant (d) and transition (b) zones: start and end, mm, slope, the paper's group",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "FaceSteps",
            "Result",
            "Steps of the top, bottom, left and right face at each cut, mm",
            output=True,
        ),
    )

    def declared(self, obj):
        count = segment_count(obj) if "Segments" in obj.PropertiesList else 1
        return (*self.PROPERTIES, *segment_properties(max(1, count)))

    def onChanged(self, obj, name):
        """Give each further segment its properties."""
        super().onChanged(obj, name)
        if name == "Segments" and "SchemaVersion" in obj.PropertiesList:
            for declared in segment_properties(segment_count(obj)):
                add_property(obj, declared)

    def build(self, obj):
        geometry = value(obj)
        member = geometry.member
        obj.Shape = brep.compound(cut_solid.member_solids(geometry))
        obj.Length = member.length
        obj.PaintedArea = detailing.painted_area(geometry)
        obj.TotalTorsion = float(np.degrees(torsion_angle(member.frames)[1][-1]))
        obj.Zones = [_zone_line(zone) for zone in zone_records(member.law)]
        obj.FaceSteps = [
            f"top {s.top:+.3f} bottom {s.bottom:+.3f} left {s.left:+.3f} right {s.right:+.3f}"
            for s in member.law.face_steps
        ]
        return geometry.findings


def _zone_line(zone) -> str:
    slope = f" 1:{zone.slope:.4g}" if zone.slope else ""
    return f"{zone.label} {zone.start:.3f} {zone.end:.3f}{slope} {zone.group}"


def segment_count(obj) -> int:
    """How many segments of a Member have properties: what Segments says, if that can be."""
    return min(obj.Segments, MOST_SEGMENTS)


def refuse_many_segments(obj, count: int) -> None:
    """Raises BendTorsionError for more segments than a Member can have."""
    if count > MOST_SEGMENTS:
        raise BendTorsionError(
            error(
                "segments",
                obj.Label,
                "more segments than a member can have",
                "make members of it",
                position="property Segments",
                value=count,
                limit=MOST_SEGMENTS,
            )
        )


def segment_properties(count: int) -> tuple[Property, ...]:
    """The properties of segments 1 … count."""
    properties = []
    for k in range(1, count + 1):
        group = f"Segment {k}"
        properties.append(Property("App::PropertyLink", f"Section{k}", group, "The section"))
        properties += [
            Property(
                _DISTANCE,
                f"Cut{k}",
                group,
                "Where the transition to the segment starts, from the start of the axis; of "
                "segment 1 on closed axes only",
                0.0,
            ),
            Property(
                "App::PropertyFloat",
                f"CutRatio{k}",
                group,
                "Where it starts as a part of the length; 0 to use the distance",
                0.0,
            ),
            Property(
                "App::PropertyEnumeration",
                f"CutBy{k}",
                group,
                "place: by Cut or CutRatio; crossing: where CutAxis crosses; point: nearest "
                "to CutPoint",
                "place",
                CUT_BY,
            ),
            Property("App::PropertyLink", f"CutAxis{k}", group, "The crossing axis"),
            Property("App::PropertyVector", f"CutPoint{k}", group, "A point near the axis, mm"),
            Property(_DISTANCE, f"CutOffset{k}", group, "Moves the cut along the axis", 0.0),
            Property(
                "App::PropertyFloat",
                f"Slope{k}",
                group,
                "Length of the transition per millimetre of step; 0 for a step",
                segment.DEFAULT_SLOPE,
            ),
            Property(
                "App::PropertyEnumeration",
                f"Transition{k}",
                group,
                "Linear, with a fold at each end, or smooth over the same length",
                "linear",
                segment.TRANSITIONS,
            ),
            Property(
                "App::PropertyString",
                f"Stagger{k}",
                group,
                "Offsets of the faces' thickness joints: auto, none, or mm such as top=0 left=200",
                "auto",
            ),
            Property(
                "App::PropertyEnumeration",
                f"Align{k}",
                group,
                "What lies on the axis, or is flush with the segment before",
                "centre",
                segment.ALIGNMENTS,
            ),
            Property(
                "App::PropertyEnumeration",
                f"AlignTo{k}",
                group,
                "Align to the axis, to the previous segment, or hold the top or bottom face at "
                "the offset from the surface itself",
                "axis",
                segment.ALIGN_TO,
            ),
            Property(_DISTANCE, f"OffsetY{k}", group, "Offset along the breadth", 0.0),
            Property(_DISTANCE, f"OffsetZ{k}", group, "Offset along the height", 0.0),
        ]
    return tuple(properties)


def value(obj) -> detailing.MemberGeometry:
    """The core geometry of a Member; raises BendTorsionError for what cannot be built."""
    if obj.Segments < 1:
        raise BendTorsionError(
            error(
                "segments",
                obj.Label,
                "a member needs a segment",
                "set Segments to 1 or more",
                value=obj.Segments,
                limit=1,
            )
        )
    refuse_many_segments(obj, obj.Segments)
    target = linked(obj, "Axis", "Axis")
    axis = axis_object.value(target)
    segments = tuple(_segment(obj, k, axis) for k in range(1, obj.Segments + 1))
    given = detailing.MemberInput(
        obj.Label,
        segments,
        obj.OffsetY.Value,
        obj.OffsetZ.Value,
        math.radians(obj.Roll.Value),
        obj.TransitionLength,
        axis_object.frame_value(target),
        ThicknessRules(obj.JointStagger.Value, obj.FoldClearance.Value, obj.ChamferSlope),
        *end_cuts.end_cuts(obj),
    )
    return detailing.member_of(given, axis, axis_object.surface_value(target))


def _segment(obj, k: int, axis: Axis) -> segment.Segment:
    cut, is_ratio = cut_of(obj, k, axis)
    return segment.Segment(
        section_object.value(linked(obj, f"Section{k}", "SectionSpec")),
        cut,
        getattr(obj, f"Slope{k}"),
        getattr(obj, f"Align{k}"),
        getattr(obj, f"AlignTo{k}"),
        getattr(obj, f"OffsetY{k}").Value,
        getattr(obj, f"OffsetZ{k}").Value,
        is_ratio,
        getattr(obj, f"Transition{k}"),
        getattr(obj, f"Stagger{k}"),
    )


def cut_of(obj, k: int, axis: Axis) -> tuple[float, bool]:
    """The cut before segment k, and whether it is a part of the length rather than mm."""
    by, offset = getattr(obj, f"CutBy{k}"), getattr(obj, f"CutOffset{k}").Value
    if by == "crossing":
        other = axis_object.value(linked(obj, f"CutAxis{k}", "Axis"))
        return cut_place(axis, crossing=other, offset=offset), False
    if by == "point":
        point = np.array(tuple(getattr(obj, f"CutPoint{k}")))
        return cut_place(axis, point=point, offset=offset, reach=reach(obj)), False
    # Cuts beyond the axis are left to the section law, which names the segment.
    ratio = getattr(obj, f"CutRatio{k}")
    if not ratio:
        return getattr(obj, f"Cut{k}").Value + offset, False
    return (ratio * axis.length + offset, False) if offset else (ratio, True)


def reach(obj) -> float:
    """How far from its axis a Member may reach, mm: the circle about its sections, wherever they
    are held, and their offsets. Sections in error count as none."""
    farthest = before = 0.0
    for k in range(1, segment_count(obj) + 1):
        try:
            section = section_object.value(linked(obj, f"Section{k}", "SectionSpec"))
        except BendTorsionError:
            continue
        offset = math.hypot(getattr(obj, f"OffsetY{k}").Value, getattr(obj, f"OffsetZ{k}").Value)
        own = math.hypot(section.h, section.b) + offset
        # One that is held to the segment before starts from where that may be.
        before = own if getattr(obj, f"AlignTo{k}") == "axis" else own + before
        farthest = max(farthest, before)
    return farthest + math.hypot(obj.OffsetY.Value, obj.OffsetZ.Value)
