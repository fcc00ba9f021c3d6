# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands for schedules and documents to start from."""

from __future__ import annotations

from pathlib import Path

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui import ask, resources, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.progress import progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
WORKBOOKS = QT_TRANSLATE_NOOP("BendTorsion", "Schedule (*.xlsx)")
DOCUMENTS = QT_TRANSLATE_NOOP("BendTorsion", "FreeCAD document (*.FCStd)")
HALL = Path("concert_hall") / "concert_hall.xlsx"


def import_schedule(document) -> None:
    """The document of a schedule."""
    title = translate("BendTorsion", "Import schedule")
    path = ask.open_file(title, translate("BendTorsion", WORKBOOKS))
    if path is not None:
        with progress(title) as report:
            open_schedule(path, report)


def open_schedule(path, report):
    """A new document with the members of a schedule, computed and shown. Raises BendTorsionError
    for an invalid schedule; stopped or in error, it leaves no document."""
    from BendTorsionWB.document import build_document
    from BendTorsionWB.project import detail_members, read_jobs

    schedule, jobs = read_jobs(path)
    _, lost = detail_members(schedule, jobs, progress=report)
    if lost:
        raise BendTorsionError(lost)
    document = build_document(schedule, jobs, sheets=False, hidden=False)
    try:
        objects = list(reversed(document.TopologicalSortedObjects))
        for done, obj in enumerate(objects, start=1):
            obj.recompute()
            report(translate("BendTorsion", "document"), done, len(objects))
        document.recompute()
    except BaseException:
        FreeCAD.closeDocument(document.Name)
        raise
    document.Label = Path(path).stem
    document.clearUndos()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    return document


def write_schedule(document) -> None:
    """The document as a schedule; what a schedule cannot say is told."""
    from BendTorsionWB.round_trip import write_back

    title = translate("BendTorsion", "Write schedule")
    if not any(getattr(obj, "BT_Type", "") == "Member" for obj in document.Objects):
        raise selection.refusal("the document has no member", "make one, or import a schedule")
    path = ask.save_file(title, translate("BendTorsion", WORKBOOKS), ".xlsx")
    if path is None:
        return
    with progress(title) as report:
        report(translate("BendTorsion", "writing and reading it again"), 0, 1)
        found = write_back(document, path)
    FreeCAD.setActiveDocument(document.Name)
    for finding in found:
        FreeCAD.Console.PrintWarning(f"{finding.line()}\n")
    ask.tell(
        translate("BendTorsion", "Written: {file}; {count} things a schedule cannot say").format(
            file=path, count=len(found)
        )
    )


def example(document) -> None:
    """A document to start from: one of the templates, or the concert hall from its schedule."""
    from BendTorsionWB.document_templates import new_document, template_titles

    title = translate("BendTorsion", "Example project")
    titles = {translate("BendTorsion", text): name for name, text in template_titles().items()}
    hall = translate("BendTorsion", "concert hall, from its schedule")
    chosen = ask.choice(title, translate("BendTorsion", "Start from"), [*titles, hall])
    if chosen is None:
        return
    if chosen == hall:
        with progress(title) as report:
            open_schedule(resources.FOLDER / "examples" / HALL, report)
        return
    path = ask.save_file(title, translate("BendTorsion", DOCUMENTS), ".FCStd")
    if path is None:
        return
    new_document(titles[chosen], path)
    FreeCAD.openDocument(path)
    FreeCADGui.SendMsgToActiveView("ViewFit")


COMMANDS = (
    Command(
        "ImportSchedule",
        QT_TRANSLATE_NOOP("BendTorsion_ImportSchedule", "Import schedule"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ImportSchedule", "A new document with the members of a schedule workbook"
        ),
        "B, Y",
        import_schedule,
        needs_document=False,
    ),
    Command(
        "WriteSchedule",
        QT_TRANSLATE_NOOP("BendTorsion_WriteSchedule", "Write schedule"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_WriteSchedule", "Write the members of the document as a schedule workbook"
        ),
        "B, W",
        write_schedule,
    ),
    Command(
        "Example",
        QT_TRANSLATE_NOOP("BendTorsion_Example", "Example project"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Example",
            "Start from an example: one member, three members on a dome, the concert hall",
        ),
        "B, X",
        example,
        needs_document=False,
    ),
)
