# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds FreeCAD's library folder, so that plain Python can import FreeCAD as a module."""

import os
import sys
from importlib.util import find_spec
from pathlib import Path

CANDIDATES = (
    "/usr/lib/freecad-python3/lib",
    "/usr/lib/freecad/lib",
    "/usr/lib64/freecad/lib",
    "/usr/local/lib/freecad/lib",
)


def append() -> None:
    """Append FreeCAD's library folder to `sys.path` unless FreeCAD can be imported already.

    `FREECAD_LIB` names the folder when it is not one of Debian's. Appended, never prepended:
    the folder is full of shared objects that would shadow other packages.
    """
    if "FreeCAD" in sys.modules or find_spec("FreeCAD") is not None:
        return
    for folder in (os.environ.get("FREECAD_LIB", ""), *CANDIDATES):
        if folder and (Path(folder) / "FreeCAD.so").exists():
            sys.path.append(folder)
            return


def missing() -> str:
    """One line saying how to install FreeCAD, for when `import FreeCAD` fails."""
    return (
        "FreeCAD is not installed for this Python: on Debian run 'apt-get install freecad' and use "
        "/usr/bin/python3, or set FREECAD_LIB to the folder that holds FreeCAD.so"
    )
