# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes docs/images/concert_hall.png from build/concert_hall/model.FCStd.

Run in a FreeCAD window: xvfb-run -a -s "-screen 0 1600x1000x24" freecad docs/make_pictures.py
"""

import os
from pathlib import Path

import FreeCAD
import FreeCADGui

ROOT = Path(__file__).resolve().parent.parent
COLOURS = {
    "T": (0.85, 0.55, 0.25),
    "B": (0.55, 0.35, 0.2),
    "L": (0.35, 0.55, 0.75),
    "R": (0.25, 0.4, 0.55),
}


def main() -> None:
    document = FreeCAD.openDocument(str(ROOT / "build" / "concert_hall" / "model.FCStd"))
    for obj in document.Objects:
        shown = getattr(obj, "BT_Type", "") == "PlateSet"
        if hasattr(obj.ViewObject, "Visibility"):
            obj.ViewObject.Visibility = shown
        if getattr(obj, "BT_Type", "") == "PlateSet":
            # Each plate by its face letter, edges thin.
            colours = []
            for mark, solid in zip(obj.Marks, obj.Shape.Solids):
                colours += [COLOURS[mark.split("-")[-1][0]]] * len(solid.Faces)
            obj.ViewObject.DiffuseColor = colours
            obj.ViewObject.LineWidth = 1
    FreeCADGui.activeDocument().activeView().setAnimationEnabled(False)
    view = FreeCADGui.activeDocument().activeView()
    view.setCameraType("Orthographic")
    rotation = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), -12).multiply(
        FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 74)
    )
    view.setCameraOrientation(rotation.Q)
    view.fitAll(0.6)
    FreeCADGui.updateGui()
    view.saveImage(str(ROOT / "docs" / "images" / "concert_hall.png"), 1400, 640, "White")


try:
    main()
finally:
    os._exit(0)
