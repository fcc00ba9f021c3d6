# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edits tried out in an open transaction: taken back, or done again as recorded lines.

Accepting aborts the trial and runs its outcome as a macro in one undo step, so that what is
recorded is what was done; what the trial computed is kept by `core.memo`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from BendTorsionWB.gui import macro, tree


class Preview:
    """objects: what is edited. create: makes them when they are new: called with a function that
    makes an object, as `make("make_section", document, "Section")`; returns the objects."""

    def __init__(self, document, name: str, objects: Sequence = (), create: Callable | None = None):
        self.document, self.name, self.create = document, name, create
        document.openTransaction(name)
        try:
            self.objects = list(create(_make_unrecorded)) if create else list(objects)
            if create:
                tree.TRIED.update(obj.Name for obj in self.objects)
            document.recompute()
        except BaseException:
            self.cancel()
            raise
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

    def cancel(self) -> None:
        """Take everything back."""
        tree.TRIED.clear()
        self.document.abortTransaction()


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


def _bound(obj) -> dict[str, str]:
    """The expressions of an object by property."""
    return {path.lstrip("."): text for path, text in obj.ExpressionEngine}


def _same(one, other) -> bool:
    if hasattr(one, "UserString"):
        return one.Value == other.Value
    return one == other
