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
_LAST = b"END-ISO-10303-21;"
_BEYOND = 100_000
"""Bytes written after those of the kernel, which does not tell when the disk is full."""


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
        path.write_bytes(solids)
        try:
            shape = Part.Shape()
            shape.importBinary(str(path))
            with _as_ap214():
                shape.exportStep(str(written))
        except RuntimeError as failure:
            raise OSError(str(failure)) from failure
        content = written.read_bytes()
    if not content.rstrip().endswith(_LAST):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    return content


@contextmanager
def _as_ap214() -> Iterator[None]:
    """The kernel writes AP214 inside the block, whatever FreeCAD's preferences say: AP203 has
    records of its own for each product."""
    group = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Part/STEP")
    Part.setStaticValue(_SCHEMA, _AP214)
    try:
        yield
    finally:
        Part.setStaticValue(_SCHEMA, group.GetString("Scheme", _AP214))


@functools.cache
def kernel() -> str:
    """What a text depends on besides its solids: the kernel's version, and how it is set (units).
    Raises OSError."""
    box = step_text(solids_as_bytes([Part.makeBox(1.0, 1.0, 1.0).Solids[0]]))
    return f"{Part.OCC_VERSION} {box.partition(b'MANIFOLD_SOLID_BREP')[2].decode('latin-1')}"
