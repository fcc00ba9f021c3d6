# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table of text cells edited as in a spreadsheet: copy, paste, fill down, clear, rows added."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets

translate = FreeCAD.Qt.translate
BAD = "#d9534f"


class RowTable(QtWidgets.QTableWidget):
    """Rows of text. `edited` is told the cells written, {(row, column): text}, once per action:
    typing, pasting, filling down or clearing. Cells given in `locked` cannot be written."""

    edited = QtCore.Signal(object)

    def __init__(self, headings, grows: bool = False):
        super().__init__(0, len(headings))
        self.setHorizontalHeaderLabels(list(headings))
        self.grows = grows
        self.locked: set[tuple[int, int]] = set()
        self.verticalHeader().setDefaultSectionSize(22)
        self.horizontalHeader().setStretchLastSection(True)
        self.cellChanged.connect(self._typed)

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

    def flag(self, row: int, column: int, reason: str) -> None:
        """Mark a cell as bad, with the reason as its tooltip."""
        self.blockSignals(True)
        item = self.item(row, column)
        item.setBackground(QtGui.QColor(BAD))
        item.setToolTip(reason)
        self.blockSignals(False)

    def keyPressEvent(self, event):
        """Copy, paste, fill down (Ctrl+D), clear."""
        if event.matches(QtGui.QKeySequence.Copy):
            self.copy()
        elif event.matches(QtGui.QKeySequence.Paste):
            self.paste()
        elif event.key() == QtCore.Qt.Key_D and event.modifiers() == QtCore.Qt.ControlModifier:
            self.fill_down()
        elif event.key() in (QtCore.Qt.Key_Delete, QtCore.Qt.Key_Backspace):
            self.write(dict.fromkeys(self._selected(), ""))
        else:
            super().keyPressEvent(event)

    def copy(self) -> None:
        """The selected block as tab-separated text."""
        cells = self._selected()
        rows, columns = sorted({r for r, _ in cells}), sorted({c for _, c in cells})
        lines = ["\t".join(self.item(r, c).text() for c in columns) for r in rows]
        QtWidgets.QApplication.clipboard().setText("\n".join(lines))

    def paste(self) -> None:
        """Tab-separated text from the first selected cell on; one value fills the selection."""
        text = QtWidgets.QApplication.clipboard().text().rstrip("\r\n")
        block = [line.split("\t") for line in text.splitlines()]
        selected = self._selected()
        if not block or not selected:
            return
        if len(block) == 1 and len(block[0]) == 1:
            self.write(dict.fromkeys(selected, block[0][0].strip()))
            return
        r0, c0 = selected[0]
        self.write(
            {
                (r0 + r, c0 + c): cell.strip()
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
        """Write texts into cells and tell; what lies outside or is locked is left out."""
        self.blockSignals(True)
        written = {}
        for (r, c), text in sorted(cells.items()):
            if c >= self.columnCount() or (r, c) in self.locked:
                continue
            while self.grows and r >= self.rowCount() - 1:
                self._add_row()
            if r < self.rowCount():
                self.item(r, c).setText(text)
                written[r, c] = text
        self.blockSignals(False)
        if written:
            self.edited.emit(written)

    def _add_row(self) -> None:
        row = self.rowCount()
        self.insertRow(row)
        for c in range(self.columnCount()):
            self.setItem(row, c, QtWidgets.QTableWidgetItem())

    def _typed(self, row: int, column: int) -> None:
        self.write({(row, column): self.item(row, column).text().strip()})

    def _selected(self) -> list[tuple[int, int]]:
        return sorted((index.row(), index.column()) for index in self.selectedIndexes())
