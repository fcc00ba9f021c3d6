# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: fields of panels come to by keys, cells of the
member table."""

import FreeCADGui
import keys
import steps
from hands import field, named, run, select, window
from PySide import QtGui


def text_of(name):
    """What a field of the panel shows."""
    return field(name).findChild(QtGui.QLineEdit).text()


def to(name):
    """Bring the keyboard to a field by Tab."""
    keys.active(window())
    for _ in range(60):
        now = QtGui.QApplication.focusWidget()
        if now is not None and field(name) in (now, now.parent()):
            return
        keys.strike("Tab", pause=1)
    raise LookupError(name)


def open_section():
    """The panel of the section, with the keyboard in the field of the height."""
    select(named("B"))
    run("Section")
    to("Height")


def panel_open():
    """Whether a task panel is open."""
    return bool(FreeCADGui.Control.activeDialog())


def open_table(row, name):
    """The member table with the keyboard in a cell; its dock."""
    from BendTorsionWB.gui import member_rows

    run("MemberTable")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    keys.active(window())
    dock.table.setFocus()
    dock.table.setCurrentCell(row, member_rows.COLUMNS.index(name))
    steps.settle(3)
    return dock
