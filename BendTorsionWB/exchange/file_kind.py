# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kinds of files by the endings of their names, told before anything is computed for them."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Sequence
from dataclasses import replace
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


def refuse_no_file(path: str | os.PathLike, object: str = "") -> None:
    """Raises BendTorsionError where no file can be: at a link that leads back to itself, a name
    longer than the system takes, a device or a pipe, which may never end. Folders, and what is not
    there, are told by those who read. object: what names the file, the file itself when left out.
    """
    name = Path(path).name
    fields = {"value": name}
    fault = None
    try:
        mode = os.stat(path).st_mode
    except OSError as failure:
        if failure.errno == errno.ELOOP:
            loop = "is a link that leads back to itself"
            put = "put the file itself in its place"
            fault = error("file-unreadable", name, loop, put, **fields)
        elif failure.errno == errno.ENAMETOOLONG:
            long = "is longer than a file's name may be"
            fault = error("file-unreadable", name, long, "shorten it", **fields)
    else:
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            endless = "is a device or a pipe, not a file"
            save = "save what it gives as a file"
            fault = error("file-unreadable", name, endless, save, **fields)
    if fault is None:
        return
    if object:
        fault = replace(fault, object=object, message=f"{name}: {fault.message}")
    raise BendTorsionError(fault)
