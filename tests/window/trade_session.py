# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: what a detailer who has read nothing tries first."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import member_document, panel_text, part_tables
from hands import answered, asked, field, key, named, press, run, select, window


def told():
    """What the status bar says."""
    return window().statusBar().currentMessage()


def side_width():
    """Pixels the tree has, or the panel before it."""
    tree = steps.side()
    docks = window().findChildren(QtGui.QDockWidget)
    panels = [dock for dock in docks if dock.objectName() == "Tasks"]
    behind = tree.visibleRegion().isEmpty() or FreeCADGui.Control.activeDialog()
    dock = panels[0] if panels and behind else tree
    assert not dock.visibleRegion().isEmpty()
    return dock.width()


def ours(kind):
    """The objects of a kind."""
    return [o for o in FreeCAD.ActiveDocument.Objects if getattr(o, "BT_Type", "") == kind]


def refusals():
    """Nothing selected: the sentences, and what the Report view has of them."""
    FreeCAD.newDocument("Refusals")
    before = steps.report_view()
    shown = {name: run(name) for name in ("MembersFromSelection", "CutPoint", "Sheets")}
    return {"shown": shown, "report": steps.report_view()[len(before) :]}


def sections():
    """The types of a section, as the panel and the dialog of members offer them."""
    from BendTorsionWB.gui import section_dialog

    run("Section")
    box = field("Type", QtGui.QComboBox)
    seen = {"panel": {box.itemData(k): box.itemText(k) for k in range(box.count())}}
    box.setCurrentIndex(box.findData("box2"))
    steps.settle(6)
    seen["value"] = ours("SectionSpec")[0].Type
    steps.picture("section")
    press("Cancel")
    dialog = section_dialog.SectionDialog(window(), 1, 3)
    seen["dialog"] = {dialog.type.itemData(k): dialog.type.itemText(k) for k in range(2)}
    dialog.show()
    dialog.fields["t"].setProperty("rawValue", 400.0)
    steps.settle(2)
    picker, first = dialog.align.geometry(), dialog.first.geometry()
    seen["apart"] = first.top() - picker.bottom()
    seen["points"] = [
        pointed_at(dialog.align, name) for name in ("top-left", "top", "right", "bottom")
    ]
    pointed_at(dialog.align, None)
    seen["picker"] = [dialog.align.toolTip(), dialog.align.accessibleName()]
    steps.picture("dialog_picker")
    dialog.close()
    return seen


def pointed_at(picker, name):
    """The tooltip of a nine-point picker at one of its points, or beside them all."""
    at = picker.point_of(name).toPoint() if name else QtCore.QPoint(1, 1)
    event = QtGui.QHelpEvent(QtCore.QEvent.ToolTip, at, picker.mapToGlobal(at))
    QtGui.QApplication.sendEvent(picker, event)
    return picker.toolTip()


def members():
    """Three members on a face: what is seen and selected after."""
    import Part

    document = FreeCAD.newDocument("Trade")
    document.UndoMode = 1
    roof = document.addObject("Part::Feature", "Roof")
    roof.Shape = Part.makePlane(12000, 9000)
    curves = []
    for k, y in enumerate((1500.0, 4500.0, 7500.0)):
        curves.append(document.addObject("Part::Feature", f"Curve{k}"))
        curves[-1].Shape = Part.makeLine((1000, y, 0), (11000, y + 200 * k, 0))
    document.recompute()
    select((roof, "Face1"), *((curve, "Edge1") for curve in curves))
    answered(lambda dialog: dialog.accept())
    run("MembersFromSelection")
    seen = {
        "visible": {o.Label: o.ViewObject.Visibility for o in (roof, *ours("Surface"))},
        "selected": [o.Label for o in FreeCADGui.Selection.getSelection()],
    }
    document.undo()
    steps.settle(2)
    seen["undone"] = roof.ViewObject.Visibility
    document.redo()
    document.recompute()
    steps.settle(2)
    return seen


def patterns():
    """Development of one member, then of the two others: where each lies."""
    document = FreeCAD.ActiveDocument
    select(named("M1"))
    run("Development")
    press("Ok")
    select(named("M2"), named("M3"))
    run("Development")
    FreeCADGui.ActiveDocument.ActiveView.viewTop()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.picture("patterns")

    def box(obj):
        b = obj.Shape.BoundBox
        return [b.XMin, b.XMax, b.YMin, b.YMax]

    return {
        "patterns": {o.Label: box(o) for o in ours("Unfold")},
        "model": [box(o) for o in (*ours("PlateSet"), document.Roof)],
        "states": [o.Status for o in ours("Unfold")],
    }


def sheets():
    """Sheets of the first member: what is told and shown."""
    select(named("M1"))
    seen = {"shown": run("Sheets")}
    steps.settle(6)
    pages = [o for o in FreeCAD.ActiveDocument.Objects if o.isDerivedFrom("TechDraw::DrawPage")]
    area = window().centralWidget()
    seen["told"], seen["pages"] = told(), len(pages)
    active = area.activeSubWindow() if hasattr(area, "activeSubWindow") else None
    seen["view"] = active.windowTitle() if active is not None else ""
    seen["page"] = pages[0].Label if pages else ""
    steps.picture("sheets")
    return seen


def repair():
    """Nothing to repair."""
    document = FreeCAD.ActiveDocument
    before = list(document.UndoNames)
    run("Repair")
    return {"before": before, "after": list(document.UndoNames), "told": told()}


def node():
    """Two members that do not meet; a member without its section."""
    document = FreeCAD.ActiveDocument
    select(named("M1"), named("M2"))
    run("Node")
    seen = {"node": panel_text()}
    labels = [w.text() for w in window().findChildren(QtGui.QLabel) if w.isVisible()]
    seen["labels"] = [text for text in labels if "apart" in text]
    steps.picture("node")
    press("Cancel")
    member = named("M3")
    document.openTransaction("Without")
    member.Section1 = None
    document.recompute()
    seen["section"] = list(member.Findings)
    document.abortTransaction()
    document.recompute()
    return seen


def parts():
    """Which cell typing goes to in tables of parts."""
    seen = {}
    for name, table in part_tables():
        seen[name] = [table.hasFocus(), table.currentRow(), table.currentColumn()]
    return seen


def transform():
    """Whether FreeCAD's Transform takes hold of a member, its plates, its patterns."""
    from BendTorsionWB import make

    document, seen = FreeCAD.ActiveDocument, {}
    plates = next(obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "PlateSet")
    patterns = make.make_unfold(document, plates)
    document.recompute()
    for obj in (plates.Member, plates, patterns):
        FreeCADGui.ActiveDocument.setEdit(obj, 1)
        steps.settle(2)
        seen[obj.BT_Type] = FreeCADGui.ActiveDocument.getInEdit() is not None
        FreeCADGui.Control.closeDialog()
        FreeCADGui.ActiveDocument.resetEdit()
        steps.settle(2)
    return seen


def split():
    """Width of the side of the window before, while and after; texts."""
    document = member_document("Split")
    steps.side().setVisible(True)
    steps.narrow(300)
    seen = {"widths": [side_width()]}
    select(named("M1"))
    run("Splits")
    steps.settle(4)
    seen["widths"].append(side_width())
    seen["verdict"] = field("verdict", QtGui.QLabel).text()
    view = next(v for v in window().findChildren(QtGui.QGraphicsView) if v.minimumWidth() >= 500)
    texts = [i for i in view.scene().items() if isinstance(i, QtGui.QGraphicsSimpleTextItem)]
    seen["texts"] = [
        i.deviceTransform(view.viewportTransform()).mapRect(i.boundingRect()).height()
        for i in texts
    ]
    seen["inside"] = [
        i.deviceTransform(view.viewportTransform()).mapRect(i.boundingRect()).left() for i in texts
    ]
    steps.picture("split")
    press("Cancel")
    steps.settle(8)
    seen["widths"].append(side_width())
    FreeCAD.setActiveDocument(document.Name)
    return seen


def table():
    """The table beside the Report view; a text that cannot be, and another cell after it."""
    report = window().findChild(QtGui.QDockWidget, "Report view")
    report.setVisible(True)
    steps.settle(2)
    run("MemberTable")
    dock = window().findChild(QtGui.QDockWidget, "BendTorsion_MemberTable")
    rows = dock.table
    steps.settle(4)
    from BendTorsionWB.gui.member_rows import COLUMNS

    widths = {name: rows.columnWidth(c) for c, name in enumerate(COLUMNS)}
    seen = {"size": [dock.width(), dock.height(), window().width()], "columns": widths}
    steps.picture("table")
    top, offset = COLUMNS.index("top"), COLUMNS.index("offset_y")
    rows.write({(0, top): "00; 20000"})
    steps.settle(4)
    rows.write({(1, offset): "25"})
    steps.settle(4)
    item = rows.item(0, top)
    seen["kept"] = [item.text(), bool(item.toolTip())]
    seen["other"] = named("M1").OffsetY2.Value
    rows.write({(0, top): "6000 12000"})
    steps.settle(4)
    seen["mended"] = [item.text(), item.toolTip()]
    rows.write({(0, top): "no"})
    steps.settle(4)
    rows.setCurrentCell(0, top)
    key(rows, QtCore.Qt.Key_Escape)
    steps.settle(4)
    seen["dropped"] = [rows.item(0, top).text(), rows.item(0, top).toolTip()]
    rows.setCurrentCell(0, COLUMNS.index("align"))
    rows.edit(rows.currentIndex())
    steps.settle(2)
    editor = rows.findChild(QtGui.QLineEdit)
    editor.completer().complete()
    steps.settle(2)
    popup = editor.completer().popup()
    seen["choices"] = [popup.width(), popup.sizeHintForColumn(0)]
    popup.hide()
    report.hide()
    dock.hide()
    return seen


def severities():
    """Lightness of the colours of severities beside dark and beside light texts."""
    from BendTorsionWB.gui.task_panel import colour_of

    seen = {}
    for text in ("#000000", "#ffffff"):
        label = QtGui.QLabel()
        palette = label.palette()
        palette.setColor(QtGui.QPalette.Text, QtGui.QColor(text))
        label.setPalette(palette)
        seen[text] = {
            name: QtGui.QColor(colour_of(name, label)).lightness()
            for name in ("error", "warning", "note")
        }
    return seen


def example():
    """The name proposed for an example."""
    from BendTorsionWB.gui.qt import QtWidgets

    names = []
    former = QtWidgets.QFileDialog.getSaveFileName
    QtWidgets.QFileDialog.getSaveFileName = lambda *given: names.append(given[2]) or ("", "")
    with asked(choice="three members on one surface, with drawing sheets"):
        run("Example")
    QtWidgets.QFileDialog.getSaveFileName = former
    return names


steps.run(
    refusals,
    sections,
    members,
    patterns,
    sheets,
    repair,
    node,
    parts,
    split,
    table,
    severities,
    transform,
    example,
)
