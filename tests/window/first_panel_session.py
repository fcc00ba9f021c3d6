# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: the first panel of a session, opened after a dialog."""

import os
import sys

import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import ok_enabled
from hands import field, named, press, select, window
from keys import strike
from macro_base import base


def first_panel():
    """Members by their dialog, then delivery pieces of one: PySide still has the dialog's buttons
    where FreeCAD makes those of the panel."""
    document = base("First")
    select((document.Ball, "Face1"), document.Arc1)
    keys.active(window())
    QtCore.QTimer.singleShot(2500, lambda: strike("Return"))
    strike("b", "f", pause=4)
    steps.until(lambda: document.getObjectsByLabel("M1"))
    steps.settle(10)
    keys.active(window())
    select(named("M1"))
    strike("b", "i", pause=6)
    rows = field("rows", QtGui.QTableWidget)
    seen = {"keyboard": rows.hasFocus(), "good": ok_enabled()}
    rows.write({(0, 0): "1", (0, 1): "0", (0, 2): "-5"})
    steps.settle()
    seen["bad"] = ok_enabled()
    press("Cancel")
    seen["open"] = bool(FreeCADGui.Control.activeDialog())
    seen["undo"] = document.UndoNames
    return seen


steps.run(first_panel)
