# SPDX-License-Identifier: LGPL-2.1-or-later
"""A geometry file read by FreeCAD's program without a window, where this program cannot be forked:
in FreeCAD's window, and on Windows.

The program is started with this file as its script, and reads the file the environment names.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import FreeCAD

NAMES = ("freecadcmd", "FreeCADCmd")
FILE, ANSWER = "BENDTORSION_TRIAL_FILE", "BENDTORSION_TRIAL_ANSWER"
BEGUN, READ = "begun", "read"


def program() -> str | None:
    """FreeCAD's program without a window: beside FreeCAD itself, or on the path."""
    home = Path(FreeCAD.getHomePath())
    places = [str(home / "bin"), str(home), str(Path(sys.executable).parent)]
    found = (shutil.which(name, path=place) for place in (*places, None) for name in NAMES)
    return next((path for path in found if path), None)


def failure_in_program(path: Path, seconds: float, folder: Path) -> str:
    """Why a file cannot be read, empty when it can or there is no such program. folder: for what
    the program answers."""
    command = program()
    if command is None:
        return ""
    answer = folder / "answer.txt"
    given = {**os.environ, FILE: str(path), ANSWER: str(answer)}
    try:
        subprocess.run(
            [command, __file__],
            env=given,
            cwd=folder,
            timeout=seconds,
            check=False,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        return f"it takes longer than {seconds:.0f} s"
    except OSError:
        return ""
    # Its exit code says little: some releases end with 0 after a fault. One that did not come to
    # the file says nothing about it.
    said = answer.read_text(encoding="utf-8") if answer.is_file() else ""
    return "the reader crashed" if said == BEGUN else ""


def _main() -> None:
    import Part

    answer = Path(os.environ[ANSWER])
    answer.write_text(BEGUN, encoding="utf-8")
    try:
        Part.Shape().read(os.environ[FILE])
    except Exception as problem:  # noqa: BLE001 - what the reader itself refuses is told later
        FreeCAD.Console.PrintLog(f"{problem}\n")
    answer.write_text(READ, encoding="utf-8")
    os._exit(0)


# FreeCAD loads a script as a module of its own, outside the package.
if __name__ == Path(__file__).stem:
    _main()
