# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which documents the one of a split model links to: it holds no member of its own."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.etree import ElementTree

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.file_kind import refuse_no_file


def linked_documents(path: Path) -> tuple[str, ...]:
    """Names of the documents that a saved document links to, as it says them; none for a document
    with objects of ours, and for what is no document. Nothing is opened in FreeCAD. Raises
    BendTorsionError for a device or a pipe, as `refuse_no_file`."""
    refuse_no_file(path)
    try:
        with zipfile.ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("Document.xml"))
    except (OSError, zipfile.BadZipFile, KeyError, ElementTree.ParseError, RuntimeError):
        return ()
    if any(item.get("name") == "BT_Type" for item in root.iter("Property")):
        return ()
    files = (
        link.get("file", "")
        for item in root.iter("Property")
        if item.get("name") == "LinkedObject"
        for link in item.iter("XLink")
    )
    return tuple(dict.fromkeys(name for name in files if name))


def refuse_linked(path: Path) -> None:
    """Raises BendTorsionError for the document of a split model."""
    names = linked_documents(path)
    if names:
        told = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
        raise BendTorsionError(
            error(
                "document-linked",
                path.name,
                "holds no member itself: it links to the documents of a split model",
                f"open or name one of these: {told}",
                value=str(path),
            )
        )
