# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing of the split editor as it is looked at, and the keys that are its own."""

from __future__ import annotations

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.row_table import typed

STEP = 10.0
"""Millimetres a joint moves with an arrow key; ten times with Shift."""
MOVES = {QtCore.Qt.Key_Left: -STEP, QtCore.Qt.Key_Right: STEP}
TURNS = {QtCore.Qt.Key_Up: -1, QtCore.Qt.Key_Down: 1}
KEYS = (*MOVES, *TURNS, QtCore.Qt.Key_Insert, QtCore.Qt.Key_Delete)


class StripView(QtWidgets.QGraphicsView):
    """Shows the whole drawing; keys without a joint chosen choose the first."""

    def __init__(self, panel):
        super().__init__(panel.scene)
        self.panel = panel
        self.setRenderHint(QtGui.QPainter.Antialiasing)
        self.setMinimumSize(560, 270)

    def show_all(self) -> None:
        """Fit the drawing into the view."""
        self.fitInView(self.scene().sceneRect(), QtCore.Qt.KeepAspectRatio)

    def event(self, event):
        """Keep its keys and all letters from FreeCAD's shortcuts: Del would delete the plates, a
        space hide them, and a figure turn the view."""
        if not isinstance(event, QtCore.QEvent):
            # PySide knows events by their address, and gives what lived there before.
            return False
        if event.type() == QtCore.QEvent.ShortcutOverride and (
            event.key() in KEYS or typed(event) or self._drops(event)
        ):
            event.accept()
            return True
        return super().event(event)

    def _drops(self, event) -> bool:
        """Whether a key takes back no more than the drag."""
        return self.panel.dragged and event.key() == QtCore.Qt.Key_Escape

    def keyPressEvent(self, event):
        """Keys of the editor go no further than here."""
        if self._drops(event):
            self.panel.drop()
            event.accept()
            return
        if event.key() in KEYS:
            self.panel.press(event.key(), bool(event.modifiers() & QtCore.Qt.ShiftModifier))
            event.accept()
        elif typed(event):
            self.panel.type_place(event)
            event.accept()
        else:
            super().keyPressEvent(event)

    def resizeEvent(self, event):
        """Fit it again."""
        super().resizeEvent(event)
        self.show_all()
