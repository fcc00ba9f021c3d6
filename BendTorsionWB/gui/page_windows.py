# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window of a drawing page closes when its page goes, and opens again when an undo or a redo
brings the page back; FreeCAD 0.20 leaves it open, empty, and never draws in it again."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask
from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.recomputing import AGAIN


class PageWindows:
    """Document observer that follows the pages whose windows are open."""

    def __init__(self):
        self.gone: set[tuple[str, str]] = set()
        self.waiting: set[str] = set()

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes, also when its making is taken back."""
        if obj.isDerivedFrom("TechDraw::DrawPage") and obj.Name in _pages_open(obj.Document.Name):
            self.gone.add((obj.Document.Name, obj.Name))
            self._wait(obj.Document.Name)

    def slotUndoDocument(self, document):
        """Called by FreeCAD after an undo."""
        if any(name == document.Name for name, _ in self.gone):
            self._wait(document.Name)

    slotRedoDocument = slotUndoDocument

    def slotDeletedDocument(self, document):
        """Nothing is known of a document that is closed."""
        self.gone = {one for one in self.gone if one[0] != document.Name}

    def _wait(self, name: str, milliseconds: int = 0) -> None:
        if name not in self.waiting:
            self.waiting.add(name)
            QtCore.QTimer.singleShot(milliseconds, lambda: self._settle(name))

    def _settle(self, name: str) -> None:
        self.waiting.discard(name)
        document = FreeCAD.listDocuments().get(name)
        if document is None:
            return
        if document.Recomputing:
            self._wait(name, AGAIN)
            return
        _close_without_page(name)
        for of, page in sorted(self.gone):
            obj = document.getObject(page) if of == name else None
            if obj is not None:
                self.gone.discard((of, page))
                open_whole(obj)


def open_whole(page) -> None:
    """Open the window of a drawing page in front and show all of the page. What the status bar
    tells stays: TechDraw tells there of its drawing."""
    told = FreeCADGui.getMainWindow().statusBar().currentMessage()
    page.ViewObject.doubleClicked()
    # The window has its size a moment later.
    at = page.Document.Name, page.Name
    QtCore.QTimer.singleShot(0, lambda: _fit(*at, told))


def watch() -> None:
    """Follow all documents from now on."""
    FreeCAD.addDocumentObserver(PageWindows())


def _fit(document: str, page: str, told: str) -> None:
    if told:
        ask.tell(told)
    for view in _views(document) if document in FreeCAD.listDocuments() else ():
        if _page_of(view) == page:
            view.fitAll()


def _views(document: str) -> list:
    return FreeCADGui.getDocument(document).mdiViewsOfType("TechDrawGui::MDIViewPage")


def _page_of(view) -> str:
    """The name of the page a window shows; empty when it is no part of a document any more."""
    try:
        return view.getPage().Name
    except RuntimeError:
        return ""


def _pages_open(document: str) -> list[str]:
    return [_page_of(view) for view in _views(document)]


def _close_without_page(document: str) -> None:
    """Close the windows whose pages are gone, but not the last of a document: FreeCAD would ask
    whether to save it."""
    main = FreeCADGui.getMainWindow()
    area = main.findChild(QtWidgets.QMdiArea)
    front = area.currentSubWindow()
    for view in _views(document):
        alone = len(FreeCADGui.getDocument(document).mdiViewsOfType("Gui::MDIView")) == 1
        if not _page_of(view) and not alone:
            main.setActiveWindow(view)
            for drawing in area.currentSubWindow().findChildren(QtWidgets.QGraphicsView):
                # FreeCAD 1.0 takes it again when the page comes back, and ends without it.
                drawing.setParent(main)
            area.currentSubWindow().close()
    if front is not None and front.isVisible():
        area.setActiveSubWindow(front)
