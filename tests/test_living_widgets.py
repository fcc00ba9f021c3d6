# SPDX-License-Identifier: LGPL-2.1-or-later
"""Widgets of FreeCAD's that are found while Python holds one that is gone."""

import weakref

import pytest

from BendTorsionWB.gui.qt import QtCore, living


class Holder:
    """Holds an object that is gone, in a circle, as a panel that was closed does."""

    def __init__(self):
        parent = QtCore.QObject()
        self.itself, self.gone = self, QtCore.QObject(parent)


def by_address(holders, lives):
    """As PySide finds what lives at an address."""
    return holders[0].gone if holders else lives


def test_what_lives_is_found_once_what_is_gone_is_let_go():
    lives, known = QtCore.QObject(), weakref.WeakSet([Holder()])
    with pytest.raises(RuntimeError):
        by_address(list(known), lives).objectName()
    assert living(lambda: by_address(list(known), lives)) is lives and not known


def test_what_is_gone_and_still_held_is_nothing():
    holder = Holder()
    assert living(lambda: holder.gone) is None
    assert living(lambda: None) is None
