# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: the first panel of a session, opened after a dialog, with nothing
looked at before: what Python has been given of the window lives on for it."""

import json
import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from macro_base import base

STEP = 2000
"""Milliseconds from one to the next, in FreeCAD's own loop."""


def start():
    """Members of a face and an arc, by their dialog."""
    FreeCADGui.activateWorkbench("BendTorsionWorkbench")
    document = base("First")
    FreeCADGui.Selection.addSelection("First", document.Ball.Name, "Face1")
    FreeCADGui.Selection.addSelection("First", document.Arc1.Name)
    QtCore.QTimer.singleShot(STEP, lambda: QtGui.QApplication.activeModalWidget().accept())
    QtCore.QTimer.singleShot(3 * STEP, pieces)
    FreeCADGui.runCommand("BendTorsion_MembersFromSelection")


def pieces():
    """The panel of the member's delivery pieces."""
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection("First", FreeCAD.ActiveDocument.getObject("Member").Name)
    QtCore.QTimer.singleShot(STEP, bad_row)
    FreeCADGui.runCommand("BendTorsion_Pieces")


def bad_row():
    """A row that cannot be, and what the panel makes of it."""
    window = FreeCADGui.getMainWindow()
    rows = next(w for w in window.findChildren(QtGui.QTableWidget, "rows") if w.isVisible())
    rows.write({(0, 0): "1", (0, 1): "0", (0, 2): "-5"})
    boxes = [box for box in window.findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    button = boxes[0].button(QtGui.QDialogButtonBox.Ok)
    seen = {"ok": button.isEnabled(), "told": button.toolTip()}
    report = window.findChild(QtGui.QTextEdit, "Report view").toPlainText()
    with open(os.environ["BENDTORSION_WINDOW_RESULT"], "w", encoding="utf-8") as file:
        json.dump({"first_panel": seen, "report_view": report}, file)
    os._exit(0)


QtCore.QTimer.singleShot(0, start)
