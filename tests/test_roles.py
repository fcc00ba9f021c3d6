# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces and edges by role: the parts named are where their names say, cut or not."""

import FreeCAD
import numpy as np
import Part
import pytest

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import plate_set
from BendTorsionWB.shapes import roles

R = 20000.0


@pytest.fixture(scope="module")
def model():
    document = FreeCAD.newDocument("roles", hidden=True)
    surface = make.make_surface(document, "Hall", "sphere", r=R)
    angle = np.linspace(0.0, 0.5, 5)
    points = R * np.column_stack(
        [np.cos(angle), np.sin(angle) * np.cos(0.3), np.sin(angle) * np.sin(0.3)]
    )
    axis = make.make_axis(document, "A1", surface, points)
    big = make.make_section(document, "S8", "box1", h=800, b=700, t=20, gap1=3)
    small = make.make_section(document, "S6", "box1", h=600, b=500, t=20, gap1=3)
    beam = make.make_section(document, "I4", "i", h=400, b=300, t=16, t_web=10)
    member = make.make_member(document, "M1", axis, [big, small], [{}, {"cut": 4000.0}])
    plates = make.make_plates(document, member, {"top": [0.6], "left": [0.3, 0.8]})
    open_member = make.make_member(document, "M2", axis, [beam])
    open_plates = make.make_plates(document, open_member)
    document.recompute()
    for obj in (member, plates, open_member, open_plates):
        assert obj.Status == "ok", obj.Status
    yield {"member": member, "plates": plates, "open": open_member, "open plates": open_plates}
    FreeCAD.closeDocument(document.Name)


def rails_at(plate, s, outer):
    """First and second edge (2, 3) of a plate's outer or inner surface at a station."""
    rails = plate.rails.outer if outer else plate.rails.inner
    return rails([s])[0].reshape(2, 3)


def distance(shape, point):
    return shape.distToShape(Part.Vertex(*np.asarray(point, float).tolist()))[0]


@pytest.mark.parametrize("which", ["plates", "open plates"])
def test_faces_and_edges_of_plates_lie_where_their_roles_say(model, which):
    obj = model[which]
    for item in plate_set.value(obj).plates:
        plate = item.plate
        s = plate.start + 0.37 * (plate.end - plate.start)
        (a, b), (c, d) = rails_at(plate, s, True), rails_at(plate, s, False)
        first, second = plate.edges
        places = {
            "outer": (a + b) / 2,
            "inner": (c + d) / 2,
            f"edge {first}": (a + c) / 2,
            f"edge {second}": (b + d) / 2,
            f"arris outer {first}": a,
            f"arris outer {second}": b,
            f"arris inner {first}": c,
            f"arris inner {second}": d,
        }
        for name, at in (("start", plate.start), ("end", plate.end)):
            (a, b), (c, d) = rails_at(plate, at, True), rails_at(plate, at, False)
            places[f"end {name}"] = (a + b + c + d) / 4
            places[f"arris {name} outer"] = (a + b) / 2
            places[f"arris {name} inner"] = (c + d) / 2
            places[f"arris {name} {first}"] = (a + c) / 2
            places[f"arris {name} {second}"] = (b + d) / 2
        for number, fold in enumerate(plate.rails.outer_folds, start=1):
            a, b = rails_at(plate, fold, True)
            places[f"fold {number} outer"] = (a + b) / 2
        for role, point in places.items():
            names = make.sub_elements(obj, plate.mark, role)
            parts = [obj.Shape.getElement(name) for name in names]
            assert min(distance(part, point) for part in parts) < 0.005, (plate.mark, role)
            kind = "Face" if role.split()[0] in ("outer", "inner", "edge", "end") else "Edge"
            assert all(name.startswith(kind) for name in names)
            for name in names:
                mark, own = make.role_of(obj, name)
                assert mark == plate.mark and roles.base(own) == role


def test_every_part_has_one_role_and_the_pieces_between_folds_are_counted(model):
    obj = model["plates"]
    table = make.roles_of(obj)
    assert len(table) == len(obj.Shape.Faces) + len(obj.Shape.Edges)
    assert len(set(table.items())) == len(set(table.values())) == len(table)
    folded = next(i.plate for i in plate_set.value(obj).plates if len(i.plate.folds) == 2)
    names = make.sub_elements(obj, folded.mark, "outer")
    assert [make.role_of(obj, name)[1] for name in names] == ["outer 1", "outer 2", "outer 3"]
    assert make.sub_elements(obj, folded.mark, "outer 2") == names[1:2]
    middles = [obj.Shape.getElement(name).CenterOfMass for name in names]
    start = rails_at(folded, folded.start, True).mean(axis=0)
    far = [np.linalg.norm(np.array(m) - start) for m in middles]
    assert far == sorted(far)


def test_the_member_s_skin_is_named_by_its_faces_and_corners(model):
    obj = model["member"]
    member = member_object.value(obj).member
    corners = member.corners(0.0, member.length)([2000.0])[0].reshape(4, 3)
    for j, (corner, face) in enumerate(
        zip(("TL", "TR", "BR", "BL"), ("top", "right", "bottom", "left"), strict=True)
    ):
        [edge] = make.sub_elements(obj, "skin 1", f"arris {corner} 1")
        assert distance(obj.Shape.getElement(edge), corners[j]) < 0.005
        faces = make.sub_elements(obj, "skin 1", face)
        middle = (corners[j] + corners[(j + 1) % 4]) / 2
        assert distance(obj.Shape.getElement(faces[0]), middle) < 0.005
    assert len(make.sub_elements(obj, "skin 1", "end start")) == 1
    assert make.sub_elements(obj, "skin 1", "fold 1 top")[0].startswith("Edge")


def test_an_open_member_is_named_strip_by_strip(model):
    obj = model["open"]
    for mark in ("top", "bottom", "web"):
        assert len(make.sub_elements(obj, mark, "outer")) == 1


def test_roles_survive_cuts_that_renumber_everything(model):
    """An end cut off askew, a hole through, a notch at an edge: same names, by geometry."""
    plates = plate_set.value(model["plates"])
    item = next(i for i in plates.plates if len(i.plate.folds) == 2)
    plate = item.plate
    index = model["plates"].Marks.index(plate.mark)
    solid = model["plates"].Shape.Solids[index]
    body = roles.plate_body([(p.knots, p.poles) for p in item.skin], plate.edges)
    before = dict(zip(roles.face_roles(solid, body), solid.Faces, strict=True))

    def at(s):
        (a, b), (c, d) = rails_at(plate, s, True), rails_at(plate, s, False)
        return (a + b + c + d) / 4, (b - a) / np.linalg.norm(b - a), (c - a) / np.linalg.norm(c - a)

    middle, _, through = at(plate.start + 1500.0)
    hole = Part.makeCylinder(
        60.0, 200.0, FreeCAD.Vector(*(middle - 100.0 * through)), FreeCAD.Vector(*through)
    )
    end, across, _ = at(plate.start + 250.0)
    box = Part.makeBox(2000, 4000, 2000, FreeCAD.Vector(-2000, -2000, -1000))
    along = (
        rails_at(plate, plate.start + 251.0, True)[0]
        - rails_at(plate, plate.start + 250.0, True)[0]
    )
    along = along / np.linalg.norm(along) + 0.3 * across
    box.Placement = FreeCAD.Placement(
        FreeCAD.Vector(*end),
        FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(*along)),
    )
    cut = solid.cut(hole).cut(box).Solids[0]
    faces = roles.face_roles(cut, body)
    assert sorted(faces) == sorted([*before, "opening"])
    by_role = dict(zip(faces, cut.Faces, strict=True))
    for role in before:
        if role not in ("end start", "outer 1", "inner 1", "edge left 1", "edge right 1"):
            assert by_role[role].Area == pytest.approx(before[role].Area, rel=1e-6)
    assert by_role["outer 1"].Area < before["outer 1"].Area
    # The askew end is where the old one was cut off, and has another direction.
    assert distance(by_role["end start"], end) < 1e-3
    assert by_role["opening"].Area == pytest.approx(np.pi * 120.0 * plate.thickness, rel=1e-2)
    edges = roles.edge_roles(cut, faces, body)
    named = {roles.base(edge) for edge in edges}
    assert {"opening outer", "opening inner", "arris start outer", "fold 1 outer"} <= named
    assert len(set(edges)) == len(edges)


def test_a_role_or_mark_that_is_none_is_refused_with_what_there_is(model):
    with pytest.raises(BendTorsionError) as raised:
        make.sub_elements(model["plates"], "M1-T1", "lid")
    [finding] = raised.value.findings
    assert finding.code == "role-unknown" and "end start" in finding.mend
    with pytest.raises(BendTorsionError) as raised:
        make.sub_elements(model["plates"], "M9-T1", "outer")
    assert "M1-T1" in raised.value.findings[0].mend


def test_flat_parts_have_sides_edges_and_openings():
    from BendTorsionWB.core.plates.flat_plate import FlatPlate
    from BendTorsionWB.core.sections.section import STEEL
    from BendTorsionWB.shapes.flat_solid import flat_solid

    turn = FreeCAD.Rotation(FreeCAD.Vector(1, 2, 3), 50)
    frame = np.eye(4)
    for k, axis in enumerate(((1, 0, 0), (0, 1, 0), (0, 0, 1))):
        frame[:3, k] = turn.multVec(FreeCAD.Vector(*axis))
    frame[:3, 3] = 1000.0, 2000.0, 3000.0
    outline = np.array([(-300, -200, 0), (300, -200, 0), (300, 200, 0), (-300, 200, 0)], float)
    hole = np.array([(-80, 0, -1), (80, 0, -1)], float)
    flat = FlatPlate("M1", "M1-D1", "diaphragm", "D", 1, 16.0, STEEL, frame, outline, 0.0, (hole,))
    solid = flat_solid(flat)
    faces = roles.flat_face_roles(solid, flat)
    by_role = dict(zip(faces, solid.Faces, strict=True))
    for name, z in (("side start", -8.0), ("side end", 8.0)):
        place = flat.in_model(np.array([[200.0, 150.0]]), z)[0]
        assert distance(by_role[name], place) < 1e-6
    for k, middle in enumerate(((0, -200), (300, 0), (0, 200), (-300, 0)), start=1):
        assert distance(by_role[f"edge {k}"], flat.in_model(np.array([middle], float))[0]) < 1e-6
    assert [roles.base(face) for face in faces].count("opening") == len(faces) - 6 >= 1
    edges = {roles.base(edge) for edge in roles.edge_roles(solid, faces)}
    assert {"opening start", "opening end", "arris start 1", "arris end 4", "corner 1 2"} <= edges
    assert {roles.base(name) for name in ("arris start 1", "corner 1 2")} <= edges
