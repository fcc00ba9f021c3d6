# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that check the document and write what the shop needs."""

from __future__ import annotations

import tempfile
from pathlib import Path

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask, macro, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.progress import progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
PATTERNS = "select members with patterns; Development makes them"


def check(document) -> None:
    """Recompute everything and list what is found."""
    from BendTorsionWB.gui import findings_panel
    from BendTorsionWB.model_files import checked_recompute

    checked_recompute(document)
    findings_panel.show(document)


def findings(document) -> None:
    """List what was found, as it is."""
    from BendTorsionWB.gui import findings_panel

    findings_panel.show(document)


def sheets(document) -> None:
    """Drawing sheets of the selected members; of all when none is selected."""
    given = selection.picked()
    own = (
        selection.of_member(given, "Unfold", PATTERNS) if given.ours else _kind(document, "Unfold")
    )
    missing = [item for item in own if not _users(item, "SheetSet")]
    if not missing:
        raise selection.refusal(
            "every member has its sheets already" if own else "no member has patterns", PATTERNS
        )
    with macro.undo_step(document, translate("BendTorsion", "Sheets")):
        made = []
        for item in missing:
            beds = _users(item.Plates, "AssemblyBed")
            made.append(macro.make("make_sheets", document, item, bed=beds[0] if beds else None))
        macro.recompute()
        macro.raise_errors(made)


def export_package(document) -> None:
    """Write cut files, sheets, STEP, workbook and report of the document into a folder."""
    title = translate("BendTorsion", "Export package")
    if not _kind(document, "Unfold"):
        raise selection.refusal("no member has patterns", PATTERNS)
    out = ask.folder(title)
    if out is None:
        return
    with progress(title) as report:
        result = export(document, out, report)
    ask.tell(
        translate("BendTorsion", "{count} members written to {folder}").format(
            count=sum(bool(record.plates) for record in result.records), folder=out
        )
    )


def export(document, out: str, report):
    """What the command line's `export` writes, of a copy of an open document."""
    from BendTorsionWB.document_export import export_document

    sheets_wanted = bool(_kind(document, "Unfold"))
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "document.FCStd"
        document.recompute()
        document.saveCopy(str(copy))
        active = FreeCAD.ActiveDocument.Name
        try:
            return export_document(copy, out, workers=1, progress=report, sheets=sheets_wanted)
        finally:
            FreeCAD.setActiveDocument(active)


def report(document) -> None:
    """Write the figures as a workbook or as report.json."""
    from BendTorsionWB.document_export import records_of, write_figures

    if not _kind(document, "Unfold"):
        raise selection.refusal("no member has patterns", PATTERNS)
    title = translate("BendTorsion", "Report")
    kinds = translate("BendTorsion", "Workbook (*.xlsx);;Report (*.json)")
    path = ask.save_file(title, kinds, ".xlsx")
    if path is None:
        return
    with progress(title) as shown:
        shown(translate("BendTorsion", "figures"), 0, 2)
        given = records_of(document)
        shown(translate("BendTorsion", "writing"), 1, 2)
        write_figures(given, path)
    ask.tell(translate("BendTorsion", "Written: {file}").format(file=path))


def preferences(document) -> None:
    """Open FreeCAD's preferences at the workbench's page."""
    FreeCADGui.showPreferences("BendTorsion", 0)


def _kind(document, kind: str) -> list:
    return [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == kind]


def _users(obj, kind: str) -> list:
    return [user for user in obj.InList if getattr(user, "BT_Type", "") == kind]


COMMANDS = (
    Command(
        "Check",
        QT_TRANSLATE_NOOP("BendTorsion_Check", "Check"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Check", "Recompute the document and list everything that is found"
        ),
        "B, K",
        check,
    ),
    Command(
        "Findings",
        QT_TRANSLATE_NOOP("BendTorsion_Findings", "Findings"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Findings",
            "All errors, warnings and notes of the document; a click shows the place",
        ),
        "B, N",
        findings,
    ),
    Command(
        "Sheets",
        QT_TRANSLATE_NOOP("BendTorsion_Sheets", "Sheets"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Sheets",
            "Drawing sheets of the selected members; of all when nothing is selected",
        ),
        "B, H",
        sheets,
        ("Member", "PlateSet", "Unfold"),
    ),
    Command(
        "ExportPackage",
        QT_TRANSLATE_NOOP("BendTorsion_ExportPackage", "Export package"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ExportPackage",
            "Write DXF and NC1 per plate, sheets, STEP, workbook and report into a folder",
        ),
        "B, E",
        export_package,
    ),
    Command(
        "Report",
        QT_TRANSLATE_NOOP("BendTorsion_Report", "Report"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Report", "Write the figures of all members as a workbook or JSON file"
        ),
        "B, O",
        report,
    ),
    Command(
        "Preferences",
        QT_TRANSLATE_NOOP("BendTorsion_Preferences", "Preferences"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Preferences",
            "What new objects start with; existing documents stay as they are",
        ),
        "B, G",
        preferences,
        needs_document=False,
    ),
)
