# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: cuts, alignments and links picked with the mouse in the view."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import mouse
import steps
from commands_aids import member_document
from hands import field, key, named, press, run, select, window
from mouse import place


def texts():
    """Every text beside the cuts in the view."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoType.fromName("SoFrameLabel"))
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(FreeCADGui.ActiveDocument.ActiveView.getSceneGraph())
    found = []
    for path in search.getPaths():
        found.append(path.getTail().getField("string").get().getString().strip('"'))
    return [text for text in found if text.startswith("Cut ")]


def drag_cut():
    """A cut taken with the mouse, moved, shown on the way; kept with OK in one undo step."""
    document = member_document("Drag")
    member, axis, plates = named("M1"), named("A1"), named("M1 plates")
    named("Hall").ViewObject.Visibility = False
    select(plates)
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    steps.settle()
    select(member)
    run("Member")
    result = {"texts": texts(), "cuts": [member.Cut2.Value], "volumes": [plates.Volume.Value]}
    start, end = (mouse.pixel_of(place(axis, s)) for s in (5000.0, 7000.0))
    FreeCADGui.Selection.clearSelection()
    mouse.press(start)
    mouse.move(start, end)
    steps.settle(4)
    result["on_the_way"] = [texts(), member.Cut2.Value, plates.Volume.Value]
    result["field"] = field("Cut2").property("rawValue")
    steps.picture("cut_dragged")
    mouse.release(end)
    result["cuts"].append(member.Cut2.Value)
    result["shown"] = field("segments", QtGui.QComboBox).currentIndex() + 1
    result["selected"] = [item.Label for item in FreeCADGui.Selection.getSelection()]
    third = mouse.pixel_of(place(axis, member.Cut3.Value))
    mouse.press(third)
    mouse.move(third, mouse.pixel_of(place(axis, 13500.0)))
    result["third"] = [member.Cut3.Value]
    key(mouse.view_widget().parent(), QtCore.Qt.Key_Escape)
    steps.settle()
    result["third"].append(member.Cut3.Value)
    result["still_open"] = bool(FreeCADGui.Control.activeDialog())
    mouse.release(third)
    press("Ok")
    result["after"] = [texts(), member.Cut2.Value, member.Cut3.Value, document.UndoNames]
    document.undo()
    document.recompute()
    result["undone"] = member.Cut2.Value
    return result


def drag_nothing():
    """Beside a cut the mouse is FreeCAD's; Cancel takes a drag back."""
    member, axis = named("M1"), named("A1")
    select(member)
    run("Member")
    far = mouse.pixel_of(place(axis, 2500.0))
    mouse.press(far)
    held = FreeCADGui.ActiveDocument.ActiveView
    mouse.release(far)
    result = {"cut": [member.Cut2.Value], "view": str(held)}
    mouse.drag(*(mouse.pixel_of(place(axis, s)) for s in (5000.0, 6000.0)))
    result["cut"].append(member.Cut2.Value)
    press("Cancel")
    result["cut"].append(member.Cut2.Value)
    result["texts"] = texts()
    return result


def align_on_the_member():
    """Clicks on the faces of a member choose its position."""
    member, axis = named("M1"), named("A1")
    view = FreeCADGui.ActiveDocument.ActiveView
    select(member)
    run("Alignment")
    steps.picture("alignment_in_view")
    result = {}
    view.viewTop()
    steps.settle(15)
    mouse.click(mouse.pixel_of(place(axis, 3000.0)))
    result["top"] = [member.Align1, field("alignment").value]
    box = member.Section1
    y = 0.45 * box.Breadth.Value
    at = place(axis, 3000.0)
    result["left"] = []
    side = FreeCAD.Vector(0, 1, 0) * y + FreeCAD.Vector(*map(float, at))
    mouse.click(mouse.pixel_of(side))
    result["left"] = [member.Align1, field("alignment").value]
    press("Cancel")
    result["back"] = member.Align1
    return result


def link_picked():
    """The axis of a member is picked in the tree after its button was pressed, and not before."""
    member = named("M1")
    select(member)
    run("Member")
    other = named("A2")
    select(other)
    steps.settle()
    result = {"axes": [member.Axis.Label]}
    field("pick Axis").click()
    select(other)
    steps.settle(6)
    result["axes"].append(member.Axis.Label)
    result["pressed"] = field("pick Axis").isChecked()
    steps.picture("link_picked")
    press("Cancel")
    result["axes"].append(member.Axis.Label)
    return result


def view_closed():
    """The document of an open panel with cuts in the view is closed."""
    select(named("M1"))
    run("Member")
    FreeCAD.closeDocument("Drag")
    steps.settle(10)
    window().update()
    return {"open": bool(FreeCADGui.Control.activeDialog())}


def large_section():
    """Cut point at a click on the edge of a section of 2.5 m, which is far from its axis."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument("Large")
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (9000, 0, 0)])
    section = make.make_section(document, "B", h=2500, b=2500, t=20)
    member = make.make_member(document, "M1", axis, [section])
    plates = make.make_plates(document, member)
    document.recompute()
    corner = max((v.Point for v in plates.Shape.Vertexes), key=lambda p: p.y + p.z - abs(p.x))
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection("Large", plates.Name, "Edge1", 4000.0, corner.y, corner.z)
    shown = run("CutPoint")
    is_open = bool(FreeCADGui.Control.activeDialog())
    press("Ok") if is_open else None
    return {
        "shown": shown,
        "off": [corner.y, corner.z],
        "cuts": [member.Segments, member.Cut2.Value],
    }


steps.run(drag_cut, drag_nothing, align_on_the_member, link_picked, view_closed, large_section)
