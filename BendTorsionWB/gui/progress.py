# SPDX-License-Identifier: LGPL-2.1-or-later
"""Long work in the window: a bar that shows how far it is, and a way to stop it."""

from __future__ import annotations

import time
from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.unseen_documents import unseen_documents

translate = FreeCAD.Qt.translate


PATIENCE = 0.7
"""Seconds work may take before a bar is shown, where it mostly takes less."""
NEVER = 2**30
"""Milliseconds."""


class Cancelled(Exception):
    """The user stopped the work."""


@contextmanager
def progress(title: str, patience: float = 0.0):
    """A `project.Progress`, which `make_files` tells too, that shows a dialog with Cancel once the
    work has lasted `patience` seconds; it raises Cancelled once that is pressed, or once a document
    was closed that was open when it began, so that the work stops between two of its steps."""
    started = time.monotonic()
    open_before = set(FreeCAD.listDocuments())
    dialog = QtWidgets.QProgressDialog(FreeCADGui.getMainWindow())
    dialog.setWindowTitle(title)
    dialog.setLabelText(title)
    # An Enter too many does not stop the work; Escape and a click do. The dialog's own button is
    # not always found: PySide knows widgets by their address, and gives what lived there before.
    cancel = QtWidgets.QPushButton(translate("BendTorsion", "Cancel"))
    dialog.setCancelButton(cancel)
    cancel.setAutoDefault(False)
    cancel.setDefault(False)
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)
    # It would show itself, patience or none.
    dialog.setMinimumDuration(NEVER)
    dialog.setAutoReset(False)
    dialog.setAutoClose(False)
    dialog.setMinimumWidth(420)

    def report(what: str, done: int, count: int) -> None:
        if not dialog.isVisible() and not dialog.wasCanceled():
            if time.monotonic() - started < patience:
                return
            dialog.show()
        dialog.setLabelText(f"{title}: {what}" if what else title)
        dialog.setMaximum(max(count, 1))
        dialog.setValue(done)
        QtWidgets.QApplication.processEvents()
        if dialog.wasCanceled() or not open_before <= set(FreeCAD.listDocuments()):
            raise Cancelled

    window, stay = FreeCADGui.getMainWindow(), _Stay()
    window.installEventFilter(stay)
    # Here: the workbench opens without loading scipy.
    from BendTorsionWB.make_files import PROGRESS

    former = PROGRESS.set(report)
    try:
        report("", 0, 1)
        with unseen_documents():
            yield report
    finally:
        PROGRESS.reset(former)
        window.removeEventFilter(stay)
        dialog.close()
        dialog.deleteLater()


class _Stay(QtCore.QObject):
    """Keeps the window open: FreeCAD would close the documents under the work."""

    def eventFilter(self, window, event):
        """Called by Qt before the window has the event."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent) or event.type() != QtCore.QEvent.Close:
            return False
        event.ignore()
        return True
