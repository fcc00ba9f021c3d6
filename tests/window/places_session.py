# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: places of joints and cuts by real keys, dragged, in error."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import member_document, ok_enabled, panel_text, whole_document
from hands import field, named, press, retype, run, select, window

LEFT, NONE = QtCore.Qt.LeftButton, QtCore.Qt.NoButton


def first_joints():
    """A member without joints: Ins at once, another face by Down, Ins there."""
    whole_document("Places")
    plates = named("M2 plates")
    select(plates)
    run("Splits")
    keys.active(window())
    seen = {"keyboard": QtGui.QApplication.focusWidget() is _strips()}
    keys.strike("Insert", pause=8)
    seen["first"] = _joints(plates)
    keys.strike("Down")
    seen["told"] = [_which(), field("place").isEnabled()]
    keys.strike("Right", "Delete", "Insert", pause=8)
    seen["second"] = _joints(plates)
    press("Ok")
    seen["undo"] = FreeCAD.ActiveDocument.UndoNames
    FreeCAD.ActiveDocument.undo()
    FreeCAD.ActiveDocument.recompute()
    FreeCAD.ActiveDocument.clearUndos()
    return seen


def letters():
    """Digits begin the place of the joint chosen; space and letters go nowhere."""
    plates = named("M1 plates")
    select(plates)
    run("Splits")
    keys.active(window())
    camera = FreeCADGui.ActiveDocument.ActiveView.getCameraOrientation().Q
    keys.strike("2", "space", "v", "f", pause=3)
    same = FreeCADGui.ActiveDocument.ActiveView.getCameraOrientation().Q == camera
    seen = {"unchosen": [same, plates.ViewObject.Visibility, list(plates.JointsTop)]}
    keys.strike("Down", "space", pause=3)
    keys.write("2750")
    steps.settle(8)
    same = FreeCADGui.ActiveDocument.ActiveView.getCameraOrientation().Q == camera
    seen["chosen"] = [same, plates.ViewObject.Visibility, list(plates.JointsTop)]
    tips = []
    for text in ("8 m", "20 m"):
        retype(field("place"), text)
        tips.append(field("place").toolTip())
    seen["refused"] = [tips, ok_enabled(), list(plates.JointsTop)]
    press("Cancel")
    seen["cancelled"] = list(plates.JointsTop)
    return seen


def dragged():
    """A joint dragged with pauses longer than any preview waits; keys right after each other."""
    plates = named("M1 plates")
    select(plates)
    run("Splits")
    view = _strips()
    joint = next(i for i in _drawn(view) if (i.face, i.k) == ("top", 1))
    panel, face, k = joint.panel, joint.face, joint.k
    start = view.mapFromScene(joint.line().center())
    keys.active(window())
    view.setFocus()
    _mouse(view, QtCore.QEvent.MouseButtonPress, start, LEFT, LEFT)
    _mouse(view, QtCore.QEvent.MouseMove, start - QtCore.QPoint(30, 0), NONE, LEFT)
    seen = {"escaped": [panel.joints[face][k] < 6000.0]}
    keys.strike("Escape")
    for kind, button in ((QtCore.QEvent.MouseMove, NONE), (QtCore.QEvent.MouseButtonRelease, LEFT)):
        _mouse(view, kind, start - QtCore.QPoint(50, 0), button, LEFT if button == NONE else NONE)
    steps.settle(10)
    seen["escaped"] += [panel.joints[face][k], bool(FreeCADGui.Control.activeDialog())]
    seen["places"] = [panel.joints[face][k]]
    _mouse(view, QtCore.QEvent.MouseButtonPress, start, LEFT, LEFT)
    for pixels in (-20, -40, -60):
        at = start + QtCore.QPoint(pixels, 0)
        _mouse(view, QtCore.QEvent.MouseMove, at, NONE, LEFT)
        steps.settle(10)
        seen["places"].append(panel.joints[face][k])
    _mouse(view, QtCore.QEvent.MouseButtonRelease, at, LEFT, NONE)
    shown = len(plates.Marks), plates.Shape.hashCode()
    steps.settle(10)
    seen["shown"] = plates.Shape.hashCode() != shown[1] and len(plates.Marks) == shown[0]
    seen["drawn"] = [list(plates.JointsTop), len({i.k for i in _drawn(view) if i.face == "top"})]
    keys.active(window())
    view.setFocus()
    keys.strike("Delete", "Down", "Right", pause=1)
    steps.settle(8)
    seen["removed"] = list(plates.JointsTop)
    press("Cancel")
    FreeCAD.closeDocument("Places")
    return seen


def _straight(name, length, thicknesses, segments, joints):
    """The plates of a straight member, in a document of their own with the editor open."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument(name)
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A", ground, ((0, 0, 0), (length, 0, 0)))
    used = [make.make_section(document, f"B{t}", h=600, b=600, t=t) for t in thicknesses]
    member = make.make_member(document, "M1", axis, used, segments)
    plates = make.make_plates(document, member, joints)
    document.recompute()
    select(plates)
    run("Splits")
    return plates


def without_joints():
    """A member longer than a plate may be, that nobody has divided but for one face."""
    _straight("Long", 13000, (16,), [{}], {"top": [6000.0]})
    seen = field("verdict", QtGui.QLabel).text().split("<br>")
    press("Cancel")
    FreeCAD.closeDocument("Long")
    return seen


def forced():
    """The joints of a face `auto` with a change of thickness, one added, all shown."""
    plates = _straight("Forced", 12000, (16, 20), [{}, {"cut": 5000}], {"top": "auto"})
    view = _strips()
    tips = [item.toolTip() for item in view.scene().items()]
    seen = {"fixed": [tip for tip in tips if "stays where it is" in tip]}
    seen["plates"] = sum("-T" in mark for mark in plates.Marks)
    seen["drawn"] = [item.face for item in _drawn(view)]
    keys.active(window())
    view.setFocus()
    keys.strike("Down", "Insert", pause=8)
    seen["added"] = [list(plates.JointsTop), sum("-T" in mark for mark in plates.Marks)]
    steps.picture("forced")
    press("Cancel")
    seen["auto"] = list(plates.AutoJoints)
    FreeCAD.closeDocument("Forced")
    return seen


def cuts():
    """A cut beyond the axis, then no cut at all; by an expression; a slope that cannot be."""
    document = member_document("Cuts")
    member = named("M1")
    select(member)
    run("Member")
    field("segments", QtGui.QComboBox).setCurrentIndex(1)
    steps.settle(4)
    seen = {}
    for text in ("abc", ""):
        retype(field("Cut2"), "60 m")
        steps.settle(8)
        beyond = [ok_enabled(), "60000" in panel_text()]
        retype(field("Cut2"), text or "1")
        if not text:
            keys.active(window())
            keys.strike("BackSpace")
        steps.settle(8)
        seen[text] = [beyond, member.Cut2.Value, "60000" in panel_text(), ok_enabled()]
    retype(field("Cut2"), "=2 * 3 m")
    steps.settle(8)
    slider = next(w for w in window().findChildren(QtGui.QSlider) if w.isVisible())
    seen["bound"] = [member.Cut2.Value, slider.value(), 6e6 / member.Axis.Length.Value]
    retype(field("Slope2"), "-1")
    seen["slope"] = panel_text()
    press("Cancel")
    seen["cancelled"] = [member.Cut2.Value, member.Slope2]
    select(member)
    run("CutPoint")
    segments = field("segments", QtGui.QComboBox)
    k = segments.currentIndex() + 1
    section = field(f"Section{k}", QtGui.QComboBox)
    seen["before"] = segments.currentText()
    # None is the first.
    section.setCurrentIndex(
        1 if section.currentIndex() == section.count() - 1 else section.count() - 1
    )
    steps.settle(8)
    seen["listed"] = [segments.currentText(), section.currentText(), member.Segments, k]
    press("Cancel")
    FreeCAD.closeDocument(document.Name)
    return seen


def _strips():
    return next(v for v in window().findChildren(QtGui.QGraphicsView) if v.minimumWidth() >= 500)


def _drawn(view):
    from BendTorsionWB.gui.split_scene import JointItem

    return [item for item in view.scene().items() if isinstance(item, JointItem)]


def _which():
    return next(
        text
        for text in (label.text() for label in window().findChildren(QtGui.QLabel))
        if "no joint" in text
    )


def _joints(plates):
    faces = ("Top", "Bottom", "Left", "Right")
    return {face: list(getattr(plates, f"Joints{face}")) for face in faces}


def _mouse(view, kind, at, button, held):
    """One mouse event in the strips."""
    widget = view.viewport()
    screen = QtCore.QPointF(widget.mapToGlobal(at))
    event = QtGui.QMouseEvent(kind, QtCore.QPointF(at), screen, button, held, QtCore.Qt.NoModifier)
    QtGui.QApplication.sendEvent(widget, event)
    QtGui.QApplication.processEvents()


steps.run(first_joints, letters, dragged, without_joints, forced, cuts)
