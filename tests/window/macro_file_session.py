# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: a macro as FreeCAD's recorder saves it, with commands that are
refused and cancelled among those that are done, and the file run again.

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
    refused = run("MembersFromSelection")
    of_faces = [edge for face in shapes.Shape.Faces for edge in face.Edges]
    free = [
        f"Edge{k}"
        for k, edge in enumerate(shapes.Shape.Edges, start=1)
        if not any(edge.isSame(other) for other in of_faces)
    ]
    picked = [(shapes, "Face1"), *((shapes, name) for name in free)]
    select(*picked)
    answered(lambda dialog: dialog.reject())
    shown += run("MembersFromSelection")
    select(*picked[:2])
    answered(_sizes)
    shown += run("MembersFromSelection")
    select(named("Surface"), *picked[2:])
    answered(_sizes)
    shown += run("MembersFromSelection")
    select()
    shown += run("Section")
    retype(field("Height"), "450 mm")
    press("Cancel")
    shown += run("Section")
    retype(field("Height"), "500 mm")
    press("Ok")
    refused += run("Report")
    select(named("M1 plates"))
    shown += run("Plates")
    retype(field("joints top"), "3000 6000")
    press("Ok")
    select(named("M1"))
    shown += run("Development")
    press("Ok")
    shown += run("ShowAs")
    shown += run("ShowAs")
    _spoil("M2 plates")
    select(named("M1"), named("M2"))
    refused += run("AssemblyBed")
    with asked(folder="/proc/nowhere"):
        refused += run("ExportPackage")
    _spoil("M2 plates", mended=True)
    # From FreeCAD 1.0 on the command that starts it stops it.
    stop = "Std_MacroStopRecord"
    known = stop in FreeCADGui.Command.listAll()
    FreeCADGui.runCommand(stop if known else "Std_DlgMacroRecord")
    steps.settle()
    found = {"shown": shown, "refused": refused, "free": len(free)}
    return found | _seen()


def _spoil(label, mended=False):
    """Plates in error, beside what is recorded."""
    named(label).JointsTop = [] if mended else [90000.0]
    FreeCAD.ActiveDocument.recompute()
    steps.settle(2)


def _seen():
    """What there is, what of it is shown, and where the view looks."""
    document = FreeCAD.ActiveDocument
    return {
        "figures": figures(document),
        "shown_ones": sorted(o.Label for o in document.Objects if o.ViewObject.Visibility),
        "camera": FreeCADGui.getDocument(document.Name).ActiveView.getCamera(),
    }


def run_again():
    """The file as it is."""
    exec(compile(MACRO.read_text(encoding="utf-8"), str(MACRO), "exec"), __main__.__dict__)
    steps.settle()
    return _seen()


steps.run(run_again if MACRO.exists() else recorded)
