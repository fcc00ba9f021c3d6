# SPDX-License-Identifier: LGPL-2.1-or-later
"""Adds commands to FreeCAD, from a file that has the name of the package.

FreeCAD has the name of the file that adds a Python command imported by every macro the command is
recorded in, as if it were a module of its own; this one can be, wherever the macro runs.
"""

import FreeCADGui


def add(commands) -> None:
    """Add `command.Command`s by their full names."""
    for command in commands:
        FreeCADGui.addCommand(command.full_name, command)
