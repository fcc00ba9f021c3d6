# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which of the nine positions of a section lies where a member was clicked in the 3D view."""

from __future__ import annotations

import FreeCAD
import FreeCADGui
import numpy as np

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui.alignment_picker import ROWS
from BendTorsionWB.gui.tree import LINKED_ABOVE

EDGE = 1.0 / 3.0
"""Part of a face from its edge that stands for the corner."""


class FacePick:
    """Selection observer: tells `chosen` the position clicked on one of the members or their
    plates, until `stop`."""

    def __init__(self, members, chosen):
        self.members, self.chosen = list(members), chosen
        FreeCADGui.Selection.addObserver(self)

    def stop(self) -> None:
        """Follow the selection no longer."""
        FreeCADGui.Selection.removeObserver(self)

    def addSelection(self, document, name, sub, point):
        """Called by FreeCAD for each pick."""
        obj = FreeCAD.getDocument(document).getObject(name) if sub else None
        if getattr(obj, "BT_Type", "") == "PlateSet":
            obj = getattr(obj, LINKED_ABOVE["PlateSet"])
        if obj is None or obj not in self.members:
            return
        found = position_at(obj, point)
        if found:
            self.chosen(found)


def position_at(member, point) -> str:
    """The position of a Member's section nearest to a point (x, y, z) on it; empty when the member
    is in error or the point is not near it."""
    from BendTorsionWB.core.axes.axis_places import cut_place
    from BendTorsionWB.objects import member as member_object

    try:
        geometry = member_object.value(member).member
        axis, reach = geometry.frames.axis, member_object.reach(member)
        s = cut_place(axis, point=np.array(tuple(point), float), reach=reach)
    except BendTorsionError:
        return ""
    at = geometry.frames.at(np.array([s]))
    away = np.array(tuple(point), float) - at.origin[0]
    y, z = float(away @ at.y[0]), float(away @ at.z[0])
    cell = next((c for c in geometry.law.cells if c.start <= s <= c.end), geometry.law.cells[-1])
    corners = cell.corners_at(np.array([s]))[0]
    low, high = corners.min(axis=0), corners.max(axis=0)
    from_left = (high[0] - y) / (high[0] - low[0])
    from_top = (high[1] - z) / (high[1] - low[1])
    return ROWS[_third(from_top)][_third(from_left)]


def _third(part: float) -> int:
    return 0 if part < EDGE else 2 if part > 1.0 - EDGE else 1
