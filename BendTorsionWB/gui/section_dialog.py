# SPDX-License-Identifier: LGPL-2.1-or-later
"""The dialog that asks for one box section: type, height, breadth and plate thickness."""

from __future__ import annotations

from dataclasses import dataclass

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets

translate = FreeCAD.Qt.translate

TYPES = (("box1", "Webs full height"), ("box2", "Flanges full breadth"))
DIMENSIONS = (
    ("h", "Height h", 600.0),
    ("b", "Breadth b", 600.0),
    ("t", "Thickness t", 16.0),
)


@dataclass(frozen=True)
class SectionChoice:
    """A box section as typed in: type `box1` or `box2`, lengths in mm."""

    type: str
    h: float
    b: float
    t: float


class SectionDialog(QtWidgets.QDialog):
    """Asks for a section; `choice()` is what the fields hold."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setWindowTitle(translate("BendTorsion", "Section of the new members"))
        self.type = QtWidgets.QComboBox()
        for name, meaning in TYPES:
            self.type.addItem(f"{name}: {translate('BendTorsion', meaning)}", name)
        form = QtWidgets.QFormLayout()
        form.addRow(translate("BendTorsion", "Type"), self.type)
        self.fields = {}
        for name, label, value in DIMENSIONS:
            field = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
            field.setProperty("unit", "mm")
            field.setProperty("minimum", 0.1)
            field.setProperty("rawValue", value)
            form.addRow(translate("BendTorsion", label), field)
            self.fields[name] = field
        buttons = QtWidgets.QDialogButtonBox(
            QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel,
            QtCore.Qt.Horizontal,
        )
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QtWidgets.QVBoxLayout(self)
        layout.addLayout(form)
        layout.addWidget(buttons)

    def choice(self) -> SectionChoice:
        """The section the fields hold."""
        lengths = {name: float(field.property("rawValue")) for name, field in self.fields.items()}
        return SectionChoice(type=self.type.currentData(), **lengths)


def ask(parent=None) -> SectionChoice | None:
    """Show the dialog; the section chosen, or None when it is cancelled."""
    dialog = SectionDialog(parent)
    accepted = dialog.exec_() if hasattr(dialog, "exec_") else dialog.exec()
    return dialog.choice() if accepted else None
