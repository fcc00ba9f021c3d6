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
from hands import field, named, press, retype, run, select, window

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def state(document):
    """What a cancelled panel leaves alone."""
    steps.settle(3)
    shapes = [o for o in document.Objects if hasattr(o, "Shape") and o.Shape.SubShapes]
    return {
        "touched": sorted(o.Label for o in document.Objects if "Touched" in o.State),
        "modified": FreeCADGui.getDocument(document.Name).Modified,
        "objects": sorted(o.Label for o in document.Objects),
        "undo": document.UndoNames,
        "visible": sorted(o.Label for o in document.Objects if o.ViewObject.Visibility),
        "shapes": {o.Label: f"{o.Shape.BoundBox.DiagonalLength:.6g}" for o in shapes},
    }


def saved(document):
    """The document as its file has it."""
    if not document.FileName:
        document.saveAs(os.path.join(FOLDER, f"{document.Name}.FCStd"))
    # As Ctrl+S does; a script's save leaves the mark of a document that is not saved.
    FreeCADGui.SendMsgToActiveView("Save")
    return state(document)


def differs(document, before):
    """What is not as it was."""
    after = state(document)
    return {name: [before[name], after[name]] for name in before if after[name] != before[name]}


def left_after(document, before, command, edit, *picked):
    """What a command leaves that was edited and cancelled."""
    select(*picked)
    said = run(command)
    steps.settle(2)
    edit()
    steps.settle(6)
    tried = differs(document, before)
    press("Cancel")
    return [said, sorted(tried), differs(document, before)]


def button(text):
    """A button of the panel."""
    found = window().findChildren(QtGui.QPushButton)
    return next(item for item in found if item.isVisible() and item.text() == text)


def segment(number):
    """Choose a segment of the member's panel."""
    field("segments", QtGui.QComboBox).setCurrentIndex(number - 1)
    steps.settle(2)


def cuts():
    """A cut added, taken away, slid, typed, dragged in the view; cancelled."""
    document = member_document("Cuts")
    named("Hall").ViewObject.Visibility = False
    select(named("M1 plates"))
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    steps.settle()
    before, member = saved(document), named("M1")

    def remove():
        segment(2)
        button("Remove").click()

    def slide():
        segment(2)
        next(w for w in window().findChildren(QtGui.QSlider) if w.isVisible()).setValue(400)

    def typed():
        segment(2)
        retype(field("Cut2"), "6000 mm")

    def dragged():
        start, end = (mouse.pixel_of(mouse.place(named("A1"), s)) for s in (5000.0, 7000.0))
        mouse.drag(start, end)

    edits = {
        "nothing": lambda: None,
        "offset": lambda: retype(field("OffsetZ"), "60 mm"),
        "typed": typed,
        "added": lambda: button("Add cut").click(),
        "removed": remove,
        "slid": slide,
        "dragged": dragged,
    }
    seen = {n: left_after(document, before, "Member", edit, member) for n, edit in edits.items()}
    seen["cut point"] = left_after(document, before, "CutPoint", lambda: None, member)
    select(member)
    steps.picture("cancelled")
    seen["before"] = before
    FreeCAD.closeDocument(document.Name)
    return seen


def first_edit():
    """Another value in the first field of the panel that takes one; its name."""
    from BendTorsionWB.gui import property_form

    for form in window().findChildren(property_form.PropertyForm):
        for name, widget in form.fields.items():
            if not (widget.isVisible() and widget.isEnabled()):
                continue
            if isinstance(widget, QtGui.QComboBox) and widget.count() > 1:
                widget.setCurrentIndex((widget.currentIndex() + 1) % widget.count())
                return name
            if isinstance(widget, QtGui.QCheckBox):
                widget.click()
                return name
            if isinstance(widget, QtGui.QAbstractSpinBox):
                retype(widget, "37")
                return name
    return ""


def kinds():
    """The panel of each kind of object, opened as by a double-click."""
    from BendTorsionWB.gui import editors

    document = whole_document("Kinds")
    before, seen = saved(document), {}
    for obj in list(document.Objects):
        kind = getattr(obj, "BT_Type", "")
        if kind not in editors.PANELS or kind in seen:
            continue
        obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
        steps.settle()
        edited = first_edit()
        steps.settle(6)
        tried = differs(document, before)
        press("Cancel")
        seen[kind] = [edited, sorted(tried), differs(document, before)]
    return seen


def parts():
    """Tables, joints and commands that make something new."""
    document = FreeCAD.ActiveDocument
    before, seen = state(document), {}
    one = named("M1")
    for command in ("Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds"):

        def cell():
            table = field("rows")
            table.setCurrentCell(0, 0)
            table.write({(0, 0): "X1", (0, 1): "500"})

        seen[command] = left_after(document, before, command, cell, one)

    def joint():
        retype(field("joints bottom"), "2000 4000")

    seen["Plates"] = left_after(document, before, "Plates", joint, one)
    seen["Splits"] = left_after(document, before, "Splits", lambda: None, one)

    def corner():
        field("alignment").choose("bottom")

    seen["Alignment"] = left_after(document, before, "Alignment", corner, one)
    axis = named("M1-axis")
    seen["new section"] = left_after(document, before, "Section", first_edit)
    seen["new surface"] = left_after(document, before, "Surface", first_edit)
    seen["new member"] = left_after(document, before, "Member", first_edit, axis, named("B"))
    seen["new patterns"] = left_after(document, before, "Development", first_edit, named("M2"))
    seen["new bed"] = left_after(document, before, "AssemblyBed", first_edit, named("M2"))
    return seen


steps.run(cuts, kinds, parts)
