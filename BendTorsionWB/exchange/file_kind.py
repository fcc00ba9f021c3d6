# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kinds of files by the endings of their names, told before anything is computed for them."""

from __future__ import annotations

import errno
import os
from collections.abc import Sequence
from pathlib import Path

from ..core.finding import BendTorsionError, error

FIGURES = (".xlsx", ".json")
"""Endings of what figures are written to."""
CHANGES = (".xlsx", ".csv", ".json")
"""Endings of what changes are written to."""
DOCUMENT = (".FCStd",)


def check_ending(path: str | os.PathLike, endings: Sequence[str]) -> None:
    """Raises BendTorsionError for a name that ends in none of these, capital letters apart."""
    path = Path(path)
    if path.suffix.lower() in [ending.lower() for ending in endings]:
        return
    known = ", ".join(endings)
    raise BendTorsionError(
        error(
            "file-kind",
            path.name,
            "the end of its name is that of no kind of file there is here",
            f"use one that ends in {known}",
            value=path.suffix,
            limit=known,
        )
    )


def refuse_loop(path: str | os.PathLike, object: str = "") -> None:
    """Raises BendTorsionError for a link that leads back to itself: no file can be read there.
    object: what names the file, the file itself when left out."""
    try:
        os.stat(path)
    except OSError as failure:
        if failure.errno == errno.ELOOP:
            name, told = Path(path).name, "is a link that leads back to itself"
            raise BendTorsionError(
                error(
                    "file-unreadable",
                    object or name,
                    f"{name} {told}" if object else told,
                    "put the file itself in its place",
                    value=str(path),
                )
            ) from None
