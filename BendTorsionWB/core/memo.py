# SPDX-License-Identifier: LGPL-2.1-or-later
"""Memoised arrows: results kept by a content hash of their inputs, never by identity."""

from __future__ import annotations

import functools
import hashlib
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from weakref import WeakSet

import numpy as np

KEPT = 12000
"""Results kept in memory; the least recently used go first."""

_results: OrderedDict[str, object] = OrderedDict()


def content_hash(*values) -> str:
    """Hash of plain values, arrays, dataclasses and results of memoised functions (which carry
    the hash of what made them); the same in every process."""
    parts: list[bytes] = []
    for value in values:
        _feed(parts.append, value)
    return hashlib.sha256(b"".join(parts)).hexdigest()


_PLAIN = frozenset({type(None), str, bytes, bool, int, float})
_fields: dict[type, tuple[tuple[bytes, str], ...]] = {}


def _feed(feed: Callable[[bytes], None], value) -> None:
    kind = type(value)
    # Most values by far are of these kinds.
    if kind in _PLAIN:
        feed(f"{kind.__name__} {value!r};".encode())
        return
    if kind is tuple or kind is list:
        feed(f"[{len(value)}".encode())
        for item in value:
            _feed(feed, item)
        feed(b"]")
        return
    made_from = getattr(value, "_made_from", None)
    if made_from is not None:
        feed(b"made " + made_from.encode())
    elif isinstance(value, np.ndarray):
        feed(f"array {value.shape} {value.dtype}".encode())
        feed(np.ascontiguousarray(value).tobytes())
    elif kind in _fields or is_dataclass(kind):
        if kind not in _fields:
            _fields[kind] = tuple((f"{own.name}=".encode(), own.name) for own in fields(kind))
        feed(f"{kind.__name__}(".encode())
        for name, key in _fields[kind]:
            feed(name)
            _feed(feed, getattr(value, key))
        feed(b")")
    elif isinstance(value, (tuple, list)):
        feed(f"[{len(value)}".encode())
        for item in value:
            _feed(feed, item)
        feed(b"]")
    elif isinstance(value, dict):
        feed(f"{{{len(value)}".encode())
        for key in sorted(value):
            _feed(feed, key)
            _feed(feed, value[key])
        feed(b"}")
    elif isinstance(value, (str, bytes, int, float)):
        feed(f"{kind.__name__} {value!r};".encode())
    else:
        raise TypeError(f"no content hash for {kind.__name__}")


def memoised(function: Callable) -> Callable:
    """The function with its results kept by the content of its arguments (all positional)."""

    @functools.wraps(function)
    def arrow(*arguments):
        key = content_hash(function.__qualname__, *arguments)
        if key in _results:
            _results.move_to_end(key)
            return _results[key]
        result = function(*arguments)
        object.__setattr__(result, "_made_from", key)
        remember(result)
        return result

    return arrow


def remember(result) -> None:
    """Keep a result made elsewhere (a worker process) under the hash it carries."""
    _results[result._made_from] = result
    while len(_results) > KEPT:
        _results.popitem(last=False)


def forget_all() -> None:
    """Empty the memo, and all that is kept besides."""
    _results.clear()
    for one in Kept.all:
        one.clear()


def stamped(value):
    """The value, to be told from now on by the hash of its content, which is not taken again."""
    if not made_from(value):
        object.__setattr__(value, "_made_from", content_hash(value))
    return value


def made_from(value) -> str:
    """The content hash a memoised result carries; empty for what was made otherwise."""
    return getattr(value, "_made_from", "")


class Kept(OrderedDict):
    """Parts of results by the content they are made from, so that an edit makes only those it
    changes; the least recently used go first."""

    all: WeakSet[Kept] = WeakSet()
    __hash__ = object.__hash__

    def __init__(self, most: int = KEPT):
        super().__init__()
        self.most = most
        self.all.add(self)

    def recall(self, key):
        """The value of a key, or None."""
        if key in self:
            self.move_to_end(key)
        return self.get(key)

    def keep(self, key, value) -> None:
        """Keep a value under a key."""
        self[key] = value
        if len(self) > self.most:
            self.popitem(last=False)
