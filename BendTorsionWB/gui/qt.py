# SPDX-License-Identifier: LGPL-2.1-or-later
"""Qt as FreeCAD was built with it, under one set of names: the only module in gui to import Qt.

FreeCAD's own `PySide` package maps to PySide2 or PySide6, whichever the program runs on, and keeps
the widgets in `QtGui` on every release. Outside FreeCAD that package is not on the path.
"""

import gc
from collections.abc import Callable

try:
    from PySide import QtCore, QtGui

    QtWidgets = QtGui
except ImportError:
    try:
        from PySide2 import QtCore, QtGui, QtWidgets
    except ImportError:
        from PySide6 import QtCore, QtGui, QtWidgets

__all__ = ["QtCore", "QtGui", "QtWidgets", "living"]


def living(found: Callable):
    """The widget of FreeCAD's that a call gives, or None. PySide knows widgets by their address:
    while Python still holds one that is gone, it gives that in place of what lives there now."""
    widget = found()
    if _is_gone(widget):
        del widget
        # Panels that were closed hold theirs in circles.
        gc.collect()
        widget = found()
    return None if _is_gone(widget) else widget


def _is_gone(widget) -> bool:
    try:
        return widget is not None and widget.objectName() is None
    except RuntimeError:
        return True
