# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: files written, stopped, refused; schedules and examples opened."""

import contextlib
import os
import sys
from pathlib import Path

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


@contextlib.contextmanager
def documents_seen():
    """The lines of documents that the tree shows at any moment meanwhile."""
    seen, watch = set(), QtCore.QTimer()
    opened = set()

    def look():
        tree, lines = steps.document_tree(), list(steps.tree_rows())
        level = 1 if lines and lines[0][1].data() == "Application" else 0
        lines = [at for depth, at in lines if depth == level]
        seen.update(at.data() for at in lines if not tree.isRowHidden(at.row(), at.parent()))
        opened.update(FreeCAD.listDocuments())

    watch.timeout.connect(look)
    watch.start(0)
    try:
        yield seen
    finally:
        watch.stop()
    assert len(opened) > 1, "no document was opened that could have been seen"


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
    tree = steps.document_tree()
    # *Description*: hidden by default from FreeCAD 1.0 on, where labels alone have all the width.
    tree.header().showSection(1)
    tree.expandAll()
    steps.settle()
    widths = []
    watch = QtCore.QTimer()
    watch.timeout.connect(lambda: widths.append(tree.columnWidth(0)))
    watch.start(5)
    with asked(folder=package), documents_seen() as seen:
        result["package_shown"] = run("ExportPackage")
    steps.settle(12)
    watch.stop()
    follows = tree.header().sectionResizeMode(0) == QtGui.QHeaderView.ResizeToContents
    result["tree"] = [len(widths), sorted(set(widths)), follows]
    result["seen"] = [sorted(seen), document.Label]
    result["package"] = sorted(os.listdir(package))
    result["plates"] = sorted(os.listdir(os.path.join(package, "plates")))
    result["marks"] = list(named("M1 plates").Marks)
    result["active"] = FreeCAD.ActiveDocument.Name == document.Name
    schedule = os.path.join(FOLDER, "back.xlsx")
    with asked(save_file=schedule, warn=None):
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


def losses():
    """What a schedule cannot say, told by the command: one section that no member has, and ten;
    the Report view, which a warning would open."""
    from BendTorsionWB import make
    from BendTorsionWB.gui import ask

    document, seen = small_document(), {}
    warn, report = ask.warn, window().findChild(QtGui.QDockWidget, "Report view")
    for first, count in ((0, 1), (1, 10)):
        for k in range(first, count):
            make.make_section(document, f"spare {k}", h=500, b=400, t=13 + k)
        warned = []
        document.recompute()
        ask.warn = warned.append
        before = steps.report_view()
        with asked(save_file=os.path.join(FOLDER, f"spare{count}.xlsx")):
            shown = run("WriteSchedule")
        said = window().statusBar().currentMessage()
        listed = steps.report_view().removeprefix(before).count("section spare 9")
        seen[count] = [shown, said, warned, report.isVisible(), listed]
    ask.warn = warn
    return seen


def expressions():
    """What the command tells of a section that follows a spreadsheet."""
    from BendTorsionWB.gui import ask

    document, warn, warned = small_document(), ask.warn, []
    section = next(o for o in document.Objects if getattr(o, "BT_Type", "") == "SectionSpec")
    document.addObject("Spreadsheet::Sheet", "Sizes").set("A1", "=12 mm")
    section.setExpression("Thickness", "Sizes.A1")
    member = next(o for o in document.Objects if getattr(o, "BT_Type", "") == "Member")
    member.setExpression("OffsetY", "Sizes.A1 - 12 mm")
    document.recompute()
    ask.warn = warned.append
    with asked(save_file=os.path.join(FOLDER, "bound.xlsx")):
        run("WriteSchedule")
    ask.warn = warn
    return [warned, section.Label, member.Label]


def split():
    """What writes the members of a document, in the one that links to those of a split model."""
    from BendTorsionWB.model_files import ModelPart, write_linked_model

    former, folder = FreeCAD.ActiveDocument, Path(FOLDER) / "split"
    (folder / "model").mkdir(parents=True)
    document = small_document()
    document.addObject("App::LinkGroup", "Plates")
    document.saveAs(str(folder / "model" / "001.FCStd"))
    FreeCAD.closeDocument(document.Name)
    write_linked_model([ModelPart("model/001", ("M1",))], folder / "model.FCStd", 1)
    whole = FreeCAD.openDocument(str(folder / "model.FCStd"))
    seen = {name: run(name) for name in ("WriteSchedule", "ExportPackage", "Report")}
    for name in {*FreeCAD.listDocuments()} & {whole.Name, "001", "_001"}:
        FreeCAD.closeDocument(name)
    FreeCAD.setActiveDocument(former.Name)
    return seen


steps.run(output, losses, expressions, split)
