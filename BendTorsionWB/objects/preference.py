# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preferences of FreeCAD that hold for a while only."""

from __future__ import annotations

from contextlib import contextmanager, nullcontext

import FreeCAD


@contextmanager
def preference(group: str, name: str, value: bool):
    """A yes-or-no preference with this value inside the block, and as it was after it."""
    settings = FreeCAD.ParamGet(f"User parameter:BaseApp/Preferences/{group}")
    was_set = name in settings.GetBools()
    before = settings.GetBool(name, False)
    settings.SetBool(name, value)
    try:
        yield
    finally:
        if was_set:
            settings.SetBool(name, before)
        else:
            settings.RemBool(name)


def without_faces():
    """TechDraw views computed without the faces between their lines: finding them takes time with
    the square of the lines, most of a view, and only hatches on screen use them; no file holds
    them. In the window, where somebody may look at hatches, as preferred there."""
    return (
        nullcontext() if FreeCAD.GuiUp else preference("Mod/TechDraw/General", "HandleFaces", False)
    )
