# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: seconds of what users wait for (see benchmarks/window.py)."""

import os
import statistics
import sys
import time

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps

EDITS = 7


def spent(action):
    """Wall and processor seconds of an action and of drawing what it changed."""
    wall, cpu = time.perf_counter(), time.process_time()
    action()
    QtGui.QApplication.processEvents()
    view = FreeCADGui.ActiveDocument.ActiveView if FreeCADGui.ActiveDocument else None
    if hasattr(view, "redraw"):
        view.redraw()
    return {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}


def activation():
    """What the first opening of the workbench took, before the steps."""
    return ACTIVATION


def edit():
    """A section's height to values never seen before: the median, and where the time goes."""
    from BendTorsionWB import make
    from BendTorsionWB.objects import member, plate_set, section_spec

    parts = {}
    for kind in (section_spec.SectionSpec, member.Member, plate_set.PlateSet):
        traced(kind, "execute", f"{kind.TYPE} computed", parts)
    document = FreeCAD.newDocument("Edit")
    hall = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    xs = (-12000.0, -6000.0, 0.0, 6000.0, 12000.0)
    points = [
        (x, 0.3 * x, 20000 * (1 - (x / 40000) ** 2 - (0.3 * x / 30000) ** 2) ** 0.5) for x in xs
    ]
    axis = make.make_axis(document, "A1", hall, points)
    section = make.make_section(document, "B", h=600, b=500, t=16)
    target = make.make_member(document, "M1", axis, [section])
    joints = {
        face: [5000 + k, 10000 + k, 15000 + k, 20000 + k]
        for k, face in zip((0, 400, 800, 1200), ("top", "bottom", "left", "right"), strict=True)
    }
    plates = make.make_plates(document, target, joints)
    document.recompute()
    hall.ViewObject.Visibility = target.ViewObject.Visibility = False
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.settle()
    runs = []
    for k in range(EDITS):
        section.Height = 620 + 7 * k
        parts.clear()
        runs.append(spent(document.recompute) | {"parts": dict(parts)})
    middle = sorted(runs, key=lambda one: one["cpu"])[EDITS // 2]
    known = sum(middle["parts"].values())
    middle["parts"]["display and FreeCAD"] = middle["cpu"] - known
    middle["wall"] = statistics.median(one["wall"] for one in runs)
    middle["note"] = f"{plates.PlateCount} plates, median of {EDITS} edits"
    return middle


def traced(kind, name, label, parts):
    """Add the processor time of a method to parts."""
    function = getattr(kind, name)

    def timed(self, *given):
        start = time.process_time()
        try:
            return function(self, *given)
        finally:
            parts[label] = parts.get(label, 0.0) + time.process_time() - start

    setattr(kind, name, timed)


def open_model():
    """Open a saved model and draw it."""
    for name in list(FreeCAD.listDocuments()):
        FreeCAD.closeDocument(name)
    path = os.environ["BENDTORSION_WINDOW_MODEL"]
    result = spent(lambda: (FreeCAD.openDocument(path), FreeCADGui.SendMsgToActiveView("ViewFit")))
    result["note"] = f"{len(FreeCAD.ActiveDocument.Objects)} objects"
    return result


def first_marks():
    """Marks of all plates for the first time since the model was opened."""
    FreeCADGui.Selection.clearSelection()
    found = spent(lambda: FreeCADGui.runCommand("BendTorsion_ShowMarks"))
    plates = [o for o in FreeCAD.ActiveDocument.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
    count = sum(len(item.ViewObject.Proxy.labels.labels) for item in plates)
    FreeCADGui.runCommand("BendTorsion_ShowMarks")
    return found | {"note": f"{count} marks"}


def turn():
    """Turn the view of the model: the mean of ten turns, and the slowest, where it stalls."""
    view = FreeCADGui.ActiveDocument.ActiveView
    turns = [spent(view.viewIsometric if k % 2 else view.viewFront) for k in range(10)]
    found = {name: statistics.mean(one[name] for one in turns) for name in ("wall", "cpu")}
    slowest = max(turns, key=lambda one: one["wall"])
    return found | {"note": f"slowest {slowest['wall']:.3f} s, {slowest['cpu']:.3f} s cpu"}


def turn_labelled():
    """Turn it with every label and the ribbons of all frames on."""
    for item in FreeCAD.ActiveDocument.Objects:
        kind = getattr(item, "BT_Type", "")
        if kind == "PlateSet":
            item.ViewObject.ShowMarks = item.ViewObject.ShowPoints = True
        if kind == "Axis":
            item.ViewObject.Visibility = item.ViewObject.ShowFrames = True
    steps.settle()
    plates = [o for o in FreeCAD.ActiveDocument.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
    count = sum(len(item.ViewObject.Proxy.labels.labels) for item in plates)
    found = turn()
    return found | {"note": f"{count} labels, ribbons of all axes; {found['note']}"}


def open_page():
    """Open the first drawing page of the model, which waits until then."""
    pages = [o for o in FreeCAD.ActiveDocument.Objects if o.isDerivedFrom("TechDraw::DrawPage")]
    drawn = sum(page.KeepUpdated for page in pages)
    result = spent(pages[0].ViewObject.doubleClicked)
    return result | {"note": f"{len(pages)} pages, {drawn} drawn before"}


def first_minute():
    """Members from a face and three curves of a STEP file: opened, made, drawn; what a user has to
    wait for, the dialog apart."""
    import ImportGui
    import Part

    from BendTorsionWB.gui import commands_model, section_dialog, selection

    path = os.path.join(os.environ["HOME"], "roof.step")
    arcs = [
        Part.makeCircle(20000, FreeCAD.Vector(), FreeCAD.Vector(0, tilt, 30), 20, 60)
        for tilt in (10, 20, 30)
    ]
    roof = Part.makeSphere(20000).Faces[0]
    Part.makeCompound([roof, *arcs]).exportStep(path)
    parts = {}

    def step(label, action):
        start = time.process_time()
        found = action()
        parts[label] = time.process_time() - start
        return found

    def everything():
        document = FreeCAD.newDocument("Minute")
        step("STEP file read", lambda: ImportGui.insert(path, "Minute"))
        shape = next(o for o in document.Objects if getattr(o, "Shape", None) and o.Shape.Faces)
        own = len(shape.Shape.Faces[0].Edges)
        edges = [f"Edge{k}" for k in range(own + 1, len(shape.Shape.Edges) + 1)]
        FreeCADGui.Selection.clearSelection()
        for name in ("Face1", *edges):
            FreeCADGui.Selection.addSelection("Minute", shape.Name, name)
        surface, curves = step(
            "selection sorted", lambda: selection.surface_and_curves(selection.picked())
        )
        choice = section_dialog.SectionChoice("box1", 600.0, 500.0, 16.0, "centre", 1)
        step(
            "members made",
            lambda: commands_model.make_members(document, surface, curves, choice),
        )
        FreeCADGui.SendMsgToActiveView("ViewFit")

    result = spent(everything)
    made = [o for o in FreeCAD.ActiveDocument.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
    FreeCAD.closeDocument("Minute")
    return result | {"parts": parts, "note": f"{len(made)} members"}


ACTIVATION = {}
activate = FreeCADGui.activateWorkbench


def timed_activation(name):
    """The first time the workbench is opened."""
    found = spent(lambda: activate(name))
    ACTIVATION.update(ACTIVATION or found)


FreeCADGui.activateWorkbench = timed_activation
steps.run(activation, edit, first_minute, open_model, first_marks, turn, turn_labelled, open_page)
