# SPDX-License-Identifier: LGPL-2.1-or-later
"""The nine positions of a section on its axis, picked on a drawing of the section."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets

translate = FreeCAD.Qt.translate
ROWS = (
    ("top-left", "top", "top-right"),
    ("left", "centre", "right"),
    ("bottom-left", "bottom", "bottom-right"),
)
"""As seen walking along the axis, the height upwards."""
MARGIN, SIZE, DOT, REACH = 26, 132, 4.0, 14.0
"""Pixels; the words of the four sides stand in the margin."""
CHOSEN = "#f0a020"


class AlignmentPicker(QtWidgets.QWidget):
    """A box section with nine points; click one or move with the arrow keys."""

    chosen = QtCore.Signal(str)

    def __init__(self, value: str = "centre"):
        super().__init__()
        self.value = value
        self.setFixedSize(SIZE, SIZE)
        self.setFocusPolicy(QtCore.Qt.StrongFocus)
        self.setMouseTracking(True)
        self.setObjectName("alignment")
        self.setAccessibleDescription(
            translate(
                "BendTorsion", "Nine points of the section, seen along the axis with the height up"
            )
        )
        self._tell()

    def choose(self, value: str) -> None:
        """Choose a position and tell."""
        if value != self.value:
            self.value = value
            self._tell()
            self.update()
            self.chosen.emit(value)

    def point_of(self, name: str) -> QtCore.QPointF:
        """Where a position is drawn."""
        row, column = _place(name)
        step = (SIZE - 2 * MARGIN) / 2.0
        return QtCore.QPointF(MARGIN + column * step, MARGIN + row * step)

    def event(self, event):
        """The tooltip of a point names that point."""
        if event.type() == QtCore.QEvent.ToolTip:
            name = self._under(event.pos())
            self.setToolTip(translate("BendTorsion", name) if name else self._words())
        return super().event(event)

    def mousePressEvent(self, event):
        """Choose the position clicked."""
        name = self._under(event.pos())
        if name:
            self.setFocus()
            self.choose(name)

    def keyPressEvent(self, event):
        """Arrow keys move to the neighbour."""
        moves = {
            QtCore.Qt.Key_Up: (-1, 0),
            QtCore.Qt.Key_Down: (1, 0),
            QtCore.Qt.Key_Left: (0, -1),
            QtCore.Qt.Key_Right: (0, 1),
        }
        if event.key() not in moves:
            super().keyPressEvent(event)
            return
        row, column = _place(self.value)
        down, right = moves[event.key()]
        self.choose(ROWS[min(max(row + down, 0), 2)][min(max(column + right, 0), 2)])

    def paintEvent(self, event):
        """Draw the section, its points, the chosen one as the axis."""
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        ink = self.palette().color(QtGui.QPalette.WindowText)
        outer = QtCore.QRectF(self.point_of("top-left"), self.point_of("bottom-right"))
        painter.setPen(QtGui.QPen(ink, 1.5))
        painter.drawRect(outer)
        painter.setPen(QtGui.QPen(ink, 0.8))
        painter.drawRect(outer.adjusted(6, 6, -6, -6))
        self._name_sides(painter)
        if self.hasFocus():
            painter.setPen(QtGui.QPen(self.palette().color(QtGui.QPalette.Highlight), 1.0))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        for name in (name for row in ROWS for name in row):
            is_chosen = name == self.value
            painter.setPen(QtGui.QPen(ink, 1.0))
            painter.setBrush(QtGui.QColor(CHOSEN) if is_chosen else self.palette().window())
            size = DOT * (2.0 if is_chosen else 1.0)
            painter.drawEllipse(self.point_of(name), size, size)
        painter.end()

    def _name_sides(self, painter) -> None:
        """What the sides are called, outside of the section; upright at left and right."""
        room = MARGIN - 2 * int(DOT)
        font = self.font()
        font.setPixelSize(11)
        painter.save()
        painter.setFont(font)
        painter.translate(SIZE / 2.0, SIZE / 2.0)
        for name, turn in (("top", 0), ("bottom", 0), ("left", -90), ("right", 90)):
            painter.save()
            painter.rotate(turn)
            y = SIZE // 2 - room if name == "bottom" else -SIZE // 2
            line = QtCore.QRect(-SIZE // 2, y, SIZE, room)
            painter.drawText(line, QtCore.Qt.AlignCenter, translate("BendTorsion", name))
            painter.restore()
        painter.restore()

    def _under(self, place) -> str:
        near = {
            name: QtCore.QLineF(QtCore.QPointF(place), self.point_of(name)).length()
            for row in ROWS
            for name in row
        }
        name = min(near, key=near.get)
        return name if near[name] <= REACH else ""

    def _tell(self) -> None:
        self.setToolTip(self._words())
        self.setAccessibleName(self._words())

    def _words(self) -> str:
        text = translate("BendTorsion", "{position} of the section on the axis; arrow keys move it")
        return text.format(position=translate("BendTorsion", self.value))


def _place(name: str) -> tuple[int, int]:
    return next((r, row.index(name)) for r, row in enumerate(ROWS) if name in row)
