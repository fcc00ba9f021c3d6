# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD leaves open after an undo, a redo or a step taken back: objects that are only marked
to be computed, and badges in the tree for what is gone."""

from __future__ import annotations

from contextlib import suppress

import FreeCAD

from BendTorsionWB.gui import tree
from BendTorsionWB.gui.progress import PATIENCE, Cancelled, progress
from BendTorsionWB.gui.qt import QtCore
from BendTorsionWB.gui.recomputing import AGAIN, recompute_each, touched_in

translate = FreeCAD.Qt.translate

SEEN = 300
"""Milliseconds until the tree has drawn what it was told; it waits 100."""


class Undone:
    """Document observer: computes what an undo or a redo brought back, folds it where it was, and
    shows the worst finding again of what an object that went was shown below."""

    def __init__(self):
        self.waiting: set[str] = set()
        self.above: set[tuple[str, str]] = set()
        self.came: set[tuple[str, str]] = set()

    def slotUndoDocument(self, document):
        """Called by FreeCAD after an undo."""
        self._wait(document.Name)

    def slotRedoDocument(self, document):
        """Called by FreeCAD after a redo."""
        self._wait(document.Name)

    def slotCreatedObject(self, obj):
        """Called by FreeCAD when an object comes: one that has its properties already is brought
        back, and the tree asks nothing above it for what is folded there."""
        if obj.Document.Restoring:
            return
        if hasattr(obj, "BT_Type") or obj.isDerivedFrom("TechDraw::DrawPage"):
            if not self.came:
                QtCore.QTimer.singleShot(0, self._fold)
            self.came.add((obj.Document.Name, obj.Name))

    def _fold(self) -> None:
        came, self.came = self.came, set()
        above = set()
        for where, name in came:
            document = FreeCAD.listDocuments().get(where)
            obj = document.getObject(name) if document is not None else None
            if obj is None:
                continue
            around = [obj, *tree.parents(obj)[:1], tree.sheets_of(obj)]
            above.update((where, item.Name) for item in around if hasattr(item, "Findings"))
        tree.TRIED.update(name for _, name in came)
        _ask_again(above)
        QtCore.QTimer.singleShot(SEEN, lambda: self._show_folded(came, above))

    def _show_folded(self, came, above) -> None:
        tree.TRIED.difference_update(name for _, name in came)
        _ask_again(above)

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes, also when its making is taken back."""
        if not hasattr(obj, "BT_Type"):
            return
        above = {(item.Document.Name, item.Name) for item in tree.parents(obj)}
        if above and not self.above:
            QtCore.QTimer.singleShot(0, self._show_badges)
        self.above |= above

    def _wait(self, name: str, milliseconds: int = 0) -> None:
        if name not in self.waiting:
            self.waiting.add(name)
            QtCore.QTimer.singleShot(milliseconds, lambda: self._compute(name))

    def _compute(self, name: str) -> None:
        """Values that come back ask to be computed, whether they belong together or not."""
        self.waiting.discard(name)
        document = FreeCAD.listDocuments().get(name)
        if document is None or document.HasPendingTransaction or document.RecomputesFrozen:
            return
        if document.Recomputing:
            # FreeCAD's bar of progress hears timers meanwhile.
            self._wait(name, AGAIN)
            return
        touched = [document.getObject(one) for one in touched_in(document)]
        if not any(hasattr(obj, "BT_Type") for obj in touched):
            return
        # Stopped, they stay marked.
        with suppress(Cancelled), progress(translate("BendTorsion", "Undo"), PATIENCE) as report:
            recompute_each(document, report)

    def _show_badges(self) -> None:
        above, self.above = self.above, set()
        for document, name in above:
            found = FreeCAD.listDocuments().get(document)
            obj = found.getObject(name) if found is not None else None
            if obj is not None and obj.ViewObject is not None:
                obj.ViewObject.signalChangeIcon()


def _ask_again(above) -> None:
    for where, name in above:
        document = FreeCAD.listDocuments().get(where)
        obj = document.getObject(name) if document is not None else None
        if obj is not None:
            tree.ask_again(obj)


def watch() -> None:
    """Follow all documents from now on."""
    FreeCAD.addDocumentObserver(Undone())
