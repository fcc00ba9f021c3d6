# SPDX-License-Identifier: LGPL-2.1-or-later
"""Icons of objects in the tree, with a badge on those in error and those with warnings."""

from __future__ import annotations

from functools import cache

import FreeCADGui

from BendTorsionWB.gui import resources
from BendTorsionWB.gui.qt import QtCore, QtGui

ICONS = {
    "Surface": "BendTorsion_Surface",
    "Axis": "BendTorsion_Axis",
    "SectionSpec": "BendTorsion_Section",
    "Member": "BendTorsion_Member",
    "PlateSet": "BendTorsion_Plates",
    "Unfold": "BendTorsion_Development",
    "Node": "BendTorsion_Node",
    "AssemblyBed": "BendTorsion_AssemblyBed",
    "SheetSet": "BendTorsion_Sheets",
    "ArrangementSet": "BendTorsion_Sheets",
    "NodeSheets": "BendTorsion_Sheets",
}
"""The icon of a kind is that of the command that makes it; the workbench's where there is none."""

BADGES = {"error": "#d32f2f", "warning": "#f9a825"}
SIZE = 64


def path_of(kind: str) -> str:
    """Path of the icon of a kind of object."""
    return resources.icon(ICONS.get(kind, "BendTorsion"))


@cache
def icon_of(kind: str, severity: str):
    """The icon (QIcon) of a kind; severity: of the worst finding, empty when there is none."""
    plain = _drawn(kind)
    icon = QtGui.QIcon()
    # The tree greys the icons of hidden objects; a badge is to stand out there too.
    for mode in (QtGui.QIcon.Normal, QtGui.QIcon.Disabled):
        icon.addPixmap(_with_badge(plain.pixmap(SIZE, SIZE, mode), severity), mode)
    return icon


def _drawn(kind: str):
    """The icon (QIcon) of a kind as its file has it."""
    plain = QtGui.QIcon(path_of(kind))
    if plain.pixmap(SIZE, SIZE).isNull():
        # Qt 6 reads SVG by a plug-in that need not be installed; FreeCAD draws SVG by itself.
        FreeCADGui.addIconPath(str(resources.FOLDER / "icons"))
        plain = FreeCADGui.getIcon(ICONS.get(kind, "BendTorsion"))
    return plain


def _with_badge(picture, severity: str):
    if severity not in BADGES:
        return picture
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    if severity == "error":
        _stop_sign(painter)
    else:
        _warning_sign(painter)
    painter.end()
    return picture


def _stop_sign(painter) -> None:
    """A red disc with a cross at the lower right."""
    painter.setPen(QtGui.QPen(QtGui.QColor("white"), 2.5))
    painter.setBrush(QtGui.QColor(BADGES["error"]))
    painter.drawEllipse(QtCore.QRectF(26.0, 26.0, 36.0, 36.0))
    painter.setPen(QtGui.QPen(QtGui.QColor("white"), 6.0))
    painter.drawLine(QtCore.QPointF(37.0, 37.0), QtCore.QPointF(51.0, 51.0))
    painter.drawLine(QtCore.QPointF(51.0, 37.0), QtCore.QPointF(37.0, 51.0))


def _warning_sign(painter) -> None:
    """A yellow triangle with an exclamation mark at the lower right."""
    painter.setPen(QtGui.QPen(QtGui.QColor("#3e2f00"), 2.5))
    painter.setBrush(QtGui.QColor(BADGES["warning"]))
    corners = ((44.0, 25.0), (62.0, 61.0), (26.0, 61.0))
    painter.drawPolygon(QtGui.QPolygonF([QtCore.QPointF(*corner) for corner in corners]))
    painter.setPen(QtGui.QPen(QtGui.QColor("#3e2f00"), 5.0))
    painter.drawLine(QtCore.QPointF(44.0, 38.0), QtCore.QPointF(44.0, 48.0))
    painter.drawPoint(QtCore.QPointF(44.0, 55.0))
