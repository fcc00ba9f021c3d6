# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Unfold: the flat patterns of a member's plates, as wires."""

from __future__ import annotations

from BendTorsionWB.core import detailing
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.pattern import MODES
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects.proxy import Property, Proxy, linked
from BendTorsionWB.shapes import pattern_shape


class Unfold(Proxy):
    """Flat patterns, one wire per plate in mark order, laid out in rows in the XY plane."""

    TYPE = "Unfold"
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
            "App::PropertyStringList",
            "Marks",
            "Result",
            "Position marks, as the wires",
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
            "App::PropertyStringList",
            "Forming",
            "Result",
            "Forming class of each plate: flat, elastic, cold or hot",
            output=True,
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
    )

    def build(self, obj):
        record = member_record_of(obj)
        obj.Shape = pattern_shape.laid_out(record.plates)
        obj.Marks = [plate.mark for plate in record.plates]
        obj.Areas = [plate.area for plate in record.plates]
        obj.Forming = [plate.forming for plate in record.plates]
        obj.LengthErrorMax = max(plate.length_error_max for plate in record.plates)
        obj.StrainMax = max(plate.strain_max for plate in record.plates)
        return record.findings


def member_record_of(obj) -> MemberRecord:
    """The lofting record of an Unfold; raises BendTorsionError for what cannot be built."""
    return detailing.record_of(plates_object.value(linked(obj, "Plates", "PlateSet")), obj.Mode)
