# SPDX-License-Identifier: LGPL-2.1-or-later
"""One command of the workbench: its name, words and shortcut, what it runs and when it can."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.gui import ask, finding_words, macro, resources
from BendTorsionWB.gui.progress import Cancelled

PREFIX = "BendTorsion_"


@dataclass(frozen=True)
class Command:
    """A command as FreeCAD asks for it.

    run: called with the active document, or None; raises BendTorsionError for what it cannot do.
    suits: BendTorsion kinds, or `Face`, `Edge`, `Vertex`, the context menu offers it for; fits:
    whether it does for as many of ours as are selected, given `selection.Picked` with those alone.
    """

    name: str
    text: str
    tooltip: str
    shortcut: str
    run: Callable
    suits: tuple[str, ...] = ()
    fits: Callable = lambda given: True
    needs_document: bool = True

    @property
    def full_name(self) -> str:
        """The name FreeCAD knows it by."""
        return PREFIX + self.name

    def GetResources(self):
        """Words, icon and shortcut; FreeCAD looks the words up in the translations by the name."""
        return {
            "Pixmap": resources.icon(self.full_name),
            "MenuText": self.text,
            "ToolTip": self.tooltip,
            "Accel": self.shortcut,
        }

    def IsActive(self):
        """Whenever its document is open and no task panel is; what is missing in the selection is
        said on use."""
        if FreeCADGui.Control.activeDialog():
            return False
        return not self.needs_document or FreeCAD.ActiveDocument is not None

    def Activated(self):
        """Run it; errors are shown as lines. A comment of its own stands in a macro, whatever it
        does: of a command without any line FreeCAD has the macro run the command itself."""
        macro.comment(self.text)
        with errors_shown():
            self.run(FreeCAD.ActiveDocument)


@contextmanager
def errors_shown():
    """A BendTorsionError inside is shown in a message box, no traceback; work the user stopped, or
    a file that cannot be written, likewise in a line. Not in the Report view, which would open
    and take the place of the 3D view."""
    try:
        yield
    except Cancelled:
        ask.tell(FreeCAD.Qt.translate("BendTorsion", "Stopped"))
    except OSError as problem:
        told = str(problem.strerror or problem)
        found = error("file", str(problem.filename or "file"), told)
        _show(finding_words.told(BendTorsionError(found)))
    except BendTorsionError as problem:
        _show(finding_words.told(problem))


def _show(text: str) -> None:
    FreeCAD.Console.PrintLog(f"{text}\n")
    ask.warn(text)
