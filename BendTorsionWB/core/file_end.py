# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a file of others' geometry has its end: readers take what is there of one cut short, and
say nothing."""

from __future__ import annotations

import os
import re
from pathlib import Path

CUT_SHORT = "the file is cut short, as when saving or copying it was interrupted"
MEND = "save or copy it again, or restore it"
_TAIL = 4096
"""Bytes at the end of a file, and at its start, that are looked at."""
_STEP_END = re.compile(rb"END-ISO-10303-21\s*;", re.IGNORECASE)
_IGES_END = re.compile(rb"^.{72}T", re.MULTILINE)
_DXF_BINARY = b"AutoCAD Binary DXF"
_DXF_START = re.compile(rb"(?:\xef\xbb\xbf)?\s*(?:999|0)[ \t]*\r?\n")
_DXF_END = re.compile(rb"^[ \t]*EOF\s*\Z", re.MULTILINE)
_BREP_SHAPES = re.compile(rb"^TShapes\s+([0-9]+)\s*$", re.MULTILINE)
_BREP_END = re.compile(rb"\*\s*[-+ie][0-9]+ [0-9]+\s*\Z")


def is_cut_short(path: str | os.PathLike, kind: str) -> bool:
    """Whether a file begins as one of its kind (STEP, IGES, DXF or BREP) and lacks what ends it:
    the closing line of ISO 10303-21, the terminate section of IGES, EOF of DXF, the last shape of a
    BREP text. Raises OSError."""
    with open(path, "rb") as stream:
        start = stream.read(_TAIL)
        stream.seek(max(0, stream.seek(0, os.SEEK_END) - _TAIL))
        end = stream.read()
    if kind == "STEP":
        # Signatures may follow the closing line, of any length.
        whole = _STEP_END.search(end) or _STEP_END.search(Path(path).read_bytes())
        return b"ISO-10303-21" in start.upper() and not whole
    if kind == "IGES":
        return start[72:73] == b"S" and not _IGES_END.search(end)
    if kind == "DXF":
        if start.startswith(_DXF_BINARY):
            return not end.rstrip(b"\0\x1a").endswith(b"EOF")
        return bool(_DXF_START.match(start)) and not _DXF_END.search(end.rstrip(b"\0\x1a"))
    return b"CASCADE Topology V" in start and _lacks_shapes(Path(path).read_bytes())


def _lacks_shapes(content: bytes) -> bool:
    """Whether a BREP text has fewer shapes than it says, each ended by a star, or no last one."""
    said = _BREP_SHAPES.search(content)
    if said is None:
        return True
    shapes = content[said.end() :]
    return shapes.count(b"*") < int(said.group(1)) or not _BREP_END.search(shapes)
