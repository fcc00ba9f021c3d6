# SPDX-License-Identifier: LGPL-2.1-or-later
"""Says in a box what written files do not hold, and why."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import FreeCAD

from BendTorsionWB.core.finding import Finding
from BendTorsionWB.gui import ask, finding_words

translate = FreeCAD.Qt.translate
MOST_TOLD = 8
"""Lines under one heading; a box that grows beyond the screen has no button to close it."""


def tell(found: Mapping[str, Sequence[Finding]]) -> None:
    """Show findings under the heading each list is given by; nothing when all are empty. Where
    they are too many for the box it says so, and the Report view has them all."""
    found = {heading: findings for heading, findings in found.items() if findings}
    blocks = []
    for heading, findings in found.items():
        lines = [finding_words.line(finding) for finding in findings]
        if len(lines) > MOST_TOLD:
            # As messages: a warning would open the view in the place of the model.
            FreeCAD.Console.PrintMessage("".join(f"{line}\n" for line in [heading, *lines]))
            more = translate("BendTorsion", "and {count} more; the Report view lists them all")
            lines[MOST_TOLD:] = [more.format(count=len(lines) - MOST_TOLD)]
        blocks.append("\n".join([heading, *lines]))
    if blocks:
        ask.warn("\n\n".join(blocks))
