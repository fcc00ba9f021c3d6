# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API of open documents and files: schedules in and out, package, report, check,
repair, support bundle.

Each raises BendTorsionError for what it cannot do, and leaves no half-made document or file.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.document import build_document
from BendTorsionWB.document_export import export_document, records_of, write_figures
from BendTorsionWB.document_templates import new_document
from BendTorsionWB.model_files import checked_recompute
from BendTorsionWB.objects.preference import recomputes
from BendTorsionWB.objects.repair import repair as give_back
from BendTorsionWB.objects.told import PROGRESS
from BendTorsionWB.project import BuildResult, detail_members, read_project
from BendTorsionWB.round_trip import write_back
from BendTorsionWB.shapes.surface_files import shape_from_file
from BendTorsionWB.support import write_bundle


def open_schedule(path: str | os.PathLike, sheets: bool = False):
    """A new document with the members of a schedule, recomputed; sheets: with drawing sheets.
    Raises BendTorsionError for an invalid schedule."""
    report = PROGRESS.get()
    schedule, jobs, found = read_project(path)
    _, lost = detail_members(schedule, jobs, progress=report, of_files=found.findings)
    if lost:
        raise BendTorsionError(lost)
    document = build_document(schedule, jobs, sheets=sheets, hidden=False)
    try:
        objects = list(reversed(document.TopologicalSortedObjects))
        for done, obj in enumerate(objects, start=1):
            obj.recompute()
            report("document", done, len(objects))
        document.recompute()
    except BaseException:
        FreeCAD.closeDocument(document.Name)
        raise
    document.Label = Path(path).stem
    document.clearUndos()
    return document


def import_shapes(document, path: str | os.PathLike, step: str = "Import shapes"):
    """A plain object with everything of a STEP, IGES or BREP file, faces and free curves, in a new
    document when document is None; FreeCAD's own import leaves free curves out since 1.0. step: the
    name of the undo step it is in a new document. Raises BendTorsionError for what cannot be
    read."""
    shape = shape_from_file(path)
    if document is None:
        document = FreeCAD.newDocument(Path(path).stem)
        document.openTransaction(step)
        feature = _shapes(document, path, shape)
        document.commitTransaction()
        return feature
    return _shapes(document, path, shape)


def _shapes(document, path: str | os.PathLike, shape):
    feature = document.addObject("Part::Feature", "Shapes")
    feature.Label, feature.Shape = Path(path).stem, shape
    return feature


def open_template(template: str, path: str | os.PathLike):
    """A new document from a template of `document_templates`, saved at path and opened."""
    new_document(template, path)
    return FreeCAD.openDocument(os.fspath(path))


def write_schedule(document, path: str | os.PathLike) -> tuple[Finding, ...]:
    """Write an open document as a schedule; a warning for each thing a schedule cannot say."""
    PROGRESS.get()("writing and reading it again", 0, 1)
    active = FreeCAD.ActiveDocument
    try:
        return write_back(document, path)
    finally:
        _activate(active)


def write_package(document, folder: str | os.PathLike) -> BuildResult:
    """Write the cut files, sheets, models, workbook and report of an open document, as the command
    line's `export` does of a saved one."""
    active = FreeCAD.ActiveDocument
    with tempfile.TemporaryDirectory() as beside:
        copy = Path(beside) / "document.FCStd"
        with recomputes(document):
            document.recompute()
        document.saveCopy(str(copy))
        try:
            return export_document(copy, folder, workers=1, progress=PROGRESS.get())
        finally:
            _activate(active)


def write_report(document, path: str | os.PathLike) -> tuple[Finding, ...]:
    """Write the figures of an open document as a workbook, or as JSON when the name ends so; what
    was found, of members in error, which have no figures, too."""
    report = PROGRESS.get()
    report("figures", 0, 2)
    given = records_of(document)
    report("writing", 1, 2)
    write_figures(given, path)
    return tuple(given.findings)


def check(document) -> tuple[Finding, ...]:
    """Recompute an open document; the errors of all its objects."""
    return checked_recompute(document)


def repair(document) -> list[str]:
    """Give the objects of an open document back what computes them, which a document loses that is
    saved without the workbench, and recompute it; the labels of those that had lost it."""
    repaired = give_back(document)
    if repaired:
        checked_recompute(document)
    return [obj.Label for obj in repaired]


def write_support(path: str | os.PathLike, document=None) -> tuple[str, ...]:
    """Write what a report of a fault needs into one file (.zip), with the findings and tables of an
    open document when one is given; the names of what is in it."""
    report = PROGRESS.get()
    report("versions", 0, 2)
    if document is None:
        return write_bundle(path)
    active = FreeCAD.ActiveDocument
    with tempfile.TemporaryDirectory() as beside:
        copy = Path(beside) / "document.FCStd"
        document.saveCopy(str(copy))
        report("findings and tables", 1, 2)
        try:
            return write_bundle(path, copy)
        finally:
            _activate(active)


def _activate(document) -> None:
    if document is not None:
        FreeCAD.setActiveDocument(document.Name)
