# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: drawing pages of a document saved without a window."""

import os
import sys

import FreeCAD
import FreeCADGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps


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
    return result


steps.run(pages)
