# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: every command once; undo steps and the lines of the macro."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import recorded
from hands import answered, asked, field, named, press, retype, run, select
from macro_base import base, figures

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


class Session:
    """Runs commands and notes what each showed and how many undo steps it made."""

    def __init__(self, document):
        self.document, self.shown, self.undo = document, {}, {}

    def command(self, name, *selected, finish=None, edit=None):
        """Select, run, edit the panel, press a button of it."""
        select(*selected)
        before = len(self.document.UndoNames)
        shown = run(name)
        if edit is not None:
            edit()
            steps.settle(6)
        if finish:
            press(finish)
        self.shown[name] = shown
        self.undo[name] = len(self.document.UndoNames) - before


def rows(text):
    """Paste rows into the table of the panel."""
    table = field("rows", QtGui.QTableWidget)
    QtGui.QApplication.clipboard().setText(text)
    table.setCurrentCell(0, 0)
    table.paste()
    steps.settle(6)


def all_commands():
    """A building with every command of the workbench."""
    document = base("Macro")
    start = len(recorded())
    session = Session(document)
    command = session.command

    def answer(dialog):
        dialog.fields["h"].setProperty("rawValue", 700.0)
        dialog.accept()

    command("Surface", (document.Ball, "Face1"), finish="Ok")
    answered(answer)
    command("MembersFromSelection", (document.Ball, "Face1"), document.Arc1, document.Arc2)
    with asked(save_file=os.path.join(FOLDER, "bundle.zip")):
        command("SupportBundle")
    command("Repair")
    command("Axis", named("Surface"), document.Branch, finish="Ok")
    command("Section", finish="Ok", edit=lambda: retype(field("Height"), "500 mm"))
    section = next(o for o in document.Objects if o.Label == "Section 2")
    command("Member", named("Axis"), section, finish="Ok")
    command("CutPoint", named("M2"), finish="Ok", edit=lambda: retype(field("Cut2"), "3 m"))
    command("Alignment", named("M2"), finish="Ok", edit=lambda: _align("top"))
    command("Plates", named("M3"), finish="Ok")
    members = named("M1"), named("M3")
    command("Node", *members, finish="Ok", edit=lambda: retype(field("Gap"), "4 mm"))
    plates = named("M2 plates")
    command("Splits", plates, finish="Ok", edit=_joint)
    command("Pieces", plates, finish="Ok", edit=lambda: rows("1\t\t4000\n2"))
    command("Diaphragms", plates, finish="Ok", edit=lambda: rows("1500\t12"))
    command("Openings", plates, finish="Ok", edit=lambda: rows("left\t2500\t0\td=120"))
    command("FaceMarks", plates, finish="Ok", edit=lambda: rows("top\t3000\t0\tpunch"))
    command("Welds", plates, finish="Ok", edit=lambda: rows("TL\t\t\tbevel angle=45 land=2 gap=3"))
    command("Development", plates, finish="Ok", edit=lambda: retype(field("GreenEnd"), "25"))
    command("AssemblyBed", plates, finish="Ok", edit=_saddles)
    command("Sheets")
    path = os.path.join(FOLDER, "ball.step")
    document.Ball.Shape.exportStep(path)
    with asked(open_file=path):
        command("ImportShapes")
    with asked(choice="strain"):
        command("ColourBy", plates)
    for name in ("ShowAs", "ShowMarks", "ShowPoints"):
        command(name, plates)
        command(name, plates)
    command("FitMembers")
    command("ShowFrames", named("M2"))
    command("MemberTable")
    command("Check")
    command("Findings")
    for name in ("BendTorsion_FindingsPanel", "BendTorsion_MemberTable"):
        FreeCADGui.getMainWindow().findChild(QtGui.QDockWidget, name).hide()
    with asked(save_file=os.path.join(FOLDER, "macro.xlsx"), warn=None):
        command("WriteSchedule")
    # Both tell of M1 and M3, whose plates are not laid flat.
    with asked(save_file=os.path.join(FOLDER, "figures.json"), warn=None):
        command("Report")
    with asked(folder=os.path.join(FOLDER, "package"), warn=None):
        command("ExportPackage")
    steps.picture("all_commands")
    lines = [line for line in recorded()[start:] if line and not line.startswith(("#", "Gui."))]
    return {
        "shown": session.shown,
        "undo": session.undo,
        "names": document.UndoNames,
        "lines": lines,
        "figures": figures(document),
    }


def _align(value):
    field("alignment").choose(value)


def _saddles():
    retype(field("SaddleSpacing"), "1.5 m")


def _joint():
    from BendTorsionWB.gui.split_scene import PlateItem

    view = FreeCADGui.getMainWindow().findChildren(QtGui.QGraphicsView)[-1]
    panel = next(i for i in view.scene().items() if isinstance(i, PlateItem)).panel
    panel.add_joint("top", 5000.0)


def opened():
    """A schedule and a template, each a new document, by lines of a macro."""
    start = len(recorded())
    with asked(open_file=os.path.join(FOLDER, "macro.xlsx"), choice="without drawing sheets"):
        shown = run("ImportSchedule")
    imported = figures(FreeCAD.ActiveDocument)
    path = os.path.join(FOLDER, "template.FCStd")
    with asked(choice="one member on a dome, with a section change", save_file=path):
        shown += run("Example")
    lines = [line for line in recorded()[start:] if line and not line.startswith(("#", "Gui."))]
    return {"shown": shown, "lines": lines, "imported": imported}


def two_documents():
    """Lines about two documents in one step, each the active one when it is its turn."""
    from BendTorsionWB.gui import macro

    former, start = FreeCAD.ActiveDocument, len(recorded())
    one, two = FreeCAD.newDocument("One"), FreeCAD.newDocument("Two")
    FreeCAD.setActiveDocument(one.Name)
    with macro.recorded(one):
        for document, name in ((one, "First"), (two, "Second"), (one, "Third")):
            FreeCAD.setActiveDocument(document.Name)
            with macro.recorded(document):
                macro.run(f"document.addObject('App::FeaturePython', {name!r})")
    with macro.undo_step(two, "Step"), macro.recorded(two):
        macro.run("document.addObject('App::FeaturePython', 'Fourth')")
    seen = {own.Name: [obj.Name for obj in own.Objects] for own in (one, two)}
    seen["lines"] = [line for line in recorded()[start:] if line.startswith("document")]
    for document in (one, two):
        FreeCAD.closeDocument(document.Name)
    FreeCAD.setActiveDocument(former.Name)
    return seen


steps.run(all_commands, opened, two_documents)
