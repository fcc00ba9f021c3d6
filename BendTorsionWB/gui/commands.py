# SPDX-License-Identifier: LGPL-2.1-or-later
"""All commands of the workbench, and where they stand in toolbars, menu and context menus."""

from __future__ import annotations

import FreeCADGui

from BendTorsionWB.gui import (
    BendTorsionWB,
    commands_files,
    commands_model,
    commands_output,
    commands_plates,
    commands_view,
    selection,
)
from BendTorsionWB.gui.command import PREFIX, Command

SEPARATOR = "Separator"
FAMILIES = (commands_model, commands_plates, commands_view, commands_output, commands_files)
TOOLBARS = {
    "BendTorsion Model": (
        *("ImportShapes", "MembersFromSelection", "Surface", "Axis", "Section", "Member"),
        *(SEPARATOR, "CutPoint", "Alignment", "MemberTable"),
    ),
    "BendTorsion Plates": (
        *("Plates", "Splits", "Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds", "Node"),
        *(SEPARATOR, "Development", "AssemblyBed"),
    ),
    "BendTorsion View": (
        *("FitMembers", "ShowAs", "ShowFrames", "ShowMarks", "ShowPoints", "ColourBy"),
    ),
    "BendTorsion Output": (
        *("Check", "Findings", "Sheets", "ExportPackage", "Report"),
        *(SEPARATOR, "ImportSchedule", "WriteSchedule", "Example"),
        *(SEPARATOR, "Repair", "SupportBundle", "Preferences"),
    ),
}
"""Names of the commands on each toolbar."""
MENUS = {
    "Model": TOOLBARS["BendTorsion Model"],
    "Plates": TOOLBARS["BendTorsion Plates"],
    "View": TOOLBARS["BendTorsion View"],
    "Output": TOOLBARS["BendTorsion Output"][:5],
    "Schedule": ("ImportSchedule", "WriteSchedule"),
}
"""Submenus of the workbench's menu."""
OTHERS = ("Example", "Repair", "SupportBundle", "Preferences")
"""What stands in the menu below them."""


EDITED_BY = {
    **{"Surface": "Surface", "Axis": "Axis", "SectionSpec": "Section", "Member": "Member"},
    **{"PlateSet": "Plates", "Node": "Node", "Unfold": "Development", "AssemblyBed": "AssemblyBed"},
    "SheetSet": "Sheets",
}
"""The command that edits a kind of object."""


def commands() -> dict[str, Command]:
    """Every command by its name."""
    return {command.name: command for family in FAMILIES for command in family.COMMANDS}


def register() -> None:
    """Add the commands to FreeCAD."""
    BendTorsionWB.add(commands().values())


def full_names(names) -> list[str]:
    """The names FreeCAD knows commands by; separators stay."""
    return [name if name == SEPARATOR else PREFIX + name for name in names]


def suited() -> list[str]:
    """Full names of the commands the context menu offers for what is selected, by kind and number;
    first those that edit it."""
    kinds, ours = set(), []
    for item in FreeCADGui.Selection.getSelectionEx():
        own = selection.own_of(item.Object)
        names = item.SubElementNames
        shape = getattr(item.Object, "Shape", None)
        if own is not None:
            kinds.add(own.BT_Type)
            ours.append(own)
        elif names:
            kinds.update(name.rstrip("0123456789") for name in names)
        elif shape is not None and not shape.isNull():
            kinds.add("Face" if shape.Faces else "Edge" if shape.Edges else "Vertex")
    given = selection.Picked(ours=tuple(dict.fromkeys(ours)))
    found = [c for c in commands().values() if kinds & set(c.suits) and c.fits(given)]
    found.sort(key=lambda command: command.name not in {EDITED_BY.get(kind) for kind in kinds})
    return [command.full_name for command in found]


def lay_out(workbench) -> None:
    """Put the commands on the workbench's toolbars and into its menu."""
    for name, names in TOOLBARS.items():
        workbench.appendToolbar(name, full_names(names))
    for name, names in MENUS.items():
        workbench.appendMenu(["&BendTorsion", name], full_names(names))
    workbench.appendMenu("&BendTorsion", full_names(OTHERS))
