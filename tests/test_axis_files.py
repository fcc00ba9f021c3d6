# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes from DXF drawings and from curves of STEP and BREP files."""

import math

import ezdxf
import FreeCAD
import Import
import numpy as np
import Part
import pytest

from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.curve_files import dxf_axes, dxf_axis
from BendTorsionWB.shapes.curve_files import part_axis

POLES = [(0, 0, 0), (5, 1, 0), (9, 4, 2), (14, 5, 3)]


@pytest.fixture(scope="module")
def drawing(tmp_path_factory):
    """A drawing in metres."""
    path = tmp_path_factory.mktemp("dxf") / "axes.dxf"
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 6
    space = document.modelspace()

    def on(layer):
        return {"layer": layer}

    space.add_rational_spline(POLES, [1, 2, 1.5, 1], 3, dxfattribs=on("SPLINE"))
    space.add_lwpolyline(
        [(0, 0, 0), (10, 0, math.tan(math.pi / 8)), (20, 10, 0), (20, 18, 0)],
        format="xyb",
        dxfattribs=on("BULGE"),
    )
    space.add_line((9, 1, 0), (5, 0, 0), dxfattribs=on("LINES"))
    space.add_line((0, 0, 1), (5, 0, 0), dxfattribs=on("LINES"))
    space.add_line((13, 3, 0), (9, 1, 0), dxfattribs=on("LINES"))
    space.add_circle((1, 2, 3), 4, dxfattribs={"layer": "RING", "extrusion": (0, 1, 0)})
    space.add_polyline3d([(0, 0, 0), (4, 0, 1), (8, 1, 2)], dxfattribs=on("POLY"))
    for point in [(0, 0, 0), (8, 1, 0), (2, 0, 0), (5, 0.3, 0)]:
        space.add_point(point, dxfattribs=on("POINTS"))
    space.add_spline(POLES, dxfattribs=on("FITTED"))
    space.add_circle((0, 0), 4, dxfattribs=on("MESS"))
    space.add_circle((50, 0), 4, dxfattribs=on("MESS"))
    document.saveas(path)
    return path


def axis(path, name):
    return axis_from(dxf_axis(path, name).into(AxisInput("A")), None)


def test_a_rational_spline_is_exact_in_millimetres(drawing):
    curve = dxf_axis(drawing, "spline").curve
    t = np.linspace(0, 1, 21)
    basis = np.array([math.comb(3, k) * t**k * (1 - t) ** (3 - k) for k in range(4)]).T
    basis *= [1, 2, 1.5, 1]
    exact = 1000 * basis @ np.array(POLES) / basis.sum(axis=1, keepdims=True)
    first, last = curve.domain
    assert curve.evaluate(first + t * (last - first))[0] == pytest.approx(exact, abs=1e-9)


def test_bulges_are_arcs(drawing):
    found = axis(drawing, "BULGE")
    assert found.length == pytest.approx(1e3 * (10 + 10 * math.pi / 2 + 8), abs=1e-6)
    near = found.position(
        found.place_of(np.array([[10e3 + 10e3 * math.sin(0.6), 10e3 - 10e3 * math.cos(0.6), 0]]))
    )
    assert np.linalg.norm(near[0, :2] - [10e3, 10e3]) == pytest.approx(10e3, abs=1e-6)


def test_loose_lines_are_chained_and_points_ordered(drawing):
    assert len(dxf_axis(drawing, "LINES").segments) == 3
    wanted = 1000 * np.array([[0, 0, 1], [5, 0, 0], [9, 1, 0], [13, 3, 0.0]])
    assert axis(drawing, "LINES").given == pytest.approx(wanted)
    loose = axis(drawing, "POINTS").given
    assert loose[:, 0] == pytest.approx([0, 2e3, 5e3, 8e3])
    assert len(axis(drawing, "POLY").given) == 3
    assert axis(drawing, "FITTED").given == pytest.approx(1000 * np.array(POLES, float))


def test_a_circle_in_its_own_plane_is_a_closed_axis(drawing):
    ring = axis(drawing, "RING")
    assert ring.closed and ring.length == pytest.approx(8e3 * math.pi, abs=1e-6)
    points = ring.position(np.linspace(0, ring.length, 30))
    assert np.abs(points[:, 1] - 3e3).max() < 1e-6


def test_a_layer_of_texts_alone_holds_no_curves(tmp_path):
    document = ezdxf.new("R2000", units=4)
    document.layers.add("Notes")
    document.layers.add("BARE")
    space = document.modelspace()
    space.add_text("axis", dxfattribs={"layer": "Notes"})
    space.add_text("axis", dxfattribs={"layer": "undeclared"})
    for layer in ("A1", "A2"):
        space.add_line((0, 0, 0), (9e3, 0, 0), dxfattribs={"layer": layer})
    document.saveas(tmp_path / "axes.dxf")
    for given, layer in (("notes", "Notes"), ("BARE", "BARE"), ("undeclared", "undeclared")):
        with pytest.raises(BendTorsionError) as caught:
            dxf_axis(tmp_path / "axes.dxf", given)
        [finding] = caught.value.findings
        assert finding.code == "axis-source-empty"
        assert finding.message == f"layer {layer} holds no curves, lines or points"
        assert finding.mend == "use A1, A2"
    with pytest.raises(BendTorsionError) as caught:
        dxf_axis(tmp_path / "axes.dxf", "NOWHERE")
    [finding] = caught.value.findings
    assert finding.code == "axis-source-name" and finding.mend == "use A1, A2"


def test_entities_answer_to_their_handles_and_names_are_listed(drawing):
    handles = [name for name, source in dxf_axes(drawing).items() if source.points is not None]
    assert len(handles) == 1 + 4
    with pytest.raises(BendTorsionError) as caught:
        dxf_axis(drawing, "NOWHERE")
    assert "SPLINE" in caught.value.findings[0].mend
    with pytest.raises(BendTorsionError) as caught:
        dxf_axis(drawing, "MESS")
    assert caught.value.findings[0].code == "axis-segment-gap"


def test_a_file_that_is_no_drawing_is_refused(tmp_path):
    bad = tmp_path / "bad.dxf"
    bad.write_text("nothing of the kind", encoding="utf-8")
    for path, code in ((bad, "axis-file"), (tmp_path / "missing.dxf", "file-missing")):
        with pytest.raises(BendTorsionError) as caught:
            dxf_axis(path)
        assert caught.value.findings[0].code == code


def test_named_curves_of_step_files_come_back_exactly(tmp_path):
    document = FreeCAD.newDocument("AxisFiles", hidden=True, temp=True)
    vector = FreeCAD.Vector
    spline = Part.BSplineCurve()
    spline.interpolate([vector(0, 0, 0), vector(5000, 1000, 0), vector(9000, 4000, 3000)])
    arc = Part.Arc(
        vector(5000, 0, 0),
        vector(5000 + 1e4 * 0.5**0.5, 1e4 * (1 - 0.5**0.5), 0),
        vector(15000, 10000, 0),
    )
    straight = Part.LineSegment(vector(0, 0, 0), vector(5000, 0, 0))
    shapes = {
        "Rib 1": Part.Wire([straight.toShape(), arc.toShape()]),
        "Rib 2": spline.toShape(),
        "Block": Part.makeBox(1, 2, 3),
    }
    items = []
    for label, shape in shapes.items():
        item = document.addObject("Part::Feature", "Shape")
        item.Label, item.Shape = label, shape
        items.append(item)
    path = tmp_path / "axes.step"
    Import.export(items, str(path))
    FreeCAD.closeDocument(document.Name)
    rib = axis_from(part_axis(path, "Rib 1").into(AxisInput("A")), None)
    assert rib.length == pytest.approx(5e3 + 5e3 * math.pi, abs=1e-3)
    other = axis_from(part_axis(path, "Rib 2").into(AxisInput("A")), None)
    assert other.length == pytest.approx(spline.length(), abs=1e-4)
    for name in ("Block", "Rib 3"):
        with pytest.raises(BendTorsionError):
            part_axis(path, name)
    brep = tmp_path / "axis.brep"
    shapes["Rib 2"].exportBrep(str(brep))
    assert part_axis(brep).curve.poles == pytest.approx(other.curve.poles, abs=1e-6)


def line(space, *points):
    space.add_polyline3d(points)


def spline(space, weights=(1, 1, 2, 1), end=1.0):
    added = space.add_rational_spline(POLES, weights, 3)
    added.knots = [0.0] * 4 + [end] * 4


@pytest.mark.parametrize(
    "code, draw",
    [
        ("axis-point-too-far", lambda space: line(space, (0, 0, 0), (1e300, 0, 0))),
        ("axis-point-too-far", lambda space: line(space, (0, 0, 0), (1.1e7, 0, 0))),
        ("axis-point-too-far", lambda space: space.add_point((1.7e308, 0, 0))),
        ("axis-point-not-a-number", lambda space: space.add_circle((0, 0), 1e300)),
        (
            "axis-point-not-a-number",
            lambda space: space.add_lwpolyline([(0, 0, 1e300), (9, 9, 0)], format="xyb"),
        ),
        ("axis-curve-weights", lambda space: spline(space, (1, 1e-300, 1, 1))),
        ("axis-curve-weights", lambda space: spline(space, (1, -1, 1, 1))),
        ("axis-curve-knots", lambda space: spline(space, end=1e-300)),
        ("axis-curve-knots", lambda space: spline(space, end=math.nan)),
    ],
)
@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_numbers_nothing_can_be_computed_from_are_refused_when_read(tmp_path, code, draw):
    document = ezdxf.new("R2000", units=6)
    draw(document.modelspace())
    document.saveas(tmp_path / "axis.dxf")
    with pytest.raises(BendTorsionError) as caught:
        dxf_axis(tmp_path / "axis.dxf", "0")
    [finding] = caught.value.findings
    assert finding.code == code and finding.position in ("segment 1", "point 1")
    assert finding.value is None or finding.value > finding.limit


def test_poles_of_a_part_curve_far_beyond_any_building_are_refused(tmp_path):
    poles = [FreeCAD.Vector(*pole) * 1e12 for pole in POLES]
    curve = Part.BSplineCurve()
    curve.buildFromPoles(poles)
    curve.toShape().exportBrep(str(tmp_path / "axis.brep"))
    with pytest.raises(BendTorsionError) as caught:
        part_axis(tmp_path / "axis.brep")
    assert caught.value.findings[0].code == "axis-point-too-far"
