# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels of plates: joints per face, delivery pieces, diaphragms."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.stock import stock_of
from BendTorsionWB.core.part_tables import PART_COLUMNS, READERS
from BendTorsionWB.core.sections.section import BOX_FACES
from BendTorsionWB.gui import finding_words
from BendTorsionWB.gui.joint_words import joints_text, set_joints
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import PropertyForm
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.row_table import RowTable
from BendTorsionWB.gui.task_panel import TaskPanel

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class PlatesPanel(TaskPanel):
    """Joints of each face, the rules they are held against, the spacing of measuring lines."""

    def __init__(self, preview: Preview):
        super().__init__(preview, translate("BendTorsion", "Plates"), "BendTorsion_Plates")
        self.plates = preview.objects[0]
        rows = [
            ("RulePack", translate("BendTorsion", "Rules")),
            ("StationSpacing", translate("BendTorsion", "Measuring lines every")),
        ]
        self.fields = PropertyForm([self.plates], rows, self.changed)
        self.add_form(self.fields)
        stock = QtWidgets.QFormLayout()
        self.stock = QtWidgets.QLineEdit(self.plates.Stock)
        self.stock.setObjectName("stock")
        self.stock.setPlaceholderText("12000x2500; 16 10000x2000; 30 S460 8000x2200")
        tip = self.plates.getDocumentationOfProperty("Stock")
        self.stock.setToolTip(translate("App::Property", tip))
        self.stock.textEdited.connect(self._stock)
        stock.addRow(translate("BendTorsion", "Stock"), self.stock)
        self.body.addLayout(stock)
        box = QtWidgets.QGroupBox(translate("BendTorsion", "Joints of each face"))
        box.setToolTip(
            translate("BendTorsion", "mm from the start, ratios up to 1, auto, or empty for none")
        )
        form = QtWidgets.QFormLayout(box)
        self.joints = {}
        for face in faces_of(self.plates):
            field = QtWidgets.QLineEdit(joints_text(self.plates, face))
            field.setObjectName(f"joints {face}")
            field.setPlaceholderText(translate("BendTorsion", "none; 4000 8000; 0.5; auto"))
            field.textEdited.connect(lambda text, face=face: self._joints(face, text))
            form.addRow(translate("BendTorsion", face), field)
            self.joints[face] = field
        self.body.addWidget(box)
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
        if done and member is not None:
            member.ViewObject.Visibility = False
        return done

    def _stock(self, text: str) -> None:
        try:
            stock_of(text)
        except BendTorsionError as problem:
            self.refuse(self.stock, _told(problem))
            return
        self.plates.Stock = text
        self.refuse(self.stock, "")
        self.changed()

    def _joints(self, face: str, text: str) -> None:
        field = self.joints[face]
        try:
            set_joints(self.plates, face, text)
        except ValueError as problem:
            self.refuse(field, f"{translate('BendTorsion', face)}: {problem}")
            return
        self.refuse(field, "")
        self.changed()


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
        self.body.addWidget(self.rows)
        hint = QtWidgets.QLabel(
            translate(
                "BendTorsion",
                "Type rows, or paste them from a spreadsheet; headings tell what they mean when"
                " the mouse is over them",
            )
        )
        hint.setObjectName("hint")
        hint.setWordWrap(True)
        self.body.addWidget(hint)

    def show(self) -> None:
        """Open it; typing starts in the first cell."""
        super().show()
        self.rows.setCurrentCell(0, 0)
        self.rows.setFocus()

    def _choices(self, row: int, column: int) -> list[str]:
        """The faces, where one is asked for."""
        return faces_of(self.plates) if self.columns[column] == "face" else []

    def _read(self) -> None:
        """Take the rows over when all can be read; mark those that cannot."""
        from BendTorsionWB.objects import plate_parts

        texts = self.rows.texts()
        self.rows.show_rows(texts)
        self.rows.resizeColumnsToContents()
        rows, reason = [], ""
        for r, cells in enumerate(texts):
            row = dict(zip(self.columns, cells, strict=True))
            try:
                numbers = plate_parts.number_columns(self.table)
                row = {
                    name: float(text.replace(",", ".") or 0.0) if name in numbers else text
                    for name, text in row.items()
                }
                READERS[self.table](row)
                rows.append(row)
            except (ValueError, BendTorsionError) as problem:
                told = _told(problem)
                line = translate("BendTorsion", "row {number}: {reason}")
                reason = reason or line.format(number=r + 1, reason=told)
                for c in range(len(self.columns)):
                    self.rows.flag(r, c, told)
        self.refuse(self.rows, reason)
        if not reason:
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
