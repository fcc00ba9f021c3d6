# SPDX-License-Identifier: LGPL-2.1-or-later
"""A dock that shows the active document, and follows its edits, undo, and other documents."""

from __future__ import annotations

from abc import abstractmethod

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import standard_buttons
from BendTorsionWB.gui.qt import QtCore, QtWidgets

LEAST_HEIGHT = 280
"""Pixels a dock is opened with at least: some rows below the headings."""


class DocumentDock(QtWidgets.QDockWidget):
    """Subclasses fill their widget in `refresh`, from `self.document`, None when there is none."""

    def __init__(self, name: str, title: str, widget):
        super().__init__(title, FreeCADGui.getMainWindow())
        self.setObjectName(name)
        self.setWidget(widget)
        self.document = FreeCAD.ActiveDocument
        self.timer = QtCore.QTimer(self)
        self.timer.setSingleShot(True)
        self.timer.timeout.connect(self._refresh)
        self.observer = _Follow(self)
        FreeCAD.addDocumentObserver(self.observer)
        window = FreeCADGui.getMainWindow()
        window.addDockWidget(QtCore.Qt.BottomDockWidgetArea, self)
        for other in window.findChildren(QtWidgets.QDockWidget):
            if isinstance(other, DocumentDock) and other is not self:
                window.tabifyDockWidget(other, self)

    @abstractmethod
    def refresh(self) -> None:
        """Show the document as it is now."""

    def forget_document(self, name: str) -> None:
        """Drop what is kept of a document that goes: another may have its name."""

    def name(self) -> None:
        """Name what `refresh` does not, in the language of the window."""

    def changeEvent(self, event):
        """In another language once the window is."""
        super().changeEvent(event)
        standard_buttons.name_again(event, self.name)
        if event.type() == QtCore.QEvent.LanguageChange:
            self.soon()

    def soon(self) -> None:
        """Refresh when FreeCAD is done with what it does."""
        self.timer.start(0)

    def _refresh(self) -> None:
        self.document = FreeCAD.ActiveDocument
        if self.isVisible():
            self.refresh()

    def showEvent(self, event):
        """Up to date whenever it is seen."""
        super().showEvent(event)
        self.soon()


class _Follow:
    """Tells the dock what happens to documents."""

    def __init__(self, dock: DocumentDock):
        self.dock = dock

    def slotRecomputedDocument(self, document):
        """Called by FreeCAD after a recompute."""
        self.dock.soon()

    def slotUndoDocument(self, document):
        """Called by FreeCAD after an undo."""
        self.dock.soon()

    def slotRedoDocument(self, document):
        """Called by FreeCAD after a redo."""
        self.dock.soon()

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes."""
        self.dock.soon()

    def slotActivateDocument(self, document):
        """Called by FreeCAD when another document becomes the active one."""
        self.dock.soon()

    def slotDeletedDocument(self, document):
        """Called by FreeCAD before a document goes."""
        if self.dock.document == document:
            self.dock.document = None
        self.dock.forget_document(document.Name)
        self.dock.soon()


def shown(kind, name: str):
    """The one dock of a kind in the window, made when there is none, shown and raised."""
    window = FreeCADGui.getMainWindow()
    dock = window.findChild(QtWidgets.QDockWidget, name)
    new = dock is None
    if new:
        dock = kind()
    if not dock.isVisible():
        _join_visible(window, dock)
    dock.show()
    dock.raise_()
    if new and dock.height() < LEAST_HEIGHT:
        window.resizeDocks([dock], [LEAST_HEIGHT], QtCore.Qt.Vertical)
    return dock


def _join_visible(window, dock) -> None:
    """Put a dock before one that is seen at the bottom of the window: beside the Report view a
    table has no width to be read."""
    bottom = QtCore.Qt.BottomDockWidgetArea
    if dock.isFloating() or window.dockWidgetArea(dock) != bottom:
        return
    for other in window.findChildren(QtWidgets.QDockWidget):
        placed = window.dockWidgetArea(other) == bottom and not other.isFloating()
        if placed and other.isVisible():
            window.tabifyDockWidget(other, dock)
            return
