# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is built in its place stays there; what is laid beside the model may be moved."""

import FreeCAD
import Part
import pytest

from BendTorsionWB import make


@pytest.fixture
def built(document):
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A", ground, ((0, 0, 0), (6000, 500, 0)))
    section = make.make_section(document, "B", h=500, b=400, t=12)
    member = make.make_member(document, "M1", axis, [section])
    plates = make.make_plates(document, member)
    patterns = make.make_unfold(document, plates)
    document.recompute()
    return {"surface": ground, "axis": axis, "member": member, "plates": plates}, patterns


@pytest.mark.parametrize("kind", ["surface", "axis", "member", "plates"])
@pytest.mark.parametrize("by", ["script", "expression", "shape"])
def test_what_is_built_in_its_place_cannot_be_moved(document, built, kind, by):
    moved, _ = built
    obj = moved[kind]
    before = {name: one.Shape.BoundBox.Center for name, one in moved.items()}
    up = FreeCAD.Placement(FreeCAD.Vector(0, 0, 1000), FreeCAD.Rotation(0, 0, 30))
    if by == "script":
        obj.Placement = up
    elif by == "expression":
        obj.setExpression("Placement.Base.z", "1 m")
    else:
        shape = obj.Shape.copy()
        shape.Placement = up
        obj.Shape = shape
        obj.touch()
    document.recompute()
    for name, one in moved.items():
        assert one.Status == "ok" and one.Placement.isIdentity()
        assert (one.Shape.BoundBox.Center - before[name]).Length < 1e-6


@pytest.mark.parametrize("by", ["origin", "source"])
def test_a_surface_is_seen_where_it_is(document, by):
    """Its shape may have a place of its own; moved away from there it comes back."""
    if by == "origin":
        ground = make.make_surface(document, "Ground", "sphere", r=2000.0, origin=(0, 0, 5000))
    else:
        roof = document.addObject("Part::Feature", "Roof")
        roof.Shape = Part.makePlane(8000, 4000, FreeCAD.Vector(-4000, -2000, 0))
        roof.Placement.Base.z = 5000
        ground = make.make_surface(document, "Ground", face=(roof, "Face1"))
    document.recompute()
    for _ in range(2):
        box = ground.Shape.BoundBox
        assert ground.Status == "ok" and abs(box.Center.x) + abs(box.Center.y) < 1.0
        assert box.Center.z == pytest.approx(5000.0, abs=1.0)
        ground.Placement = FreeCAD.Placement(FreeCAD.Vector(300, 0, 700), FreeCAD.Rotation())
        document.recompute()


def test_patterns_lie_where_they_are_put(document, built):
    _, patterns = built
    before = patterns.Shape.BoundBox.Center
    patterns.Placement.Base += FreeCAD.Vector(0, 0, 1000)
    document.recompute()
    away = patterns.Shape.BoundBox.Center - before
    assert (away - FreeCAD.Vector(0, 0, 1000)).Length < 1e-6
