# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes from STEP, IGES and BREP files, whole or one part by its name or number."""

from __future__ import annotations

import os
import re
import tempfile
from pathlib import Path

import FreeCAD  # noqa: F401  Part crashes the interpreter when it is loaded before FreeCAD
import Part

from ..core.file_end import CUT_SHORT, MEND, is_cut_short
from ..core.finding import BendTorsionError, error
from .file_parts import FilePiece, chosen, pieces_of, told
from .iges_names import named_entities
from .step_names import names_in, only_named
from .trial_reading import failure_of_file

KINDS = {
    ".step": "STEP",
    ".stp": "STEP",
    ".iges": "IGES",
    ".igs": "IGES",
    ".brep": "BREP",
    ".brp": "BREP",
}


def faces_from_file(path: str | os.PathLike, name: str = "", object: str = "surface") -> Part.Shape:
    """The faces of a file, or of its part called `name`; raises BendTorsionError for a file that
    is missing, unreadable, of another kind, or without faces."""
    shape = shape_from_file(path, name, object)
    if not shape.Faces:
        raise _fault(
            "surface-file-empty",
            path,
            object,
            "there is no face in it",
            "export faces, a shell or a solid",
        )
    return shape


def shape_from_file(path: str | os.PathLike, name: str = "", object: str = "file") -> Part.Shape:
    """The shape of a file, or of its part called `name`; raises BendTorsionError."""
    path = Path(path)
    kind = KINDS.get(path.suffix.lower())
    if kind is None:
        raise _fault(
            "file-kind",
            path,
            object,
            "this kind of file is not read",
            f"use {', '.join(sorted(KINDS))}",
        )
    if not path.is_file():
        raise _fault(
            "file-missing",
            path,
            object,
            "there is no such file",
            "write its path relative to the schedule",
        )
    try:
        cut_short = is_cut_short(path, kind)
    except OSError as failure:
        problem = failure.strerror
        raise _fault(
            "file-unreadable",
            path,
            object,
            f"it cannot be read as {kind}: {problem}",
            "allow reading it, or copy it to another place",
        ) from failure
    if cut_short:
        raise _fault("file-unreadable", path, object, CUT_SHORT, MEND)
    if name and kind == "STEP":
        return _named(path, name, object)
    shape = _read(path, path, kind, object)
    return _piece(shape, path, name, object) if name else shape


def pieces_in(path: str | os.PathLike, shape: Part.Shape) -> tuple[FilePiece, ...]:
    """The curves and surfaces of the shape of a file, an IGES file's with their names."""
    path = Path(path)
    if KINDS.get(path.suffix.lower()) != "IGES":
        return pieces_of(shape)
    return pieces_of(shape, named_entities(path.read_text(encoding="latin-1")))


def _piece(shape: Part.Shape, path: Path, name: str, object: str) -> Part.Shape:
    pieces = pieces_in(path, shape)
    found = chosen(pieces, name)
    if found is None:
        raise _unknown(path, object, name, told(pieces))
    return found


def _unknown(path: Path, object: str, name: str, known: str) -> BendTorsionError:
    return _fault(
        "file-name-unknown",
        path,
        object,
        f"nothing in it is called {name!r}",
        f"it holds {known}",
    )


def _named(path: Path, name: str, object: str) -> Part.Shape:
    """The shape of one named part of a STEP file. FreeCAD 0.20's own reader of names crashes on
    free curves, so the file is cut down to the part and read without names."""
    text = path.read_text(encoding="latin-1")
    alone = only_named(text, name)
    if alone is None:
        known = ", ".join(names_in(text)[:12])
        if re.fullmatch(r"(curve|surface)\d+", name.lower()) or not known:
            return _piece(_read(path, path, "STEP", object), path, name, object)
        raise _unknown(path, object, name, known)
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "part.step"
        part.write_text(alone, encoding="latin-1")
        return _read(part, path, "STEP", object)


def _read(part: Path, path: Path, kind: str, object: str) -> Part.Shape:
    shape = Part.Shape()
    failure = failure_of_file(part, lambda: shape.read(str(part)))
    if failure:
        raise _fault("file-unreadable", path, object, failure, "export it again, or in parts")
    try:
        shape.read(str(part))
    except Exception as problem:
        raise _fault(
            "file-unreadable", path, object, f"it cannot be read as {kind}", "export it again"
        ) from problem
    if shape.isNull():
        raise _fault(
            "file-unreadable", path, object, f"it cannot be read as {kind}", "export it again"
        )
    return shape


def _fault(code, path, object, message, mend) -> BendTorsionError:
    name = Path(path).name
    return BendTorsionError(error(code, object, f"{name}: {message}", mend, value=name))
