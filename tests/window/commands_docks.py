# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steps of the commands session in the docks: the table of all members, the findings."""

import FreeCAD
import FreeCADGui
import steps
from hands import key, named, run, window
from PySide import QtCore, QtGui

NEWER = tuple(int(part) for part in FreeCAD.Version()[:2]) >= (1, 1)
CHINESE = "Chinese (Simplified)" if NEWER else "Chinese Simplified"
"""What FreeCAD calls the language."""


def off_place(axis_label, s):
    """How far the middle of the view is from a place on an axis, mm."""
    import numpy as np

    from BendTorsionWB.objects import axis

    view = FreeCADGui.ActiveDocument.ActiveView
    camera = view.getCameraNode()
    eye = FreeCAD.Vector(*camera.position.getValue().getValue())
    middle = eye + view.getViewDirection() * camera.focalDistance.getValue()
    place = axis.value(named(axis_label)).position(np.array([s]))[0]
    return (middle - FreeCAD.Vector(*map(float, place))).Length


def by_keys(rows, at):
    """What is selected, and how far the view is from the place, once the arrow keys have gone from
    the other rows to the first of some; and after the list is filled anew."""
    rows.setFocus()
    rows.setCurrentCell(at[0], 0)
    for code in (QtCore.Qt.Key_Down, QtCore.Qt.Key_Up):
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        steps.settle()
        key(rows, code)
        steps.settle()
    seen = [rows.currentRow() == at[0], off_place("A1", 8000.0), rows.hasFocus()]
    seen += [[n for s in FreeCADGui.Selection.getSelectionEx() for n in s.SubElementNames]]
    FreeCADGui.Selection.clearSelection()
    FreeCAD.ActiveDocument.recompute(None, True)
    steps.settle()
    return [*seen, len(FreeCADGui.Selection.getSelection())]


def in_chinese(rows):
    """Headings of both docks in the other language, and back."""
    table = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable").table
    seen = []
    for language in (CHINESE, "English"):
        FreeCADGui.setLocale(language)
        steps.settle()
        seen += [[one.horizontalHeaderItem(1).text() for one in (rows, table)]]
    return seen


def table():
    """Paste, fill down, bad cells, undo, in the table of all members."""
    document = FreeCAD.ActiveDocument
    run("MemberTable")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    cells = dock.table
    m1 = named("M1")
    undo = len(document.UndoNames)
    QtGui.QApplication.clipboard().setText("5200\t3\tlinear\ttop\n11200\t3\tlinear\tnowhere")
    cells.clearSelection()
    cells.setCurrentCell(1, 3)
    cells.paste()
    steps.settle()
    result = {
        "rows": cells.rowCount(),
        "cuts": [m1.Cut2.Value, m1.Cut3.Value],
        "align": [m1.Align2, m1.Align3],
        "bad": [cells.item(2, 6).text(), cells.item(2, 6).toolTip()],
        "steps": len(document.UndoNames) - undo,
    }
    cells.clearSelection()
    for row in range(6):
        cells.item(row, 9).setSelected(True)
    cells.item(0, 9).setText("25")
    cells.fill_down()
    steps.settle()
    result["filled"] = [
        getattr(named(name), f"OffsetZ{k}").Value for name in ("M1", "M2") for k in (1, 2, 3)
    ]
    cells.write({(0, 12): "auto", (0, 13): "7000"})
    steps.settle()
    plates = named("M1 plates")
    result["joints"] = [list(plates.AutoJoints), list(plates.JointsRight), plates.Status]
    result["told"] = told_while_typed(cells, named("M1").Label)
    QtGui.QApplication.clipboard().setText('"3"\tlinear')
    cells.clearSelection()
    for row in (1, 2):
        for column in (4, 5):
            cells.item(row, column).setSelected(True)
    cells.paste()
    steps.settle()
    result["repeated"] = [m1.Slope2, m1.Slope3, m1.Transition2, m1.Transition3]
    cells.clearSelection()
    for row, column in ((1, 3), (2, 4)):
        cells.item(row, column).setSelected(True)
    cells.copy()
    result["copied"] = QtGui.QApplication.clipboard().text()
    cells.write({(1, 3): "99000"})
    steps.settle()
    result["error"] = [m1.Status, cells.item(0, 0).toolTip()]
    steps.picture("member_table")
    return result


def told_while_typed(cells, label):
    """What is said in the editor of an alignment: a bad word, a good one; what it offers."""
    cells.setCurrentCell(1, 6)
    cells.editItem(cells.item(1, 6))
    editor = next(w for w in cells.findChildren(QtGui.QLineEdit) if w.isVisible())
    said = []
    for text in ("nowhere", "top"):
        editor.setText(text)
        said.append([bool(editor.styleSheet()), editor.toolTip()])
        if text == "nowhere":
            steps.picture("member_table_typing")
    offered = editor.completer().model().rowCount()
    cells.closeEditor(editor, QtGui.QAbstractItemDelegate.RevertModelCache)
    steps.settle()
    return [*said, offered, cells.item(1, 6).text()]


def findings():
    """The error of the cut is listed; a click selects and goes to it; undo clears the list."""
    document = FreeCAD.ActiveDocument
    run("Check")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_FindingsPanel")
    rows = dock.widget()
    result = {"title": dock.windowTitle()}
    result["texts"] = [rows.item(r, 3).text() for r in range(rows.rowCount())]
    rows.cellClicked.emit(0, 0)
    result["selected"] = [item.Label for item in FreeCADGui.Selection.getSelection()]
    document.undo()
    document.recompute()
    steps.settle()
    result["left"] = [rows.item(r, 0).text() for r in range(rows.rowCount())]
    plates = named("M1 plates")
    plates.AutoJoints, plates.JointsTop, plates.JointsLeft = [], [8000.0], [8010.0]
    plates.JointsBottom, plates.JointsRight = [4000.0], [4010.0]
    document.recompute()
    steps.settle()
    at = [r for r in range(rows.rowCount()) if "s = " in rows.item(r, 2).text()]
    result["positions"] = [rows.item(r, 2).text() for r in at]
    rows.cellClicked.emit(at[0], 0)
    steps.settle()
    result["off_place"] = off_place("A1", 8000.0)
    steps.picture("findings")
    result["by_keys"] = by_keys(rows, at)
    result["headings"] = in_chinese(rows)
    for name in ("BendTorsion_FindingsPanel", "BendTorsion_MemberTable"):
        window().findChild(QtGui.QDockWidget, name).hide()
    return result
