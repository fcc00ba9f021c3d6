# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schedules and documents against each other: their difference, and documents as schedules."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import BendTorsionError, Finding, error, warning
from BendTorsionWB.document import build_document
from BendTorsionWB.document_cycles import refuse_cycle
from BendTorsionWB.document_difference import document_changes
from BendTorsionWB.document_forms import (
    AXIS_FORMS,
    CUT_FORMS,
    equal_sections,
    without_other_forms,
)
from BendTorsionWB.document_objects import documents_of, kind_of, objects_of, value_of
from BendTorsionWB.document_rows import rows_of
from BendTorsionWB.exchange.difference import Change, schedule_changes
from BendTorsionWB.exchange.linked_documents import refuse_linked
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_rows import Schedule
from BendTorsionWB.exchange.schedule_writer import write_schedule
from BendTorsionWB.exchange.whole_file import write_changed
from BendTorsionWB.objects.proxy import KIND_WORDS
from BendTorsionWB.objects.repair import refuse_bare
from BendTorsionWB.project import read_jobs
from BendTorsionWB.whole_model import close_model, members_in, open_model

FOUND_BY_BUILDING = {("SheetSet", "Bed"), ("SheetSet", "PlatePages"), ("Node", "Place")}
"""Properties that building sets where they are their default: nobody said anything there."""
_WORDS = KIND_WORDS | {"Node": "node", "SheetSet": "sheets", "File": "shape"}


def difference(one: str | os.PathLike, other: str | os.PathLike) -> tuple[Change, ...]:
    """What changed from one schedule or document to another, per member and property; raises
    BendTorsionError for what cannot be read."""
    paths = [Path(one), Path(other)]
    if not any(path.suffix.lower() == ".fcstd" for path in paths):
        return schedule_changes(*map(read_schedule, paths))
    documents = {}
    try:
        for path in paths:
            if path.suffix.lower() == ".fcstd" and path not in documents:
                documents[path] = open_model(path)
                _refuse_uncomputed(documents[path])
        # A model without sheets is no difference from its schedule.
        sheets = all(
            any(kind_of(obj) == "SheetSet" for obj in document.Objects)
            for document in documents.values()
        )
        for path in paths:
            if path not in documents:
                schedule, jobs = read_jobs(path)
                documents[path] = build_document(schedule, jobs, sheets)
        pair = [documents[path] for path in paths]
        return without_other_forms(document_changes(*pair), *pair)
    finally:
        for model in documents.values():
            close_model(documents_of(model))


def _refuse_uncomputed(model) -> None:
    """Raises BendTorsionError for objects that cannot be computed, or lost what computes them."""
    for document in documents_of(model):
        refuse_bare(document.Objects)
        refuse_cycle(document)


def write_document_back(
    document: str | os.PathLike, path: str | os.PathLike
) -> tuple[Finding, ...]:
    """`write_back` of a saved document, or of all those a split model links to."""
    model = open_model(Path(document))
    try:
        return write_back(model, path)
    finally:
        close_model(documents_of(model))


def write_back(document, path: str | os.PathLike) -> tuple[Finding, ...]:
    """Write a document, or a WholeModel, as a schedule: a workbook (.xlsx) or a folder of CSV, and
    a folder beside it for shapes. A warning for each thing a schedule cannot say; raises
    BendTorsionError, before anything is written, for a document without members and for objects
    that cannot be computed, lost what computes them, or depend on each other in a circle.

    Told by reading what is to be written, making its document, and comparing.
    """
    path = Path(path)
    _refuse_uncomputed(document)
    if not any(kind_of(obj) == "Member" for obj in document.Objects):
        if getattr(document, "FileName", ""):
            refuse_linked(Path(document.FileName))
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
        parts = documents_of(document)
        unsaid: list[Change] = []
        rules: dict[tuple[str, str, str], str] = {}
        for part in parts:
            own = jobs
            if len(parts) > 1:
                own = {name: jobs[name] for name in members_in(document, part)}
            unsaid += _unsaid(part, schedule, own)
            rules |= _expressions(part)
        shapes = {file.name: file.read_bytes() for file in sorted(files.glob("*"))}
    for name, content in shapes.items():
        write_changed(path.with_name(files.name) / name, content)
    write_schedule(rows, path)
    found = [
        warning(
            "not-in-schedule",
            change.name,
            f"{_WORDS.get(change.kind, change.kind)} {change.name}: the schedule cannot say "
            f"{change.property or 'it'}",
            "leave it in the document, or set it by hand after building the schedule",
            position=f"property {change.property}" if change.property else "",
        )
        for change in dict.fromkeys(unsaid)
    ]
    found += [
        warning(
            "expression-not-in-schedule",
            name,
            f"{_WORDS.get(kind, kind)} {name}: the schedule has what {property} comes to now, not "
            f"its expression {text}",
            "leave it in the document, or type the expression again after building the schedule",
            position=f"property {property}",
        )
        for (kind, name, property), text in rules.items()
    ]
    return tuple(found)


def _expressions(document) -> dict[tuple[str, str, str], str]:
    """The expressions that properties of our objects follow, by kind, label and property."""
    return {
        (kind_of(obj), obj.Label, path.lstrip(".")): text
        for obj in objects_of(document).values()
        for path, text in obj.ExpressionEngine
    }


def _unsaid(document, schedule: Schedule, jobs: dict[str, MemberJob]) -> list[Change]:
    """What of a document that of the schedule with these members does not have."""
    sheets = any(kind_of(obj) == "SheetSet" for obj in document.Objects)
    again = build_document(schedule, jobs, sheets)
    try:
        equal = equal_sections(document, again)
        changes = document_changes(document, again, by_label=True)
        plain = {key for key in map(_key, changes) if _is_default(document, *key)}
    finally:
        close_model([again])
    return [
        change
        for change in changes
        if change.kind != "File" and change.what != "added" and not _in_another_form(change)
        if not (change.kind == "SectionSpec" and change.name in equal) and _key(change) not in plain
    ]


def _key(change: Change) -> tuple[str, str, str]:
    return change.kind, change.name, change.property


def _is_default(document, kind: str, name: str, property: str) -> bool:
    """Whether a property that building finds a value for is as it was when its object was made."""
    if (kind, property) not in FOUND_BY_BUILDING:
        return False
    for obj in objects_of(document).values():
        if kind_of(obj) == kind and obj.Label == name:
            declared = {item.name: item.default for item in obj.Proxy.declared(obj)}
            return value_of(obj, property) == declared[property]
    return False


def _in_another_form(change: Change) -> bool:
    """Whether the schedule says a property by others: axes by rule or of pieces by points and
    curves, cuts by crossing or point by their place."""
    return (
        change.property.startswith(AXIS_FORMS) or change.property.rstrip("0123456789") in CUT_FORMS
    )
