# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field for a quantity: what is typed is judged at once, lengths are shown in mm.

FreeCAD's own loses millimetres above 10 m, leaves the unit behind when Tab selects the number, and
goes back to the former value in silence when it cannot read what was typed.
"""

from __future__ import annotations

import re

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.row_table import typed
from BendTorsionWB.gui.typed_line import TypedLine
from BendTorsionWB.gui.typed_quantity import SIGNS, number_of

translate = FreeCAD.Qt.translate
LARGEST = 1e9
DECIMALS = 2
IMPERIAL = frozenset({2, 3, 5, 7})
"""FreeCAD's unit schemas of feet and inches; in all others lengths are in mm."""
FRAMED = re.compile(r"border: 1px (solid|dashed) (#\w+)")
PENS = {"solid": QtCore.Qt.SolidLine, "dashed": QtCore.Qt.DashLine}
SELECTS = (
    QtCore.Qt.TabFocusReason,
    QtCore.Qt.BacktabFocusReason,
    QtCore.Qt.ShortcutFocusReason,
    QtCore.Qt.OtherFocusReason,
)
"""Ways into the field after which typing takes the place of what it holds."""


class QuantityField(QtWidgets.QAbstractSpinBox):
    """Holds `rawValue`, a number of `unit` (empty for none), from `minimum` to `maximum`.
    `valueChanged` tells each new one, while it is typed too. A text that is none is kept to be
    mended, `fault` says why, and the value is that of before the text was begun; `begun` tells of
    each that is typed over all of a former one. One that follows an expression shows it beside its
    value (`show_rule`); `held` tells of keys for one that cannot be typed over."""

    valueChanged = QtCore.Signal(float)
    begun = QtCore.Signal()
    held = QtCore.Signal()

    def __init__(self, value: float, unit: str, least: float = -LARGEST, most: float = LARGEST):
        super().__init__()
        self._unit, self._value, self._decimals = unit, float(value), DECIMALS
        self._least, self._most = least, most
        self._before, self._unread = self._value, False
        self._rule = ""
        self._frame: tuple | None = None
        # A line of its own: PySide knows widgets by address, and may take one that Qt made for
        # something else that lived there before.
        self.line = TypedLine()
        self.setLineEdit(self.line)
        self.line.begun.connect(self._begin)
        self.line.textEdited.connect(self._typed)
        self.editingFinished.connect(self._finished)
        self._show()

    def _set_value(self, value: float) -> None:
        changed = value != self._value
        self._value = self._before = float(value)
        self._unread, self._rule = False, ""
        self._show()
        if changed:
            self.valueChanged.emit(self._value)

    def show_rule(self, value: float, expression: str, fixed: bool) -> None:
        """Show the value an expression has; an empty one rules no more. fixed: nothing can be typed
        over it."""
        self._value = self._before = float(value)
        self._unread, self._rule = False, expression
        self.line.setReadOnly(fixed)
        self._show()

    def is_typed_into(self) -> bool:
        """Whether it holds a text of the user's that is not settled."""
        return self.line.isModified()

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
        if not self.line.isModified():
            return ""
        try:
            self._read()
        except ValueError as problem:
            return str(problem)
        return ""

    def before(self) -> float:
        """What it held before the text was begun."""
        return self._before

    def limit(self, least: float, most: float) -> None:
        """Judge what is typed from now on by these."""
        self._least, self._most = least, most

    def check(self, value: float, text: str) -> None:
        """Raises ValueError with the limit for a value beyond it; text: how it was written."""
        if value < self._least:
            words = translate("BendTorsion", "{text} is too little: {limit} or more")
        elif value > self._most:
            words = translate("BendTorsion", "{text} is too much: {limit} or less")
        else:
            return
        limit = self._least if value < self._least else self._most
        limit = f"{limit:.10g} {SIGNS.get(self._unit, self._unit)}".rstrip()
        raise ValueError(words.format(text=text.strip(), limit=limit))

    def _read(self) -> float:
        text, point = self.text(), QtCore.QLocale().decimalPoint()
        value = number_of(text, self._unit, self._factor(), point)
        self.check(value, text)
        return value

    def _quantity(self):
        return FreeCAD.Units.Quantity(f"{self._value!r} {self._unit}")

    def _factor(self) -> float:
        """How many of `unit` a number without one means."""
        if not self._in_feet():
            return 1.0
        internal = FreeCAD.Units.Quantity(f"1 {self._unit}").Value
        return float(self._quantity().getUserPreferred()[1]) / internal

    def _show(self) -> None:
        if self._in_feet():
            text = self._quantity().UserString
        else:
            words = QtCore.QLocale()
            words.setNumberOptions(QtCore.QLocale.OmitGroupSeparator)
            number = words.toString(self._value, "f", self._decimals)
            text = f"{number} {SIGNS.get(self._unit, self._unit)}".rstrip()
        self.line.setText(f"{text}   (= {self._rule})" if self._rule else text)
        if self._rule:
            # The value is what must be seen where both have no room.
            self.line.setCursorPosition(0)

    def _in_feet(self) -> bool:
        """Whether FreeCAD shows the unit in that of another system."""
        return bool(self._unit) and FreeCAD.Units.getSchema() in IMPERIAL

    def _begin(self) -> None:
        if not self._unread:
            self._before = self._value
            self.begun.emit()

    def _typed(self, _) -> None:
        mended, self._unread, self._rule = self._unread, False, ""
        try:
            value = self._read()
        except ValueError:
            value, mended, self._unread = self._before, False, True
        if value != self._value or mended:
            self._value = value
            self.valueChanged.emit(value)

    def _finished(self) -> None:
        """Show what was read; a text that cannot be read stays, to be mended."""
        if self.line.isModified() and not self.fault():
            self._before = self._value
            self._show()

    def stepBy(self, steps):
        """Called by Qt for arrow keys, the wheel and the buttons."""
        self._set_value(min(max(self._value + steps, self._least), self._most))
        self.selectAll()

    def stepEnabled(self):
        """Called by Qt: both ways, or none."""
        # Of the class: with PySide6 an object does not have them.
        steps = QtWidgets.QAbstractSpinBox
        if self.line.isReadOnly():
            return steps.StepNone
        return steps.StepUpEnabled | steps.StepDownEnabled

    def keyPressEvent(self, event):
        """Keys that would write into what cannot be typed over are told of."""
        writes = typed(event) or event.matches(QtGui.QKeySequence.Paste)
        erases = event.key() in (QtCore.Qt.Key_Delete, QtCore.Qt.Key_Backspace)
        if self.line.isReadOnly() and (writes or erases):
            self.held.emit()
            event.accept()
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event):
        """All that is written is selected when the field is come to by keys."""
        super().focusInEvent(event)
        if event.reason() in SELECTS:
            self.selectAll()

    def changeEvent(self, event):
        """The frame of a style sheet for what is written is drawn by the field itself: Qt draws
        none in a spin box, and one around it would squeeze the arrows."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent):
            return
        super().changeEvent(event)
        if event.type() == QtCore.QEvent.StyleChange:
            found = FRAMED.search(self.styleSheet())
            self._frame = (PENS[found[1]], QtGui.QColor(found[2])) if found else None
            self.update()

    def paintEvent(self, event):
        """With the frame, if there is one."""
        super().paintEvent(event)
        if self._frame is None:
            return
        painter = QtGui.QPainter(self)
        style, colour = self._frame
        painter.setPen(QtGui.QPen(colour, 1, style))
        # Not at the very edge, which a screen of another scale cuts off.
        painter.drawRect(self.rect().adjusted(1, 1, -2, -2))
        painter.end()

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
