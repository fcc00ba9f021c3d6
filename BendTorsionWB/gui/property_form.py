# SPDX-License-Identifier: LGPL-2.1-or-later
"""A form of fields for properties of objects: each edit goes to the property at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import FreeCAD

from BendTorsionWB.gui.link_picker import LinkPicker
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.quantity_field import LARGEST, QuantityField
from BendTorsionWB.gui.words import choice_text

translate = FreeCAD.Qt.translate
UNITS = {
    "App::PropertyLength": "mm",
    "App::PropertyDistance": "mm",
    "App::PropertyAngle": "deg",
    "App::PropertyPressure": "MPa",
}
FLAWED = "border: 1px solid #c62828;"


class PropertyForm(QtWidgets.QWidget):
    """Fields for properties of one object, or of several that get the same value.

    rows: (property, label). kinds: the kind of object a link property chooses from. changed: called
    after each edit. `refused`: by property, why its field holds what the property cannot be, marked
    at the field; `judged` is called when that changes.
    """

    def __init__(
        self,
        objects: Sequence,
        rows: Sequence[tuple[str, str]],
        changed: Callable[[], None],
        kinds=None,
    ):
        super().__init__()
        self.judged: Callable[[], None] = lambda: None
        self.objects, self.changed, self.kinds = list(objects), changed, dict(kinds or {})
        self.fields: dict[str, QtWidgets.QWidget] = {}
        self.labels: dict[str, QtWidgets.QLabel] = {}
        self.pickers: dict[str, LinkPicker] = {}
        self.reasons: dict[str, str] = {}
        self.refused: dict[str, str] = {}
        # Fields that lose the focus while they are taken down tell of an edit once more.
        self.ended = False
        self.layout_ = QtWidgets.QFormLayout(self)
        self.layout_.setContentsMargins(0, 0, 0, 0)
        for name, label in rows:
            self._add(name, label)

    def show_rows(self, names) -> None:
        """Show the fields of these properties only."""
        for name, field in self.fields.items():
            field.setVisible(name in names)
            self.labels[name].setVisible(name in names)
            if name in self.pickers:
                self.pickers[name].button.setVisible(name in names)

    def read(self) -> None:
        """Fill the fields from the first object."""
        for name, field in self.fields.items():
            field.blockSignals(True)
            _show(field, getattr(self.objects[0], name))
            field.blockSignals(False)
            self.judge(name, "")

    def flag(self, name: str, reason: str) -> None:
        """Mark a field with what is wrong, or take the mark off; unreadable text comes first."""
        reason = self.refused.get(name) or reason
        field = self.fields[name]
        field.setStyleSheet(FLAWED if reason else "")
        field.setToolTip(reason or self._tip(name))
        self.reasons[name] = reason

    def told(self) -> list[str]:
        """What is wrong with the fields that hold what cannot be, one line each."""
        return [f"{self.labels[name].text()}: {reason}" for name, reason in self.refused.items()]

    def judge(self, name: str, reason: str) -> None:
        """Take note of a field that holds nothing the property can be, or that it does again."""
        if reason:
            self.refused[name] = reason
        elif self.refused.pop(name, None) is None:
            return
        self.flag(name, reason)
        self.judged()

    def _tip(self, name: str) -> str:
        tip = translate("App::Property", self.objects[0].getDocumentationOfProperty(name))
        bound = _expression(self.objects[0], name)
        return f"{tip}\n= {bound}" if bound else tip

    def _add(self, name: str, label: str) -> None:
        obj = self.objects[0]
        edited = partial(self._edited, name)
        field = _field(obj, name, edited, self.kinds.get(name))
        # A value that follows an expression is the expression's.
        field.setEnabled(not _expression(obj, name))
        field.setObjectName(name)
        self.fields[name] = field
        field.setToolTip(self._tip(name))
        self.labels[name] = QtWidgets.QLabel(label)
        self.labels[name].setBuddy(field)
        if obj.getTypeIdOfProperty(name) == "App::PropertyLink":
            picker = LinkPicker(self, name, self.kinds.get(name, ""))
            self.pickers[name] = picker
            line = QtWidgets.QHBoxLayout()
            line.addWidget(field, 1)
            line.addWidget(picker.button)
            self.layout_.addRow(self.labels[name], line)
        else:
            self.layout_.addRow(self.labels[name], field)
        if obj.getTypeIdOfProperty(name) in UNITS:
            unit = UNITS[obj.getTypeIdOfProperty(name)]
            line = field.findChild(QtWidgets.QLineEdit)
            line.textChanged.connect(lambda text: self._text_changed(name, text, unit))

    def _text_changed(self, name: str, text: str, unit: str) -> None:
        """Judge what is typed into a quantity field; `= …` is an expression."""
        if self.ended:
            return
        if not text.startswith("="):
            self.judge(name, self.fields[name].fault())
            return
        given = text[1:].strip()
        try:
            # An expression that means nothing is taken by FreeCAD and fails at every recompute.
            value = self.objects[0].evalExpression(given)
            unit_of = getattr(value, "Unit", FreeCAD.Units.Unit())
            wanted = FreeCAD.Units.Quantity(f"1 {unit}").Unit
            if unit_of not in (wanted, FreeCAD.Units.Unit()) or isinstance(value, str):
                raise ValueError(translate("BendTorsion", "it has another unit"))
            for obj in self.objects:
                obj.setExpression(name, given)
        except Exception as problem:  # noqa: BLE001 - FreeCAD raises many kinds for expressions
            words = translate("BendTorsion", "the expression cannot be read: {reason}")
            self.judge(name, words.format(reason=words_of(problem)))
            return
        self.judge(name, "")
        self.changed()

    def _edited(self, name: str, value) -> None:
        if self.ended:
            return
        # What is typed takes the place of an expression.
        for obj in self.objects:
            if _expression(obj, name):
                obj.setExpression(name, None)
        before = [getattr(obj, name) for obj in self.objects]
        reader = READERS.get(self.objects[0].getTypeIdOfProperty(name), lambda given: given)
        try:
            value = reader(value)
            for obj in self.objects:
                setattr(obj, name, value)
        except (ValueError, TypeError, ArithmeticError) as problem:
            for obj, former in zip(self.objects, before, strict=True):
                setattr(obj, name, former)
            self.judge(name, words_of(problem))
            return
        self.judge(name, "")
        self.flag(name, "")
        self.changed()


def words_of(problem: Exception) -> str:
    """What an exception of FreeCAD says; some carry a record instead of a text."""
    given = problem.args[0] if problem.args else ""
    return str(given.get("sErrMsg", given)) if isinstance(given, dict) else str(given)


def _expression(obj, name: str) -> str:
    return next((text for path, text in obj.ExpressionEngine if path.lstrip(".") == name), "")


def _field(obj, name: str, edited, kind):
    """The field for a property by its type."""
    type_, value = obj.getTypeIdOfProperty(name), getattr(obj, name)
    if type_ in UNITS:
        least = 0.0 if type_ == "App::PropertyLength" else -LARGEST
        unit = UNITS[type_]
        field = QuantityField(_in_unit(value, unit), unit, least)
        field.valueChanged.connect(
            lambda _=None: edited(f"{float(field.property('rawValue'))!r} {unit}")
        )
        return field
    if type_ == "App::PropertyEnumeration":
        field = QtWidgets.QComboBox()
        for choice in obj.getEnumerationsOfProperty(name):
            field.addItem(choice_text(obj.BT_Type, name, choice), choice)
        field.setCurrentIndex(field.findData(value))
        field.currentIndexChanged.connect(lambda _: edited(field.currentData()))
        return field
    if type_ == "App::PropertyLink":
        field = QtWidgets.QComboBox()
        field.addItem("", None)
        for other in obj.Document.Objects:
            if getattr(other, "BT_Type", "") == kind:
                field.addItem(other.Label, other.Name)
        field.setCurrentIndex(field.findData(value.Name) if value else 0)
        field.currentIndexChanged.connect(
            lambda _: edited(obj.Document.getObject(field.currentData() or ""))
        )
        return field
    if type_ == "App::PropertyBool":
        field = QtWidgets.QCheckBox()
        field.setChecked(value)
        field.toggled.connect(edited)
        return field
    if type_ == "App::PropertyFloat":
        field = QtWidgets.QDoubleSpinBox()
        field.setDecimals(3)
        field.setRange(-LARGEST, LARGEST)
        field.setValue(value)
        field.valueChanged.connect(edited)
        return field
    if type_ in READERS:
        field = QtWidgets.QLineEdit(_words(value))
        field.textEdited.connect(edited)
        return field
    field = QtWidgets.QLineEdit(str(value))
    field.editingFinished.connect(lambda: edited(field.text()))
    return field


def _read_vector(text: str) -> FreeCAD.Vector:
    try:
        numbers = [float(word) for word in text.replace(";", " ").replace(",", " ").split()]
    except ValueError:
        numbers = []
    if len(numbers) != 3:
        raise ValueError(translate("BendTorsion", "give three numbers: x, y, z"))
    return FreeCAD.Vector(*numbers)


def _read_words(text: str) -> list[str]:
    return text.replace(",", " ").replace(";", " ").split()


READERS = {"App::PropertyVector": _read_vector, "App::PropertyStringList": _read_words}
"""What reads the text of properties that have no field of their own."""


def _words(value) -> str:
    return ", ".join(f"{item:g}" if isinstance(item, float) else str(item) for item in value)


def _in_unit(value, unit: str) -> float:
    return float(value.getValueAs(unit).Value)


def _show(field, value) -> None:
    """Put a property's value into its field."""
    if isinstance(field, QtWidgets.QComboBox):
        data = value.Name if hasattr(value, "Name") else value
        field.setCurrentIndex(max(field.findData(data), 0))
    elif isinstance(field, QtWidgets.QCheckBox):
        field.setChecked(value)
    elif isinstance(field, QtWidgets.QDoubleSpinBox):
        field.setValue(value)
    elif isinstance(field, QtWidgets.QLineEdit):
        plain = isinstance(value, str | int)
        field.setText(str(value) if plain else _words(value))
    else:
        unit = field.property("unit")
        field.setProperty("rawValue", _in_unit(value, unit))
