# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that check the document and write what the shop needs."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask, macro, not_written, page_windows, selection, tree
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.commands_plates import make_all, users
from BendTorsionWB.gui.progress import progress
from BendTorsionWB.gui.qt import QtCore

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
ERRORS = QT_TRANSLATE_NOOP("BendTorsion", "Written without what is in error:")
WITHOUT = QT_TRANSLATE_NOOP("BendTorsion", "Written without what is not laid flat:")
NONE = QT_TRANSLATE_NOOP("BendTorsion", "no member has patterns")
PATTERNS = QT_TRANSLATE_NOOP("BendTorsion", "select members with patterns; Development makes them")


def check(document) -> None:
    """Recompute everything and list what is found."""
    from BendTorsionWB.gui import findings_panel

    macro.on_files(document, "check", document)
    findings_panel.show(document)


def findings(document) -> None:
    """List what was found, as it is."""
    from BendTorsionWB.gui import findings_panel

    findings_panel.show(document)


def sheets(document) -> None:
    """Drawing sheets of the selected members, of all when none is selected; those of one member
    that has them, in their panel."""
    from BendTorsionWB.gui.panels_detail import SheetsPanel
    from BendTorsionWB.gui.preview import Preview

    given = selection.picked()
    title = translate("BendTorsion", "Sheets")
    own = (
        selection.of_member(given, "Unfold", PATTERNS) if given.ours else _kind(document, "Unfold")
    )
    if not own:
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "no member has patterns"), PATTERNS
        )
    missing = [item for item in own if not users(item, "SheetSet")]
    if not missing and len(own) == 1:
        SheetsPanel(Preview(document, title, users(own[0], "SheetSet")[:1])).show()
        return
    if not missing:
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "every member has its sheets already"),
            QT_TRANSLATE_NOOP("BendTorsion", "select one member to edit its sheets"),
        )

    def make():
        return [macro.make("make_sheets", document, item, bed=_bed_of(item)) for item in missing]

    made = make_all(document, title, make)
    with macro.recorded(document):
        macro.in_window("commands_output", "show_pages", made)
    labels = ", ".join(item.Label for item in made)
    words = translate("BendTorsion", "{count} pages, in the tree below {sheets}")
    ask.tell(words.format(count=len(_pages(made)), sheets=labels))


def _pages(sheet_sets: list) -> list:
    return [page for item in sheet_sets for page in tree.pages(item)]


def show_pages(sheet_sets: list) -> None:
    """Show new pages as they are drawn, and open the first."""
    pages = _pages(sheet_sets)
    for page in pages:
        # The frames FreeCAD draws round views are no part of a drawing.
        if "ShowFrames" in page.ViewObject.PropertiesList:
            page.ViewObject.ShowFrames = False
    if pages:
        first = pages[0].Document.Name, pages[0].Name
        # The dialog that closes gives the view back its focus a moment later.
        QtCore.QTimer.singleShot(100, lambda: _open_page(*first))


def _open_page(document: str, name: str) -> None:
    page = FreeCAD.listDocuments().get(document) and FreeCAD.getDocument(document).getObject(name)
    if page:
        page_windows.open_whole(page)


def _bed_of(unfold):
    beds = users(unfold.Plates, "AssemblyBed")
    return beds[0] if beds else None


def export_package(document) -> None:
    """Write cut files, sheets, STEP, workbook and report of the document into a folder."""
    title = translate("BendTorsion", "Export package")
    selection.refuse_split(document)
    if not _kind(document, "Unfold"):
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "no member has patterns"), PATTERNS
        )
    out = ask.folder(title)
    if out is None:
        return
    with progress(title):
        result = macro.on_files(document, "write_package", document, out)
    ask.tell(
        translate("BendTorsion", "{count} members written to {folder}").format(
            count=sum(bool(record.plates) for record in result.records), folder=out
        )
    )
    _warn_of_missing(result.findings)


def report(document) -> None:
    """Write the figures as a workbook or as report.json."""
    selection.refuse_split(document)
    if not _kind(document, "Unfold"):
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "no member has patterns"), PATTERNS
        )
    title = translate("BendTorsion", "Report")
    kinds = translate("BendTorsion", "Workbook (*.xlsx);;Report (*.json)")
    path = ask.save_file(title, kinds, ".xlsx")
    if path is None:
        return
    with progress(title):
        found = macro.on_files(document, "write_report", document, path)
    ask.tell(translate("BendTorsion", "Written: {file}").format(file=path))
    _warn_of_missing(found)


def _warn_of_missing(findings) -> None:
    """Show what is not in the files and why, where there is any."""
    # Here, not above: the workbench opens without loading numpy.
    from BendTorsionWB.exchange.folder_guide import LEFT_OUT

    not_written.tell(
        {
            translate("BendTorsion", ERRORS): [one for one in findings if one.severity == "error"],
            translate("BendTorsion", WITHOUT): [one for one in findings if one.code in LEFT_OUT],
        }
    )


def preferences(document) -> None:
    """Open FreeCAD's preferences at the workbench's page."""
    FreeCADGui.showPreferences("BendTorsion", 0)


def _kind(document, kind: str) -> list:
    return [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == kind]


def _is_drawn_or_one(given) -> bool:
    """The patterns of one member, or of some of which one has no sheets."""
    own = selection.stood_for(given, "Unfold")
    return len(own) == 1 or not all(users(item, "SheetSet") for item in own)


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
        ("Member", "PlateSet", "Unfold", "SheetSet"),
        _is_drawn_or_one,
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
        ("SheetSet", "ArrangementSet", "NodeSheets"),
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
