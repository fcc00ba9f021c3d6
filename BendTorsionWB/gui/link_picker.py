# SPDX-License-Identifier: LGPL-2.1-or-later
"""A button beside the field of a link: press it, then click the object in the view or the tree."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.selection import standing_for

translate = FreeCAD.Qt.translate


class LinkPicker:
    """The button for one link field of a PropertyForm; kind: of the objects it takes."""

    def __init__(self, form, name: str, kind: str):
        self.form, self.name, self.kind = form, name, kind
        self.following = False
        self.button = QtWidgets.QPushButton(translate("BendTorsion", "Pick"))
        self.button.setObjectName(f"pick {name}")
        self.button.setCheckable(True)
        self.button.setToolTip(
            translate("BendTorsion", "Press, then click it in the view or the tree")
        )
        self.button.toggled.connect(self._follow)
        self.button.destroyed.connect(lambda: self.stop())

    def stop(self) -> None:
        """Follow the selection no longer."""
        if self.following:
            FreeCADGui.Selection.removeObserver(self)
            self.following = False

    def addSelection(self, document, name, sub, point):
        """Called by FreeCAD for each pick."""
        target = self.form.objects[0].Document
        if document != target.Name or self.form.ended:
            return
        found = standing_for(target.getObject(name), self.kind)
        field = self.form.fields[self.name]
        at = field.findData(found.Name) if found is not None else -1
        if at >= 0:
            field.setCurrentIndex(at)
            self.button.setChecked(False)

    def _follow(self, on: bool) -> None:
        self.stop()
        if on:
            FreeCADGui.Selection.addObserver(self)
            self.following = True
