# SPDX-License-Identifier: LGPL-2.1-or-later
"""A form of fields for properties of objects: each edit goes to the property at once, and what
cannot be takes the property back to what it was before the edit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial

import FreeCAD

from BendTorsionWB.gui.link_picker import LinkPicker
from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.quantity_field import LARGEST, QuantityField
from BendTorsionWB.gui.typed_line import TypedLine
from BendTorsionWB.gui.typed_quantity import expression_value, words_of
from BendTorsionWB.gui.words import choice_text

translate = FreeCAD.Qt.translate
UNITS = {
    "App::PropertyLength": "mm",
    "App::PropertyDistance": "mm",
    "App::PropertyAngle": "deg",
    "App::PropertyPressure": "MPa",
    "App::PropertyFloat": "",
}
FIGURES = 3
"""Decimals of numbers without a unit."""
FRAME = "QLineEdit, QAbstractItemView {{ border: 1px {style} {colour}; }}"
"""Around what is written: around a whole spin box or combo box it would squeeze the arrows."""
FLAWED = FRAME.format(style="solid", colour="#c62828") + "QComboBox, QCheckBox { color: #c62828; }"


class PropertyForm(QtWidgets.QWidget):
    """Fields for properties of one object, or of several that get the same value.

    rows: (property, label). kinds: the kind of object a link property chooses from. changed: called
    after each edit. limits: by property, the least and the most a quantity can be. checks: by
    property, what raises ValueError for a text it cannot be. `refused`: by
    property, why its field holds what the property cannot be, marked at the field; `judged` is
    called when that changes.
    """

    def __init__(
        self,
        objects: Sequence,
        rows: Sequence[tuple[str, str]],
        changed: Callable[[], None],
        kinds=None,
        limits=None,
        checks=None,
    ):
        super().__init__()
        self.judged: Callable[[], None] = lambda: None
        self.objects, self.changed, self.kinds = list(objects), changed, dict(kinds or {})
        self.limits = dict(limits or {})
        self.checks = dict(checks or {})
        # By property: what the objects had before the edit that is under way.
        self.before: dict[str, list[tuple]] = {}
        self.fields: dict[str, QtWidgets.QWidget] = {}
        self.labels: dict[str, QtWidgets.QLabel] = {}
        # What stands beside the label: the field, or a line that it is part of.
        self.beside: dict[str, QtWidgets.QWidget] = {}
        self.pickers: dict[str, LinkPicker] = {}
        self.reasons: dict[str, str] = {}
        self.refused: dict[str, str] = {}
        # Those that followed an expression when the form was made: it rules, not the field.
        self.ruled: set[str] = set()
        # Fields that lose the focus while they are taken down tell of an edit once more.
        self.ended = False
        # A QFormLayout keeps the spacing of rows that are hidden.
        self.layout_ = QtWidgets.QGridLayout(self)
        self.layout_.setColumnStretch(1, 1)
        self.layout_.setContentsMargins(0, 0, 0, 0)
        for name, label in rows:
            self._add(name, label)

    def show_rows(self, names) -> None:
        """Show the fields of these properties only."""
        for name, label in self.labels.items():
            for widget in (label, self.beside[name]):
                widget.setVisible(name in names)

    def read(self, names: Sequence[str]) -> None:
        """Fill the fields of these properties from the first object; what was typed into others
        stays to be mended."""
        for name in names:
            field = self.fields[name]
            self.before.pop(name, None)
            field.blockSignals(True)
            _show(field, getattr(self.objects[0], name))
            field.blockSignals(False)
            self.judge(name, "")
        self.follow()

    def follow(self) -> None:
        """Show what expressions have come to."""
        for name, field in self.fields.items():
            typed_into = isinstance(field, QuantityField) and field.is_typed_into()
            if name not in self.refused and not typed_into:
                self._follow(name)

    def _follow(self, name: str) -> None:
        field, obj = self.fields[name], self.objects[0]
        bound = _expression(obj, name)
        if not bound and name not in self.ruled:
            return
        if not bound:
            self.ruled.discard(name)
        field.blockSignals(True)
        if isinstance(field, QuantityField):
            value = _in_unit(getattr(obj, name), field.property("unit"))
            field.show_rule(value, bound, name in self.ruled)
        else:
            _show(field, getattr(obj, name))
            field.setEnabled(name not in self.ruled)
        field.blockSignals(False)
        if not self.reasons.get(name):
            field.setToolTip(self._tip(name))

    def _tell_ruled(self, name: str) -> None:
        """Say at a field that an expression rules why it takes no text."""
        field = self.fields[name]
        place = field.mapToGlobal(QtCore.QPoint(0, field.height()))
        QtWidgets.QToolTip.showText(place, self._tip(name), field)

    def flag(self, name: str, reason: str) -> None:
        """Mark a field with what is wrong, or take the mark off; unreadable text comes first."""
        reason = self.refused.get(name) or reason
        field = self.fields[name]
        field.setStyleSheet(FLAWED if reason else "")
        field.setToolTip(reason or self._tip(name))
        self.reasons[name] = reason

    def told(self) -> list[str]:
        """What is wrong with the fields that hold what cannot be, one line each."""
        return [
            f"{text} {reason}" if text.endswith(":") else f"{text}: {reason}"
            for text, reason in ((self.labels[k].text(), why) for k, why in self.refused.items())
        ]

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
        if name not in self.ruled:
            return f"{tip}\n= {bound}" if bound else tip
        words = translate(
            "BendTorsion",
            "it follows = {text}: change what it names, or clear the expression in the property"
            " editor, tab Data",
        )
        return f"{tip}\n{words.format(text=bound)}"

    def _add(self, name: str, label: str) -> None:
        obj = self.objects[0]
        edited = partial(self._edited, name)
        field = _field(obj, name, edited, self.kinds.get(name), self.limits.get(name, ()))
        if _expression(obj, name):
            self.ruled.add(name)
        field.setObjectName(name)
        self.fields[name] = field
        field.setToolTip(self._tip(name))
        self.labels[name] = QtWidgets.QLabel(label)
        self.labels[name].setBuddy(field)
        if obj.getTypeIdOfProperty(name) == "App::PropertyLink":
            picker = LinkPicker(self, name, self.kinds.get(name, ""))
            self.pickers[name] = picker
            self.beside[name] = QtWidgets.QWidget()
            line = QtWidgets.QHBoxLayout(self.beside[name])
            line.setContentsMargins(0, 0, 0, 0)
            line.addWidget(field, 1)
            line.addWidget(picker.button)
        else:
            self.beside[name] = field
        row = self.layout_.rowCount()
        self.layout_.addWidget(self.labels[name], row, 0)
        self.layout_.addWidget(self.beside[name], row, 1)
        if isinstance(field, QtWidgets.QLineEdit | QuantityField):
            field.editingFinished.connect(lambda: self._leave(name))
        if name in self.checks:
            field.textEdited.connect(lambda text: self._check_text(name, text))
        if isinstance(field, TypedLine | QuantityField):
            field.begun.connect(lambda: self._settle(name))
        if isinstance(field, QuantityField):
            field.line.textChanged.connect(lambda text: self._text_changed(name, text))
            field.held.connect(lambda: self._tell_ruled(name))
        self._follow(name)

    def _text_changed(self, name: str, text: str) -> None:
        """Judge what is typed into a quantity field; `= …` is an expression."""
        if self.ended:
            return
        field = self.fields[name]
        if not text.startswith("="):
            if reason := field.fault():
                self._put_back(name)
            self.judge(name, reason)
            return
        given = text[1:].strip()
        try:
            value = expression_value(self.objects[0], given, field.property("unit"))
            field.check(value, text)
        except ValueError as problem:
            self._put_back(name)
            self.judge(name, str(problem))
            return
        self.before.setdefault(name, self._state(name))
        for obj in self.objects:
            obj.setExpression(name, given)
        self.judge(name, "")
        self.changed()

    def limit(self, name: str, least: float, most: float) -> None:
        """Judge what is typed into the field of a quantity by these from now on."""
        self.fields[name].limit(least, most)

    def _check_text(self, name: str, text: str) -> None:
        """Judge a text that is being typed; it goes to the property once the field is left."""
        try:
            self._check(name, text)
        except ValueError as problem:
            self.judge(name, words_of(problem))
        else:
            self.judge(name, "")

    def _check(self, name: str, value) -> None:
        # What is there already is no fault of this edit.
        if name in self.checks and value != getattr(self.objects[0], name):
            self.checks[name](value)

    def _edited(self, name: str, value) -> None:
        if self.ended:
            return
        self.before.setdefault(name, self._state(name))
        reader = READERS.get(self.objects[0].getTypeIdOfProperty(name), lambda given: given)
        try:
            value = reader(value)
            self._check(name, value)
            for obj in self.objects:
                # What is typed takes the place of an expression.
                if _expression(obj, name):
                    obj.setExpression(name, None)
                setattr(obj, name, value)
        except (ValueError, TypeError, ArithmeticError) as problem:
            self._put_back(name)
            self.judge(name, words_of(problem))
            return
        self.judge(name, "")
        self.flag(name, "")
        self.changed()

    def _state(self, name: str) -> list[tuple]:
        """The value and the expression of a property, object by object."""
        return [(getattr(obj, name), _expression(obj, name)) for obj in self.objects]

    def _put_back(self, name: str) -> None:
        """Give the objects what they had before the edit: of a field in error nothing is shown."""
        before = self.before.get(name)
        if before is None or before == self._state(name):
            return
        for obj, (value, bound) in zip(self.objects, before, strict=True):
            obj.setExpression(name, bound or None)
            setattr(obj, name, value)
        self.changed()

    def _settle(self, name: str) -> None:
        """A field is left, or its text begun anew: what it holds is what the edit begins with,
        unless it cannot be, or the checks refuse it."""
        if name not in self.refused and not self.reasons.get(name):
            self.before.pop(name, None)

    def _leave(self, name: str) -> None:
        """A field is left: one that was typed an expression into shows its value, too."""
        if self.ended:
            # Of an object that was new and is gone.
            return
        self._settle(name)
        field, bound = self.fields[name], _expression(self.objects[0], name)
        if name in self.refused or not isinstance(field, QuantityField):
            return
        if bound and field.text().startswith("="):
            field.blockSignals(True)
            # The property has the value after the next recompute only; what the expression names
            # may have gone meanwhile.
            with suppress(ValueError):
                value = expression_value(self.objects[0], bound, field.property("unit"))
                field.show_rule(value, bound, False)
            field.blockSignals(False)
            field.setToolTip(self._tip(name))


def _expression(obj, name: str) -> str:
    return next((text for path, text in obj.ExpressionEngine if path.lstrip(".") == name), "")


def _field(obj, name: str, edited, kind, limits):
    """The field for a property by its type."""
    type_, value = obj.getTypeIdOfProperty(name), getattr(obj, name)
    if type_ in UNITS:
        least = 0.0 if type_ == "App::PropertyLength" else -LARGEST
        unit = UNITS[type_]
        field = QuantityField(_in_unit(value, unit), unit, *(limits or (least,)))
        if unit:
            field.valueChanged.connect(
                lambda _=None: edited(f"{float(field.property('rawValue'))!r} {unit}")
            )
        else:
            field.setProperty("decimals", FIGURES)
            field.valueChanged.connect(edited)
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
    if type_ in READERS:
        field = TypedLine(_words(value))
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
    return float(value.getValueAs(unit).Value) if unit else float(value)


def _show(field, value) -> None:
    """Put a property's value into its field."""
    if isinstance(field, QtWidgets.QComboBox):
        data = value.Name if hasattr(value, "Name") else value
        field.setCurrentIndex(max(field.findData(data), 0))
    elif isinstance(field, QtWidgets.QCheckBox):
        field.setChecked(value)
    elif isinstance(field, QtWidgets.QLineEdit):
        plain = isinstance(value, str | int)
        field.setText(str(value) if plain else _words(value))
    else:
        unit = field.property("unit")
        field.setProperty("rawValue", _in_unit(value, unit))
