# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a member: its axis and offsets, its segments with cuts and transitions."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.gui.alignment_picker import AlignmentPicker
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.quantity_field import LARGEST
from BendTorsionWB.gui.task_panel import TaskPanel
from BendTorsionWB.objects.member import segment_count

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

MEMBER_ROWS = (
    ("Axis", QT_TRANSLATE_NOOP("BendTorsion", "Axis")),
    ("OffsetY", QT_TRANSLATE_NOOP("BendTorsion", "Offset along the breadth")),
    ("OffsetZ", QT_TRANSLATE_NOOP("BendTorsion", "Offset along the height")),
    ("Roll", QT_TRANSLATE_NOOP("BendTorsion", "Roll")),
    ("StartCut", QT_TRANSLATE_NOOP("BendTorsion", "Cut of the start")),
    ("EndCut", QT_TRANSLATE_NOOP("BendTorsion", "Cut of the end")),
)
SEGMENT_ROWS = (
    ("Section", QT_TRANSLATE_NOOP("BendTorsion", "Section")),
    ("Cut", QT_TRANSLATE_NOOP("BendTorsion", "Cut")),
    ("Slope", QT_TRANSLATE_NOOP("BendTorsion", "Slope 1 :")),
    ("Transition", QT_TRANSLATE_NOOP("BendTorsion", "Transition")),
    ("AlignTo", QT_TRANSLATE_NOOP("BendTorsion", "Align to")),
    ("OffsetY", QT_TRANSLATE_NOOP("BendTorsion", "Offset along the breadth")),
    ("OffsetZ", QT_TRANSLATE_NOOP("BendTorsion", "Offset along the height")),
)
OF_A_CUT = ("Cut", "Slope", "Transition")
STEPS = 1000


class MemberPanel(TaskPanel):
    """Edits one member; `segment` is the number of the segment shown."""

    def __init__(self, preview: Preview, segment: int = 1):
        super().__init__(preview, translate("BendTorsion", "Member"), "BendTorsion_Member")
        self.member = preview.objects[0]
        rows = [(name, translate("BendTorsion", label)) for name, label in MEMBER_ROWS]
        self.fields = PropertyForm([self.member], rows, self.changed, {"Axis": "Axis"})
        self.add_form(self.fields)
        self.segments = QtWidgets.QComboBox()
        self.segments.setObjectName("segments")
        self.segments.currentIndexChanged.connect(lambda _: self._choose_segment())
        self.add = QtWidgets.QPushButton(translate("BendTorsion", "Add cut"))
        self.remove = QtWidgets.QPushButton(translate("BendTorsion", "Remove"))
        self.add.clicked.connect(self._add)
        self.remove.clicked.connect(self._remove)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self.segments, 1)
        for button in (self.add, self.remove):
            line.addWidget(button)
        self.body.addLayout(line)
        self.box = QtWidgets.QGroupBox()
        self.inner = QtWidgets.QVBoxLayout(self.box)
        self.body.addWidget(self.box)
        self.transition = QtWidgets.QLabel()
        self.segment_fields, self.shown = None, 0
        self.picking = self.slider = None
        self.dragger = None
        self._list(segment)

    def show(self) -> None:
        """With the cuts to be dragged in the 3D view."""
        # Here, not above: the panel is known before the first 3D view is.
        from BendTorsionWB.gui.cut_dragger import CutDragger

        super().show()
        self.dragger = CutDragger(self)

    @property
    def segment(self) -> int:
        """Number of the segment shown."""
        return self.segments.currentIndex() + 1

    def show_findings(self) -> None:
        """With the length of the transition before the segment."""
        super().show_findings()
        marks = [line for line in self.member.Zones if line.startswith(f"b-{self.segment - 1} ")]
        text = ""
        if marks and self.segment > 1:
            start, end = map(float, marks[0].split()[1:3])
            text = translate("BendTorsion", "Transition {length:.0f} mm: {start:.0f} to {end:.0f}")
            text = text.format(length=end - start, start=start, end=end)
        self.transition.setText(text)
        self.transition.setVisible(bool(text))
        for k, words in enumerate(self._segment_words()):
            self.segments.setItemText(k, words)
        self._show_cut()
        if self.dragger is not None and self.dragger.held is None and not self.closed:
            self.dragger.refresh()

    def show_segment(self, number: int) -> bool:
        """Choose the segment whose fields are shown; False when what was typed for that shown is to
        be mended first."""
        if number != self.segment:
            if self.segment_fields.refused:
                return False
            self.segments.blockSignals(True)
            self.segments.setCurrentIndex(number - 1)
            self.segments.blockSignals(False)
            self._show_segment()
        return True

    def property_of(self, finding: Finding) -> str:
        """Findings about a cut name its segment."""
        if finding.position.startswith("segment ") and finding.message.startswith("cut "):
            return f"Cut{finding.position.split()[1].rstrip(',')}"
        return super().property_of(finding)

    def _list(self, segment: int) -> None:
        self.segments.blockSignals(True)
        self.segments.clear()
        self.segments.addItems(self._segment_words())
        self.segments.setCurrentIndex(segment - 1)
        self.segments.blockSignals(False)
        self.remove.setEnabled(self.member.Segments > 1)
        self._show_segment()

    def _segment_words(self) -> list[str]:
        """Each segment with its section."""
        words = translate("BendTorsion", "Segment {number}: {section}")
        count = segment_count(self.member)
        sections = [getattr(self.member, f"Section{k + 1}") for k in range(count)]
        return [
            words.format(number=k, section=section.Label if section else "-")
            for k, section in enumerate(sections, start=1)
        ]

    def _choose_segment(self) -> None:
        """Show the segment chosen, unless what was typed for that shown is to be mended first."""
        if self.segment_fields is not None and self.segment_fields.refused:
            self.segments.blockSignals(True)
            self.segments.setCurrentIndex(self.shown - 1)
            self.segments.blockSignals(False)
        else:
            self._show_segment()

    def _show_segment(self) -> None:
        """Build the fields of the segment chosen."""
        if self.segment_fields is not None:
            self.forms.remove(self.segment_fields)
        while self.inner.count():
            item = self.inner.takeAt(0).widget()
            if item is not self.transition:
                item.hide()
                item.deleteLater()
        k = self.segment
        closed = self.member.Axis is not None and self.member.Axis.Closed
        rows = [
            (f"{name}{k}", translate("BendTorsion", label))
            for name, label in SEGMENT_ROWS
            if k > 1 or closed or name not in OF_A_CUT
        ]
        self.shown = k
        self.segment_fields = PropertyForm(
            [self.member],
            rows,
            self.changed,
            {f"Section{k}": "SectionSpec"},
            {f"Slope{k}": (0.0, LARGEST)},
        )
        self.watch(self.segment_fields)
        self.box.setTitle(translate("BendTorsion", "Segment {number}").format(number=k))
        picker = AlignmentPicker(getattr(self.member, f"Align{k}"))
        picker.chosen.connect(self._align)
        self.picker, self.slider = picker, None
        self.inner.addWidget(self.segment_fields)
        self.inner.addWidget(self.transition)
        if k > 1 or closed:
            self.slider = QtWidgets.QSlider(QtCore.Qt.Horizontal)
            self.slider.setRange(1, STEPS - 1)
            self.slider.setToolTip(translate("BendTorsion", "Drag the cut along the axis"))
            self.slider.valueChanged.connect(self._slide)
            self.inner.addWidget(self.slider)
            self.pick = QtWidgets.QPushButton(translate("BendTorsion", "Pick the cut in 3D"))
            self.pick.setCheckable(True)
            self.pick.toggled.connect(self._pick)
            self.inner.addWidget(self.pick)
        self.inner.addWidget(picker)
        self.show_findings()

    def _align(self, value: str) -> None:
        setattr(self.member, f"Align{self.segment}", value)
        self.moved()

    def _slide(self, step: int) -> None:
        self.cut_at(step / STEPS * self.member.Axis.Length.Value)

    def cut_at(self, place: float) -> None:
        """Move the cut of the segment shown to a place, mm."""
        k = self.segment
        setattr(self.member, f"CutBy{k}", "place")
        setattr(self.member, f"CutRatio{k}", 0.0)
        setattr(self.member, f"CutOffset{k}", 0.0)
        setattr(self.member, f"Cut{k}", round(place, 1))
        self.segment_fields.read((f"Cut{k}",))
        self._show_cut()
        self.moved()

    def _show_cut(self) -> None:
        """The slider where the cut is, also by an expression; of one that is nowhere it stays."""
        from BendTorsionWB.objects import axis as axis_object
        from BendTorsionWB.objects.proxy import linked
        from BendTorsionWB.objects.segment_edit import cut_length

        if self.slider is None or self.slider.isSliderDown():
            return
        try:
            axis = axis_object.value(linked(self.member, "Axis", "Axis"))
            place = cut_length(self.member, self.segment, axis)
        except BendTorsionError:
            return
        self.slider.blockSignals(True)
        self.slider.setValue(round(STEPS * place / axis.length))
        self.slider.blockSignals(False)

    def _add(self) -> None:
        """Divide the segment shown in its middle, unless what was typed is to be mended first."""
        if self.segment_fields.refused:
            return
        from BendTorsionWB.objects.segment_edit import add_cut, middle_of

        try:
            new = add_cut(self.member, middle_of(self.member, self.segment))
        except BendTorsionError as problem:
            self.tell(problem)
            return
        self._list(new)
        self.changed()

    def _remove(self) -> None:
        from BendTorsionWB.objects.segment_edit import remove_segment

        number = self.segment
        remove_segment(self.member, number)
        self._list(max(number - 1, 1))
        self.changed()

    def _pick(self, on: bool) -> None:
        if self.picking is not None:
            FreeCADGui.Selection.removeObserver(self.picking)
            self.picking = None
        if on:
            self.picking = _Pick(self)
            FreeCADGui.Selection.addObserver(self.picking)

    def picked(self, point) -> None:
        """Put the cut nearest to a point picked in the 3D view."""
        try:
            place = place_on(self.member, point)
        except BendTorsionError as problem:
            self.tell(problem)
            return
        self.cut_at(place)

    def stop(self) -> None:
        """Take the cuts out of the 3D view."""
        super().stop()
        self._pick(False)
        if self.dragger is not None:
            self.dragger.stop()


def place_on(member, point) -> float:
    """Place on the axis of a Member nearest to a point (x, y, z), to a tenth of a mm; raises
    BendTorsionError for an axis in error."""
    import numpy as np

    from BendTorsionWB.core.axes.axis_places import cut_place
    from BendTorsionWB.objects import axis as axis_object
    from BendTorsionWB.objects import member as member_object
    from BendTorsionWB.objects.proxy import linked

    core, at = axis_object.value(linked(member, "Axis", "Axis")), np.array(tuple(point), float)
    return round(float(cut_place(core, point=at, reach=member_object.reach(member))), 1)


class _Pick:
    """Takes the points picked in the 3D view to the panel."""

    def __init__(self, panel: MemberPanel):
        self.panel = panel

    def addSelection(self, document, obj, sub, point):
        """Called by FreeCAD for each pick."""
        if sub and document == self.panel.preview.document.Name:
            self.panel.picked(point)
