# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which object of one document is which of another: of the same row, or under a label by hand."""

from __future__ import annotations

from collections.abc import Mapping

from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.document_objects import (
    FILE_SHAPE,
    NAMED,
    inputs_of,
    key_of,
    kind_of,
    owner_of,
    same,
    value_of,
)
from BendTorsionWB.exchange.renames import Key


def counterparts(
    old: Mapping[Key, object], new: Mapping[Key, object], by_label: bool = False
) -> dict[Key, Key]:
    """The key in `old` of each object of `new` that is the same: of the same row; under the label
    it was given by hand; and made of one of these, as its plates and nodes. by_label: a label by
    hand counts before the row. Raises BendTorsionError where a label by hand is the name of another
    row, and it cannot be told which of the two the object is."""
    found = {key: key for key in new if key in old}
    exchanged = _exchanged(old, new, by_label)
    if exchanged:
        others = {key: was for key, was in exchanged.items() if key != was}
        gone, came = set(others.values()), set(others)
        found = {
            key: key
            for key in found
            if not ({key, *_owners(old[key])} & gone or {key, *_owners(new[key])} & came)
        } | exchanged
    stayed = set(found.values())
    sides = (
        {key: obj for key, obj in old.items() if key not in stayed},
        {key: obj for key, obj in new.items() if key not in found},
    )
    for identity in (_labelled, _following):
        known = {was: key for key, was in found.items()}
        gone, came = {}, {}
        for side, names, keys in zip(sides, (known, {}), (gone, came)):
            for key, obj in side.items():
                keys.setdefault(identity(key, obj, names), []).append(key)
        for own in came.keys() & gone.keys() - {None}:
            if len(gone[own]) == 1 == len(came[own]):
                found[came[own][0]] = gone[own][0]
    return {key: found[key] for key in new if key in found}


def _labelled(key: Key, obj, known: Mapping[Key, Key]) -> object:
    """What an object with a row of its own is known by when its label is not that of the row."""
    return (key[0], obj.Label) if key[0] in NAMED and key[0] != "File" else None


def _owners(obj) -> list[Key]:
    """The keys of what an object is named after; a node of its members, a file's shape of the axis
    or surface."""
    if kind_of(obj) == "Node":
        return [key_of(one) for one in (obj.Through, obj.Other) if one is not None]
    if kind_of(obj) == "File":
        return [key_of(user) for user in obj.InList if kind_of(user) in ("Surface", "Axis")][:1]
    return [key_of(owner_of(obj))]


def _following(key: Key, obj, known: Mapping[Key, Key]) -> object:
    """What an object named after another is known by: that one and the rest of its name, and a node
    by its members. known: other keys of these to tell instead."""
    owners = _owners(obj)
    if key[0] == "Node":
        return ("Node", *(known.get(one, one) for one in owners))
    if not owners or owners == [key]:
        return None
    [named] = owners
    return (key[0], known.get(named, named), key[1].removeprefix(named[1]))


def _exchanged(old: Mapping[Key, object], new: Mapping[Key, object], by_label: bool) -> dict:
    """The key in `old` of each object of `new` where labels by hand are names of other rows, as
    when two members were given each other's: by row or by label, whichever of the two has objects
    made from the very same. Raises BendTorsionError where neither has, or some of both."""
    found: dict[Key, Key] = {}
    stayed: dict[Key, Key] = {}
    for kind in NAMED[1:]:
        sides = [{key: obj for key, obj in side.items() if key[0] == kind} for side in (old, new)]
        labels = [_by_label(side) for side in sides]
        rows = {key: key for key in sides[1] if key in sides[0]}
        labelled = {key: labels[0][label] for label, key in labels[1].items() if label in labels[0]}
        both = {
            key: was
            for key, was in labelled.items()
            if rows.get(key, was) != was or rows.get(was, key) != key
        }
        if both:
            by_row = {key: key for key in {*both, *both.values()} if key in rows}
            found |= _decided(old, new, both, by_row, stayed, by_label)
        told = {was: key for key, was in found.items() if key[0] == kind}
        others = {was: key for key, was in {**labelled, **rows}.items() if key not in found}
        stayed |= {**others, **told}
    return found


def _by_label(objects: Mapping[Key, object]) -> dict[str, Key]:
    """The keys of objects by label, where no other has the same."""
    found: dict[str, list[Key]] = {}
    for key, obj in objects.items():
        found.setdefault(obj.Label, []).append(key)
    return {label: keys[0] for label, keys in found.items() if len(keys) == 1}


def _decided(
    old: Mapping[Key, object],
    new: Mapping[Key, object],
    labelled: dict[Key, Key],
    rows: dict[Key, Key],
    stayed: Mapping[Key, Key],
    by_label: bool,
) -> dict[Key, Key]:
    """Of two ways to pair objects the one that is right; raises BendTorsionError."""
    if by_label:
        return labelled
    same_labelled, same_rows = (
        [key for key, was in pairs.items() if _made_alike(old[was], new[key], stayed)]
        for pairs in (labelled, rows)
    )
    if len(same_rows) == len(rows) or (same_rows and not same_labelled):
        return rows
    if same_labelled and not same_rows:
        return labelled
    raise BendTorsionError(_untold(old[was], was) for was in labelled.values())


def _untold(obj, row: Key) -> Finding:
    return error(
        "labels-exchanged",
        obj.Label,
        f"{row[0]} {obj.Label} follows the row {row[1]}, and {obj.Label} is a row as well; which "
        "of the two it is now cannot be told: neither is as the object",
        f"give it its label {row[1]} back and run update; change names in the schedule after that",
        position="property Label",
        value=obj.Label,
        limit=row[1],
    )


def _made_alike(one, other, stayed: Mapping[Key, Key]) -> bool:
    """Whether two objects are made from the same, but for their labels. stayed: by key of what they
    link to, its key beside the other."""
    names = dict.fromkeys((*inputs_of(one), *inputs_of(other)))
    return all(
        same(_value(one, name, stayed), _value(other, name, {}))
        for name in names
        if name != "Label"
    )


def _value(obj, name: str, stayed: Mapping[Key, Key]):
    """A property as plain values, links by their keys beside the other, shapes by what they are."""
    value = getattr(obj, name, None)
    items = value if isinstance(value, (tuple, list)) else (value,)
    if not any(hasattr(item, "Label") for item in items):
        return value_of(obj, name)
    return tuple(_link(item, stayed) if hasattr(item, "Label") else item for item in items)


def _link(obj, stayed: Mapping[Key, Key]):
    if kind_of(obj) == "File":
        return value_of(obj, FILE_SHAPE)
    return stayed.get(key_of(obj), key_of(obj))
