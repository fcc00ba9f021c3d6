# SPDX-License-Identifier: LGPL-2.1-or-later
"""Long work in the window: a bar that shows how far it is, and a way to stop it."""

from __future__ import annotations

from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets

translate = FreeCAD.Qt.translate


class Cancelled(Exception):
    """The user stopped the work."""


@contextmanager
def progress(title: str):
    """A `project.Progress` that shows a dialog with Cancel; it raises Cancelled once that is
    pressed, so that the work stops between two of its steps."""
    dialog = QtWidgets.QProgressDialog(FreeCADGui.getMainWindow())
    dialog.setWindowTitle(title)
    dialog.setLabelText(title)
    dialog.setCancelButtonText(translate("BendTorsion", "Cancel"))
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)
    dialog.setMinimumDuration(0)
    dialog.setAutoReset(False)
    dialog.setAutoClose(False)
    dialog.setMinimumWidth(420)

    def report(what: str, done: int, count: int) -> None:
        dialog.setLabelText(f"{title}: {what}")
        dialog.setMaximum(max(count, 1))
        dialog.setValue(done)
        QtWidgets.QApplication.processEvents()
        if dialog.wasCanceled():
            raise Cancelled

    dialog.show()
    try:
        report("", 0, 1)
        yield report
    finally:
        dialog.close()
        dialog.deleteLater()
