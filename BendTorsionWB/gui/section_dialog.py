# SPDX-License-Identifier: LGPL-2.1-or-later
"""The dialog that asks what members from a selection are: section, alignment, first number."""

from __future__ import annotations

from dataclasses import dataclass

import FreeCAD

from BendTorsionWB.gui.alignment_picker import AlignmentPicker
from BendTorsionWB.gui.preferences import preferred
from BendTorsionWB.gui.property_form import FLAWED
from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.quantity_field import QuantityField
from BendTorsionWB.gui.words import choice_text

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

TYPES = ("box1", "box2")
"""Of the types of section, those this dialog asks all sizes of."""
DIMENSIONS = (
    ("h", QT_TRANSLATE_NOOP("BendTorsion", "Height h"), "Height"),
    ("b", QT_TRANSLATE_NOOP("BendTorsion", "Breadth b"), "Breadth"),
    ("t", QT_TRANSLATE_NOOP("BendTorsion", "Thickness t"), "Thickness"),
)
LEAST = 0.1


@dataclass(frozen=True)
class SectionChoice:
    """What was typed in: type `box1` or `box2`, lengths in mm, alignment, number of the first."""

    type: str
    h: float
    b: float
    t: float
    align: str = "centre"
    first: int = 1


class SectionDialog(QtWidgets.QDialog):
    """Asks what the members are; `choice()` is what the fields hold."""

    def __init__(self, parent=None, first: int = 1, count: int = 1):
        super().__init__(parent)
        self.setWindowTitle(translate("BendTorsion", "Members from selection"))
        self.count = count
        self.type = QtWidgets.QComboBox()
        for name in TYPES:
            self.type.addItem(choice_text("SectionSpec", "Type", name), name)
        form = QtWidgets.QFormLayout()
        form.addRow(translate("BendTorsion", "Type"), self.type)
        # Here, not above: the workbench opens without loading Part.
        from BendTorsionWB.objects.section_spec import SectionSpec

        tips = {item.name: item.tooltip for item in SectionSpec.PROPERTIES}
        self.tips = {name: translate("App::Property", tips[own]) for name, _, own in DIMENSIONS}
        self.fields = {}
        self.type.setCurrentIndex(self.type.findData(preferred("SectionType")))
        for name, label, preference in DIMENSIONS:
            field = QuantityField(preferred(preference), "mm", LEAST)
            field.findChild(QtWidgets.QLineEdit).textChanged.connect(self._judge)
            field.setObjectName(name)
            form.addRow(translate("BendTorsion", label), field)
            self.fields[name] = field
        self.align = AlignmentPicker()
        form.addRow(translate("BendTorsion", "On the axis"), self.align)
        self.first = QtWidgets.QSpinBox()
        self.first.setRange(1, 99999)
        self.first.setValue(first)
        self.first.valueChanged.connect(self._judge)
        form.addRow(translate("BendTorsion", "First number"), self.first)
        self.words = QtWidgets.QLabel()
        self.words.setWordWrap(True)
        self.buttons = QtWidgets.QDialogButtonBox(
            QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel,
            QtCore.Qt.Horizontal,
        )
        # Qt's own translations are not on every machine.
        ok, cancel = QtWidgets.QDialogButtonBox.Ok, QtWidgets.QDialogButtonBox.Cancel
        self.buttons.button(ok).setText(translate("BendTorsion", "OK"))
        self.buttons.button(cancel).setText(translate("BendTorsion", "Cancel"))
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout = QtWidgets.QVBoxLayout(self)
        # Room for a second line from the start: the dialog does not grow when a text wraps.
        self.words.setMinimumHeight(2 * self.words.fontMetrics().lineSpacing())
        form.setVerticalSpacing(10)
        layout.addLayout(form)
        layout.addWidget(self.words)
        layout.addWidget(self.buttons)
        self._judge()
        self.fields["h"].setFocus()

    def choice(self) -> SectionChoice:
        """What the fields hold."""
        lengths = {name: float(field.property("rawValue")) for name, field in self.fields.items()}
        return SectionChoice(
            self.type.currentData(),
            **lengths,
            align=self.align.value,
            first=self.first.value(),
        )

    def _judge(self, _=None) -> None:
        """Say what will be made, or what is wrong, and allow OK accordingly."""
        given = self.choice()
        faults = {}
        for name, label, _ in DIMENSIONS:
            field = self.fields[name]
            reason = field.fault()
            field.setStyleSheet(FLAWED if reason else "")
            field.setToolTip(reason or self.tips[name])
            if reason:
                faults[name] = f"{translate('BendTorsion', label)}: {reason}"
        if faults:
            text, color = "\n".join(faults.values()), "color: #c62828;"
        elif 2.0 * given.t >= min(given.h, given.b):
            text = translate("BendTorsion", "The plates do not fit: 2 t must be less than h and b")
            color = "color: #c62828;"
        else:
            text = translate("BendTorsion", "{count} members from M{first} on, cut into plates")
            text, color = text.format(count=self.count, first=given.first), ""
        self.words.setText(text)
        self.words.setStyleSheet(color)
        self.buttons.button(QtWidgets.QDialogButtonBox.Ok).setEnabled(not color)


def ask(parent=None, first: int = 1, count: int = 1) -> SectionChoice | None:
    """Show the dialog; what was chosen, or None when it is cancelled."""
    dialog = SectionDialog(parent, first, count)
    accepted = dialog.exec_() if hasattr(dialog, "exec_") else dialog.exec()
    return dialog.choice() if accepted else None
