# SPDX-License-Identifier: LGPL-2.1-or-later
"""A form of fields for properties of objects: each edit goes to the property at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtWidgets

translate = FreeCAD.Qt.translate
UNITS = {
    "App::PropertyLength": "mm",
    "App::PropertyDistance": "mm",
    "App::PropertyAngle": "deg",
    "App::PropertyPressure": "MPa",
}
FLAWED = "border: 1px solid #c62828;"
LARGEST = 1e9


class PropertyForm(QtWidgets.QWidget):
    """Fields for properties of one object, or of several that get the same value.

    rows: (property, label). kinds: the kind of object a link property chooses from. changed: called
    after each edit. An edit a property refuses is marked at its field with the reason.
    """

    def __init__(
        self,
        objects: Sequence,
        rows: Sequence[tuple[str, str]],
        changed: Callable[[], None],
        kinds=None,
    ):
        super().__init__()
        self.objects, self.changed, self.kinds = list(objects), changed, dict(kinds or {})
        self.fields: dict[str, QtWidgets.QWidget] = {}
        self.labels: dict[str, QtWidgets.QLabel] = {}
        self.reasons: dict[str, str] = {}
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

    def read(self) -> None:
        """Fill the fields from the first object."""
        for name, field in self.fields.items():
            field.blockSignals(True)
            _show(field, getattr(self.objects[0], name))
            field.blockSignals(False)

    def flag(self, name: str, reason: str) -> None:
        """Mark a field with what is wrong, or take the mark off."""
        field = self.fields[name]
        field.setStyleSheet(FLAWED if reason else "")
        field.setToolTip(reason or self._tip(name))
        self.reasons[name] = reason

    def _tip(self, name: str) -> str:
        tip = self.objects[0].getDocumentationOfProperty(name)
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
        self.layout_.addRow(self.labels[name], field)

    def _edited(self, name: str, value) -> None:
        if self.ended:
            return
        try:
            for obj in self.objects:
                setattr(obj, name, value)
        except (ValueError, TypeError, ArithmeticError) as problem:
            self.flag(name, str(problem))
            return
        self.flag(name, "")
        self.changed()


def quantity_field(value: float, unit: str, least: float = -LARGEST):
    """A field for a quantity in `unit` that reads other units and formulas too."""
    field = _new_quantity_field()
    field.setProperty("unit", unit)
    field.setProperty("minimum", least)
    field.setProperty("maximum", LARGEST)
    field.setProperty("rawValue", value)
    return field


def _new_quantity_field():
    # PySide knows widgets that FreeCAD's loader made by their address even when Qt has deleted
    # them, and gives the dead one for a new one at its place; the next is made at another.
    while True:
        field = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
        try:
            field.objectName()
        except RuntimeError:
            continue
        return field


def _expression(obj, name: str) -> str:
    return next((text for path, text in obj.ExpressionEngine if path.lstrip(".") == name), "")


def _field(obj, name: str, edited, kind):
    """The field for a property by its type."""
    type_, value = obj.getTypeIdOfProperty(name), getattr(obj, name)
    if type_ in UNITS:
        least = 0.0 if type_ == "App::PropertyLength" else -LARGEST
        unit = UNITS[type_]
        field = quantity_field(_in_unit(value, unit), unit, least)
        field.valueChanged.connect(
            lambda _=None: edited(f"{float(field.property('rawValue'))!r} {unit}")
        )
        return field
    if type_ == "App::PropertyEnumeration":
        field = QtWidgets.QComboBox()
        for choice in obj.getEnumerationsOfProperty(name):
            field.addItem(translate("BendTorsion", choice), choice)
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
    field = QtWidgets.QLineEdit(str(value))
    field.editingFinished.connect(lambda: edited(field.text()))
    return field


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
        field.setText(str(value))
    else:
        unit = field.property("unit")
        field.setProperty("rawValue", _in_unit(value, unit))
