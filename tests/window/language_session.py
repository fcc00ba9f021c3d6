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


def panels():
    """A panel of each kind and both pages of preferences, with every label that is cut off."""
    from commands_aids import whole_document

    from BendTorsionWB.gui import editors, section_dialog
    from BendTorsionWB.gui.preferences_page import OutputPage, PreferencesPage

    document = whole_document("Panels")
    window = FreeCADGui.getMainWindow()
    cut, words = {}, {}
    for obj in [
        item for item in document.Objects if getattr(item, "BT_Type", "") in editors.PANELS
    ]:
        if obj.BT_Type in words:
            continue
        FreeCADGui.getDocument(document.Name).setEdit(obj.Name)
        steps.settle(4)
        steps.picture(f"zh_{obj.BT_Type}")
        dock = next(d for d in window.findChildren(QtGui.QDockWidget) if d.isVisible())
        cut[obj.BT_Type], words[obj.BT_Type] = steps.cut_labels(dock), steps.words(dock)
        FreeCADGui.getDocument(document.Name).resetEdit()
        steps.settle(3)
    for page in (PreferencesPage(), OutputPage()):
        page.loadSettings()
        page.form.resize(page.form.sizeHint())
        page.form.show()
        steps.settle(2)
        name = type(page).__name__
        cut[name], words[name] = steps.cut_labels(page.form), steps.words(page.form)
        page.form.hide()
    dialog = section_dialog.SectionDialog(window, 1, 3)
    dialog.show()
    steps.picture("zh_dialog")
    cut["dialog"], words["dialog"] = steps.cut_labels(dialog), steps.words(dialog)
    dialog.close()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.picture("zh_window")
    return {"cut": cut, "words": words}


def refusals():
    """What commands say when nothing is selected, where the window itself has the words."""
    from hands import run

    document = FreeCAD.newDocument("Nothing")
    names = ("MembersFromSelection", "Axis", "Member", "CutPoint", "Alignment", "Plates", "Node")
    names += ("Development", "Sheets", "ShowMarks", "ExportPackage", "WriteSchedule")
    said = {name: run(name, 0) for name in names}
    FreeCAD.closeDocument(document.Name)
    return said


def findings():
    """An error and warnings in the panel of findings, a task panel, the member table and the
    status bar; a refusal in its message box; and what the objects hold of them."""
    from commands_aids import member_document, panel_text
    from hands import field, named, press, retype, run, select

    from BendTorsionWB.gui import command, finding_words, macro

    document = member_document("Found")
    plates, section = named("M1 plates"), named("B600")
    plates.JointsTop = [900.0, 950.0]
    document.recompute()
    shown = {"warnings": [finding_words.of_text(text).message for text in plates.Findings]}
    select(section)
    run("Section")
    retype(field("Thickness"), "400 mm")
    steps.settle(10)
    shown["label"] = panel_text()
    shown["field"] = field("Thickness").toolTip()
    steps.picture("zh_error_in_panel")
    press("Cancel")
    named("M2").Cut2 = 90000.0
    document.recompute()
    run("MemberTable")
    run("Findings")
    steps.settle(6)
    window = FreeCADGui.getMainWindow()
    docks = {
        name: window.findChild(QtGui.QDockWidget, f"BendTorsion_{name}").table
        for name in ("FindingsPanel", "MemberTable")
    }
    steps.picture("zh_findings")
    found = docks["FindingsPanel"]
    shown["headings"] = [found.horizontalHeaderItem(c).text() for c in range(found.columnCount())]
    shown["rows"] = [
        [found.item(r, c).text() for c in range(found.columnCount())]
        for r in range(found.rowCount())
    ]
    shown["tooltips"] = [found.item(r, 0).toolTip() for r in range(found.rowCount())]
    table = docks["MemberTable"]
    shown["cells"] = [
        table.item(r, c).toolTip()
        for r in range(table.rowCount())
        for c in range(table.columnCount())
        if table.item(r, c).toolTip()
    ]
    select(named("M2"))
    steps.settle(2)
    shown["status_bar"] = window.statusBar().currentMessage()
    told = []
    command._show = told.append
    with command.errors_shown():
        macro.raise_errors([named("M2")])
    with command.errors_shown():
        open(os.path.join(os.path.dirname(__file__), "nothing", "there"), encoding="utf-8")
    shown["boxes"] = told
    shown["held"] = [*named("M2").Findings, named("M2").Status]
    return shown


steps.run(commands, pages, panels, refusals, findings)
