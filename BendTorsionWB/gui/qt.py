# SPDX-License-Identifier: LGPL-2.1-or-later
"""Qt as FreeCAD was built with it, under one set of names: the only module in gui to import Qt.

FreeCAD's own `PySide` package maps to PySide2 or PySide6, whichever the program runs on, and keeps
the widgets in `QtGui` on every release. Outside FreeCAD that package is not on the path.
"""

try:
    from PySide import QtCore, QtGui

    QtWidgets = QtGui
except ImportError:
    try:
        from PySide2 import QtCore, QtGui, QtWidgets
    except ImportError:
        from PySide6 import QtCore, QtGui, QtWidgets

__all__ = ["QtCore", "QtGui", "QtWidgets"]
