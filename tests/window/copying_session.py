# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: members copied, pasted and duplicated."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import whole_document
from hands import named, offered, select


def state(document):
    """Labels of our objects with status, marks and whether they wait to be computed."""
    return {
        obj.Label: [obj.Status, list(getattr(obj, "Marks", [])), "Touched" in obj.State]
        for obj in document.Objects
        if hasattr(obj, "Status") and obj.BT_Type not in ("PageOutlines", "PageSymbol")
    }


def pages(document):
    """How many drawing pages there are."""
    return sum(obj.isDerivedFrom("TechDraw::DrawPage") for obj in document.Objects)


def do(name, answer):
    """FreeCAD's command by its menu, its dialogs accepted, our question answered by the button of
    that text; what was asked."""
    asked, timer = [], QtCore.QTimer()

    def look():
        box = QtGui.QApplication.activeModalWidget()
        if box is None or not box.isVisible():
            return
        if isinstance(box, QtGui.QMessageBox):
            asked.append(box.text())
            steps.picture(f"asked_{name}")
            next(one for one in box.buttons() if one.text() == answer).click()
        elif answer == "cancel":
            box.reject()
        elif box.metaObject().className() == "Gui::DlgObjectSelection":
            box.accept()

    timer.timeout.connect(look)
    timer.start(200)
    offered(f"Std_{name}")[0].trigger()
    steps.settle(15)
    timer.stop()
    return asked


def to(document):
    """Bring a document to the front."""
    FreeCAD.setActiveDocument(document.Name)
    FreeCADGui.ActiveDocument = FreeCADGui.getDocument(document.Name)
    steps.settle(3)


def across():
    """A member into a new document, alone and then with what follows from it."""
    one = whole_document("One")
    seen = {"before": state(one), "pages": pages(one)}
    for way in ("Leave them", "Copy them as well", "cancel"):
        to(one)
        select(named("M1"))
        asked = do("Copy", way)
        other = FreeCAD.newDocument("Other")
        other.UndoMode = 1
        steps.settle(3)
        do("Paste", "")
        seen[way] = {"asked": asked, "pasted": state(other), "pages": pages(other)}
        seen[way]["undo"] = list(other.UndoNames)
        FreeCAD.closeDocument(other.Name)
    return seen


def within():
    """Two members with their node, beside those that are there."""
    one = named("M1").Document
    to(one)
    select(named("M1"), named("M2"))
    seen = {"asked": do("Copy", "Copy them as well")}
    do("Paste", "")
    seen["pasted"] = state(one)
    seen["undo"] = list(one.UndoNames)
    one.undo()
    steps.settle(10)
    seen["undone"] = state(one)
    one.clearUndos()
    return seen


def all_of_it():
    """Everything copied but pages, which FreeCAD cannot copy: nothing is left to ask for."""
    one = named("M1").Document
    select(*(obj for obj in one.Objects if obj.Label in state(one)))
    return do("Copy", "Leave them")


def duplicated():
    """The second member, twice: alone, and with its plates."""
    one = named("M2").Document
    to(one)
    seen = {}
    for way in ("Leave them", "Copy them as well"):
        select(named("M2"))
        asked = do("DuplicateSelection", way)
        seen[way] = {"asked": asked, "made": state(one), "undo": list(one.UndoNames)}
        one.undo()
        steps.settle(10)
        one.clearUndos()
    return seen


steps.run(across, within, all_of_it, duplicated)
