# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: the tutorial of docs/guide.md, step by step, with its pictures.

The steps are functions in the order of the guide; each leaves the picture the guide shows.
"""

import os
import sys
import time

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from hands import answered, asked, field, key, named, press, retype, run, select, window

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def ours(kind):
    """The objects of a kind in the document."""
    return [o for o in FreeCAD.ActiveDocument.Objects if getattr(o, "BT_Type", "") == kind]


def look(*objects):
    """Turn the view to the objects, all when none are given."""
    steps.narrow()
    view = FreeCADGui.ActiveDocument.ActiveView
    view.viewIsometric()
    if objects:
        select(*objects)
        FreeCADGui.SendMsgToActiveView("ViewSelection")
        FreeCADGui.Selection.clearSelection()
    else:
        FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.settle()


def folded_out(depth):
    """Open the tree down to a depth below the document."""
    tree = steps.document_tree()
    tree.expandToDepth(depth)
    steps.settle()


def open_step_file():
    """1: import the STEP file of the architect."""
    with asked(open_file=os.environ["BENDTORSION_WINDOW_STEP"]):
        shown = run("ImportShapes")
    assert shown == [], shown
    steps.settle()
    look()
    steps.picture("1-step-file")
    shapes = [o for o in FreeCAD.ActiveDocument.Objects if hasattr(o, "Shape")]
    return {o.Label: [len(o.Shape.Faces), len(o.Shape.Edges)] for o in shapes}


def members_from_selection():
    """2: select the roof's face and the three curves, one dialog, members with plates."""
    roof = FreeCAD.ActiveDocument.Objects[0]
    border = {edge.hashCode() for edge in roof.Shape.Faces[0].Edges}
    curves = [
        f"Edge{number}"
        for number, edge in enumerate(roof.Shape.Edges, start=1)
        if edge.hashCode() not in border
    ]
    select((roof, "Face1"), *((roof, curve) for curve in curves))
    result = {"curves": len(curves), "undo_before": FreeCAD.ActiveDocument.UndoCount}

    def answer(dialog):
        dialog.fields["h"].setProperty("rawValue", 700.0)
        dialog.fields["b"].setProperty("rawValue", 500.0)
        dialog.fields["t"].setProperty("rawValue", 14.0)
        steps.picture("2-members-dialog")
        result["ok"] = dialog.buttons.button(QtGui.QDialogButtonBox.Ok).isEnabled()
        dialog.accept()

    answered(answer)
    result["shown"] = run("MembersFromSelection")
    result["undo_after"] = FreeCAD.ActiveDocument.UndoCount
    roof.ViewObject.Visibility = False
    look()
    folded_out(1)
    steps.picture("3-members")
    result["members"] = [member.Label for member in ours("Member")]
    result["plates"] = [plates.PlateCount for plates in ours("PlateSet")]
    return result


def edit_section():
    """3: double-click the section, give another height, see the members follow."""
    section = ours("SectionSpec")[0]
    before = [plates.Mass for plates in ours("PlateSet")]
    FreeCADGui.getDocument(FreeCAD.ActiveDocument.Name).setEdit(section.Name)
    steps.settle()
    height = field("Height")
    height.setProperty("rawValue", 600.0)
    start = time.process_time()
    steps.settle(10)
    spent = time.process_time() - start
    steps.picture("4-edit-section")
    press("Ok")
    after = [plates.Mass for plates in ours("PlateSet")]
    return {"before": before, "after": after, "height": section.Height.Value, "seconds": spent}


def member_table():
    """4: the top of every section onto its axis, filled down in the table of all members."""
    from BendTorsionWB.gui import member_rows

    FreeCADGui.Selection.clearSelection()
    shown = run("MemberTable")
    undo = FreeCAD.ActiveDocument.UndoCount
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    cells, column = dock.table, member_rows.COLUMNS.index("align")
    cells.clearSelection()
    cells.setCurrentCell(0, column)
    for row in range(cells.rowCount()):
        cells.item(row, column).setSelected(True)
    cells.item(0, column).setText("top")
    key(cells, QtCore.Qt.Key_D, modifiers=QtCore.Qt.ControlModifier)
    steps.settle()
    look()
    steps.picture("5-member-table")
    dock.hide()
    return {
        "shown": shown,
        "undo": FreeCAD.ActiveDocument.UndoCount - undo,
        "aligned": [member.Align1 for member in ours("Member")],
        "statuses": [plates.Status for plates in ours("PlateSet")],
    }


def joints():
    """5: joints by the rules for all members; those of one on its developed faces."""
    shown, faces = [], ("top", "bottom", "left", "right")
    for plates in ours("PlateSet"):
        select(plates)
        shown += run("Plates")
        for face in faces:
            retype(field(f"joints {face}"), "auto")
        steps.settle(6)
        press("Ok")
    plates = named("M1 plates")
    select(plates)
    shown += run("Splits")
    FreeCADGui.Selection.clearSelection()
    view = window().findChildren(QtGui.QGraphicsView)[-1]
    view.setFocus()
    key(view, QtCore.Qt.Key_Down)
    for _ in range(15):
        key(view, QtCore.Qt.Key_Right)
    steps.settle(10)
    verdict = field("verdict", QtGui.QLabel).text()
    place = field("place").findChild(QtGui.QLineEdit)
    steps.picture("6-split-editor")
    seen = place.cursorPositionAt(QtCore.QPoint(1, place.height() // 2))
    press("Cancel")
    return {
        "shown": shown,
        "verdict": verdict,
        "first_figure_seen": seen,
        "plates": [item.PlateCount for item in ours("PlateSet")],
        "status": plates.Status,
        "warnings": [text for item in ours("PlateSet") for text in item.Findings],
    }


def marks():
    """6: marks of the plates, and what they are coloured by."""
    plates = named("M1 plates")
    select(plates)
    shown = run("ShowMarks")
    with asked(choice="strain"):
        shown += run("ColourBy")
    look(plates)
    steps.picture("7-marks-and-colours")
    select(plates)
    shown += run("ShowMarks")
    with asked(choice="none"):
        shown += run("ColourBy")
    return {"shown": shown, "colour": plates.ColourBy}


def development():
    """7: flat patterns of all members."""
    select(*ours("Member"))
    shown = run("Development")
    for item in (*ours("PlateSet"), *ours("Axis"), *ours("Surface")):
        item.ViewObject.Visibility = False
    for item in ours("Unfold")[1:]:
        item.ViewObject.Visibility = False
    FreeCADGui.Selection.clearSelection()
    steps.narrow()
    FreeCADGui.ActiveDocument.ActiveView.viewTop()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    folded_out(3)
    steps.picture("8-development")
    unfolds = ours("Unfold")
    return {
        "shown": shown,
        "patterns": [len(unfold.Shape.Faces) for unfold in unfolds],
        "errors": [unfold.LengthErrorMax for unfold in unfolds],
        "statuses": [unfold.Status for unfold in unfolds],
    }


def sheets():
    """8: drawing sheets; the first page of the first member."""
    FreeCADGui.Selection.clearSelection()
    shown = run("Sheets")
    pages = [o for o in FreeCAD.ActiveDocument.Objects if o.isDerivedFrom("TechDraw::DrawPage")]
    steps.narrow()
    pages[0].ViewObject.doubleClicked()
    steps.settle(15)
    FreeCADGui.SendMsgToActiveView("ViewFit")
    folded_out(3)
    steps.picture("9-sheet")
    return {
        "shown": shown,
        "tree": steps.tree_items(),
        "pages": [item.PageCount for item in ours("SheetSet")],
    }


def check():
    """9: everything that is found, in a list."""
    for view in window().findChildren(QtGui.QMdiSubWindow):
        if "sheets" not in view.windowTitle():
            view.setFocus()
    for item in (*ours("PlateSet"), *ours("Surface")):
        item.ViewObject.Visibility = True
    for item in ours("Unfold"):
        item.ViewObject.Visibility = False
    area = window().findChild(QtGui.QMdiArea)
    area.setActiveSubWindow(area.subWindowList()[0])
    look()
    # A joint too close to that of the next face, so that there is something to find.
    plates = named("M1 plates")
    webs = _plates_of(plates, "left")[0].s_end
    plates.AutoJoints = ["bottom", "right"]
    plates.JointsLeft, plates.JointsTop = [webs], [webs - 50.0]
    shown = run("Check")
    rows = window().findChild(QtGui.QDockWidget, "BendTorsion_FindingsPanel").widget()
    found = [rows.item(r, 3).text() for r in range(rows.rowCount())]
    rows.cellClicked.emit(0, 0)
    steps.picture("10-check")
    plates.AutoJoints = ["top", "bottom", "left", "right"]
    plates.JointsLeft = plates.JointsTop = []
    FreeCAD.ActiveDocument.recompute()
    errors = [o.Label for o in FreeCAD.ActiveDocument.Objects if getattr(o, "Status", "ok") != "ok"]
    return {"shown": shown, "errors": errors, "found": found}


def _plates_of(plates, face):
    """The developed plates of a face, along the member."""
    from BendTorsionWB.objects import unfold

    record = unfold.member_record_of(next(item for item in ours("Unfold") if item.Plates == plates))
    return sorted((p for p in record.plates if p.face == face), key=lambda plate: plate.s_start)


def export():
    """10: everything for the shop in one folder."""
    package = os.path.join(FOLDER, "package")
    with asked(folder=package):
        shown = run("ExportPackage")
    marks = [mark for plates in ours("PlateSet") for mark in plates.Marks]
    cut = sorted(os.listdir(os.path.join(package, "plates")))
    return {
        "shown": shown,
        "files": sorted(os.listdir(package)),
        "cut": [name for name in cut if name.endswith(".dxf")],
        "sheets": sorted(os.listdir(os.path.join(package, "sheets"))),
        "marks": sorted(marks),
    }


steps.run(
    *(open_step_file, members_from_selection, edit_section, member_table, joints, marks),
    *(development, sheets, check, export),
)
