# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that cut members into plates, join them, lay them flat and put them together."""

from __future__ import annotations

from collections.abc import Callable

import FreeCAD

from BendTorsionWB.gui import ask, first_view, macro, selection
from BendTorsionWB.gui.command import Command
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.progress import PATIENCE, progress

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
MEND = QT_TRANSLATE_NOOP("BendTorsion", "select a member or its plates")
MEMBERS = QT_TRANSLATE_NOOP("BendTorsion", "members")
ONE = QT_TRANSLATE_NOOP("BendTorsion", "select one member or its plates")


def plates(document) -> None:
    """The joints of the selected plates; plates of the selected members that have none."""
    from BendTorsionWB.gui.plates_panel import PlatesPanel

    given = selection.picked()
    name = translate("BendTorsion", "Plates")
    members = selection.of_member(given, "Member", MEND)
    bare = [item for item in members if not users(item, "PlateSet")]
    if not bare:
        member = selection.only(members, MEMBERS, ONE)
        PlatesPanel(Preview(document, name, users(member, "PlateSet")[:1])).show()
        return
    if len(bare) == 1:
        preview = Preview(document, name, create=lambda make: _make_plates(make, document, bare))
        PlatesPanel(preview).show()
        return
    make_all(document, name, lambda: _make_plates(macro.make, document, bare))


def _make_plates(make: Callable, document, members: list) -> list:
    """Plates that stand for their members from then on."""
    made = [make("make_plates", document, one) for one in members]
    for one in members:
        macro.put_view(one, "Visibility", False)
    return made


def pieces(document) -> None:
    """The delivery pieces of the selected member."""
    _parts(document, "Pieces", translate("BendTorsion", "Delivery pieces"), "BendTorsion_Pieces")


def diaphragms(document) -> None:
    """The diaphragms and end plates of the selected member."""
    name = translate("BendTorsion", "Diaphragms and end plates")
    _parts(document, "Diaphragms", name, "BendTorsion_Diaphragms")


def openings(document) -> None:
    """The openings in the faces of the selected member."""
    _parts(document, "Openings", translate("BendTorsion", "Openings"), "BendTorsion_Openings")


def face_marks(document) -> None:
    """What is marked on the faces of the selected member."""
    _parts(document, "Marks", translate("BendTorsion", "Marks on faces"), "BendTorsion_FaceMarks")


def welds(document) -> None:
    """The welds of the selected member that differ from those of the rule pack."""
    _parts(document, "Edges", translate("BendTorsion", "Welds"), "BendTorsion_Welds")


def edit_only(document, name: str, panel: Callable, found: list, things: str, mend: str) -> None:
    """The one object found selected, in its panel; raises BendTorsionError as `selection.only`."""
    panel(Preview(document, name, [selection.only(found, things, mend)])).show()


def _parts(document, table: str, name: str, icon: str) -> None:
    from BendTorsionWB.gui.plates_panel import PartsPanel

    PartsPanel(Preview(document, name, [_own_plates()]), table, name, icon).show()


def _own_plates():
    """The PlateSet of the one member selected."""
    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    return selection.only(own, MEMBERS, ONE)


def splits(document) -> None:
    """The split editor of the selected plates."""
    from BendTorsionWB.gui.split_editor import SplitPanel

    name = translate("BendTorsion", "Split editor")
    SplitPanel(Preview(document, name, [_own_plates()])).show()


def node(document) -> None:
    """The selected node; that of the two selected members, or a new one where the second of them
    ends on the first."""
    from BendTorsionWB.gui.panels_detail import NodePanel
    from BendTorsionWB.objects import node as node_object

    given = selection.picked()
    name = translate("BendTorsion", "Node")
    nodes = given.of_kind("Node")
    if nodes:
        mend = QT_TRANSLATE_NOOP("BendTorsion", "select one node")
        edit_only(document, name, NodePanel, nodes, QT_TRANSLATE_NOOP("BendTorsion", "nodes"), mend)
        return
    mend = QT_TRANSLATE_NOOP(
        "BendTorsion",
        "select the member that runs through, then the one that ends on it; or a node to edit",
    )
    members = selection.of_member(given, "Member", mend)
    if len(members) != 2:
        words = translate("BendTorsion", "{count} selected, two members are needed")
        raise selection.refusal(words.format(count=len(members)), mend)
    there = [
        item
        for item in dict.fromkeys(users(members[0], "Node"))
        if {item.Through, item.Other} == set(members)
    ]
    place = node_object.free_place(*members, there)
    if place is None:
        _edit_one_of(document, name, members, there)
        return
    taken = {item.Label for item in document.Objects}
    label = next(f"N{k}" for k in range(1, len(taken) + 2) if f"N{k}" not in taken)
    cut = [item for one in members for item in users(one, "PlateSet")]

    at = {"place": place} if there else {}

    def create(make):
        return [make("make_node", document, *members, label, plates=cut, **at)]

    NodePanel(Preview(document, name, create=create)).show()


def _edit_one_of(document, name: str, members: list, there: list) -> None:
    """The node two members have, in its panel; of several one is to be selected."""
    from BendTorsionWB.gui.panels_detail import NodePanel

    one, other = (item.Label for item in members)
    labels = ", ".join(item.Label for item in there)
    words = translate("BendTorsion", "{one} and {other} have their node already: {nodes}")
    told = words.format(one=one, other=other, nodes=labels)
    if len(there) > 1:
        raise selection.refusal(told, QT_TRANSLATE_NOOP("BendTorsion", "select the node to edit"))
    NodePanel(Preview(document, name, there)).show()
    ask.tell(told)


def development(document) -> None:
    """Flat patterns of the selected members' plates; of one member in its panel."""
    from BendTorsionWB.gui.panels_detail import DevelopmentPanel

    name = translate("BendTorsion", "Development")
    _of_plates(document, "Unfold", _make_unfold, name, DevelopmentPanel)


def _make_unfold(make: Callable, document, plates):
    """Patterns beside the model and those there are."""
    from BendTorsionWB.make import place_beside

    return make("make_unfold", document, plates, place=place_beside(document, plates))


def assembly_bed(document) -> None:
    """Assembly beds of the selected members' pieces; of one member in its panel."""
    from BendTorsionWB.gui.panels_detail import BedPanel

    name = translate("BendTorsion", "Assembly bed")
    _of_plates(document, "AssemblyBed", _make_bed, name, BedPanel)


def _make_bed(make: Callable, document, plates):
    return make("make_bed", document, plates)


def _of_plates(document, kind: str, new: Callable, name: str, panel: Callable) -> None:
    """What follows the selected PlateSets: of several made where it is missing, of one in a panel,
    new or as it is."""
    own = selection.of_member(selection.picked(), "PlateSet", MEND)
    missing = [item for item in own if not users(item, kind)]
    if len(own) > 1:
        if not missing:
            labels = ", ".join(item.Label for item in own)
            raise selection.refusal(
                translate("BendTorsion", "{labels} have it already").format(labels=labels),
                QT_TRANSLATE_NOOP("BendTorsion", "select one to edit it"),
            )
        make_all(
            document,
            name,
            lambda: [shown(new(macro.make, document, one)) for one in missing],
            fits=True,
        )
        return
    if not missing:
        panel(Preview(document, name, users(own[0], kind)[:1])).show()
        return

    def create(make):
        return [shown(new(make, document, own[0]))]

    panel(Preview(document, name, create=create, fits=True)).show()
    first_view.fit()


def make_all(document, name: str, make: Callable[[], list], fits: bool = False) -> list:
    """Objects made, recomputed one by one and without error, in one undo step; long work can be
    stopped, and leaves the document as it was. fits: the view is fitted to them. Raises
    BendTorsionError, Cancelled."""
    with progress(name, PATIENCE) as report, macro.undo_step(document, name):
        made = make()
        macro.recompute(report, made)
        macro.raise_errors(made)
        if fits:
            macro.in_window("first_view", "fit")
    return made


def shown(obj):
    """The object, to be seen: flat patterns and beds are hidden when they come from a file."""
    macro.put_view(obj, "Visibility", True)
    return obj


def users(obj, kind: str) -> list:
    """What of a kind links to an object."""
    return [user for user in obj.InList if getattr(user, "BT_Type", "") == kind]


def _is_cut_or_one(given) -> bool:
    """One member, or some of which one has no plates."""
    members = selection.stood_for(given, "Member")
    return len(members) == 1 or not all(users(item, "PlateSet") for item in members)


def _has_one(given) -> bool:
    return selection.is_one(given, "PlateSet")


def _has_node(given) -> bool:
    """One node, or two members."""
    nodes = given.of_kind("Node")
    return len(nodes) == 1 or (not nodes and len(selection.stood_for(given, "Member")) == 2)


def _is_open(given, kind: str) -> bool:
    """The plates of one member, or of some of which one lacks what is to follow them."""
    own = selection.stood_for(given, "PlateSet")
    return len(own) == 1 or not all(users(item, kind) for item in own)


COMMANDS = (
    Command(
        "Plates",
        QT_TRANSLATE_NOOP("BendTorsion_Plates", "Plates"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Plates",
            "Cut the selected members into plates, or edit the joints of each face",
        ),
        "B, P",
        plates,
        ("Member", "PlateSet"),
        _is_cut_or_one,
    ),
    Command(
        "Pieces",
        QT_TRANSLATE_NOOP("BendTorsion_Pieces", "Delivery pieces"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Pieces", "Where the member is divided into pieces for transport and site"
        ),
        "B, I",
        pieces,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "Diaphragms",
        QT_TRANSLATE_NOOP("BendTorsion_Diaphragms", "Diaphragms"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Diaphragms", "Diaphragms and end plates of the selected member"
        ),
        "B, D",
        diaphragms,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "Openings",
        QT_TRANSLATE_NOOP("BendTorsion_Openings", "Openings"),
        QT_TRANSLATE_NOOP("BendTorsion_Openings", "Holes and slots in the faces of the member"),
        "B, 3",
        openings,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "FaceMarks",
        QT_TRANSLATE_NOOP("BendTorsion_FaceMarks", "Marks on faces"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_FaceMarks", "Punches, lines and texts marked on the faces of the member"
        ),
        "B, 4",
        face_marks,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "Welds",
        QT_TRANSLATE_NOOP("BendTorsion_Welds", "Welds"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Welds",
            "Preparation, place and tests of seams and joints that differ from the rule pack",
        ),
        "B, 5",
        welds,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "Splits",
        QT_TRANSLATE_NOOP("BendTorsion_Splits", "Split editor"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Splits",
            "Drag the joints of each face on the face laid flat, held against the rules at once",
        ),
        "B, J",
        splits,
        ("Member", "PlateSet"),
        _has_one,
    ),
    Command(
        "Node",
        QT_TRANSLATE_NOOP("BendTorsion_Node", "Node"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_Node",
            "Where the second selected member ends on the first; the node the two have, or the one"
            " selected",
        ),
        "B, 6",
        node,
        ("Member", "PlateSet", "Node"),
        _has_node,
    ),
    Command(
        "Development",
        QT_TRANSLATE_NOOP("BendTorsion_Development", "Development"),
        QT_TRANSLATE_NOOP("BendTorsion_Development", "Lay the plates of the selected members flat"),
        "B, V",
        development,
        ("Member", "PlateSet", "Unfold"),
        lambda given: _is_open(given, "Unfold"),
    ),
    Command(
        "AssemblyBed",
        QT_TRANSLATE_NOOP("BendTorsion_AssemblyBed", "Assembly bed"),
        QT_TRANSLATE_NOOP(
            "BendTorsion_AssemblyBed",
            "What the pieces of the selected members lie on while they are put together",
        ),
        "B, B",
        assembly_bed,
        ("Member", "PlateSet", "AssemblyBed"),
        lambda given: _is_open(given, "AssemblyBed"),
    ),
)
