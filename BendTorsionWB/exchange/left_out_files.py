# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kinds of files that a build can be told to leave out, and which of them there are no longer."""

from __future__ import annotations

import re
from collections.abc import Iterable

MODEL, SHEETS, SVG = "model", "drawing sheets", "drawing sheets as SVG"
_KINDS = {
    MODEL: re.compile(r"model(/[^/]+)?\.(FCStd|step|ifc)"),
    SHEETS: re.compile(r"sheets/[^/]+\.pdf"),
    SVG: re.compile(r"sheets/[^/]+\.svg"),
}


def kinds_gone(before: Iterable[str], now: Iterable[str]) -> dict[str, list[str]]:
    """By kind: the names before, in their order, of the kinds of which there is not one name now.
    A file that is gone while others of its kind are there is of a member, split or node that is."""
    before, now = list(before), list(now)
    found = {}
    for kind, pattern in _KINDS.items():
        names = [name for name in before if pattern.fullmatch(name)]
        if names and not any(map(pattern.fullmatch, now)):
            found[kind] = names
    return found
