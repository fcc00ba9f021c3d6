# SPDX-License-Identifier: LGPL-2.1-or-later
"""The status bar says what is wrong with the object that is selected."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

translate = FreeCAD.Qt.translate


class SelectedFindings:
    """Selection observer: the worst finding of what is selected, and how many more there are."""

    def addSelection(self, document, name, element, point):
        """Called by FreeCAD when something is selected."""
        obj = FreeCAD.getDocument(document).getObject(name)
        if obj is not None and "Findings" in obj.PropertiesList:
            FreeCADGui.getMainWindow().statusBar().showMessage(status_text(obj))


def status_text(obj) -> str:
    """One line on an object: its first error, else its first warning, else nothing."""
    # Here, not above: the workbench opens without loading Part.
    from BendTorsionWB.gui import finding_words
    from BendTorsionWB.objects.proxy import findings_of

    found = [f for f in findings_of(obj) if f.severity in ("error", "warning")]
    found.sort(key=lambda finding: finding.severity)
    if not found:
        return ""
    line = finding_words.line(found[0])
    if len(found) > 1:
        more = translate("BendTorsion", "and {count} more").format(count=len(found) - 1)
        line = f"{line} ({more})"
    return line


def watch() -> None:
    """Follow the selection from now on."""
    FreeCADGui.Selection.addObserver(SelectedFindings())
