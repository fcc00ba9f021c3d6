# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a finding is about in the model: the edge, the end or the face it names, and the place."""

import FreeCAD
import Part
import pytest

from BendTorsionWB import make
from BendTorsionWB.core.finding import warning
from BendTorsionWB.gui.finding_places import places_of

LENGTH, HEIGHT, BREADTH = 9000.0, 500.0, 400.0


@pytest.fixture(scope="module")
def model():
    """A straight box along x; its axis in its middle."""
    document = FreeCAD.newDocument("places", hidden=True)
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (LENGTH, 0, 0)])
    section = make.make_section(document, "B", h=HEIGHT, b=BREADTH, t=12)
    member = make.make_member(document, "M1", axis, [section])
    plates = make.make_plates(document, member, {"top": [3000, 6000], "left": [2500]})
    plates.EdgeSeams, plates.EdgePreps = ["TL", "T1/T2"], ["", ""]
    plates.EdgeStarts, plates.EdgeEnds = ["3500", ""], ["4500", ""]
    plates.EdgePlaces, plates.EdgeTests = ["field", ""], ["", ""]
    document.recompute()
    assert plates.Status == "ok"
    yield document
    FreeCAD.closeDocument(document.Name)


def marked(document, name, position):
    """The faces marked, and the place, of a finding on an object of that name or mark."""
    obj = document.getObjectsByLabel("M1")[0]
    about, place = places_of(document, obj, warning("c", name, "m", position=position))
    return [(item, sub, item.Shape.getElement(sub) if sub else None) for item, sub in about], place


def bounds(face):
    box = face.BoundBox
    return [round(v) for v in (box.XMin, box.XMax, box.YMin, box.YMax, box.ZMin, box.ZMax)]


def test_a_long_edge_is_marked_and_not_the_whole_plate(model):
    [(plates, name, face)], place = marked(model, "M1-L2", "first top, 4000 to 5000 mm on the axis")
    assert plates.Label == "M1 plates" and name.startswith("Face")
    # The left web, its upper narrow face.
    assert bounds(face) == [2500, 9000, 188, 200, 250, 250]
    assert face.distToShape(Part.Vertex(place))[0] < 1e-6
    assert place.x == pytest.approx(4500.0) and place.z == pytest.approx(250.0)


@pytest.mark.parametrize(("end", "x"), [("start E-1", 3000), ("end E-2", 6000)])
def test_an_end_is_marked(model, end, x):
    [(_, _, face)], _ = marked(model, "M1-T2", f"{end}, 0 to 90 mm along it")
    assert bounds(face)[:2] == [x, x]


def test_a_plate_without_more_is_marked_by_its_outer_face(model):
    [(_, _, face)], place = marked(model, "M1-T2", "")
    assert bounds(face)[:2] == [3000, 6000] and bounds(face)[4:] == [250, 250] and place is None


def test_a_face_of_a_member_is_marked_where_the_place_is(model):
    found, place = marked(model, "M1", "face top, s = 7000 mm")
    assert [bounds(face)[:2] for _, _, face in found] == [[6000, 9000]]
    assert place.x == pytest.approx(7000.0)
    assert len(marked(model, "M1", "face top")[0]) == 3


def test_rows_of_edges_mark_what_they_join(model):
    """The seam with its plates beside the stretch of the row; the joint with two ends."""
    found, place = marked(model, "M1", "edge 1")
    assert sorted(bounds(face)[:2] for _, _, face in found) == [[2500, 9000], [3000, 6000]]
    assert place.x == pytest.approx(4000.0)
    found, place = marked(model, "M1", "edge 2")
    assert [bounds(face)[:2] for _, _, face in found] == [[3000, 3000]] * 2 and place is None


def test_the_place_on_an_axis_is_the_middle_of_a_stretch(model):
    [(axis, name, _)], place = marked(model, "A1", "s = 1000 to 3000 mm")
    assert (axis.Label, name) == ("A1", "") and place.x == pytest.approx(2000.0)
    [(axis, _, _)], place = marked(model, "A1", "x, y, z = 10, -20, 30 mm")
    assert tuple(place) == (10.0, -20.0, 30.0)


def test_all_members_a_finding_names_are_marked(model):
    about, _ = places_of(model, model.Objects[0], warning("c", "M1, A1", "m"))
    assert {item.Label for item, _ in about} == {"M1", "A1"}
