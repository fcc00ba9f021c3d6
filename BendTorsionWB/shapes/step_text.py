# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids as the kernel writes them to STEP, by way of bytes that can be handed to any process."""

from __future__ import annotations

import errno
import functools
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import FreeCAD
import Part

_SCHEMA, _AP214 = "write.step.schema", "AP214IS"
_UNIT, _UNITS = "write.step.unit", ("MM", "M", "INCH")
"""The kernel's names for the units that FreeCAD's preference numbers."""
_PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Part"
_LAST = b"END-ISO-10303-21;"
_BEYOND = 100_000
"""Bytes written after those of the kernel, which does not tell when the disk is full."""
_READINGS = 20
"""After how many readings solids are taken as they are then, whatever comes next."""


def solids_as_bytes(solids: Sequence[Part.Shape]) -> bytes:
    """The solids to the bit. Raises OSError."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "solids.bin"
        try:
            Part.Compound(list(solids)).exportBinary(str(path))
        except RuntimeError as failure:
            raise OSError(str(failure)) from failure
        content = path.read_bytes()
        with open(path, "ab") as stream:
            stream.write(bytes(_BEYOND))
    return content


def step_text(solids: bytes) -> bytes:
    """The STEP file of what `solids_as_bytes` gave: one product of these solids, in their order.
    Raises OSError."""
    with tempfile.TemporaryDirectory() as folder:
        path, written = Path(folder) / "solids.bin", Path(folder) / "solids.step"
        try:
            shape = _read(settled(solids, path), path)
            with _as_ours():
                shape.exportStep(str(written))
        except RuntimeError as failure:
            raise OSError(str(failure)) from failure
        content = written.read_bytes()
    if not content.rstrip().endswith(_LAST):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    return content


def settled(solids: bytes, path: Path) -> bytes:
    """The same for solids as they were computed and as they come back from documents, however often
    they were saved. path: of a file to write and read. Raises OSError and RuntimeError.

    The kernel makes directions it reads of length 1 again and axes square, which changes their last
    bits: after a few readings the same states come again and again, and the first of these in the
    order of their bytes is taken.
    """
    seen = [solids]
    while len(seen) <= _READINGS:
        _read(seen[-1], path).exportBinary(str(path))
        content = path.read_bytes()
        if content in seen:
            return min(seen[seen.index(content) :])
        seen.append(content)
    return seen[-1]


def _read(solids: bytes, path: Path) -> Part.Shape:
    path.write_bytes(solids)
    shape = Part.Shape()
    shape.importBinary(str(path))
    return shape


@contextmanager
def _as_ours() -> Iterator[None]:
    """The kernel writes AP214 in mm inside the block, whatever FreeCAD's preferences say: AP203 has
    records of its own for each product, and members of one file are made at different times."""
    group = FreeCAD.ParamGet(f"{_PREFERENCES}/STEP")
    Part.setStaticValue(_SCHEMA, _AP214)
    Part.setStaticValue(_UNIT, _UNITS[0])
    try:
        yield
    finally:
        Part.setStaticValue(_SCHEMA, group.GetString("Scheme", _AP214))
        chosen = group.GetInt("Unit", 0)
        Part.setStaticValue(_UNIT, _UNITS[chosen if 0 <= chosen < len(_UNITS) else 0])


def kernel() -> str:
    """What a text depends on besides its solids: the kernel's version, and how it is set. Raises
    OSError."""
    # Which curves it writes on surfaces is left to the preference, which may change meanwhile.
    return _kernel(FreeCAD.ParamGet(f"{_PREFERENCES}/General").GetInt("WriteSurfaceCurveMode", -1))


@functools.cache
def _kernel(curves: int) -> str:
    box = step_text(solids_as_bytes([Part.makeBox(1.0, 1.0, 1.0).Solids[0]]))
    told = box.partition(b"MANIFOLD_SOLID_BREP")[2].decode("latin-1")
    return f"{Part.OCC_VERSION} {curves} {told}"
