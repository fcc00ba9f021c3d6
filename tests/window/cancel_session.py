# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: each panel opened, something edited, cancelled; what stays."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import mouse
import steps
from commands_aids import member_document, whole_document
from hands import field, named, press, retype, run, select

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def state(document):
    """What a cancelled panel leaves alone."""
    steps.settle(3)
    return {
        "touched": sorted(o.Label for o in document.Objects if "Touched" in o.State),
        "modified": FreeCADGui.getDocument(document.Name).Modified,
        "objects": sorted(o.Label for o in document.Objects),
        "undo": document.UndoNames,
        "shapes": {
            o.Label: f"{o.Shape.BoundBox.DiagonalLength:.6g}"
            for o in document.Objects
            if hasattr(o, "Shape")
        },
    }


def saved(document):
    """The document as its file has it."""
    document.saveAs(os.path.join(FOLDER, f"{document.Name}.FCStd"))
    steps.settle()
    return state(document)


def left_after(document, before, command, edit, *picked):
    """What differs after a command was edited and cancelled."""
    select(*picked)
    said = run(command)
    edit()
    steps.settle(6)
    press("Cancel")
    after = state(document)
    return [said, {name: after[name] for name in before if after[name] != before[name]}]


def cuts():
    """A cut added, removed, dragged, slid, typed; cancelled."""
    document = member_document("Cuts")
    before = saved(document)
    member = named("M1")
    box = lambda: field("segments", QtGui.QComboBox)

    def add():
        button("Add cut").click()

    def remove():
        box().setCurrentIndex(1)
        button("Remove").click()

    def slide():
        box().setCurrentIndex(1)
        steps.settle(2)
        next(w for w in FreeCADGui.getMainWindow().findChildren(QtGui.QSlider) if w.isVisible()).setValue(400)

    def typed():
        box().setCurrentIndex(1)
        steps.settle(2)
        retype(field("Cut2"), "6000 mm")

    def offset():
        retype(field("OffsetZ"), "60 mm")

    def button(text):
        return next(b for b in FreeCADGui.getMainWindow().findChildren(QtGui.QPushButton) if b.isVisible() and b.text() == text)

    seen = {}
    for name, edit in (("nothing", lambda: None), ("offset", offset), ("typed", typed), ("add", add), ("remove", remove), ("slide", slide)):
        seen[name] = left_after(document, before, "Member", edit, member)
    seen["cut point"] = left_after(document, before, "CutPoint", lambda: None, member)
    seen["section"] = left_after(document, before, "Section", lambda: retype(field("Height"), "700 mm"), named("B600"))
    seen["new section"] = left_after(document, before, "Section", lambda: retype(field("Height"), "700 mm"))
    return seen


steps.run(cuts)
