# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field for a quantity: reads units and sums, says what it cannot read, shows lengths in mm.

FreeCAD's own loses millimetres above 10 m, leaves the unit behind when Tab selects the number, and
goes back to the former value in silence when it cannot read what was typed.
"""

from __future__ import annotations

import re

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtWidgets

translate = FreeCAD.Qt.translate
LARGEST = 1e9
DECIMALS = 2
IMPERIAL = frozenset({2, 3, 5, 7})
"""FreeCAD's unit schemas of feet and inches; in all others lengths are in mm."""
SIGNS = {"deg": "°"}
"""Units that are shown by a sign."""
SUMMANDS = re.compile(r"[+-]?[^+-]+")
FACTOR = re.compile(r"([^*/]*[A-Za-z°])\s*([*/].+)")
"""Of what FreeCAD does not read by itself: `1 m - 35 mm`, `300 mm * 2`."""
SELECTS = (
    QtCore.Qt.TabFocusReason,
    QtCore.Qt.BacktabFocusReason,
    QtCore.Qt.ShortcutFocusReason,
    QtCore.Qt.OtherFocusReason,
)
"""Ways into the field after which typing takes the place of what it holds."""


class QuantityField(QtWidgets.QAbstractSpinBox):
    """Holds `rawValue`, a number of `unit`, from `minimum` to `maximum`. `valueChanged` tells each
    new one, while it is typed too; a text that is none leaves it, and `fault` says why."""

    valueChanged = QtCore.Signal(float)

    def __init__(self, value: float, unit: str, least: float = -LARGEST):
        super().__init__()
        self._unit, self._value, self._decimals = unit, float(value), DECIMALS
        self._least, self._most = least, LARGEST
        self.lineEdit().textEdited.connect(self._typed)
        self.editingFinished.connect(self._finished)
        self._show()

    def _set_value(self, value: float) -> None:
        changed = value != self._value
        self._value = float(value)
        self._show()
        if changed:
            self.valueChanged.emit(self._value)

    def _set_decimals(self, count: int) -> None:
        self._decimals = count
        self._show()

    rawValue = QtCore.Property(float, lambda self: self._value, _set_value)
    unit = QtCore.Property(str, lambda self: self._unit)
    minimum = QtCore.Property(float, lambda self: self._least)
    maximum = QtCore.Property(float, lambda self: self._most)
    decimals = QtCore.Property(int, lambda self: self._decimals, _set_decimals)

    def fault(self) -> str:
        """Why what is written is no value of the field; empty when it is."""
        if not self.lineEdit().isModified():
            return ""
        try:
            self._read()
        except ValueError as problem:
            return str(problem)
        return ""

    def _read(self) -> float:
        text = self.text()
        value = number_of(text, self._unit, self._factor())
        if not self._least <= value <= self._most:
            words = translate("BendTorsion", "{text} is not between {least:g} and {most:g} {unit}")
            raise ValueError(
                words.format(text=text, least=self._least, most=self._most, unit=self._unit)
            )
        return value

    def _quantity(self):
        return FreeCAD.Units.Quantity(f"{self._value!r} {self._unit}")

    def _factor(self) -> float:
        """How many of `unit` a number without one means."""
        if not _imperial():
            return 1.0
        internal = FreeCAD.Units.Quantity(f"1 {self._unit}").Value
        return float(self._quantity().getUserPreferred()[1]) / internal

    def _show(self) -> None:
        if _imperial():
            self.lineEdit().setText(self._quantity().UserString)
            return
        words = QtCore.QLocale()
        words.setNumberOptions(QtCore.QLocale.OmitGroupSeparator)
        number = words.toString(self._value, "f", self._decimals)
        self.lineEdit().setText(f"{number} {SIGNS.get(self._unit, self._unit)}")

    def _typed(self, _) -> None:
        try:
            value = self._read()
        except ValueError:
            return
        if value != self._value:
            self._value = value
            self.valueChanged.emit(value)

    def _finished(self) -> None:
        """Show what was read; a text that cannot be read stays, to be mended."""
        if self.lineEdit().isModified() and not self.fault():
            self._show()

    def stepBy(self, steps):
        """Called by Qt for arrow keys, the wheel and the buttons."""
        self._set_value(min(max(self._value + steps, self._least), self._most))
        self.selectAll()

    def stepEnabled(self):
        """Called by Qt: both ways."""
        return self.StepUpEnabled | self.StepDownEnabled

    def focusInEvent(self, event):
        """All that is written is selected when the field is come to by keys."""
        super().focusInEvent(event)
        if event.reason() in SELECTS:
            self.selectAll()

    def sizeHint(self):
        """Room for a length of a building and the buttons."""
        size = super().sizeHint()
        size.setWidth(
            self.fontMetrics().horizontalAdvance("-000000.00 mm") + 3 * size.height() // 2
        )
        return size

    def minimumSizeHint(self):
        """The same: a number that is cut off is another."""
        return self.sizeHint()


def number_of(text: str, unit: str, plain: float = 1.0) -> float:
    """The number of `unit` a text means, `0.5 m`, `2 * 325 mm` or `600`; plain: what a number
    without a unit is multiplied by. Raises ValueError, saying why, for what is none."""
    if not text.strip():
        raise ValueError(translate("BendTorsion", "a value is missing"))
    wanted = FreeCAD.Units.Quantity(f"1 {unit}").Unit
    read = _quantity_of(text)
    if read is None or read.Unit not in (wanted, FreeCAD.Units.Unit()):
        # What was typed before the unit that stood there, with a unit of its own.
        rest = text.rstrip()
        sign = next((one for one in (unit, SIGNS.get(unit)) if one and rest.endswith(one)), None)
        typed = _quantity_of(rest[: -len(sign)]) if sign else None
        if typed is not None and typed.Unit == wanted:
            read = typed
    if read is None:
        raise ValueError(translate("BendTorsion", "{text} cannot be read").format(text=text))
    if read.Unit == wanted:
        return float(read.getValueAs(unit).Value)
    if read.Unit != FreeCAD.Units.Unit():
        raise ValueError(
            translate("BendTorsion", "{text} has another unit than {unit}").format(
                text=text, unit=unit
            )
        )
    return float(read.Value) * plain


def _quantity_of(text: str):
    """What FreeCAD reads, or a sum of such; None when it is neither."""
    text = text.replace(",", ".")
    parts = [text]
    while True:
        try:
            read = [_term(part) for part in parts]
            return sum(read[1:], read[0])
        except (ValueError, ArithmeticError):
            if len(parts) > 1:
                return None
            parts = SUMMANDS.findall(text)
            if len(parts) < 2:
                return None


def _term(text: str):
    """A quantity with its unit at the end, as FreeCAD reads it, or before a factor."""
    try:
        return FreeCAD.Units.Quantity(text)
    except ValueError:
        split = FACTOR.fullmatch(text)
        if split is None:
            raise
        return FreeCAD.Units.Quantity(split[1]) * FreeCAD.Units.Quantity(f"1 {split[2]}")


def _imperial() -> bool:
    return FreeCAD.Units.getSchema() in IMPERIAL
