# SPDX-License-Identifier: LGPL-2.1-or-later
"""Room for a task panel: the side of the window is widened for its fields, and narrowed after."""

from __future__ import annotations

import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets

MARGIN = 60
"""Pixels that FreeCAD draws around a task panel."""
GONE = 200
"""Milliseconds after which FreeCAD has taken a closed panel down."""


class PanelRoom:
    """Where the widget of a panel, `form`, stands: in the window's own side, or over the view as
    FreeCAD 1.1 has it."""

    def __init__(self, form: QtWidgets.QWidget):
        self.form = form
        self.before: tuple[QtWidgets.QDockWidget, int] | None = None

    def dock(self) -> QtWidgets.QDockWidget | None:
        """The dock the panel stands in, once it is shown."""
        # Asked of the window, which lasts: a parent PySide gives goes when it is used no more, and
        # with it all it was asked for, such as the buttons of the panel.
        docks = FreeCADGui.getMainWindow().findChildren(QtWidgets.QDockWidget)
        return next((dock for dock in docks if dock.isAncestorOf(self.form)), None)

    def over_view(self) -> bool:
        """Whether the panel stands over the view."""
        dock = self.dock()
        return dock is not None and _overlay(dock) is not None

    def widen(self, width: int) -> None:
        """Make room for fields that ask for some pixels, if there is less."""
        dock = self.dock()
        if dock is not None and dock.width() < width + MARGIN:
            self.before = dock, dock.width()
            _resize(dock, width + MARGIN)

    def give_back(self) -> None:
        """Leave the side as wide as the user has it, once the panel is closed."""
        if self.before is None:
            return
        dock, width = self.before

        def narrow():
            if not FreeCADGui.Control.activeDialog():
                _resize(dock, width)

        # Again when the fields are gone, which may be wider than that until then.
        for pause in (0, GONE):
            QtCore.QTimer.singleShot(pause, narrow)


def _overlay(dock):
    """What holds a dock over the view, or None."""
    holder = dock.parent()
    while holder is not None and holder.metaObject().className() != "Gui::OverlayTabWidget":
        holder = holder.parent()
    return holder


def _resize(dock, width: int) -> None:
    window, overlay = FreeCADGui.getMainWindow(), _overlay(dock)
    if overlay is None:
        window.resizeDocks([dock], [width], QtCore.Qt.Horizontal)
        return
    # No one but the grip at its edge, which users drag, can make it wider.
    place, width = overlay.geometry(), min(width, window.width())
    edges = {"OverlayRight": place.right() + 1 - width, "OverlayLeft": place.left() + width}
    if overlay.objectName() not in edges:
        # Above or below the view it is as wide as that.
        return
    edge = QtCore.QPoint(edges[overlay.objectName()], place.top())
    # Only what must be asked: PySide6 lets go of all it was shown below a widget with that widget.
    title = overlay.findChild(QtWidgets.QWidget, "OverlayTitle")
    for grip in title.children() if title is not None else ():
        if grip.metaObject().className() == "Gui::OverlaySizeGrip":
            grip.dragMove.emit(window.mapToGlobal(edge))
