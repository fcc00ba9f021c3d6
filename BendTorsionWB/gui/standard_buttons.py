# SPDX-License-Identifier: LGPL-2.1-or-later
"""OK and Cancel in the language of the window: Qt's own translations are not on every machine."""

from __future__ import annotations

from collections.abc import Callable

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtWidgets

translate = FreeCAD.Qt.translate


def name(*boxes) -> None:
    """Name OK and Cancel of QDialogButtonBoxes; of none that is gone: PySide6 calls methods of a
    dialog that is deleted."""
    for box in filter(_is_alive, boxes):
        for standard, text in (
            (QtWidgets.QDialogButtonBox.Ok, translate("BendTorsion", "OK")),
            (QtWidgets.QDialogButtonBox.Cancel, translate("BendTorsion", "Cancel")),
        ):
            button = box.button(standard)
            if button is not None:
                button.setText(text)


def name_again(event, named: Callable[[], None]) -> None:
    """Call `named` once a widget and all in it have an event (of `changeEvent`) that tells of a new
    language. FreeCAD tells of one whenever it loads a part of itself, as the first panel has it do,
    and Qt names its standard buttons anew then."""
    if event.type() == QtCore.QEvent.LanguageChange:
        # Not by a function of its own: the call of a widget's method goes with the widget.
        QtCore.QTimer.singleShot(0, named)


def _is_alive(box) -> bool:
    try:
        box.standardButtons()
    except RuntimeError:
        return False
    return True
