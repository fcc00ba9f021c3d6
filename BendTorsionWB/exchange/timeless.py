# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD stamps into its files (times, random ids) replaced, so that the same input gives the
same bytes."""

from __future__ import annotations

import hashlib
import os
import re
import uuid
import zipfile
from collections.abc import Sequence
from pathlib import Path

TIME = "1980-01-01T00:00:00Z"
TOUCHED = 1
"""Of the status of a property: set since its object was computed."""


def timeless_document(path: Path, shown: Sequence[str] = ()) -> None:
    """A FreeCAD document rewritten in place: entries in order, without times and random ids.

    shown: names of its objects, none of which has a view of its own making, that are visible when
    it is opened; without a window FreeCAD saves no views, and what has none is hidden.
    """
    part = path.with_name(f"{path.name}.new")
    try:
        with zipfile.ZipFile(path) as source, zipfile.ZipFile(part, "w") as target:
            # One by one: a model of hundreds of members has as many MB.
            for info in source.infolist():
                content = source.read(info)
                if info.filename == "Document.xml":
                    content = _timeless_xml(content.decode()).encode()
                _pack(target, info.filename, content)
            if shown:
                _pack(target, "GuiDocument.xml", _views(shown).encode())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def _pack(target: zipfile.ZipFile, name: str, content: bytes) -> None:
    info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
    info.compress_type = zipfile.ZIP_DEFLATED
    target.writestr(info, content, compresslevel=3)


def _views(shown: Sequence[str]) -> str:
    visible = (
        '<Properties Count="1"><Property name="Visibility" type="App::PropertyBool">'
        '<Bool value="true"/></Property></Properties>'
    )
    views = "".join(f'<ViewProvider name="{name}">{visible}</ViewProvider>' for name in shown)
    return (
        "<?xml version='1.0' encoding='utf-8'?>\n"
        '<Document SchemaVersion="1"><ViewProviderData Count="'
        f'{len(shown)}">{views}</ViewProviderData><Camera settings=""/></Document>\n'
    )


def _timeless_xml(text: str) -> str:
    for stamp in ("CreationDate", "LastModifiedDate"):
        text = re.sub(
            rf'(<Property name="{stamp}"[^>]*>\s*<String value=")[^"]*', rf"\g<1>{TIME}", text
        )
    # A link to another document keeps the time that one was saved.
    text = re.sub(r'(<XLink file="[^"]+" stamp=")[^"]*', rf"\g<1>{TIME}", text)
    # TechDraw computes views of its own accord, sooner or later, and leaves properties touched.
    # What is to be computed is kept with the objects; FreeCAD forgets this when it has read them.
    text = re.sub(r'(<_?Property [^>]*?) status="(\d+)"', _untouched, text)
    # Objects count their ids on from a random number.
    numbers = [int(n) for n in re.findall(r'<Object type="[^"]*" name="[^"]*" id="(\d+)"', text)]
    first = min(numbers, default=1)
    text = re.sub(
        r'(<Object type="[^"]*" name="[^"]*" id=")(\d+)',
        lambda match: f"{match.group(1)}{int(match.group(2)) - first + 1}",
        text,
    )
    # An id of the document's own, from what is in it.
    text = re.sub(r'(<Uuid value=")[^"]*', r"\g<1>", text)
    own = uuid.uuid5(uuid.NAMESPACE_OID, hashlib.sha256(text.encode()).hexdigest())
    return re.sub(r'(<Uuid value=")', rf"\g<1>{own}", text)


def _untouched(tag: re.Match) -> str:
    status = int(tag.group(2)) & ~TOUCHED
    return f'{tag.group(1)} status="{status}"' if status else tag.group(1)
