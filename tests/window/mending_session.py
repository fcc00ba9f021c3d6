# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: values that cannot be, typed by real keys, and mended."""

import os
import sys

import FreeCAD
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import long_members, ok_enabled, panel_text, recorded
from fields import open_section, panel_open, text_of, to
from hands import answered, field, named, press, run, select, window


def nothing_shown():
    """By text typed at a hand's speed, with a pause in it: what the model has then."""
    long_members("Mended")
    section, seen = named("B"), {"mass": round(named("M1 plates").Mass, 6)}
    for text in (
        "50 cm 600.00 mm",
        "--5",
        "1,200",
        "1 km",
        "0.05",
        "700 mm + ",
        "= 5 kg",
        "= 1 km",
        "650 mm bf",
    ):
        open_section()
        # The beginning of it is a value, and is seen.
        keys.type_beside(0.1, text[:5])
        steps.settle(8)
        keys.type_beside(0.05, text[5:])
        steps.settle(10)
        height = field("Height")
        seen[text] = [text_of("Height"), section.Height.Value, list(section.ExpressionEngine)]
        seen[text] += [round(named("M1 plates").Mass, 6), ok_enabled(), height.toolTip()]
        seen[text].append(panel_text())
        press("Cancel")
    return seen


def several():
    """The offset of three members in one panel: typed, refused, mended, cancelled."""
    members = [named(f"M{k}") for k in (1, 2, 3)]
    members[1].OffsetY = 5.0
    FreeCAD.ActiveDocument.recompute()

    def offsets():
        return [member.OffsetY.Value for member in members]

    select(*members)
    run("Alignment")
    keys.active(window())
    to("OffsetY")
    keys.type_beside(0.05, "30")
    seen = {"typed": offsets()}
    keys.type_beside(0.05, " kg")
    seen["refused"] = offsets()
    keys.type_beside(0.05, "@BackSpace", "@BackSpace", "mm")
    seen["mended"] = offsets()
    press("Cancel")
    seen["cancelled"] = offsets()
    members[1].OffsetY = 0.0
    FreeCAD.ActiveDocument.recompute()
    FreeCAD.ActiveDocument.clearUndos()
    return seen


def mended():
    """Enter right after a value that can be, typed over one that cannot."""
    from BendTorsionWB.gui import task_panel

    document, section = FreeCAD.ActiveDocument, named("B")

    def over(name, bad, good):
        open_section()
        to(name)
        keys.type_beside(0.05, bad)
        steps.settle(10)
        before = ok_enabled()
        keys.type_beside(0.05, "@Control_L+a", good, "@Return")
        steps.settle(10)
        found = [
            panel_open(),
            getattr(section, name).Value,
            *([ok_enabled()] if panel_open() else []),
        ]
        if panel_open():
            press("Cancel")
        else:
            document.undo()
            document.recompute()
        return before, found

    seen = {}
    for key, given in (
        ("text", ("Height", "bf", "700")),
        ("size", ("Thickness", "400", "20")),
        ("still", ("Thickness", "400", "390")),
    ):
        before, seen[key] = over(*given)
        assert not before, key
    heavy = task_panel.HEAVY
    open_section()
    to("Thickness")
    keys.type_beside(0.05, "400")
    steps.settle(10)
    task_panel.HEAVY = -1.0
    try:
        keys.type_beside(0.05, "@Control_L+a", "24", "@Return")
        steps.settle(15)
        seen["heavy"] = [panel_open(), section.Thickness.Value]
    finally:
        task_panel.HEAVY = heavy
    if panel_open():
        press("Cancel")
    else:
        document.undo()
        document.recompute()
    return seen


def arrows():
    """Where the arrows and the text of a field are: as it is, in error, waiting to be shown."""
    from BendTorsionWB.gui import task_panel

    def places():
        spin = field("Height")
        option = QtGui.QStyleOptionSpinBox()
        spin.initStyleOption(option)
        parts = (QtGui.QStyle.SC_SpinBoxUp, QtGui.QStyle.SC_SpinBoxDown)
        parts += (QtGui.QStyle.SC_SpinBoxEditField,)
        kind = QtGui.QStyle.CC_SpinBox
        found = [spin.style().subControlRect(kind, option, part, spin) for part in parts]
        shown = spin.grab().toImage()
        pixels = [
            shown.pixelColor(x, y).name()
            for x in range(shown.width())
            for y in range(shown.height())
        ]
        colours.append([pixels.count(name) > 50 for name in ("#c62828", "#b26a00")])
        return [[one.x(), one.y(), one.width(), one.height()] for one in found]

    colours, heavy = [], task_panel.HEAVY
    open_section()
    seen = {"plain": places()}
    keys.type_beside(0.05, "bf")
    steps.settle(4)
    seen["flawed"] = places()
    steps.picture("field_flawed")
    task_panel.HEAVY = -1.0
    try:
        keys.type_beside(0.05, "@Control_L+a", "700")
        steps.settle(4)
        seen["unshown"] = places()
        steps.picture("field_unshown")
    finally:
        task_panel.HEAVY = heavy
    press("Cancel")
    seen["widths"] = [place[2] for place in seen["plain"]]
    seen["colours"] = colours
    return seen


def bound_in_dialog():
    """Members from a selection whose height follows the radius of the ball they lie on."""
    import Part

    former = FreeCAD.ActiveDocument.Name
    document = FreeCAD.newDocument("Bound")
    document.UndoMode = 1
    ball = document.addObject("Part::Sphere", "Ball")
    ball.Radius = 20000
    arc = document.addObject("Part::Feature", "Arc")
    arc.Shape = Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, 10, 30), 10, 50)
    document.recompute()
    document.clearUndos()
    select((ball, "Face1"), (arc, "Edge1"))
    seen, start = {}, len(recorded())

    def answer(dialog):
        keys.active(dialog)
        ok = dialog.buttons.button(QtGui.QDialogButtonBox.Ok)
        keys.strike("Control_L+a", pause=1)
        keys.write("= 5 kg")
        steps.settle(3)
        seen["refused"] = [ok.isEnabled(), "border" in dialog.fields["h"].styleSheet()]
        seen["told"] = dialog.words.text()
        seen["alone"] = {}
        for text in ("= Radius / 50", "= Placement.Base.z + 5 m", "= .Radius / 50", "= Height / 2"):
            field_ = dialog.fields["h"]
            field_.lineEdit().setText(text)
            seen["alone"][text] = [ok.isEnabled(), "border" in field_.styleSheet()]
            seen["alone"][text].append(dialog.words.text())
        for text in ("= 2 * <<Ball>>.Radius / 50", "= Ball.Radius / (20 * pi) + 5 cm + 1e1 mm"):
            dialog.fields["h"].lineEdit().setText(text)
            seen["alone"][text] = [ok.isEnabled()]
        keys.strike("Control_L+a", pause=1)
        keys.write("= 2 * Ball.Radius / 50")
        choice = dialog.choice()
        seen["taken"] = [ok.isEnabled(), [list(pair) for pair in choice.bound], choice.h]
        seen["value"] = dialog.words.text()
        keys.strike("Return", pause=1)

    answered(answer)
    run("MembersFromSelection", 20)
    section = next(o for o in document.Objects if getattr(o, "BT_Type", "") == "SectionSpec")
    seen["made"] = [section.Height.Value]
    seen["made"].append([path.lstrip(".") for path, _ in section.ExpressionEngine])
    seen["lines"] = recorded()[start:]
    seen["undo"] = document.UndoNames
    ball.Radius = 21000
    document.recompute()
    seen["followed"] = section.Height.Value
    FreeCAD.closeDocument(document.Name)
    FreeCAD.setActiveDocument(former)
    steps.settle(4)
    return seen


def answered_dialog():
    """Whether a dialog is still there once it was answered, with its language changed just before;
    an event that PySide takes for something else."""
    from BendTorsionWB.gui import section_dialog
    from BendTorsionWB.gui.qt import QtCore, QtWidgets
    from BendTorsionWB.gui.quantity_field import QuantityField

    def there():
        # Otherwise those to be deleted stay until this script is done.
        QtCore.QCoreApplication.sendPostedEvents(None, QtCore.QEvent.DeferredDelete)
        return len(window().findChildren(section_dialog.SectionDialog))

    def answer(dialog):
        dialog.changeEvent(QtCore.QEvent(QtCore.QEvent.LanguageChange))
        dialog.reject()

    before = there()
    answered(answer)
    section_dialog.ask(window())
    steps.settle(4)
    seen = {"left": there() - before}
    quantity, nothing = QuantityField(1.0, "mm"), QtCore.QObject()
    quantity.changeEvent(nothing)
    dialog = section_dialog.SectionDialog()
    dialog.changeEvent(nothing)
    dialog.changeEvent(QtCore.QEvent(QtCore.QEvent.LanguageChange))
    dialog.deleteLater()
    QtCore.QCoreApplication.sendPostedEvents(None, QtCore.QEvent.DeferredDelete)
    steps.settle(4)
    seen["others"] = isinstance(quantity, QtWidgets.QWidget)
    return seen


def ruled():
    """A height that follows a spreadsheet: what its field shows, typed into, and when the cell
    changes; a breadth that is bound here, left, and typed over."""
    from BendTorsionWB import make

    former, document = FreeCAD.ActiveDocument, FreeCAD.newDocument("Ruled")
    sheet = document.addObject("Spreadsheet::Sheet", "Sheet")
    sheet.set("A1", "=600 mm")
    section = make.make_section(document, "B", h=400, b=300, t=12)
    section.setExpression("Height", "Sheet.A1")
    document.recompute()
    open_section()
    seen = {"opened": [text_of("Height"), field("Height").toolTip()]}
    QtGui.QToolTip.hideText()
    keys.type_beside(0.1, "7", "@BackSpace", "@Up")
    seen["typed into"] = [text_of("Height"), section.Height.Value, QtGui.QToolTip.text()]
    seen["typed into"] += [ok_enabled(), len(section.ExpressionEngine)]
    steps.picture("ruled")
    sheet.set("A1", "=650 mm")
    document.recompute()
    steps.settle(2)
    seen["followed"] = text_of("Height")
    to("Breadth")
    keys.type_beside(0.05, "=Height / 2")
    seen["being typed"] = text_of("Breadth")
    to("Thickness")
    seen["left"] = text_of("Breadth")
    steps.settle(12)
    seen["bound"] = [text_of("Breadth"), section.Breadth.Value]
    sheet.set("A1", "=700 mm")
    document.recompute()
    steps.settle(2)
    seen["follows"] = [text_of("Breadth"), section.Breadth.Value]
    keys.strike("Shift_L+Tab")
    keys.type_beside(0.05, "250")
    to("Thickness")
    steps.settle(8)
    paths = [path.lstrip(".") for path, _ in section.ExpressionEngine]
    seen["typed over"] = [text_of("Breadth"), section.Breadth.Value, paths]
    press("Cancel")
    FreeCAD.closeDocument(document.Name)
    FreeCAD.setActiveDocument(former.Name)
    steps.settle(4)
    return seen


steps.run(nothing_shown, several, mended, arrows, bound_in_dialog, answered_dialog, ruled)
