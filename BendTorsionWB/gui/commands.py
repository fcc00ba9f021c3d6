# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the workbench: each reads the selection, asks, and calls `BendTorsionWB.make`."""

from __future__ import annotations

from contextlib import contextmanager

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui import resources, section_dialog, selection
from BendTorsionWB.gui.qt import QtWidgets

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

MEMBERS_FROM_SELECTION = "BendTorsion_MembersFromSelection"


class MembersFromSelection:
    """Members with plates from one selected face and the curves selected on it."""

    def GetResources(self):
        """Name, tooltip and icon, as FreeCAD asks for them."""
        return {
            "Pixmap": resources.icon(MEMBERS_FROM_SELECTION),
            "MenuText": QT_TRANSLATE_NOOP(MEMBERS_FROM_SELECTION, "Members from selection"),
            "ToolTip": QT_TRANSLATE_NOOP(
                MEMBERS_FROM_SELECTION,
                "Select one face and one or more curves on it: each curve becomes a box member"
                " that follows the face, cut into plates",
            ),
        }

    def IsActive(self):
        """Whenever a document is open; what is missing in the selection is said on use."""
        return FreeCAD.ActiveDocument is not None

    def Activated(self):
        """Read the selection, ask for the section, make the members in one undo step."""
        with errors_shown():
            picked = selection.face_and_curves(FreeCADGui.Selection.getSelectionEx())
            section = section_dialog.ask(FreeCADGui.getMainWindow())
            if section is not None:
                make_members(FreeCAD.ActiveDocument, picked, section)


def make_members(document, picked, section) -> list:
    """Members M1, M2, … (the next free numbers) with plates, one per curve; one undo step.

    picked: `selection.FaceAndCurves`. section: `section_dialog.SectionChoice`. Raises
    BendTorsionError, the document as before, when one of them cannot be built.
    """
    # Here, not above: the workbench opens at once, and scipy is loaded with the first members.
    from BendTorsionWB import make

    with undo_step(document, translate("BendTorsion", "Members from selection")):
        before = len(document.Objects)
        surface = make.make_surface(document, "Surface", face=picked.face)
        spec = make.make_section(
            document, "Section", type=section.type, h=section.h, b=section.b, t=section.t
        )
        members = []
        for mark, edge in zip(_free_marks(document, len(picked.edges)), picked.edges, strict=True):
            axis = make.make_axis(document, f"{mark}-axis", surface, edge=edge)
            member = make.make_member(document, mark, axis, sections=[spec])
            make.make_plates(document, member)
            # The plates show the same body; two skins in one place only flicker.
            member.ViewObject.Visibility = False
            members.append(member)
        document.recompute()
        _raise_errors(document.Objects[before:])
    return members


def _free_marks(document, count: int) -> list[str]:
    taken = {item.Label for item in document.Objects}
    candidates = (f"M{number}" for number in range(1, len(taken) + count + 1))
    return [mark for mark in candidates if mark not in taken][:count]


def _raise_errors(objects) -> None:
    from BendTorsionWB.objects.proxy import findings_of

    ours = (item for item in objects if hasattr(item, "BT_Type"))
    found = (finding for item in ours for finding in findings_of(item))
    # Objects downstream repeat the error of the one at fault.
    errors = tuple(dict.fromkeys(finding for finding in found if finding.severity == "error"))
    if errors:
        raise BendTorsionError(errors)


@contextmanager
def undo_step(document, name: str):
    """Everything inside is one undo step; an exception takes all of it back."""
    document.openTransaction(name)
    try:
        yield
    except BaseException:
        document.abortTransaction()
        raise
    document.commitTransaction()


@contextmanager
def errors_shown():
    """A BendTorsionError inside is shown in a message box and in the Report view, no traceback."""
    try:
        yield
    except BendTorsionError as problem:
        FreeCAD.Console.PrintError(f"{problem}\n")
        QtWidgets.QMessageBox.warning(FreeCADGui.getMainWindow(), "BendTorsion", str(problem))


def register() -> list[str]:
    """Add the commands to FreeCAD; their names in toolbar order."""
    FreeCADGui.addCommand(MEMBERS_FROM_SELECTION, MembersFromSelection())
    return [MEMBERS_FROM_SELECTION]
