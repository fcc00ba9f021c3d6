# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels of plates: joints per face, delivery pieces, diaphragms."""

from __future__ import annotations

import re

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.stock import stock_of
from BendTorsionWB.core.part_tables import PART_COLUMNS, READERS
from BendTorsionWB.core.plates.diaphragm_input import ENDS
from BendTorsionWB.core.sections.section import BOX_FACES
from BendTorsionWB.core.tolerances import NEAREST_STATIONS
from BendTorsionWB.gui import finding_words, macro
from BendTorsionWB.gui.joint_words import joints_text, set_joints
from BendTorsionWB.gui.member_rows import matching
from BendTorsionWB.gui.panel_room import MARGIN
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.row_table import RowTable
from BendTorsionWB.gui.task_panel import TaskPanel
from BendTorsionWB.gui.typed_line import TypedLine
from BendTorsionWB.gui.typed_quantity import number_of

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
UNITS = {"piece": "", "rotation": "deg"}
"""Of columns of numbers that are no lengths."""
PLACES = ("s", "from", "to")
PLAIN = re.compile(r"\d+(\.\d+)?%?")
"""A place that is kept as it is written."""


class PlatesPanel(TaskPanel):
    """Joints of each face, the rules they are held against, the spacing of measuring lines."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Plates"), "BendTorsion_Plates")
        self.plates = preview.objects[0]
        rows = [
            ("RulePack", translate("BendTorsion", "Rules")),
            ("StationSpacing", translate("BendTorsion", "Measuring lines every")),
        ]
        limits = {"StationSpacing": (NEAREST_STATIONS,)}
        self.fields = PropertyForm([self.plates], rows, self.changed, limits=limits)
        self.add_form(self.fields)
        stock = QtWidgets.QFormLayout()
        self.stock = TypedLine(self.plates.Stock)
        self.stock.setObjectName("stock")
        example = translate("BendTorsion", "such as {text}")
        self.stock.setPlaceholderText(example.format(text="12000x2500; 30 S460 8000x2200"))
        tip = self.plates.getDocumentationOfProperty("Stock")
        self.stock.setToolTip(translate("App::Property", tip))
        self.stock.textEdited.connect(self._stock)
        self.stock.begun.connect(self._settle)
        self.stock.editingFinished.connect(self._settle)
        stock.addRow(translate("BendTorsion", "Stock"), self.stock)
        self.body.addLayout(stock)
        box = QtWidgets.QGroupBox(translate("BendTorsion", "Joints of each face"))
        box.setToolTip(
            translate("BendTorsion", "mm from the start, ratios up to 1, auto, or empty for none")
        )
        form = QtWidgets.QFormLayout(box)
        self.joints = {}
        for face in faces_of(self.plates):
            field = TypedLine(joints_text(self.plates, face))
            field.setObjectName(f"joints {face}")
            field.setPlaceholderText(
                translate("BendTorsion", "none, or such as 4000 8000, 0.5, auto")
            )
            field.textEdited.connect(lambda text, face=face: self._joints(face, text))
            field.begun.connect(self._settle)
            field.editingFinished.connect(self._settle)
            form.addRow(translate("BendTorsion", face), field)
            self.joints[face] = field
        self.body.addWidget(box)
        # What the fields held before the edit that is under way.
        self.before: dict[str, str] = {}
        self._settle()
        self.count = QtWidgets.QLabel()
        self.body.addWidget(self.count)

    def show_findings(self) -> None:
        """With the number of plates and their mass."""
        super().show_findings()
        text = translate("BendTorsion", "{count} plates, {mass:.0f} kg")
        self.count.setText(text.format(count=self.plates.PlateCount, mass=self.plates.Mass))

    def accept(self) -> bool:
        """Keep the edits; the plates stand for the member from then on."""
        member = self.plates.Member
        done = super().accept()
        if done and member is not None and member.ViewObject.Visibility:
            with macro.recorded(member.Document):
                macro.put_view(member, "Visibility", False)
        return done

    def _stock(self, text: str) -> None:
        reason = ""
        try:
            stock_of(text)
        except BendTorsionError as problem:
            text, reason = self.before["stock"], _told(problem)
        if text != self.plates.Stock:
            self.plates.Stock = text
            self.changed()
        self.refuse(self.stock, reason)

    def _settle(self) -> None:
        """A field is left, or its text begun anew: what it holds is what the edit begins with."""
        if self.stock not in self.refused:
            self.before["stock"] = self.plates.Stock
        for face, field in self.joints.items():
            if field not in self.refused:
                self.before[face] = joints_text(self.plates, face)

    def _joints(self, face: str, text: str) -> None:
        field, reason = self.joints[face], ""
        try:
            set_joints(self.plates, face, text)
        except ValueError as problem:
            reason = f"{translate('BendTorsion', face)}: {problem}"
            if joints_text(self.plates, face) != self.before[face]:
                set_joints(self.plates, face, self.before[face])
                self.changed()
        if not reason:
            self.changed()
        self.refuse(field, reason)


class PartsPanel(TaskPanel):
    """The rows of one table of a PlateSet, `Pieces` or `Diaphragms`, as in a spreadsheet."""

    def __init__(self, preview: Preview, table: str, title: str, icon: str):
        super().__init__(preview, title, icon)
        from BendTorsionWB.objects import plate_parts

        self.plates, self.table = preview.objects[0], table
        self.columns = PART_COLUMNS[table]
        self.rows = RowTable(self.columns, grows=True)
        self.rows.setObjectName("rows")
        self.rows.setMinimumHeight(160)
        for c, tip in enumerate(plate_parts.column_tips(table)):
            self.rows.horizontalHeaderItem(c).setToolTip(translate("App::Property", tip))
        self.rows.show_rows(
            [_text(row.get(column, "")) for column in self.columns]
            for row in plate_parts.rows_of(self.plates, table)
        )
        self.rows.resizeColumnsToContents()
        self.rows.edited.connect(lambda _: self._read())
        self.rows.choices = self._choices
        self.rows.judge = self._reason
        self.body.addWidget(self.rows)
        hint = QtWidgets.QLabel(
            translate(
                "BendTorsion",
                "Type rows, or paste them from a spreadsheet; headings tell what they mean when"
                " the mouse is over them",
            )
        )
        if table == "Edges" and not any(
            getattr(user, "BT_Type", "") == "Unfold" for user in self.plates.InList
        ):
            judged = translate(
                "BendTorsion", "Welds are judged once the plates are laid flat (Development)"
            )
            hint.setText(f"{hint.text()}. {judged}.")
        hint.setObjectName("hint")
        hint.setWordWrap(True)
        self.body.addWidget(hint)

    def show(self) -> None:
        """Open it; typing starts in the first cell."""
        self.rows.setCurrentCell(0, 0)
        super().show()

    def first_field(self):
        """The table."""
        return self.rows

    def width(self) -> int:
        """All columns are to be seen."""
        self.rows.resizeColumnsToContents()
        headings = self.rows.verticalHeader().width() + self.rows.horizontalHeader().length()
        return max(super().width(), headings + MARGIN)

    def _choices(self, row: int, column: int) -> list[str]:
        """The faces, where one is asked for."""
        return faces_of(self.plates) if self.columns[column] == "face" else []

    def _cell(self, column: str, text: str) -> float | str:
        """What a cell means: a number, a place as text, or words, empty for nothing; raises
        ValueError."""
        from BendTorsionWB.objects import plate_parts

        if column in plate_parts.number_columns(self.table):
            return number_of(text, UNITS.get(column, "mm")) if text else ""
        if column == "face":
            return matching(text, faces_of(self.plates)) or text
        if column not in PLACES or not text:
            return text
        if word := matching(text, ENDS):
            return word
        if PLAIN.fullmatch(text) or not any(letter.isdigit() for letter in text):
            # The checks say of other words what a place is.
            return text
        if text.endswith("%"):
            return f"{number_of(text[:-1], ''):.15g}%"
        return f"{number_of(text, 'mm'):.15g}"

    def _reason(self, row: int, column: int, text: str) -> str:
        """Why a text cannot be in a cell; empty when it can."""
        try:
            self._cell(self.columns[column], text.strip())
        except ValueError as problem:
            return str(problem)
        return ""

    def _read(self) -> None:
        """Take the rows over when all can be read; mark those that cannot."""
        from BendTorsionWB.objects import plate_parts

        texts = self.rows.texts()
        self.rows.show_rows(texts)
        self.rows.resizeColumnsToContents()
        rows, reasons = [], []
        for r, cells in enumerate(texts):
            faults = {c: self._reason(r, c, text) for c, text in enumerate(cells)}
            faults = {c: told for c, told in faults.items() if told}
            if not faults:
                row = {name: self._cell(name, text) for name, text in zip(self.columns, cells)}
                try:
                    READERS[self.table](row)
                    rows.append(row)
                except (ValueError, BendTorsionError) as problem:
                    faults = dict.fromkeys(range(len(cells)), _told(problem))
            for c, told in faults.items():
                line = translate("BendTorsion", "row {number}: {reason}")
                reasons.append(line.format(number=r + 1, reason=told))
                self.rows.flag(r, c, told)
        self.refuse(self.rows, "\n".join(dict.fromkeys(reasons)))
        if not reasons:
            plate_parts.set_parts(self.plates, self.table, rows)
            self.changed()


def faces_of(plates) -> list[str]:
    """The faces of a PlateSet that have joints, those of a box first."""
    others = [
        name.removeprefix("Joints").lower()
        for name in plates.PropertiesList
        if name.startswith("Joints")
        and plates.getTypeIdOfProperty(name) == "App::PropertyFloatList"
    ]
    return list(dict.fromkeys([*BOX_FACES, *others]))


def _told(problem: Exception) -> str:
    """What is wrong with a row, and its mend."""
    if isinstance(problem, BendTorsionError):
        return finding_words.reason(problem.findings[0])
    return translate("BendTorsion", "a number is missing or cannot be read")


def _text(value) -> str:
    if isinstance(value, float):
        return f"{value:g}" if value else ""
    return str(value)
