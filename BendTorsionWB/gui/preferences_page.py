# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's page in FreeCAD's preferences."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui.preferences import OTHERS, SECTIONS
from BendTorsionWB.gui.property_form import quantity_field
from BendTorsionWB.gui.qt import QtWidgets

translate = FreeCAD.Qt.translate
LEAST = 0.0001


class PreferencesPage:
    """FreeCAD makes one when its preferences open, and calls loadSettings and saveSettings."""

    def __init__(self):
        self.form = QtWidgets.QWidget()
        self.form.setWindowTitle(translate("BendTorsion", "New objects"))
        self.fields = {}
        layout = QtWidgets.QVBoxLayout(self.form)
        layout.addWidget(self._group(translate("BendTorsion", "Section"), SECTIONS))
        layout.addWidget(self._group(translate("BendTorsion", "Other objects"), OTHERS))
        note = QtWidgets.QLabel(
            translate(
                "BendTorsion",
                "New objects start with these. Objects that are there keep their own values, and"
                " documents their results. The language is that of FreeCAD.",
            )
        )
        note.setWordWrap(True)
        layout.addWidget(note)
        layout.addStretch()

    def _group(self, title: str, preferences):
        box = QtWidgets.QGroupBox(title)
        form = QtWidgets.QFormLayout(box)
        for item in preferences:
            if item.choices:
                field = QtWidgets.QComboBox()
                for choice in item.choices:
                    field.addItem(translate("BendTorsion", choice), choice)
            elif isinstance(item.default, float):
                field = quantity_field(item.default, "mm", LEAST)
                if item.default < 1.0:
                    field.setProperty("decimals", 4)
            else:
                field = QtWidgets.QLineEdit()
            field.setObjectName(item.name)
            form.addRow(translate("BendTorsion", item.label), field)
            self.fields[item.name] = item, field
        return box

    def loadSettings(self):
        """Show what is preferred now."""
        for item, field in self.fields.values():
            if item.choices:
                field.setCurrentIndex(field.findData(item.value))
            elif isinstance(item.default, float):
                field.setProperty("rawValue", item.value)
            else:
                field.setText(item.value)

    def saveSettings(self):
        """Keep what the fields hold."""
        for item, field in self.fields.values():
            if item.choices:
                item.keep(field.currentData())
            elif isinstance(item.default, float):
                item.keep(float(field.property("rawValue")))
            else:
                item.keep(field.text())
