# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: what commands make of a selection, and keys typed into tables and
pressed in the 3D view."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import member_document, recorded, whole_document
from hands import answered, asked, field, key, named, press, retype, run, select, window

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def panel_open():
    """Whether a task panel is open."""
    return bool(FreeCADGui.Control.activeDialog())


def ours(document, kind):
    """Labels of the objects of a kind."""
    return [o.Label for o in document.Objects if getattr(o, "BT_Type", "") == kind]


def no_document():
    """Shapes imported while no document is open: read, and of a file that holds none."""
    import Part

    for name in list(FreeCAD.listDocuments()):
        FreeCAD.closeDocument(name)
    path = os.path.join(FOLDER, "nothing.step")
    with open(path, "w", encoding="ascii") as file:
        file.write("nothing")
    with asked(open_file=path):
        seen = {"bad": [run("ImportShapes"), list(FreeCAD.listDocuments())]}
    path = os.path.join(FOLDER, "dome.step")
    Part.makeSphere(20000).exportStep(path)
    start = len(recorded())
    with asked(open_file=path):
        seen["shown"] = run("ImportShapes")
    lines = [line for line in recorded()[start:] if not line.startswith(("#", "Gui."))]
    seen["labels"] = [item.Label for item in FreeCAD.listDocuments().values()]
    document = FreeCAD.ActiveDocument
    seen["steps"] = [list(document.UndoNames), len(document.Objects)]
    FreeCADGui.runCommand("Std_Undo")
    steps.settle()
    seen["undone"] = len(document.Objects)
    FreeCADGui.runCommand("Std_Redo")
    steps.settle()
    seen["redone"] = [len(o.Shape.Faces) for o in document.Objects]
    FreeCAD.closeDocument(document.Name)
    exec("\n".join(lines), {})
    seen["again"] = [len(o.Shape.Faces) for o in FreeCAD.ActiveDocument.Objects]
    FreeCAD.closeDocument(FreeCAD.ActiveDocument.Name)
    return seen


def axes():
    """Members along two axes at once; a selected axis edited."""
    document = member_document("Axes")
    select(named("A1"), named("A2"), named("B800"))
    seen = {"shown": run("Member"), "open": panel_open(), "undo": document.UndoNames}
    made = [named(mark) for mark in ours(document, "Member")[2:]]
    seen["made"] = [[m.Label, m.Axis.Label, m.Section1.Label, m.Status] for m in made]
    document.undo()
    seen["undone"] = ours(document, "Member")
    document.clearUndos()
    select(named("A1"))
    seen["axis"] = [run("Axis"), panel_open()]
    retype(field("EndExtension"), "1 m")
    press("Ok")
    seen["extended"] = [named("A1").EndExtension.Value, ours(document, "Axis"), document.UndoNames]
    document.undo()
    document.recompute()
    document.clearUndos()
    return seen


def typed_into_the_table():
    """Letters over a cell; Enter while the list of choices is open."""
    document = FreeCAD.ActiveDocument
    run("MemberTable")
    table = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable").table
    table.clearSelection()
    table.setCurrentCell(1, 6)
    kept = []
    for text in "bR4":
        event = QtGui.QKeyEvent(QtCore.QEvent.ShortcutOverride, 0, QtCore.Qt.NoModifier, text)
        event.ignore()
        QtGui.QApplication.sendEvent(table, event)
        kept.append(event.isAccepted())
    event = QtGui.QKeyEvent(
        QtCore.QEvent.ShortcutOverride, QtCore.Qt.Key_S, QtCore.Qt.ControlModifier, "\x13"
    )
    event.ignore()
    QtGui.QApplication.sendEvent(table, event)
    seen = {"kept": kept, "ctrl": event.isAccepted()}
    table.editItem(table.item(1, 6))
    editor = next(w for w in table.findChildren(QtGui.QLineEdit) if w.isVisible())
    editor.selectAll()
    for letter in "bottom":
        key(editor, 0, letter)
    steps.settle()
    popup = editor.completer().popup()
    seen["list"] = popup.isVisible()
    key(popup, QtCore.Qt.Key_Return)
    steps.settle()
    seen["aligned"] = [named("M1").Align2, document.UndoNames]
    window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable").hide()
    document.undo()
    document.recompute()
    document.clearUndos()
    return seen


def escape_in_the_view():
    """Esc in the 3D view closes a panel opened by its command as one opened by double-click."""
    document, member, seen = FreeCAD.ActiveDocument, named("M1"), {}
    for way in ("command", "double-click"):
        select(member)
        if way == "command":
            run("Member")
        else:
            member.ViewObject.Proxy.doubleClicked(member.ViewObject)
            steps.settle()
        retype(field("OffsetZ"), "50 mm")
        steps.settle(6)
        typed = member.OffsetZ.Value
        key(FreeCADGui.ActiveDocument.ActiveView.graphicsView(), QtCore.Qt.Key_Escape)
        steps.settle()
        seen[way] = [typed, panel_open(), member.OffsetZ.Value, document.UndoNames]
    return seen


def cut_where_clicked():
    """A cut at a place clicked on a plate, in the trade's tenths of a millimetre."""
    import numpy as np

    from BendTorsionWB.objects import axis

    document, member = FreeCAD.ActiveDocument, named("M1")
    at = axis.value(named("A1")).position(np.array([3000.04]))[0]
    FreeCADGui.Selection.clearSelection()
    plates = named("M1 plates")
    FreeCADGui.Selection.addSelection(document.Name, plates.Name, "Face1", *map(float, at))
    seen = {"shown": run("CutPoint")}
    press("Ok")
    seen["cut"] = [member.Segments, member.Cut2.Value, document.UndoNames]
    FreeCAD.closeDocument(document.Name)
    return seen


def node_of_a_pair():
    """Two members that have their node; two that meet at two places."""
    from BendTorsionWB import make

    document, seen = whole_document("Pair"), {}
    for pair in (("M1", "M2"), ("M2", "M1")):
        select(*map(named, pair))
        shown = run("Node")
        said = window().statusBar().currentMessage()
        open_ = [panel_open(), field("Node").text() if panel_open() else ""]
        press("Cancel")
        seen[" ".join(pair)] = [shown, *open_, said, ours(document, "Node")]
    seen["undo"] = document.UndoNames
    points = [(500, -3000, 0), (2500, 1500, 0), (6000, 1500, 0), (8500, -3000, 0)]
    wave = make.make_axis(document, "wave", named("Ground"), points)
    make.make_member(document, "M3", wave, [named("B")])
    document.recompute()
    document.clearUndos()
    places = []
    for _ in range(2):
        select(named("M1"), named("M3"))
        run("Node")
        press("Ok")
        node = named(ours(document, "Node")[-1])
        places.append([node.Status, node.PlaceThrough.Value])
    seen["two"] = [places, document.UndoNames]
    select(named("M1"), named("M3"))
    seen["third"] = [run("Node"), panel_open(), ours(document, "Node")]
    return seen


def context_of_sheets():
    """What the context menu offers for sheets, a page of them and an axis, for one and for several;
    what Sheets opens."""
    from BendTorsionWB.gui import commands

    document = FreeCAD.ActiveDocument
    page = next(o for o in document.Objects if o.isDerivedFrom("TechDraw::DrawPage"))
    found = {}
    chosen = {label: [named(label)] for label in ("M1 sheets", "M1-axis", "M1 plates", "M1")}
    chosen |= {"page": [page], "two": [named("M1"), named("M2")], "node": [named("N1")]}
    chosen |= {"three": [*chosen["two"], named("N1")], "plates": [named("M1 plates"), named("M2")]}
    chosen |= {"axes": [named("M1-axis"), named("M2-axis")]}
    for name, items in chosen.items():
        select(*items)
        found[name] = [name.removeprefix("BendTorsion_") for name in commands.suited()]
    for name in ("M1 sheets", "page"):
        select(*chosen[name])
        found[f"open {name}"] = [run("Sheets"), panel_open()]
        press("Cancel")
    FreeCAD.closeDocument("Pair")
    return found


def in_error():
    """Files written of a document with a member in error; a cut in it."""
    from BendTorsionWB.gui import ask

    document = whole_document("InError")
    named("B").Thickness = 400
    document.recompute()
    before, told = ask.warn, []
    ask.warn = told.append
    seen = {}
    with asked(folder=os.path.join(FOLDER, "package")):
        seen["package"] = run("ExportPackage")
    with asked(save_file=os.path.join(FOLDER, "figures.json")):
        seen["report"] = run("Report")
    ask.warn = before
    seen["told"] = told
    seen["cut files"] = os.path.exists(os.path.join(FOLDER, "package", "plates"))
    FreeCADGui.Selection.clearSelection()
    select(named("M1"))
    seen["cut"] = run("CutPoint")
    FreeCAD.closeDocument(document.Name)
    return seen


def sources():
    """A member along a hidden curve far from the face; the curve is deleted and comes back."""
    import Part

    document = FreeCAD.newDocument("Sources")
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 20000
    line = document.addObject("Part::Feature", "Line")
    line.Shape = Part.makeLine(FreeCAD.Vector(-4000, 0, 20030), FreeCAD.Vector(4000, 0, 20030))
    document.recompute()
    ball.ViewObject.Visibility = line.ViewObject.Visibility = False
    select((ball, "Face1"), line)
    answered(lambda dialog: dialog.accept())
    seen = {"shown": run("MembersFromSelection")}
    seen["said"] = window().statusBar().currentMessage()
    seen["status"] = named("M1 plates").Status
    document.openTransaction("Delete")
    document.removeObject("Line")
    document.commitTransaction()
    document.recompute()
    seen["deleted"] = [named("M1-axis").Status, named("M1 plates").Status]
    seen["empty"] = not named("M1 plates").Shape.Solids
    document.undo()
    document.recompute()
    seen["back"] = named("M1 plates").Status
    select((ball, "Face1"), line)
    answered(lambda dialog: dialog.accept())
    run("MembersFromSelection")
    seen["surfaces"] = ours(document, "Surface")
    return seen


def surface_used_again():
    """Members, a surface and an axis on a face that has its Surface; on the whole shape, and on
    one that is offset. A new one with nothing selected."""
    document, ball, line = FreeCAD.ActiveDocument, named("Ball"), named("Line")
    seen = {"members": [named(mark).Axis.Surface.Label for mark in ("M1", "M2")]}
    document.clearUndos()
    for name, face in (("face", (ball, "Face1")), ("shape", ball)):
        select(face)
        shown = run("Surface")
        said = window().statusBar().currentMessage()
        retype(field("Offset"), "5 mm")
        press("Ok" if name == "face" else "Cancel")
        seen[name] = [shown, said, named("Surface").Offset.Value, ours(document, "Surface")]
        if name == "face":
            document.undo()
            document.recompute()
            document.clearUndos()
    select((ball, "Face1"), line)
    run("Axis")
    press("Ok")
    seen["axis"] = [named("Axis").Surface.Label, ours(document, "Surface"), document.UndoNames]
    named("Surface").Offset = 100
    document.recompute()
    select((ball, "Face1"), line)
    run("Axis")
    press("Ok")
    seen["offset"] = [named("Axis 2").Surface.Label, ours(document, "Surface")]
    select()
    run("Surface")
    press("Ok")
    seen["new"] = ours(document, "Surface")
    return seen


def tree_nodes():
    """What is taken where a part, a group or a compound is picked in the tree: with some of what
    it holds, alone, and of a group that holds nothing; members of a part that was moved."""
    import Part

    from BendTorsionWB.core.finding import BendTorsionError
    from BendTorsionWB.gui import ask, selection

    document = FreeCAD.newDocument("Nodes")
    roof = document.addObject("App::Part", "roof")
    lines = [
        Part.makeLine(FreeCAD.Vector(-4000, y, 20030), FreeCAD.Vector(4000, y, 20030))
        for y in (0, 900)
    ]
    shapes = {"Ball": Part.makeSphere(20000), "L1": lines[0], "L2": lines[1]}
    for name, shape in shapes.items():
        document.addObject("Part::Feature", name).Shape = shape
        roof.addObject(document.getObject(name))
    whole = document.addObject("Part::Feature", "whole")
    whole.Shape = Part.Compound(list(shapes.values()))
    pair = document.addObject("Part::Compound", "pair")
    pair.Links = [named("L1"), named("L2")]
    empty = document.addObject("App::DocumentObjectGroup", "empty")
    document.recompute()
    steps.settle()

    def taken(*items):
        select(*items)
        try:
            (obj, name), curves = selection.surface_and_curves(selection.picked())
        except BendTorsionError as problem:
            return str(problem)
        return [obj.Label, name, [[one.Label, edges] for one, edges in curves]]

    face, line = (roof, "Ball.Face1"), (roof, "L1.Edge1")
    seen = {
        "with parts": taken(roof, face, line),
        "after parts": taken(face, line, roof),
        "alone": taken(roof),
        "compound": taken(whole),
        "compound and its line": taken(face, pair, line),
        "and nothing": taken(empty, face, line),
        "no curve": taken(empty, face),
        "two faces": taken(face, whole),
    }
    roof.Placement.Base = FreeCAD.Vector(1000, 0, 0)
    document.recompute()
    select(roof, empty)
    answered(lambda dialog: dialog.accept())
    # FreeCAD warns in the status bar of links out of a part.
    said, tell = [], ask.tell
    ask.tell = said.append
    seen["shown"] = run("MembersFromSelection")
    ask.tell = tell
    seen["said"] = " ".join(said)
    seen["made"] = [[mark, named(mark).Status] for mark in ours(document, "Member")]
    box = named("M1-axis").Shape.BoundBox
    seen["x"] = [box.XMin, box.XMax]
    FreeCAD.closeDocument(document.Name)
    return seen


steps.run(
    no_document,
    axes,
    typed_into_the_table,
    escape_in_the_view,
    cut_where_clicked,
    node_of_a_pair,
    context_of_sheets,
    in_error,
    sources,
    surface_used_again,
    tree_nodes,
)
