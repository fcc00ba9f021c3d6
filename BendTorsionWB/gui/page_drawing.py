# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing pages are drawn when they are first opened: a building has a hundred, 0.1 s each.

A page that comes from a file waits (its KeepUpdated is off) until it is opened or written as DXF;
from then on it follows every edit. TechDraw prints and exports only pages that are open.
"""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore
from BendTorsionWB.sheets.qt import settle_threads

_followed: list = []
"""The observers, once the first page waits."""
_opened: dict[str, set[str]] = {}
"""By the Uid of a document the names of its pages that were drawn."""


def wait(outlines) -> None:
    """Let the pages around a PageOutlines object that is being restored wait to be opened."""
    for page in pages_around(outlines):
        if not _followed:
            _follow()
        page.setPropertyStatus("KeepUpdated", "NoModify")
        page.KeepUpdated = False


def draw(page) -> None:
    """Draw a page of ours that waits, and keep it up to date from now on."""
    if not page.KeepUpdated and is_ours(page):
        page.KeepUpdated = True
        settle_threads()
        _opened.setdefault(page.Document.Uid, set()).add(page.Name)


def plain(outlines) -> None:
    """Show the pages around a PageOutlines object without the frames of their views."""
    for page in pages_around(outlines):
        if "ShowFrames" in page.ViewObject.PropertiesList:
            page.ViewObject.ShowFrames = False


def is_ours(page) -> bool:
    """Whether a drawing page belongs to a set of sheets."""
    return any(getattr(view, "BT_Type", "") == "PageSymbol" for view in page.Views)


def pages_around(outlines) -> list:
    """The drawing pages that show a PageOutlines object."""
    return [
        page
        for view in outlines.InList
        if view.isDerivedFrom("TechDraw::DrawViewPart")
        for page in view.InList
        if page.isDerivedFrom("TechDraw::DrawPage")
    ]


def _follow() -> None:
    import TechDraw

    opened, kept = _Opened(), _Kept()
    FreeCADGui.addDocumentObserver(opened)
    FreeCAD.addDocumentObserver(kept)
    _followed.extend((opened, kept))
    write = TechDraw.writeDXFPage

    def write_drawn(page, *rest):
        draw(page)
        return write(page, *rest)

    # TechDraw's command to export a page as DXF calls this by its name, whether or not it is open.
    TechDraw.writeDXFPage = write_drawn


class _Opened:
    """Draws a page before it is shown."""

    def slotChangedObject(self, view, name):
        """Called by FreeCAD when a property of a view changes."""
        if name == "Visibility" and view.Visibility and _is_page(view.Object):
            if not view.Object.Document.Restoring:
                draw(view.Object)


class _Kept:
    """Draws pages that were opened anew when undo or Cancel takes back that they were drawn."""

    def slotAbortTransaction(self, document):
        """Called by FreeCAD when an edit was cancelled."""
        QtCore.QTimer.singleShot(0, lambda name=document.Name: _draw_again(name))

    slotUndoDocument = slotRedoDocument = slotAbortTransaction


def _draw_again(document: str) -> None:
    if document in FreeCAD.listDocuments():
        found = FreeCAD.getDocument(document)
        for name in sorted(_opened.get(found.Uid, ())):
            page = found.getObject(name)
            if page is not None:
                draw(page)


def _is_page(obj) -> bool:
    return obj.isDerivedFrom("TechDraw::DrawPage")
