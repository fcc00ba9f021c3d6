# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between the objects of two documents: by kind and label, property by property."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping

from BendTorsionWB.exchange.difference import Change
from BendTorsionWB.exchange.renames import Key, Reference, renames
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


def key_of(obj) -> Key:
    """Kind and name of an object: that of its row, or its label where it has none."""
    return kind_of(obj), getattr(obj, "FromSchedule", "") or obj.Label


def inputs_of(obj) -> tuple[str, ...]:
    """Names of the properties an object is made from."""
    if kind_of(obj) == "File":
        return ("Label", FILE_SHAPE)
    return ("Label", *(item.name for item in obj.Proxy.declared(obj) if not item.output))


def value_of(obj, name: str):
    """A property as plain values: quantities as numbers in FreeCAD's units, links by label, names
    of faces in alphabetical order."""
    if name in FACES:
        return tuple(sorted(getattr(obj, name, ())))
    if name == FILE_SHAPE:
        return hashlib.sha256(obj.Shape.exportBrepToString().encode()).hexdigest()[:12]
    return _plain(getattr(obj, name, None))


def _plain(value):
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if hasattr(value, "Label"):
        return value.Label
    if hasattr(value, "UserString"):
        return value.Value
    if hasattr(value, "x"):
        return (value.x, value.y, value.z)
    if isinstance(value, (tuple, list)):
        return tuple(_plain(item) for item in value)
    return str(value)


def same(one, other) -> bool:
    """Whether two plain values are equal, numbers to EXACT_TO of their size."""
    if isinstance(one, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(one) == len(other) and all(map(same, one, other))
    numbers = (int, float)
    if isinstance(one, numbers) and isinstance(other, numbers):
        return abs(one - other) <= EXACT_TO * max(abs(one), abs(other), 1.0)
    return one == other


def document_changes(before, after) -> tuple[Change, ...]:
    """What changed from one document to another. Links count by label, results not at all."""
    old, new = objects_of(before), objects_of(after)
    gone = {key: obj for key, obj in old.items() if key not in new}
    came = {key: obj for key, obj in new.items() if key not in old}
    renamed = renamed_objects(gone, came)
    changes = [
        Change("renamed", kind, name, "", was, name, members_of([new[kind, name]]))
        for (kind, was), name in renamed.items()
    ]
    told = {*renamed, *((kind, name) for (kind, _), name in renamed.items())}
    changes += [_whole("removed", obj) for key, obj in gone.items() if not told & _keys(key, obj)]
    for key, obj in new.items():
        if key not in old:
            changes += [] if told & _keys(key, obj) else [_whole("added", obj)]
            continue
        for name in dict.fromkeys((*inputs_of(old[key]), *inputs_of(obj))):
            one, other = value_of(old[key], name), value_of(obj, name)
            if not same(one, other):
                changes.append(Change("changed", *key, name, one, other, member=members_of([obj])))
    return tuple(changes)


_NAMED = ("File", "Surface", "SectionSpec", "Axis", "Member")
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


def _keys(key: Key, obj) -> set[Key]:
    """The key of an object, and that of the member it belongs to."""
    owner = owner_of(obj)
    return {key} if owner == obj else {key, key_of(owner)}


def renamed_objects(gone: Mapping[Key, object], came: Mapping[Key, object]) -> dict[Key, str]:
    """The new name of each object that is gone while one came with the same content under another
    name; a member's with its plates, patterns and bed."""
    return renames(_contents(gone), _contents(came), _NAMED)


def _contents(objects: Mapping[Key, object]) -> dict[Key, dict]:
    found: dict[Key, dict] = {}
    for key, obj in objects.items():
        owner = owner_of(obj)
        if kind_of(owner) not in _NAMED or kind_of(obj) == "SheetSet":
            continue
        whose = key if owner == obj else key_of(owner)
        # Of a member that stays, what changed hands or names is no rename of the member.
        if whose not in objects:
            continue
        content = found.setdefault(whose, {})
        for name in inputs_of(obj):
            value = getattr(obj, name, None)
            if kind_of(obj) == "File" or not hasattr(value, "Label"):
                value = value_of(obj, name)
            elif value != owner and owner_of(value) != owner:
                value = Reference(*key_of(value))
            else:
                continue
            if name != "Label":
                content[(key[0], name)] = value
    return found


def _whole(what: str, obj) -> Change:
    return Change(what, kind_of(obj), obj.Label, member=members_of([obj]))


def members_of(objects: Iterable) -> str:
    """Labels of the members that depend on these objects or are one, or that a plate set, its
    patterns or sheets belong to."""
    labels: dict[str, None] = {}
    for obj in objects:
        for one in (obj, *obj.InListRecursive, *obj.OutListRecursive):
            if type_of(one) == "Member" and (
                one in (obj, *obj.InListRecursive) or not _is_upstream(obj)
            ):
                labels[one.Label] = None
    return ", ".join(sorted(labels))


def _is_upstream(obj) -> bool:
    return kind_of(obj) in ("Surface", "Axis", "SectionSpec", "Member", "File")
