# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table of text cells edited as in a spreadsheet: copy, paste, fill down, clear, rows added."""

from __future__ import annotations

import csv
from collections.abc import Callable

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets

translate = FreeCAD.Qt.translate
BAD = "#d9534f"
NOTE, CHOICE = QtCore.Qt.UserRole, QtCore.Qt.UserRole + 1
"""Where a cell keeps what is told beside its text; where a line of a list has what is typed."""
ENTER = (QtCore.Qt.Key_Return, QtCore.Qt.Key_Enter)


def typed(event) -> bool:
    """Whether a key event writes a character."""
    commands = QtCore.Qt.ControlModifier | QtCore.Qt.AltModifier | QtCore.Qt.MetaModifier
    return event.text().isprintable() and bool(event.text()) and not event.modifiers() & commands


class RowTable(QtWidgets.QTableWidget):
    """Rows of text. `edited` is told the cells written, {(row, column): text}, once per action:
    typing, pasting, filling down or clearing. Cells given in `locked` cannot be written; texts for
    them, and for cells beyond the table, go to `left_out` likewise.

    judge: (row, column, text) -> why a text cannot be, told while it is typed. choices: (row,
    column) -> the texts that can be, offered while one is typed; choice_notes: likewise, what is
    told beside each. keys: what keys do in the table,
    kept from FreeCAD's shortcuts: Del would delete what is selected in the tree. Enter takes what
    is typed and goes down, with Shift up.
    """

    edited = QtCore.Signal(object)
    left_out = QtCore.Signal(object)

    def __init__(self, headings, grows: bool = False):
        super().__init__(0, len(headings))
        self.setHorizontalHeaderLabels(list(headings))
        self.grows = grows
        self.locked: set[tuple[int, int]] = set()
        self.verticalHeader().setDefaultSectionSize(22)
        self.horizontalHeader().setStretchLastSection(True)
        self.cellChanged.connect(self._typed)
        self.judge: Callable[[int, int, str], str] = lambda row, column, text: ""
        self.choices: Callable[[int, int], list[str]] = lambda row, column: []
        self.choice_notes: Callable[[int, int], list[str]] = lambda row, column: []
        self.setItemDelegate(_Cell(self))
        self.keys: list[tuple[QtGui.QKeySequence, Callable[[], None]]] = [
            *((key, self.copy) for key in QtGui.QKeySequence.keyBindings(QtGui.QKeySequence.Copy)),
            *(
                (key, self.paste)
                for key in QtGui.QKeySequence.keyBindings(QtGui.QKeySequence.Paste)
            ),
            (QtGui.QKeySequence("Ctrl+D"), self.fill_down),
            (QtGui.QKeySequence("Del"), self.clear_cells),
            (QtGui.QKeySequence("Backspace"), self.clear_cells),
        ]

    def show_rows(self, rows, locked=()) -> None:
        """Show rows of text, with an empty one at the end when the table grows."""
        self.blockSignals(True)
        self.locked = set(locked)
        rows = [list(row) for row in rows]
        if self.grows:
            rows.append([""] * self.columnCount())
        self.setRowCount(len(rows))
        for r, row in enumerate(rows):
            for c, text in enumerate(row):
                item = self.item(r, c)
                if item is None:
                    item = QtWidgets.QTableWidgetItem()
                    self.setItem(r, c, item)
                if item.text() != text:
                    item.setText(text)
                item.setToolTip("")
                item.setData(QtCore.Qt.BackgroundRole, None)
                flags = item.flags() | QtCore.Qt.ItemIsEditable
                if (r, c) in self.locked:
                    flags &= ~QtCore.Qt.ItemIsEditable
                item.setFlags(flags)
        self.blockSignals(False)

    def texts(self) -> list[list[str]]:
        """All rows with any text."""
        rows = [
            [self.item(r, c).text().strip() for c in range(self.columnCount())]
            for r in range(self.rowCount())
        ]
        return [row for row in rows if any(row)]

    def note_beside(self, column: int) -> None:
        """Let the cells of a column tell what `note` is given beside their text."""
        self.setItemDelegateForColumn(column, _NotedCell(self))

    def note(self, row: int, column: int, note: str) -> None:
        """Tell something beside the text of a cell that is no part of it: not copied, not typed."""
        self.blockSignals(True)
        self.item(row, column).setData(NOTE, note)
        self.blockSignals(False)

    def flag(self, row: int, column: int, reason: str) -> None:
        """Mark a cell as bad, with the reason as its tooltip."""
        self.blockSignals(True)
        item = self.item(row, column)
        item.setBackground(QtGui.QColor(BAD))
        item.setToolTip(reason)
        self.blockSignals(False)

    def event(self, event):
        """Keep the keys of the table from FreeCAD's shortcuts, and what is typed over a cell: its
        first letters would be a command, as B, O."""
        if not isinstance(event, QtCore.QEvent):
            # PySide knows events by their address, and gives what lived there before.
            return False
        if event.type() == QtCore.QEvent.ShortcutOverride and (
            self._meant(event) is not None or typed(event)
        ):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event):
        """Copy, paste, fill down, clear, and what else is among the keys."""
        action = self._meant(event)
        if action is None:
            super().keyPressEvent(event)
        else:
            action()
            event.accept()

    def _meant(self, event) -> Callable[[], None] | None:
        modifiers = event.modifiers() & ~QtCore.Qt.KeypadModifier
        # Flags of PySide2 are numbers, those of PySide6 have one.
        held = int(getattr(modifiers, "value", modifiers))
        pressed = QtGui.QKeySequence(held | int(event.key()))
        return next((action for key, action in self.keys if key == pressed), None)

    def go(self, down: int) -> None:
        """To the cell so many rows below; stays where there is none."""
        row, column = self.currentRow() + down, self.currentColumn()
        if 0 <= row < self.rowCount():
            self.setCurrentCell(row, column)

    def clear_cells(self) -> None:
        """Empty the selected cells."""
        self.write(dict.fromkeys(self._selected(), ""))

    def copy(self) -> None:
        """The selected block as tab-separated text; cells that are not selected are empty."""
        cells = self._selected()
        rows, columns = sorted({r for r, _ in cells}), sorted({c for _, c in cells})
        lines = [
            "\t".join(self.item(r, c).text() if (r, c) in cells else "" for c in columns)
            for r in rows
        ]
        QtWidgets.QApplication.clipboard().setText("\n".join(lines))

    def paste(self) -> None:
        """Tab-separated text, as spreadsheets copy it, from the first selected cell on; repeated
        when the selection is a multiple of it."""
        block = block_of(QtWidgets.QApplication.clipboard().text())
        selected = self._selected()
        if not block or not selected:
            return
        r0, c0 = selected[0][0], min(c for _, c in selected)
        rows = len({r for r, _ in selected})
        columns = len({c for _, c in selected})
        wide = max(map(len, block))
        down = rows // len(block) if rows % len(block) == 0 else 1
        across = columns // wide if columns % wide == 0 else 1
        if len(block) == wide == 1:
            self.write(dict.fromkeys(selected, block[0][0]))
            return
        self.write(
            {
                (r0 + i * len(block) + r, c0 + j * wide + c): cell
                for i in range(max(down, 1))
                for j in range(max(across, 1))
                for r, line in enumerate(block)
                for c, cell in enumerate(line)
            }
        )

    def fill_down(self) -> None:
        """Give every selected cell the text of the top one of its column."""
        tops: dict[int, str] = {}
        cells = self._selected()
        for r, c in cells:
            tops.setdefault(c, self.item(r, c).text())
        self.write({(r, c): tops[c] for r, c in cells})

    def write(self, cells) -> None:
        """Write texts into cells and tell; what lies outside or is locked is told as left out,
        unless it says what is there."""
        self.blockSignals(True)
        written, left_out = {}, {}
        for (r, c), text in sorted(cells.items()):
            while self.grows and c < self.columnCount() and r >= self.rowCount() - 1:
                self._add_row()
            item = self.item(r, c)
            if item is None or (r, c) in self.locked:
                if text and (item is None or item.text() != text):
                    left_out[r, c] = text
                continue
            item.setText(text)
            written[r, c] = text
        self.blockSignals(False)
        if written:
            self.edited.emit(written)
        if left_out:
            self.left_out.emit(left_out)

    def _add_row(self) -> None:
        row = self.rowCount()
        self.insertRow(row)
        for c in range(self.columnCount()):
            self.setItem(row, c, QtWidgets.QTableWidgetItem())

    def _typed(self, row: int, column: int) -> None:
        self.write({(row, column): self.item(row, column).text().strip()})

    def _selected(self) -> list[tuple[int, int]]:
        return sorted((index.row(), index.column()) for index in self.selectedIndexes())


def block_of(text: str) -> list[list[str]]:
    """The cells of text from a spreadsheet's clipboard; LibreOffice and Excel quote those that hold
    a tab, a line break or a quote."""
    lines = text.rstrip("\r\n").splitlines(keepends=True)
    return [[cell.strip() for cell in line] for line in csv.reader(lines, "excel-tab") if line]


class _Cell(QtWidgets.QStyledItemDelegate):
    """The editor of a cell: tells what cannot be while it is typed, offers what can."""

    def __init__(self, table: RowTable):
        super().__init__(table)
        self.table = table

    def createEditor(self, parent, option, index):
        """Called by Qt when a cell is to be edited."""
        editor = QtWidgets.QLineEdit(parent)
        choices = self.table.choices(index.row(), index.column())
        if choices:
            completer = QtWidgets.QCompleter(editor)
            notes = self.table.choice_notes(index.row(), index.column()) or [""] * len(choices)
            lines = [_beside(*pair) for pair in zip(choices, notes, strict=True)]
            model = QtGui.QStandardItemModel(completer)
            for choice, line in zip(choices, lines, strict=True):
                item = QtGui.QStandardItem(line)
                item.setData(choice, CHOICE)
                model.appendRow(item)
            completer.setModel(model)
            completer.setCompletionRole(CHOICE)
            completer.setCompletionMode(QtWidgets.QCompleter.UnfilteredPopupCompletion)
            completer.setCaseSensitivity(QtCore.Qt.CaseInsensitive)
            popup = completer.popup()
            widest = max(map(popup.fontMetrics().horizontalAdvance, lines))
            popup.setMinimumWidth(widest + 3 * popup.fontMetrics().height())
            editor.setCompleter(completer)
            # While its list is open, Enter comes from there.
            editor.returnPressed.connect(lambda: self._leave(editor))
        at = (index.row(), index.column())
        editor.textChanged.connect(lambda text: self._judge(editor, at, text))
        return editor

    def eventFilter(self, editor, event):
        """Called by Qt before the editor has the event: Enter ends the editing and goes on."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent):
            return False
        if event.type() == QtCore.QEvent.KeyPress and event.key() in ENTER:
            self._leave(editor)
            return True
        return super().eventFilter(editor, event)

    def _leave(self, editor) -> None:
        up = QtWidgets.QApplication.keyboardModifiers() & QtCore.Qt.ShiftModifier
        if editor.completer() is not None:
            # Keys that come while the text is taken would be the list's.
            editor.completer().popup().hide()
        self.commitData.emit(editor)
        self.closeEditor.emit(editor, QtWidgets.QAbstractItemDelegate.NoHint)
        self.table.go(-1 if up else 1)

    def _judge(self, editor, at, text: str) -> None:
        reason = self.table.judge(*at, text)
        editor.setStyleSheet(f"background: {BAD}; color: white;" if reason else "")
        editor.setToolTip(reason)
        if reason and editor.isVisible():
            # Above the cell: below it is the list of what can be.
            place = editor.mapToGlobal(QtCore.QPoint(0, -3 * editor.height()))
            QtWidgets.QToolTip.showText(place, reason, editor)
        else:
            QtWidgets.QToolTip.hideText()


class _NotedCell(_Cell):
    """A cell that tells something beside its text."""

    def initStyleOption(self, option, index):
        """Called by Qt before a cell is drawn or measured."""
        super().initStyleOption(option, index)
        option.text = _beside(option.text, index.data(NOTE))


def _beside(text: str, note: str | None) -> str:
    return f"{text}   ({note})" if note else text
