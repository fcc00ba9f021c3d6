# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window, dark, of a laptop's size and in Chinese: where things stand in
panels, what the tree and the 3D view show of members."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import panel_text, part_tables, whole_document
from hands import answered, field, form, named, press, retype, run, select, window


def laptop():
    """The window 1280 × 800, a document with all kinds of objects."""
    window().setGeometry(0, 0, 1280, 800)
    whole_document("Layout")
    steps.settle()
    return [window().width(), window().height()]


def first_panel():
    """What OK and Cancel say when FreeCAD tells of a language anew, as when it loads a part of
    itself; in a panel and in the dialogs of the workbench."""
    from BendTorsionWB.gui import ask

    edit("Ground")
    QtGui.QApplication.postEvent(window(), QtCore.QEvent(QtCore.QEvent.LanguageChange))
    steps.settle()
    boxes = [box for box in window().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    seen = {"panel": [button.text() for button in boxes[0].buttons()]}
    press("Cancel")

    def look(dialog, name):
        box = dialog.findChild(QtGui.QDialogButtonBox)
        seen[name] = [button.text() for button in box.buttons()]
        dialog.reject()

    answered(lambda dialog: look(dialog, "choice"))
    seen["chosen"] = ask.choice("A", "B", ["one", "two"])
    answered(lambda dialog: (dialog.setTextValue("two"), dialog.accept()))
    seen["chosen two"] = ask.choice("A", "B", ["one", "two"])
    answered(lambda dialog: look(dialog, "warning"))
    ask.warn("one")
    return seen


def edit(label):
    """Open the panel of an object."""
    obj = named(label)
    obj.ViewObject.Proxy.doubleClicked(obj.ViewObject)
    steps.settle(4)


def rows():
    """(name, top, bottom) of the fields that are seen, from above, in the window."""
    kinds = (QtGui.QComboBox, QtGui.QAbstractSpinBox, QtGui.QCheckBox, QtGui.QLineEdit)
    found = {}
    for kind in kinds:
        for item in form().findChildren(kind):
            if item.isVisible() and item.objectName() and "qt_" not in item.objectName():
                top = item.mapTo(window(), QtCore.QPoint(0, 0)).y()
                found[item.objectName()] = [top, top + item.height()]
    return sorted([name, *place] for name, place in found.items())


def many_findings():
    """The fields of a surface before an edit that all axes on it complain of, and after; the box
    with what is found, folded too."""
    edit("Ground")
    seen = {"before": rows(), "text before": panel_text()}
    retype(field("Offset"), "30 mm")
    steps.settle(10)
    seen["after"], seen["text"] = rows(), panel_text()
    area = field("findings", QtGui.QLabel).parentWidget().parentWidget()
    seen["heights"] = [field("findings", QtGui.QLabel).height(), area.height()]
    seen["scrolls"] = area.verticalScrollBar().maximum()
    heading = field("findings heading", QtGui.QToolButton)
    seen["heading"] = heading.text()
    steps.picture("many_findings")
    heading.click()
    steps.settle(2)
    seen["folded"] = [area.isVisible(), heading.isVisible(), rows() == seen["after"]]
    steps.picture("findings_folded")
    heading.click()
    steps.settle(2)
    seen["unfolded"] = area.isVisible()
    press("Cancel")
    return seen


def error_in_view():
    """A panel a little higher than its place: how much is seen of an error and of the field it is
    made in, one at the top and one further down. A panel much higher: what stands at the field."""
    # A dialog had it, and no window manager gives it back.
    keys.active(window())
    edit("M1")
    told, area = field("findings", QtGui.QLabel), panel_area()
    # FreeCAD 1.0 draws lower fields in the dark, 1.1 leaves less of the window to a panel.
    hide_of_panel(area, 20, 70)
    seen = {"hidden": area.verticalScrollBar().maximum()}
    for name in ("OffsetY", "OffsetZ1"):
        area.verticalScrollBar().setValue(0)
        retype(field(name), "abc")
        steps.settle(6)
        shown = [told.visibleRegion(), field(name).visibleRegion()]
        heights = [region.boundingRect().height() for region in shown]
        seen[name] = [told.text(), *heights, told.fontMetrics().lineSpacing()]
        steps.picture(f"error_{name}")
        retype(field(name), "0 mm")
        steps.settle(6)
    hide_of_panel(area, 250, 290)
    area.verticalScrollBar().setValue(0)
    retype(field("OffsetY"), "abc")
    steps.settle(6)
    heights = [w.visibleRegion().boundingRect().height() for w in (told, field("OffsetY"))]
    tip = QtGui.QToolTip
    seen["at field"] = [area.verticalScrollBar().maximum(), tip.isVisible(), tip.text(), *heights]
    steps.picture("error_at_field")
    press("Cancel")
    window().resize(1280, 800)
    steps.settle()
    return seen


def panel_area():
    """What scrolls the panel. PySide6 lets go of its bar with it."""
    area = form()
    while not isinstance(area, QtGui.QScrollArea):
        area = area.parentWidget()
    return area


def hide_of_panel(area, least, most):
    """Make the window as high as hides so many pixels of the panel, about."""
    while area.verticalScrollBar().maximum() > most and window().height() < 1160:
        window().resize(1280, window().height() + 20)
        steps.settle(2)
    while area.verticalScrollBar().maximum() <= least and window().height() > 300:
        window().resize(1280, window().height() - 20)
        steps.settle(2)


def hidden_rows():
    """The fields of a plane, of an ellipsoid, and of the plane again."""
    edit("Ground")
    kind, seen = field("Kind", QtGui.QComboBox), {}
    for name, choice in (("plane", "plane"), ("dome", "ellipsoid"), ("again", "plane")):
        kind.setCurrentIndex(kind.findData(choice))
        steps.settle(10)
        seen[name] = sorted(rows(), key=lambda row: row[1])
        steps.picture(f"rows_{name}")
    press("Cancel")
    return seen


def tables_of_parts():
    """By table: how far it can be scrolled sideways, and whether it has the keyboard."""
    seen = {}
    for name, rows in part_tables():
        seen[name] = [rows.columnCount(), rows.horizontalScrollBar().maximum(), rows.hasFocus()]
        steps.picture(f"table_{name}")
    return seen


def width_given_back():
    """How wide panels are: one with few fields, a table, and the former again."""
    seen = []
    for opened in (lambda: edit("Ground"), lambda: run("Pieces"), lambda: edit("Ground")):
        select(named("M1"))
        opened()
        seen.append(form().width())
        press("Cancel")
        steps.settle(8)
    return seen


def split_names():
    """Lightness of the ground in the split editor and of the names of faces on it."""
    select(named("M1"))
    run("Splits")
    steps.picture("splits")
    view = window().findChildren(QtGui.QGraphicsView)[-1]
    ground = view.viewport().grab().toImage().pixelColor(2, 2).lightness()
    items = view.scene().items()
    texts = [item for item in items if isinstance(item, QtGui.QGraphicsSimpleTextItem)]
    shown = {item.text(): item.brush().color().lightness() for item in texts}
    press("Cancel")
    return {"ground": ground, "names": {name: shown[name] for name in ("上", "下", "左", "右")}}


def members_in_tree():
    """Whether the tree greys a member, and what is shown of it: hidden and shown by Space, by its
    plates, as skin and as plates again."""
    from BendTorsionWB.gui import member_display

    member, plates = named("M1"), named("M1 plates")
    seen = {}

    def note(name):
        steps.settle()
        tree = steps.document_tree()
        (item,) = tree.findItems("M1", QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive)
        grey = item.foreground(0).style() != QtCore.Qt.NoBrush
        shown = [steps.drawn(one) for one in (member, plates)]
        agreed = [one.ViewObject.Visibility for one in (member, plates)] == shown
        seen[name] = [grey, *shown, agreed]

    def space():
        select(member)
        FreeCADGui.runCommand("Std_ToggleVisibility")

    note("plates")
    steps.picture("tree")
    space()
    note("hidden")
    space()
    note("shown")
    plates.ViewObject.Visibility = False
    note("plates hidden")
    plates.ViewObject.Visibility = True
    note("plates shown")
    member_display.show_as([member], "skin")
    note("skin")
    space()
    note("skin hidden")
    member_display.show_as([member], "axis")
    note("axis")
    member_display.show_as([member], "plates")
    note("plates again")
    FreeCADGui.Selection.clearSelection()
    return seen


def new_plates():
    """Plates made for a member that is hidden are seen."""
    from BendTorsionWB import make

    document = FreeCAD.ActiveDocument
    axis = make.make_axis(document, "A3", named("Ground"), [(0, 8000, 0), (5000, 8000, 0)])
    member = make.make_member(document, "M3", axis, [named("B")])
    document.recompute()
    steps.settle()
    member.ViewObject.Visibility = False
    steps.settle()
    plates = make.make_plates(document, member)
    member.ViewObject.Visibility = False
    document.recompute()
    steps.settle()
    return [steps.drawn(member), steps.drawn(plates)]


def plates_redone():
    """[skin shown, plates shown] of a hidden member whose plates are made, undone and redone."""
    document, member = FreeCAD.ActiveDocument, named("M3")
    document.removeObject(named("M3 plates").Name)
    document.recompute()
    document.clearUndos()
    select(member)
    run("Plates")
    press("Ok")
    seen = []
    for act in (lambda: None, lambda: (document.undo(), steps.settle(), document.redo())):
        act()
        steps.settle()
        seen.append([steps.drawn(member), steps.drawn(named("M3 plates"))])
    FreeCADGui.Selection.clearSelection()
    return seen


def crowded_marks():
    """Marks of a member whose plates meet at an edge, seen whole: those turned to the eye, and the
    boxes of those that are shown."""
    import numpy as np
    from pivy import coin

    from BendTorsionWB.gui.label_layer import CORNERS

    plates = named("M1 plates")
    plates.ViewObject.ShowMarks = True
    view = FreeCADGui.ActiveDocument.ActiveView
    view.viewIsometric()
    select(named("M1 plates"))
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    FreeCADGui.Selection.clearSelection()
    steps.settle()
    view.redraw()
    steps.picture("marks")
    layer = plates.ViewObject.Proxy.labels
    eye = np.array(view.getViewDirection())
    turned = [one.text for one in layer.labels if one.normal @ eye < -0.05]
    boxes = {}
    for label, corner in zip(layer.labels, layer.shown.tolist()):
        if corner >= 0:
            box = np.array(label.pixels)
            low = np.array(view.getPointOnScreen(*label.place)) - CORNERS[corner] * box
            boxes[label.text] = [*low.tolist(), *(low + box).tolist()]
    search = coin.SoSearchAction()
    search.setType(coin.SoType.fromName("SoFrameLabel"))
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(plates.ViewObject.RootNode)
    drawn = {}
    for path in search.getPaths():
        read = {
            name: path.getTail().getField(name).get().getString().strip('"')
            for name in ("string", "horAlignment", "vertAlignment")
        }
        drawn[read["string"]] = [read["horAlignment"], read["vertAlignment"]]
    corners = {one.text: corner for one, corner in zip(layer.labels, layer.shown.tolist())}
    plates.ViewObject.ShowMarks = False
    return {"turned": turned, "boxes": boxes, "drawn": drawn, "corners": corners}


def small_on_huge():
    """Members of a few metres made on a ball of 400 m: how much of the view they fill, and the way
    it looks, before and after."""
    import Part

    document = FreeCAD.newDocument("Huge")
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 200000
    arc = Part.makeCircle(200000, FreeCAD.Vector(), FreeCAD.Vector(0, 10, 30), 10, 12)
    curve = document.addObject("Part::Feature", "Curve")
    curve.Shape = arc
    document.recompute()
    view = FreeCADGui.ActiveDocument.ActiveView
    view.viewFront()
    steps.still(view)
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.still(view)
    before = [view.getCameraNode().height.getValue(), list(view.getViewDirection())]
    select((ball, "Face1"), (curve, "Edge1"))
    answered(lambda dialog: dialog.accept())
    shown = run("MembersFromSelection")
    steps.still(view)
    steps.picture("small_on_huge")
    box = named("M1 plates").Shape.BoundBox
    spot = view.getPointOnScreen(box.Center.x, box.Center.y, box.Center.z)
    after = [view.getCameraNode().height.getValue(), list(view.getViewDirection())]
    seen = {
        "shown": shown,
        "before": before,
        "after": after,
        "length": box.DiagonalLength,
        "spot": [*spot],
        "size": [*view.getSize()],
        "selected": len(FreeCADGui.Selection.getSelection()),
    }
    FreeCAD.closeDocument(document.Name)
    return seen


steps.run(
    laptop,
    first_panel,
    many_findings,
    error_in_view,
    hidden_rows,
    tables_of_parts,
    width_given_back,
    split_names,
    members_in_tree,
    new_plates,
    plates_redone,
    crowded_marks,
    small_on_huge,
)
