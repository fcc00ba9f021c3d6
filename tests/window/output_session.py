# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: files written, stopped, refused; schedules and examples opened."""

import os
import sys

import FreeCAD
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from hands import asked, named, press, run, select, window

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def small_document():
    """One short member on a plane, with plates."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument("Output")
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (2500, 0, 0)])
    section = make.make_section(document, "B500", h=500, b=400, t=12)
    make.make_plates(document, make.make_member(document, "M1", axis, [section]))
    document.recompute()
    document.clearUndos()
    return document


def output():
    """Development, bed, sheets; a package stopped and written; schedule, report; read-only."""
    document = small_document()
    select(named("M1"))
    shown = run("Development")
    press("Ok")
    select(named("M1"))
    shown += run("AssemblyBed")
    press("Ok")
    shown += run("Sheets")
    result = {"shown": shown, "undo": document.UndoNames[:3]}
    stopped = os.path.join(FOLDER, "stopped")
    bars = []
    watch = QtCore.QTimer()

    def stop():
        for bar in window().findChildren(QtGui.QProgressDialog):
            if bar.isVisible() and bar.value() > 2:
                bars.append(bar.labelText())
                bar.cancel()

    watch.timeout.connect(stop)
    watch.start(5)
    with asked(folder=stopped):
        result["stopped_shown"] = run("ExportPackage")
    watch.stop()
    result["bars"] = bars[:1]
    result["stopped"] = sorted(os.listdir(stopped)) if os.path.isdir(stopped) else []
    package = os.path.join(FOLDER, "package")
    with asked(folder=package):
        result["package_shown"] = run("ExportPackage")
    result["package"] = sorted(os.listdir(package))
    result["plates"] = sorted(os.listdir(os.path.join(package, "plates")))
    result["marks"] = list(named("M1 plates").Marks)
    result["active"] = FreeCAD.ActiveDocument.Name == document.Name
    schedule = os.path.join(FOLDER, "back.xlsx")
    with asked(save_file=schedule):
        result["schedule"] = [run("WriteSchedule"), os.path.exists(schedule)]
    with asked(save_file="/proc/nowhere/back.xlsx"):
        result["read_only"] = run("WriteSchedule")
    book = os.path.join(FOLDER, "figures.xlsx")
    with asked(save_file=book):
        result["report"] = [run("Report"), os.path.exists(book)]
    with asked(open_file=schedule, choice="without drawing sheets"):
        result["import_shown"] = run("ImportSchedule")
    back = FreeCAD.ActiveDocument
    result["import"] = {
        item.Label: item.Shape.Volume
        for item in back.Objects
        if getattr(item, "BT_Type", "") == "PlateSet"
    }
    result["wanted"] = {"M1 plates": named("M1 plates", document).Shape.Volume}
    bad = os.path.join(FOLDER, "bad.xlsx")
    with open(bad, "w", encoding="utf-8") as file:
        file.write("no workbook")
    count = len(FreeCAD.listDocuments())
    with asked(open_file=bad, choice="without drawing sheets"):
        result["bad_schedule"] = run("ImportSchedule")
    example = os.path.join(FOLDER, "example.FCStd")
    with asked(choice="one member on a dome, with a section change", save_file=example):
        result["example"] = [run("Example"), FreeCAD.ActiveDocument.FileName == example]
    result["documents"] = len(FreeCAD.listDocuments()) - count
    steps.picture("example")
    return result


steps.run(output)
