# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the 3D view of a document looks at first: at the members, as a whole."""

from __future__ import annotations

import zipfile
from contextlib import contextmanager

import FreeCAD
import FreeCADGui
from pivy import coin

from BendTorsionWB.gui import member_display
from BendTorsionWB.gui.qt import QtCore

_waiting: set[str] = set()
"""Names of documents that are to be looked at once they are open."""


def fit() -> None:
    """Fit the active view to everything that is shown in it."""
    FreeCADGui.SendMsgToActiveView("ViewFit")


def look_at_first() -> None:
    """Look at what a document holds first as FreeCAD's preferences have it of new documents: of a
    document that a macro makes FreeCAD leaves that to the macro."""
    view = FreeCADGui.ActiveDocument.ActiveView
    if not hasattr(view, "viewDefaultOrientation"):
        fit()
        return
    with _at_once(view):
        view.viewDefaultOrientation()
        fit()


def look_at_members() -> None:
    """Turn the view of the active document to the plates; surfaces may be much larger than what is
    built on them."""
    document = FreeCAD.ActiveDocument
    view = FreeCADGui.getDocument(document.Name).ActiveView
    if not hasattr(view, "viewIsometric"):
        return
    _hide_what_lies_within(document)
    with _at_once(view):
        view.viewIsometric()
        look_at(*(obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "PlateSet"))


@contextmanager
def _at_once(view):
    """The view turns in one step inside: FreeCAD 1.0 turns it little by little, and goes on with
    that after the view has been fitted, away from what it was fitted to."""
    animated = view.isAnimationEnabled()
    view.setAnimationEnabled(False)
    try:
        yield
    finally:
        view.setAnimationEnabled(animated)


def _hide_what_lies_within(document) -> None:
    """Hide the skins of members whose plates are seen, and shapes whose surfaces are: faces in one
    place flicker. A document that was saved stays so: nobody has changed it."""
    for obj in document.Objects:
        kind = getattr(obj, "BT_Type", "")
        if kind == "Member" and member_display.plates_shown(obj):
            with _unmodified(obj):
                member_display.hide_skin(obj)
        if kind == "Surface" and obj.ViewObject.Visibility and obj.Source is not None:
            with _unmodified(obj.Source[0]):
                obj.Source[0].ViewObject.Visibility = False


@contextmanager
def _unmodified(obj):
    """Whether an object is shown is no change of its document meanwhile."""
    for item in (obj, obj.ViewObject):
        item.setPropertyStatus("Visibility", "NoModify")
    try:
        yield
    finally:
        for item in (obj, obj.ViewObject):
            item.setPropertyStatus("Visibility", "-NoModify")


def look_at(*objects) -> None:
    """Fit the active view to objects, to everything when there are none, from where it looks; a
    member is seen by its plates. Nothing is selected then."""
    FreeCADGui.Selection.clearSelection()
    for obj in objects:
        for seen in member_display.plates_shown(obj) or (obj,):
            FreeCADGui.Selection.addSelection(seen.Document.Name, seen.Name)
    chosen = bool(FreeCADGui.Selection.getSelection())
    FreeCADGui.SendMsgToActiveView("ViewSelection" if chosen else "ViewFit")
    FreeCADGui.Selection.clearSelection()


def fit_members(*members) -> None:
    """Fit the active 3D view to members as they are shown, by plates, skin or axis, from where it
    looks; what is selected stays. FreeCAD's own fit takes the surface in, too."""
    view = FreeCADGui.ActiveDocument.ActiveView
    if not hasattr(view, "getCameraNode"):
        return
    whole = coin.SoGroup()
    for member in members:
        for seen in member_display.seen_of(member):
            whole.addChild(seen.ViewObject.RootNode)
    if whole.getNumChildren():
        region = coin.SbViewportRegion(*(int(pixels) for pixels in view.getSize()))
        view.getCameraNode().viewAll(whole, region)


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
        look_at_members()
        return
    view = FreeCADGui.getDocument(name).ActiveView
    # A hidden document has none, and a page is no 3D view.
    if hasattr(view, "fitAll"):
        view.fitAll()
