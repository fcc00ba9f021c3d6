# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: what refused, undone and repeated commands leave behind; what is
told of what is not written; menus of a right click; read-only files and broken workbooks."""

import contextlib
import os
import sys
import zipfile

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps
from commands_aids import whole_document
from hands import answered, asked, field, named, press, retype, run, select, trigger, window
from macro_base import base, figures
from right_click import tree_menu, view_menu

FOLDER = os.path.dirname(os.environ["BENDTORSION_WINDOW_RESULT"])


def state(document):
    """What work that was refused leaves alone; pictures in the tree as they are drawn."""
    steps.settle(8)
    return {
        "labels": sorted(o.Label for o in document.Objects),
        "touched": sorted(o.Label for o in document.Objects if "Touched" in o.State),
        "invalid": sorted(o.Label for o in document.Objects if not o.isValid()),
        "undo": document.UndoNames,
        "icons": icons(),
        "tree": sorted(steps.tree_items()),
        "shown": sorted(o.Label for o in document.Objects if o.ViewObject.Visibility),
        "findings": {o.Label: o.Findings for o in document.Objects if hasattr(o, "BT_Type")},
    }


def icons():
    """By label: the picture of an object in the tree, badges and all."""
    found = {}
    for _, at in steps.tree_rows():
        image = QtGui.QIcon(at.data(QtCore.Qt.DecorationRole)).pixmap(32, 32).toImage()
        buffer = QtCore.QBuffer()
        buffer.open(QtCore.QIODevice.WriteOnly)
        image.save(buffer, "PNG")
        found[at.data()] = bytes(buffer.data()).hex()
    return found


def differing(before, after):
    """Which parts of two states differ, and how."""
    found = {}
    for key, value in before.items():
        if after[key] != value:
            found[key] = [value, after[key]]
            if isinstance(value, dict):
                other = after[key]
                found[key] = sorted(n for n in {**value, **other} if value.get(n) != other.get(n))
    return found


def refused():
    """Commands for several members of which one cannot be: nothing of it stays."""
    document = whole_document("Refused")
    from BendTorsionWB import make

    third = make.make_axis(document, "M3-axis", named("Ground"), ((0, 9000, 0), (4000, 9000, 0)))
    member = make.make_member(document, "M3", third, [named("B")])
    make.make_plates(document, member, {"top": [90000.0]})
    document.recompute()
    document.clearUndos()
    seen = {"in error": named("M3 plates").Status}
    for command in ("Development", "AssemblyBed"):
        before = state(document)
        select(named("M2"), named("M3"))
        said = run(command)
        select()
        seen[command] = [said, differing(before, state(document))]
    steps.picture("refused")
    with _no_pattern_of("M2"):
        select(named("M2 plates"), named("M1 bed"), named("M3"))
        named("M3 plates").JointsTop = []
        document.recompute()
        before = state(document)
        said = run("Development")
    select()
    seen["patterns"] = [said, differing(before, state(document))]
    select(member)
    run("Plates")
    press("Cancel")
    select()
    seen["cancelled"] = differing(before, state(document))
    FreeCAD.closeDocument("Refused")
    return seen


@contextlib.contextmanager
def _no_pattern_of(label):
    """The plates of a member that can be made and not be laid flat."""
    from BendTorsionWB.core.finding import BendTorsionError, error
    from BendTorsionWB.objects.unfold import Unfold

    build = Unfold.build

    def refuse(self, obj):
        if obj.Plates.Member.Label == label:
            raise BendTorsionError(error("no-pattern", label, "cannot be laid flat", "widen it"))
        return build(self, obj)

    Unfold.build = refuse
    try:
        yield
    finally:
        Unfold.build = build


def _yes(dialog):
    """Delete what others depend on: FreeCAD 1.1 has it asked with No as the answer of Enter."""
    box = dialog.findChild(QtGui.QDialogButtonBox)
    if box is None:
        # Another, as of what is computed meanwhile, or not found: PySide knows widgets by address.
        answered(_yes)
        return
    box.button(QtGui.QDialogButtonBox.Yes).click()


def undone():
    """Deleted as by the key, and undone and redone: all is computed, and shown as it was."""
    document = whole_document("Undone")
    before = state(document)
    seen = {}
    for label in ("M1", "M1 plates", "B", "Ground", "M1-axis", "M1 patterns"):
        document.clearUndos()
        select(named(label))
        answered(_yes)
        trigger("Std_Delete")
        gone = not document.getObjectsByLabel(label)
        deleted = state(document)
        trigger("Std_Undo")
        steps.settle(8)
        seen[label] = {"gone": gone, "undone": differing(before, state(document))}
        trigger("Std_Redo")
        steps.settle(8)
        seen[label]["redone"] = differing(deleted, state(document))
        trigger("Std_Undo")
        steps.settle(8)
        seen[label]["undone again"] = differing(before, state(document))
    select(named("B"))
    run("Section")
    retype(field("Height"), "600 mm")
    press("Ok")
    select()
    trigger("Std_Undo")
    steps.settle(8)
    seen["edit"] = {"undone": differing(before, state(document))}
    select(named("M2"))
    run("AssemblyBed")
    press("Ok")
    select()
    made = state(document)
    for name in ("Std_Undo", "Std_Redo"):
        trigger(name)
        steps.settle(8)
    seen["made"] = {"redone": differing(made, state(document))}
    FreeCAD.closeDocument("Undone")
    return seen


def redone():
    """An edit, a panel that is left as it was opened, undo and redo."""
    document = whole_document("Redone")
    seen = {}
    for command, label in (("Section", "B"), ("Member", "M1"), ("Surface", "Ground")):
        document.clearUndos()
        select(named("B"))
        run("Section")
        retype(field("Height"), "600 mm")
        press("Ok")
        select(named(label))
        run(command)
        press("Cancel")
        undos = list(document.UndoNames)
        trigger("Std_Undo")
        steps.settle(8)
        height = named("B").Height.Value
        redos = list(document.RedoNames)
        trigger("Std_Redo")
        steps.settle(8)
        again = named("B").Height.Value
        open_still = FreeCAD.getActiveTransaction()
        seen[command] = [undos, height != 600.0, redos, again, open_still]
        trigger("Std_Undo")
        steps.settle(8)
    FreeCAD.closeDocument("Redone")
    return seen


def sections():
    """Members made again with the same sizes, with others, and beside a section that is bound."""
    document = base("Sections")
    made = []

    def answer(height):
        def fill(dialog):
            dialog.fields["h"].setProperty("rawValue", height)
            dialog.accept()

        answered(fill)

    for arc, height in (("Arc1", 700.0), ("Arc2", 700.0), ("Branch", 800.0)):
        select((document.Ball, "Face1"), document.getObject(arc))
        answer(height)
        run("MembersFromSelection")
        member = [o for o in document.Objects if getattr(o, "BT_Type", "") == "Member"][-1]
        made.append([member.Label, member.Section1.Label])
    seen = {"made": made}
    seen["undo"] = document.UndoNames
    first = named("Section")
    document.clearUndos()
    first.setExpression("Height", "350 mm * 2")
    document.recompute()
    select((document.Ball, "Face1"), document.Arc2)
    answer(700.0)
    run("MembersFromSelection")
    seen["bound"] = named("M4").Section1.Label
    FreeCAD.closeDocument("Sections")
    return seen


def left_out():
    """Package and report of a document with a member without patterns: said by the command."""
    from BendTorsionWB.gui import ask

    document = whole_document("LeftOut")
    warned = []
    warn, ask.warn = ask.warn, warned.append
    package = os.path.join(FOLDER, "left_out")
    with asked(folder=package):
        shown = run("ExportPackage")
    said = window().statusBar().currentMessage()
    with asked(save_file=os.path.join(FOLDER, "left_out.json")):
        shown += run("Report")
    ask.warn = warn
    with open(os.path.join(package, "README.txt"), encoding="utf-8") as file:
        readme = file.read()
    FreeCAD.closeDocument(document.Name)
    return {"shown": shown, "said": said, "warned": warned, "readme": readme}


def read_only():
    """Files that must not be written over; each command says so and leaves the file."""
    document = whole_document("ReadOnly")
    seen = {}
    for name, ending in (
        ("Report", ".json"),
        ("Report", ".xlsx"),
        ("WriteSchedule", ".xlsx"),
        ("SupportBundle", ".zip"),
    ):
        path = os.path.join(FOLDER, f"{name}_kept{ending}")
        with open(path, "w", encoding="utf-8") as file:
            file.write("kept")
        os.chmod(path, 0o444)
        with asked(save_file=path):
            said = run(name)
        with open(path, encoding="utf-8") as file:
            kept = file.read() == "kept"
        seen[f"{name} {ending}"] = [said, kept]
    from BendTorsionWB.gui import ask

    package = os.path.join(FOLDER, "kept_package")
    warn, ask.warn = ask.warn, lambda text: None
    with asked(folder=package):
        seen["first"] = run("ExportPackage")
    path = os.path.join(package, "report.json")
    with open(path, "rb") as file:
        content = file.read()
    os.chmod(path, 0o444)
    named("B").Height = 510
    document.recompute()
    with asked(folder=package):
        said = run("ExportPackage")
    ask.warn = warn
    with open(path, "rb") as file:
        seen["package"] = [said, file.read() == content]
    FreeCAD.closeDocument(document.Name)
    return seen


def round_trip():
    """The schedule written and read in the window says the same of every member; workbooks that
    are cut short, empty, of something else or not there are told and open nothing."""
    from BendTorsionWB import make

    document = whole_document("RoundTrip")
    make.make_unfold(document, named("M2 plates"))
    document.recompute()
    path = os.path.join(FOLDER, "trip.xlsx")
    with asked(save_file=path, warn=None):
        seen = {"written": run("WriteSchedule")}
    wanted = figures(document)
    with asked(open_file=path, choice="without drawing sheets"):
        seen["read"] = run("ImportSchedule")
    back = FreeCAD.ActiveDocument
    shown = {o.Label: o.ViewObject.Visibility for o in back.Objects if hasattr(o, "BT_Type")}
    seen["shown"] = [shown["M1"], shown["M1 plates"]]
    found = figures(back)
    kinds = ("Axis", "Member", "PlateSet", "Unfold", "SectionSpec", "Surface")
    seen["wanted"] = {k: v for k, v in wanted.items() if v[0] in kinds}
    seen["found"] = {k: v for k, v in found.items() if v[0] in kinds}
    again = os.path.join(FOLDER, "again.xlsx")
    with asked(save_file=again, warn=None):
        seen["written again"] = run("WriteSchedule")
    seen["sheets"] = [_tables(path), _tables(again)]
    with open(path, "rb") as file:
        whole = file.read()
    broken = {
        "half": whole[: len(whole) // 2],
        "empty": b"",
        "folder": None,
        "words": b"not a workbook",
        "zip": None,
        "cells": None,
        "gone": None,
    }
    documents = sorted(FreeCAD.listDocuments())
    seen["broken"] = {}
    for name, content in broken.items():
        book = os.path.join(FOLDER, f"{name}.xlsx")
        if content is not None:
            with open(book, "wb") as file:
                file.write(content)
        if name == "folder":
            os.mkdir(book)
        if name == "zip":
            with zipfile.ZipFile(book, "w") as archive:
                archive.writestr("words.txt", "no workbook")
        if name == "cells":
            _spoiled(path, book)
        with asked(open_file=book, choice="without drawing sheets"):
            said = run("ImportSchedule")
        seen["broken"][name] = [said, sorted(FreeCAD.listDocuments()) == documents]
    for name in ("RoundTrip", back.Name):
        FreeCAD.closeDocument(name)
    return seen


def _tables(path):
    """The sheets of a workbook as text; nodes got their place when they were read."""
    import openpyxl

    book = openpyxl.load_workbook(path)
    return {sheet.title: repr(list(sheet.values)) for sheet in book if sheet.title != "Nodes"}


def _spoiled(path, book):
    """A workbook with a member whose axis is not there."""
    import openpyxl

    whole = openpyxl.load_workbook(path)
    sheet = whole["Members"]
    column = [cell.value for cell in sheet[1]].index("axis") + 1
    sheet.cell(2, column).value = "nowhere"
    whole.save(book)


def menus():
    """What a right click offers, in the tree and in the view, and what one of its entries does."""
    document = whole_document("Menus")
    tree, seen = steps.document_tree(), {"tree": {}}
    for label in ("M1", "M1 plates", "M1 patterns", "M1-axis", "B", "N1", "M1 sheets"):
        select(named(label))
        steps.settle(2)
        seen["tree"][label] = tree_menu(tree, label)
    select()
    seen["tree"][""] = tree_menu(tree, "")
    for label in ("M1", "M1 plates", "M1 patterns", "M1-axis", ""):
        select(*([named(label)] if label else []))
        steps.settle(2)
        seen.setdefault("view", {})[label] = view_menu()
    select(named("M1 plates"))
    tree_menu(tree, "M1 plates", choose="Assembly bed")
    steps.settle(5)
    seen["chosen"] = bool(FreeCADGui.Control.activeDialog())
    press("Cancel")
    select(named("M1"))
    before = [o.ViewObject.Visibility for o in (named("M1"), named("M1 plates"))]
    tree_menu(tree, "M1", choose="Show outer skin")
    steps.settle(5)
    after = [o.ViewObject.Visibility for o in (named("M1"), named("M1 plates"))]
    seen["skin"] = [before, after]
    FreeCAD.closeDocument(document.Name)
    return seen


STEPS = (refused, undone, redone, sections, left_out, read_only, round_trip, menus)
chosen = os.environ.get("BENDTORSION_WINDOW_ONLY", "").split()
steps.run(*(one for one in STEPS if not chosen or one.__name__ in chosen))
