# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: the member table by real keys, what it does not take, closed."""

import os
import sys

import FreeCAD

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import long_members
from fields import open_table
from hands import named, run, window
from PySide import QtGui


def first_rows():
    """The rows of the first segments of the members."""
    return [named(f"M{k}") for k in (1, 2, 3)]


def enter():
    """Cells typed one below the other with Enter between."""
    long_members("Table")
    dock = open_table(0, "offset_y")
    keys.type_beside(0.1, "2 cm + 5 mm", "@Return", "50", "@Return")
    steps.settle(8)
    seen = {"offsets": [member.OffsetY1.Value for member in first_rows()], "down": []}
    dock.table.setCurrentCell(0, dock.table.currentColumn())
    for _ in range(3):
        keys.strike("Return", pause=2)
        seen["down"].append(dock.table.currentRow())
    dock = open_table(0, "align")
    keys.type_beside(0.15, "Top", "@Return", "BOTTOM", "@Return", "top", "@Shift_L+Return")
    steps.settle(8)
    seen["aligned"] = [member.Align1 for member in first_rows()]
    seen["up"] = dock.table.currentRow()
    for member in first_rows():
        member.OffsetY1, member.Align1 = 0.0, "centre"
    FreeCAD.ActiveDocument.recompute()
    steps.settle(4)
    dock.hide()
    return seen


def reasons():
    """What stands beside the table after Enter."""
    from BendTorsionWB import make

    dock = open_table(0, "offset_y")
    keys.type_beside(0.05, "1,200", "@Return")
    steps.settle(6)
    seen = {"told": dock.said.text()}
    steps.picture("reason")
    dock.table.setCurrentCell(0, dock.table.currentColumn())
    keys.type_beside(0.05, "@Escape")
    steps.settle(4)
    make.add_cut(named("M1"), 15000.0)
    FreeCAD.ActiveDocument.recompute()
    dock = open_table(1, "cut")
    keys.type_beside(0.05, "99 m", "@Return")
    steps.settle(6)
    seen["checks"] = dock.said.text()
    FreeCAD.ActiveDocument.undo()
    make.remove_segment(named("M1"), 2)
    FreeCAD.ActiveDocument.recompute()
    steps.settle(4)
    seen["mended"] = dock.said.text()
    dock.hide()
    return seen


def block():
    """Four cells of a pasted block that are not taken; Esc in the first, then with all selected."""
    dock = open_table(0, "offset_y")
    at = [(row, dock.table.currentColumn() + k) for row in (0, 1) for k in (0, 1)]

    def texts():
        return [dock.table.item(*cell).text() for cell in at]

    QtGui.QApplication.clipboard().setText("1,200\t2,300\n3,400\t4,500")
    dock.table.paste()
    steps.settle(4)
    seen = {"pasted": texts(), "told": dock.said.text()}
    area = dock.said.parentWidget().parentWidget()
    seen["scrolls"] = area.verticalScrollBar().maximum() >= dock.said.height() - area.height() - 1
    steps.picture("block")
    for name in ("one", "all"):
        for cell in at[: {"one": 0, "all": 4}[name]]:
            dock.table.item(*cell).setSelected(True)
        dock.table.setFocus()
        keys.strike("Escape", pause=4)
        seen[name] = [texts(), dock.said.text(), window().statusBar().currentMessage()]
    dock.hide()
    return seen


def sizes():
    """What is told of sections and lengths; what of it is copied; a section taken from the list."""
    from BendTorsionWB import make

    make.make_section(FreeCAD.ActiveDocument, "C", h=400, b=300, t=10, t_top=20)
    FreeCAD.ActiveDocument.recompute()
    dock = open_table(1, "section")
    option = QtGui.QStyleOptionViewItem()
    column, table = dock.table.currentColumn(), dock.table
    table.itemDelegateForColumn(column).initStyleOption(option, table.model().index(1, column))
    table.copy()
    seen = {"cell": option.text, "copied": QtGui.QApplication.clipboard().text()}
    keys.type_beside(0.1, "c")
    steps.settle(4)
    editor = next(w for w in table.findChildren(QtGui.QLineEdit) if w.isVisible())
    model = editor.completer().model()
    seen["list"] = [model.index(k, 0).data() for k in range(model.rowCount())]
    steps.picture("sections")
    keys.type_beside(0.1, "@Down", "@Return")
    steps.settle(8)
    seen["taken"] = [member.Section1.Label for member in first_rows()]
    last = table.columnCount() - 1
    seen["lengths"] = [table.item(row, last).text() for row in range(3)]
    seen["wanted"] = [member.Length.Value for member in first_rows()]
    seen["heading"] = table.horizontalHeaderItem(last).text()
    FreeCAD.ActiveDocument.undo()
    dock.hide()
    return seen


def empty():
    """The table of a document without members, and of the one with them again."""
    document = FreeCAD.ActiveDocument
    other = FreeCAD.newDocument("Empty")
    run("MemberTable")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    steps.settle(4)
    label = dock.findChild(QtGui.QLabel, "none")
    seen = {"without": [label.isVisible(), dock.table.isVisible(), label.text()]}
    steps.picture("empty")
    FreeCAD.closeDocument(other.Name)
    FreeCAD.setActiveDocument(document.Name)
    steps.settle(6)
    seen["with"] = [label.isVisible(), dock.table.isVisible()]
    dock.hide()
    return seen


def closed():
    """A cell that is not taken, the table closed and opened again, another document between."""
    document = FreeCAD.ActiveDocument
    dock = open_table(0, "offset_y")
    column = dock.table.currentColumn()

    def cell():
        item = dock.table.item(0, column)
        return [item.text(), bool(item.toolTip()), "1,200" in dock.said.text()]

    keys.type_beside(0.05, "1,200", "@Return")
    steps.settle(6)
    window().statusBar().clearMessage()
    dock.close()
    steps.settle(4)
    seen = {"status": window().statusBar().currentMessage()}
    open_table(0, "offset_y")
    seen["again"] = cell()
    other = FreeCAD.newDocument("Other")
    steps.settle(4)
    seen["other document"] = dock.said.text()
    FreeCAD.closeDocument(other.Name)
    FreeCAD.setActiveDocument(document.Name)
    steps.settle(6)
    seen["back"] = cell()
    dock.table.setCurrentCell(0, column)
    dock.table.setFocus()
    keys.strike("Escape", pause=4)
    seen["dropped"] = cell()
    dock.hide()
    return seen


def same_name():
    """A text that is not taken, the table closed, then its document; another of that name."""
    document = FreeCAD.ActiveDocument
    seen = []
    for text in ("1,200", ""):
        former = FreeCAD.ActiveDocument
        long_members("Twice")
        dock = open_table(0, "offset_y")
        column = dock.table.currentColumn()
        if text:
            keys.type_beside(0.05, text, "@Return")
            steps.settle(6)
        seen.append([dock.table.item(0, column).text(), FreeCAD.ActiveDocument.Name])
        dock.hide()
        steps.settle(4)
        FreeCAD.closeDocument("Twice")
        FreeCAD.setActiveDocument(former.Name)
    FreeCAD.setActiveDocument(document.Name)
    return seen


steps.run(enter, reasons, block, sizes, empty, closed, same_name)
