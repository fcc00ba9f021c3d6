# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: menus of a right click, read and chosen from."""

import mouse
import steps
from PySide import QtCore, QtGui


def _words(menu):
    """The words of a menu that can be chosen, submenus and all, and those that cannot."""
    found = []
    for action in menu.actions():
        if action.isSeparator():
            continue
        if action.menu() is not None:
            found += _words(action.menu())
        else:
            found.append([action.text().replace("&", ""), action.isEnabled()])
    return found


def _read_popup(found, choose=""):
    """Read the menu that pops up, and choose an entry or close it."""

    def look(times=40):
        menu = QtGui.QApplication.activePopupWidget()
        if menu is None:
            if times:
                QtCore.QTimer.singleShot(50, lambda: look(times - 1))
            return
        found.extend(_words(menu))
        entry = _entry(menu, choose) if choose else None
        if entry is not None:
            entry.trigger()
        menu.close()

    QtCore.QTimer.singleShot(50, look)


def _entry(menu, text):
    for action in menu.actions():
        inner = _entry(action.menu(), text) if action.menu() is not None else None
        if inner is not None:
            return inner
        if action.text().replace("&", "") == text:
            return action
    return None


def tree_menu(tree, label, choose=""):
    """What a right click on an object in the tree offers, or on its ground; choose: an entry."""
    found = []
    at = QtCore.QPoint(tree.viewport().width() - 8, tree.viewport().height() - 8)
    for _, row in steps.tree_rows():
        if label and row.data() == label:
            tree.scrollTo(row)
            at = tree.visualRect(row).center()
    _read_popup(found, choose)
    event = QtGui.QContextMenuEvent(
        QtGui.QContextMenuEvent.Mouse, at, tree.viewport().mapToGlobal(at)
    )
    QtGui.QApplication.sendEvent(tree.viewport(), event)
    steps.settle(3)
    return found


def view_menu():
    """A right click on the ground of the view, beside what is in it."""
    found = []
    at = QtCore.QPointF(6, mouse.view_widget().height() - 6)
    _read_popup(found)
    mouse.send(QtCore.QEvent.MouseMove, at)
    right = QtCore.Qt.RightButton
    mouse.send(QtCore.QEvent.MouseButtonPress, at, right, right)
    mouse.send(QtCore.QEvent.MouseButtonRelease, at, right)
    steps.settle(3)
    return found
