# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: every command and the task panels; the docks stand in
commands_docks."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import member_document, ok_enabled, panel_text, recorded
from commands_docks import findings, table
from hands import field, key, named, press, retype, run, select, window


def reachable():
    """By its title, how many buttons each of our toolbars shows, and whether it hides others behind
    an arrow, in a window of 1600 pixels."""
    found = {}
    for bar in window().findChildren(QtGui.QToolBar):
        if bar.windowTitle().startswith("BendTorsion"):
            buttons = [bar.widgetForAction(a) for a in bar.actions() if not a.isSeparator()]
            arrow = bar.findChild(QtGui.QToolButton, "qt_toolbar_ext_button")
            shown = sum(button.isVisible() for button in buttons)
            found[bar.windowTitle()] = [shown, arrow is not None and arrow.isVisible()]
    return [window().width(), found]


def commands():
    """Toolbars, words, icons and shortcuts."""
    from BendTorsionWB.gui import commands as all_commands

    bars = FreeCADGui.activeWorkbench().getToolbarItems()
    own = {name: bars[name] for name in bars if name.startswith("BendTorsion")}
    listed = FreeCADGui.listCommands()
    made = all_commands.commands().values()
    others = {}
    for action in window().findChildren(QtGui.QAction):
        if not action.shortcut().isEmpty():
            others.setdefault(action.shortcut().toString(), set()).add(action.objectName())
    steps.picture("toolbars")
    return {
        "toolbars": own,
        "reachable": reachable(),
        "registered": [item.full_name in listed for item in made],
        "icons": [os.path.exists(item.GetResources()["Pixmap"]) for item in made],
        "words": [bool(item.text and len(item.tooltip) > 20) for item in made],
        "shortcuts": [item.shortcut for item in made],
        "used_twice": {item: sorted(who) for item, who in others.items() if len(who) > 1},
    }


def nothing_selected():
    """Every command that needs a selection says what to select, and changes nothing."""
    document = FreeCAD.newDocument("Nothing")
    names = (
        *("MembersFromSelection", "Axis", "Member", "CutPoint", "Alignment", "Plates", "Pieces"),
        *("Diaphragms", "Splits", "Development", "AssemblyBed", "Sheets", "ShowFrames"),
        *("Openings", "FaceMarks", "Welds", "Node"),
        *("ShowMarks", "ShowPoints", "ShowAs", "ColourBy", "ExportPackage", "Report"),
        "WriteSchedule",
    )
    shown = {name: run(name, 0) for name in names}
    objects, undo = len(document.Objects), document.UndoNames
    box = document.addObject("Part::Box", "Box")
    document.recompute()
    select(box)
    wrong = {name: run(name) for name in ("Member", "Plates", "MembersFromSelection", "Axis")}
    FreeCAD.closeDocument("Nothing")
    inactive = [name for name in names if FreeCADGui.isCommandActive(f"BendTorsion_{name}")]
    return {
        "shown": shown,
        "wrong": wrong,
        "objects": objects,
        "undo": undo,
        "active_without_document": inactive,
    }


def members():
    """One face, one arc and a compound of two chains: three members; the macro does it again."""
    import Part

    def base(name):
        document = FreeCAD.newDocument(name)
        sphere = document.addObject("Part::Sphere", "Sphere")
        sphere.Radius = 20000
        arcs = [
            Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, tilt, 30), start, end)
            for tilt, start, end in ((10, 10, 50), (25, 10, 30), (25, 30, 50), (40, 10, 50))
        ]
        for item, shape in (("One", arcs[0]), ("Two", Part.Compound(arcs[1:]))):
            document.addObject("Part::Feature", item).Shape = shape
        document.recompute()
        return document

    document = base("Members")
    before = {item.Name for item in document.Objects}
    select((document.Sphere, "Face1"), document.One, document.Two)
    seen = {}

    def accept():
        dialog = QtGui.QApplication.activeModalWidget()
        ok = dialog.buttons.button(QtGui.QDialogButtonBox.Ok)
        retype(dialog.fields["t"], "400 mm")
        seen["too_thick"] = [ok.isEnabled(), dialog.words.text()]
        retype(dialog.fields["t"], "16 mm")
        retype(dialog.fields["h"], "0.8 m")
        dialog.align.choose("top")
        dialog.first.setValue(5)
        seen["dialog"] = [ok.isEnabled(), dialog.words.text()]
        steps.picture("members_dialog")
        dialog.accept()

    QtCore.QTimer.singleShot(300, accept)
    start = len(recorded())
    seen["shown"] = run("MembersFromSelection")
    lines = [line for line in recorded()[start:] if not line.startswith("#")]
    seen["undo"] = document.UndoNames

    def volumes(of):
        return {item.Label: item.Shape.Volume for item in of.Objects if item.Name not in before}

    seen["volumes"] = volumes(document)
    document.Sphere.ViewObject.Visibility = False
    FreeCADGui.Selection.clearSelection()
    plates = [item for item in document.Objects if getattr(item, "BT_Type", "") == "PlateSet"]
    select(*plates)
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    FreeCADGui.Selection.clearSelection()
    steps.picture("members")
    seen["tree"] = [text for depth, text in steps.tree_items() if depth == 2]
    document.undo()
    seen["after_undo"] = sorted({item.Name for item in document.Objects} - before)
    again = base("Again")
    exec("\n".join(lines), {})
    seen["again"] = volumes(again)
    seen["lines"] = lines
    for name in ("Members", "Again"):
        FreeCAD.closeDocument(name)
    return seen


def section_panel():
    """Type a height: shown at once; Cancel takes all back; OK is one undo step of one line."""
    document = member_document("Sections")
    section, plates = named("B600"), named("M1 plates")
    state = {"mass": [plates.Mass], "height": [section.Height.Value], "undo": []}

    def note():
        state["mass"].append(plates.Mass)
        state["height"].append(section.Height.Value)
        state["undo"].append(document.UndoNames)

    select(section)
    run("Section")
    state["inactive"] = FreeCADGui.isCommandActive("BendTorsion_Member")
    retype(field("Height"), "900 mm")
    steps.settle(10)
    note()
    steps.picture("section_panel")
    press("Cancel")
    note()
    select(section)
    run("Section")
    retype(field("Thickness"), "400 mm")
    steps.settle(10)
    state["bad"] = [panel_text(), plates.PlateCount, plates.Status]
    state["ok"] = ok_enabled()
    state["flagged"] = [bool(field(name).styleSheet()) for name in ("Thickness", "Height")]
    steps.picture("section_bad")
    press("Cancel")
    note()
    start = len(recorded())
    section.ViewObject.Proxy.doubleClicked(section.ViewObject)
    steps.settle()
    retype(field("Height"), "700 mm")
    steps.settle(10)
    press("Ok")
    note()
    state["lines"] = [line for line in recorded()[start:] if not line.startswith("#")]
    document.undo()
    document.recompute()
    note()
    state["open"] = bool(FreeCADGui.Control.activeDialog())
    FreeCADGui.Selection.clearSelection()
    made = run("Section")
    press("Ok")
    state["new"] = [made, [item.Label for item in document.Objects][-1], document.UndoNames[:1]]
    document.undo()
    return state


def member_panel():
    """Segments added, given a section, moved and taken away; cuts picked and dragged."""
    document = FreeCAD.ActiveDocument
    member = named("M1")
    select(member)
    run("Member")
    segments = field("segments", QtGui.QComboBox)
    result = {"segments": [segments.count()]}
    segments.setCurrentIndex(1)
    steps.settle()
    result["transition"] = [
        label.text() for label in window().findChildren(QtGui.QLabel) if "5000" in label.text()
    ]
    retype(field("Cut2"), "4500 mm")
    steps.settle(10)
    steps.picture("member_panel")
    result["cut"] = member.Cut2.Value
    field("alignment").setFocus()
    key(field("alignment"), QtCore.Qt.Key_Up)
    result["align"] = [member.Align1, member.Align2]
    next(b for b in window().findChildren(QtGui.QPushButton) if b.text() == "Add cut").click()
    steps.settle(10)
    result["segments"].append(member.Segments)
    result["cuts"] = [getattr(member, f"Cut{k}").Value for k in range(2, member.Segments + 1)]
    result["status"] = member.Status
    press("Cancel")
    result["cancelled"] = [member.Segments, member.Cut2.Value, member.Align2, document.UndoNames]
    select(member)
    run("CutPoint")
    result["cut_point"] = [member.Segments, field("segments", QtGui.QComboBox).currentIndex() + 1]
    press("Cancel")
    result["cut_cancelled"] = [member.Segments, document.UndoNames]
    select(member)
    run("CutPoint")
    press("Ok")
    result["cut_kept"] = [member.Segments, document.UndoNames]
    document.undo()
    return result


def plate_panels():
    """Joints as text, joints dragged by key, diaphragms as rows, alignment of two members."""
    document = FreeCAD.ActiveDocument
    plates = named("M1 plates")
    select(plates)
    run("Plates")
    result = {"count": [plates.PlateCount]}
    retype(field("joints left"), "8000")
    steps.settle(10)
    result["count"].append(plates.PlateCount)
    retype(field("joints left"), "8000 x")
    result["bad"] = [list(plates.JointsLeft), field("joints left").toolTip(), ok_enabled()]
    steps.picture("plates_panel")
    retype(field("joints left"), "8000")
    retype(field("stock"), "9000 by 2000")
    result["bad stock"] = [plates.Stock, field("stock").toolTip(), ok_enabled()]
    retype(field("stock"), "9000x2000")
    result["stock"] = [plates.Stock, ok_enabled()]
    press("Ok")
    result["kept"] = [list(plates.JointsLeft), document.UndoNames]
    select(plates)
    run("Splits")
    from BendTorsionWB.gui.split_editor import JointItem

    view = window().findChildren(QtGui.QGraphicsView)[-1]
    joint = next(i for i in view.scene().items() if isinstance(i, JointItem) and i.face == "top")
    joint.setFocus()
    before = list(plates.JointsTop)
    for _ in range(3):
        key(view, QtCore.Qt.Key_Left)
    result["moved"] = [before, list(plates.JointsTop)]
    steps.settle(10)
    panel = next(i for i in view.scene().items() if isinstance(i, JointItem)).panel
    panel.move_joint("left", 0, panel.joints["top"][0] - 20.0)
    steps.settle(10)
    result["rules"] = panel_text()
    steps.picture("split_editor")
    press("Cancel")
    result["split_cancelled"] = list(plates.JointsTop)
    select(plates)
    run("Diaphragms")
    rows = field("rows", QtGui.QTableWidget)
    QtGui.QApplication.clipboard().setText("3000\t12\n7000\t12\t2")
    rows.setCurrentCell(0, 0)
    rows.paste()
    steps.settle(10)
    result["diaphragms"] = [list(plates.DiaphragmPlaces), list(plates.DiaphragmGaps), plates.Status]
    rows.write({(2, 0): "nowhere", (2, 1): "12"})
    steps.settle()
    result["bad_row"] = [list(plates.DiaphragmPlaces), rows.item(2, 0).toolTip(), ok_enabled()]
    rows.write({(2, 0): "4500", (2, 1): ""})
    steps.settle()
    result["half_row"] = [list(plates.DiaphragmPlaces), rows.item(2, 1).toolTip(), ok_enabled()]
    steps.picture("diaphragms")
    rows.write({(2, 0): "", (2, 1): ""})
    steps.settle()
    result["mended"] = ok_enabled()
    press("Ok")
    result["undo"] = document.UndoNames
    members_ = [named("M1"), named("M2")]
    select(*members_)
    run("Alignment")
    key(field("alignment"), QtCore.Qt.Key_Down)
    steps.settle(10)
    steps.picture("alignment")
    press("Ok")
    result["aligned"] = [[getattr(m, f"Align{k}") for k in (1, 2, 3)] for m in members_]
    return result


def documents():
    """A panel edits its own document when another is active, and goes with its document."""
    first = FreeCAD.ActiveDocument
    height = named("B600").Height.Value
    second = member_document("Second")
    other = named("B600", second)
    select(other)
    run("Section")
    FreeCAD.setActiveDocument(first.Name)
    retype(field("Height"), "650 mm")
    steps.settle(10)
    press("Ok")
    result = {
        "first": [named("B600", first).Height.Value - height, "Section" in first.UndoNames[:1]],
        "second": [other.Height.Value, second.UndoNames],
    }
    FreeCAD.setActiveDocument("Second")
    select(other)
    run("Section")
    FreeCAD.closeDocument("Second")
    steps.settle(10)
    result["open_after_closing"] = bool(FreeCADGui.Control.activeDialog())
    FreeCAD.setActiveDocument(first.Name)
    first.removeObject(named("A2").Name)
    first.recompute()
    select(named("M2"))
    run("Member")
    result["source_gone"] = panel_text()
    press("Cancel")
    first.removeObject(named("M2 plates").Name)
    first.removeObject(named("M2").Name)
    return result


def folded():
    """Plates made by the command are folded under their member, patterns under them."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument("Folded")
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (5000, 0, 0)])
    member = make.make_member(document, "M1", axis, [make.make_section(document, "B")])
    document.recompute()
    steps.settle()
    select(member)
    run("Plates")
    press("Ok")
    select(member)
    run("Development")
    press("Ok")
    tree = [item for item in steps.tree_items() if item[1].startswith("M1")]
    FreeCAD.closeDocument("Folded")
    return {"tree": tree}


steps.run(
    commands,
    nothing_selected,
    folded,
    members,
    section_panel,
    member_panel,
    plate_panels,
    table,
    findings,
    documents,
)
