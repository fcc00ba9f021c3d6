# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels of what follows plates: flat patterns, assembly beds, nodes, drawing sheets."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.quantity_field import LARGEST
from BendTorsionWB.gui.task_panel import TaskPanel

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

PATTERN_ROWS = (
    ("Mode", QT_TRANSLATE_NOOP("BendTorsion", "Laying flat by")),
    ("FlattenedSurface", QT_TRANSLATE_NOOP("BendTorsion", "Surface laid flat")),
    ("MarkingFace", QT_TRANSLATE_NOOP("BendTorsion", "Marked and seen from")),
    ("Contour", QT_TRANSLATE_NOOP("BendTorsion", "Contour of bevelled edges")),
)
ALLOWANCE_ROWS = (
    ("ShrinkageAlong", QT_TRANSLATE_NOOP("BendTorsion", "Shrinkage along, mm/m")),
    ("ShrinkageAcross", QT_TRANSLATE_NOOP("BendTorsion", "Shrinkage across, mm/m")),
    ("JointAllowance", QT_TRANSLATE_NOOP("BendTorsion", "Per butt joint, mm")),
    ("DiaphragmAllowance", QT_TRANSLATE_NOOP("BendTorsion", "Per diaphragm, mm")),
    ("GreenStart", QT_TRANSLATE_NOOP("BendTorsion", "Green at the start, mm")),
    ("GreenEnd", QT_TRANSLATE_NOOP("BendTorsion", "Green at the end, mm")),
    ("Splice", QT_TRANSLATE_NOOP("BendTorsion", "Joints welded")),
)
BED_ROWS = (
    ("Face", QT_TRANSLATE_NOOP("BendTorsion", "Face that lies down")),
    ("Plane", QT_TRANSLATE_NOOP("BendTorsion", "Plane of the bed")),
    ("Normal", QT_TRANSLATE_NOOP("BendTorsion", "Upward direction x, y, z")),
    ("SaddleSpacing", QT_TRANSLATE_NOOP("BendTorsion", "Saddles every")),
    ("SeatHeight", QT_TRANSLATE_NOOP("BendTorsion", "Lowest seat above the floor")),
    ("PinPitch", QT_TRANSLATE_NOOP("BendTorsion", "Pitch of the pin grid (0: none)")),
    ("LowestPin", QT_TRANSLATE_NOOP("BendTorsion", "Lowest pin above its base")),
    ("TemplatePitch", QT_TRANSLATE_NOOP("BendTorsion", "Templates every")),
    ("TemplateLines", QT_TRANSLATE_NOOP("BendTorsion", "Templates besides at")),
    ("Clearance", QT_TRANSLATE_NOOP("BendTorsion", "Clearance of templates")),
)
NODE_ROWS = (
    ("Node", QT_TRANSLATE_NOOP("BendTorsion", "Name of the node")),
    ("Through", QT_TRANSLATE_NOOP("BendTorsion", "Runs through")),
    ("Other", QT_TRANSLATE_NOOP("BendTorsion", "Ends on it")),
    ("ThroughBy", QT_TRANSLATE_NOOP("BendTorsion", "Which runs through")),
    ("Place", QT_TRANSLATE_NOOP("BendTorsion", "About where, if they meet twice")),
    ("Type", QT_TRANSLATE_NOOP("BendTorsion", "Type")),
    ("Gap", QT_TRANSLATE_NOOP("BendTorsion", "Root gap")),
    ("StubLength", QT_TRANSLATE_NOOP("BendTorsion", "Length of the stub")),
    ("Diaphragms", QT_TRANSLATE_NOOP("BendTorsion", "Diaphragms inside")),
    ("Blend", QT_TRANSLATE_NOOP("BendTorsion", "Make flush")),
    ("RulePack", QT_TRANSLATE_NOOP("BendTorsion", "Rules")),
)
SHEET_ROWS = (
    ("Project", QT_TRANSLATE_NOOP("BendTorsion", "Project")),
    ("Author", QT_TRANSLATE_NOOP("BendTorsion", "Drawn by")),
    ("Bed", QT_TRANSLATE_NOOP("BendTorsion", "Assembly bed")),
    ("PlatePages", QT_TRANSLATE_NOOP("BendTorsion", "A page for each plate")),
    ("SheetFormat", QT_TRANSLATE_NOOP("BendTorsion", "Format")),
    ("SheetStandard", QT_TRANSLATE_NOOP("BendTorsion", "Standard")),
    ("SheetLanguage", QT_TRANSLATE_NOOP("BendTorsion", "Language")),
    ("SheetUnit", QT_TRANSLATE_NOOP("BendTorsion", "Unit")),
)


def _rows(declared) -> list[tuple[str, str]]:
    return [(name, translate("BendTorsion", label)) for name, label in declared]


class _InSight(TaskPanel):
    """A panel whose object is to be seen while it is edited, hidden as it may be otherwise."""

    def show(self) -> None:
        """Open it; the object comes into sight."""
        self.hidden = [obj for obj in self.preview.objects if not obj.ViewObject.Visibility]
        for obj in self.hidden:
            obj.ViewObject.Visibility = True
        super().show()

    def _end(self, finish) -> None:
        if not self.closed and not self.preview.create:
            for obj in self.hidden:
                obj.ViewObject.Visibility = False
        super()._end(finish)


class DevelopmentPanel(_InSight):
    """How the plates of a member are laid flat, and what they are cut larger by."""

    def __init__(self, preview: Preview):
        title = translate("BendTorsion", "Development")
        super().__init__(preview, title, "BendTorsion_Development")
        self.unfold = preview.objects[0]
        self.add_form(PropertyForm(preview.objects, _rows(PATTERN_ROWS), self.changed))
        form = PropertyForm(preview.objects, _rows(ALLOWANCE_ROWS), self.changed)
        self.add_form(form, translate("BendTorsion", "Cut larger by"))
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)

    def show_findings(self) -> None:
        """With the number of patterns and their worst length error."""
        super().show_findings()
        text = translate("BendTorsion", "{count} patterns, lengths within {off:.4f} mm")
        self.figures.setText(
            text.format(count=len(self.unfold.Marks), off=self.unfold.LengthErrorMax)
        )


class BedPanel(_InSight):
    """What the pieces of a member lie on while they are put together."""

    def __init__(self, preview: Preview):
        title = translate("BendTorsion", "Assembly bed")
        super().__init__(preview, title, "BendTorsion_AssemblyBed")
        self.bed = preview.objects[0]
        self.fields = PropertyForm(preview.objects, _rows(BED_ROWS), self.changed)
        self.add_form(self.fields)
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)

    def show_findings(self) -> None:
        """With the number of saddles, and the direction where it counts."""
        super().show_findings()
        names = {name for name, _ in BED_ROWS}
        self.fields.show_rows(names - (set() if self.bed.Plane == "normal" else {"Normal"}))
        text = translate("BendTorsion", "{count} saddles, lying on: {faces}")
        faces = ", ".join(translate("BendTorsion", face) for face in self.bed.DownFaces)
        self.figures.setText(text.format(count=len(self.bed.Saddles), faces=faces))


FIRST_STUB = 500.0
"""mm, of a stub that has no length yet, as far as it can be."""


class NodePanel(TaskPanel):
    """How one member ends on another."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Node"), "BendTorsion_Node")
        self.node = preview.objects[0]
        kinds = {"Through": "Member", "Other": "Member"}
        checks = {"Node": self._check_name}
        rows = _rows(NODE_ROWS)
        self.fields = PropertyForm(preview.objects, rows, self.changed, kinds, checks=checks)
        self.add_form(self.fields)
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)
        self._limit()

    def changed(self) -> None:
        """A stub without a length gets one that can be."""
        node = self.node
        bound = {path.lstrip(".") for path, _ in node.ExpressionEngine}
        if node.Type == "stub" and not node.StubLength.Value and "StubLength" not in bound:
            least, most = self._limits().get("StubLength", (0.0, 0.0))
            if 0.0 < least <= most:
                node.StubLength = max(least, min(FIRST_STUB, most))
                self.fields.read(["StubLength"])
        super().changed()

    def update(self) -> None:
        """What the fields can be depends on the members."""
        super().update()
        if not self.closed:
            self._limit()

    def _limits(self) -> dict[str, tuple[float, float]]:
        # Here, not above: the panel is known before what computes is loaded.
        from BendTorsionWB.objects import node as node_object

        return node_object.limits(self.node)

    def _limit(self) -> None:
        found = self._limits()
        for name in ("Gap", "StubLength"):
            least, most = found.get(name, (0.0, LARGEST))
            # Where no length can be, what is found says why.
            self.fields.limit(name, *((least, most) if least <= most else (0.0, LARGEST)))

    def _check_name(self, name: str) -> None:
        """Raises ValueError for a name that tells the node from nothing."""
        if not name.strip():
            raise ValueError(translate("BendTorsion", "give the node a name"))
        for obj in self.node.Document.Objects:
            if getattr(obj, "BT_Type", "") == "Member" and obj.Label == name.strip():
                words = translate("BendTorsion", "{name} is a member: give the node another name")
                raise ValueError(words.format(name=name.strip()))

    def show_findings(self) -> None:
        """With what kind of node it is, and the length of a stub where there is one."""
        super().show_findings()
        names = {name for name, _ in NODE_ROWS}
        self.fields.show_rows(names - (set() if self.node.Type == "stub" else {"StubLength"}))
        lines = []
        if self.node.ThroughBy == "rank":
            none = translate("BendTorsion", "none")
            members = [item for item in (self.node.Through, self.node.Other) if item is not None]
            ranks = ", ".join(f"{item.Label} {item.Rank or none}" for item in members)
            lines.append(
                translate("BendTorsion", "Ranks, property Rank of members: {ranks}").format(
                    ranks=ranks
                )
            )
        # Of members that do not meet there is neither angle nor distance.
        if self.node.Kind:
            text = translate("BendTorsion", "{kind}, angle {angle:.1f}°, axes {off:.2f} mm apart")
            lines.append(
                text.format(
                    kind=translate("BendTorsion", self.node.Kind),
                    angle=self.node.CrossingAngle.Value,
                    off=self.node.AxisDistance.Value,
                )
            )
        self.figures.setVisible(bool(lines))
        self.figures.setText("\n".join(lines))


class SheetsPanel(TaskPanel):
    """How the drawing sheets of a member look."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Sheets"), "BendTorsion_Sheets")
        self.sheets = preview.objects[0]
        rows = _rows(SHEET_ROWS)
        self.add_form(PropertyForm(preview.objects, rows, self.changed, {"Bed": "AssemblyBed"}))
        self.figures = QtWidgets.QLabel()
        self.body.addWidget(self.figures)

    def show_findings(self) -> None:
        """With the number of pages."""
        super().show_findings()
        text = translate("BendTorsion", "{count} pages")
        self.figures.setText(text.format(count=self.sheets.PageCount))
