# SPDX-License-Identifier: LGPL-2.1-or-later
"""A task panel follows its document, and closes with it and with the object it edits."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore


class Closing:
    """Closes the panel with its document, and with the object it edits; its fields show what a
    recompute has brought."""

    def __init__(self, panel):
        self.panel = panel
        self.object_goes = False

    def slotRecomputedDocument(self, document):
        """Called by FreeCAD after a recompute: fields may follow a table that was edited."""
        if document == self.panel.preview.document and not self.panel.closed:
            for form in self.panel.forms:
                form.follow()

    def slotDeletedDocument(self, document):
        """Called by FreeCAD before a document goes."""
        panel = self.panel
        if document == panel.preview.document and (self.object_goes or not panel.closed):
            self.object_goes = False
            if not panel.closed:
                panel.stop()
            FreeCADGui.Control.closeDialog()
            QtCore.QTimer.singleShot(0, lambda: FreeCAD.removeDocumentObserver(self))

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes, also when the panel itself takes it back."""
        panel = self.panel
        if panel.closed or obj not in panel.preview.objects:
            return
        self.object_goes = True
        panel.stop()
        QtCore.QTimer.singleShot(0, self._object_gone)

    def _object_gone(self) -> None:
        if not self.object_goes:
            # Its document went with it.
            return
        panel, self.object_goes = self.panel, False
        panel.closed = False
        panel._end(panel.preview.leave)
