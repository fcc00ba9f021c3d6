# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether files named by a schedule may lie outside its folder: not unless whoever runs it says so.

A schedule from elsewhere must not make this program open other files of the machine.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path, PureWindowsPath

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.file_kind import refuse_no_file

_allowed = ContextVar("files outside the schedule's folder are allowed", default=False)


@contextmanager
def outside_allowed(allowed: bool = True) -> Iterator[None]:
    """Within the block, files outside a schedule's folder are read as well."""
    token = _allowed.set(allowed)
    try:
        yield
    finally:
        _allowed.reset(token)


def file_of(folder: str | os.PathLike, name: str, object: str) -> Path:
    """The path of a file named by a schedule; raises BendTorsionError for one outside its folder,
    also by a link, and for what is no file."""
    path = Path(folder) / name
    refuse_no_file(path, object)
    refuse_outside(folder, name, object)
    if path.is_dir():
        mend = "name a STEP, IGES, BREP, DXF or Rhino file"
        raise BendTorsionError(error("file-kind", object, f"{name}: is no file", mend, value=name))
    return path


def refuse_outside(folder: str | os.PathLike, name: str, object: str) -> None:
    """Raises BendTorsionError for a file that lies outside a schedule's folder, also by a link,
    unless those are read as well."""
    try:
        inside = Path(folder or ".").resolve() in (Path(folder) / name).resolve().parents
    except (OSError, ValueError, RuntimeError):
        inside = False
    # Elsewhere than on Windows its paths are names of files that happen to hold a colon.
    inside = inside and not PureWindowsPath(name).is_absolute()
    if not inside and not _allowed.get():
        raise BendTorsionError(
            error(
                "file-outside",
                object,
                f"{name}: lies outside the schedule's folder",
                "put it beside the schedule, or add --outside-files if you trust the schedule",
                value=name,
            )
        )
