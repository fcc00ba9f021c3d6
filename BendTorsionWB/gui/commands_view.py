# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands for what is shown of members: plates, skin, axis, frames, labels, colours."""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui import ask, macro, member_display, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.preview import is_there
from BendTorsionWB.gui.progress import PATIENCE, Cancelled, progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
MEND = QT_TRANSLATE_NOOP("BendTorsion", "select members, or have some in the document")


def show_frames(document) -> None:
    """Frame ribbons of the selected axes or members, on or off."""
    given = selection.picked()
    axes = given.of_kind("Axis")
    if not axes:
        axes = list(dict.fromkeys(item.Axis for item in _members(document) if item.Axis))
    shown = all(item.ViewObject.ShowFrames for item in axes)
    with macro.recorded(document):
        for item in axes:
            macro.put_view(item, "ShowFrames", not shown)
            if not shown:
                macro.put_view(item, "Visibility", True)


def show_marks(document) -> None:
    """Marks of the selected members' plates, on or off."""
    _toggle(document, "ShowMarks", translate("BendTorsion", "Show marks"))


def show_points(document) -> None:
    """Station lines and point labels of the selected members' plates, on or off."""
    _toggle(document, "ShowPoints", translate("BendTorsion", "Show points"))


def fit_members(document) -> None:
    """Look at the selected members as large as the view has room; at all when none is selected."""
    with macro.recorded(document):
        macro.in_window("first_view", "fit_members", *_members(document))


def show_as(document) -> None:
    """The next of plates, skin and axis for the selected members."""
    members = _members(document)
    modes = list(member_display.MODES)
    now = member_display.mode_of(members[0])
    following = modes[(modes.index(now) + 1) % len(modes)] if now in modes else modes[0]
    with macro.recorded(document):
        macro.in_window("member_display", "show_as", members, following)
    ask.tell(translate("BendTorsion", member_display.MODES[following]))


def colour_by(document) -> None:
    """Colour the selected members' plates by a figure, with a legend."""
    plates = _plates(document)
    words = {
        translate("BendTorsion", word): word
        for word in plates[0].getEnumerationsOfProperty("ColourBy")
    }
    title = translate("BendTorsion", "Colour by")
    chosen = ask.choice(title, title, list(words))
    if chosen is None:
        return
    with progress(title, PATIENCE) as report, macro.undo_step(document, title):
        # What is laid flat is kept; told one by one, the user sees how far it is and can stop.
        for done, item in enumerate(plates):
            report(item.Label, done, len(plates))
            _laid_flat(item)
        macro.make("colour_by", plates, words[chosen])


def _laid_flat(plates) -> None:
    """Lay the plates of a PlateSet flat, which `core.memo` keeps; nothing for what is in error."""
    from BendTorsionWB.core import detailing
    from BendTorsionWB.objects import plate_set

    try:
        detailing.record_of(plate_set.value(plates))
    except BendTorsionError:
        pass  # It has no colours, and its own findings say why.


def _toggle(document, name: str, title: str) -> None:
    plates = _plates(document)
    before = [getattr(item.ViewObject, name) for item in plates]
    with progress(title, PATIENCE) as report, macro.recorded(document):
        try:
            for done, item in enumerate(plates):
                report(item.Label, done, len(plates))
                macro.put_view(item, name, not all(before))
        except Cancelled:
            for item, value in zip(plates, before, strict=True):
                if is_there(item):
                    setattr(item.ViewObject, name, value)
            raise


def _members(document) -> list:
    """The selected members; all when nothing of ours is selected."""
    return _chosen(document, "Member")


def _plates(document) -> list:
    return _chosen(document, "PlateSet")


def _chosen(document, kind: str) -> list:
    given = selection.picked()
    if given.ours:
        return selection.of_member(given, kind, MEND)
    found = [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == kind]
    if not found:
        raise selection.refusal(QT_TRANSLATE_NOOP("BendTorsion", "there is no member"), MEND)
    return found


COMMANDS = (
    Command(
        "FitMembers",
        QT_TRANSLATE_NOOP("BendTorsion_FitMembers", "Fit members"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_FitMembers",
            "Fit the view to the selected members, without the surface they lie on; to all members"
            " when nothing is selected",
        ),
        "B, 9",
        fit_members,
        ("Member", "PlateSet"),
    ),
    Command(
        "ShowAs",
        QT_TRANSLATE_NOOP("BendTorsion_ShowAs", "Plates, skin or axis"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ShowAs",
            "Show plates, outer skin or axis of the selected members, in turn; of all when nothing"
            " is selected",
        ),
        "B, Q",
        show_as,
        ("Member", "PlateSet"),
    ),
    Command(
        "ShowFrames",
        QT_TRANSLATE_NOOP("BendTorsion_ShowFrames", "Show frames"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ShowFrames",
            "Show where the height of the section points along the selected axes, or hide it",
        ),
        "B, R",
        show_frames,
        ("Axis", "Member", "PlateSet"),
    ),
    Command(
        "ShowMarks",
        QT_TRANSLATE_NOOP("BendTorsion_ShowMarks", "Show marks"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ShowMarks", "Show the position mark of each plate, or hide it"
        ),
        "B, 1",
        show_marks,
        ("Member", "PlateSet"),
    ),
    Command(
        "ShowPoints",
        QT_TRANSLATE_NOOP("BendTorsion_ShowPoints", "Show points"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ShowPoints", "Show station lines with their L and P labels, or hide them"
        ),
        "B, 2",
        show_points,
        ("Member", "PlateSet"),
    ),
    Command(
        "ColourBy",
        QT_TRANSLATE_NOOP("BendTorsion_ColourBy", "Colour by"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_ColourBy",
            "Colour plates by strain, length error, forming class, thickness and more, all selected"
            " members on one scale, with a legend",
        ),
        "B, Z",
        colour_by,
        ("Member", "PlateSet"),
    ),
)
