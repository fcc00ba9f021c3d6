# SPDX-License-Identifier: LGPL-2.1-or-later
"""The objects of ours in a document: their kinds and names, and their input as plain values."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType

from BendTorsionWB.exchange.renames import Key
from BendTorsionWB.objects.proxy import type_of

FILE_SHAPE = "Shape"
"""The one property of a shape that was read from a file."""
FACES = ("AutoJoints", "AutoLanes")
"""Properties that name faces; their order says nothing."""
EXACT_TO = 1e-12
"""Relative difference below which two numbers are the same: what degrees and radians cost."""


def kind_of(obj) -> str:
    """The kind of an object of ours: its BT_Type, `File` for a shape read from a file; empty for
    every other, and for the parts of drawing pages, which follow their sheet set."""
    kind = type_of(obj)
    if kind in ("PageOutlines", "PageSymbol"):
        return ""
    if not kind and obj.TypeId == "Part::Feature" and "FromSchedule" in obj.PropertiesList:
        return "File"
    return kind


def objects_of(document) -> dict[tuple[str, str], object]:
    """Our objects by kind and name, in the order of the document."""
    found = {}
    for obj in document.Objects:
        if kind_of(obj):
            found.setdefault(key_of(obj), obj)
    return found


def documents_of(model) -> tuple:
    """The documents of a model: those of a split one, or the one it is."""
    return getattr(model, "documents", (model,))


def all_objects_of(documents: Iterable) -> dict[Key, list]:
    """Our objects of some documents by kind and name: of a split model more than one has an object
    that members of several use."""
    found: dict[Key, list] = {}
    for document in documents:
        for key, obj in objects_of(document).items():
            found.setdefault(key, []).append(obj)
    return found


def divided(obj, name: str) -> bool:
    """Whether a property says what of a model is in the document of an object, and no more."""
    return name == "Sheets" and kind_of(obj) in ("ArrangementSet", "NodeSheets")


def follows(obj, name: str, before: tuple, after: tuple, labels: Collection[str]) -> bool:
    """Whether a divided property, as plain values, differs by objects of these labels alone: what
    is told of them says it."""
    if not divided(obj, name):
        return False
    one, other = ([own for own in side if own not in labels] for side in (before, after))
    return one == other


def key_of(obj) -> Key:
    """Kind and name of an object: that of its row, or its label where it has none."""
    return kind_of(obj), getattr(obj, "FromSchedule", "") or obj.Label


def inputs_of(obj) -> tuple[str, ...]:
    """Names of the properties an object is made from."""
    if kind_of(obj) == "File":
        return ("Label", FILE_SHAPE)
    return ("Label", *(item.name for item in obj.Proxy.declared(obj) if not item.output))


def value_of(obj, name: str, labels: Mapping[Key, str] = MappingProxyType({})):
    """A property as plain values: quantities as numbers in FreeCAD's units, links by label, names
    of faces in alphabetical order. labels: by kind and label of what is linked to, that to tell
    instead."""
    if name in FACES:
        return tuple(sorted(getattr(obj, name, ())))
    if name == FILE_SHAPE:
        return hashlib.sha256(obj.Shape.exportBrepToString().encode()).hexdigest()[:12]
    return _plain(getattr(obj, name, None), labels)


def _plain(value, labels: Mapping[Key, str]):
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if hasattr(value, "Label"):
        return labels.get((kind_of(value), value.Label), value.Label)
    if hasattr(value, "UserString"):
        return value.Value
    if hasattr(value, "x"):
        return (value.x, value.y, value.z)
    if isinstance(value, (tuple, list)):
        return tuple(_plain(item, labels) for item in value)
    return str(value)


def same(one, other) -> bool:
    """Whether two plain values are equal, numbers to EXACT_TO of their size."""
    if isinstance(one, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(one) == len(other) and all(map(same, one, other))
    numbers = (int, float)
    if isinstance(one, numbers) and isinstance(other, numbers):
        return abs(one - other) <= EXACT_TO * max(abs(one), abs(other), 1.0)
    return one == other


NAMED = ("File", "Surface", "SectionSpec", "Axis", "Member")
"""Kinds with rows of their own, each after those its objects link to."""
_TO_MEMBER = {
    "PlateSet": ("Member",),
    "Unfold": ("Plates", "Member"),
    "AssemblyBed": ("Plates", "Member"),
    "SheetSet": ("Unfold", "Plates", "Member"),
}
"""By kind of what is made of one member: the links that lead to it."""


def owner_of(obj):
    """The member a plate set, patterns, a bed or sheets belong to; the object itself otherwise."""
    link = obj
    for name in _TO_MEMBER.get(kind_of(obj), ()):
        link = getattr(link, name, None)
    return obj if link is None else link
