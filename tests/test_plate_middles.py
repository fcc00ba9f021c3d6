# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where marks stand: on the outer face of each plate, pointing away from its member."""

import FreeCAD
import numpy as np
import Part
import pytest

from BendTorsionWB import make
from BendTorsionWB.core import detailing
from BendTorsionWB.core.colour_scale import ColourScale
from BendTorsionWB.objects import plate_set


@pytest.fixture(scope="module")
def plates():
    """The plates of a member with transitions, lanes and a diaphragm, on an ellipsoid."""
    document = FreeCAD.newDocument("middles", hidden=True)
    hall = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    xs = (-9000.0, -4000.0, 1000.0, 5000.0, 9000.0)
    points = [(x, 3000.0, 20000 * (1 - (x / 40000) ** 2 - 0.01) ** 0.5) for x in xs]
    axis = make.make_axis(document, "A", hall, points)
    sections = [make.make_section(document, f"B{h}", h=h, b=700, t=16) for h in (600, 800)]
    member = make.make_member(document, "M1", axis, sections, [{}, {"cut": 8000}])
    made = make.make_plates(
        document,
        member,
        {"top": [6500, 12500], "left": [5000]},
        lanes={"bottom": [0.5]},
        diaphragms=[{"s": 4000.0, "t": 12.0}],
    )
    document.recompute()
    assert made.Status == "ok", made.Status
    yield made
    FreeCAD.closeDocument(document.Name)


def test_each_mark_stands_on_the_outer_face_of_its_plate(plates):
    """The kernel measures its distance from the face that plays that role."""
    seen = 0
    for mark, place, outward in zip(
        plates.Marks, plates.PlateMiddles, plates.PlateDirections, strict=True
    ):
        if "-D" in mark:
            continue
        names = make.sub_elements(plates, mark, "outer")
        faces = [plates.Shape.getElement(name) for name in names]
        vertex = Part.Vertex(place)
        distance, pairs, _ = min(
            (face.distToShape(vertex) for face in faces), key=lambda item: item[0]
        )
        assert distance < 0.5
        seen += 1
        solid = plates.Shape.Solids[plates.Marks.index(mark)]
        step = 4.0 * outward / outward.Length
        assert solid.isInside(place - step, 0.01, True), mark
        assert not solid.isInside(place + step, 0.01, True), mark
    assert seen == 3 + 2 + 2 + 1


def test_directions_are_those_of_the_flat_patterns_faces(plates):
    """And as long as the plates are wide."""
    record = detailing.record_of(plate_set.value(plates))
    laid = {plate.mark: plate for plate in record.plates}
    for mark, outward in zip(plates.Marks, plates.PlateDirections, strict=True):
        vector = np.array(tuple(outward))
        if "-D" in mark:
            assert np.linalg.norm(vector) == pytest.approx(1.0)
            continue
        normal = laid[mark].placing[2, :3]
        assert vector @ normal / np.linalg.norm(vector) > 0.99
        assert 0.5 * laid[mark].width < np.linalg.norm(vector) < 1.1 * laid[mark].width


def test_plates_in_error_have_no_middles(plates):
    section = plates.Member.Section1
    before = section.Thickness
    section.Thickness = 400.0
    plates.Document.recompute()
    assert plates.PlateMiddles == plates.PlateDirections == []
    section.Thickness = before
    plates.Document.recompute()
    assert len(plates.PlateMiddles) == len(plates.Marks)


def test_a_diaphragms_mark_stands_in_it(plates):
    number = next(k for k, mark in enumerate(plates.Marks) if "-D" in mark)
    solid = plates.Shape.Solids[number]
    assert solid.isInside(plates.PlateMiddles[number], 0.01, True)


def test_several_plate_sets_share_a_scale(plates):
    """Nothing is touched by it; with `none` the colours go."""
    make.colour_by([plates], "thickness")
    assert list(plates.ColourRange) == [12.0, 16.0] and len(plates.Legend) == 2
    assert "Touched" not in plates.State
    dark, light = min(plates.Colours), max(plates.Colours)
    assert plates.Colours[plates.Marks.index("M1-T1")] == light != dark
    make.colour_by([plates], "none")
    assert plates.Colours == plates.Legend == plates.ColourRange == []


@pytest.mark.parametrize("wrong", [[3.0], [16.0, 12.0], [float("nan"), 16.0], [12.0, 14.0, 16.0]])
def test_a_scale_that_is_none_is_refused_until_it_is_one(plates, wrong):
    before = list(plates.Marks)
    plates.ColourBy, plates.ColourRange = "thickness", wrong
    plates.Document.recompute()
    assert "ColourRange" in plates.Status and not plates.Colours and not plates.Shape.SubShapes
    plates.ColourRange = [10.0, 20.0]
    plates.Document.recompute()
    assert plates.Status == "ok" and list(plates.Marks) == before
    # 12 mm lies at a fifth of the scale, 16 at three: as the whole scale tells them.
    whole = ColourScale(10.0, 20.0).colours(np.array([12.0, 16.0]))
    painted = {tuple(round(part, 3) for part in colour[:3]) for colour in plates.Colours}
    assert painted == {tuple(round(part, 3) for part in colour) for colour in whole.tolist()}
    plates.ColourBy, plates.ColourRange = "none", []
    plates.Document.recompute()
