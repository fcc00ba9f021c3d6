# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents that files are made of are not seen in the tree.

FreeCAD's `hidden` spares a document its view only: the tree lists it all the same. One that is
temporary is not listed, but knows no file that another could link to. The tree also folds the one
that was active for each that comes; the column of labels, as wide as they are, would shrink then,
and the empty column *Description* come into view beside it.
"""

from __future__ import annotations

from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets

SETTLED = 500
"""Milliseconds after which the tree has unfolded the document again."""


@contextmanager
def unseen_documents():
    """Documents without a view that are opened or made meanwhile are left out of the tree."""
    observer = _Unseen()
    FreeCAD.addDocumentObserver(observer)
    fixed = QtWidgets.QHeaderView.Fixed
    modes = [(header, header.sectionResizeMode(0)) for header in _headers()]
    # Those that are held already are let go by who holds them.
    modes = [(header, mode) for header, mode in modes if mode != fixed]
    for header, _ in modes:
        header.setSectionResizeMode(0, fixed)
    try:
        yield
    finally:
        FreeCAD.removeDocumentObserver(observer)
        # The tree follows what happened to documents once the window has time again.
        QtCore.QTimer.singleShot(SETTLED, lambda: _release(modes))


def _release(modes) -> None:
    """Let columns follow their contents again."""
    for header, mode in modes:
        header.setSectionResizeMode(0, mode)


def _headers() -> list:
    return [tree.header() for tree in _trees()]


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
