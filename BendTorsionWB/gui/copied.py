# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's Copy, Paste and Duplicate of members: what would stay behind is told and taken along on
request, and what was pasted is computed under the names it has there.

FreeCAD copies what an object depends on, not what depends on it: plates, patterns, bed, sheets and
nodes of a member stay behind. What it pastes it takes for computed, and a member whose name is
taken comes under another while its plates keep their marks.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterable
from contextlib import suppress

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask, tree
from BendTorsionWB.gui.progress import PATIENCE, Cancelled, progress
from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.recomputing import recompute_each

translate = FreeCAD.Qt.translate
COPIED = "application/x-documentobject"
"""What FreeCAD calls copied objects, a document in itself; `-file` added, the name of its file."""
OBJECT = re.compile(r'<Object type="[^"]*" name="(\w+)@(\w+)"')
OWN_NAME = re.compile(r".+ (plates|patterns|bed|sheets)\d*")
"""Labels that what follows a member gets by itself."""
STEPS = ("Paste", "Duplicate")
NAMED = 8
"""Objects that stay behind are named up to this many."""


class _Pasted:
    """Document observer: computes what is pasted and duplicated within the step; asks for what a
    duplicate left behind."""

    def __init__(self):
        self.before: dict[str, set[str]] = {}

    def slotOpenTransaction(self, document, name):
        """Called by FreeCAD when a step begins."""
        if name in STEPS:
            self.before[document.Name] = {obj.Name for obj in document.Objects}

    def slotBeforeCloseTransaction(self, abort):
        """Called by FreeCAD before a step ends: what is computed belongs to it, pages as well."""
        for where, before in () if abort else list(self.before.items()):
            document = FreeCAD.listDocuments().get(where)
            if document is not None and document.HasPendingTransaction:
                del self.before[where]
                compute(document, [obj for obj in document.Objects if obj.Name not in before])

    def slotCommitTransaction(self, document):
        """Called by FreeCAD when a step is done."""
        if document.UndoNames[:1] == ["Duplicate"]:
            where = document.Name
            QtCore.QTimer.singleShot(0, lambda: _after_duplicate(where))

    def slotAbortTransaction(self, document):
        """Called by FreeCAD when a step was taken back."""
        self.before.pop(document.Name, None)


def _after_duplicate(where: str) -> None:
    """Ask for what the Duplicate that was just done left behind."""
    document = FreeCAD.listDocuments().get(where)
    if document is None or document.UndoNames[:1] != ["Duplicate"]:
        return
    picked = FreeCADGui.Selection.getSelection(where)
    copies = [*picked, *(needed for obj in picked for needed in obj.OutListRecursive)]
    if wants(left := left_behind(picked, copies)):
        document.undo()
        _select(left)
        FreeCADGui.runCommand("Std_DuplicateSelection")


def compute(document, came: Iterable) -> None:
    """Name pasted objects of ours after the member they came with, and compute them."""
    for obj in came:
        if not hasattr(obj, "BT_Type"):
            continue
        above = tree.parents(obj)
        member = next((item for item in above if item.BT_Type == "Member"), None)
        word = OWN_NAME.fullmatch(obj.Label)
        if obj.BT_Type in tree.LINKED_ABOVE and member is not None and word:
            if not obj.Label.startswith(f"{member.Label} "):
                obj.Label = f"{member.Label} {word[1]}"
        obj.touch()
    # Stopped, they stay marked.
    with suppress(Cancelled), progress(translate("BendTorsion", "Paste"), PATIENCE) as report:
        recompute_each(document, report)


def left_behind(picked: Iterable, copied: Iterable) -> list:
    """What follows from picked members and is not copied with them: plates, patterns, beds, sheets,
    and nodes both members of which are picked. copied: all that is, what they depend on too."""
    taken = [obj for obj in picked if getattr(obj, "BT_Type", "") in {"Member", *tree.CLAIMED}]
    there = [*copied]
    left: list = []
    for obj in taken:
        for user in obj.InList:
            if user not in taken and _follows(user, taken):
                # Looked at in its turn.
                taken.append(user)
                left += [] if user in there else [user]
    return left


def _follows(obj, taken: list) -> bool:
    kind = getattr(obj, "BT_Type", "")
    if kind == "Node":
        return obj.Through in taken and obj.Other in taken
    return kind in tree.LINKED_ABOVE and getattr(obj, tree.LINKED_ABOVE[kind]) in taken


def wants(left: list) -> bool:
    """Whether the user wants what would stay behind as well; False for nothing."""
    if not left:
        return False
    names = ", ".join(obj.Label for obj in left[:NAMED])
    if len(left) > NAMED:
        more = translate("BendTorsion", "and {count} more").format(count=len(left) - NAMED)
        names = f"{names}, {more}"
    text = translate(
        "BendTorsion",
        "Not copied: {names}. FreeCAD copies what an object depends on, not what depends on it.",
    )
    return ask.offer(
        text.format(names=names),
        translate("BendTorsion", "Copy them as well"),
        translate("BendTorsion", "Leave them"),
    )


def _copied() -> list:
    """The objects on the clipboard, as far as their documents are open."""
    data = QtWidgets.QApplication.clipboard().mimeData()
    if data.hasFormat(COPIED):
        source = io.BytesIO(data.data(COPIED).data())
    elif data.hasFormat(f"{COPIED}-file"):
        source = data.data(f"{COPIED}-file").data().decode()
    else:
        return []
    try:
        with zipfile.ZipFile(source) as copied:
            text = copied.read("Document.xml").decode("utf-8")
    except (OSError, KeyError, zipfile.BadZipFile):
        return []
    documents = FreeCAD.listDocuments()
    found = OBJECT.findall(text)
    objects = [documents[where].getObject(name) for name, where in found if where in documents]
    return [obj for obj in objects if obj is not None]


def _after_copy() -> None:
    """Ask for what the Copy that was just done left behind."""
    picked, copied = FreeCADGui.Selection.getSelection("*"), _copied()
    # A copy that was cancelled leaves nothing on the clipboard.
    if set(picked) & set(copied) and wants(left := left_behind(picked, copied)):
        _select(left)
        FreeCADGui.runCommand("Std_Copy")


def _select(objects: Iterable) -> None:
    """Select these objects besides those that are."""
    for obj in objects:
        FreeCADGui.Selection.addSelection(obj.Document.Name, obj.Name)


def watch() -> None:
    """Follow Copy, Paste and Duplicate from now on."""
    FreeCAD.addDocumentObserver(_Pasted())
    command = FreeCADGui.Command.get("Std_Copy")
    actions = command.getAction() if command else []
    for action in actions:
        # After FreeCAD's own, which is connected first.
        action.triggered.connect(lambda checked=False: _after_copy())
    _kept.extend(actions)


_kept: list = []
"""The actions; PySide would let go of what listens to them."""
