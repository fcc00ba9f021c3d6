# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between the objects of two documents: by kind and label, property by property."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from BendTorsionWB.document_objects import (
    NAMED,
    all_objects_of,
    divided,
    documents_of,
    inputs_of,
    key_of,
    kind_of,
    objects_of,
    owner_of,
    same,
    value_of,
)
from BendTorsionWB.document_pairs import counterparts
from BendTorsionWB.exchange.difference import Change
from BendTorsionWB.exchange.renames import Key, Reference, renames
from BendTorsionWB.objects.proxy import type_of


def document_changes(before, after, by_label: bool = False) -> tuple[Change, ...]:
    """What changed from one document, or split model, to another. Links count by label, results
    not at all. by_label: the other was made of what was written of the first. Raises
    BendTorsionError as `counterparts`."""
    old, new = objects_of(before), objects_of(after)
    copies = [all_objects_of(documents_of(model)) for model in (before, after)]
    in_parts = any(len(documents_of(model)) > 1 for model in (before, after))
    paired = counterparts(old, new, by_label)
    stayed = set(paired.values())
    gone = {key: obj for key, obj in old.items() if key not in stayed}
    came = {key: obj for key, obj in new.items() if key not in paired}
    renamed = renamed_objects(gone, came, {was: key[1] for key, was in paired.items()})
    changes = [
        Change("renamed", kind, name, "", was, name, members_of(copies[1][kind, name]))
        for (kind, was), name in renamed.items()
    ]
    told = {*renamed, *((kind, name) for (kind, _), name in renamed.items())}
    changes += [
        _whole("removed", copies[0][key]) for key, obj in gone.items() if not told & _keys(key, obj)
    ]
    labels = {(key[0], old[was].Label): new[key].Label for key, was in paired.items()}
    for key, obj in new.items():
        if key not in paired:
            changes += [] if told & _keys(key, obj) else [_whole("added", copies[1][key])]
            continue
        was = old[paired[key]]
        follows = key != paired[key]
        title = obj.Label if follows else key[1]
        for name in dict.fromkeys((*inputs_of(was), *inputs_of(obj))):
            if in_parts and divided(obj, name):
                sides = (copies[0][paired[key]], labels), (copies[1][key], {})
                one, other = (_joined(own, name, called) for own, called in sides)
            else:
                one, other = value_of(was, name, labels), value_of(obj, name)
            # Of a row under another name it is known by its label, or named after what is.
            if same(one, other) or (name == "Label" and (follows or _same_rest(was, obj))):
                continue
            what = "renamed" if name == "Label" and key[0] in NAMED else "changed"
            members = members_of(copies[1][key])
            changes.append(Change(what, key[0], title, name, one, other, member=members))
    return tuple(changes)


def _joined(copies: Iterable, name: str, labels: Mapping[Key, str]) -> tuple:
    """What of a model is in each of its documents, together, in alphabetical order."""
    return tuple(sorted({one for obj in copies for one in value_of(obj, name, labels)}))


def _same_rest(one, other) -> bool:
    """Whether two objects named after others are named alike but for these."""
    owners = owner_of(one), owner_of(other)
    return owners != (one, other) and (
        one.Label.removeprefix(owners[0].Label) == other.Label.removeprefix(owners[1].Label)
    )


def _keys(key: Key, obj) -> set[Key]:
    """The key of an object, and that of the member it belongs to."""
    owner = owner_of(obj)
    return {key} if owner == obj else {key, key_of(owner)}


def renamed_objects(
    gone: Mapping[Key, object], came: Mapping[Key, object], known: Mapping[Key, str]
) -> dict[Key, str]:
    """The new name of each object that is gone while one came with the same content under another
    name; a member's with its plates, patterns and bed. known: the names of those that stayed."""
    return renames(_contents(gone), _contents(came), NAMED, known)


def _contents(objects: Mapping[Key, object]) -> dict[Key, dict]:
    found: dict[Key, dict] = {}
    for key, obj in objects.items():
        owner = owner_of(obj)
        if kind_of(owner) not in NAMED or kind_of(obj) == "SheetSet":
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


def _whole(what: str, copies: Sequence) -> Change:
    return Change(what, kind_of(copies[0]), copies[0].Label, member=members_of(copies))


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
