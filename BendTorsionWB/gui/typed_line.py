# SPDX-License-Identifier: LGPL-2.1-or-later
"""A line of text that tells when one is begun anew: typed or pasted over all of the former one."""

from __future__ import annotations

from BendTorsionWB.gui.qt import QtCore, QtWidgets


class TypedLine(QtWidgets.QLineEdit):
    """`begun` comes before `textEdited`."""

    begun = QtCore.Signal()

    def __init__(self, text: str = ""):
        super().__init__(text)
        self._whole = False
        self.selectionChanged.connect(self._selected)
        self.textEdited.connect(self._typed)

    def _selected(self) -> None:
        # Told after `textEdited` of what takes the place of the selection.
        self._whole = bool(self.text()) and self.selectedText() == self.text()

    def _typed(self, _) -> None:
        if self._whole:
            self.begun.emit()
