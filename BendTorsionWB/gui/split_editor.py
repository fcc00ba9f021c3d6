# SPDX-License-Identifier: LGPL-2.1-or-later
"""The split editor: each face as a strip, its joints dragged, held against the rules at once."""

from __future__ import annotations

import json
import re

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui.joint_words import set_joints
from BendTorsionWB.gui.plates_panel import faces_of
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.task_panel import COLOURS, TaskPanel

translate = FreeCAD.Qt.translate
WIDTH, HEIGHT, GAP, LEFT = 560.0, 34.0, 22.0, 64.0
PLATES = ("#e8b84a", "#f3d58c")
STEP = 10.0
"""Millimetres a joint moves with an arrow key; ten times with Shift."""
CLEAR = 1.0
"""Least distance of joints while they are dragged, mm."""


class SplitPanel(TaskPanel):
    """Strips of all faces of a PlateSet; joints are dragged, added by double-click, deleted."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Split editor"), "BendTorsion_Splits")
        self.plates = preview.objects[0]
        rows = [("RulePack", translate("BendTorsion", "Rules"))]
        self.add_form(PropertyForm([self.plates], rows, self.changed))
        self.scene = QtWidgets.QGraphicsScene()
        self.view = QtWidgets.QGraphicsView(self.scene)
        self.view.setRenderHint(QtGui.QPainter.Antialiasing)
        self.view.setMinimumHeight(270)
        self.view.setToolTip(
            translate(
                "BendTorsion",
                "Drag a joint or move it by arrow keys; double-click adds one, Del removes it",
            )
        )
        self.body.addWidget(self.view)
        self.place = QtWidgets.QLabel()
        self.body.addWidget(self.place)
        self.joints: dict[str, list[float]] = {}
        self.length = 0.0

    def show_findings(self) -> None:
        """Draw the strips again with what is found on them."""
        super().show_findings()
        self._draw()

    def move_joint(self, face: str, k: int, s: float) -> float:
        """Move a joint of a face between its neighbours; where it is then, mm."""
        own = self.joints[face]
        least = own[k - 1] + CLEAR if k else CLEAR
        most = own[k + 1] - CLEAR if k + 1 < len(own) else self.length - CLEAR
        own[k] = round(min(max(s, least), most), 1)
        text = translate("BendTorsion", "{face}: joint {number} at {place:.1f} mm")
        self.place.setText(
            text.format(face=translate("BendTorsion", face), number=k + 1, place=own[k])
        )
        self._write(face)
        return own[k]

    def add_joint(self, face: str, s: float) -> None:
        """A further joint of a face."""
        self.joints[face] = sorted([*self.joints[face], round(s, 1)])
        self._write(face)

    def remove_joint(self, face: str, k: int) -> None:
        """One joint less."""
        del self.joints[face][k]
        self._write(face)

    def _write(self, face: str) -> None:
        set_joints(self.plates, face, " ".join(f"{s:.10g}" for s in self.joints[face]))
        self.changed()

    def _draw(self) -> None:
        from BendTorsionWB.objects import plate_set

        try:
            made = plate_set.value(self.plates)
        except BendTorsionError:
            # The strips stay as they were; the findings say why.
            return
        self.scene.clear()
        member = made.geometry.member
        self.length = member.length
        plates = [item.plate for item in made.plates]
        for row, face in enumerate(faces_of(self.plates)):
            own = [plate for plate in plates if plate.face == face]
            if not own:
                continue
            top = row * (HEIGHT + GAP)
            self._strip(face, own, top, member.law.folds)
            self.joints[face] = self._joints_of(face, own)
            for k, s in enumerate(self.joints[face]):
                self.scene.addItem(JointItem(self, face, k, s, top))
        for finding in map(json.loads, self.plates.Findings):
            self._mark(finding)
        self.scene.setSceneRect(self.scene.itemsBoundingRect().adjusted(-6, -6, 6, 6))
        self.view.fitInView(self.scene.sceneRect(), QtCore.Qt.KeepAspectRatio)

    def _joints_of(self, face: str, plates) -> list[float]:
        """The joints of a face in mm: those given, or those solved."""
        given = list(getattr(self.plates, f"Joints{face.capitalize()}"))
        if face in self.plates.AutoJoints:
            ends = sorted({round(plate.start, 1) for plate in plates})
            return ends[1:]
        if given and max(given) <= 1.0:
            given = [value * self.length for value in given]
        return [round(s, 1) for s in given if s < self.length - CLEAR]

    def _strip(self, face: str, plates, top: float, folds) -> None:
        ink = self.form.palette().color(QtGui.QPalette.Text)
        name = self.scene.addSimpleText(translate("BendTorsion", face))
        name.setBrush(ink)
        name.setPos(-LEFT, top + 8)
        outline = QtGui.QPen(QtGui.QColor("#7a5c14"), 1.0)
        for k, plate in enumerate(plates):
            left, right = self.x_of(plate.start), self.x_of(plate.end)
            item = StripItem(self, face, QtCore.QRectF(left, top, right - left, HEIGHT))
            item.setPen(outline)
            item.setBrush(QtGui.QColor(PLATES[k % 2]))
            long, thick = plate.end - plate.start, plate.thickness
            item.setToolTip(f"{plate.mark}: {long:.0f} mm, t = {thick:g}")
            self.scene.addItem(item)
            text = self.scene.addSimpleText(plate.mark.rsplit("-", 1)[-1])
            text.setBrush(QtGui.QColor("#3a2a00"))
            text.setAcceptedMouseButtons(QtCore.Qt.NoButton)
            text.setPos(0.5 * (left + right) - 8, top + 8)
        dashes = QtGui.QPen(QtGui.QColor("#2f6fb0"), 1.0, QtCore.Qt.DashLine)
        for s in folds:
            self.scene.addLine(self.x_of(s), top - 4, self.x_of(s), top + HEIGHT + 4, dashes)

    def _mark(self, finding: dict) -> None:
        """A mark on the strips of the faces a finding names, where it is."""
        place = re.search(r"s = (-?[\d.]+)", finding["position"])
        if place is None:
            return
        colour = QtGui.QColor(COLOURS[finding["severity"]])
        words = re.findall(r"\w+", f"{finding['position']} {finding['message']}")
        for row, face in enumerate(faces_of(self.plates)):
            if face in words:
                x, y = self.x_of(float(place[1])), row * (HEIGHT + GAP) - 10
                item = self.scene.addPolygon(
                    QtGui.QPolygonF(
                        [
                            QtCore.QPointF(x - 6, y),
                            QtCore.QPointF(x + 6, y),
                            QtCore.QPointF(x, y + 9),
                        ]
                    ),
                    QtGui.QPen(colour),
                    colour,
                )
                item.setToolTip(f"{finding['message']}. {finding['mend']}")

    def x_of(self, s: float) -> float:
        """Where a place on the axis is drawn."""
        return s / self.length * WIDTH

    def s_of(self, x: float) -> float:
        """The place on the axis drawn at x."""
        return x / WIDTH * self.length


class StripItem(QtWidgets.QGraphicsRectItem):
    """One plate of a strip; a double-click adds a joint."""

    def __init__(self, panel: SplitPanel, face: str, rectangle):
        super().__init__(rectangle)
        self.panel, self.face = panel, face

    def mouseDoubleClickEvent(self, event):
        """Add a joint here."""
        self.panel.add_joint(self.face, self.panel.s_of(event.scenePos().x()))


class JointItem(QtWidgets.QGraphicsRectItem):
    """A joint that can be dragged along its strip."""

    def __init__(self, panel: SplitPanel, face: str, k: int, s: float, top: float):
        super().__init__(-3.0, top - 5.0, 6.0, HEIGHT + 10.0)
        self.panel, self.face, self.k = panel, face, k
        self.setPos(panel.x_of(s), 0.0)
        self.setBrush(QtGui.QColor("#c2410c"))
        self.setPen(QtGui.QPen(QtCore.Qt.NoPen))
        self.setCursor(QtCore.Qt.SizeHorCursor)
        self.setFlags(
            QtWidgets.QGraphicsItem.ItemIsFocusable | QtWidgets.QGraphicsItem.ItemIsSelectable
        )
        self.setZValue(2.0)

    def mousePressEvent(self, event):
        """Take it."""
        self.setFocus()

    def mouseMoveEvent(self, event):
        """Drag it."""
        s = self.panel.move_joint(self.face, self.k, self.panel.s_of(event.scenePos().x()))
        self.setPos(self.panel.x_of(s), 0.0)

    def keyPressEvent(self, event):
        """Move it by keys, or remove it."""
        step = STEP * (10.0 if event.modifiers() & QtCore.Qt.ShiftModifier else 1.0)
        moves = {QtCore.Qt.Key_Left: -step, QtCore.Qt.Key_Right: step}
        if event.key() in moves:
            at = self.panel.joints[self.face][self.k] + moves[event.key()]
            s = self.panel.move_joint(self.face, self.k, at)
            self.setPos(self.panel.x_of(s), 0.0)
        elif event.key() == QtCore.Qt.Key_Delete:
            self.panel.remove_joint(self.face, self.k)
