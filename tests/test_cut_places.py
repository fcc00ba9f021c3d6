# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cuts where another axis crosses, or nearest to a point, in a document."""

import FreeCAD
import numpy as np
import pytest

from BendTorsionWB import make


@pytest.fixture
def model():
    document = FreeCAD.newDocument("cuts", hidden=True)
    dome = make.make_surface(document, "Dome", "sphere", r=20000)
    along = np.radians(np.linspace(0, 50, 9))
    first = [(20000 * np.sin(a), 0, 20000 * np.cos(a)) for a in along]
    # A great circle that crosses the first axis 20° from its start, at right angles.
    tilt = np.radians(20.0)
    x, z = np.array([np.sin(tilt), 0, np.cos(tilt)]), np.array([0, 1.0, 0])
    second = [20000 * (np.cos(a) * x + np.sin(a) * z) for a in np.radians(np.linspace(-15, 15, 7))]
    one = make.make_axis(document, "A1", dome, first)
    other = make.make_axis(document, "A2", dome, second)
    sections = [make.make_section(document, f"B{h}", h=h, b=h, t=16) for h in (800, 600)]
    member = make.make_member(
        document, "M1", one, sections, [{}, {"cut_by": "crossing", "cut_axis": other}]
    )
    document.recompute()
    yield document, one, other, member
    FreeCAD.closeDocument(document.Name)


def cut(member) -> float:
    return float(member.Zones[0].split()[2])


def test_a_cut_follows_the_crossing_axis_and_its_offset(model):
    document, _, other, member = model
    assert member.Status == "ok"
    assert cut(member) == pytest.approx(20000 * np.radians(20), abs=0.01)
    member.CutOffset2 = -250
    document.recompute()
    assert cut(member) == pytest.approx(20000 * np.radians(20) - 250, abs=0.01)
    other.Points = [p + FreeCAD.Vector(-2000, 0, 0) for p in other.Points]
    document.recompute()
    assert cut(member) < 20000 * np.radians(20) - 1000


def test_a_cut_nearest_to_a_point(model):
    document, one, _, member = model
    member.CutBy2 = "point"
    member.CutPoint2 = one.Points[4] + FreeCAD.Vector(0, 300, 0)
    document.recompute()
    assert cut(member) == pytest.approx(20000 * np.radians(25), abs=0.01)


def test_a_missing_crossing_is_an_error_and_comes_back(model):
    document, _, other, member = model
    member.CutAxis2 = None
    document.recompute()
    assert member.Status.startswith("error") and not member.Shape.Solids
    member.CutAxis2 = other
    document.recompute()
    assert member.Status == "ok" and len(member.Shape.Solids) == 1


def test_crossings_are_control_points(model):
    document, one, other, _ = model
    one.CrossingAxes = [other]
    document.recompute()
    assert one.CrossingPlaces == pytest.approx([20000 * np.radians(20)], abs=0.01)
    assert one.CrossingPoints[0].Length == pytest.approx(20000, abs=0.005)


def test_points_on_a_large_section_are_near_however_far_its_axis_is(model):
    """A section of 2.5 m held by its corner reaches 3.5 m; a point beside it is refused."""
    document, one, _, member = model
    for k in (1, 2):
        getattr(member, f"Section{k}").Height = getattr(member, f"Section{k}").Breadth = 2500.0
        setattr(member, f"Align{k}", "top-left")
    member.CutBy2 = "point"
    out = FreeCAD.Vector(one.Points[4]).normalize()
    away = FreeCAD.Vector(0, 1, 0)
    # By the left end of the outer face, the opposite corner is 2.5 m to the right and inward.
    corner = one.Points[4] - 2450.0 * out - 2450.0 * away
    member.CutPoint2 = corner
    document.recompute()
    assert member.Status == "ok", member.Findings
    assert cut(member) == pytest.approx(20000 * np.radians(25), abs=1.0)
    assert make.add_cut(member, tuple(corner - 100.0 * out)) in (2, 3)
    member.CutPoint2 = one.Points[4] + 5000.0 * out
    document.recompute()
    assert "cut-point-far" in member.Findings[0]
