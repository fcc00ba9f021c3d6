# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Axis object: sources, fits, ends, frames, presets and rules; its outputs and errors."""

import json
import math

import FreeCAD
import numpy as np
import Part
import pytest
from exact_axes import curves
from FreeCAD import Vector

from BendTorsionWB import make
from BendTorsionWB.objects.axis import Axis

CURVES = curves()
POINTS = CURVES["E-diag"].points(9, 1)


@pytest.fixture
def hall(document):
    return make.make_surface(document, "Hall", a=40e3, b=30e3, c=20e3)


def codes(obj):
    return [json.loads(text)["code"] for text in obj.Findings]


def line(document, *points):
    feature = document.addObject("Part::Feature", "Line")
    feature.Shape = Part.makePolygon([Vector(*map(float, p)) for p in points])
    return feature


def test_every_property_says_what_it_is(document, hall):
    axis = make.make_axis(document, "A1", hall, POINTS)
    for declared in Axis.PROPERTIES:
        assert declared.tooltip and declared.group
        assert axis.getDocumentationOfProperty(declared.name) == declared.tooltip
        assert axis.getGroupOfProperty(declared.name) == declared.group
        assert ("ReadOnly" in axis.getTypeOfProperty(declared.name)) == declared.output


def test_outputs_are_those_of_the_curve(document, hall):
    axis = make.make_axis(document, "A1", hall, POINTS)
    document.recompute()
    exact = CURVES["E-diag"].axis()
    assert (axis.Status, codes(axis)) == ("ok", [])
    assert axis.Length.Value == pytest.approx(exact.length, abs=0.5)
    assert axis.SurfaceDistanceRMS.Value < 0.003
    radius = 1 / np.linalg.norm(exact.curvature(np.linspace(0, exact.length, 999)), axis=1).max()
    assert axis.MinimumRadius.Value == pytest.approx(radius, rel=0.02)
    truth = math.degrees(CURVES["E-diag"].torsion_to(np.ones(1))[0])
    assert axis.TotalTorsion.Value == pytest.approx(truth, abs=0.01)
    assert 0.1 < axis.MaximumTwist < 1.0
    assert 0.1 < axis.InSurfaceUncertainty.Value < 50
    assert len(axis.ControlPoints) >= 9
    assert axis.ControlPoints == axis.DesignControlPoints


def test_wires_sketches_and_shuffled_segments_give_the_axis_of_their_points(document, hall):
    plain = make.make_axis(document, "A1", hall, POINTS)
    wire = make.make_axis(document, "A2", hall, edge=(line(document, *POINTS), ""))
    pieces = [
        line(document, *(POINTS[k : k + 2] if k % 2 else POINTS[k : k + 2][::-1]))
        for k in (3, 0, 7, 5, 1, 6, 4, 2)
    ]
    loose = make.make_axis(document, "A3", hall, sources=pieces, direction="rule")
    bare = make.make_axis(
        document, "A4", hall, POINTS[[3, 0, 7, 5, 8, 1, 6, 4, 2]], order="nearest", direction="rule"
    )
    plane = make.make_surface(document, "Floor", "plane")
    sketch = document.addObject("Sketcher::SketchObject", "Sketch")
    sketch.addGeometry(Part.ArcOfCircle(Part.Circle(Vector(), Vector(0, 0, 1), 2e4), 0.2, 1.2))
    arc = make.make_axis(document, "A5", plane, edge=(sketch, ""))
    document.recompute()
    for other in (wire, loose, bare):
        assert other.Status == "ok", other.Status
        assert other.Length.Value == pytest.approx(plain.Length.Value, abs=1e-6)
    assert (arc.Status, arc.MinimumRadius.Value) == ("ok", pytest.approx(2e4))
    assert arc.Length.Value == pytest.approx(2e4, abs=1e-6)


def test_rules_offsets_ends_and_presets(document, hall):
    start, end = (tuple(map(float, POINTS[k])) for k in (0, -1))
    chord = make.make_axis(document, "A0", hall, POINTS)
    geodesic = make.make_axis(
        document, "A1", hall, rule={"kind": "geodesic", "start": start, "end": end}
    )
    across = np.cross(np.subtract(end, start), (0, 0, 1))
    section = make.make_axis(
        document,
        "A2",
        hall,
        rule={
            "kind": "plane section",
            "start": start,
            "end": end,
            "origin": start,
            "normal": across,
        },
    )
    away = make.make_axis(document, "A3", hall, POINTS, fit="offset", distance=250)
    longer = make.make_axis(document, "A4", hall, POINTS, start_extension=300, end_extension=-500)
    level = make.make_axis(document, "A5", hall, POINTS, end_z=float(POINTS[-1][2]) - 100)
    camber = make.make_axis(
        document, "A6", hall, POINTS, preset={0: (0, 0, 0), 0.5: (0, 0, 80), 1: (0, 0, 0)}
    )
    document.recompute()
    for axis in (geodesic, section, away, longer, level, camber):
        assert axis.Status == "ok", axis.Status
    assert geodesic.Length.Value < min(section.Length.Value, chord.Length.Value)
    assert away.SurfaceDistanceMax.Value < 0.01
    ends = [vertex.Point for vertex in away.Shape.Vertexes]
    assert (ends[0] - chord.Shape.Vertexes[0].Point).Length == pytest.approx(250, abs=0.1)
    assert longer.Length.Value == pytest.approx(chord.Length.Value - 200, abs=1e-3)
    assert level.Shape.Vertexes[-1].Point.z == pytest.approx(POINTS[-1][2] - 100, abs=1e-3)
    moves = np.array(
        [
            tuple(a - b)
            for a, b in zip(camber.ControlPoints, camber.DesignControlPoints, strict=True)
        ]
    )
    assert moves[:, 2].max() == pytest.approx(80, abs=3)
    assert np.abs(moves[[0, -1]]).max() < 1e-6


def test_rings_and_their_turns(document, hall):
    torus = make.make_surface(document, "Torus", "torus", R=30e3, r=8e3)
    ring = make.make_axis(document, "A1", torus, CURVES["T-ring"].points(25, 2), closed=True)
    flat = make.make_axis(
        document, "A2", hall, CURVES["E-ring"].points(25, 2), closed=True, frame="minimal"
    )
    document.recompute()
    assert (ring.Status, ring.Windings, flat.Windings) == ("ok", -1, 0)
    assert ring.TotalTorsion.Value == pytest.approx(-358.65, abs=0.1)
    assert ring.Shape.Edges[0].isClosed()


def test_frames_turn_the_members_section(document, hall):
    section = make.make_section(document, "S", h=800, b=400, t=16)
    up = make.make_axis(document, "A1", hall, POINTS, frame="fixed", twist={0: 0, 1: 20})
    member = make.make_member(document, "M1", up, [section], roll=10)
    document.recompute()
    assert member.Status == "ok", member.Status
    from BendTorsionWB.objects import member as member_object

    frames = member_object.value(member).member.frames
    at = frames.at(np.array([0.0, frames.axis.length]))
    tilt = np.degrees(np.arctan2(-at.y[:, 2], np.linalg.norm(at.y[:, :2], axis=1)))
    upright = np.sqrt(1 - at.x[:, 2] ** 2)
    expected = np.degrees(np.arcsin(np.sin(np.radians([10, 30])) * upright))
    assert np.abs(tilt) == pytest.approx(expected, abs=1e-6)


def test_what_is_shown_on_request(document, hall):
    axis = make.make_axis(document, "A1", hall, POINTS)
    document.recompute()
    assert (len(axis.Shape.Edges), axis.Shape.ShapeType) == (1, "Edge")
    axis.Show = "control points"
    document.recompute()
    assert len(axis.Shape.Vertexes) >= len(axis.ControlPoints)
    axis.Show, axis.ShowScale = "frame ribbon", 500.0
    document.recompute()
    teeth = [edge.Length for edge in axis.Shape.Edges[1:102]]
    assert teeth == pytest.approx([500.0] * 101)
    axis.Show, axis.ShowScale = "curvature comb", 1e8
    document.recompute()
    longest = max(edge.Length for edge in axis.Shape.Edges[1:102])
    assert longest == pytest.approx(1e8 / axis.MinimumRadius.Value, rel=1e-3)


@pytest.mark.parametrize(
    ("points", "settings", "code"),
    [
        (POINTS[:1], {}, "axis-too-few-points"),
        ([*POINTS[:3], (math.nan, 0, 0)], {}, "axis-point-not-a-number"),
        ([*POINTS[:3], POINTS[2], *POINTS[3:]], {}, "axis-points-coincide"),
        (POINTS / 1000, {}, "axis-far-from-surface"),
        (POINTS + [0, 0, 1e4], {}, "axis-far-from-surface"),
        (POINTS, {"twist": {0: 0, 9e9: 1}}, "frame-station-outside"),
        (POINTS, {"frame": "given"}, "frame-table-empty"),
        ([(0, 0, 2e4), (0, 0, 2.1e4)], {"fit": "keep"}, "axis-along-normal"),
    ],
)
def test_bad_input_is_an_error_never_a_curve(document, hall, points, settings, code):
    axis = make.make_axis(document, "A1", hall, **settings)
    axis.Points = [FreeCAD.Vector(*point) for point in points]
    section = make.make_section(document, "S", h=800, b=400, t=16)
    member = make.make_member(document, "M1", axis, [section])
    document.recompute()
    assert code in codes(axis)
    assert axis.Status.startswith("error") and not axis.Shape.Edges
    assert axis.Length.Value == 0.0 and list(axis.ControlPoints) == []
    assert member.Status.startswith("error") and not member.Shape.Faces


def test_creases_borders_and_units_are_found_with_their_place(document):
    box = document.addObject("Part::Feature", "Box")
    shape = Part.makeBox(9000, 9000, 4000)
    box.Shape = Part.Compound(
        [f for f in shape.Faces if f.CenterOfMass.z > 3900 or f.CenterOfMass.y < 10]
    )
    surface = make.make_surface(document, "Roof", face=(box, ""))
    points = [(4000, -0.5, 3000), (5000, 3000, 4000), (5000, 6000, 4000), (5000, 9500, 4000)]
    crossing = make.make_axis(document, "A1", surface, points, fit="keep")
    upright = make.make_axis(document, "A2", surface, points, fit="keep", frame="fixed")
    small = make.make_surface(document, "Metres", "sphere", r=30)
    document.recompute()
    assert crossing.Status.startswith("error")
    (crease,) = [f for f in map(json.loads, crossing.Findings) if f["code"] == "surface-crease"]
    assert crease["value"] == pytest.approx(90, abs=0.5) and crease["position"].startswith("s = ")
    assert upright.Status == "ok" and "surface-border" in codes(upright)
    (unit,) = map(json.loads, small.Findings)
    assert unit["code"] == "surface-size" and "metres" in unit["message"]


def test_a_deleted_surface_is_an_error_and_comes_back(document, hall):
    axis = make.make_axis(document, "A1", hall, POINTS)
    document.recompute()
    document.removeObject(hall.Name)
    document.recompute()
    assert axis.Status.startswith("error") and codes(axis) == ["link-missing"]
    axis.Surface = make.make_surface(document, "Hall", a=40e3, b=30e3, c=20e3)
    document.recompute()
    assert axis.Status == "ok"


def test_everything_survives_saving(document, hall, tmp_path):
    make.make_axis(
        document,
        "A1",
        hall,
        POINTS,
        frame="given",
        given_angles={0: 0, 9000: 20},
        twist={0: 0, 1: 5},
        preset={0.5: (0, 0, 10)},
        start_dz=-50,
        show="frame ribbon",
        chord_sag=30,
        reverse=True,
    )
    document.recompute()
    (before,) = [o for o in document.Objects if o.Label == "A1"]
    assert before.Status == "ok", before.Status
    path = str(tmp_path / "a.FCStd")
    document.saveAs(path)
    figures = before.Length.Value, before.TotalTorsion.Value, len(before.Shape.Edges)
    again = FreeCAD.openDocument(path, hidden=True)
    try:
        (after,) = [o for o in again.Objects if o.Label == "A1"]
        after.touch()
        again.recompute()
        assert (after.Length.Value, after.TotalTorsion.Value, len(after.Shape.Edges)) == figures
    finally:
        if again.Name != document.Name:
            FreeCAD.closeDocument(again.Name)
