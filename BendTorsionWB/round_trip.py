# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schedules and documents against each other: their difference, and documents as schedules."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError, Finding, error, warning
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.document import build_document
from BendTorsionWB.document_difference import document_changes, kind_of, objects_of
from BendTorsionWB.document_rows import rows_of
from BendTorsionWB.document_update import open_document
from BendTorsionWB.exchange.difference import Change, schedule_changes
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_writer import write_schedule
from BendTorsionWB.exchange.whole_file import write_changed
from BendTorsionWB.objects import section_spec
from BendTorsionWB.project import read_jobs


def difference(one: str | os.PathLike, other: str | os.PathLike) -> tuple[Change, ...]:
    """What changed from one schedule or document to another, per member and property; raises
    BendTorsionError for what cannot be read."""
    paths = [Path(one), Path(other)]
    if not any(path.suffix.lower() == ".fcstd" for path in paths):
        return schedule_changes(*map(read_schedule, paths))
    import FreeCAD

    documents = {}
    try:
        for path in paths:
            if path.suffix.lower() == ".fcstd":
                documents[path] = open_document(path)
        # A model without sheets is no difference from its schedule.
        sheets = all(
            any(kind_of(obj) == "SheetSet" for obj in document.Objects)
            for document in documents.values()
        )
        for path in paths:
            if path not in documents:
                schedule, jobs = read_jobs(path)
                documents[path] = build_document(schedule, jobs, sheets)
        return document_changes(*(documents[path] for path in paths))
    finally:
        for document in documents.values():
            FreeCAD.closeDocument(document.Name)


def write_document_back(
    document: str | os.PathLike, path: str | os.PathLike
) -> tuple[Finding, ...]:
    """`write_back` of a saved document."""
    import FreeCAD

    opened = open_document(Path(document))
    try:
        return write_back(opened, path)
    finally:
        FreeCAD.closeDocument(opened.Name)


def write_back(document, path: str | os.PathLike) -> tuple[Finding, ...]:
    """Write a document as a schedule: a workbook (.xlsx) or a folder of CSV, and a folder beside it
    for shapes. A warning for each thing a schedule cannot say; raises BendTorsionError, before
    anything is written, for a document without members and for objects that cannot be computed.

    Told by reading what is to be written, making its document, and comparing.
    """
    import FreeCAD

    path = Path(path)
    if not any(kind_of(obj) == "Member" for obj in document.Objects):
        raise BendTorsionError(
            error(
                "member-unknown",
                document.Label,
                "there is no member in the document",
                "open another document",
            )
        )
    with tempfile.TemporaryDirectory() as folder:
        trial = Path(folder) / path.name
        files = trial.with_name(f"{path.stem} files")
        rows = rows_of(document, files)
        write_schedule(rows, trial)
        schedule, jobs = read_jobs(trial)
        sheets = any(kind_of(obj) == "SheetSet" for obj in document.Objects)
        again = build_document(schedule, jobs, sheets)
        try:
            equal = _equal_sections(document, again)
            changes = document_changes(document, again)
        finally:
            FreeCAD.closeDocument(again.Name)
        shapes = {file.name: file.read_bytes() for file in sorted(files.glob("*"))}
    for name, content in shapes.items():
        write_changed(path.with_name(files.name) / name, content)
    write_schedule(rows, path)
    return tuple(
        warning(
            "not-in-schedule",
            change.name,
            f"{change.kind} {change.name}: the schedule cannot say {change.property or 'it'}",
            "leave it in the document, or set it by hand after building the schedule",
            position=f"property {change.property}" if change.property else "",
        )
        for change in changes
        if change.kind != "File" and change.what != "added" and not _in_another_form(change)
        if not (change.kind == "SectionSpec" and change.name in equal)
    )


def _equal_sections(one, other) -> set[str]:
    """Names of the sections that are the same though their properties may not be: thicknesses of
    all plates or of each, joints automatic or named."""
    sections = [
        {
            name: content_hash(section_spec.value(obj))
            for (kind, name), obj in objects_of(document).items()
            if kind == "SectionSpec"
        }
        for document in (one, other)
    ]
    return {name for name, value in sections[0].items() if sections[1].get(name) == value}


_OTHER_FORMS = ("Rule", "Source", "Points", "Order", "Direction", "Reversed", "Closed", "CutBy")
_CUTS = ("Cut", "CutAxis", "CutPoint", "CutOffset", "CutRatio")


def _in_another_form(change: Change) -> bool:
    """Whether the schedule says a property by others: axes by rule or of pieces by points and
    curves, cuts by crossing or point by their place."""
    return change.property.startswith(_OTHER_FORMS) or change.property.rstrip("0123456789") in _CUTS
