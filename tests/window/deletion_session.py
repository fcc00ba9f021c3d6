# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: FreeCAD's own Delete of what others need, its question, undo."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import whole_document
from hands import answered, field, named, offered, press, retype, run, select, window

NEEDED = ("Ground", "B", "M1-axis", "M1", "M1 plates", "M1 patterns", "N1", "M2")


def panel_open():
    """Whether a task panel is open."""
    return bool(FreeCADGui.Control.activeDialog())


def state(document):
    """Labels with status and size, and what FreeCAD marks."""
    found = {}
    for obj in document.Objects:
        if hasattr(obj, "Status"):
            solid = hasattr(obj, "Shape") and bool(obj.Shape.SubShapes)
            # Of a copy, which has no picture: newer kernels bound a shape by its picture if any.
            size = f"{obj.Shape.copy().BoundBox.DiagonalLength:.5g}" if solid else ""
            found[obj.Label] = [obj.Status, size, obj.isValid()]
    return found


def delete(answer):
    """FreeCAD's Delete, what it asks answered with Yes or No; the text of the question."""
    asked, timer = [], QtCore.QTimer()

    def look():
        box = QtGui.QApplication.activeModalWidget()
        if isinstance(box, QtGui.QMessageBox) and box.isVisible():
            timer.stop()
            asked.append(box.text())
            box.button(getattr(QtGui.QMessageBox, answer)).click()

    timer.timeout.connect(look)
    timer.start(50)
    FreeCADGui.runCommand("Std_Delete")
    timer.stop()
    steps.settle(4)
    return asked


def again(document, name):
    """FreeCAD's Undo or Redo, and the document computed."""
    FreeCADGui.runCommand(f"Std_{name}")
    steps.settle(3)
    document.recompute()
    return state(document)


def deletions():
    """Each object others need: the question refused, answered, undone, done again, undone."""
    document = whole_document("Deletions")
    before, seen = state(document), {}
    for label in NEEDED:
        select(named(label))
        found = {"asked": delete("No"), "refused": state(document) == before}
        delete("Yes")
        document.recompute()
        found["deleted"] = state(document)
        found["undo"] = len(document.UndoNames)
        if label == "Ground":
            steps.picture("deleted")
        found["undone"] = again(document, "Undo") == before
        found["redone"] = again(document, "Redo") == found["deleted"]
        found["back"] = again(document, "Undo") == before
        document.clearUndos()
        seen[label] = found
    return {"before": before, "seen": seen}


def key_in_the_view():
    """Del pressed in the 3D view and in the tree; what is not needed goes without a question."""
    document, seen = FreeCAD.ActiveDocument, {"active": keys.active(window())}
    views = {"view": FreeCADGui.ActiveDocument.ActiveView.graphicsView().viewport()}
    views["tree"] = steps.document_tree()
    for name, widget in views.items():
        select(named("M1 bed"))
        widget.setFocus()
        steps.until(widget.hasFocus)
        offered("Std_Delete")
        keys.strike("Delete", pause=5)
        steps.until(lambda: document.UndoNames)
        seen[name] = [not document.getObjectsByLabel("M1 bed"), bool(document.UndoNames)]
        again(document, "Undo")
        seen[name].append(bool(document.getObjectsByLabel("M1 bed")))
    document.clearUndos()
    return seen


def while_a_panel_is_open():
    """Del, Ctrl+Z and Ctrl+Y in the view while the panel of a section is open."""
    document, section = FreeCAD.ActiveDocument, named("B")
    before = state(document)
    select(section)
    run("Section")
    retype(field("Height"), "600 mm")
    steps.settle(6)
    seen = {"tried": section.Height.Value, "held": []}
    widget = FreeCADGui.ActiveDocument.ActiveView.graphicsView().viewport()
    for name in ("Delete", "Control_L+z", "Control_L+y"):
        select(section)
        widget.setFocus()
        keys.strike(name, pause=4)
        told = window().statusBar().currentMessage()
        seen["held"].append([panel_open(), named("B").Height.Value, told])
    press("Cancel")
    seen["cancelled"] = state(document) == before
    FreeCAD.closeDocument(document.Name)
    return seen


def members_again():
    """Members from selection undone and done again."""
    import Part

    document = FreeCAD.newDocument("Again")
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 20000
    arc = document.addObject("Part::Feature", "Arc")
    arc.Shape = Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, 10, 30), 10, 50)
    document.recompute()
    select((ball, "Face1"), arc)
    answered(lambda dialog: dialog.accept())
    run("MembersFromSelection")
    made = state(document)
    seen = {"made": made, "undo": document.UndoNames}
    seen["undone"] = again(document, "Undo")
    seen["redone"] = again(document, "Redo") == made
    # The tree is told in two steps.
    steps.settle(8)
    seen["tree"] = steps.tree_items()
    again(document, "Undo")
    seen["back"] = again(document, "Redo") == made
    steps.picture("redone")
    return seen


steps.run(deletions, key_in_the_view, while_a_panel_is_open, members_again)
