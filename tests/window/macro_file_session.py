# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: a macro as FreeCAD's recorder saves it, and the file run again.

BENDTORSION_WINDOW_MACRO names the file; it is recorded where there is none, and run where there is.
"""

import os
import sys
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

import __main__

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from hands import answered, asked, field, named, press, retype, run, select
from macro_base import figures

MACRO = Path(os.environ["BENDTORSION_WINDOW_MACRO"])
ARCS = Path(os.environ["BENDTORSION_WINDOW_ARCS"])


def _start(dialog):
    dialog.findChild(QtGui.QLineEdit, "lineEditMacroPath").setText(f"{MACRO.parent}/")
    dialog.findChild(QtGui.QLineEdit, "lineEditPath").setText(MACRO.name)
    dialog.findChild(QtGui.QPushButton, "buttonStart").click()


def _sizes(dialog):
    dialog.fields["h"].setProperty("rawValue", 700.0)
    dialog.accept()


def recorded():
    """Commands of the workbench from a new document on, while FreeCAD records."""
    answered(_start)
    FreeCADGui.runCommand("Std_DlgMacroRecord")
    steps.settle()
    FreeCADGui.runCommand("Std_New")
    shown = []
    with asked(open_file=str(ARCS)):
        shown += run("ImportShapes")
    shapes = FreeCAD.ActiveDocument.Objects[0]
    answered(_sizes)
    of_faces = [edge for face in shapes.Shape.Faces for edge in face.Edges]
    free = [
        f"Edge{k}"
        for k, edge in enumerate(shapes.Shape.Edges, start=1)
        if not any(edge.isSame(other) for other in of_faces)
    ]
    select((shapes, "Face1"), *((shapes, name) for name in free))
    shown += run("MembersFromSelection")
    select()
    shown += run("Section")
    retype(field("Height"), "500 mm")
    press("Ok")
    select(named("M1 plates"))
    shown += run("Plates")
    retype(field("joints top"), "3000 6000")
    press("Ok")
    select(named("M1"))
    shown += run("Development")
    press("Ok")
    FreeCADGui.runCommand("Std_MacroStopRecord")
    steps.settle()
    return {"shown": shown, "figures": figures(FreeCAD.ActiveDocument), "free": len(free)}


def run_again():
    """The file as it is."""
    exec(compile(MACRO.read_text(encoding="utf-8"), str(MACRO), "exec"), __main__.__dict__)
    steps.settle()
    return {"figures": figures(FreeCAD.ActiveDocument)}


steps.run(run_again if MACRO.exists() else recorded)
