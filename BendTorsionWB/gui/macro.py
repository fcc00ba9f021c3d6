# SPDX-License-Identifier: LGPL-2.1-or-later
"""One undo step of lines that run as FreeCAD records them: the macro is what was done.

FreeCAD records a line before it runs it, and takes none back. So lines run here first, and are
recorded once all of the step is done: of what was refused or stopped nothing is replayed.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui import transaction
from BendTorsionWB.gui.recomputing import keys_kept, recompute_each, touched_in, untouch


def literal(value) -> str:
    """A value as the text of a macro line; document objects by their names in `document`."""
    if isinstance(value, FreeCAD.Document):
        return "document"
    if hasattr(value, "TypeId") and hasattr(value, "Document"):
        return f"document.getObject({value.Name!r})"
    if isinstance(value, FreeCAD.Vector):
        return f"FreeCAD.Vector({value.x!r}, {value.y!r}, {value.z!r})"
    if isinstance(value, FreeCAD.Units.Quantity):
        return repr(value.Value)
    if isinstance(value, list):
        return f"[{', '.join(map(literal, value))}]"
    if isinstance(value, tuple):
        return f"({', '.join(map(literal, value))}{',' if len(value) == 1 else ''})"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{literal(k)}: {literal(v)}" for k, v in value.items()) + "}"
    return repr(value)


class _Nothing:
    """Stands for the names in lines that are recorded and not run again: all of it does nothing."""

    def __call__(self, *_, **__):
        return self

    def __getattr__(self, name):
        return self

    def __setattr__(self, name, value):
        pass

    def __bool__(self):
        return False


NAMES = ("FreeCAD", "document", "make", "make_files", "made")
"""The names recorded lines use."""
_waiting: list[str] | None = None
"""Lines that were run and wait to be recorded; None outside `recorded`."""


def comment(text: str) -> None:
    """Record a comment."""
    FreeCADGui.doCommand(f"# {text}")


def run(line: str) -> None:
    """Run a line, to be recorded with what it belongs to. Raises what it raises."""
    with recorded():
        exec(compile(line, "<macro>", "exec"), sys.modules["__main__"].__dict__)
        _waiting.append(line)


@contextmanager
def recorded(document=None):
    """Lines run inside are recorded when all of it is done, and none of them when it is broken off.
    document: that they work on, which is recorded with the modules they need."""
    global _waiting
    if _waiting is not None:
        _begin(document)
        yield
        return
    _waiting = []
    try:
        _begin(document)
        yield
        lines = _waiting
    finally:
        _waiting = None
    _record(lines)


def _record(lines: list[str]) -> None:
    """Have FreeCAD record lines that were run: it runs them again, on names of nothing."""
    names = sys.modules["__main__"].__dict__
    before = {name: names[name] for name in NAMES if name in names}
    try:
        for line in lines:
            if not line.startswith(("import ", "from ")):
                names.update(dict.fromkeys(NAMES, _Nothing()))
            FreeCADGui.doCommand(line)
    finally:
        for name in NAMES:
            names.pop(name, None)
        names.update(before)


def _begin(document) -> None:
    """Run what lines about a document need, the modules and the document, unless it was run."""
    if document is None:
        return
    for line in ("import FreeCAD", "from BendTorsionWB import make"):
        _need(line)
    named = any(line.startswith("document = ") for line in _waiting)
    if named and sys.modules["__main__"].document == document:
        return
    # Later on another may be active than when the lines are replayed.
    active = document is FreeCAD.ActiveDocument and not named
    found = "FreeCAD.ActiveDocument" if active else f"FreeCAD.getDocument({document.Name!r})"
    run(f"document = {found}")


def _need(line: str) -> None:
    """Run a line that others need, unless it was run."""
    if line not in _waiting:
        run(line)


def make(function: str, *arguments, **named):
    """Run `make.function(…)` as a recorded line; what it returns. Raises what it raises."""
    # Here, not above: the workbench opens at once, and scipy is loaded with the first object.
    from BendTorsionWB.gui.preferences import with_preferences

    arguments, named = with_preferences(function, arguments, named)
    given = [literal(item) for item in arguments]
    given += [f"{key}={literal(item)}" for key, item in named.items()]
    run(f"made = make.{function}({', '.join(given)})")
    return sys.modules["__main__"].made


def on_files(document, function: str, *arguments, **named):
    """Run `make_files.function(…)` as a recorded line; what it returns. Raises what it raises.
    document: the one worked on, None when a new one is opened."""
    with recorded(document):
        run("from BendTorsionWB import make_files")
        given = [literal(item) for item in arguments]
        given += [f"{key}={literal(item)}" for key, item in named.items()]
        run(f"made = make_files.{function}({', '.join(given)})")
        return sys.modules["__main__"].made


def put(obj, name: str, value) -> None:
    """Set a property as a recorded line."""
    run(f"{literal(obj)}.{name} = {literal(value)}")


def bind(obj, name: str, text: str | None) -> None:
    """Set the expression of a property as a recorded line; None takes it away."""
    run(f"{literal(obj)}.setExpression({name!r}, {text!r})")


def put_view(obj, name: str, value) -> None:
    """Set a property of an object's view, as a line that does nothing in a console; outside
    `recorded` and `undo_step`, where things are tried out, no line is recorded."""
    if _waiting is None:
        setattr(obj.ViewObject, name, value)
    else:
        _need("import FreeCAD")
        run(f"if FreeCAD.GuiUp: {literal(obj)}.ViewObject.{name} = {value!r}")


def in_window(module: str, function: str, *arguments) -> None:
    """Call a function of a module of `gui` as a recorded line that does nothing in a console."""
    with recorded():
        _need("import FreeCAD")
        run(_window_line(module, function, arguments))


def seen(module: str, function: str, *arguments) -> None:
    """Record the call of a function of a module of `gui` whose work the user has seen done."""
    with recorded():
        _need("import FreeCAD")
        _waiting.append(_window_line(module, function, arguments))


def _window_line(module: str, function: str, arguments: tuple) -> str:
    given = ", ".join(map(literal, arguments))
    return f"if FreeCAD.GuiUp: from BendTorsionWB.gui import {module}; {module}.{function}({given})"


def recompute(progress=None, objects=()) -> None:
    """Recompute the document of objects as a recorded line; with progress (`project.Progress`,
    which may raise to stop) it is told before each object that is computed."""
    if progress is not None and objects:
        recompute_each(objects[0].Document, progress)
    with keys_kept():
        run("document.recompute()")


@contextmanager
def undo_step(document, name: str):
    """Everything inside is one undo step; an exception takes all of it back."""
    key = document.Name
    with recorded(document), _active(document):
        touched = touched_in(document)
        transaction.begin(document, name)
        try:
            yield
        except BaseException:
            if key in FreeCAD.listDocuments():
                transaction.abort(document, name)
                untouch(document, touched)
            raise
        transaction.commit(document, name)


@contextmanager
def _active(document):
    """Make a document the active one meanwhile: of a step in another document FreeCAD leaves an
    empty one in that which is active."""
    former = FreeCAD.ActiveDocument.Name if FreeCAD.ActiveDocument else document.Name
    if former == document.Name:
        yield
        return
    FreeCAD.setActiveDocument(document.Name)
    try:
        yield
    finally:
        if former in FreeCAD.listDocuments():
            FreeCAD.setActiveDocument(former)


def raise_errors(objects) -> None:
    """Raise BendTorsionError with the errors of these objects' last recompute."""
    from BendTorsionWB.objects.proxy import findings_of

    ours = (item for item in objects if hasattr(item, "BT_Type"))
    found = (finding for item in ours for finding in findings_of(item))
    # Objects downstream repeat the error of the one at fault.
    errors = tuple(dict.fromkeys(finding for finding in found if finding.severity == "error"))
    if errors:
        raise BendTorsionError(errors)
