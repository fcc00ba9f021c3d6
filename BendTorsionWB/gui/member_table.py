# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of all members in a dock: edited in bulk, each edit one undo step, shown at once."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui import macro, member_rows
from BendTorsionWB.gui.dock import DocumentDock, shown
from BendTorsionWB.gui.row_table import RowTable

translate = FreeCAD.Qt.translate
NAME = "BendTorsion_MemberTable"


def show(document) -> MemberTable:
    """Show the table."""
    return shown(MemberTable, NAME)


class MemberTable(DocumentDock):
    """A row per segment of each member; columns as in a schedule."""

    def __init__(self):
        headings = [translate("BendTorsion", name) for name in member_rows.COLUMNS]
        self.table = RowTable(headings)
        self.table.edited.connect(self._edit)
        self.table.judge = self._reason
        self.table.choices = self._choices
        self.rows: list[member_rows.Row] = []
        self.sized = False
        super().__init__(NAME, translate("BendTorsion", "Member table"), self.table)

    def refresh(self) -> None:
        """Show all members; the name of one in error is marked with the error."""
        columns = member_rows.COLUMNS
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
                if obj.Status not in ("", "ok"):
                    self.table.flag(r, 0, obj.Status)
        for (r, c), reason in member_rows.faults(self.rows).items():
            self.table.flag(r, c, reason)
        if not self.sized and self.rows:
            self.table.resizeColumnsToContents()
            self.sized = True

    def _reason(self, row: int, column: int, text: str) -> str:
        """Why a text cannot be in a cell; empty when it can."""
        _, reasons = member_rows.edits_of(self.rows, {(row, column): text})
        return reasons.get((row, column), "")

    def _choices(self, row: int, column: int) -> list[str]:
        return self.rows[row].choices(member_rows.COLUMNS[column])

    def _edit(self, cells) -> None:
        """Write what can be read, in one undo step; mark what cannot, with the reason."""
        edits, reasons = member_rows.edits_of(self.rows, cells)
        if edits:
            with macro.undo_step(self.document, translate("BendTorsion", "Member table")):
                for obj, name, value in edits:
                    macro.put(obj, name, value)
                macro.recompute()
        self.refresh()
        for (r, c), reason in reasons.items():
            self.table.blockSignals(True)
            self.table.item(r, c).setText(cells[r, c])
            self.table.blockSignals(False)
            self.table.flag(r, c, reason)
        self.timer.stop()
