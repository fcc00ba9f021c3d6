# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing pages are drawn when they are first opened: a building has a hundred, 0.1 s each.

A page that is made, or comes from a file, waits (its KeepUpdated is off) until it is opened or
exported, by a command or a script; from then on it follows every edit.
"""

from __future__ import annotations

import importlib
from functools import wraps

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore
from BendTorsionWB.gui.recomputing import AGAIN
from BendTorsionWB.objects.sheet_pages import let_wait
from BendTorsionWB.sheets.qt import settle_threads

WRITERS = {
    "TechDraw": ("writeDXFPage", "writeDXFView", "viewPartAsDxf", "viewPartAsSvg"),
    "TechDrawGui": ("export", "exportPageAsPdf", "exportPageAsSvg"),
}
"""What writes pages or their views, by module."""
_followed: list = []
"""The observers, once there is a page."""
_opened: dict[str, set[str]] = {}
"""By the Uid of a document the names of its pages that were drawn."""


def wait(outlines) -> None:
    """Let the pages around a PageOutlines object that is being restored wait to be opened."""
    follow()
    for page in pages_around(outlines):
        let_wait(page)


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


def follow() -> None:
    """Draw pages that wait when they are opened or exported, from now on."""
    if _followed:
        return
    opened, kept = _Opened(), _Kept()
    FreeCADGui.addDocumentObserver(opened)
    FreeCAD.addDocumentObserver(kept)
    _followed.extend((opened, kept))
    # FreeCAD's commands call these by their names, too, whether or not the page is open.
    for module, names in WRITERS.items():
        written_by = importlib.import_module(module)
        for name in names:
            setattr(written_by, name, _drawing(getattr(written_by, name)))


def _drawing(write):
    """A function of TechDraw that draws the pages of what it is given before it writes them."""

    @wraps(write)
    def write_drawn(given, *rest):
        for one in given if isinstance(given, (list, tuple)) else (given,):
            for page in (one, *getattr(one, "InList", ())):
                if hasattr(page, "isDerivedFrom") and _is_page(page):
                    draw(page)
        return write(given, *rest)

    return write_drawn


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
        if found.Recomputing:
            # What an undo brought back is computed meanwhile; a page would be within it.
            QtCore.QTimer.singleShot(AGAIN, lambda: _draw_again(document))
            return
        for name in sorted(_opened.get(found.Uid, ())):
            page = found.getObject(name)
            if page is not None:
                draw(page)


def _is_page(obj) -> bool:
    return obj.isDerivedFrom("TechDraw::DrawPage")
