# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which folders are of an issue, and that nothing is written into one again."""

from __future__ import annotations

import os
from pathlib import Path

from ..core.finding import BendTorsionError, error

ISSUED = "issued"
TRANSMITTAL = "transmittal"
OUTLINES = "outlines.npz"


def is_issued(path: str | os.PathLike) -> bool:
    """Whether a path is an issue or lies in one, moved elsewhere too, or in a folder of issues."""
    place = Path(os.path.realpath(path))
    return any(_is_issue(p) or _holds_issues(p) for p in (place, *place.parents))


def refuse_issued(path: str | os.PathLike) -> None:
    """Raises BendTorsionError where `is_issued`."""
    if is_issued(path):
        raise BendTorsionError(
            error(
                "folder-issued",
                str(path),
                "belongs to an issue, and nothing is written into one again",
                "choose a place outside the folder of issues",
            )
        )


def _is_issue(folder: Path) -> bool:
    try:
        return all((folder / name).is_file() for name in (f"{TRANSMITTAL}.json", OUTLINES))
    except OSError:
        # What may not be looked into is refused by whoever writes there.
        return False


def _holds_issues(folder: Path) -> bool:
    # What begins with a point was never issued: the program was killed over it.
    return folder.name == ISSUED and any(map(_is_issue, folder.glob("[!.]*")))
