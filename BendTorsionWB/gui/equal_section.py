# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section a document has already of what is asked for, so that none is made twice."""

from __future__ import annotations

import math


def section_of(document, kind: str, sizes: dict[str, float]):
    """The section of a type with these sizes and nothing else said, sizes as of `make_section`;
    None for none. One that follows a spreadsheet may become another."""
    # Here, not above: the workbench opens without loading Part.
    from BendTorsionWB.objects.section_spec import PROPERTY_OF_SIZE, SectionSpec

    said = {"Type": kind} | {PROPERTY_OF_SIZE[size]: value for size, value in sizes.items()}
    wanted = {
        item.name: said.get(item.name, item.default)
        for item in SectionSpec.PROPERTIES
        if not item.output
    }
    for obj in document.Objects:
        if getattr(obj, "BT_Type", "") == "SectionSpec" and not obj.ExpressionEngine:
            if all(_equal(getattr(obj, name), value) for name, value in wanted.items()):
                return obj
    return None


def _equal(value, wanted) -> bool:
    """Whether a property has a value; lists that are not given are empty."""
    value = getattr(value, "Value", value)
    if isinstance(wanted, float):
        return math.isclose(value, wanted, rel_tol=1e-9)
    return value == wanted or (wanted is None and not value)
