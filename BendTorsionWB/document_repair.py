# SPDX-License-Identifier: LGPL-2.1-or-later
"""A saved document whose objects lost what computes them, made whole."""

from __future__ import annotations

import os
from pathlib import Path

import FreeCAD

from BendTorsionWB.core.finding import Finding
from BendTorsionWB.document_update import open_document
from BendTorsionWB.model_files import checked_recompute, save
from BendTorsionWB.objects.repair import repair


def repair_document(
    path: str | os.PathLike, out: str | os.PathLike | None = None
) -> tuple[list[str], tuple[Finding, ...]]:
    """Repair a document in place, or as another file; the labels of what was repaired, and the
    errors of all objects. A document with nothing to repair is not written. Raises
    BendTorsionError for one that cannot be read, repaired or written."""
    document = open_document(Path(path))
    try:
        labels = [obj.Label for obj in repair(document)]
        findings = checked_recompute(document)
        if labels:
            save(document, Path(out or path))
    finally:
        FreeCAD.closeDocument(document.Name)
    return labels, findings
