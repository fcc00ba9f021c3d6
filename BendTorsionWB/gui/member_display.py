# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is shown of members: their plates, their outer skin or only their axis."""

from __future__ import annotations

import FreeCAD

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

MODES = {
    "plates": QT_TRANSLATE_NOOP("BendTorsion", "Show plates"),
    "skin": QT_TRANSLATE_NOOP("BendTorsion", "Show outer skin"),
    "axis": QT_TRANSLATE_NOOP("BendTorsion", "Show axis only"),
}


def show_as(members, mode: str) -> None:
    """Show members in one of MODES; without plates their skin stands for them."""
    for member in members:
        plates = [user for user in member.InList if getattr(user, "BT_Type", "") == "PlateSet"]
        for item in plates:
            item.ViewObject.Visibility = mode == "plates"
        member.ViewObject.Visibility = mode == "skin" or (mode == "plates" and not plates)
        if member.Axis is not None and member.Axis.ViewObject is not None:
            member.Axis.ViewObject.Visibility = mode == "axis"


def mode_of(member) -> str:
    """The mode a member is shown in; empty when nothing of it is."""
    if member.ViewObject.Visibility:
        return "skin"
    for user in member.InList:
        if getattr(user, "BT_Type", "") == "PlateSet" and user.ViewObject.Visibility:
            return "plates"
    return "axis" if member.Axis is not None and member.Axis.ViewObject.Visibility else ""
