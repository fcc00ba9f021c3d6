# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's own commands that would end what a task panel tries out, held while it is open.

Delete, undo and the like open a transaction of their own, which keeps the one of the panel; Cancel
could take nothing back then, and the object under edit could be gone.
"""

from __future__ import annotations

from collections.abc import Callable

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask
from BendTorsionWB.gui.qt import QtCore, QtGui

translate = FreeCAD.Qt.translate
EVERY = 500
"""Milliseconds between two looks whether the panel is still there."""
HELD = ("Std_Delete", "Std_Undo", "Std_Redo", "Std_Cut", "Std_Paste", "Std_DuplicateSelection")


class HeldCommands(QtCore.QObject):
    """Holds them, by menu, button and key, until `release`; a key says why. gone: called when the
    panel was closed behind its back, as a macro may do."""

    def __init__(self, gone: Callable[[], None]):
        super().__init__()
        self.gone = gone
        found = [FreeCADGui.Command.get(name) for name in HELD]
        self.actions = [action for item in found if item for action in item.getAction()]
        for action in self.actions:
            action.blockSignals(True)
        # FreeCAD 1.0 may keep a key from its action: heard where all keys pass.
        self.window = FreeCADGui.getMainWindow()
        self.window.installEventFilter(self)
        self.timer = QtCore.QTimer(self)
        self.timer.timeout.connect(self._look)
        self.timer.start(EVERY)

    def _look(self) -> None:
        if not FreeCADGui.Control.activeDialog():
            self.release()
            self.gone()

    def release(self) -> None:
        """Give them back."""
        self.timer.stop()
        self.window.removeEventFilter(self)
        for action in self.actions:
            action.blockSignals(False)
        self.actions = []

    def eventFilter(self, window, event):
        """Called by Qt before the window has a key that nothing in front of it took."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent):
            return False
        if event.type() == QtCore.QEvent.ShortcutOverride and self._keys(event):
            ask.tell(translate("BendTorsion", "Close the panel first, by OK or Cancel"))
        return False

    def _keys(self, event) -> bool:
        """Whether a key event is one of a held command."""
        modifiers = event.modifiers()
        # Flags, not numbers, in PySide6.
        pressed = QtGui.QKeySequence(int(getattr(modifiers, "value", modifiers)) | int(event.key()))
        return any(pressed in action.shortcuts() for action in self.actions)
