# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window in another language: what commands, menus and pages say."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps


def commands():
    """Menu text of each command, by name."""
    steps.settle()
    window = FreeCADGui.getMainWindow()
    names = [name for name in FreeCADGui.listCommands() if name.startswith("BendTorsion_")]
    infos = {name: FreeCADGui.Command.get(name).getInfo() for name in names}
    bars = [bar.windowTitle() for bar in window.findChildren(QtGui.QToolBar)]
    menus = [action.text() for action in window.menuBar().actions()]
    actions = {}
    for name in names:
        found = FreeCADGui.Command.get(name).getAction()
        actions[name] = found[0].text() if found else ""
    return {
        "menu": {name: info["menuText"] for name, info in infos.items()},
        "actions": actions,
        "toolbars": bars,
        "menus": menus,
    }


def pages():
    """The words of the preferences page and of the legend's title."""
    from BendTorsionWB.gui import legend
    from BendTorsionWB.gui.preferences_page import PreferencesPage

    page = PreferencesPage()
    return {
        "labels": [label.text() for label in page.form.findChildren(QtGui.QLabel)],
        "title": page.form.windowTitle(),
        "legend": FreeCAD.Qt.translate("BendTorsion", legend.TITLES["strain"]),
    }


steps.run(commands, pages)
