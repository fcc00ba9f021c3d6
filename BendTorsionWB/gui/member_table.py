# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of all members in a dock: edited in bulk, each edit one undo step, shown at once."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui import finding_words, macro, member_rows
from BendTorsionWB.gui.command import errors_shown
from BendTorsionWB.gui.dock import DocumentDock, shown
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.row_table import RowTable

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
NAME = "BendTorsion_MemberTable"
ADD = QT_TRANSLATE_NOOP("BendTorsion", "Divide the segment")
REMOVE = QT_TRANSLATE_NOOP("BendTorsion", "Remove the segment")
MOST_TOLD = 6
LEAST_WIDTH = 64
"""Pixels of a column without texts yet, to be typed into."""


def show(document) -> MemberTable:
    """Show the table."""
    return shown(MemberTable, NAME)


class MemberTable(DocumentDock):
    """A row per segment of each member; columns as in a schedule."""

    def __init__(self):
        headings = [translate("BendTorsion", name) for name in member_rows.COLUMNS]
        self.table = RowTable(headings)
        self.table.edited.connect(self._edit)
        self.table.left_out.connect(self._tell_left_out)
        self.table.judge = self._reason
        self.table.choices = self._choices
        self.table.horizontalHeader().setStretchLastSection(False)
        self.table.horizontalHeader().setMinimumSectionSize(LEAST_WIDTH)
        self.table.setContextMenuPolicy(QtCore.Qt.ActionsContextMenu)
        bar = QtWidgets.QHBoxLayout()
        for text, keys, run in ((ADD, "Ins", self.add_segment), (REMOVE, "Ctrl+Del", self.remove)):
            sequence = QtGui.QKeySequence(keys)
            self.table.keys.append((sequence, run))
            action = QtGui.QAction(translate("BendTorsion", text), self.table)
            action.triggered.connect(lambda _=False, run=run: run())
            self.table.addAction(action)
            button = QtWidgets.QPushButton(translate("BendTorsion", text))
            button.setObjectName(text)
            button.setToolTip(sequence.toString(QtGui.QKeySequence.NativeText))
            button.clicked.connect(lambda _=False, run=run: run())
            bar.addWidget(button)
        self.said = QtWidgets.QLabel()
        self.said.setObjectName("said")
        self.said.setWordWrap(True)
        bar.addWidget(self.said, 1)
        whole = QtWidgets.QWidget()
        lines = QtWidgets.QVBoxLayout(whole)
        lines.setContentsMargins(0, 0, 0, 0)
        lines.addWidget(self.table)
        lines.addLayout(bar)
        self.rows: list[member_rows.Row] = []
        # By member, segment and column: what was typed and cannot be, and why.
        self.refused: dict[tuple[str, int, str], tuple[str, str]] = {}
        self.table.keys.append((QtGui.QKeySequence("Esc"), self.forget))
        self.sized = False
        super().__init__(NAME, translate("BendTorsion", "Member table"), whole)

    def add_segment(self) -> None:
        """Divide the segment of the current row in its middle, in one undo step."""
        from BendTorsionWB.objects.segment_edit import middle_of

        if not 0 <= self.table.currentRow() < len(self.rows):
            return
        row = self.rows[self.table.currentRow()]
        with errors_shown():
            place = middle_of(row.member, row.segment)
            with macro.undo_step(self.document, translate("BendTorsion", ADD)):
                macro.make("add_cut", row.member, place)
                macro.recompute()
        self.refresh()

    def remove(self) -> None:
        """Take the segments of the selected rows away, in one undo step; each member keeps one."""
        chosen = sorted({index.row() for index in self.table.selectedIndexes()}, reverse=True)
        chosen = [self.rows[r] for r in chosen if r < len(self.rows)]
        if not chosen:
            return
        with errors_shown(), macro.undo_step(self.document, translate("BendTorsion", REMOVE)):
            for row in chosen:
                macro.make("remove_segment", row.member, row.segment)
            macro.recompute()
        self.refresh()

    def forget(self) -> None:
        """Drop what was typed and cannot be; the cells show what is."""
        self.refused.clear()
        self.refresh()

    def refresh(self) -> None:
        """Show all members; the name of one in error is marked with the error. What was typed and
        cannot be stays in its cell until it is mended, or dropped by Esc."""
        columns = member_rows.COLUMNS
        self.said.setText("")
        self.rows = member_rows.rows_of(self.document)
        self.table.show_rows(
            [[row.text(column) for column in columns] for row in self.rows],
            {
                (r, c)
                for r, row in enumerate(self.rows)
                for c, column in enumerate(columns)
                if row.is_locked(column)
            },
        )
        for r, row in enumerate(self.rows):
            for obj in filter(None, (row.member, row.plates)):
                if error := finding_words.first_error(obj):
                    self.table.flag(r, 0, error)
        for (r, c), reason in member_rows.faults(self.rows).items():
            self.table.flag(r, c, reason)
        for (r, c), (text, reason) in self._refused_cells().items():
            self.table.blockSignals(True)
            self.table.item(r, c).setText(text)
            self.table.blockSignals(False)
            self.table.flag(r, c, reason)
        if not self.sized and self.rows:
            self.table.resizeColumnsToContents()
            self.sized = True
        # Columns grow with their texts; what the user made wider stays.
        for c in range(len(columns) - 1):
            wanted = self.table.sizeHintForColumn(c)
            if self.table.columnWidth(c) < wanted:
                self.table.setColumnWidth(c, wanted)

    def _key(self, row: int, column: int) -> tuple[str, int, str]:
        own = self.rows[row]
        return own.member.Name, own.segment, member_rows.COLUMNS[column]

    def _refused_cells(self) -> dict[tuple[int, int], tuple[str, str]]:
        """What is refused, by row and column; what is of another document is dropped."""
        cells = {
            (r, c): self.refused[self._key(r, c)]
            for r in range(len(self.rows))
            for c in range(len(member_rows.COLUMNS))
            if self._key(r, c) in self.refused and (r, c) not in self.table.locked
        }
        self.refused = {self._key(*at): told for at, told in cells.items()}
        return cells

    def _tell_left_out(self, cells) -> None:
        """Which texts were not taken and why: beside the table, and at their cells."""
        columns = [
            self.table.horizontalHeaderItem(c).text() for c in range(len(member_rows.COLUMNS))
        ]
        beyond = translate("BendTorsion", "the table ends before it")
        cell = translate("BendTorsion", "row {row} {column}")
        told: dict[str, list[str]] = {}
        for r, c in cells:
            inside = r < len(self.rows) and c < len(columns)
            reason = self.rows[r].lock_reason(member_rows.COLUMNS[c]) if inside else beyond
            name = columns[c] if c < len(columns) else str(c + 1)
            told.setdefault(reason, []).append(cell.format(row=r + 1, column=name))
            if inside:
                self.table.flag(r, c, reason)
        more = translate("BendTorsion", "and {count} more")
        lines = []
        for reason, named in told.items():
            shown = named[:MOST_TOLD]
            if len(named) > MOST_TOLD:
                shown.append(more.format(count=len(named) - MOST_TOLD))
            lines.append(f"{', '.join(shown)} ({reason})")
        self.said.setText(
            translate("BendTorsion", "Not taken: {cells}").format(cells="; ".join(lines))
        )

    def _reason(self, row: int, column: int, text: str) -> str:
        """Why a text cannot be in a cell; empty when it can."""
        _, reasons = member_rows.edits_of(self.rows, {(row, column): text})
        return reasons.get((row, column), "")

    def _choices(self, row: int, column: int) -> list[str]:
        return self.rows[row].choices(member_rows.COLUMNS[column])

    def _edit(self, cells) -> None:
        """Write what can be read, in one undo step; mark what cannot, with the reason."""
        edits, reasons = member_rows.edits_of(self.rows, cells)
        for at in cells:
            self.refused.pop(self._key(*at), None)
            if at in reasons:
                self.refused[self._key(*at)] = cells[at], reasons[at]
        if edits:
            with macro.undo_step(self.document, translate("BendTorsion", "Member table")):
                for obj, name, value in edits:
                    macro.put(obj, name, value)
                macro.recompute()
        self.refresh()
        self.timer.stop()
