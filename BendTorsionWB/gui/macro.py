# SPDX-License-Identifier: LGPL-2.1-or-later
"""One undo step of lines that run as FreeCAD records them: the macro is what was done."""

from __future__ import annotations

import sys
from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui.recomputing import keys_kept, recompute_each


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


def begin(document) -> None:
    """Record what the lines to come need: the modules, and the document they work on."""
    FreeCADGui.doCommand("import FreeCAD")
    FreeCADGui.doCommand("from BendTorsionWB import make")
    active = document is FreeCAD.ActiveDocument
    found = "FreeCAD.ActiveDocument" if active else f"FreeCAD.getDocument({document.Name!r})"
    FreeCADGui.doCommand(f"document = {found}")


def make(function: str, *arguments, **named):
    """Run `make.function(…)` as a recorded line; what it returns. Raises what it raises."""
    # Here, not above: the workbench opens at once, and scipy is loaded with the first object.
    from BendTorsionWB.gui.preferences import with_preferences

    arguments, named = with_preferences(function, arguments, named)
    given = [literal(item) for item in arguments]
    given += [f"{key}={literal(item)}" for key, item in named.items()]
    FreeCADGui.doCommand(f"made = make.{function}({', '.join(given)})")
    return sys.modules["__main__"].made


def on_files(document, function: str, *arguments, **named):
    """Run `make_files.function(…)` as a recorded line; what it returns. Raises what it raises.
    document: the one worked on, None when a new one is opened."""
    FreeCADGui.doCommand("from BendTorsionWB import make_files")
    if document is not None:
        begin(document)
    given = [literal(item) for item in arguments]
    given += [f"{key}={literal(item)}" for key, item in named.items()]
    FreeCADGui.doCommand(f"made = make_files.{function}({', '.join(given)})")
    return sys.modules["__main__"].made


def put(obj, name: str, value) -> None:
    """Set a property as a recorded line."""
    FreeCADGui.doCommand(f"{literal(obj)}.{name} = {literal(value)}")


def bind(obj, name: str, text: str | None) -> None:
    """Set the expression of a property as a recorded line; None takes it away."""
    FreeCADGui.doCommand(f"{literal(obj)}.setExpression({name!r}, {text!r})")


def recompute(progress=None, objects=()) -> None:
    """Recompute the document of objects as a recorded line; with progress (`project.Progress`,
    which may raise to stop) it is told before each object that is computed."""
    if progress is not None and objects:
        recompute_each(objects[0].Document, progress)
    with keys_kept():
        FreeCADGui.doCommand("document.recompute()")


@contextmanager
def undo_step(document, name: str):
    """Everything inside is one undo step; an exception takes all of it back."""
    key = document.Name
    begin(document)
    with _active(document):
        document.openTransaction(name)
        try:
            yield
        except BaseException:
            if key in FreeCAD.listDocuments():
                document.abortTransaction()
            raise
        document.commitTransaction()


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
