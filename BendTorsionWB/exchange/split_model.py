# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a model is split, read from its documents: an update keeps every member where it is."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.linked_documents import linked_documents

SPLIT = "BendTorsion split"
"""Of the entry in the metadata of the document that links to the others: members per document."""
_PART = re.compile(r"(model/\d{3,})\.FCStd")


def split_size(model: Path) -> int:
    """Members per document of a split model, of which this is the document that links to all: as
    it says, else as many as the fullest has; 0 for a model in one document, or none."""
    parts = _parts(model)
    if not parts:
        return 0
    said = saved_metadata(model).get(SPLIT, "")
    counts = (len(_members(model.parent / f"{part}.FCStd")) for part in parts)
    return int(said if said.isdecimal() else 0) or max(counts) or 1


def saved_metadata(path: Path) -> dict[str, str]:
    """The metadata of a saved document of its own; none of what is no document."""
    return {item.get("key", ""): item.get("value", "") for item in _read(path).iter("Item")}


def kept_groups(model: Path, members: Sequence[str], size: int) -> dict[str, tuple[str, ...]]:
    """The members by name of the document they are in; new ones in the last one while there is
    room, then in more; none in a document whose members all are gone. Raises BendTorsionError for
    members whose labels are names of members in other documents."""
    groups: dict[str, list[str]] = {}
    placed: set[str] = set()
    by_part = {part: _members(model.parent / f"{part}.FCStd") for part in _parts(model)}
    _refuse_exchanged(by_part, members)
    for part, held in by_part.items():
        rows = {row for row, _ in held}
        # A label by hand counts where its row is gone, as for the document itself.
        rows |= {label for row, label in held if row not in members}
        groups[part] = [name for name in members if name in rows and name not in placed]
        placed |= {*groups[part]}
    new = [name for name in members if name not in placed]
    last = max(groups, key=_number)
    room = max(size - len(groups[last]), 0)
    groups[last] += new[:room]
    for index, start in enumerate(range(room, len(new), size), start=1):
        groups[f"model/{_number(last) + index:03d}"] = new[start : start + size]
    # In the order of the schedule, as they are found to be the next time.
    return {part: tuple(name for name in members if name in held) for part, held in groups.items()}


def _refuse_exchanged(held: Mapping[str, list], members: Sequence[str]) -> None:
    home = {row: part for part, own in held.items() for row, _ in own}
    findings = [
        error(
            "labels-exchanged",
            label,
            f"Member {label} in {part}.FCStd follows the row {row}, and the member of the row "
            f"{label} is in {home[label]}.FCStd: no member goes from one document to another",
            f"give it its label {row} back, or run build with --split for a model made anew",
            position="property Label",
            value=label,
            limit=row,
        )
        for part, own in held.items()
        for row, label in own
        if label != row and label in members and home.get(label, part) != part
    ]
    if findings:
        raise BendTorsionError(findings)


def _parts(model: Path) -> list[str]:
    """Names of the documents of a split model without ending, those that are there."""
    found = filter(None, map(_PART.fullmatch, linked_documents(model)))
    return [match[1] for match in found if (model.parent / match[0]).exists()]


def _number(part: str) -> int:
    return int(part.rpartition("/")[2])


def _members(path: Path) -> list[tuple[str, str]]:
    """Row and label of each member with plates in a document: others are there only because some
    meet them."""
    held, plated = {}, set()
    for item in _read(path).iterfind("ObjectData/Object"):
        words = {own.get("name"): own for own in item.iterfind("Properties/Property")}
        kind = _value(words.get("BT_Type"))
        if kind == "Member":
            label = _value(words.get("Label"))
            held[item.get("name")] = _value(words.get("FromSchedule")) or label, label
        elif kind == "PlateSet":
            plated.add(_value(words.get("Member")))
    return [own for name, own in held.items() if name in plated]


def _value(item: ElementTree.Element | None) -> str:
    """The text or link of a property."""
    return item[0].get("value", "") if item is not None and len(item) else ""


def _read(path: Path) -> ElementTree.Element:
    """The objects of a saved document; none of what is no document."""
    try:
        with zipfile.ZipFile(path) as archive:
            return ElementTree.fromstring(archive.read("Document.xml"))
    except (OSError, zipfile.BadZipFile, KeyError, ElementTree.ParseError, RuntimeError):
        return ElementTree.Element("Document")
