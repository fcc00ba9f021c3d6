# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties as the window calls them: by the label in their panel, else as the property editor has
them."""

from __future__ import annotations

import re

import FreeCAD

translate = FreeCAD.Qt.translate


def label_of(kind: str, name: str) -> str:
    """The words for a property of a kind of object (BT_Type)."""
    # Here, not above: panels load what computes.
    from BendTorsionWB.gui import panels_detail, panels_model

    rows = {
        "Surface": panels_model.SURFACE_ROWS,
        "Axis": panels_model.AXIS_ROWS,
        "SectionSpec": panels_model.SECTION_ROWS,
        "Unfold": panels_detail.PATTERN_ROWS + panels_detail.ALLOWANCE_ROWS,
        "AssemblyBed": panels_detail.BED_ROWS,
        "Node": panels_detail.NODE_ROWS,
        "SheetSet": panels_detail.SHEET_ROWS,
    }
    label = dict(rows.get(kind, ())).get(name)
    if label is not None:
        return translate("BendTorsion", label)
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name)
