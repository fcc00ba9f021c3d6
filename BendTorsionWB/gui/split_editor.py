# SPDX-License-Identifier: LGPL-2.1-or-later
"""The split editor: faces laid flat, their joints dragged and held against the rules at once."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_margins import Margin, joint_margins
from BendTorsionWB.core.patterns.face_strip import face_strip
from BendTorsionWB.gui.joint_words import set_joints
from BendTorsionWB.gui.plates_panel import faces_of
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.quantity_field import QuantityField
from BendTorsionWB.gui.split_scene import (
    BROKEN,
    FIXED,
    KEPT,
    LEFT,
    JointItem,
    PlateItem,
    by_lane,
    in_pixels,
    rows_of,
)
from BendTorsionWB.gui.split_view import MOVES, TURNS, StripView
from BendTorsionWB.gui.split_words import beyond, margin_line, too_long
from BendTorsionWB.gui.task_panel import TaskPanel

translate = FreeCAD.Qt.translate
CLEAR = 1.0
"""Least distance of joints while they are dragged, mm."""
SAME = 0.5
"""mm; edges of plates nearer than this to a joint are that joint."""


class SplitPanel(TaskPanel):
    """Developed strips of all faces of a PlateSet, lanes of a face below each other; joints are
    dragged, typed, added, removed, and are those of all lanes of their face."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Split editor"), "BendTorsion_Splits")
        self.plates = preview.objects[0]
        rows = [("RulePack", translate("BendTorsion", "Rules"))]
        self.add_form(PropertyForm([self.plates], rows, self.changed))
        self.scene = QtWidgets.QGraphicsScene()
        self.view = StripView(self)
        self.view.setToolTip(
            translate(
                "BendTorsion",
                "Drag a joint, or move it by the left and right arrow keys (Shift: ten times);"
                " up and down choose another, double-click or Ins adds one, Del removes it",
            )
        )
        self.body.addWidget(self.view)
        self.which = QtWidgets.QLabel()
        self.place = QuantityField(0.0, "mm", 0.0)
        self.place.setObjectName("place")
        self.place.setMinimumWidth(170)
        self.place.line.textChanged.connect(self._typed)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self.which, 1)
        line.addWidget(self.place, 1)
        self.body.addLayout(line)
        self.verdict = QtWidgets.QLabel()
        self.verdict.setObjectName("verdict")
        self.verdict.setWordWrap(True)
        self.body.addWidget(self.verdict)
        self.scale_note = QtWidgets.QLabel()
        self.body.addWidget(self.scale_note)
        self.joints: dict[str, list[float]] = {}
        self.forced: dict[str, list[float]] = {}
        self.rows = {}
        self.made = None
        self.length = 0.0
        self.focus: tuple[str, int] | None = None
        self.dragged = self.behind = False
        self.taken = "", 0, 0.0
        self.kept = 0.0
        self.placed: tuple[str, int] | None = None

    def show(self) -> None:
        """Open it; labels have their colours from where they stand."""
        super().show()
        self._draw()

    def first_field(self):
        """The strips have the keyboard, not the rules above them."""
        return self.view

    def show_findings(self) -> None:
        """Draw the strips again with what is found."""
        super().show_findings()
        self._draw()

    def take(self, face: str, k: int) -> None:
        """A joint is taken by the mouse: nothing is recomputed until it is let go, as the strips
        would be drawn anew and the joint lost."""
        self.taken = face, k, self.joints[face][k]
        self.dragged, self.behind = True, self.timer.isActive()
        self.timer.stop()

    def let_go(self) -> None:
        """The joint stays where it is; what was edited meanwhile is shown."""
        self.dragged = False
        if self.behind:
            self.moved()

    def drop(self) -> None:
        """Put the joint that is dragged back where it was taken; all else stays."""
        face, k, s = self.taken
        self.joints[face][k] = s
        self._write(face)
        self._show_items()
        self.chosen(face, k)
        self.let_go()

    def changed(self) -> None:
        """Recompute soon, but not while a joint is dragged."""
        if self.dragged:
            self.behind = True
        else:
            super().changed()

    def margins(self, face: str, k: int) -> tuple[Margin, ...]:
        """What the rules say of a joint where it stands now."""
        member = self.made.geometry.member
        cuts = {name: self._cuts(name) for name in self.rows}
        number = cuts[face].index(self.joints[face][k]) - 1
        return joint_margins(
            face,
            number,
            cuts,
            self.made.given.rules.within_stock(member.law.plate_kinds),
            self.adjacent,
            member.law.folds,
            self.made.given.keep_outs(
                self.length, [piece.end for piece in self.made.pieces if piece.end < self.length]
            ),
        )

    def keeps_rules(self, face: str, k: int) -> bool:
        """Whether a joint keeps them all."""
        return all(margin.kept for margin in self.margins(face, k))

    def move_joint(self, face: str, k: int, s: float) -> float:
        """Move a joint of a face between its neighbours; where it is then, mm."""
        least, most = self._between(face, k)
        self.joints[face][k] = round(min(max(s, least), most), 1)
        self._write(face)
        self._show_items()
        self.chosen(face, k)
        return self.joints[face][k]

    def _between(self, face: str, k: int) -> tuple[float, float]:
        """The least and the largest place of a joint between its neighbours."""
        own = self.joints[face]
        least = own[k - 1] + CLEAR if k else CLEAR
        most = own[k + 1] - CLEAR if k + 1 < len(own) else self.length - CLEAR
        return least, most

    def add_joint(self, face: str, s: float) -> None:
        """A further joint of a face."""
        s = round(min(max(s, CLEAR), self.length - CLEAR), 1)
        if any(abs(s - other) < CLEAR for other in self.joints[face]):
            return
        self.joints[face] = sorted([*self.joints[face], s])
        self.focus = face, self.joints[face].index(s)
        self._write(face)

    def divide(self, faces) -> None:
        """A further joint in the middle of the longest plate of faces."""
        plates = []
        for face in faces:
            cuts = self._cuts(face)
            plates += [(b - a, face, 0.5 * (a + b)) for a, b in zip(cuts, cuts[1:], strict=False)]
        _, face, middle = max(plates, key=lambda plate: plate[0])
        self.add_joint(face, middle)

    def remove_joint(self, face: str, k: int) -> None:
        """One joint less."""
        del self.joints[face][k]
        self.focus = None
        self._write(face)

    def press(self, key: int, shift: bool) -> None:
        """What a key does to the joint chosen: moves it, goes to the next, adds one, removes it."""
        item = self.scene.focusItem()
        if isinstance(item, JointItem):
            self.focus = item.face, item.k
        if not self.rows:
            # Of plates in error nothing is drawn.
            return
        if key == QtCore.Qt.Key_Insert:
            self.divide(self.rows if self.focus is None else [self.focus[0]])
            return
        if key in TURNS or not self._has_joint():
            self.choose_next(TURNS.get(key, 1))
            return
        face, k = self.focus
        if key in MOVES:
            step = MOVES[key] * (10.0 if shift else 1.0)
            self.move_joint(face, k, self.joints[face][k] + step)
        else:
            self.remove_joint(face, k)

    def type_place(self, event) -> None:
        """A digit begins the place of the joint chosen; other letters write nothing."""
        if self._has_joint() and event.text().isdigit():
            self.place.setFocus(QtCore.Qt.OtherFocusReason)
            key = QtGui.QKeyEvent(event.type(), event.key(), event.modifiers(), event.text())
            QtWidgets.QApplication.sendEvent(self.place, key)

    def _has_joint(self) -> bool:
        """Whether a joint is chosen, not a face that has none."""
        return self.focus is not None and self.focus[1] < len(self.joints[self.focus[0]])

    def choose_next(self, step: int) -> None:
        """Give the next or the former joint the focus, face by face; a face without joints has a
        turn of its own, for Ins."""
        order = [(face, k) for face in self.rows for k in range(len(self.joints[face]) or 1)]
        at = order.index(self.focus) + step if self.focus in order else 0
        self._focus_on(*order[at % len(order)])

    def chosen(self, face: str, k: int) -> None:
        """Show the place of a joint and each rule with its figure and its limit."""
        self.focus = face, k
        text = translate("BendTorsion", "{face}: joint {number} at")
        self.which.setText(text.format(face=translate("BendTorsion", face), number=k + 1))
        other, self.placed = self.placed != self.focus, self.focus
        self._show_place(self.joints[face][k], other)
        self.verdict.setText("<br>".join(map(margin_line, self.margins(face, k))))

    def _show_place(self, s: float, other: bool) -> None:
        """Show a place, of another joint than before in place of any text; a text that is none
        stays with its own."""
        self.place.setEnabled(True)
        if self.place.hasFocus() or self.place.line.hasFocus():
            return
        if other:
            self.kept = s
        if other if self.place.fault() else abs(self.place.property("rawValue") - s) > 0.05:
            self.place.blockSignals(True)
            self.place.setProperty("rawValue", s)
            self.place.blockSignals(False)
            # From its first figure on: a field that was too narrow once stays scrolled.
            self.place.line.home(False)

    def _typed(self, _=None) -> None:
        if self.focus is None or self.closed:
            return
        face, k = self.focus
        fault, s = self.place.fault(), float(self.place.property("rawValue"))
        least, most = self._between(face, k)
        # After a place beyond, the field began with that: it is none to go back to.
        if least <= self.place.before() <= most:
            self.kept = self.place.before()
        if not fault and not least <= s <= most:
            fault = beyond(s, least, most, self.length)
        if fault or self.place in self.refused:
            self.refuse(self.place, fault)
        # Of a place in error nothing is shown: the joint is where it was before it was typed.
        s = self.kept if fault else s
        if abs(s - self.joints[face][k]) > 0.05 and least <= s <= most:
            self.move_joint(face, k, s)

    def _write(self, face: str) -> None:
        set_joints(self.plates, face, " ".join(f"{s:.10g}" for s in self.joints[face]))
        self.changed()

    def _cuts(self, face: str) -> list[float]:
        """Start of the member, joints and changes of thickness of a face, end of the member."""
        return sorted([0.0, *self.joints[face], *self.forced[face], self.length])

    def _draw(self) -> None:
        if self.dragged:
            self.behind = True
            return
        from BendTorsionWB.core import detailing
        from BendTorsionWB.core.sections.section import strips_meet
        from BendTorsionWB.objects import plate_set

        try:
            made = plate_set.value(self.plates)
            developed = detailing.record_of(made).plates
        except BendTorsionError:
            # The strips stay as they were; the findings say why.
            return
        self.made, self.length = made, made.geometry.member.length
        strips = made.geometry.member.law.strips
        self.adjacent = {
            one.face: [o.face for o in strips if o is not one and strips_meet(one, o)]
            for one in strips
        }
        own = {
            face: [plate for plate in developed if plate.face == face and plate.lines]
            for face in faces_of(self.plates)
        }
        lanes = by_lane(own, {item.plate.mark: item.plate.lane.letter for item in made.plates})
        laid = {lane: face_strip(plates) for lane, plates in lanes.items()}
        rows, larger = rows_of({lane: strip for lane, strip in laid.items() if strip})
        self.rows = {face: {} for face, _ in rows}
        for (face, letter), row in rows.items():
            self.rows[face][letter] = row
        self.scene.clear()
        for face in self.rows:
            self.joints[face] = self._joints_of(face, own[face])
            self.forced[face] = [
                s
                for s in sorted({round(plate.s_start, 3) for plate in own[face]})[1:]
                if all(abs(s - joint) > SAME for joint in self.joints[face])
            ]
        for (face, letter), row in rows.items():
            self._draw_row(face, letter, row, lanes[face, letter])
        bounds = self.scene.itemsBoundingRect().adjusted(-6, -6, 6, 6)
        self.scene.setSceneRect(bounds)
        self.view.show_all()
        note = translate(
            "BendTorsion", "Each face laid flat; breadths drawn {times:.1f} times as large"
        )
        self.scale_note.setText(note.format(times=larger))
        if self.focus is not None:
            self._focus_on(*self.focus)
        else:
            self._summary()

    def _draw_row(self, face: str, letter: str, row, plates) -> None:
        # As labels are written, in a dark window too.
        ink = self.scale_note.palette().color(QtGui.QPalette.WindowText)
        name = self.scene.addSimpleText(f"{translate('BendTorsion', face)} {letter}".strip())
        name.setBrush(ink)
        start = row.line(float(row.strip.s[0])).center()
        name.setPos(-LEFT, start.y())
        in_pixels(name, 0.0)
        for k, plate in enumerate(sorted(plates, key=lambda plate: plate.s_start)):
            item = PlateItem(self, face, row, k, plate.s_start, plate.s_end)
            long = plate.s_end - plate.s_start
            item.setToolTip(f"{plate.mark}: {long:.0f} mm, t = {plate.thickness:g}")
            self.scene.addItem(item)
            text = self.scene.addSimpleText(plate.mark.rsplit("-", 1)[-1])
            text.setBrush(QtGui.QColor("#3a2a00"))
            text.setAcceptedMouseButtons(QtCore.Qt.NoButton)
            at = row.line(0.5 * (plate.s_start + plate.s_end)).center()
            text.setPos(at)
            in_pixels(text, 0.5)
            text.setZValue(1.0)
        kept_clear = self.made.given.keep_outs(self.length)
        for places, colour in (
            (self.made.geometry.member.law.folds, "#2f6fb0"),
            ([s for own in kept_clear.values() for s in own], "#7b4aa0"),
        ):
            pen = QtGui.QPen(QtGui.QColor(colour), 1.5, QtCore.Qt.DashLine)
            for s in places:
                self.scene.addLine(row.line(s), pen).setZValue(1.0)
        pen = QtGui.QPen(QtGui.QColor(FIXED), 3.0)
        for s in self.forced[face]:
            line = self.scene.addLine(row.line(s), pen)
            line.setZValue(1.5)
            words = translate(
                "BendTorsion", "{place:.0f} mm: asked for by sections or pieces, stays where it is"
            )
            line.setToolTip(words.format(place=s))
        for k, s in enumerate(self.joints[face]):
            self.scene.addItem(JointItem(self, face, k, s, row))

    def _joints_of(self, face: str, plates) -> list[float]:
        """The joints of a face in mm: those given, or those solved without those that sections and
        pieces ask for, which stay where they are."""
        given = list(getattr(self.plates, f"Joints{face.capitalize()}"))
        if face in self.plates.AutoJoints:
            law = self.made.geometry.member.law
            index = [strip.face for strip in law.strips].index(face)
            solved = sorted({round(plate.s_start, 1) for plate in plates})[1:]
            return [s for s in solved if all(abs(s - o) > SAME for o in law.joints_of(index))]
        if given and max(given) <= 1.0:
            given = [value * self.length for value in given]
        return [round(s, 1) for s in given if s < self.length - CLEAR]

    def _focus_on(self, face: str, k: int) -> None:
        every = [item for item in self.scene.items() if isinstance(item, JointItem)]
        own = [item for item in every if (item.face, item.k) == (face, k)]
        for item in own[:1]:
            self.scene.setFocusItem(item)
            self.chosen(face, k)
        if not own:
            self.scene.setFocusItem(None)
            self.focus = None if self.joints[face] else (face, k)
            self._summary()
        self._show_items()

    def _show_items(self) -> None:
        """Draw joints where they are now, and what is chosen."""
        for item in self.scene.items():
            if isinstance(item, PlateItem):
                item.show_chosen()
            # One that was just removed is drawn until all is drawn anew.
            elif isinstance(item, JointItem) and item.k < len(self.joints[item.face]):
                item.show_at(self.joints[item.face][item.k])

    def _summary(self) -> None:
        """How many joints keep the rules, while none is chosen, but perhaps a face without any."""
        words, face = translate("BendTorsion", "{face}: no joint, Ins adds one"), self.focus
        self.which.setText(words.format(face=translate("BendTorsion", face[0])) if face else "")
        self.place.setEnabled(False)
        every = [(face, k) for face in self.rows for k in range(len(self.joints[face]))]
        broken = sum(not self.keeps_rules(*item) for item in every)
        text = translate("BendTorsion", "Joints: {count}, against the rules: {broken}")
        colour = BROKEN if broken else KEPT
        lines = [(colour, text.format(count=len(every), broken=broken))]
        # No joint is there to tell of its plates.
        rules = self.made.given.rules.within_stock(self.made.geometry.member.law.plate_kinds)
        for name in (face for face in self.rows if not self.joints[face]):
            cuts = self._cuts(name)
            longest = max(b - a for a, b in zip(cuts, cuts[1:]))
            if longest > rules.longest_piece:
                lines.append((BROKEN, too_long(name, longest, rules.longest_piece)))
        dots = (f'<span style="color:{colour}">&#9679;</span> {line}' for colour, line in lines)
        self.verdict.setText("<br>".join(dots))
