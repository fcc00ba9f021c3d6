# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing of the split editor: developed strips of faces, and joints to drag along them."""

from __future__ import annotations

import numpy as np

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets

WIDTH, GAP, LANE_GAP, LEFT, LEAST_HEIGHT = 700.0, 26.0, 6.0, 100.0, 26.0
PLATES = ("#e8b84a", "#f3d58c")
KEPT, BROKEN, FIXED = "#43a047", "#e53935", "#455a64"


class Row:
    """Where the developed strip of a face is drawn: scale along, scale across, height of its middle
    in the scene; y grows downwards there."""

    def __init__(self, strip, along: float, across: float, middle: float):
        self.strip, self.along, self.across, self.middle = strip, along, across, middle

    def point(self, flat) -> QtCore.QPointF:
        """A point of the strip in the scene."""
        return QtCore.QPointF(flat[0] * self.along, self.middle - flat[1] * self.across)

    def line(self, s: float) -> QtCore.QLineF:
        """The line across the strip at a place on the axis."""
        return QtCore.QLineF(*map(self.point, self.strip.across(s)))

    def place(self, at) -> float:
        """The place on the axis nearest to a point of the scene."""
        return self.strip.place_at((at.x() / self.along, (self.middle - at.y()) / self.across))

    def plate(self, start: float, end: float) -> QtGui.QPolygonF:
        """The outline of the strip between two places."""
        inside = (self.strip.s > start) & (self.strip.s < end)
        first, second = self.strip.across(start), self.strip.across(end)
        edge = [first[0], *self.strip.first[inside], second[0]]
        back = [second[1], *self.strip.second[inside][::-1], first[1]]
        return QtGui.QPolygonF([self.point(flat) for flat in (*edge, *back)])


def by_lane(own, letters) -> dict[tuple[str, str], list]:
    """The plates of faces by face and lane, lanes in order; own: face -> its plates; letters: mark
    -> lane, empty for a face that is not divided along its length."""
    found: dict[tuple[str, str], list] = {}
    for face, plates in own.items():
        for plate in sorted(plates, key=lambda plate: letters.get(plate.mark, "")):
            found.setdefault((face, letters.get(plate.mark, "")), []).append(plate)
    return found


def rows_of(strips) -> tuple[dict[tuple[str, str], Row], float]:
    """A row for each strip by its face and lane, one below the other, all to one scale along; and
    how much larger breadths are drawn, so that slender faces can be seen."""
    boxes = {}
    for lane, strip in strips.items():
        points = np.concatenate([strip.first, strip.second])
        boxes[lane] = points.min(axis=0), points.max(axis=0)
    along = WIDTH / max(high[0] - low[0] for low, high in boxes.values())
    narrowest = min(
        float(np.hypot(*(strip.first - strip.second).T).max()) for strip in strips.values()
    )
    across = max(along, LEAST_HEIGHT / narrowest)
    rows, top, above = {}, -GAP, ""
    for (face, letter), strip in strips.items():
        low, high = boxes[face, letter]
        top += LANE_GAP if face == above else GAP
        rows[face, letter] = Row(strip, along, across, top + high[1] * across)
        top += (high[1] - low[1]) * across
        above = face
    return rows, across / along


def in_pixels(text, part: float) -> None:
    """Keep a text as large as others of the window, however small the drawing is; its middle, or
    the part of its width that is given, stands at its place."""
    text.setFlag(QtWidgets.QGraphicsItem.ItemIgnoresTransformations)
    size = text.boundingRect()
    text.setTransform(QtGui.QTransform.fromTranslate(-part * size.width(), -0.5 * size.height()))


class PlateItem(QtWidgets.QGraphicsPolygonItem):
    """One plate of a strip; a double-click adds a joint."""

    def __init__(self, panel, face: str, row: Row, k: int, start: float, end: float):
        super().__init__(row.plate(start, end))
        self.panel, self.face, self.row = panel, face, row
        self.setBrush(QtGui.QColor(PLATES[k % 2]))
        self.show_chosen()

    def show_chosen(self) -> None:
        """Draw it as one of the face chosen, or of another."""
        panel = self.panel
        chosen = panel.focus is not None and panel.focus[0] == self.face
        self.setPen(QtGui.QPen(QtGui.QColor("#7a5c14"), 2.5 if chosen else 1.0))

    def mouseDoubleClickEvent(self, event):
        """Add a joint here."""
        self.panel.add_joint(self.face, self.row.place(event.scenePos()))


class JointItem(QtWidgets.QGraphicsLineItem):
    """A joint that is dragged along its strip, green where it keeps the rules, red where not."""

    def __init__(self, panel, face: str, k: int, s: float, row: Row):
        super().__init__()
        self.panel, self.face, self.k, self.row = panel, face, k, row
        self.setCursor(QtCore.Qt.SizeHorCursor)
        self.setFlags(
            QtWidgets.QGraphicsItem.ItemIsFocusable | QtWidgets.QGraphicsItem.ItemIsSelectable
        )
        self.setZValue(2.0)
        self.show_at(s)

    def show_at(self, s: float) -> None:
        """Draw it at a place, as the rules judge it there."""
        line = self.row.line(s)
        # A little longer than the strip is wide, to be caught by the mouse.
        unit = line.unitVector()
        reach = QtCore.QPointF(unit.dx() * 5.0, unit.dy() * 5.0)
        self.setLine(QtCore.QLineF(line.p1() - reach, line.p2() + reach))
        colour = KEPT if self.panel.keeps_rules(self.face, self.k) else BROKEN
        wide = 7.0 if self.panel.focus == (self.face, self.k) else 4.0
        self.setPen(QtGui.QPen(QtGui.QColor(colour), wide, QtCore.Qt.SolidLine, QtCore.Qt.RoundCap))

    def boundingRect(self):
        """With room for the mouse beside the line."""
        return super().boundingRect().adjusted(-4.0, -4.0, 4.0, 4.0)

    def paint(self, painter, option, widget=None):
        """The line alone: the focus shows in its breadth."""
        painter.setPen(self.pen())
        painter.drawLine(self.line())

    def mousePressEvent(self, event):
        """Take it."""
        self.panel.take(self.face, self.k)
        self.setFocus()

    def mouseMoveEvent(self, event):
        """Drag it, unless Esc has put it back."""
        if self.panel.dragged:
            self.panel.move_joint(self.face, self.k, self.row.place(event.scenePos()))

    def mouseReleaseEvent(self, event):
        """Let it go."""
        if event.buttons() == QtCore.Qt.NoButton:
            self.panel.let_go()

    def focusInEvent(self, event):
        """Tell what the rules say of it."""
        super().focusInEvent(event)
        self.panel.chosen(self.face, self.k)
