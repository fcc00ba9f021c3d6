# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: panels of every kind, refusals, keys, templates, stopping."""

import os
import sys
from contextlib import contextmanager

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import member_document, ok_enabled, panel_text, whole_document
from hands import asked, field, key, named, press, retype, run, select, window
from node_panel import node_fields, ranks_of_a_node

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def double_clicks():
    """Each kind opens its panel by a double-click; a value edited shows at once; Cancel takes it
    back; OK keeps it as one undo step."""
    document = whole_document("Panels")
    edits = (
        ("Ground", "Offset", "30 mm", 30.0),
        ("M1-axis", "EndExtension", "1 m", 1000.0),
        ("B", "Height", "450 mm", 450.0),
        ("M1", "OffsetZ", "-20 mm", -20.0),
        ("M1 plates", "StationSpacing", "400 mm", 400.0),
        ("M1 patterns", "GreenEnd", "25", 25.0),
        ("M1 bed", "SaddleSpacing", "1500 mm", 1500.0),
        ("N1", "Gap", "5 mm", 5.0),
        ("M1 sheets", "Project", "Hall", "Hall"),
    )
    result = {}
    for label, name, text, wanted in edits:
        obj = named(label)
        seen = {}
        for finish in ("Cancel", "Ok"):
            before = _value(obj, name)
            obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
            steps.settle(3)
            retype(field(name), text)
            line = field(name)
            if isinstance(line, QtGui.QLineEdit):
                line.editingFinished.emit()
            steps.settle(5)
            seen[f"{finish} typed"] = _value(obj, name) == wanted
            steps.picture(f"panel_{obj.BT_Type}")
            press(finish)
            seen[finish] = [before == _value(obj, name), len(document.UndoNames)]
        seen["status"] = obj.Status
        seen["open"] = bool(FreeCADGui.Control.activeDialog())
        document.undo()
        document.recompute()
        seen["undone"] = _value(obj, name) == before
        document.clearUndos()
        result[label] = seen
    return result


def _value(obj, name):
    value = getattr(obj, name)
    return getattr(value, "Value", value)


def refused():
    """Texts no quantity can be: the reason at the field, OK off; nothing is kept."""
    document = FreeCAD.ActiveDocument
    bed = named("M1 bed")
    select(bed)
    run("AssemblyBed")
    result = {}
    for text in ("", "5 k", "two", "=Nothing.here", "="):
        retype(field("SaddleSpacing"), "1 m")
        field("SaddleSpacing").findChild(QtGui.QLineEdit).clear()
        retype(field("SaddleSpacing"), text)
        result[text] = [ok_enabled(), field("SaddleSpacing").toolTip(), panel_text()]
    steps.picture("refused")
    retype(field("SaddleSpacing"), "1200 mm")
    result["mended"] = [ok_enabled(), bool(field("SaddleSpacing").styleSheet())]
    retype(field("SaddleSpacing"), "=2 * 600 mm + 1 m")
    steps.settle(5)
    result["bound"] = [ok_enabled(), bed.SaddleSpacing.Value]
    press("Ok")
    result["kept"] = [bed.SaddleSpacing.Value, [list(e) for e in bed.ExpressionEngine]]
    result["undo"] = document.UndoNames
    document.undo()
    document.recompute()
    result["undone"] = [bed.SaddleSpacing.Value, list(bed.ExpressionEngine)]
    document.clearUndos()
    select(named("B"))
    run("Section")
    retype(field("Thickness"), "400 mm")
    steps.settle(6)
    result["by the checks"] = [named("M1 plates").Status, ok_enabled()]
    press("Cancel")
    status = named("M1 plates").Status
    result["cancelled"] = [named("B").Thickness.Value, status, document.UndoNames]
    return result


def by_keys():
    """A section edited and a joint moved, added and removed without the mouse."""
    document = FreeCAD.ActiveDocument
    plates = named("M1 plates")
    select(plates)
    run("Splits")
    # A bar shown while an undo was computed took the keyboard along.
    keys.active(window())
    view = window().findChildren(QtGui.QGraphicsView)[-1]
    view.setFocus()
    result = {}
    key(view, QtCore.Qt.Key_Down)
    steps.settle(2)
    result["first"] = [field("place").property("rawValue"), _verdict()]
    key(view, QtCore.Qt.Key_Down)
    key(view, QtCore.Qt.Key_Right)
    steps.settle(6)
    result["second moved"] = list(plates.JointsTop)
    key(view, QtCore.Qt.Key_Insert)
    steps.settle(6)
    result["added"] = list(plates.JointsTop)
    retype(field("place"), "5 m")
    steps.settle(6)
    result["typed"] = list(plates.JointsTop)
    result["verdict"] = _verdict()
    steps.picture("split_keys")
    retype(field("place"), "80 m")
    result["beyond"] = [list(plates.JointsTop), ok_enabled(), field("place").toolTip()]
    retype(field("place"), "5 m")
    view.setFocus()
    key(view, QtCore.Qt.Key_Delete)
    steps.settle(6)
    result["removed"] = list(plates.JointsTop)
    press("Ok")
    result["undo"] = document.UndoNames
    document.undo()
    document.recompute()
    result["undone"] = list(plates.JointsTop)
    return result


def _verdict():
    return field("verdict", QtGui.QLabel).text()


def lanes():
    """The split editor of a face in two lanes: each is drawn, their joints move together."""
    from BendTorsionWB.gui.split_scene import JointItem, PlateItem

    document = FreeCAD.ActiveDocument
    plates = named("M1 plates")
    plates.LanesTop = [0.4]
    document.recompute()
    document.clearUndos()
    select(plates)
    run("Splits")
    view = window().findChildren(QtGui.QGraphicsView)[-1]
    items = view.scene().items()
    names = [i.text() for i in items if isinstance(i, QtGui.QGraphicsSimpleTextItem)]
    drawn = [i for i in items if isinstance(i, PlateItem)]
    top = [i for i in items if isinstance(i, JointItem) and i.face == "top" and i.k == 0]
    before = [item.line().x1() for item in top]
    panel = drawn[0].panel
    panel.move_joint("top", 0, panel.joints["top"][0] + 500.0)
    moved = [item.line().x1() - x for item, x in zip(top, before)]
    steps.picture("split_lanes")
    steps.settle(6)
    marks = sorted(mark for mark in plates.Marks if "-T" in mark)
    seen = {"names": names, "plates": len(drawn), "moved": moved, "marks": marks}
    seen["status"] = plates.Status
    press("Cancel")
    plates.LanesTop = []
    document.recompute()
    document.clearUndos()
    return seen


def part_tables():
    """What the table of openings says of itself, and offers for a face."""
    select(named("M1 plates"))
    run("Openings")
    rows = field("rows", QtGui.QTableWidget)
    seen = [field("hint", QtGui.QLabel).text(), rows.choices(0, 0), rows.choices(0, 1)]
    rows.write({(0, 0): "Top", (0, 1): "1.5 m", (0, 2): "1,200", (0, 3): "d=120", (1, 2): "3,400"})
    steps.settle()
    marked = [bool(rows.item(0, c).toolTip()) for c in range(4)]
    refused = [ok_enabled(), panel_text(), marked]
    rows.write({(0, 2): "2 cm + 5 mm", (1, 2): ""})
    steps.settle(6)
    plates = named("M1 plates")
    read = [plates.OpeningFaces, plates.OpeningPlaces, plates.OpeningOffsets, ok_enabled()]
    press("Cancel")
    return [*seen, refused, read]


def joint_fields():
    """Places of joints with units; what cannot be takes them back."""
    plates = named("M1 plates")
    select(plates)
    run("Plates")
    line = field("joints top")
    seen = {"before": list(plates.JointsTop)}
    retype(line, "2 m 4.5 m + 5 mm")
    seen["units"] = [list(plates.JointsTop), ok_enabled()]
    retype(line, "3 m bf")
    seen["refused"] = [list(plates.JointsTop), ok_enabled()]
    press("Cancel")
    seen["cancelled"] = list(plates.JointsTop)
    return seen


def context_menus():
    """What the context menu offers for each kind of selection."""
    from BendTorsionWB.gui import commands

    document = FreeCAD.ActiveDocument
    box = document.addObject("Part::Box", "Box")
    document.recompute()
    found = {}
    chosen = {label: named(label) for label in ("M1", "M1 plates", "M1-axis", "B", "N1", "M1 bed")}
    chosen |= {"face": (box, "Face1"), "edge": (box, "Edge1"), "vertex": (box, "Vertex1")}
    for label, item in chosen.items():
        select(item)
        found[label] = [name.removeprefix("BendTorsion_") for name in commands.suited()]
    FreeCADGui.Selection.clearSelection()
    found["nothing"] = commands.suited()
    menu = [
        action.text().replace("&", "")
        for submenu in window().findChildren(QtGui.QMenu)
        for action in submenu.actions()
    ]
    return {"found": found, "menu": menu}


def stopped():
    """Cancel while patterns of many members are made: nothing of it stays."""
    from BendTorsionWB.gui import commands_plates, progress

    document = FreeCAD.ActiveDocument
    before = sorted(item.Name for item in document.Objects)
    bars = []
    watch = QtCore.QTimer()

    def stop():
        for bar in window().findChildren(QtGui.QProgressDialog):
            if bar.isVisible():
                bars.append(bar.labelText())
                bar.cancel()

    watch.timeout.connect(stop)
    watch.start(1)
    patience = commands_plates.PATIENCE
    commands_plates.PATIENCE = 0.0
    document.clearUndos()
    try:
        with asked():
            select(*(item for item in document.Objects if getattr(item, "BT_Type", "") == "Member"))
            shown = run("AssemblyBed")
    finally:
        commands_plates.PATIENCE = patience
        watch.stop()
    status = window().statusBar().currentMessage()
    return {
        "bars": bars[:1],
        "shown": shown,
        "status": status,
        "patience": progress.PATIENCE,
        "same": before == sorted(item.Name for item in document.Objects),
        "undo": document.UndoNames,
    }


def templates():
    """Each document template opens from the command, computed and without errors."""
    from BendTorsionWB.document_templates import template_titles

    result = {}
    for name, title in template_titles().items():
        path = os.path.join(FOLDER, f"{name}.FCStd")
        with asked(choice=title, save_file=path):
            shown = run("Example")
        document = FreeCAD.ActiveDocument
        for item in document.Objects:
            item.touch()
        document.recompute()
        ours = [item for item in document.Objects if hasattr(item, "BT_Type")]
        steps.picture(f"template_{name}")
        result[name] = {
            "shown": shown,
            "file": document.FileName == path,
            "members": sum(item.BT_Type == "Member" for item in ours),
            "wrong": [f"{i.Label}: {i.Status}" for i in ours if getattr(i, "Status", "ok") != "ok"],
            "seen": any(item.ViewObject.Visibility for item in ours if item.BT_Type == "PlateSet"),
        }
        FreeCAD.closeDocument(document.Name)
    return result


def height_typed():
    """Another height typed into the panel of a section, its preview shown."""
    run("Section")
    retype(field("Height"), "620 mm")
    steps.settle(6)


@contextmanager
def added_in(document, name):
    """A script's transaction in a document, with an object that is new."""
    document.openTransaction(name)
    document.addObject("App::FeaturePython", "Thing")
    yield
    document.commitTransaction()


def elsewhere():
    """A transaction in another document while a panel is open, then OK or Cancel."""
    former, seen = FreeCAD.ActiveDocument, {}
    document = whole_document("Own")
    other = FreeCAD.newDocument("Elsewhere")
    FreeCAD.setActiveDocument(document.Name)
    section = named("B")
    for label, button in (("B", "Ok"), ("B", "Cancel"), ("", "Ok"), ("", "Cancel")):
        count, height = len(document.Objects), section.Height.Value
        FreeCADGui.Selection.clearSelection()
        if label:
            select(section)
        height_typed()
        with added_in(other, "Script"):
            pass
        press(button)
        steps.settle(6)
        found = [list(document.UndoNames), list(document.RedoNames)]
        found += [section.Height.Value, len(document.Objects) - count]
        if button == "Ok":
            document.undo()
            document.recompute()
            found += [section.Height.Value == height, len(document.Objects) - count]
        document.clearUndos()
        seen[f"{label} {button}"] = found
    seen["other"] = [list(other.UndoNames), len(other.Objects)]
    select(section)
    height_typed()
    with added_in(other, "Both"):
        named("M1").Label2 = "noted"
    press("Cancel")
    steps.settle(6)
    seen["both"] = [section.Height.Value, named("M1").Label2]
    for own in (other, document):
        FreeCAD.closeDocument(own.Name)
    FreeCAD.setActiveDocument(former.Name)
    return seen


def other_cut():
    """A slope that is none, another cut pressed in the 3D view, the own one dragged and let go."""
    import gc

    import numpy as np

    from BendTorsionWB.gui.cut_dragger import CutDragger

    former = FreeCAD.ActiveDocument
    document = member_document("Cuts")
    member = named("M1")
    select(member)
    run("Member")
    field("segments", QtGui.QComboBox).setCurrentIndex(1)
    steps.settle(4)
    retype(field("Slope2"), "bf")
    steps.settle(4)

    dragger = next(one for one in gc.get_objects() if isinstance(one, CutDragger) and one.handles)

    def at(segment, beyond=0.0):
        handle = next(one for one in dragger.handles if one.segment == segment)
        place = dragger.frames.axis.position(np.array([handle.s + beyond]))
        return dragger.mouse.pixels(place)[0][0]

    def state():
        slope = window().findChildren(QtGui.QWidget, "Slope2")
        shown = [w.findChild(QtGui.QLineEdit).text() for w in slope if w.isVisible()]
        return [field("segments", QtGui.QComboBox).currentIndex() + 1, shown, ok_enabled()]

    cut, other = member.Cut2.Value, member.Cut3.Value
    seen = {"before": state(), "taken": dragger.press(at(3))}
    dragger.move(at(3, 500.0), True)
    dragger.release(at(3))
    steps.settle(6)
    seen["other"] = [*state(), member.Cut2.Value == cut, member.Cut3.Value == other]
    dragger.press(at(2))
    dragger.move(at(2, 500.0), True)
    steps.settle(3)
    seen["dragged"] = [*state(), member.Cut2.Value > cut + 100.0]
    dragger.escape()
    steps.settle(6)
    seen["escaped"] = [*state(), member.Cut2.Value == cut]
    press("Cancel")
    FreeCAD.closeDocument(document.Name)
    FreeCAD.setActiveDocument(former.Name)
    return seen


steps.run(
    double_clicks,
    refused,
    ranks_of_a_node,
    node_fields,
    by_keys,
    lanes,
    part_tables,
    joint_fields,
    context_menus,
    stopped,
    templates,
    elsewhere,
    other_cut,
)
