# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window in another language: every text of ours that can be seen."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import whole_document
from hands import asked, form, named, press, run, select, window
from words_aids import menu_texts, model_texts, plain, texts_of

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])
FOUND = ("findings",)
"""Widgets whose text is what the checks found."""


def commands():
    """Texts and tooltips of commands, of the menu and the toolbars."""
    steps.settle()
    found = []
    for name in FreeCADGui.listCommands():
        if name.startswith("BendTorsion_"):
            for action in FreeCADGui.Command.get(name).getAction():
                found += [action.text(), action.toolTip(), action.statusTip(), action.whatsThis()]
    for action in window().menuBar().actions():
        if _is_ours(action.text()):
            found += menu_texts(action.menu())
    bars = [bar.windowTitle() for bar in window().findChildren(QtGui.QToolBar)]
    return plain([*found, *filter(_is_ours, bars)])


def _is_ours(title):
    return "弯扭" in title or "BendTorsion" in title


def dock():
    """The dock a task panel stands in."""
    return next(d for d in window().findChildren(QtGui.QDockWidget) if d.isVisible())


def panels():
    """The panel of each kind of object, tables of parts, the split editor, the alignment."""
    from BendTorsionWB.gui import editors

    document, found = whole_document("Words"), {}
    for obj in list(document.Objects):
        kind = getattr(obj, "BT_Type", "")
        if kind in editors.PANELS and kind not in found:
            obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
            steps.settle(4)
            found[kind] = _panel()
            press("Cancel")
    names = ("Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds", "Splits", "Alignment")
    for name in (*names, "CutPoint"):
        select(named("M1"))
        run(name)
        found[name] = _panel()
        steps.picture(f"zh_{name}")
        press("Cancel")
    return found


def _panel():
    boxes = [box for box in dock().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    found = [text for box in boxes for text in texts_of(box)]
    return plain([*found, *texts_of(form(), FOUND)])


def docks():
    """The member table and the list of findings."""
    found = {}
    for name, command in (("MemberTable", "MemberTable"), ("FindingsPanel", "Check")):
        run(command)
        own = window().findChild(QtGui.QDockWidget, f"BendTorsion_{name}")
        steps.settle(4)
        found[name] = texts_of(own)
        steps.picture(f"zh_{name}")
        if name == "MemberTable":
            own.table.write({(0, 3): "500"})
            steps.settle()
            found["left out"] = [own.said.text()]
        own.hide()
    return found


def dialogs():
    """The dialog of members, choices, pages of preferences, bars of long work."""
    from BendTorsionWB.gui import ask, section_dialog
    from BendTorsionWB.gui.preferences_page import OutputPage, PreferencesPage

    found, said = {}, []
    dialog = section_dialog.SectionDialog(window(), 1, 3)
    dialog.show()
    steps.settle(2)
    found["members"] = texts_of(dialog)
    dialog.close()
    for page in (PreferencesPage(), OutputPage()):
        page.loadSettings()
        page.form.show()
        steps.settle(2)
        found[type(page).__name__] = texts_of(page.form)
        page.form.hide()
    former = {name: getattr(ask, name) for name in ("choice", "open_file", "save_file", "folder")}

    def refuse(*given):
        for text in given:
            said.extend([text] if isinstance(text, str) else text)

    for name in former:
        setattr(ask, name, refuse)
    for command in ("ColourBy", "Example", "ImportSchedule", "ImportShapes", "WriteSchedule"):
        run(command)
    for command in ("ExportPackage", "Report", "SupportBundle"):
        run(command)
    for name, function in former.items():
        setattr(ask, name, function)
    found["asked"] = plain(said)
    return found


def told():
    """What the status bar says, and the bar of long work."""
    from BendTorsionWB.gui import ask
    from BendTorsionWB.gui.progress import progress

    said, before = [], (ask.tell, ask.warn)
    ask.tell = ask.warn = said.append
    for _ in range(3):
        run("ShowAs")
    run("Repair")
    select(named("M1"), named("M2"))
    run("Node")
    press("Cancel")
    for name, ending in (("WriteSchedule", "w.xlsx"), ("Report", "r.json")):
        with asked(save_file=os.path.join(FOLDER, ending)):
            said.extend(run(name))
    with asked(save_file=os.path.join(FOLDER, "b.zip")):
        said.extend(run("SupportBundle"))
    with asked(folder=os.path.join(FOLDER, "package")):
        said.extend(run("ExportPackage"))
    ask.tell, ask.warn = before
    bars = []
    with progress(FreeCAD.Qt.translate("BendTorsion", "Export package")) as report:
        report("M1", 1, 2)
        bar = next(b for b in window().findChildren(QtGui.QProgressDialog) if b.isVisible())
        bars = texts_of(bar)
    return plain([*said, *bars])


def view():
    """Legends and labels in the 3D view; what the context menu of a member offers."""
    from pivy import coin

    from BendTorsionWB.gui import legend

    document = FreeCAD.ActiveDocument
    found = {"legend": []}
    plates, real = named("M1 plates"), legend._column

    def column(painter, left, title, names, rows):
        found["legend"] += [title, *(text for _, text in rows)]
        real(painter, left, title, names, rows)

    legend._column = column
    for by in plates.getEnumerationsOfProperty("ColourBy"):
        with asked(choice=FreeCAD.Qt.translate("BendTorsion", by)):
            FreeCADGui.Selection.clearSelection()
            run("ColourBy", 2)
        entries = legend.entries(document)
        if entries:
            legend.paint(entries)
        if by == "forming":
            steps.picture("zh_forming")
    legend._column = real
    for name in ("ShowMarks", "ShowPoints", "ShowFrames"):
        run(name, 2)
    select(named("M1"))
    run("CutPoint")
    search = coin.SoSearchAction()
    search.setType(coin.SoType.fromName("SoFrameLabel"))
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(FreeCADGui.ActiveDocument.ActiveView.getSceneGraph())
    labels = [p.getTail().getField("string").get().getString() for p in search.getPaths()]
    found["labels"] = plain(labels)
    press("Cancel")
    menu = QtGui.QMenu()
    named("M1").ViewObject.Proxy.setupContextMenu(named("M1").ViewObject, menu)
    found["menu"] = menu_texts(menu)
    return found


def properties():
    """By kind of object: what the property editor calls the groups of our properties, and tells of
    each of them."""
    document, found = FreeCAD.ActiveDocument, {}
    # A property editor that is hidden stays empty.
    steps.side().setVisible(True)
    for obj in document.Objects:
        kind = getattr(obj, "BT_Type", "")
        if not kind or kind in found:
            continue
        select(obj)
        steps.settle(4)
        editors = window().findChildren(QtGui.QTreeView)
        name = "Gui::PropertyEditor::PropertyEditor"
        editors = [item for item in editors if item.metaObject().className() == name]
        rows = [row for item in editors for row in model_texts(item.model())]
        ours = {item.name for item in obj.Proxy.declared(obj)} | {"ShowMarks", "ShowFrames"}
        tips = {}
        for _, tip in rows:
            head, _, told = tip.partition("\n\n")
            own = head.rpartition("Name: ")[2]
            if own in ours:
                tips[own] = told
        groups = {obj.getGroupOfProperty(name) for name in tips if name in obj.PropertiesList}
        titles = [title for title, tip in rows if not tip]
        found[kind] = {"tips": tips, "groups": sorted(groups), "titles": titles}
        if kind == "Member":
            steps.picture("zh_properties")
    return found


steps.run(commands, panels, docks, dialogs, told, view, properties)
