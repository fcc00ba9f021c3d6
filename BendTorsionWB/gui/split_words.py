# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the split editor says of a joint: its rules, and why it cannot be at a place."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core.joints.joint_margins import Margin
from BendTorsionWB.gui.split_scene import BROKEN, KEPT

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
RULE_WORDS = {
    "shortest_piece": QT_TRANSLATE_NOOP("BendTorsion", "shorter plate beside it"),
    "longest_piece": QT_TRANSLATE_NOOP("BendTorsion", "longer plate beside it"),
    "stagger": QT_TRANSLATE_NOOP("BendTorsion", "joint of the next face"),
    "fold_clearance": QT_TRANSLATE_NOOP("BendTorsion", "nearest fold"),
    "diaphragm_clearance": QT_TRANSLATE_NOOP("BendTorsion", "nearest diaphragm"),
    "node_clearance": QT_TRANSLATE_NOOP("BendTorsion", "nearest node"),
    "piece_end_clearance": QT_TRANSLATE_NOOP("BendTorsion", "nearest end of a piece"),
}


def beyond(s: float, least: float, most: float, length: float) -> str:
    """Why a joint cannot be at s: neighbours leave it from least to most, of a member of a length,
    mm."""
    if 0.0 <= s <= length:
        words = translate(
            "BendTorsion",
            "{place:.0f} mm is not between its neighbours: {least:.0f} to {most:.0f} mm",
        )
    else:
        words = translate(
            "BendTorsion",
            "{place:.0f} mm is beyond the member of {length:.0f} mm; between its neighbours:"
            " {least:.0f} to {most:.0f} mm",
        )
    return words.format(place=s, length=length, least=least, most=most)


def too_long(face: str, length: float, limit: float) -> str:
    """That a face without a joint has a plate longer than the rules allow, mm."""
    words = translate("BendTorsion", "{face}: a plate of {length:.0f} mm, at most {limit:.0f}")
    return words.format(face=translate("BendTorsion", face), length=length, limit=limit)


def margin_line(margin: Margin) -> str:
    """A rule as a line, red or green, with its figure and its limit."""
    colour = KEPT if margin.kept else BROKEN
    words = translate("BendTorsion", RULE_WORDS[margin.rule])
    about = f" ({translate('BendTorsion', margin.about)})" if margin.about else ""
    limit = (
        translate("BendTorsion", "at most {limit:.0f}")
        if margin.rule == "longest_piece"
        else translate("BendTorsion", "at least {limit:.0f}")
    ).format(limit=margin.limit)
    dot = f'<span style="color:{colour}">&#9679;</span>'
    return f'{dot} {words}{about}: <b style="color:{colour}">{margin.figure:.0f} mm</b>, {limit}'
