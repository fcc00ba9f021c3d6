# SPDX-License-Identifier: LGPL-2.1-or-later
"""Containers that are moved, filled and emptied leave nothing where it was: what is built is where
its sources are in the document, in every output."""

import FreeCAD
import Part
import pytest

from BendTorsionWB import make, make_files
from BendTorsionWB.document_export import records_of
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.solid_files import named_solids

UP = FreeCAD.Placement(FreeCAD.Vector(100, 200, 700), FreeCAD.Rotation())
TURNED = FreeCAD.Placement(FreeCAD.Vector(0, 0, 300), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 20))
SOURCES = ("Roof", "Line", "Wall")
OURS = ("Surface", "Axis", "Member", "PlateSet")
FILLED = {
    "sources": SOURCES,
    "everything": (*SOURCES, "SectionSpec", *OURS),
    "plates": ("PlateSet",),
}


def plane_feature(document, name, base, rotation):
    made = document.addObject("Part::Feature", name)
    made.Shape = Part.makePlane(9000, 8000, FreeCAD.Vector(-4500, -4000, 0))
    made.Placement = FreeCAD.Placement(FreeCAD.Vector(*base), rotation)
    return made


@pytest.fixture
def model(document):
    document.UndoMode = 1
    upright = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), 90)
    roof = plane_feature(document, "Roof", (0, 0, 0), FreeCAD.Rotation())
    wall = plane_feature(document, "Wall", (2500, 0, 0), upright)
    line = document.addObject("Part::Feature", "Line")
    line.Shape = Part.makeLine(FreeCAD.Vector(-2000, 0, 0), FreeCAD.Vector(2400, 100, 0))
    surface = make.make_surface(document, "Ground", face=(roof, "Face1"))
    axis = make.make_axis(document, "A", surface, edge=(line, "Edge1"))
    section = make.make_section(document, "B", h=500, b=400, t=12)
    cut = {"kind": "surface", "face": (wall, "Face1")}
    member = make.make_member(document, "M1", axis, [section], end_cut=cut)
    make.make_plates(document, member)
    document.recompute()
    assert {obj.Status for obj in ours(document)} == {"ok"}
    return document


def ours(document):
    return [obj for obj in document.Objects if hasattr(obj, "BT_Type")]


def corners(obj):
    """The vertices of an object's shape in the document, as FreeCAD shows them."""
    place = obj.getGlobalPlacement().multiply(obj.Placement.inverse())
    return [tuple(round(x, 5) + 0.0 for x in place.multVec(v.Point)) for v in obj.Shape.Vertexes]


def figures(document):
    return {name: (obj.Status, corners(obj)) for name in OURS for obj in [document.getObject(name)]}


def check_up_to_date(document, told):
    """Nothing changes when everything is computed anew, and the files have what is seen."""
    document.recompute()
    before = figures(document)
    for obj in document.Objects:
        obj.touch()
    document.recompute()
    after = figures(document)
    assert [name for name in OURS if before[name] != after[name]] == [], told
    assert not any(obj.Proxy.mustExecute(obj) for obj in ours(document))
    plates = document.PlateSet
    if plates.Status != "ok":
        return
    written = [v.Point for one in named_solids(plates) for v in one.solid.Vertexes]
    seen = [FreeCAD.Vector(*point) for point in corners(plates)]
    assert len(written) == len(seen), told
    assert max((a - b).Length for a, b in zip(written, seen, strict=True)) < 1e-4, told


@pytest.mark.parametrize("filled", FILLED)
def test_whatever_is_done_with_a_container_everything_follows(model, filled):
    put = [model.getObject(name) for name in FILLED[filled]]
    part, outer = model.addObject("App::Part", "Inner"), model.addObject("App::Part", "Outer")
    model.recompute()

    def fill(placed):
        part.Placement = placed
        part.Group = put

    steps = {
        "dragged into a placed one": lambda: fill(UP),
        "moved": lambda: setattr(part, "Placement", TURNED),
        "put into one that moves": lambda: (outer.addObject(part), setattr(outer, "Placement", UP)),
        "emptied": lambda: setattr(part, "Group", []),
    }
    first = figures(model)
    for told, step in steps.items():
        step()
        check_up_to_date(model, f"{filled} {told}")
    assert figures(model) == first


def test_plates_are_where_their_curve_is(model):
    low = model.PlateSet.Shape.BoundBox.ZMin
    part = model.addObject("App::Part", "Part")
    part.Group = [model.getObject(name) for name in (*SOURCES, *OURS)]
    for height in (700.0, -50.0):
        part.Placement.Base.z = height
        model.recompute()
        assert min(z for _, _, z in corners(model.PlateSet)) == pytest.approx(low + height)
        solids = Part.Compound([one.solid for one in named_solids(model.PlateSet)])
        assert solids.BoundBox.ZMin == pytest.approx(low + height)


def test_an_export_alone_sees_that_a_container_was_moved(model):
    part = model.addObject("App::Part", "Part")
    part.Group = [model.getObject(name) for name in SOURCES]
    make.make_unfold(model, model.PlateSet)
    model.recompute()
    part.Placement = UP
    (record,) = records_of(model).records.values()
    points = [FreeCAD.Vector(*map(float, p.xyz)) for one in record.plates for p in one.points]
    solids = Part.Compound([one.solid for one in named_solids(model.PlateSet)])
    box = solids.BoundBox
    assert box.Center.z == pytest.approx(UP.Base.z, abs=1.0)
    box.enlarge(0.01)
    assert points and all(box.isInside(point) for point in points)


def test_moved_before_it_was_saved_and_taken_back(model, tmp_path):
    part = model.addObject("App::Part", "Part")
    part.Group = [model.Line, model.Roof]
    model.recompute()
    first = figures(model)
    model.openTransaction("move")
    part.Placement = UP
    model.commitTransaction()
    model.recompute()
    moved = figures(model)
    assert moved != first
    model.undo()
    model.recompute()
    assert figures(model) == first
    part.Placement = UP
    model.saveAs(str(tmp_path / "moved.FCStd"))
    opened = FreeCAD.openDocument(str(tmp_path / "moved.FCStd"), hidden=True)
    opened.recompute()
    assert figures(opened) == moved
    check_up_to_date(opened, "opened")


def test_links_to_shapes_are_read_where_they_show_them(model):
    links = {}
    for name in SOURCES:
        links[name] = model.addObject("App::Link", f"{name}Link")
        links[name].LinkedObject = model.getObject(name)
        links[name].Placement = model.getObject(name).Placement
    model.recompute()
    first = figures(model)
    model.Surface.Source = (links["Roof"], ["Face1"])
    model.Axis.Source = (links["Line"], ["Edge1"])
    model.Member.EndCutFace = (links["Wall"], ["Face1"])
    check_up_to_date(model, "linked")
    assert figures(model) == first
    low = model.PlateSet.Shape.BoundBox.ZMin
    links["Line"].Placement.Base.z += 30.0
    links["Roof"].Placement.Base.z += 30.0
    check_up_to_date(model, "links moved")
    part = model.addObject("App::Part", "Part")
    part.Placement.Base.z = 700.0
    part.Group = list(links.values())
    check_up_to_date(model, "links in a container")
    assert model.PlateSet.Shape.BoundBox.ZMin == pytest.approx(low + 730.0)


@pytest.mark.parametrize("target", [None, "Surface"])
def test_links_to_nothing_and_to_what_is_in_error_are_told(model, target):
    link = model.addObject("App::Link", "L")
    link.LinkedObject = model.Line
    if target is None:
        model.Axis.Source = (link, ["Edge1"])
    else:
        link.LinkedObject = model.Surface
        model.Surface.Source = (model.Roof, ["Face7"])
        model.Member.EndCutFace = (link, ["Face1"])
    model.recompute()
    if target is None:
        link.LinkedObject = None
        model.recompute()
    codes = {finding.code for finding in findings_of(model.Member)}
    assert model.Member.Status.startswith("error") and "internal-error" not in codes
    assert not model.PlateSet.Shape.SubShapes


def test_skipped_recomputes_are_made_before_anything_is_judged_or_written(model, tmp_path):
    make.make_unfold(model, model.PlateSet)
    model.recompute()
    model.RecomputesFrozen = True
    model.SectionSpec.Height = 700.0
    (record,) = records_of(model).records.values()
    assert record.plates and model.RecomputesFrozen
    assert model.PlateSet.Shape.BoundBox.ZLength == pytest.approx(700.0)
    model.SectionSpec.Height = 0.0
    for told in (make_files.check(model), make_files.write_report(model, tmp_path / "r.json")):
        assert told and {finding.severity for finding in told} == {"error"}
        model.SectionSpec.touch()
    assert model.RecomputesFrozen and not model.PlateSet.Shape.SubShapes


def test_an_object_that_an_undo_took_out_asks_for_nothing(model):
    """FreeCAD's window asks it all the same."""
    model.openTransaction("one more")
    axis = make.make_axis(model, "More", model.Surface, [(0, 0, 0), (1000, 0, 0), (2000, 9, 0)])
    model.commitTransaction()
    proxy = axis.Proxy
    assert not proxy.mustExecute(axis)
    model.undo()
    assert proxy.mustExecute(axis) is False
