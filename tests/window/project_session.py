# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: a split model opened whole, turned, and its picture taken (see
docs/make_project_picture.py)."""

import os
import sys
import time

import FreeCAD
import FreeCADGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps

LEANING, TURNED = 62, -30
CLOSER = 0.65
"""What is fitted is the ball about the model, of which a flat one fills little."""


def _plate_sets():
    for document in FreeCAD.listDocuments().values():
        yield from (obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "PlateSet")


def open_project():
    """Seconds until the model is on the screen and of one turn; documents and members in it."""
    start = time.perf_counter()
    document = FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_MODEL"])
    FreeCADGui.setActiveDocument(document.Name)
    view = FreeCADGui.getDocument(document.Name).activeView()
    view.setAnimationEnabled(False)
    view.setCameraType("Orthographic")
    view.viewTop()
    view.fitAll()
    FreeCADGui.updateGui()
    opened = time.perf_counter() - start
    up, across = FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(1, 0, 0)
    rotation = FreeCAD.Rotation(up, TURNED).multiply(FreeCAD.Rotation(across, LEANING))
    start = time.perf_counter()
    view.setCameraOrientation(rotation.Q)
    view.fitAll(CLOSER)
    FreeCADGui.updateGui()
    turned = time.perf_counter() - start
    # Of a thousand members black edges would leave nothing else.
    for plates in _plate_sets():
        plates.ViewObject.LineColor = plates.ViewObject.ShapeColor
    view.saveImage(os.environ["BENDTORSION_WINDOW_PICTURE"], 1000, 640, "White")
    groups = [obj for obj in document.Objects if obj.TypeId == "App::Link"]
    return {
        "opened": opened,
        "turned": turned,
        "documents": len(FreeCAD.listDocuments()),
        "members": sum(len(link.LinkedObject.ElementList) for link in groups),
    }


steps.run(open_project)
