# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edits tried out in an open transaction: taken back, or done again as recorded lines.

Accepting aborts the trial and runs its outcome as a macro in one undo step, so that what is
recorded is what was done; what the trial computed is kept by `core.memo`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

import FreeCADGui

from BendTorsionWB.gui import finding_words, macro, transaction, tree
from BendTorsionWB.gui.recomputing import recompute, touched_in, untouch


class Preview:
    """objects: what is edited. create: makes them when they are new, or changes `objects` by more
    than values: called with a function that makes an object, as `make("make_section", document,
    "Section")`; returns what is edited from then on. fits: who shows it fits the view to it, and so
    does its macro. `errors`: those before it."""

    def __init__(
        self,
        document,
        name: str,
        objects: Sequence = (),
        create: Callable | None = None,
        fits: bool = False,
    ):
        # Here, not above: the workbench opens without loading Part.
        from BendTorsionWB.objects.repair import refuse_bare

        self.document, self.name, self.create, self.fits = document, name, create, fits
        self.objects, self.made = list(objects), set()
        refuse_bare(objects)
        self.former = [(obj, _inputs(obj), _bound(obj)) for obj in objects]
        there = {obj.Name for obj in document.Objects}
        self.touched = touched_in(document)
        self.modified = FreeCADGui.getDocument(document.Name).Modified
        self.errors = finding_words.errors_of(document.Objects)
        self.steps = list(document.UndoNames)
        transaction.begin(document, name)
        try:
            if create:
                self.objects = list(create(_make_unrecorded))
                self.made = {obj.Name for obj in document.Objects} - there
                tree.TRIED.update(obj.Name for obj in self.objects)
            recompute(document)
        except BaseException:
            self.cancel()
            raise
        if not create:
            self.errors = finding_words.errors_of(document.Objects)
        self.before = [_inputs(obj) for obj in self.objects]
        self.bound_before = [_bound(obj) for obj in self.objects]

    def accept(self) -> None:
        """One undo step of recorded lines; nothing when nothing was made or changed."""
        edits = [
            (k, name, value)
            for k, obj in enumerate(self.objects)
            for name, value in _inputs(obj).items()
            if name not in self.before[k] or not _same(value, self.before[k][name])
        ]
        bound = [
            (k, name, _bound(obj).get(name))
            for k, obj in enumerate(self.objects)
            for name in {**self.bound_before[k], **_bound(obj)}
            if _bound(obj).get(name) != self.bound_before[k].get(name)
        ]
        self.cancel()
        if not edits and not bound and not self.create:
            return
        with macro.undo_step(self.document, self.name):
            if self.create:
                self.objects = list(self.create(macro.make))
            objects = self.objects
            for k, name, value in edits:
                macro.put(objects[k], name, value)
            for k, name, text in bound:
                macro.bind(objects[k], name, text)
            macro.recompute()
            if self.fits:
                macro.seen("first_view", "fit")

    def cancel(self) -> None:
        """Take everything back; what was computed and saved before the trial is so after it."""
        tree.TRIED.clear()
        transaction.abort(self.document, self.name)
        self._undo_committed()
        self._put_back()
        untouch(self.document, self.touched)
        # FreeCAD 0.20 tells the mark of a changed document to scripts and lets none take it back.
        with suppress(AttributeError):
            FreeCADGui.getDocument(self.document.Name).Modified = self.modified

    def leave(self) -> None:
        """End it for an object that was deleted: the deletion stands, what was new goes."""
        if self.create:
            self.cancel()
        else:
            transaction.commit(self.document, self.name)

    def _undo_committed(self) -> None:
        """Undo the trial where a transaction begun in another document has made a step of it."""
        names = list(self.document.UndoNames)
        above = transaction.begun_elsewhere(names)
        # FreeCAD keeps so many steps, and drops the oldest.
        wanted = [*above, self.name, *self.steps][: len(names)]
        if names in (above, self.steps) or names != wanted:
            return
        if all(transaction.undo_empty(self.document) for _ in above):
            self.document.undo()
            transaction.forget_undone(self.document, self.name)

    def _put_back(self) -> None:
        """Take back what the abort did not: another command had ended the transaction."""
        left = [obj.Name for obj in self.document.Objects if obj.Name in self.made]
        for name in left:
            self.document.removeObject(name)
        changed = bool(left)
        here = {obj.Name for obj in self.document.Objects}
        for obj, inputs, bound in self.former:
            if not (is_there(obj) and obj.Name in here):
                continue
            now = _bound(obj)
            for name in {**now, **bound}:
                if now.get(name) != bound.get(name):
                    obj.setExpression(name, bound.get(name))
                    changed = True
            for name, value in inputs.items():
                if name not in obj.PropertiesList or not _same(getattr(obj, name), value):
                    setattr(obj, name, value)
                    changed = True
        if changed:
            recompute(self.document)


def _make_unrecorded(function: str, *arguments, **named):
    from BendTorsionWB import make
    from BendTorsionWB.gui.preferences import with_preferences

    arguments, named = with_preferences(function, arguments, named)
    return getattr(make, function)(*arguments, **named)


def _inputs(obj) -> dict[str, object]:
    """Values of the input properties, in the order they are declared."""
    from BendTorsionWB.objects.proxy import BASE_PROPERTIES

    outputs = {item.name for item in (*obj.Proxy.declared(obj), *BASE_PROPERTIES) if item.output}
    names = [item.name for item in obj.Proxy.declared(obj) if not item.output]
    # Faces a section has besides the four of a box have joints of their own.
    names += [
        name
        for name in obj.PropertiesList
        if name.startswith(("Joints", "Lanes")) and name not in names and name not in outputs
    ]
    return {name: getattr(obj, name) for name in dict.fromkeys(names)}


def is_there(obj) -> bool:
    """Whether an object, or a document, was not deleted meanwhile."""
    try:
        return bool(obj.Name)
    except ReferenceError:
        return False


def _bound(obj) -> dict[str, str]:
    """The expressions of an object by property."""
    return {path.lstrip("."): text for path, text in obj.ExpressionEngine}


def _same(one, other) -> bool:
    if hasattr(one, "UserString"):
        return one.Value == other.Value
    return one == other
