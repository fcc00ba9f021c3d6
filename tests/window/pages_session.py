# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: drawing pages of a document saved without a window."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import whole_document
from hands import named, press, run, select, window


def go_to_finding(document):
    """Click a finding while a drawing page is in front: the view that is in front
    then, and what is selected."""
    from BendTorsionWB.gui import findings_panel

    panel = findings_panel.show(document)
    steps.settle()
    before = str(FreeCADGui.ActiveDocument.ActiveView)
    panel.table.cellClicked.emit(0, 0)
    steps.settle()
    selected = [item.Label for item in FreeCADGui.Selection.getSelection()]
    steps.picture("finding_from_page")
    panel.hide()
    return [before, str(FreeCADGui.ActiveDocument.ActiveView), selected]


def pages():
    """Pages wait until they are opened; then they follow edits, undo, and are kept in the file."""
    import TechDraw

    document = FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_DOCUMENT"])
    found = [item for item in document.Objects if item.isDerivedFrom("TechDraw::DrawPage")]

    def drawn(page):
        views = [view for view in page.Views if view.isDerivedFrom("TechDraw::DrawViewPart")]
        return [page.KeepUpdated, sum(len(view.getVisibleEdges()) for view in views)]

    result = {"before": [drawn(page) for page in found]}
    first, second, third = found[:3]
    first.ViewObject.doubleClicked()
    result["opened"] = [drawn(first), drawn(second)]
    steps.settle()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.picture("view_page")
    result["finding"] = go_to_finding(document)
    path = os.path.join(os.environ["HOME"], "page.dxf")
    TechDraw.writeDXFPage(second, path)
    with open(path, encoding="utf-8") as file:
        lines = file.read().split()
    result["dxf"] = [drawn(second), lines.count("LINE") + lines.count("POLYLINE")]
    document.openTransaction("open a page")
    third.ViewObject.doubleClicked()
    document.abortTransaction()
    steps.settle()
    result["taken_back"] = drawn(third)
    symbol = next(view for view in first.Views if getattr(view, "BT_Type", "") == "PageSymbol")
    before = symbol.Symbol
    document.getObjectsByLabel("B")[0].Height = 640.0
    document.recompute()
    result["edited"] = [symbol.Symbol != before, drawn(first)]
    for page in (first, second, third):
        page.ViewObject.hide()
    steps.settle()
    path = os.path.join(os.environ["HOME"], "again.FCStd")
    document.saveAs(path)
    first.ViewObject.doubleClicked()
    name = first.Name
    FreeCAD.closeDocument(document.Name)
    again = FreeCAD.openDocument(path)
    steps.settle()
    page = again.getObject(name)
    result["again"] = [drawn(page)]
    page.ViewObject.doubleClicked()
    result["again"].append(drawn(page))
    steps.settle()
    FreeCAD.closeDocument(again.Name)
    return result


def pages_of(document):
    """The drawing pages of a document."""
    return [item for item in document.Objects if item.isDerivedFrom("TechDraw::DrawPage")]


def steps_front():
    """What kind of view is in front."""
    return str(FreeCADGui.ActiveDocument.ActiveView)


A3 = QtCore.QRectF(0, -2970, 4200, 2970)
"""The paper in TechDraw's scenes, tenths of a millimetre."""


def page_windows():
    """Title and dark pixels of each drawing page that is open, seen with its paper as large as the
    window; none of one that had not shown all of its paper."""
    found = {}
    for item in window().findChildren(QtGui.QMdiSubWindow):
        pages = [view for view in item.findChildren(QtGui.QGraphicsView) if "QGVPage" in meta(view)]
        if pages and item.isVisible():
            whole = pages[0].mapToScene(pages[0].viewport().rect()).boundingRect().contains(A3)
            pages[0].fitInView(A3, QtCore.Qt.KeepAspectRatio)
            steps.settle()
            shown = pages[0].viewport().grab().toImage()
            dots = range(0, shown.width(), 2), range(0, shown.height(), 2)
            dark = sum(shown.pixelColor(x, y).lightness() < 90 for x in dots[0] for y in dots[1])
            found[item.windowTitle().removesuffix("[*]")] = dark if whole else 0
    return found


def meta(widget):
    """What kind of widget FreeCAD made."""
    return widget.metaObject().className()


def taken_back():
    """Sheets by the command, undone and done again twice, with the page open; then a page that an
    edit leaves without a sheet, undone."""
    document = whole_document("Again")
    select(named("M2 plates"))
    run("Development")
    press("Ok")
    run("Sheets", pause=8)
    drawn = [page.Label for page in pages_of(document) if page.KeepUpdated]
    seen = {"made": page_windows(), "front": steps_front(), "drawn": drawn}
    for name in ("Undo", "Redo", "Undo", "Redo"):
        FreeCADGui.runCommand(f"Std_{name}")
        steps.settle(6)
        seen.setdefault(name, []).append([page_windows(), len(pages_of(document)), steps_front()])
    steps.picture("page_redone")
    last, sheets = pages_of(document)[-1], named("M2 sheets")
    label = last.Label
    last.ViewObject.doubleClicked()
    steps.settle()
    document.openTransaction("fewer pages")
    sheets.PlatePages = False
    document.recompute()
    document.commitTransaction()
    steps.settle(6)
    seen["surplus"] = [label, sorted(page_windows())]
    FreeCADGui.runCommand("Std_Undo")
    steps.settle(6)
    seen["back"] = [sorted(page_windows()), page_windows().get(label)]
    return seen


def long_work():
    """Sheets that take so long that the window settles while they are made: what is in front then,
    and the pages that are drawn."""
    from BendTorsionWB.gui import commands_plates, undone

    document = whole_document("Long")
    select(named("M2 plates"))
    run("Development")
    press("Ok")
    former = commands_plates.PATIENCE, undone.SEEN
    commands_plates.PATIENCE, undone.SEEN = -1.0, 3000
    try:
        run("Sheets", pause=8)
        return [steps_front(), [page.Label for page in pages_of(document) if page.KeepUpdated]]
    finally:
        commands_plates.PATIENCE, undone.SEEN = former


steps.run(pages, taken_back, long_work)
