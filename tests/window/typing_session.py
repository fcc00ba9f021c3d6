# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: keys of the X server, typed at hand's speed while previews run."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import long_members, ok_enabled, panel_text
from fields import open_section, text_of, to
from hands import field, named, press, run, select, window


def typed():
    """By text and seconds between keys: what the section's height is, and the field shows, then."""
    long_members("Typed")
    seen = {}
    for text, gap in (
        ("734", 0.15),
        ("734", 0.5),
        ("734 mm", 0.25),
        ("2 * 325 mm", 0.2),
        ("50 cm", 0.1),
        ("0.5 m", 0.1),
        ("1 m - 35 mm", 0.1),
        ("600 mm + 50 mm", 0.1),
        ("2 * (300 mm + 1 cm)", 0.1),
        ("0,7 m", 0.1),
    ):
        open_section()
        keys.type_beside(gap, text)
        last = [text_of("Height"), named("B").Height.Value, ok_enabled()]
        keys.strike("Tab", pause=3)
        seen[f"{text} {gap}"] = [*last, text_of("Height"), round(named("M1 plates").Mass)]
        press("Cancel")
    open_section()
    # The number alone, as a double-click selects it: its unit stays behind.
    field("Height").findChild(QtGui.QLineEdit).setSelection(0, len("600.00"))
    keys.type_beside(0.1, "50 cm")
    seen["leftover"] = [text_of("Height"), named("B").Height.Value]
    press("Cancel")
    seen["height"] = named("B").Height.Value
    return seen


def refused():
    """A text that is no length stays in its field with a mark, in panels and dialogs."""
    open_section()
    keys.write("bf")
    steps.settle(6)
    now = [text_of("Height"), "border" in field("Height").styleSheet(), ok_enabled()]
    keys.strike("Tab", pause=8)
    left = [text_of("Height"), "border" in field("Height").styleSheet(), ok_enabled()]
    seen = {"now": now, "left": left, "told": panel_text(), "value": named("B").Height.Value}
    press("Cancel")
    from BendTorsionWB.gui.section_dialog import SectionDialog

    dialog = SectionDialog(window())
    dialog.show()
    keys.active(dialog)
    ok = dialog.buttons.button(QtGui.QDialogButtonBox.Ok)
    height = dialog.fields["h"]
    tips = [one.toolTip() for one in dialog.fields.values()]
    keys.strike("Control_L+a", pause=1)
    keys.write("bf")
    keys.strike("Tab", pause=2)
    line = height.findChild(QtGui.QLineEdit)
    marked = [line.text(), "border" in height.styleSheet(), ok.isEnabled(), dialog.words.text()]
    height.setFocus()
    keys.strike("Control_L+a", pause=1)
    keys.write("50 cm")
    keys.strike("Tab", pause=2)
    seen["dialog"] = [tips, marked, [line.text(), ok.isEnabled(), dialog.choice().h]]
    dialog.reject()
    steps.settle(3)
    # Otherwise no window has the keyboard, and one that gets it while a panel is open gives it to
    # the view (FreeCAD 1.1).
    keys.active(window())
    return seen


def shown_when_left():
    """A preview that takes long waits until the field is left, and for no key; Esc stops it."""
    from BendTorsionWB.gui import recomputing, task_panel

    before = task_panel.HEAVY, getattr(recomputing, "PATIENCE", None)
    task_panel.HEAVY, recomputing.PATIENCE = -1.0, 0.0
    mass, seen = named("M1 plates").Mass, {}
    try:
        open_section()
        keys.type_beside(0.1, "900")
        seen["typed"] = [named("M1 plates").Mass == mass, field("Height").styleSheet()]
        seen["told"] = panel_text()
        keys.type_beside(0.1, "@Tab")
        steps.settle(10)
        seen["left"] = [named("M1 plates").Mass > mass, field("Height").styleSheet()]
        press("Cancel")
        # Keys that come while it is computed arrive in the next field.
        open_section()
        keys.type_beside(0.45, "900", "@Tab", "734 mm")
        keys.strike("Tab", pause=10)
        seen["both"] = [named("B").Height.Value, named("B").Breadth.Value]
        press("Cancel")
        open_section()
        keys.type_beside(0.05, "910", "@Return")
        steps.settle(15)
        seen["entered"] = [bool(FreeCADGui.Control.activeDialog()), named("B").Height.Value]
        seen["entered"].append(named("M1 plates").Mass > mass)
        FreeCAD.ActiveDocument.undo()
        FreeCAD.ActiveDocument.recompute()
        open_section()
        keys.type_beside(0.05, "900", "@Escape")
        seen["escaped"] = [bool(FreeCADGui.Control.activeDialog()), named("B").Height.Value]
        seen["mass"] = named("M1 plates").Mass == mass
    finally:
        task_panel.HEAVY, recomputing.PATIENCE = before
    return seen


def told_to_close():
    """FreeCAD's window told to close while a preview is computed, and while what was typed waits
    for it; its question answered by a click on Cancel and by Esc."""
    from BendTorsionWB.gui import recomputing, task_panel

    before = task_panel.HEAVY, recomputing.PATIENCE, task_panel.recompute_each
    task_panel.HEAVY, recomputing.PATIENCE = -1.0, 0.0
    close, seen = f"@close:{int(window().winId())}", {}
    computing, asked = [], []

    def each(*given):
        computing.append(True)
        if closing:
            keys.begin_beside(0.0, close).wait()
        try:
            before[2](*given)
        finally:
            computing.pop()

    def answer():
        box = QtGui.QApplication.activeModalWidget()
        asked.append(bool(computing))
        if len(asked) != 8:
            return
        if closing:
            button = box.button(QtGui.QMessageBox.Cancel)
            at = button.mapToGlobal(button.rect().center()) * button.devicePixelRatioF()
            keys.begin_beside(0.0, f"@{at.x()},{at.y()}")
        else:
            keys.active(box)
            keys.begin_beside(0.0, "@Escape")

    timer = QtCore.QTimer()
    timer.timeout.connect(lambda: QtGui.QApplication.activeModalWidget() and answer())
    task_panel.recompute_each = each
    timer.start(100)
    try:
        for closing, name, height in ((True, "computing", "905"), (False, "waiting", "915")):
            open_section()
            keys.write(height)
            keys.strike("Tab") if closing else keys.begin_beside(0.0, close).wait()
            steps.settle(50)
            seen[name] = [len(asked) >= 8, any(asked), bool(FreeCADGui.Control.activeDialog())]
            keys.active(window())
            press("Ok")
            seen[name] += [named("B").Height.Value, bool(FreeCADGui.Control.activeDialog())]
            asked.clear()
            FreeCAD.ActiveDocument.undo()
            FreeCAD.ActiveDocument.recompute()
    finally:
        timer.stop()
        task_panel.HEAVY, recomputing.PATIENCE, task_panel.recompute_each = before
    return seen


def errors():
    """Sizes that make errors downstream cannot be kept; one of two errors can be mended."""
    # So far below its axis a section as high as can be folds over itself.
    named("M1").OffsetZ = -45000
    FreeCAD.ActiveDocument.recompute()
    open_section()
    keys.type_beside(0.1, "49 m")
    steps.settle(10)
    boxes = [box for box in window().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    ok = boxes[0].button(QtGui.QDialogButtonBox.Ok)
    seen = {"folded": [panel_text(), ok.isEnabled(), ok.toolTip()]}
    keys.strike("Return", pause=8)
    seen["open"] = bool(FreeCADGui.Control.activeDialog())
    press("Cancel")
    section, member = named("B"), named("M1")
    section.Thickness = 400
    member.StartCut, member.OffsetZ = "plumb", 0
    FreeCAD.ActiveDocument.recompute()
    member.Section1 = None
    FreeCAD.ActiveDocument.recompute()
    seen["before"] = [named("M1").Status, named("M2 plates").Status]
    open_section()
    to("Thickness")
    keys.type_beside(0.1, "16")
    steps.settle(8)
    seen["mended"] = [panel_text(), ok_enabled()]
    press("Ok")
    seen["kept"] = [named("B").Thickness.Value, named("M1").Status, named("M2 plates").Status]
    return seen


def long_lengths():
    """A cut beyond 10 m."""
    member = named("M2")
    select(member)
    run("CutPoint")
    keys.active(window())
    to("Cut2")
    keys.strike("Control_L+a", pause=1)
    keys.write("14630.4")
    keys.strike("Tab", pause=8)
    shown = text_of("Cut2")
    press("Cancel")
    return {"shown": shown}


def split_keys():
    """Ins right after Del, while the preview runs."""
    from BendTorsionWB.gui.split_scene import PlateItem

    select(named("M2 plates"))
    run("Splits")
    view = window().findChildren(QtGui.QGraphicsView)[-1]
    panel = next(i for i in view.scene().items() if isinstance(i, PlateItem)).panel
    keys.active(window())
    panel.view.setFocus()
    counts = [sum(map(len, panel.joints.values()))]
    keys.strike("Down", pause=2)
    for gap in (0.2, 0.45):
        keys.type_beside(gap, "@Delete", "@Down", "@Insert", "@Insert")
        counts.append(sum(map(len, panel.joints.values())))
    press("Cancel")
    # PySide knows events by their address, and gives what lived there before.
    return {"counts": counts, "stale": panel.view.event(QtGui.QLabel())}


def table_keys():
    """A cell left by Tab starts a recompute; what is typed on meanwhile is whole."""
    from BendTorsionWB.gui import member_rows

    run("MemberTable")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    table = dock.findChild(QtGui.QTableWidget)
    column = member_rows.COLUMNS.index("top")
    keys.active(window())
    table.setFocus()
    table.setCurrentCell(1, column)
    steps.settle(3)
    keys.type_beside(0.12, "9000", "@Tab", "10000; 20000", "@Return")
    steps.settle(10)
    cells = [table.item(1, column).text(), table.item(1, column + 1).text()]
    dock.hide()
    return {"cells": cells}


steps.run(
    typed, refused, shown_when_left, told_to_close, long_lengths, split_keys, table_keys, errors
)
