# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where there is room for flat patterns: beside the model and those laid out before, in plan."""

from __future__ import annotations

from BendTorsionWB.core import detailing
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.objects import plate_set
from BendTorsionWB.objects.proxy import type_of
from BendTorsionWB.shapes.pattern_shape import ROW_GAP

CLEAR = 5.0 * ROW_GAP
"""Clear distance from the model and from the patterns of other members, mm."""


def free_place(document, plates) -> tuple[float, float, float]:
    """Where the first of the patterns of a PlateSet starts so that all of them lie clear, mm; the
    origin for plates in error.

    Below everything there is in plan, y downwards, at the height of its lowest point. The size of
    an analytic surface says nothing of where the model is, and does not count.
    """
    try:
        record = detailing.record_of(plate_set.value(plates))
    except BendTorsionError:
        return 0.0, 0.0, 0.0
    boxes = [obj.Shape.BoundBox for obj in document.Objects if _counts(obj)]
    # Patterns just made have no shape yet; they lie above their place.
    new = [obj.Placement.Base for obj in document.Objects if _is_new(obj)]
    left = min([*(box.XMin for box in boxes), *(place.x for place in new)], default=0.0)
    lowest = min([*(box.YMin for box in boxes), *(place.y for place in new)], default=0.0)
    plane = min([*(box.ZMin for box in boxes), *(place.z for place in new)], default=0.0)
    height = sum(plate.width + ROW_GAP for plate in record.plates) - ROW_GAP
    return round(left, 1), round(lowest - CLEAR - height, 1), round(plane, 1)


def _is_new(obj) -> bool:
    return type_of(obj) == "Unfold" and not obj.Shape.SubShapes


def _counts(obj) -> bool:
    shape = getattr(obj, "Shape", None)
    if not hasattr(shape, "isNull") or shape.isNull() or not shape.BoundBox.isValid():
        return False
    kind = type_of(obj)
    if kind in ("SectionSpec", "PageOutlines"):
        return False
    return kind != "Surface" or obj.Kind == "face"
