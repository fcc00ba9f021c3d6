# SPDX-License-Identifier: LGPL-2.1-or-later
"""The dialog that asks what members from a selection are: section, alignment, first number."""

from __future__ import annotations

from dataclasses import dataclass

import FreeCAD

from BendTorsionWB.core.tolerances import LARGEST_SIZE, SMALLEST_SIZE
from BendTorsionWB.gui import ask as questions
from BendTorsionWB.gui import standard_buttons
from BendTorsionWB.gui.alignment_picker import AlignmentPicker
from BendTorsionWB.gui.preferences import preferred
from BendTorsionWB.gui.property_form import FLAWED
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.quantity_field import QuantityField
from BendTorsionWB.gui.typed_quantity import expression_value, name_without_object
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


@dataclass(frozen=True)
class SectionChoice:
    """What was typed in: type `box1` or `box2`, lengths in mm, alignment, number of the first;
    bound: (property, expression) of the lengths that follow one."""

    type: str
    h: float
    b: float
    t: float
    align: str = "centre"
    first: int = 1
    bound: tuple[tuple[str, str], ...] = ()


class SectionDialog(QtWidgets.QDialog):
    """Asks what the members are; `choice()` is what the fields hold. beside: an object of the
    document, for `= …` to be read at; None where there can be none."""

    def __init__(self, parent=None, first: int = 1, count: int = 1, beside=None):
        super().__init__(parent)
        self.beside = beside
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
            field = QuantityField(preferred(preference), "mm", SMALLEST_SIZE, LARGEST_SIZE)
            field.line.textChanged.connect(self._judge)
            field.setObjectName(name)
            form.addRow(translate("BendTorsion", label), field)
            self.fields[name] = field
        self.align = AlignmentPicker()
        form.addRow(translate("BendTorsion", "On the axis"), self.align)
        self.first = _Number()
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
        self._name_buttons()
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

    def changeEvent(self, event):
        """Keep the names of the buttons."""
        if not isinstance(event, QtCore.QEvent):
            # PySide knows events by their address, and gives what lived there before.
            return
        super().changeEvent(event)
        standard_buttons.name_again(event, self._name_buttons)

    def _name_buttons(self) -> None:
        standard_buttons.name(self.buttons)

    def choice(self) -> SectionChoice:
        """What the fields hold."""
        lengths = {name: self._read(name)[0] for name in self.fields}
        return SectionChoice(
            self.type.currentData(),
            **lengths,
            align=self.align.value,
            first=self.first.value(),
            bound=tuple(
                (own, self._expression(name))
                for name, _, own in DIMENSIONS
                if self._expression(name)
            ),
        )

    def _expression(self, name: str) -> str:
        """What follows the `=` in a field."""
        text = self.fields[name].text()
        return text[1:].strip() if text.startswith("=") and self.beside is not None else ""

    def _read(self, name: str) -> tuple[float, str]:
        """The length a field means, and why it means none; that of before then."""
        field, bound = self.fields[name], self._expression(name)
        length, reason = float(field.property("rawValue")), field.fault()
        if bound:
            try:
                self._refuse_own(bound)
                length, reason = expression_value(self.beside, bound, "mm"), ""
                field.check(length, bound)
            except ValueError as problem:
                return float(field.property("rawValue")), str(problem)
        return length, reason

    def _refuse_own(self, expression: str) -> None:
        """Raises ValueError for a name that is read at the object there is, not at the section."""
        name = name_without_object(self.beside, expression)
        if not name:
            return
        words = translate(
            "BendTorsion", "{name} is of no object: write the object before it, as in {example}"
        )
        own = name.lstrip(".")
        there = own.partition(".")[0].strip() in self.beside.PropertiesList
        example = f"{self.beside.Name if there else 'Spreadsheet'}.{own}"
        raise ValueError(words.format(name=name, example=example))

    def _judge(self, _=None) -> None:
        """Say what will be made, or what is wrong, and allow OK accordingly."""
        given = self.choice()
        faults = {}
        for name, label, _ in DIMENSIONS:
            field = self.fields[name]
            reason = self._read(name)[1]
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
            for name, label, own in DIMENSIONS:
                if own in dict(given.bound):
                    value = f"{getattr(given, name):.10g} mm"
                    text += f"\n{translate('BendTorsion', label)} = {value}"
        self.words.setText(text)
        self.words.setStyleSheet(color)
        self.buttons.button(QtWidgets.QDialogButtonBox.Ok).setEnabled(not color)


class _Number(QtWidgets.QSpinBox):
    """A whole number: Qt would read 12 for `1,2`."""

    def validate(self, text, at):
        """Called by Qt with each character."""
        if text.strip("0123456789"):
            return QtGui.QValidator.Invalid, text, at
        inside = text and self.minimum() <= int(text) <= self.maximum()
        state = QtGui.QValidator.Acceptable if inside else QtGui.QValidator.Intermediate
        return state, text, at


def ask(parent=None, first: int = 1, count: int = 1, beside=None) -> SectionChoice | None:
    """Show the dialog; what was chosen, or None when it is cancelled."""
    dialog = SectionDialog(parent, first, count, beside)
    return dialog.choice() if questions.answered(dialog) else None
