# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the 3D view of a document looks at first: at the members, as a whole."""

from __future__ import annotations

import zipfile

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore

_waiting: set[str] = set()
"""Names of documents that are to be looked at once they are open."""


def look_at_members(document) -> None:
    """Turn the view to the plates; surfaces may be much larger than what is built on them."""
    view = FreeCADGui.getDocument(document.Name).ActiveView
    if not hasattr(view, "viewIsometric"):
        return
    view.viewIsometric()
    FreeCADGui.Selection.clearSelection()
    for item in document.Objects:
        if getattr(item, "BT_Type", "") == "PlateSet":
            FreeCADGui.Selection.addSelection(document.Name, item.Name)
    chosen = bool(FreeCADGui.Selection.getSelection())
    FreeCADGui.SendMsgToActiveView("ViewSelection" if chosen else "ViewFit")
    FreeCADGui.Selection.clearSelection()


def on_open(document) -> None:
    """Look at the members of a document that is being opened, when its file says of no view."""
    if document.Name not in _waiting and not _has_views(document.FileName):
        _waiting.add(document.Name)
        QtCore.QTimer.singleShot(0, lambda name=document.Name: _look(name))


def _has_views(path: str) -> bool:
    """Whether FreeCAD's window saved the file, camera and all."""
    try:
        with zipfile.ZipFile(path) as file:
            return "GuiDocument.xml" in file.namelist()
    except (OSError, zipfile.BadZipFile):
        return True


def _look(name: str) -> None:
    _waiting.discard(name)
    document = FreeCAD.listDocuments().get(name)
    if document is None:
        return
    if document == FreeCAD.ActiveDocument:
        look_at_members(document)
        return
    view = FreeCADGui.getDocument(name).ActiveView
    # A hidden document has none, and a page is no 3D view.
    if hasattr(view, "fitAll"):
        view.fitAll()
