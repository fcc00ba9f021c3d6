# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the 3D view shows beside the shape of an object: labels of plates, ribbons of frames."""

from __future__ import annotations

from pivy import coin

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes import frames
from BendTorsionWB.core.axes.frames import Frames
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.gui import frame_ribbon, plate_labels
from BendTorsionWB.gui.label_layer import LabelLayer
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import plate_set as plates_object

RIBBON = 0.04
"""Height of a frame ribbon as a part of the axis's length."""


def holder(view) -> coin.SoSeparator:
    """A node in the view of an object to put things into; they cannot be picked."""
    group, style = coin.SoSeparator(), coin.SoPickStyle()
    style.style = coin.SoPickStyle.UNPICKABLE
    group.addChild(style)
    view.RootNode.addChild(group)
    return group


def fill(group: coin.SoSeparator, obj, wanted: set[str], frame_height: float):
    """Put what is wanted (`ShowMarks`, `ShowPoints`, `ShowFrames`) into a holder, and nothing else;
    the layer of labels, to be kept as long as it is seen. An object in error shows nothing."""
    while group.getNumChildren() > 1:
        group.removeChild(1)
    if not wanted or not obj.Shape.SubShapes:
        return None
    try:
        if "ShowFrames" in wanted:
            framed = _frames(obj)
            height = frame_height or RIBBON * framed.axis.length
            group.addChild(frame_ribbon.ribbon(framed, height))
        if wanted & {"ShowMarks", "ShowPoints"}:
            labels = plate_labels.mark_labels(obj, _middles(obj)) if "ShowMarks" in wanted else []
            if "ShowPoints" in wanted:
                lines, named = plate_labels.point_labels(_record(obj))
                labels += named
                if lines is not None:
                    group.addChild(lines)
            layer = LabelLayer(labels)
            group.addChild(layer.node)
            return layer
    except BendTorsionError:
        pass  # The object's own findings say why, once it is recomputed.
    return None


def _middles(obj) -> list[tuple]:
    """Where the marks of a PlateSet stand, as saved with it: nothing has to be computed for a
    building just opened. Documents of earlier releases do not have them."""
    if len(obj.PlateMiddles) == len(obj.Marks):
        return list(zip(obj.PlateMiddles, obj.PlateDirections, strict=True))
    return plates_object.middles_of(plates_object.value(obj))


def _record(obj) -> MemberRecord:
    return detailing.record_of(plates_object.value(obj))


def _frames(obj) -> Frames:
    surface = axis_object.surface_value(obj)
    return frames.frames_of(axis_object.value(obj), surface, axis_object.frame_value(obj))
