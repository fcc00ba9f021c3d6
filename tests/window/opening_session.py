# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: a model built without a window is opened, as from the file menu."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import mouse
import steps
from hands import window


def opened():
    """The model as it stands once it is open: where its plates are in the picture, its tab."""
    document = FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_DOCUMENT"])
    steps.settle(10)
    steps.picture("opened")
    boxes = [o.Shape.BoundBox for o in document.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
    corners = [(x, y, z) for b in boxes for x in (b.XMin, b.XMax) for y in (b.YMin, b.YMax)
               for z in (b.ZMin, b.ZMax)]  # fmt: skip
    pixels = [mouse.pixel_of(corner) for corner in corners]
    widget = mouse.view_widget()
    bars = window().findChildren(QtGui.QTabBar)
    return {
        "across": [min(at.x() for at in pixels), max(at.x() for at in pixels), widget.width()],
        "down": [min(at.y() for at in pixels), max(at.y() for at in pixels), widget.height()],
        "tabs": [bar.tabText(k) for bar in bars for k in range(bar.count())],
        "modified": FreeCADGui.ActiveDocument.Modified,
        "selected": len(FreeCADGui.Selection.getSelection()),
    }


def opened_again():
    """With a camera of the user's in the file, it looks where that does."""
    document = FreeCAD.ActiveDocument
    view = FreeCADGui.ActiveDocument.ActiveView
    view.viewTop()
    view.getCameraNode().height = 1234.0
    path = os.path.join(os.environ["BENDTORSION_WINDOW_PICTURES"], "kept.FCStd")
    document.saveAs(path)
    FreeCAD.closeDocument(document.Name)
    FreeCAD.openDocument(path)
    steps.settle(10)
    height = FreeCADGui.ActiveDocument.ActiveView.getCameraNode().height.getValue()
    os.remove(path)
    return {"height": height, "modified": FreeCADGui.ActiveDocument.Modified}


steps.run(opened, opened_again)
