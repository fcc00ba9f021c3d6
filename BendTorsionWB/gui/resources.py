# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paths of the files the window shows. Imports nothing of FreeCAD: read at start-up."""

from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "resources"


def icon(name: str) -> str:
    """Path of the icon called `name`, as the text FreeCAD's resource dictionaries take."""
    return str(FOLDER / "icons" / f"{name}.svg")
