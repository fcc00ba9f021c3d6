# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document's transaction ends whether or not anything was changed in it: left open, FreeCAD takes
the next undo for its end and forgets what could be done again."""

from __future__ import annotations

import itertools

import FreeCAD


def begin(document, name: str) -> None:
    """Open a transaction of that name."""
    document.openTransaction(name)


def commit(document, name: str) -> None:
    """Keep what was done since `begin` as one undo step, if anything was."""
    document.commitTransaction()
    _close(name, abort=False)


def abort(document, name: str) -> None:
    """Take back what was done since `begin`."""
    document.abortTransaction()
    _close(name, abort=True)


def begun_elsewhere(names: list[str]) -> list[str]:
    """Of names of undo steps, the last first, those before the first of the document itself: of a
    step in another document FreeCAD leaves one in that which is active."""
    return list(itertools.takewhile(lambda name: name.startswith("-> "), names))


def undo_empty(document) -> bool:
    """Undo the last step when it changes nothing; False, and it stays, when it does."""
    changes = _Changes(document)
    FreeCAD.addDocumentObserver(changes)
    try:
        document.undo()
    finally:
        FreeCAD.removeDocumentObserver(changes)
    if changes.seen:
        document.redo()
    return not changes.seen


class _Changes:
    """Document observer: whether an object of a document changes, comes or goes."""

    def __init__(self, document):
        self.document, self.seen = document, False

    def slotChangedObject(self, obj, _):
        """Called by FreeCAD after a property was set."""
        self.seen = self.seen or obj.Document == self.document

    def slotCreatedObject(self, obj):
        """Called by FreeCAD after an object was made."""
        self.slotChangedObject(obj, "")

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes."""
        self.slotChangedObject(obj, "")


def forget_undone(document, name: str) -> None:
    """Let nothing be done again that was undone: FreeCAD forgets it with the first change."""
    begin(document, name)
    document.addObject("App::FeaturePython", "Forgotten")
    abort(document, name)


def _close(name: str, abort: bool) -> None:
    """A document without a change in it has no transaction to end, FreeCAD itself has."""
    active = FreeCAD.getActiveTransaction()
    if active is not None and active[0] == name:
        FreeCAD.closeActiveTransaction(abort)
