# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents to start from: copies of those in resources/templates, driven by a spreadsheet."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.file_kind import DOCUMENT, check_ending
from BendTorsionWB.exchange.whole_file import write_whole

FOLDER = Path(__file__).resolve().parent.parent / "resources" / "templates"
TITLES = {
    "member": "one member on a dome, with a section change",
    "surface": "three members on one surface, by planes that cut it",
    "project": "three members on one surface, with drawing sheets",
}


def template_titles() -> Mapping[str, str]:
    """What each template holds, by its name."""
    return TITLES


def new_document(template: str, path: str | os.PathLike) -> None:
    """Copy a template to a new document. Raises BendTorsionError for unknown names, a name that
    does not end in .FCStd, and a file that is there already."""
    path = Path(path)
    if template not in TITLES:
        known = ", ".join(TITLES)
        raise BendTorsionError(
            error("template-unknown", template, "there is no such template", f"use {known}")
        )
    check_ending(path, DOCUMENT)
    if path.exists():
        raise BendTorsionError(
            error("file-exists", str(path), "is there already", "choose another name")
        )
    write_whole(path, (FOLDER / f"{template}.FCStd").read_bytes())
