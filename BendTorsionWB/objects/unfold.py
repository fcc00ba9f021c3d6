# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Unfold: the flat patterns of a member's plates, as plane faces."""

from __future__ import annotations

import math

from BendTorsionWB.core import detailing
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.patterns.flattened_surface import SURFACES
from BendTorsionWB.core.patterns.flattening_errors import worst_errors
from BendTorsionWB.core.patterns.gross import SPLICES, Allowances, as_cut
from BendTorsionWB.core.patterns.laid_flat import MARKING_FACES, PatternInput
from BendTorsionWB.core.patterns.layer_names import layer_names
from BendTorsionWB.core.patterns.pattern import MODES
from BendTorsionWB.core.welds.bevels import CONTOURS
from BendTorsionWB.objects import colours
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects.proxy import Property, Proxy, linked
from BendTorsionWB.shapes import pattern_shape

FORMING_LISTS = {
    "Strains": ("largest strain of laying it flat", lambda data: data.strain.value),
    "LockedInStresses": ("membrane stress of that, MPa", lambda data: data.locked_in_stress),
    "ForcedStresses": (
        "largest stress of forcing it elastically into shape, MPa",
        lambda data: data.stress.value,
    ),
    "Twists": (
        "largest twist, degrees per metre",
        lambda data: math.degrees(1e3 * data.twist_max),
    ),
    "FlatDeviations": (
        "half its height about the best plane, mm",
        lambda data: data.flat_deviation,
    ),
    "Moments": (
        "bending moment that pulls it into shape, kNm",
        lambda data: data.pull_down.moment,
    ),
    "MiddleClamps": (
        "clamping force at mid-length beside its own weight, kN",
        lambda data: data.pull_down.clamp_middle,
    ),
    "CornerClamps": (
        "clamping force at each corner beside its own weight, kN",
        lambda data: data.pull_down.clamp_corner,
    ),
}
"""Lists of forming figures, one number per plate (0 for flat parts): meaning and figure."""

PATTERN_LISTS = {
    "Lengths": ("net length of its pattern, mm", lambda plate: plate.length),
    "Widths": ("net width of its pattern, mm", lambda plate: plate.width),
    "GrossLengths": ("length as cut, mm", lambda plate: (plate.gross or plate).length),
    "GrossWidths": ("width as cut, mm", lambda plate: (plate.gross or plate).width),
    "LengthErrors": (
        "largest flat minus true length over edges, lines and diagonals, mm",
        lambda plate: plate.length_error_max,
    ),
    "LengthErrorBounds": (
        "what no flat pattern can be below in that, mm",
        lambda plate: plate.length_error_bound,
    ),
}
"""Lists of figures of the patterns, one number per plate: meaning and figure."""


class Unfold(Proxy):
    """Flat patterns, one face per plate in mark order, laid out in rows in the XY plane."""

    TYPE = "Unfold"
    LAID_APART = True
    PROPERTIES = (
        Property("App::PropertyLink", "Plates", "Unfold", "The plates laid flat"),
        Property(
            "App::PropertyEnumeration",
            "Mode",
            "Unfold",
            "edges: both long edges keep their length; energy: least strain with straight "
            "lines; elastic: least strain",
            "edges",
            MODES,
        ),
        Property(
            "App::PropertyEnumeration",
            "FlattenedSurface",
            "Unfold",
            "The surface of the plates that is laid flat and measured",
            "mid",
            SURFACES,
        ),
        Property(
            "App::PropertyEnumeration",
            "MarkingFace",
            "Unfold",
            "The face patterns are seen from and marked on",
            "inside",
            MARKING_FACES,
        ),
        Property(
            "App::PropertyEnumeration",
            "Contour",
            "Unfold",
            "What cut files draw of bevelled edges: the edge of the surface laid flat; of the "
            "marking face (top); the line where groove and land meet; the outermost line",
            "mid",
            CONTOURS,
        ),
        *(
            Property("App::PropertyFloat", name, "Allowances", f"{meaning}, mm per m")
            for name, meaning in (
                ("ShrinkageAlong", "Shrinkage along the member, added to the patterns"),
                ("ShrinkageAcross", "Shrinkage across the member, added to the patterns"),
            )
        ),
        *(
            Property("App::PropertyFloat", name, "Allowances", f"{meaning}, mm")
            for name, meaning in (
                ("JointAllowance", "Added per butt joint, half to each of its plates"),
                ("DiaphragmAllowance", "Added per diaphragm within a plate"),
                ("GreenStart", "Left beyond the end lines at the start of the member"),
                ("GreenEnd", "Left beyond the end lines at the end of the member"),
            )
        ),
        Property(
            "App::PropertyEnumeration",
            "Splice",
            "Allowances",
            "Joints welded flat, before forming: allowance at the ends; after forming, in the "
            "box: spread over the plate",
            "after forming",
            SPLICES,
        ),
        Property(
            "App::PropertyStringList",
            "LayerNames",
            "Cut files",
            "Layers of the DXF files by other names: CUT_OUTER=10, MARK_LINE=20, …",
        ),
        Property(
            "App::PropertyStringList",
            "Marks",
            "Result",
            "Position marks, as the faces",
            output=True,
        ),
        Property(
            "App::PropertyFloatList",
            "Areas",
            "Result",
            "Net area of each pattern, mm2",
            output=True,
        ),
        Property(
            "App::PropertyFloatList",
            "GrossAreas",
            "Result",
            "Area of each pattern with its allowances, as cut, mm2",
            output=True,
        ),
        *(
            Property("App::PropertyFloatList", name, "Result", f"Per plate: {meaning}", output=True)
            for name, (meaning, _) in PATTERN_LISTS.items()
        ),
        *(
            Property("App::PropertyFloat", name, "Result", f"Largest {meaning}", output=True)
            for name, meaning in (
                ("EdgeErrorMax", "flat minus true length of the long edges, mm"),
                ("LineErrorMax", "flat minus true length of the lines, mm"),
                ("DiagonalErrorMax", "flat minus true length of the panel diagonals, mm"),
                ("CentreLineErrorMax", "flat minus true length of the centre lines, mm"),
                ("AreaErrorMax", "flat minus true area of a plate, mm2"),
                ("SeamMismatchMax", "miss of the stations of two plates along their seam, mm"),
            )
        ),
        Property(
            "App::PropertyStringList",
            "Forming",
            "Result",
            "Forming class of each plate: flat, elastic, cold or hot",
            output=True,
        ),
        Property(
            "App::PropertyFloatList",
            "BendingRadii",
            "Forming",
            "Per plate: smallest bending radius, mm; infinite for a flat one",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "FormingNotes",
            "Forming",
            "Per plate: class, the rule that decided, and how it is brought into shape",
            output=True,
        ),
        *(
            Property(
                "App::PropertyFloatList", name, "Forming", f"Per plate: {meaning}", output=True
            )
            for name, (meaning, _) in FORMING_LISTS.items()
        ),
        Property(
            "App::PropertyFloat",
            "LengthErrorMax",
            "Result",
            "Largest flat minus true length over edges, lines and diagonals, mm",
            output=True,
        ),
        Property(
            "App::PropertyFloat",
            "StrainMax",
            "Result",
            "Largest strain of laying a plate flat",
            output=True,
        ),
        *colours.PROPERTIES,
    )

    def build(self, obj):
        layer_names(obj.LayerNames, obj.Label)
        record = member_record_of(obj)
        obj.Shape = pattern_shape.laid_out(record.plates)
        obj.Marks = [plate.mark for plate in record.plates]
        obj.Areas = [plate.area for plate in record.plates]
        obj.GrossAreas = [as_cut(plate).area for plate in record.plates]
        for name, (_, figure) in PATTERN_LISTS.items():
            setattr(obj, name, [figure(plate) for plate in record.plates])
        for name, errors in worst_errors(record.plates).items():
            setattr(obj, f"{name}Max", errors)
        obj.Forming = [plate.forming for plate in record.plates]
        forming = [plate.forming_data for plate in record.plates]
        obj.FormingNotes = ["" if data is None else data.note() for data in forming]
        obj.BendingRadii = [plate.bending_radius_min for plate in record.plates]
        for name, (_, figure) in FORMING_LISTS.items():
            setattr(obj, name, [0.0 if data is None else figure(data) for data in forming])
        colours.set_colours(obj, obj.Marks, record.plates)
        obj.LengthErrorMax = max(plate.length_error_max for plate in record.plates)
        obj.StrainMax = max(plate.strain_max for plate in record.plates)
        return record.findings


def member_record_of(obj) -> MemberRecord:
    """The lofting record of an Unfold; raises BendTorsionError for what cannot be built."""
    return detailing.record_of(
        plates_object.value(linked(obj, "Plates", "PlateSet")), pattern_input(obj)
    )


def pattern_input(obj) -> PatternInput:
    """How an Unfold lays plates flat."""
    return PatternInput(
        obj.Mode,
        obj.FlattenedSurface,
        obj.MarkingFace,
        Allowances(
            obj.ShrinkageAlong,
            obj.ShrinkageAcross,
            obj.JointAllowance,
            obj.DiaphragmAllowance,
            obj.GreenStart,
            obj.GreenEnd,
            obj.Splice,
        ),
        obj.Contour,
    )
