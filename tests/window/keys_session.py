# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: members made by real keys alone, Tab through every panel."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import hands
import keys
import steps
from commands_aids import whole_document
from hands import named, run, select, window
from keys import strike, write

MOST = 80


def panel_open():
    """Whether a task panel is open."""
    return bool(FreeCADGui.Control.activeDialog())


def focus():
    """The widget that has the keyboard."""
    return QtGui.QApplication.focusWidget()


def members():
    """A face and two curves selected in the tree, the command, its dialog: keys only."""
    import Part

    document = FreeCAD.newDocument("Keys")
    document.UndoMode = 1
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 20000
    for tilt in (10, 25):
        arc = document.addObject("Part::Feature", f"Arc{tilt}")
        arc.Shape = Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, tilt, 30), 10, 50)
    document.recompute()
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    seen = {"active": keys.active(window())}
    # From the 3D view Tab leads nowhere else in FreeCAD.
    tree = steps.document_tree()
    tree.setFocus()
    strike("Home")
    # One or two rows below: newer FreeCADs show no row of the program itself.
    while tree.currentIndex().data() != "Ball" and tree.indexBelow(tree.currentIndex()).isValid():
        strike("Down")
    strike("Shift_L+Down", "Shift_L+Down")
    seen["selected"] = [item.Label for item in FreeCADGui.Selection.getSelection()]
    seen["dialog"] = []
    hands.offered("BendTorsion_MembersFromSelection")
    QtCore.QTimer.singleShot(1500, lambda: _dialog(seen["dialog"]))
    strike("b", "f", pause=4)
    steps.settle(4)
    keys.active(window())
    seen["made"] = [o.Label for o in document.Objects if getattr(o, "BT_Type", "") == "Member"]
    section = named("Section")
    seen["section"] = [section.Type, section.Height.Value, section.Breadth.Value]
    seen["section"].append(section.Thickness.Value)
    seen["align"] = named("M7").Align1
    seen["undo"] = document.UndoNames
    hands.offered("Std_Undo")
    strike("Control_L+z", pause=5)
    seen["undone"] = len(document.Objects)
    hands.offered("Std_Redo")
    strike("Control_L+Shift_L+z" if _redo_has_shift() else "Control_L+y", pause=5)
    seen["redone"] = len(document.Objects)
    FreeCAD.closeDocument(document.Name)
    return seen


def _redo_has_shift():
    return "Shift" in FreeCADGui.Command.get("Std_Redo").getInfo()["shortcut"]


def _dialog(seen):
    dialog = QtGui.QApplication.activeModalWidget()
    if isinstance(dialog, QtGui.QMessageBox):
        seen.append(dialog.text())
        dialog.accept()
        return
    seen.append(keys.active(dialog))
    names = {field.findChild(QtGui.QLineEdit): name for name, field in dialog.fields.items()}
    names |= {field: name for name, field in dialog.fields.items()}
    names |= {dialog.type: "type", dialog.align: "align", dialog.first: "first"}
    seen.append(names.get(focus(), str(focus())))
    for text in ("700", "500", "14"):
        strike("Control_L+a", pause=1)
        write(text)
        strike("Tab")
        seen.append(names.get(focus(), str(focus())))
    strike("Up")
    strike("Tab")
    seen.append(names.get(focus(), str(focus())))
    strike("Control_L+a", pause=1)
    write("7")
    steps.picture("keys_dialog")
    strike("Return", pause=1)


def order():
    """By panel: the fields Tab goes through, in turn, and those it never comes to; Esc closes."""
    document, seen = whole_document("Order"), {}
    keys.active(window())
    target = {"Section": "B", "Axis": "M1-axis", "Surface": "Ground", "Node": "N1"}
    for name in (*target, "Plates", "CutPoint", "Development", "AssemblyBed", "Alignment"):
        select(named(target.get(name, "M1")))
        run(name, 3)
        seen[name] = _round()
        strike("Escape", pause=3)
        seen[name]["closed"] = not panel_open()
        if panel_open():
            hands.press("Cancel")
    return {"seen": seen, "undo": document.UndoNames}


def _round():
    form = hands.form()
    wanted = [
        w
        for w in form.findChildren(QtGui.QWidget)
        if w.isVisible()
        and w.isEnabled()
        and w.focusPolicy() & QtCore.Qt.TabFocus
        and not (isinstance(w, QtGui.QLineEdit) and isinstance(w.parent(), QtGui.QAbstractSpinBox))
    ]
    first, met = focus(), []
    for _ in range(len(wanted) + 12):
        now = focus()
        own = now if now in wanted else now.parent() if now and now.parent() in wanted else None
        if own is not None and own not in met:
            met.append(own)
        if len(met) == len(wanted):
            break
        strike("Tab", pause=0)
        for _ in range(20):
            if focus() is not now:
                break
            QtCore.QThread.msleep(10)
            QtGui.QApplication.processEvents()
    places = [w.mapTo(form, QtCore.QPoint(0, 0)) for w in met]
    return {
        "inside": bool(first is not None and form.isAncestorOf(first)),
        "missed": [w.objectName() or type(w).__name__ for w in wanted if w not in met],
        "down": [[p.x(), p.y()] for p in places],
        "names": [w.objectName() or type(w).__name__ for w in met],
    }


def enter():
    """A size typed into a panel and Enter pressed: kept, as one undo step."""
    document = FreeCAD.ActiveDocument
    document.clearUndos()
    select(named("B"))
    run("Section")
    keys.active(window())
    field = next(w for w in window().findChildren(QtGui.QWidget, "Height") if w.isVisible())
    for _ in range(MOST):
        if focus() is field or (focus() is not None and focus().parent() is field):
            break
        strike("Tab", pause=1)
    strike("Control_L+a", pause=1)
    write("560")
    strike("Return", pause=5)
    return {"first": [panel_open(), named("B").Height.Value, document.UndoNames]}


steps.run(members, order, enter)
