# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands for schedules, documents to start from, documents to mend, reports of faults."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path

import FreeCAD

from BendTorsionWB.gui import ask, finding_words, macro, not_written, resources, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.progress import PATIENCE, progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
WORKBOOKS = QT_TRANSLATE_NOOP("BendTorsion", "Schedule (*.xlsx)")
DOCUMENTS = QT_TRANSLATE_NOOP("BendTorsion", "FreeCAD document (*.FCStd)")
BUNDLES = QT_TRANSLATE_NOOP("BendTorsion", "Support bundle (*.zip)")
GEOMETRY = QT_TRANSLATE_NOOP(
    "BendTorsion", "Geometry (*.step *.stp *.iges *.igs *.brep *.brp *.STEP *.STP *.IGES *.IGS)"
)
HALL = Path("concert_hall") / "concert_hall.xlsx"


def import_shapes(document) -> None:
    """The faces and curves of a geometry file, in the document or in a new one."""
    title = translate("BendTorsion", "Import shapes")
    path = ask.open_file(title, translate("BendTorsion", GEOMETRY))
    if path is None:
        return
    alone = document is None or not document.Objects
    with progress(title):
        if document is None:
            macro.on_files(None, "import_shapes", None, path, step=title)
        else:
            with macro.undo_step(document, title):
                macro.on_files(document, "import_shapes", document, path)
    macro.in_window("first_view", "look_at_first" if alone else "fit")


def import_schedule(document) -> None:
    """The document of a schedule, with or without drawing sheets."""
    title = translate("BendTorsion", "Import schedule")
    path = ask.open_file(title, translate("BendTorsion", WORKBOOKS))
    if path is None:
        return
    with_sheets = ask.choice(
        title,
        translate("BendTorsion", "Drawing sheets"),
        [
            translate("BendTorsion", "without drawing sheets"),
            translate("BendTorsion", "with drawing sheets (slower)"),
        ],
    )
    if with_sheets is not None:
        sheets = with_sheets == translate("BendTorsion", "with drawing sheets (slower)")
        _open_schedule(title, path, sheets)


def _open_schedule(title: str, path, sheets: bool = False) -> None:
    with progress(title):
        macro.on_files(None, "open_schedule", str(path), sheets=sheets)
    macro.in_window("first_view", "look_at_members")


def write_schedule(document) -> None:
    """The document as a schedule; what a schedule cannot say is told."""
    title = translate("BendTorsion", "Write schedule")
    selection.refuse_split(document)
    if not any(getattr(obj, "BT_Type", "") == "Member" for obj in document.Objects):
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "the document has no member"),
            QT_TRANSLATE_NOOP("BendTorsion", "make one, or import a schedule"),
        )
    path = ask.save_file(title, translate("BendTorsion", WORKBOOKS), ".xlsx")
    if path is None:
        return
    with progress(title):
        found = macro.on_files(document, "write_schedule", document, path)
    ask.tell(translate("BendTorsion", "Written: {file}").format(file=path))
    heading = translate("BendTorsion", "Written without what a schedule cannot say ({count}):")
    told = [finding_words.in_window_words(finding, document) for finding in found]
    not_written.tell({heading.format(count=len(told)): told})


def example(document) -> None:
    """A document to start from: one of the templates, or the concert hall from its schedule."""
    from BendTorsionWB.document_templates import template_titles

    title = translate("BendTorsion", "Example project")
    titles = {translate("BendTorsion", text): name for name, text in template_titles().items()}
    hall = translate("BendTorsion", "concert hall, from its schedule")
    chosen = ask.choice(title, translate("BendTorsion", "Start from"), [*titles, hall])
    if chosen is None:
        return
    if chosen == hall:
        _open_schedule(title, resources.FOLDER / "examples" / HALL)
        return
    path = ask.save_file(title, translate("BendTorsion", DOCUMENTS), ".FCStd", titles[chosen])
    if path is None:
        return
    macro.on_files(None, "open_template", titles[chosen], path)
    macro.in_window("first_view", "look_at_members")


def repair(document) -> None:
    """Give objects back what computes them, after a document was saved without the workbench."""
    from BendTorsionWB.objects.repair import bare_objects

    title = translate("BendTorsion", "Repair document")
    # Where nothing is done no undo step says that something was.
    step = macro.undo_step(document, title) if bare_objects(document) else nullcontext()
    with progress(title, PATIENCE), step:
        labels = macro.on_files(document, "repair", document)
    if labels:
        text = translate("BendTorsion", "Repaired: {count} objects")
        ask.tell(text.format(count=len(labels)))
    else:
        ask.tell(translate("BendTorsion", "Nothing to repair: every object can be computed"))


def support_bundle(document) -> None:
    """What a report of a fault needs, in one file; with the document when one is open."""
    title = translate("BendTorsion", "Support bundle")
    path = ask.save_file(title, translate("BendTorsion", BUNDLES), ".zip")
    if path is None:
        return
    with progress(title, PATIENCE):
        if document is None:
            names = macro.on_files(None, "write_support", path)
        else:
            names = macro.on_files(document, "write_support", path, document)
    ask.tell(
        translate("BendTorsion", "{file}: {names}; read them before you send them").format(
            file=path, names=", ".join(names)
        )
    )


COMMANDS = (
    Command(
        "ImportShapes",
        QT_TRANSLATE_NOOP("BendTorsion_ImportShapes", "Import shapes"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ImportShapes",
            "The faces and the curves of a STEP, IGES or BREP file, to select members from",
        ),
        "B, 0",
        import_shapes,
        needs_document=False,
    ),
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
    Command(
        "Repair",
        QT_TRANSLATE_NOOP("BendTorsion_Repair", "Repair document"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Repair",
            "Make objects compute again that were saved by a FreeCAD without this workbench",
        ),
        "B, 7",
        repair,
    ),
    Command(
        "SupportBundle",
        QT_TRANSLATE_NOOP("BendTorsion_SupportBundle", "Support bundle"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_SupportBundle",
            "Versions, preferences, findings and tables of the document in one file, for a report"
            " of a fault; without names of users, machines and folders",
        ),
        "B, 8",
        support_bundle,
        needs_document=False,
    ),
)
