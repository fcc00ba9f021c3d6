# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that cut members into plates, join them, lay them flat and put them together."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.gui import macro, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.preview import Preview

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
MEND = "select a member or its plates"


def plates(document) -> None:
    """The joints of the selected plates; plates of the selected members that have none."""
    from BendTorsionWB.gui.plates_panel import PlatesPanel

    given = selection.picked()
    name = translate("BendTorsion", "Plates")
    members = selection.of_member(given, "Member", MEND)
    bare = [item for item in members if not _users(item, "PlateSet")]
    if not bare:
        PlatesPanel(Preview(document, name, _users(members[0], "PlateSet")[:1])).show()
        return
    if len(bare) == 1:
        preview = Preview(
            document, name, create=lambda make: [make("make_plates", document, bare[0])]
        )
        bare[0].ViewObject.Visibility = False
        PlatesPanel(preview).show()
        return
    with macro.undo_step(document, name):
        made = [macro.make("make_plates", document, item) for item in bare]
        macro.recompute()
        macro.raise_errors(made)
    for item in bare:
        item.ViewObject.Visibility = False


def pieces(document) -> None:
    """The delivery pieces of the selected member."""
    _parts(document, "Pieces", translate("BendTorsion", "Delivery pieces"), "BendTorsion_Pieces")


def diaphragms(document) -> None:
    """The diaphragms and end plates of the selected member."""
    name = translate("BendTorsion", "Diaphragms and end plates")
    _parts(document, "Diaphragms", name, "BendTorsion_Diaphragms")


def _parts(document, table: str, name: str, icon: str) -> None:
    from BendTorsionWB.gui.plates_panel import PartsPanel

    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    PartsPanel(Preview(document, name, own[:1]), table, name, icon).show()


def splits(document) -> None:
    """The split editor of the selected plates."""
    from BendTorsionWB.gui.split_editor import SplitPanel

    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    SplitPanel(Preview(document, translate("BendTorsion", "Split editor"), own[:1])).show()


def development(document) -> None:
    """Flat patterns of the selected members' plates."""
    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    _once(document, own, "Unfold", "make_unfold", translate("BendTorsion", "Development"))


def assembly_bed(document) -> None:
    """Assembly beds of the selected members' pieces."""
    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    _once(document, own, "AssemblyBed", "make_bed", translate("BendTorsion", "Assembly bed"))


def _once(document, plates, kind: str, function: str, name: str) -> None:
    """Make what each PlateSet does not have yet, show it, in one undo step."""
    missing = [item for item in plates if not _users(item, kind)]
    if not missing:
        labels = ", ".join(item.Label for item in plates)
        raise selection.refusal(f"{labels} has it already", "edit it in the tree")
    with macro.undo_step(document, name):
        made = [macro.make(function, document, item) for item in missing]
        macro.recompute()
        macro.raise_errors(made)
    for item in made:
        item.ViewObject.Visibility = True


def _users(obj, kind: str) -> list:
    return [user for user in obj.InList if getattr(user, "BT_Type", "") == kind]


COMMANDS = (
    Command(
        "Plates",
        QT_TRANSLATE_NOOP("BendTorsion_Plates", "Plates"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Plates",
            "Cut the selected members into plates, or edit the joints of each face",
        ),
        "B, P",
        plates,
        ("Member", "PlateSet"),
    ),
    Command(
        "Pieces",
        QT_TRANSLATE_NOOP("BendTorsion_Pieces", "Delivery pieces"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Pieces", "Where the member is divided into pieces for transport and site"
        ),
        "B, I",
        pieces,
        ("Member", "PlateSet"),
    ),
    Command(
        "Diaphragms",
        QT_TRANSLATE_NOOP("BendTorsion_Diaphragms", "Diaphragms"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Diaphragms", "Diaphragms and end plates of the selected member"
        ),
        "B, D",
        diaphragms,
        ("Member", "PlateSet"),
    ),
    Command(
        "Splits",
        QT_TRANSLATE_NOOP("BendTorsion_Splits", "Split editor"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Splits",
            "Drag the joints of each face on a strip, held against the rules as you drag",
        ),
        "B, J",
        splits,
        ("Member", "PlateSet"),
    ),
    Command(
        "Development",
        QT_TRANSLATE_NOOP("BendTorsion_Development", "Development"),
        QT_TRANSLATE_NOOP("BendTorsion_Development", "Lay the plates of the selected members flat"),
        "B, V",
        development,
        ("Member", "PlateSet"),
    ),
    Command(
        "AssemblyBed",
        QT_TRANSLATE_NOOP("BendTorsion_AssemblyBed", "Assembly bed"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_AssemblyBed",
            "What the pieces of the selected members lie on while they are put together",
        ),
        "B, B",
        assembly_bed,
        ("Member", "PlateSet"),
    ),
)
