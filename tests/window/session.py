# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: works through the steps and writes what it saw as JSON.

BENDTORSION_WINDOW_RESULT names the file, BENDTORSION_WINDOW_DOCUMENT a document saved without a
window. A step that raises is recorded under its name, so that
one broken step does not hide the others; the program always ends.
"""

import json
import os
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtCore

WORKBENCH = "BendTorsionWorkbench"
COMMAND = "BendTorsion_MembersFromSelection"


def workbench():
    """Open the workbench; what it is called and what it put into the window."""
    import sys

    listed = WORKBENCH in FreeCADGui.listWorkbenches()
    loaded_early = [
        name for name in ("numpy", "scipy", "BendTorsionWB.make") if name in sys.modules
    ]
    FreeCADGui.activateWorkbench(WORKBENCH)
    active = FreeCADGui.activeWorkbench()
    return {
        "listed": listed,
        "active": active.name(),
        "icon_exists": os.path.exists(active.Icon),
        "toolbar": active.getToolbarItems().get("BendTorsion Model", []),
        "registered": COMMAND in FreeCADGui.listCommands(),
        "loaded_early": loaded_early,
    }


def empty_selection():
    """Run the command with nothing selected; the text of the message box it shows."""
    from PySide import QtGui

    FreeCAD.newDocument("Empty")
    shown = []

    def close_box():
        box = QtGui.QApplication.activeModalWidget()
        shown.append(box.text())
        box.accept()

    QtCore.QTimer.singleShot(500, close_box)
    FreeCADGui.runCommand(COMMAND)
    objects = len(FreeCAD.ActiveDocument.Objects)
    FreeCAD.closeDocument("Empty")
    return {"shown": shown, "objects": objects}


def members():
    """Select a sphere's face and two curves on it, run the command, accept its dialog, undo."""
    import Part
    from PySide import QtGui

    document = FreeCAD.newDocument("Members")
    document.UndoMode = 1
    sphere = document.addObject("Part::Sphere", "Sphere")
    sphere.Radius = 20000
    curves = []
    for tilt in (10, 25):
        # A great circle's arc: its plane runs through the centre, so the box along it has no twist.
        arc = Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, tilt, 30), 10, 50)
        curves.append(document.addObject("Part::Feature", f"Curve{tilt}"))
        curves[-1].Shape = arc
    document.recompute()
    before = {item.Name for item in document.Objects}
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(document.Name, sphere.Name, "Face1")
    for curve in curves:
        FreeCADGui.Selection.addSelection(document.Name, curve.Name, "Edge1")
    dialogs = []

    def accept_dialog():
        dialog = QtGui.QApplication.activeModalWidget()
        dialogs.append(dialog.windowTitle())
        dialog.fields["h"].setProperty("rawValue", 800.0)
        dialog.accept()

    QtCore.QTimer.singleShot(500, accept_dialog)
    FreeCADGui.runCommand(COMMAND)
    made = [item for item in document.Objects if item.Name not in before]
    result = {
        "dialogs": dialogs,
        "labels": [item.Label for item in made],
        "types": [item.BT_Type for item in made],
        "solids": {
            item.Label: [solid.Volume for solid in item.Shape.Solids]
            for item in made
            if item.BT_Type == "PlateSet"
        },
        "arcs": [curve.Shape.Length for curve in curves],
        "states": {item.Label: list(item.State) for item in made},
    }
    FreeCADGui.SendMsgToActiveView("ViewFit")
    document.undo()
    result["after_undo"] = sorted({item.Name for item in document.Objects} - before)
    document.redo()
    document.recompute()
    result["after_redo"] = [item.Label for item in document.Objects if item.Name not in before]
    return result


def saved_without_window():
    """Open a document saved by plain Python: what the window makes of its objects."""
    document = FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_DOCUMENT"])
    ours = [item for item in document.Objects if hasattr(item, "BT_Type")]
    result = {
        "visible": {item.BT_Type: item.ViewObject.Visibility for item in ours},
        "icons": [not item.ViewObject.Proxy.getIcon().isNull() for item in ours],
        "volume": sum(item.Shape.Volume for item in ours if item.BT_Type == "PlateSet"),
    }
    plates = next(item for item in ours if item.BT_Type == "PlateSet")
    result["colours"] = {
        "saved": [list(colour) for colour in plates.Colours],
        "painted": [list(colour) for colour in plates.ViewObject.DiffuseColor],
        "faces": [len(solid.Faces) for solid in plates.Shape.Solids],
    }
    plates.ColourBy = "none"
    for item in ours:
        item.touch()
    document.recompute()
    result["colours"]["after"] = [list(colour) for colour in plates.ViewObject.DiffuseColor]
    result["colours"]["own"] = list(plates.ViewObject.ShapeColor)
    result["statuses"] = [item.Status for item in ours]
    result["volume_again"] = sum(item.Shape.Volume for item in ours if item.BT_Type == "PlateSet")
    return result


def run():
    """Work through the steps, write the results, end the program."""
    results = {}
    try:
        for step in (workbench, empty_selection, members, saved_without_window):
            try:
                results[step.__name__] = step()
            except Exception:  # noqa: BLE001 - the failure is the result, whatever it was
                results[step.__name__] = {"failed": traceback.format_exc()}
        path = os.environ["BENDTORSION_WINDOW_RESULT"]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(results, file)
    finally:
        os._exit(0)


QtCore.QTimer.singleShot(0, run)
