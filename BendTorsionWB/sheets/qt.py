# SPDX-License-Identifier: LGPL-2.1-or-later
"""Qt for Python without a window: PySide2 or PySide6, whichever this FreeCAD runs on."""

from __future__ import annotations

import sys
from importlib import import_module

from ..core.finding import BendTorsionError, error

BINDINGS = ("PySide2", "PySide6")


def qt_modules():
    """QtCore and QtGui, of the binding that is loaded already if one is: a process cannot hold
    two. BendTorsionError when there is none."""
    for name in sorted(BINDINGS, key=lambda name: name not in sys.modules):
        try:
            return import_module(f"{name}.QtCore"), import_module(f"{name}.QtGui")
        except ImportError:
            continue
    raise BendTorsionError(
        error(
            "qt-missing",
            "sheets",
            "PDF sheets need Qt for Python, which is not installed",
            "on Debian run 'apt-get install python3-pyside2.qtgui' (python3-pyside6.qtgui where "
            "FreeCAD runs on Qt 6), use /usr/bin/python3",
        )
    )


def qt_major() -> int:
    """5 or 6. BendTorsionError when there is no Qt for Python."""
    return int(qt_modules()[0].qVersion().split(".")[0])


def settle_threads() -> None:
    """Wait for what FreeCAD 1.0 and later compute of TechDraw views in threads, and have the views
    take it. One that leaves the document before that raises in Qt's event loop, which ends a
    program without a window."""
    try:
        core, _ = qt_modules()
    except BendTorsionError:
        return
    if core.QCoreApplication.instance() is None:
        return
    # Faces are found in a second thread, when the lines are there.
    for _ in range(3):
        core.QThreadPool.globalInstance().waitForDone()
        core.QCoreApplication.sendPostedEvents(None, _FUTURE_EVENT)


_FUTURE_EVENT = 180
"""QEvent::FutureCallOut; no other event is taken here."""
