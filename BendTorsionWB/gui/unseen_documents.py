# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents that files are made of are not seen in the tree.

FreeCAD's `hidden` spares a document its view only: the tree lists it all the same. One that is
temporary is not listed, but knows no file that another could link to.
"""

from __future__ import annotations

from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets


@contextmanager
def unseen_documents():
    """Documents without a view that are opened or made meanwhile are left out of the tree."""
    observer = _Unseen()
    FreeCAD.addDocumentObserver(observer)
    try:
        yield
    finally:
        FreeCAD.removeDocumentObserver(observer)


class _Unseen:
    """Document observer that keeps documents out of the tree as they come; all that are made or
    opened meanwhile stand below those that were open."""

    def __init__(self):
        self.seen: set[str] = set()
        self.first = [tree.model().rowCount(_above(tree)) for tree in _trees()]

    def slotCreatedDocument(self, document):
        """Called by FreeCAD when a document is there, its view and its line in the tree too."""
        if FreeCADGui.getDocument(document.Name).mdiViewsOfType("Gui::MDIView"):
            self.seen.add(document.Name)
        self._hide()

    def slotActivateDocument(self, document):
        """Called by FreeCAD when another document becomes the active one; its tree shows all then,
        and again when one has another name, as one that is opened."""
        self._hide()

    slotRelabelDocument = slotActivateDocument

    def _hide(self) -> None:
        labels = {one.Label for one in FreeCAD.listDocuments().values() if one.Name in self.seen}
        for tree, first in zip(_trees(), self.first, strict=True):
            model, above = tree.model(), _above(tree)
            for row in range(first, model.rowCount(above)):
                tree.setRowHidden(row, above, model.index(row, 0, above).data() not in labels)


def _trees() -> list:
    widgets = FreeCADGui.getMainWindow().findChildren(QtWidgets.QTreeWidget)
    return [tree for tree in widgets if tree.metaObject().className() == "Gui::TreeWidget"]


def _above(tree):
    """Index that the lines of documents are below; before FreeCAD 1.0 that of the program. Asked by
    indices: PySide 6 takes a new line for one that is deleted, where that lay."""
    model, top = tree.model(), QtCore.QModelIndex()
    labels = {one.Label for one in FreeCAD.listDocuments().values()}
    if model.rowCount(top) == 1 and model.index(0, 0, top).data() not in labels:
        return model.index(0, 0, top)
    return top
