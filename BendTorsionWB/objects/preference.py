# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preferences of FreeCAD, and of a document, that hold for a while only."""

from __future__ import annotations

from contextlib import contextmanager, nullcontext

import FreeCAD


@contextmanager
def preference(group: str, name: str, value: bool | int):
    """A yes-or-no preference, or one that is a whole number, with this value inside the block, and
    as it was after it."""
    settings = FreeCAD.ParamGet(f"User parameter:BaseApp/Preferences/{group}")
    kind = "Bool" if isinstance(value, bool) else "Int"
    was_set = name in getattr(settings, f"Get{kind}s")()
    before = getattr(settings, f"Get{kind}")(name)
    getattr(settings, f"Set{kind}")(name, value)
    try:
        yield
    finally:
        if was_set:
            getattr(settings, f"Set{kind}")(name, before)
        else:
            getattr(settings, f"Rem{kind}")(name)


@contextmanager
def saved_in_binary():
    """Documents saved with the shapes in binary form, which any FreeCAD reads: smaller than as text
    and to the last digit; and not packed, for what packs them again."""
    with (
        preference("Document", "SaveBinaryBrep", True),
        preference("Document", "CompressionLevel", 0),
    ):
        yield


def without_faces():
    """TechDraw views computed without the faces between their lines: finding them takes time with
    the square of the lines, most of a view, and only hatches on screen use them; no file holds
    them. In the window, where somebody may look at hatches, as preferred there."""
    return (
        nullcontext() if FreeCAD.GuiUp else preference("Mod/TechDraw/General", "HandleFaces", False)
    )


@contextmanager
def recomputes(document):
    """A document that recomputes inside the block, also where FreeCAD's *Skip recomputes* is on."""
    skipped = document.RecomputesFrozen
    document.RecomputesFrozen = False
    try:
        yield
    finally:
        document.RecomputesFrozen = skipped
