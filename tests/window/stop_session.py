# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: Sheets stopped by a real click on Cancel, at the last member."""

import os
import sys
import time
from types import SimpleNamespace

from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import keys
import steps
from commands_aids import long_members
from hands import named, run, select


class Bar(QtGui.QProgressDialog):
    """The dialog of a command, with what it says, processor seconds from one saying to the next,
    and a real click on its Cancel when it says `WORDS` for the `TIMES`-th time."""

    WORDS, TIMES = "", 1
    shown = None

    def __init__(self, parent):
        super().__init__(parent)
        self.said, self.gaps, self.last, self.clicked_at = [], [], None, ""
        self.times = 0
        Bar.shown = self

    def setLabelText(self, text):
        """Called by the command."""
        super().setLabelText(text)
        now = time.process_time()
        # Of work that is quick the first words are said before the dialog is shown.
        self.times += text == self.WORDS
        if self.isVisible():
            self.said.append(text)
            self.gaps.append(now - (now if self.last is None else self.last))
        self.last = now
        if (
            not self.clicked_at
            and self.isVisible()
            and text == self.WORDS
            and self.times == self.TIMES
        ):
            self.clicked_at = text
            button = self.findChild(QtGui.QPushButton)
            at = button.mapToGlobal(button.rect().center()) * button.devicePixelRatioF()
            keys.begin_beside(0.1, f"@{at.x()},{at.y()}").wait()


def state(document):
    """What stopped work leaves alone."""
    return [
        sorted(o.Label for o in document.Objects),
        sorted(o.Label for o in document.Objects if "Touched" in o.State),
        document.UndoNames,
        document.HasPendingTransaction,
    ]


def sheets():
    """Stopped while the pages of the last member are made, and once they are all there."""
    from BendTorsionWB import make
    from BendTorsionWB.gui import ask, commands_plates, progress

    document, seen = long_members("Sheets", 2), {}
    for name in ("M1 plates", "M2 plates"):
        make.make_unfold(document, named(name))
    document.recompute()
    document.clearUndos()
    before = state(document)
    told = []
    tell, ask.tell = ask.tell, told.append
    # What is laid out already is made before a dialog is shown to those who wait.
    patience, commands_plates.PATIENCE = commands_plates.PATIENCE, 0.0
    progress.QtWidgets = SimpleNamespace(
        QProgressDialog=Bar,
        QApplication=QtGui.QApplication,
        QPushButton=QtGui.QPushButton,
        former=progress.QtWidgets,
    )
    try:
        for when, times in (("made", 1), ("drawn", 2)):
            Bar.WORDS, Bar.TIMES = "Sheets: M2 sheets 5", times
            select()
            said = run("Sheets")
            steps.settle(10)
            seen[when] = {
                "shown": said,
                "told": told[:],
                "clicked": Bar.shown.clicked_at,
                "pages": len({one for one in Bar.shown.said if "sheets " in one}),
                "gap": max(Bar.shown.gaps),
                "same": [one == other for one, other in zip(state(document), before, strict=True)],
            }
            told.clear()
            while document.UndoNames:
                document.undo()
            document.recompute()
    finally:
        ask.tell, commands_plates.PATIENCE = tell, patience
        progress.QtWidgets = progress.QtWidgets.former
    seen["before"] = before
    return seen


steps.run(sheets)
