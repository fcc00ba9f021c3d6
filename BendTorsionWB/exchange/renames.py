# SPDX-License-Identifier: LGPL-2.1-or-later
"""What left and what came under another name with the very same content: renamed, by its looks."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

Key = tuple[str, str]
"""Kind and name of a row or an object."""


@dataclass(frozen=True)
class Reference:
    """A value that names another row or object."""

    kind: str
    name: str


def renames(
    gone: Mapping[Key, Mapping[object, object]],
    came: Mapping[Key, Mapping[object, object]],
    kinds: Sequence[str],
    known: Mapping[Key, str] = MappingProxyType({}),
) -> dict[Key, str]:
    """The new name of each that is gone while one came with the same content, and no other on
    either side has it. kinds: in an order in which each refers to those before it only, so that a
    member on a renamed axis is the same too; contents: values by what they are of, numbers the
    same to 12 digits; known: names of what stayed, as of now."""
    found: dict[Key, str] = {}
    for kind in kinds:
        names = ChainMap(found, known)
        old, new = ({}, {})
        for side, contents in ((old, gone), (new, came)):
            for (own, name), content in contents.items():
                if own == kind:
                    words = repr(sorted((repr(k), _plain(v, names)) for k, v in content.items()))
                    side.setdefault(words, []).append(name)
        for words, names in old.items():
            if len(names) == 1 == len(new.get(words, ())):
                found[kind, names[0]] = new[words][0]
    return found


def _plain(value, found: Mapping[Key, str]):
    """A value as it compares; what it refers to under its new name."""
    if isinstance(value, Reference):
        return value.kind, found.get((value.kind, value.name), value.name)
    if isinstance(value, float):
        return f"{value:.12g}"
    if isinstance(value, (tuple, list)):
        return tuple(_plain(item, found) for item in value)
    return repr(value)
