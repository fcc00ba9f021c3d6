# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: real keys, as the X server tells of them."""

import os
import subprocess

import steps
import typist
from PySide import QtGui


def strike(*names, pause=2):
    """Keys one after the other, by their X names, each with its modifiers: `Shift_L+Down`."""
    for name in names:
        typist.hit(name)
        steps.settle(pause)


def write(text):
    """Letters and digits, as typed."""
    strike(*(typist.NAMES.get(letter, letter) for letter in text), pause=1)


def begin_beside(gap, *texts):
    """Begin to type texts, keys as `@Tab` and clicks as `@500,300`, some seconds apart; the process
    that does."""
    command = ["/usr/bin/python3", typist.__file__, str(gap), *texts]
    # The program's own libraries are none of Python's.
    given = {name: text for name, text in os.environ.items() if not name.startswith("PYTHON")}
    return subprocess.Popen(command, env=given)


def type_beside(gap, *texts):
    """Type as `begin_beside` does, while the window works, and let it catch up."""
    process = begin_beside(gap, *texts)
    while process.poll() is None:
        steps.settle(1)
    steps.settle(12)


def active(widget):
    """Give a window the keyboard, as a window manager does; there is none on a virtual screen."""
    widget.activateWindow()
    steps.settle(3)
    return QtGui.QApplication.activeWindow() is widget
