# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names a shop gives the layers of cut files, instead of those of the contract."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ..finding import BendTorsionError, error

LAYERS = (
    *("CUT_OUTER", "CUT_INNER", "MARK_LINE", "MARK_ROLL", "MARK_FOLD", "MARK_BEVEL"),
    *("MARK_TEXT", "PUNCH", "REF"),
)
"""The layers of a cut file, by the names of the contract."""
FORBIDDEN = '<>/\\":;?*|=`,'


def layer_names(lines: Iterable[str], object: str) -> dict[str, str]:
    """Contract name -> name as written, of lines such as `CUT_OUTER=10`; what is not renamed is
    left out. Raises BendTorsionError, naming the object, for layers that are not written, names
    that cannot be and names given twice."""
    names, findings = {}, []
    for line in lines:
        layer, _, name = (part.strip() for part in line.partition("="))
        if layer not in LAYERS:
            findings.append(
                _fault(object, line, f"layer {layer!r} is not written", f"use {', '.join(LAYERS)}")
            )
        elif not name or set(name) & set(FORBIDDEN):
            mend = f"use none of {' '.join(FORBIDDEN)}"
            findings.append(_fault(object, line, f"{name!r} cannot be a layer name", mend))
        elif name != layer:
            names[layer] = name
    written = [names.get(layer, layer).lower() for layer in LAYERS]
    if len(set(written)) < len(written):
        twice = next(name for name in written if written.count(name) > 1)
        findings.append(
            _fault(object, twice, "two layers have one name", "name each layer differently")
        )
    if findings:
        raise BendTorsionError(findings)
    return names


def lines_of(text: str) -> list[str]:
    """The lines of one text such as `CUT_OUTER=10 MARK_TEXT=T 5`: names may have blanks."""
    return [part for part in re.split(r"[\s;,]+(?=\w+\s*=)", text.strip()) if part]


def named_layers(text: str) -> dict[str, str]:
    """`layer_names` of one text."""
    return layer_names(lines_of(text), "")


def _fault(object: str, value: str, message: str, mend: str):
    return error("layer-name", object, message, mend, position="property LayerNames", value=value)
