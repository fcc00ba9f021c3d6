# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of all members in a dock: edited in bulk, each edit one undo step, shown at once."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import FreeCAD

from BendTorsionWB.gui import ask, finding_words, macro, member_rows
from BendTorsionWB.gui.command import errors_shown
from BendTorsionWB.gui.dock import DocumentDock, shown
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.row_table import RowTable
from BendTorsionWB.gui.scrolled_text import ScrolledText

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
NAME = "BendTorsion_MemberTable"
ADD = QT_TRANSLATE_NOOP("BendTorsion", "Divide the segment")
REMOVE = QT_TRANSLATE_NOOP("BendTorsion", "Remove the segment")
MOST_LINES = 5
"""Lines below the table seen at once; more are scrolled."""
MOST_TOLD = 6
"""Texts named in the status bar, which has one line."""
SECTION = member_rows.COLUMNS.index("section")
LEAST_WIDTH = 64
"""Pixels of a column without texts yet, to be typed into."""


def show(document) -> MemberTable:
    """Show the table."""
    return shown(MemberTable, NAME)


class MemberTable(DocumentDock):
    """A row per segment of each member; columns as in a schedule, sizes and lengths beside."""

    def __init__(self):
        self.table = RowTable(member_rows.COLUMNS)
        self.table.edited.connect(self._edit)
        self.table.left_out.connect(self._tell_left_out)
        self.table.judge = self._reason
        self.table.choices = self._choices
        self.table.choice_notes = self._choice_notes
        self.table.note_beside(SECTION)
        self.table.horizontalHeader().setStretchLastSection(False)
        self.table.horizontalHeader().setMinimumSectionSize(LEAST_WIDTH)
        self.table.setContextMenuPolicy(QtCore.Qt.ActionsContextMenu)
        self.named = []
        bar = QtWidgets.QHBoxLayout()
        for text, keys, run in ((ADD, "Ins", self.add_segment), (REMOVE, "Ctrl+Del", self.remove)):
            sequence = QtGui.QKeySequence(keys)
            self.table.keys.append((sequence, run))
            action = QtGui.QAction(self.table)
            action.triggered.connect(lambda _=False, run=run: run())
            self.table.addAction(action)
            button = QtWidgets.QPushButton()
            button.setObjectName(text)
            self.named += [(action, text), (button, text)]
            button.setToolTip(sequence.toString(QtGui.QKeySequence.NativeText))
            button.clicked.connect(lambda _=False, run=run: run())
            bar.addWidget(button)
        bar.addStretch()
        self.what = ScrolledText(MOST_LINES)
        self.said = self.what.label
        self.said.setObjectName("said")
        self.said.setTextFormat(QtCore.Qt.PlainText)
        self.said.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.none = QtWidgets.QLabel()
        self.none.setObjectName("none")
        self.none.setWordWrap(True)
        self.none.setAlignment(QtCore.Qt.AlignCenter)
        whole = QtWidgets.QWidget()
        lines = QtWidgets.QVBoxLayout(whole)
        lines.setContentsMargins(0, 0, 0, 0)
        lines.addWidget(self.table, 1)
        lines.addWidget(self.none, 1)
        lines.addWidget(self.what)
        lines.addLayout(bar)
        self.rows: list[member_rows.Row] = []
        # By document, member, segment and column: what was typed and cannot be, and why.
        self.refused: dict[tuple[str, str, int, str], tuple[str, str]] = {}
        self.table.keys.append((QtGui.QKeySequence("Esc"), self.forget))
        for keys, down in (("Return", 1), ("Enter", 1), ("Shift+Return", -1), ("Shift+Enter", -1)):
            self.table.keys.append((QtGui.QKeySequence(keys), partial(self.table.go, down)))
        self.sized = False
        super().__init__(NAME, "", whole)
        self.name()

    def name(self) -> None:
        """Title, headings and buttons."""
        self.setWindowTitle(translate("BendTorsion", "Member table"))
        headings = [translate("BendTorsion", name) for name in member_rows.COLUMNS]
        self.table.setHorizontalHeaderLabels(headings)
        length = self.table.horizontalHeaderItem(member_rows.COLUMNS.index(member_rows.LENGTH))
        length.setToolTip(member_rows.length_words())
        for item, text in self.named:
            item.setText(translate("BendTorsion", text))

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

    def hideEvent(self, event):
        """What cannot be is there again when the table is opened again; the status bar says so."""
        super().hideEvent(event)
        # A cell that was typed into is judged when the keyboard leaves it.
        QtCore.QTimer.singleShot(0, self._tell_kept)

    def _tell_kept(self) -> None:
        if self.isVisible() or not self.refused:
            return
        words = translate("BendTorsion", "Kept in the member table, not taken: {texts}")
        ask.tell(words.format(texts=_texts(text for text, _ in self.refused.values())))

    def forget(self) -> None:
        """Drop what was typed into the current cell, and those selected with it, and cannot be; the
        status bar says what it was. Other cells keep theirs."""
        cells = {(index.row(), index.column()) for index in self.table.selectedIndexes()}
        cells.add((self.table.currentRow(), self.table.currentColumn()))
        keys = [self._key(*at) for at in sorted(cells & self._refused_cells().keys())]
        if keys:
            words = translate("BendTorsion", "Dropped: {texts}")
            ask.tell(words.format(texts=_texts(self.refused.pop(key)[0] for key in keys)))
        self.refresh()

    def forget_document(self, name: str) -> None:
        """What was typed and cannot be goes with its document."""
        self.refused = {key: told for key, told in self.refused.items() if key[0] != name}

    def refresh(self) -> None:
        """Show all members; the name of one in error is marked with the error. What was typed and
        cannot be stays in its cell until it is mended, or dropped by Esc."""
        columns = member_rows.COLUMNS
        self.rows = member_rows.rows_of(self.document)
        self._say_none()
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
            self.table.note(r, SECTION, row.note("section"))
            for obj in filter(None, (row.member, row.plates)):
                if error := finding_words.first_error(obj):
                    self.table.flag(r, 0, error)
        faults = member_rows.faults(self.rows)
        for (r, c), reason in faults.items():
            self.table.flag(r, c, reason)
        refused = self._refused_cells()
        for (r, c), (text, reason) in refused.items():
            self.table.blockSignals(True)
            self.table.item(r, c).setText(text)
            self.table.blockSignals(False)
            self.table.note(r, c, "")
            self.table.flag(r, c, reason)
        self._tell({at: reason for at, (_, reason) in refused.items()}, faults)
        if not self.sized and self.rows:
            self.table.resizeColumnsToContents()
            self.sized = True
        # Columns grow with their texts; what the user made wider stays.
        for c in range(len(columns) - 1):
            wanted = self.table.sizeHintForColumn(c)
            if self.table.columnWidth(c) < wanted:
                self.table.setColumnWidth(c, wanted)

    def _say_none(self) -> None:
        """In the place of a table without rows, what makes some."""
        self.table.setVisible(bool(self.rows))
        self.none.setVisible(not self.rows)
        words = translate("BendTorsion", "No members yet: {select} makes them, {read} reads them")
        names = {
            "select": translate("BendTorsion_MembersFromSelection", "Members from selection"),
            "read": translate("BendTorsion_ImportSchedule", "Import schedule"),
        }
        self.none.setText(words.format(**names))

    def _key(self, row: int, column: int) -> tuple[str, str, int, str]:
        own = self.rows[row]
        name = own.member.Document.Name
        return name, own.member.Name, own.segment, member_rows.COLUMNS[column]

    def _refused_cells(self) -> dict[tuple[int, int], tuple[str, str]]:
        """What is refused, by row and column; what is of members or documents gone is dropped."""
        cells = {
            (r, c): self.refused[self._key(r, c)]
            for r in range(len(self.rows))
            for c in range(len(member_rows.COLUMNS))
            if self._key(r, c) in self.refused and (r, c) not in self.table.locked
        }
        here = self.document.Name if self.document is not None else ""
        others = FreeCAD.listDocuments().keys() - {here}
        self.refused = {
            **{key: told for key, told in self.refused.items() if key[0] in others},
            **{self._key(*at): told for at, told in cells.items()},
        }
        return cells

    def _tell_left_out(self, cells) -> None:
        """Say which texts have no place, beside those that cannot be, and mark their cells."""
        beyond = translate("BendTorsion", "the table ends before it")
        reasons = {at: reason for at, (_, reason) in self._refused_cells().items()}
        for r, c in cells:
            inside = r < len(self.rows) and c < len(member_rows.COLUMNS)
            reasons[r, c] = self.rows[r].lock_reason(member_rows.COLUMNS[c]) if inside else beyond
            if inside:
                self.table.flag(r, c, reasons[r, c])
        self._tell(reasons, member_rows.faults(self.rows))

    def _tell(self, refused, faults) -> None:
        """Say below the table which texts were not taken, and which are in error, and why."""
        lines = [
            words.format(cells=cells)
            for words, reasons in (
                (translate("BendTorsion", "Not taken: {cells}"), refused),
                (translate("BendTorsion", "In error: {cells}"), faults),
            )
            for cells in self._named(reasons)
        ]
        self.said.setText("\n".join(lines))
        self.what.setVisible(bool(lines))
        self.what.fit()

    def _named(self, reasons) -> list[str]:
        """Cells by row and heading, a line for those of each reason; rows that follow each other in
        a column as one."""
        columns = [
            self.table.horizontalHeaderItem(c).text() for c in range(len(member_rows.COLUMNS))
        ]
        one = translate("BendTorsion", "row {row} {column}")
        several = translate("BendTorsion", "rows {first} to {last} {column}")
        told: dict[str, dict[int, list[int]]] = {}
        for (r, c), reason in sorted(reasons.items()):
            told.setdefault(reason, {}).setdefault(c, []).append(r + 1)
        lines = []
        for reason, own in told.items():
            named = []
            for c, rows in own.items():
                column = columns[c] if c < len(columns) else str(c + 1)
                for first, last in _runs(rows):
                    words = one if first == last else several
                    named.append(words.format(row=first, first=first, last=last, column=column))
            lines.append(f"{', '.join(named)} ({reason})")
        return lines

    def _reason(self, row: int, column: int, text: str) -> str:
        """Why a text cannot be in a cell; empty when it can."""
        _, reasons = member_rows.edits_of(self.rows, {(row, column): text})
        return reasons.get((row, column), "")

    def _choices(self, row: int, column: int) -> list[str]:
        return self.rows[row].choices(member_rows.COLUMNS[column])

    def _choice_notes(self, row: int, column: int) -> list[str]:
        return self.rows[row].choice_notes(member_rows.COLUMNS[column])

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


def _texts(texts) -> str:
    """Texts as they were typed, for one line; of too many how many more there are."""
    told = [repr(text) for text in texts]
    if len(told) > MOST_TOLD:
        more = translate("BendTorsion", "and {count} more").format(count=len(told) - MOST_TOLD)
        told[MOST_TOLD:] = [more]
    return ", ".join(told)


def _runs(rows: Sequence[int]) -> list[tuple[int, int]]:
    """Rising numbers as (first, last) of those that follow each other."""
    runs: list[tuple[int, int]] = []
    for row in rows:
        if runs and row == runs[-1][1] + 1:
            runs[-1] = (runs[-1][0], row)
        else:
            runs.append((row, row))
    return runs
