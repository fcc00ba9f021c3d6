# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels of what a member is made of: surface, axis, section, alignment."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.geometry import surface as core_surface
from BendTorsionWB.core.tolerances import LARGEST_SIZE, SMALLEST_SIZE
from BendTorsionWB.gui.alignment_picker import AlignmentPicker
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.task_panel import TaskPanel
from BendTorsionWB.objects.member import segment_count

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

SECTION_ROWS = (
    ("Type", QT_TRANSLATE_NOOP("BendTorsion", "Type")),
    ("Height", QT_TRANSLATE_NOOP("BendTorsion", "Height h")),
    ("Breadth", QT_TRANSLATE_NOOP("BendTorsion", "Breadth b")),
    ("BreadthBottom", QT_TRANSLATE_NOOP("BendTorsion", "Breadth at the bottom")),
    ("Thickness", QT_TRANSLATE_NOOP("BendTorsion", "Thickness t")),
    ("ThicknessTop", QT_TRANSLATE_NOOP("BendTorsion", "Thickness of the top (0: t)")),
    ("ThicknessBottom", QT_TRANSLATE_NOOP("BendTorsion", "Thickness of the bottom (0: t)")),
    ("ThicknessWeb", QT_TRANSLATE_NOOP("BendTorsion", "Thickness of the webs (0: t)")),
    ("Gap1", QT_TRANSLATE_NOOP("BendTorsion", "Root gap, left or top")),
    ("Gap2", QT_TRANSLATE_NOOP("BendTorsion", "Root gap, right or bottom")),
    ("CornerJoint", QT_TRANSLATE_NOOP("BendTorsion", "Corner joint")),
    ("Material", QT_TRANSLATE_NOOP("BendTorsion", "Steel grade")),
)
SIZE_LIMITS = {
    **dict.fromkeys(("Height", "Breadth", "Thickness"), (SMALLEST_SIZE, LARGEST_SIZE)),
    **dict.fromkeys(("BreadthBottom", "ThicknessTop", "ThicknessBottom"), (0.0, LARGEST_SIZE)),
    **dict.fromkeys(("ThicknessWeb", "Gap1", "Gap2"), (0.0, LARGEST_SIZE)),
}
"""Of the sizes of a section, mm; those that are 0 where another counts may be 0."""
NO_BOTTOM = {"BreadthBottom", "CornerJoint"}
HIDDEN = {
    "i": {"CornerJoint"},
    "trapezoid": set(),
    "polygon": {"Height", "Breadth", "BreadthBottom", "ThicknessTop", "ThicknessBottom"},
    "strips": {"Height", "Breadth", "BreadthBottom", "Thickness", "ThicknessTop"}
    | {"ThicknessBottom", "ThicknessWeb", "Gap1", "Gap2", "CornerJoint"},
}
"""By type: what has no meaning and is hidden; NO_BOTTOM for all others."""
SURFACE_ROWS = (
    ("Kind", QT_TRANSLATE_NOOP("BendTorsion", "Kind")),
    ("a", QT_TRANSLATE_NOOP("BendTorsion", "Half-axis a")),
    ("b", QT_TRANSLATE_NOOP("BendTorsion", "Half-axis b")),
    ("c", QT_TRANSLATE_NOOP("BendTorsion", "Half-axis c")),
    ("R", QT_TRANSLATE_NOOP("BendTorsion", "Radius R of the ring")),
    ("r", QT_TRANSLATE_NOOP("BendTorsion", "Radius r")),
    ("angle", QT_TRANSLATE_NOOP("BendTorsion", "Half angle")),
    ("x", QT_TRANSLATE_NOOP("BendTorsion", "Origin x")),
    ("y", QT_TRANSLATE_NOOP("BendTorsion", "Origin y")),
    ("z", QT_TRANSLATE_NOOP("BendTorsion", "Origin z")),
    ("Offset", QT_TRANSLATE_NOOP("BendTorsion", "Offset outwards")),
    ("Flip", QT_TRANSLATE_NOOP("BendTorsion", "Reverse the outward side")),
)
SIZES = ("a", "b", "c", "R", "r", "angle")
AXIS_ROWS = (
    ("Surface", QT_TRANSLATE_NOOP("BendTorsion", "Surface")),
    ("Fit", QT_TRANSLATE_NOOP("BendTorsion", "Fit to the surface")),
    ("Distance", QT_TRANSLATE_NOOP("BendTorsion", "Distance (fit offset)")),
    ("Order", QT_TRANSLATE_NOOP("BendTorsion", "Order of points")),
    ("Closed", QT_TRANSLATE_NOOP("BendTorsion", "Closed ring")),
    ("Reversed", QT_TRANSLATE_NOOP("BendTorsion", "Turn the direction")),
    ("StartExtension", QT_TRANSLATE_NOOP("BendTorsion", "Extend the start")),
    ("EndExtension", QT_TRANSLATE_NOOP("BendTorsion", "Extend the end")),
    ("Frame", QT_TRANSLATE_NOOP("BendTorsion", "Height points along")),
    ("Roll", QT_TRANSLATE_NOOP("BendTorsion", "Roll")),
    ("Show", QT_TRANSLATE_NOOP("BendTorsion", "Show")),
)


class SectionPanel(TaskPanel):
    """The sizes of a section; members that use it follow at once."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Section"), "BendTorsion_Section")
        rows = [(name, translate("BendTorsion", label)) for name, label in SECTION_ROWS]
        sections = preview.objects[:1]
        self.fields = PropertyForm(sections, rows, self.changed, limits=SIZE_LIMITS)
        self.add_form(self.fields)
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)

    def changed(self) -> None:
        """Hide what the type does not have."""
        super().changed()
        self._show_rows()

    def show_findings(self) -> None:
        """With the figures of the section."""
        super().show_findings()
        self._show_rows()
        section = self.preview.objects[0]
        self.figures.setText(
            f"A = {section.Area.Value / 100.0:.1f} cm²   {section.MassPerMetre:.1f} kg/m"
        )

    def property_of(self, finding: Finding) -> str:
        """A finding about a section begins with the size it is about, as the schedule names it."""
        from BendTorsionWB.objects.section_spec import PROPERTY_OF_SIZE

        name = PROPERTY_OF_SIZE.get(finding.message.split()[0], "")
        section = self.preview.objects[0]
        if name.startswith("Thickness") and not getattr(section, name).Value:
            return "Thickness"
        return name or super().property_of(finding)

    def _show_rows(self) -> None:
        hidden = HIDDEN.get(self.preview.objects[0].Type, NO_BOTTOM)
        self.fields.show_rows({name for name, _ in SECTION_ROWS} - hidden)


class SurfacePanel(TaskPanel):
    """The sizes of an analytic surface, offset and outward side of any."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Surface"), "BendTorsion_Surface")
        rows = [(name, translate("BendTorsion", label)) for name, label in SURFACE_ROWS]
        self.fields = PropertyForm(preview.objects[:1], rows, self.changed)
        self.add_form(self.fields)

    def show_findings(self) -> None:
        """With the fields the kind has."""
        super().show_findings()
        kind = self.preview.objects[0].Kind
        names = {name for name, _ in SURFACE_ROWS} - set(SIZES)
        if kind == "face":
            names -= {"x", "y", "z"}
        else:
            names |= set(core_surface.parameter_names(kind))
        self.fields.show_rows(names)


class AxisPanel(TaskPanel):
    """How an axis follows its surface, its ends and its frame."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Axis"), "BendTorsion_Axis")
        rows = [(name, translate("BendTorsion", label)) for name, label in AXIS_ROWS]
        self.fields = PropertyForm(preview.objects, rows, self.changed, {"Surface": "Surface"})
        self.add_form(self.fields)
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)

    def show_findings(self) -> None:
        """With the length and the distance from the surface."""
        super().show_findings()
        axis = self.preview.objects[0]
        text = translate("BendTorsion", "Length {length:.1f} mm, off the surface {off:.4f} mm")
        self.figures.setText(
            text.format(length=axis.Length.Value, off=axis.SurfaceDistanceMax.Value)
        )


class AlignmentPanel(TaskPanel):
    """The position of one or more members on their axes, all segments alike."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Alignment"), "BendTorsion_Alignment")
        members = preview.objects
        self.picker = AlignmentPicker(members[0].Align1)
        self.picker.chosen.connect(self._align)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self.picker)
        hint = QtWidgets.QLabel(
            translate("BendTorsion", "or click the member where the axis is to be")
        )
        hint.setWordWrap(True)
        line.addWidget(hint, 1)
        self.body.addLayout(line)
        self.clicks = None
        rows = [
            ("AlignTo1", translate("BendTorsion", "Align to")),
            ("OffsetY", translate("BendTorsion", "Offset along the breadth")),
            ("OffsetZ", translate("BendTorsion", "Offset along the height")),
        ]
        self.fields = PropertyForm(members, rows, self._changed_all)
        self.add_form(self.fields)

    def show(self) -> None:
        """Follow clicks on the members, too."""
        from BendTorsionWB.gui.face_pick import FacePick

        super().show()
        self.picker.setFocus()
        self.clicks = FacePick(self.preview.objects, self.picker.choose)

    def stop(self) -> None:
        """Leave the clicks alone."""
        super().stop()
        if self.clicks is not None:
            self.clicks.stop()
            self.clicks = None

    def _align(self, value: str) -> None:
        for member in self.preview.objects:
            for k in range(1, segment_count(member) + 1):
                setattr(member, f"Align{k}", value)
        self.changed()

    def _changed_all(self) -> None:
        for member in self.preview.objects:
            for k in range(2, segment_count(member) + 1):
                setattr(member, f"AlignTo{k}", member.AlignTo1)
        self.changed()
