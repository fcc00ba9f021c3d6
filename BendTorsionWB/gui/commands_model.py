# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that make members and what they are made of: surfaces, axes, sections, cuts."""

from __future__ import annotations

import json

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import ask, macro, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.commands_plates import MEMBERS, edit_only, make_all
from BendTorsionWB.gui.equal_section import section_of
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.progress import PATIENCE, progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


def members_from_selection(document) -> None:
    """Read the selection, ask for the section, make the members in one undo step."""
    from BendTorsionWB.gui import section_dialog

    given = selection.picked()
    surface, curves = selection.surface_and_curves(given)
    choice = section_dialog.ask(
        FreeCADGui.getMainWindow(), next_number(document), len(curves), document.Objects[0]
    )
    if choice is None:
        return
    members = make_members(document, surface, curves, choice)
    with macro.recorded(document):
        macro.in_window("first_view", "look_at", *members)
    found = [text for one in members for text in (*one.Axis.Findings, *one.Findings)]
    count = sum(json.loads(text)["severity"] == "warning" for text in dict.fromkeys(found))
    said = []
    if given.others:
        words = translate("BendTorsion", "Left aside, neither faces nor curves: {names}")
        said.append(words.format(names=", ".join(obj.Label for obj in given.others)))
    if count:
        words = translate("BendTorsion", "Warnings: {count}, listed by Findings")
        said.append(words.format(count=count))
    if said:
        ask.tell("; ".join(said))


def make_members(document, surface, curves, choice) -> list:
    """Numbered members with plates, one per curve, in one undo step.

    surface, curves: as `selection.surface_and_curves`. choice: `section_dialog.SectionChoice`.
    Raises BendTorsionError, the document as before, when one of them cannot be built.
    """
    title = translate("BendTorsion", "Members from selection")
    with progress(title, PATIENCE) as report, macro.undo_step(document, title):
        before = len(document.Objects)
        if isinstance(surface, tuple):
            surface = selection.surface_of(surface) or macro.make(
                "make_surface", document, free_label(document, "Surface"), face=surface
            )
        sizes = {"h": choice.h, "b": choice.b, "t": choice.t}
        there = None if choice.bound else section_of(document, choice.type, sizes)
        section = there or macro.make(
            "make_section", document, free_label(document, "Section"), choice.type, **sizes
        )
        for name, text in choice.bound:
            macro.bind(section, name, text)
        members = []
        marks = free_marks(document, len(curves), choice.first)
        for mark, curve in zip(marks, curves, strict=True):
            axis = macro.make("make_axis", document, f"{mark}-axis", surface, edge=curve)
            segment = {"align": choice.align}
            member = macro.make("make_member", document, mark, axis, [section], [segment])
            macro.make("make_plates", document, member)
            # The plates show the same body; two skins in one place only flicker.
            macro.put_view(member, "Visibility", False)
            members.append(member)
        macro.recompute(report, document.Objects[before:])
        macro.raise_errors(document.Objects[before:])
        # Faces the members follow lie in their own faces, where both flicker.
        macro.put_view(surface, "Visibility", False)
        if surface.Source is not None:
            macro.put_view(surface.Source[0], "Visibility", False)
    return members


def next_number(document) -> int:
    """The lowest number of which no label M1, M2, … is taken."""
    taken = {item.Label for item in document.Objects}
    return next(k for k in range(1, len(taken) + 2) if f"M{k}" not in taken)


def free_marks(document, count: int, first: int = 1) -> list[str]:
    """The next free marks M1, M2, … from a number on."""
    taken = {item.Label for item in document.Objects}
    candidates = (f"M{number}" for number in range(first, first + len(taken) + count))
    return [mark for mark in candidates if mark not in taken][:count]


def free_label(document, label: str) -> str:
    """The label, or with the next free number behind it."""
    taken = {item.Label for item in document.Objects}
    numbered = (f"{label} {k}" for k in range(2, len(taken) + 3))
    return label if label not in taken else next(n for n in numbered if n not in taken)


def surface(document) -> None:
    """The picked faces as a Surface, that which they have when there is one, or the sizes of the
    Surface picked; with nothing picked, an ellipsoid whose kind and sizes are asked."""
    from BendTorsionWB.gui.panels_model import SurfacePanel

    given = selection.picked()
    faces, surfaces = given.faces, given.of_kind("Surface")
    name = translate("BendTorsion", "Surface")
    if surfaces and not faces:
        mend = QT_TRANSLATE_NOOP("BendTorsion", "select one surface")
        things = QT_TRANSLATE_NOOP("BendTorsion", "surfaces")
        edit_only(document, name, SurfacePanel, surfaces, things, mend)
        return
    if given != selection.Picked() and not faces:
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "no face is selected"),
            QT_TRANSLATE_NOOP("BendTorsion", "select faces of one shape, or nothing"),
        )
    if len(faces) > 1:
        raise selection.refusal(
            translate("BendTorsion", "{count} shapes are selected, one is needed").format(
                count=len(faces)
            ),
            QT_TRANSLATE_NOOP(
                "BendTorsion", "select faces of one shape, or nothing for a dome by its sizes"
            ),
        )
    there = selection.surface_of(faces[0]) if faces else None
    if there is not None:
        SurfacePanel(Preview(document, name, [there])).show()
        words = translate("BendTorsion", "The faces have their surface already: {surface}")
        ask.tell(words.format(surface=there.Label))
        return
    label = free_label(document, "Surface")
    source = {"face": faces[0]} if faces else {}

    def create(make):
        return [make("make_surface", document, label, **source)]

    SurfacePanel(Preview(document, name, create=create)).show()


def axis(document) -> None:
    """Axes along the picked curves, through the picked points, or where a picked plane cuts the
    surface; the axis picked when nothing else is."""
    from BendTorsionWB.gui.axis_ways import MEND, axis_ways
    from BendTorsionWB.gui.panels_model import AxisPanel

    given = selection.picked()
    name = translate("BendTorsion", "Axis")
    surfaces, axes = given.of_kind("Surface"), given.of_kind("Axis")
    sources, faces = list(given.curves), list(given.faces)
    if not sources and not given.points and len(faces) == 1:
        sources = list(given.inside)
    if axes and given == selection.Picked(ours=tuple(axes)):
        mend = QT_TRANSLATE_NOOP("BendTorsion", "select one axis")
        things = QT_TRANSLATE_NOOP("BendTorsion", "axes")
        edit_only(document, name, AxisPanel, axes, things, mend)
        return
    if not surfaces and len(faces) == 1:
        target = faces.pop()
        target = selection.surface_of(target) or target
    elif len(surfaces) == 1:
        target = surfaces[0]
    else:
        raise selection.refusal(
            translate("BendTorsion", "{count} surfaces are selected, one is needed").format(
                count=len(surfaces) or len(faces)
            ),
            MEND,
        )
    ways = axis_ways(target, sources, given.points, faces)
    label = free_label(document, "Axis")

    def create(make):
        on = target
        if isinstance(target, tuple):
            on = make("make_surface", document, free_label(document, "Surface"), face=target)
        return [
            make("make_axis", document, label if k == 0 else f"{label} {k + 1}", on, **way)
            for k, way in enumerate(ways)
        ]

    AxisPanel(Preview(document, name, create=create)).show()


def section(document) -> None:
    """The selected section, or a new one."""
    from BendTorsionWB.gui.panels_model import SectionPanel

    sections = selection.picked().of_kind("SectionSpec")
    name = translate("BendTorsion", "Section")
    if sections:
        mend = QT_TRANSLATE_NOOP("BendTorsion", "select one section")
        things = QT_TRANSLATE_NOOP("BendTorsion", "sections")
        edit_only(document, name, SectionPanel, sections, things, mend)
        return
    label = free_label(document, "Section")
    preview = Preview(document, name, create=lambda make: [make("make_section", document, label)])
    SectionPanel(preview).show()


def member(document) -> None:
    """The selected member, or a new one along each selected axis with the selected sections."""
    from BendTorsionWB.gui.member_panel import MemberPanel

    given = selection.picked()
    axes, sections = given.of_kind("Axis"), given.of_kind("SectionSpec")
    name = translate("BendTorsion", "Member")
    if not axes:
        mend = QT_TRANSLATE_NOOP("BendTorsion", "select an axis and a section, or a member to edit")
        members = selection.of_member(given, "Member", mend)
        edit_only(document, name, MemberPanel, members, MEMBERS, mend)
        return
    if not sections:
        sections = [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "SectionSpec"]
        sections = sections[-1:]
    if not sections:
        raise selection.refusal(
            QT_TRANSLATE_NOOP("BendTorsion", "there is no section"),
            QT_TRANSLATE_NOOP("BendTorsion", "make a section first"),
        )
    marks = free_marks(document, len(axes))

    def create(make):
        # Sections share the length evenly until their cuts are moved.
        segments = [{}, *({"cut_ratio": k / len(sections)} for k in range(1, len(sections)))]
        return [
            make("make_member", document, mark, axis, sections, segments)
            for mark, axis in zip(marks, axes, strict=True)
        ]

    if len(axes) > 1:
        make_all(document, name, lambda: create(macro.make))
        return
    MemberPanel(Preview(document, name, create=create)).show()


def cut_point(document) -> None:
    """A cut where the selected member was clicked; in its middle when it was picked in the tree."""
    from BendTorsionWB.gui.member_panel import MemberPanel, place_on

    mend = QT_TRANSLATE_NOOP("BendTorsion", "click a member where the cut is to be, then Cut point")
    given = selection.picked()
    target = selection.only(selection.of_member(given, "Member", mend), MEMBERS, mend)
    points = [
        tuple(point)
        for item in FreeCADGui.Selection.getSelectionEx()
        for point in item.PickedPoints
        if item.SubElementNames
    ]
    place = place_on(target, points[0]) if points else _middle(target)
    numbers = []

    def create(make):
        numbers.append(make("add_cut", target, place))
        return [target]

    preview = Preview(document, translate("BendTorsion", "Cut point"), [target], create)
    MemberPanel(preview, numbers[0]).show()


def _middle(member) -> float:
    """The middle of a member, to a tenth of a mm; raises BendTorsionError for one in error."""
    from BendTorsionWB.objects.proxy import check_linked

    check_linked(member)
    return round(0.5 * member.Length.Value, 1)


def alignment(document) -> None:
    """The position of the selected members on their axes."""
    from BendTorsionWB.gui.panels_model import AlignmentPanel

    members = selection.of_member(
        selection.picked(),
        "Member",
        QT_TRANSLATE_NOOP("BendTorsion", "select members or their plates"),
    )
    AlignmentPanel(Preview(document, translate("BendTorsion", "Alignment"), members)).show()


def member_table(document) -> None:
    """Open the table of all members."""
    from BendTorsionWB.gui import member_table as table

    table.show(document)


COMMANDS = (
    Command(
        "MembersFromSelection",
        QT_TRANSLATE_NOOP("BendTorsion_MembersFromSelection", "Members from selection"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_MembersFromSelection",
            "Select one face, shell or surface and curves on it: each curve becomes a numbered box"
            " member that follows the face, cut into plates",
        ),
        "B, F",
        members_from_selection,
        ("Face", "Edge", "Surface"),
        lambda given: len(given.of_kind("Surface")) <= 1,
    ),
    Command(
        "Surface",
        QT_TRANSLATE_NOOP("BendTorsion_Surface", "Surface"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Surface",
            "The surface members follow: from selected faces of a shape, or the sizes of the one"
            " selected; with nothing selected, a dome, cylinder, cone, torus or plane by its sizes",
        ),
        "B, U",
        surface,
        ("Face", "Surface"),
        lambda given: len(given.of_kind("Surface")) <= 1,
    ),
    Command(
        "Axis",
        QT_TRANSLATE_NOOP("BendTorsion_Axis", "Axis from selection"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Axis",
            "Select a surface and the edges, wires, sketches or points the member runs along, or a"
            " plane face that cuts the surface; or the axis to edit",
        ),
        "B, A",
        axis,
        ("Face", "Edge", "Vertex", "Surface", "Axis"),
        lambda given: max(len(given.of_kind(kind)) for kind in ("Surface", "Axis")) <= 1,
    ),
    Command(
        "Section",
        QT_TRANSLATE_NOOP("BendTorsion_Section", "Section"),
        QT_TRANSLATE_NOOP("BendTorsion_Section", "A new section, or the sizes of the one selected"),
        "B, S",
        section,
        ("SectionSpec",),
        lambda given: len(given.of_kind("SectionSpec")) == 1,
    ),
    Command(
        "Member",
        QT_TRANSLATE_NOOP("BendTorsion_Member", "Member"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Member",
            "A new member along each selected axis with the selected sections, or the segments of"
            " the member selected",
        ),
        "B, M",
        member,
        ("Axis", "Member", "PlateSet"),
        lambda given: bool(given.of_kind("Axis")) or selection.is_one(given),
    ),
    Command(
        "CutPoint",
        QT_TRANSLATE_NOOP("BendTorsion_CutPoint", "Cut point"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_CutPoint",
            "Click a member where its section is to change: a segment starts there",
        ),
        "B, C",
        cut_point,
        ("Member", "PlateSet"),
        selection.is_one,
    ),
    Command(
        "Alignment",
        QT_TRANSLATE_NOOP("BendTorsion_Alignment", "Alignment"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Alignment", "Which of nine points of the section lies on the axis"
        ),
        "B, L",
        alignment,
        ("Member", "PlateSet"),
    ),
    Command(
        "MemberTable",
        QT_TRANSLATE_NOOP("BendTorsion_MemberTable", "Member table"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_MemberTable",
            "All members as a table: sections, cuts, slopes, alignments, offsets and joints, edited"
            " or pasted as in a spreadsheet",
        ),
        "B, T",
        member_table,
        ("Member", "PlateSet"),
    ),
)
