# SPDX-License-Identifier: LGPL-2.1-or-later
"""The documents of a split model as one: every object once, and where two documents disagree."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.document_objects import (
    all_objects_of,
    divided,
    inputs_of,
    kind_of,
    same,
    value_of,
)
from BendTorsionWB.document_update import open_document
from BendTorsionWB.exchange.linked_documents import linked_documents
from BendTorsionWB.exchange.split_model import saved_metadata


@dataclass(frozen=True)
class WholeModel:
    """What is asked of a document, of all documents of a split model. Objects: ours, each once,
    a member from the document that has its plates; Meta: metadata, of the document that links to
    the others before that of the first."""

    Label: str
    Meta: Mapping[str, str]
    Objects: tuple
    documents: tuple


def open_model(path: Path):
    """A saved document, hidden, or the documents that it links to; raises BendTorsionError for what
    cannot be opened, and for documents that disagree."""
    names = linked_documents(path)
    if not names:
        return open_document(path)
    documents: list = []
    try:
        for name in names:
            documents.append(open_document(path.parent / name))
        _refuse_disagreement(path.parent, documents)
    except BaseException:
        close_model(documents)
        raise
    meta = {**documents[0].Meta, **saved_metadata(path)}
    return WholeModel(path.stem, meta, _each_once(documents), tuple(documents))


def close_model(documents: Iterable) -> None:
    """Close documents without saving them."""
    for document in documents:
        FreeCAD.closeDocument(document.Name)


def members_in(model, document) -> tuple[str, ...]:
    """Labels of the members that are this document's own: others are there only because some of
    these meet them."""
    own = (obj for obj in model.Objects if obj.Document == document and kind_of(obj) == "Member")
    return tuple(obj.Label for obj in own)


def _each_once(documents: Iterable) -> tuple:
    plated = {
        (document.Name, obj.Member.Name)
        for document in documents
        for obj in document.Objects
        if kind_of(obj) == "PlateSet" and obj.Member is not None
    }
    chosen = {
        (own.Document.Name, own.Name)
        for copies in all_objects_of(documents).values()
        for own in [
            next((o for o in copies if (o.Document.Name, o.Name) in plated), copies[0]),
        ]
    }
    every = (obj for document in documents for obj in document.Objects)
    return tuple(obj for obj in every if (obj.Document.Name, obj.Name) in chosen)


def _refuse_disagreement(folder: Path, documents: Iterable) -> None:
    """Raises BendTorsionError, an error for each property of an object that is another in another
    document: no schedule says both."""
    findings = [
        _disagreement(folder, name, first, other)
        for first, *others in all_objects_of(documents).values()
        for other in others
        for name in dict.fromkeys((*inputs_of(first), *inputs_of(other)))
        if not divided(first, name) and not same(value_of(first, name), value_of(other, name))
    ]
    if findings:
        raise BendTorsionError(findings)


def _disagreement(folder: Path, name: str, first, other) -> Finding:
    values = [_told(value_of(obj, name)) for obj in (first, other)]
    files = [Path(obj.Document.FileName).relative_to(folder).as_posix() for obj in (first, other)]
    return error(
        "documents-disagree",
        first.Label,
        f"{kind_of(first)} {first.Label}: {name} is {values[0]} in {files[0]} and {values[1]} in "
        f"{files[1]}",
        "give it one value in both, or run update to have that of the schedule in all",
        position=f"property {name}",
        value=values[0],
        limit=values[1],
    )


def _told(value) -> str:
    return f"{value:.12g}" if isinstance(value, float) else str(value)
