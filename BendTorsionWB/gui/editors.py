# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel that edits an object, by its kind: what a double click in the tree opens."""

from __future__ import annotations

from collections.abc import Callable

import FreeCAD

translate = FreeCAD.Qt.translate


def _surface(obj):
    from BendTorsionWB.gui.panels_model import SurfacePanel

    return SurfacePanel(_preview(obj, translate("BendTorsion", "Edit surface")))


def _axis(obj):
    from BendTorsionWB.gui.panels_model import AxisPanel

    return AxisPanel(_preview(obj, translate("BendTorsion", "Edit axis")))


def _section(obj):
    from BendTorsionWB.gui.panels_model import SectionPanel

    return SectionPanel(_preview(obj, translate("BendTorsion", "Edit section")))


def _member(obj):
    from BendTorsionWB.gui.member_panel import MemberPanel

    return MemberPanel(_preview(obj, translate("BendTorsion", "Edit member")))


def _plates(obj):
    from BendTorsionWB.gui.plates_panel import PlatesPanel

    return PlatesPanel(_preview(obj, translate("BendTorsion", "Edit plates")))


def _development(obj):
    from BendTorsionWB.gui.panels_detail import DevelopmentPanel

    return DevelopmentPanel(_preview(obj, translate("BendTorsion", "Edit development")))


def _bed(obj):
    from BendTorsionWB.gui.panels_detail import BedPanel

    return BedPanel(_preview(obj, translate("BendTorsion", "Edit assembly bed")))


def _node(obj):
    from BendTorsionWB.gui.panels_detail import NodePanel

    return NodePanel(_preview(obj, translate("BendTorsion", "Edit node")))


def _sheets(obj):
    from BendTorsionWB.gui.panels_detail import SheetsPanel

    return SheetsPanel(_preview(obj, translate("BendTorsion", "Edit sheets")))


def _preview(obj, name: str):
    from BendTorsionWB.gui.preview import Preview

    return Preview(obj.Document, name, [obj])


PANELS: dict[str, Callable] = {
    "Surface": _surface,
    "Axis": _axis,
    "SectionSpec": _section,
    "Member": _member,
    "PlateSet": _plates,
    "Unfold": _development,
    "AssemblyBed": _bed,
    "Node": _node,
    "SheetSet": _sheets,
}
"""By BT_Type: a function of the object that makes its task panel; the panel has `show()`,
`reject()` and takes everything back on Cancel."""


def edit_panel(obj):
    """A new task panel for an object, not yet shown; None when its kind has none."""
    make = PANELS.get(getattr(obj, "BT_Type", ""))
    return make(obj) if make is not None else None
