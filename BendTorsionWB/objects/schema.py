# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schemas of the saved properties, and the step from each to the next: a document opens with the
figures it was saved with.

Schema 1: sections have the sizes h, b, t, ... or, later, the names of today; members know no
thickness rules. Schema 2: sizes by name, thickness rules of the member, since the first release.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from BendTorsionWB.core.finding import BendTorsionError, error

SCHEMA_VERSION = 2

SIZES_OF_SCHEMA_1 = {
    "h": "Height",
    "b": "Breadth",
    "b_bottom": "BreadthBottom",
    "t": "Thickness",
    "t_top": "ThicknessTop",
    "t_bottom": "ThicknessBottom",
    "t_web": "ThicknessWeb",
    "gap1": "Gap1",
    "gap2": "Gap2",
    "E": "YoungsModulus",
    "fy": "YieldStrength",
    "J": "TorsionConstant",
}


@dataclass
class Changes:
    """What the steps found: values for the properties of today, and properties by other names."""

    values: dict[str, object] = field(default_factory=dict)
    renamed: dict[str, str] = field(default_factory=dict)


def _from_1(obj, changes: Changes) -> None:
    if obj.BT_Type == "SectionSpec":
        for old, new in SIZES_OF_SCHEMA_1.items():
            if old in obj.PropertiesList:
                changes.values[new] = getattr(obj, old)
                changes.renamed[old] = new
    elif obj.BT_Type == "Member" and "JointStagger" not in obj.PropertiesList:
        # Joints where the section changes, and no chamfers: as the plates were then.
        changes.values["ChamferSlope"] = 0.0
        for k in range(1, obj.Segments + 1):
            changes.values[f"Stagger{k}"] = "none"


STEPS = {1: _from_1}
"""By schema, the step to the next one."""


def changes_of(obj) -> Changes:
    """What has to change in a restored object, before what it lacks is added."""
    changes = Changes()
    for version in range(obj.SchemaVersion, SCHEMA_VERSION):
        STEPS[version](obj, changes)
    return changes


def apply(obj, changes: Changes) -> None:
    """Bring a restored object, complete by now, to the schema of today."""
    if obj.SchemaVersion >= SCHEMA_VERSION:
        return
    for name, value in changes.values.items():
        setattr(obj, name, value)
    for old, new in changes.renamed.items():
        _rename_in_expressions(obj, old, new)
        obj.removeProperty(old)
    obj.SchemaVersion = SCHEMA_VERSION


def check(obj) -> None:
    """Raises BendTorsionError for an object saved by a newer release: its properties may mean what
    this release does not know."""
    if obj.SchemaVersion > SCHEMA_VERSION:
        raise BendTorsionError(
            error(
                "schema-newer",
                obj.Label,
                "was saved by a newer BendTorsion",
                "open the document with that release or a later one, and do not save it here",
                value=obj.SchemaVersion,
                limit=SCHEMA_VERSION,
            )
        )


def _rename_in_expressions(obj, old: str, new: str) -> None:
    """Give a property's expression to its new name, and name it anew in those of all objects."""
    for path, expression in obj.ExpressionEngine:
        if path == old:
            obj.setExpression(old, None)
            obj.setExpression(new, expression)
    label = re.escape(f"<<{obj.Label}>>")
    named = re.compile(rf"(?<![\w.])({re.escape(obj.Name)}|{label})\.{re.escape(old)}\b(?!\()")
    for other in obj.Document.Objects:
        for path, expression in other.ExpressionEngine:
            changed = named.sub(rf"\1.{new}", expression)
            if changed != expression:
                other.setExpression(path, changed)
