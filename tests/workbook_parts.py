# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a workbook says, whichever release of openpyxl wrote it."""

import io
import zipfile
from xml.etree import ElementTree

LIBRARY = "docProps/app.xml"
"""Names the library that wrote the file, and its release."""


def workbook_parts(content: bytes) -> dict[str, str]:
    """By name, the parts of a workbook in XML's canonical form: attributes in one order."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {
            name: ElementTree.canonicalize(archive.read(name).decode("utf-8"))
            for name in archive.namelist()
            if name != LIBRARY
        }
