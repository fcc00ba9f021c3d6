# SPDX-License-Identifier: LGPL-2.1-or-later
"""No failing edit of a node, of a member at it or of a shape drawn by hand leaves anything old."""

import FreeCAD
import Part  # noqa: F401
import pytest
from test_never_stale import (
    KINDS,
    NAN,
    PAGES,
    SHEETS,
    check_nothing_stale,
    edited_and_back,
    export,
    figures,
    in_error,
    of_kind,
    ours,
)

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.objects.repair import KINDS as ALL_KINDS
from BendTorsionWB.sheets.pdf import start_qt

LINES = {
    "X": ((-2500, 0, 0), (2500, 0, 0), 600),
    "Y": ((-1250, -2165, 0), (0, 0, 0), 300),
    "Z": ((1250, -2165, 0), (0, 0, 0), 300),
}


def meeting(document, names, sheets):
    """Straight members whose branches end on X, with plates, and with patterns and sheets."""
    plane = make.make_surface(document, "Ground", "plane")
    members, plates, drawn = {}, {}, []
    for name in names:
        start, end, height = LINES[name]
        section = make.make_section(document, f"S-{name}", "box1", h=height, b=260, t=10)
        axis = make.make_axis(document, f"A-{name}", plane, [start, end], fit="keep")
        members[name] = make.make_member(document, name, axis, [section])
        plates[name] = make.make_plates(document, members[name])
    for name in reversed(names[1:]):
        make.make_node(
            document,
            members["X"],
            members[name],
            "K1",
            label=f"K1 {name}",
            plates=[plates["X"], plates[name]],
            ends_on=[members[other] for other in names[1:] if other < name],
        )
    for name in names if sheets else ():
        patterns = make.make_unfold(document, plates[name])
        drawn.append(make.make_sheets(document, patterns, plate_pages=False))
    if sheets:
        make.make_arrangement(document, drawn)
        make.make_node_sheets(document, drawn)
    document.UndoMode = 1
    document.recompute()
    told = [f.line() for obj in ours(document) for f in findings_of(obj) if f.severity == "error"]
    assert not told
    return document


@pytest.fixture
def with_sheets(document):
    start_qt()
    return meeting(document, "XY", True)


def test_every_kind_of_object_there_is_has_its_inputs_edited():
    assert {*KINDS, *SHEETS, *PAGES, "Node", "NodeSheets"} == set(ALL_KINDS)


def test_every_input_of_a_node_fails_and_heals(document):
    meeting(document, "XY", False)
    never = edited_and_back(document, "Node")
    assert not never & {"Through", "Other", "Place", "Gap", "StubLength"}


def test_every_input_of_sheets_of_nodes_fails_and_heals(with_sheets):
    edited_and_back(with_sheets, "NodeSheets")


@pytest.mark.parametrize(
    ("label", "name", "value"),
    [("S-X", "Breadth", 1.0), ("S-Y", "Height", 900), ("A-Y", "Points", []), ("K1 Y", "Gap", -5)],
)
def test_what_fails_at_a_node_empties_both_members_and_all_sheets_and_undo_heals(
    with_sheets, tmp_path, label, name, value
):
    before = figures(with_sheets)
    (obj,) = with_sheets.getObjectsByLabel(label)
    with_sheets.openTransaction("edit")
    setattr(obj, name, value)
    with_sheets.commitTransaction()
    with_sheets.recompute()
    if name == "Gap":
        # FreeCAD takes a length below nothing as nothing.
        assert obj.Gap.Value == 0.0 and not any(map(in_error, ours(with_sheets)))
    else:
        check_nothing_stale(with_sheets, label)
        below = [one for one in ours(with_sheets) if one.BT_Type in ("PlateSet", "NodeSheets")]
        assert len(below) == 3 and all(map(in_error, below))
        with pytest.raises(BendTorsionError):
            export(with_sheets, tmp_path)
    with_sheets.undo()
    with_sheets.recompute()
    assert figures(with_sheets) == before


def test_a_member_that_is_deleted_takes_its_node_along_and_undo_brings_both_back(with_sheets):
    before = figures(with_sheets)
    with_sheets.openTransaction("delete")
    with_sheets.removeObject(with_sheets.getObjectsByLabel("X")[0].Name)
    with_sheets.commitTransaction()
    with_sheets.recompute()
    check_nothing_stale(with_sheets, "member deleted")
    assert in_error(of_kind(with_sheets, "Node")) and in_error(of_kind(with_sheets, "NodeSheets"))
    with_sheets.undo()
    with_sheets.recompute()
    assert figures(with_sheets) == before


def test_a_copy_of_members_with_their_node_follows_its_own_values(document):
    meeting(document, "XY", False)
    other = FreeCAD.newDocument("copy", hidden=True)
    try:
        copied = other.copyObject(ours(document), False)
        other.recompute()
        assert not any(map(in_error, copied))
        by_label = {obj.Label: obj for obj in ours(other)}
        by_label["S-Y"].Height = 900
        other.recompute()
        check_nothing_stale(other, "copy")
        assert in_error(by_label["K1 Y"]) and in_error(by_label["X plates"])
        assert not any(map(in_error, ours(document)))
    finally:
        FreeCAD.closeDocument(other.Name)


def test_a_shape_drawn_by_hand_that_fails_empties_what_stands_on_it(document):
    """An extrusion as the surface, a line as the curve: objects of FreeCAD fail, or are empty."""
    profile = document.addObject("Part::Line", "Profile")
    profile.X1, profile.Y1, profile.X2, profile.Y2 = -6000, 0, 6000, 0
    ground = document.addObject("Part::Extrusion", "Ground")
    ground.Base, ground.DirMode, ground.Dir = profile, "Custom", FreeCAD.Vector(0, 1, 0)
    ground.LengthFwd, ground.LengthRev = 4000, 4000
    curve = document.addObject("Part::Line", "Curve")
    curve.X1, curve.Y1, curve.X2, curve.Y2 = -2000, 300, 2000, 900
    document.recompute()
    surface = make.make_surface(document, "S", face=(ground, "Face1"))
    axis = make.make_axis(document, "A", surface, edge=(curve, "Edge1"))
    section = make.make_section(document, "B", "box1", h=300, b=260, t=10)
    plates = make.make_plates(document, make.make_member(document, "M", axis, [section]))
    document.recompute()
    assert not any(map(in_error, ours(document))), [o.Status for o in ours(document)]
    before = figures(document)
    for obj, name, value in (
        (ground, "Dir", FreeCAD.Vector()),
        (ground, "Base", None),
        (curve, "X2", -2000),
    ):
        kept = getattr(obj, name)
        setattr(obj, name, value)
        if name == "X2":
            curve.Y2 = 300
        document.recompute()
        assert in_error(axis) and in_error(plates) and not plates.Shape.SubShapes, name
        check_nothing_stale(document, name)
        setattr(obj, name, kept)
        curve.Y2 = 900
        document.recompute()
        assert figures(document) == before, name


def test_whoever_uses_an_object_in_error_is_in_error_by_every_kind_of_link(document):
    """What is wrong with the object used is a number without use at the moment: it computes."""
    meeting(document, "XYZ", False)
    found = {obj.Label: obj for obj in ours(document)}
    wall = make.make_surface(document, "Wall", "cylinder", r=4800.0, origin=(-2500, 0, 0))
    found["X"].EndCut, found["X"].EndCutFace = "surface", (wall, [""])
    curve = make.make_axis(document, "Curve", found["Ground"], edge=(found["A-X"], ""))
    found["A-Y"].CrossingAxes = [found["A-X"]]
    document.recompute()
    assert not any(map(in_error, ours(document))), [o.Status for o in ours(document)]
    before = figures(document)
    for obj, name, users in (
        (wall, "a", (found["X"],)),
        (found["A-X"], "ShowScale", (curve, found["A-Y"], found["X"])),
        (found["Y"], "StartCutOffset", (found["K1 Z"], found["K1 Y"], found["Z plates"])),
        (found["K1 Z"], "StubLength", (found["X plates"], found["Z plates"])),
    ):
        kept = getattr(obj, name)
        setattr(obj, name, NAN)
        document.recompute()
        assert in_error(obj) and all(map(in_error, users)), (obj.Label, name)
        check_nothing_stale(document, f"{obj.Label}.{name}")
        setattr(obj, name, kept)
        document.recompute()
        assert figures(document) == before, (obj.Label, name)


def test_a_link_in_the_place_of_an_object_is_refused_by_name(with_sheets):
    """By any property that links; what FreeCAD's links show is shown, and computed elsewhere."""
    before = figures(with_sheets)
    link = with_sheets.addObject("App::Link", "L")
    tried = set()
    for obj in [obj for obj in ours(with_sheets) if obj.BT_Type not in PAGES]:
        for declared in obj.Proxy.declared(obj):
            kept = None if declared.output else getattr(obj, declared.name, None)
            if not kept or declared.type not in ("App::PropertyLink", "App::PropertyLinkList"):
                continue
            many = isinstance(kept, list)
            link.LinkedObject = kept[0] if many else kept
            link.recompute()
            setattr(obj, declared.name, [link] if many else link)
            obj.recompute()
            told = [f.code for f in findings_of(obj) if f.severity == "error"]
            assert told == ["link-kind"], f"{obj.BT_Type}.{declared.name}: {obj.Status}"
            setattr(obj, declared.name, kept)
            obj.recompute()
            tried.add(obj.BT_Type)
    assert tried == {"Axis", "Member", "PlateSet", "Unfold", "Node", "SheetSet"} | {
        "ArrangementSet",
        "NodeSheets",
    }
    with_sheets.removeObject(link.Name)
    with_sheets.recompute()
    assert figures(with_sheets) == before
