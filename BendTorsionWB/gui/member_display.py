# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is shown of members: their plates, their outer skin or only their axis.

FreeCAD hides and shows single objects. Hiding a member hides its plates, showing it shows them, as
they stand for it; its skin, which lies in the faces of the plates, is seen by `show_as` alone.
"""

from __future__ import annotations

from contextlib import contextmanager

import FreeCAD

from BendTorsionWB.gui.qt import QtCore

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

MODES = {
    "plates": QT_TRANSLATE_NOOP("BendTorsion", "Show plates"),
    "skin": QT_TRANSLATE_NOOP("BendTorsion", "Show outer skin"),
    "axis": QT_TRANSLATE_NOOP("BendTorsion", "Show axis only"),
}
_chosen: list = []
"""Members of which `show_as` says what is shown."""


def plates_of(member) -> list:
    """The PlateSets of a Member."""
    return [user for user in member.InList if getattr(user, "BT_Type", "") == "PlateSet"]


def plates_shown(member) -> list:
    """Those of them that are seen."""
    return [plates for plates in plates_of(member) if plates.ViewObject.Visibility]


def seen_of(member) -> list:
    """What is seen of a member: its plates, its own skin, or its axis."""
    own = [
        item for item in (member, member.Axis) if item is not None and item.ViewObject.Visibility
    ]
    return plates_shown(member) or own


def show_as(members, mode: str) -> None:
    """Show members in one of MODES; without plates their skin stands for them."""
    for member in members:
        plates = plates_of(member)
        for item in plates:
            item.ViewObject.Visibility = mode == "plates"
        with _choosing(member):
            member.ViewObject.Visibility = mode == "skin" or (mode == "plates" and not plates)
        if member.Axis is not None and member.Axis.ViewObject is not None:
            member.Axis.ViewObject.Visibility = mode == "axis"


def hide_skin(member) -> None:
    """Hide a member's own shape; its plates stay as they are."""
    with _choosing(member):
        member.ViewObject.Visibility = False


@contextmanager
def _choosing(member):
    _chosen.append(member)
    try:
        yield
    finally:
        _chosen.remove(member)


def follow(member, before: bool) -> None:
    """Have the plates of a member follow when it is hidden or shown; before: whether its own shape
    was seen before that."""
    now = member.ViewObject.Visibility
    if member in _chosen or member.Document.Restoring or member.Document.Transacting:
        # An undo and a redo bring back what was seen of each.
        return
    if now and not before and plates_of(member):
        # FreeCAD shows the skin once this is done.
        at = member.Document.Name, member.Name
        QtCore.QTimer.singleShot(0, lambda: _show_plates(*at))
    elif not now and not before:
        for plates in plates_shown(member):
            # Plates just made take the place of the skin, which is hidden then.
            if not plates.ViewObject.Proxy.is_new:
                plates.ViewObject.Visibility = False


def _show_plates(document: str, name: str) -> None:
    found = FreeCAD.listDocuments().get(document)
    member = found.getObject(name) if found is not None else None
    if member is None or not plates_of(member):
        return
    # In error nothing of it is seen: the plates are when it is mended.
    if member.ViewObject.Visibility or member.ViewObject.HiddenByError:
        show_as([member], "plates")


def mode_of(member) -> str:
    """The mode a member is shown in; empty when nothing of it is."""
    if member.ViewObject.Visibility:
        return "skin"
    if plates_shown(member):
        return "plates"
    return "axis" if member.Axis is not None and member.Axis.ViewObject.Visibility else ""
