# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: the example stopped in the middle, its document or the window
closed under it; panels while two documents are open."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import whole_document
from hands import asked, field, named, press, retype, run, select, window


def example(act):
    """The example opened from its command, `act` done once it is on its way."""
    from BendTorsionWB.gui import commands_files

    whole, commands_files.HALL = commands_files.HALL, os.environ["BENDTORSION_WINDOW_SCHEDULE"]
    before, bars = set(FreeCAD.listDocuments()), []

    def look():
        for bar in window().findChildren(QtGui.QProgressDialog):
            if bar.isVisible() and bar.value() > 0 and not bars:
                bars.append([bar.labelText(), bar.value(), bar.maximum()])
                act(bar)

    watch = QtCore.QTimer()
    watch.timeout.connect(look)
    watch.start(1)
    with asked(choice="concert hall, from its schedule"):
        shown = run("Example")
    watch.stop()
    commands_files.HALL = whole
    made = sorted(set(FreeCAD.listDocuments()) - before)
    seen = {"bars": bars, "shown": shown, "visible": window().isVisible(), "documents": made}
    seen["said"] = window().statusBar().currentMessage()
    seen["left"] = [
        b.labelText() for b in window().findChildren(QtGui.QProgressDialog) if b.isVisible()
    ]
    seen["members"] = [
        sum(getattr(o, "BT_Type", "") == "Member" for o in FreeCAD.getDocument(name).Objects)
        for name in made
    ]
    for name in made:
        FreeCAD.closeDocument(name)
    return seen


def runs():
    """Stopped, left alone, told to close the window, its document closed."""

    def close_window(bar):
        QtGui.QApplication.sendEvent(window().windowHandle(), QtGui.QCloseEvent())

    def close_document(bar):
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)

    return {
        "alone": example(lambda bar: None),
        "stopped": example(lambda bar: bar.cancel()),
        "window": example(close_window),
        "document": example(close_document),
    }


def two_documents():
    """A panel in one document while another is the active one."""
    first, second = whole_document("First"), whole_document("Second")
    FreeCAD.setActiveDocument("First")
    FreeCADGui.ActiveDocument = FreeCADGui.getDocument("First")
    steps.settle(3)
    seen = {}
    for button in ("Cancel", "Ok"):
        FreeCAD.setActiveDocument("First")
        select(named("B", first))
        run("Section")
        retype(field("Height"), "620 mm")
        steps.settle(6)
        FreeCAD.setActiveDocument("Second")
        FreeCADGui.ActiveDocument = FreeCADGui.getDocument("Second")
        steps.settle(3)
        count = len(second.Objects)
        run("Surface")
        seen[f"while {button}"] = [
            named("B", first).Height.Value,
            named("B", second).Height.Value,
            len(second.Objects) - count,
        ]
        press(button)
        seen[button] = [
            named("B", first).Height.Value,
            named("B", second).Height.Value,
            first.UndoNames,
            second.UndoNames,
            bool(FreeCADGui.Control.activeDialog()),
            sorted(o.Label for d in (first, second) for o in d.Objects if "Touched" in o.State),
        ]
    seen["closed"] = []
    for document in (first, second):
        FreeCAD.setActiveDocument(document.Name)
        select(named("B", document))
        run("Section")
        seen["closed"].append(bool(FreeCADGui.Control.activeDialog()))
        FreeCAD.closeDocument(document.Name)
        steps.settle(12)
        seen["closed"].append(bool(FreeCADGui.Control.activeDialog()))
    return seen


def gone_at_once():
    """The object a panel edits deleted and its document closed in one go, as a script does."""
    document = whole_document("Gone")
    select(named("B"))
    run("Section")
    retype(field("Height"), "650 mm")
    document.removeObject(named("B").Name)
    FreeCAD.closeDocument(document.Name)
    steps.settle(12)
    return {"panel": bool(FreeCADGui.Control.activeDialog())}


steps.run(runs, two_documents, gone_at_once)
