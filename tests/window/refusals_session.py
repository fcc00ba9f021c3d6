# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: what must not happen. Too much selected, deletion under a panel or
a dock, read-only files, closing during a run, documents saved without the workbench."""

import os
import sys
import zipfile

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import member_document, whole_document
from hands import asked, field, named, press, retype, run, select, trigger, window

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def dock(name):
    """A dock of the workbench."""
    return window().findChild(QtGui.QDockWidget, f"BendTorsion_{name}")


def panel_open():
    """Whether a task panel is open."""
    return bool(FreeCADGui.Control.activeDialog())


def several():
    """Two of a kind selected where a panel edits one."""
    document = whole_document("Several")
    from BendTorsionWB import make

    make.make_section(document, "C", h=300, b=300, t=10)
    document.recompute()
    names = ("Plates", "Splits", "Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds")
    shown = {}
    for name in (*names, "Member"):
        select(named("M1 plates"), named("M2"))
        shown[name] = [*run(name), panel_open()]
    select(named("B"), named("C"))
    shown["Section"] = [*run("Section"), panel_open()]
    select(named("M1"))
    shown["Surface"] = [*run("Surface"), panel_open()]
    select(named("Ground"))
    run("Surface")
    edited = panel_open(), len(document.Objects)
    press("Cancel")
    select(named("M1 bed"))
    of_bed = run("Sheets"), panel_open()
    press("Cancel")
    return {"shown": shown, "surface": [*edited, len(document.Objects)], "of_bed": of_bed}


def held():
    """Delete and undo while a panel is open; another command that ends its trial."""
    document, section = FreeCAD.ActiveDocument, named("B")
    document.clearUndos()
    main = next(d for d in window().findChildren(QtGui.QDockWidget) if d.isVisible())
    steps.narrow(270)
    steps.settle(4)
    widths = [main.width()]
    select(section)
    run("Section")
    retype(field("Height"), "600 mm")
    steps.settle(8)
    widths.append(main.width())
    select(section)
    seen = {}
    for name in ("Std_Delete", "Std_Undo"):
        trigger(name)
        seen[name] = [section.Height.Value, panel_open()]
    seen["told"] = []
    for key in (QtCore.Qt.Key_Home, QtCore.Qt.Key_Delete):
        window().statusBar().clearMessage()
        event = QtGui.QKeyEvent(QtCore.QEvent.ShortcutOverride, key, QtCore.Qt.NoModifier)
        event.ignore()
        QtGui.QApplication.sendEvent(window().centralWidget(), event)
        seen["told"].append(window().statusBar().currentMessage())
    press("Cancel")
    steps.settle(6)
    seen["widths"] = [*widths, main.width()]
    seen["cancelled"] = [section.Height.Value, document.UndoNames]
    FreeCADGui.Selection.clearSelection()
    for label in ("B", ""):
        count = len(document.Objects)
        if label:
            select(named(label))
        run("Section")
        retype(field("Height"), "610 mm")
        steps.settle(6)
        document.openTransaction("Another")
        named("C").Label2 = f"noted {label}"
        document.commitTransaction()
        press("Cancel")
        seen[f"another {label}"] = [section.Height.Value, len(document.Objects) - count]
        FreeCADGui.Selection.clearSelection()
    document.clearUndos()
    for label, command in (("M2 plates", "Plates"), ("M2", "Member"), ("B", "Section")):
        select(named(label))
        run(command)
        document.removeObject(named(label).Name)
        steps.settle(6)
        gone = not document.getObjectsByLabel(label)
        document.undo()
        document.recompute()
        steps.settle(3)
        seen[f"deleted {label}"] = [panel_open(), gone, bool(document.getObjectsByLabel(label))]
    select(named("C"))
    run("Section")
    FreeCADGui.Control.closeDialog()
    steps.settle(14)
    trigger("Std_Delete")
    seen["deletes again"] = not document.getObjectsByLabel("C")
    return seen


def docks():
    """Objects deleted while both docks show them; undone."""
    document = FreeCAD.ActiveDocument
    run("MemberTable")
    run("Check")
    table, found = dock("MemberTable").table, dock("FindingsPanel").table
    seen = {}
    for label in ("B", "Ground", "M2", "M1 plates"):
        document.openTransaction("Delete")
        document.removeObject(named(label).Name)
        document.commitTransaction()
        document.recompute()
        steps.settle(4)
        seen[label] = {
            "rows": [table.item(r, 0).text() for r in range(table.rowCount())],
            "sections": [table.item(r, 2).text() for r in range(table.rowCount())],
            "errors": [found.item(r, 3).text() for r in range(found.rowCount())],
        }
        document.undo()
        document.recompute()
        steps.settle(4)
        seen[label]["undone"] = [table.rowCount(), found.rowCount()]
    FreeCAD.closeDocument(document.Name)
    steps.settle(4)
    seen["closed"] = [table.rowCount(), found.rowCount()]
    return seen


def segments():
    """Rows added and taken away in the table; texts that have no cell."""
    document = member_document("Segments")
    run("MemberTable")
    table, member = dock("MemberTable").table, named("M1")
    member.CutRatio3 = 0.75
    document.recompute()
    document.clearUndos()
    steps.settle(4)

    def press_key(code, modifiers=QtCore.Qt.NoModifier):
        event = QtGui.QKeyEvent(QtCore.QEvent.ShortcutOverride, code, modifiers)
        event.ignore()
        QtGui.QApplication.sendEvent(table, event)
        kept = event.isAccepted()
        press_ = QtGui.QKeyEvent(QtCore.QEvent.KeyPress, code, modifiers)
        QtGui.QApplication.sendEvent(table, press_)
        steps.settle(4)
        return kept

    def at(row, column):
        table.clearSelection()
        table.setCurrentCell(row, column)

    at(1, 2)
    kept = [press_key(QtCore.Qt.Key_Insert)]
    seen = {"added": [member.Segments, member.Cut3.Value, table.rowCount(), document.UndoNames]}
    seen["length"] = member.Length.Value
    at(2, 2)
    kept.append(press_key(QtCore.Qt.Key_Delete, QtCore.Qt.ControlModifier))
    seen["removed"] = [member.Segments, member.Cut2.Value, len(document.UndoNames)]
    document.undo()
    document.recompute()
    seen["undone"] = member.Segments
    document.undo()
    document.recompute()
    steps.settle(4)
    at(0, 3)
    QtGui.QApplication.clipboard().setText("100\t3\n5100\t3.5" + 6 * "\n")
    select(named("B600"))
    kept.append(press_key(QtCore.Qt.Key_V, QtCore.Qt.ControlModifier))
    seen["pasted"] = [member.Cut2.Value, member.Slope2, table.item(0, 3).toolTip()]
    seen["said"] = dock("MemberTable").said.text()
    steps.picture("table_left_out")
    at(5, 2)
    QtGui.QApplication.clipboard().setText("B800\nB600")
    table.paste()
    steps.settle(4)
    seen["beyond"] = [named("M2").Section3.Label, dock("MemberTable").said.text()]
    at(1, 12)
    kept.append(press_key(QtCore.Qt.Key_Delete))
    seen["kept"] = [*kept, bool(document.getObjectsByLabel("B600"))]
    while member.Segments > 1:
        at(1, 2)
        dock("MemberTable").remove()
    from BendTorsionWB.gui import command

    told = []
    command._show = told.append
    at(0, 2)
    dock("MemberTable").remove()
    seen["only one"] = [member.Segments, told]
    dock("MemberTable").hide()
    FreeCAD.closeDocument(document.Name)
    return seen


def read_only():
    """A document in a file that cannot be written is edited, exported and read as any other."""
    path = os.path.join(FOLDER, "read_only.FCStd")
    document = whole_document("ReadOnly")
    document.saveAs(path)
    FreeCAD.closeDocument(document.Name)
    os.chmod(path, 0o444)
    content = open(path, "rb").read()
    document = FreeCAD.openDocument(path)
    steps.settle()
    select(named("B"))
    run("Section")
    retype(field("Height"), "450 mm")
    press("Ok")
    seen = {"height": named("B").Height.Value, "undo": document.UndoNames}
    nowhere = "/proc/nowhere/there"
    with asked(folder=nowhere):
        seen["package"] = run("ExportPackage")
    for name, ending in (
        ("Report", ".json"),
        ("WriteSchedule", ".xlsx"),
        ("SupportBundle", ".zip"),
    ):
        with asked(save_file=nowhere + ending):
            seen[name] = run(name)
    # It tells of M2, whose plates are not laid flat.
    with asked(folder=os.path.join(FOLDER, "from_read_only"), warn=None):
        seen["written"] = run("ExportPackage")
    seen["same"] = open(path, "rb").read() == content
    FreeCAD.closeDocument(document.Name)
    return seen


def closed_in_a_run():
    """The document of a run is closed by something else; the window is told to close."""
    from BendTorsionWB.gui import commands_plates

    patience, commands_plates.PATIENCE = commands_plates.PATIENCE, 0.0
    seen = {}
    for what in ("document", "window"):
        document = whole_document("Run")
        bars = []

        def act(what=what, bars=bars):
            for bar in window().findChildren(QtGui.QProgressDialog):
                if bar.isVisible() and not bars:
                    bars.append(bar.labelText())
                    if what == "document":
                        FreeCAD.closeDocument("Run")
                    else:
                        # As the window manager does, not as a script: that closes it at once.
                        event = QtGui.QCloseEvent()
                        QtGui.QApplication.sendEvent(window().windowHandle(), event)

        watch = QtCore.QTimer()
        watch.timeout.connect(act)
        watch.start(1)
        select(named("M1"), named("M2"))
        shown = run("AssemblyBed")
        watch.stop()
        there = "Run" in FreeCAD.listDocuments()
        seen[what] = {
            "bars": len(bars),
            "shown": shown,
            "there": there,
            "visible": window().isVisible(),
            "made": there and bool(document.getObjectsByLabel("M2 bed")),
            "undo": document.UndoNames if there else [],
        }
        if there:
            FreeCAD.closeDocument("Run")
    commands_plates.PATIENCE = patience
    return seen


def saved_without():
    """Objects that lost what computes them: told, repaired; a bundle for a report."""
    seen = {}
    path = os.path.join(FOLDER, "bundle.zip")
    with asked(save_file=path):
        seen["without"] = [run("SupportBundle"), zipfile.ZipFile(path).namelist()]
    document = whole_document("Bare")
    seen["whole"] = [run("Repair"), document.UndoNames]
    ours = [item for item in document.Objects if hasattr(item, "BT_Type")]
    for item in ours:
        item.Proxy = None
    select(named("B"))
    seen["told"] = [run("Section"), panel_open()]
    named("B").Height = 620
    seen["repaired"] = [run("Repair"), document.UndoNames, len(ours)]
    seen["said"] = window().statusBar().currentMessage()
    seen["statuses"] = sorted({item.Status for item in ours if "Status" in item.PropertiesList})
    seen["height"] = named("M1 plates").Shape.BoundBox.ZLength
    with asked(save_file=path):
        seen["with"] = [run("SupportBundle"), zipfile.ZipFile(path).namelist()]
    seen["active"] = [FreeCAD.ActiveDocument.Name, list(FreeCAD.listDocuments())]
    FreeCAD.closeDocument("Bare")
    return seen


def colours():
    """Members of different thickness and curvature on one scale; nothing else is computed."""
    from BendTorsionWB import make
    from BendTorsionWB.gui import legend

    document = member_document("Colours")
    thick = make.make_section(document, "T", h=700, b=600, t=30)
    for k in (1, 2, 3):
        setattr(named("M2"), f"Section{k}", thick)
    unfold = make.make_unfold(document, named("M1 plates"))
    document.recompute()
    document.clearUndos()
    FreeCADGui.Selection.clearSelection()
    seen = {}
    for by in ("thickness", "curvature"):
        with asked(choice=by):
            run("ColourBy")
        found = legend.entries(document)
        seen[by] = [[name, list(lines), labels] for (name, lines), labels in found.items()]
        steps.picture(f"colour_{by}")
    plates = [named("M1 plates"), named("M2 plates")]
    seen["ranges"] = [list(item.ColourRange) for item in plates]
    seen["own"] = [max(item.Colours) for item in plates]
    seen["touched"] = [i.Label for i in document.Objects if "Touched" in i.State]
    seen["undo"] = document.UndoNames
    seen["patterns"] = unfold.Status
    for item in plates:
        item.touch()
    document.recompute()
    seen["kept"] = [list(item.ColourRange) for item in plates]
    FreeCAD.closeDocument("Colours")
    return seen


def hall():
    """The concert hall of the examples, here with a small schedule in its place."""
    from BendTorsionWB.gui import commands_files

    real = commands_files.resources.FOLDER / "examples" / commands_files.HALL
    whole, commands_files.HALL = commands_files.HALL, os.environ["BENDTORSION_WINDOW_SCHEDULE"]
    with asked(choice="concert hall, from its schedule"):
        shown = run("Example")
    commands_files.HALL = whole
    document = FreeCAD.ActiveDocument
    ours = [item for item in document.Objects if hasattr(item, "BT_Type")]
    return {
        "shown": shown,
        "real": real.is_file(),
        "statuses": sorted({item.Status for item in ours}),
        "members": sum(item.BT_Type == "Member" for item in ours),
        "seen": [i.ViewObject.Visibility for i in ours if i.BT_Type == "PlateSet"],
        "undo": document.UndoNames,
    }


steps.run(
    several,
    held,
    docks,
    segments,
    read_only,
    closed_in_a_run,
    saved_without,
    colours,
    hall,
)
