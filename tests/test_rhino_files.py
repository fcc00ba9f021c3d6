# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes and surfaces from Rhino files written by rhino3dm itself."""

import math

import numpy as np
import pytest
import rhino3dm
from test_surface_files import write_schedule

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.rhino_files import rhino_axis, rhino_patches, rhino_unit
from BendTorsionWB.shapes.from_part import surface_from_part
from BendTorsionWB.shapes.patch_shape import faces_of_patches

pytestmark = pytest.mark.optional

ARC = [(20.0 * math.cos(a), 20.0 * math.sin(a), 0.0) for a in np.linspace(0.0, 1.0, 9)]


@pytest.fixture
def rhino(tmp_path):
    """A file in metres: a dome and a sheet, an axis on layer Axes, a polyline, a box."""
    model = rhino3dm.File3dm()
    model.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Meters
    for name in ("Other", "Axes"):
        layer = rhino3dm.Layer()
        layer.Name = name
        model.Layers.Add(layer)

    def named(name, layer=0):
        attributes = rhino3dm.ObjectAttributes()
        attributes.Name, attributes.LayerIndex = name, layer
        return attributes

    arc = rhino3dm.Arc(
        rhino3dm.Point3d(*ARC[0]), rhino3dm.Point3d(*ARC[4]), rhino3dm.Point3d(*ARC[8])
    )
    model.Objects.AddCurve(arc.ToNurbsCurve(), named("A1", 1))
    points = rhino3dm.Point3dList([rhino3dm.Point3d(*p) for p in ARC])
    model.Objects.AddPolyline(rhino3dm.Polyline(points), named("Line"))
    dome = rhino3dm.Sphere(rhino3dm.Point3d(0, 0, 0), 20.0)
    model.Objects.AddSurface(rhino3dm.NurbsSurface.CreateFromSphere(dome), named("Dome"))
    box = rhino3dm.BoundingBox(rhino3dm.Point3d(0, 0, 0), rhino3dm.Point3d(1, 2, 3))
    model.Objects.AddBrep(rhino3dm.Brep.CreateFromBox(rhino3dm.Box(box)), named("Box"))
    path = tmp_path / "roof.3dm"
    model.Write(str(path), 7)
    return path


def test_curves_are_exact_and_in_mm(rhino):
    assert rhino_unit(rhino) == 1000.0
    for name in ("A1", "Axes", "a1"):
        curve = rhino_axis(rhino, name).curve
        u = np.linspace(*curve.domain, 50)
        [places] = curve.evaluate(u)
        assert np.abs(np.linalg.norm(places, axis=1) - 20000.0).max() < 1e-6
        assert places[0] == pytest.approx([20000.0, 0.0, 0.0], abs=1e-6)
    line = rhino_axis(rhino, "Line")
    assert np.vstack(line.segments) == pytest.approx(1000.0 * np.array(ARC))


def test_untrimmed_surfaces_become_the_same_surface(rhino):
    surface = surface_from_part(faces_of_patches(rhino_patches(rhino, "Dome")), "Dome")
    outside = 21000.0 * np.array([[1.0, 2.0, 2.0], [-2.0, 1.0, 0.5]]) / [[3.0], [math.sqrt(5.25)]]
    foot = surface.closest(outside)
    assert np.linalg.norm(foot.points, axis=1) == pytest.approx([20000.0, 20000.0], abs=1e-6)


def test_trimmed_surfaces_and_names_not_there_are_refused(rhino, tmp_path):
    def code(call, *arguments):
        with pytest.raises(BendTorsionError) as problem:
            call(*arguments)
        [finding] = problem.value.findings
        assert finding.mend
        return finding.code

    assert code(rhino_patches, rhino, "Box") == "surface-trimmed"
    assert code(rhino_patches, rhino, "Roof") == "surface-file-empty"
    assert code(rhino_axis, rhino, "A9") == "axis-source-name"
    assert code(rhino_axis, tmp_path / "none.3dm") == "file-missing"
    (tmp_path / "bad.3dm").write_text("not Rhino", encoding="utf-8")
    assert code(rhino_axis, tmp_path / "bad.3dm") == "file-unreadable"


def test_a_schedule_is_built_from_a_rhino_file(rhino, tmp_path):
    path = write_schedule(
        tmp_path / "rhino.xlsx",
        [["Hall", "file", "roof.3dm#Dome", None]],
        [["A1", "Hall", None, "roof.3dm#A1", None, "keep", None]],
        [["M1", "A1"]],
    )
    result = project.build(
        path, tmp_path / "out", workers=1, wanted=project.Wanted(model=False, sheets=False)
    )
    assert not result.failed
    assert result.records[0].length == pytest.approx(20000.0, rel=1e-6)
    told = [f for f in result.findings if f.code == "file-read"]
    assert len(told) == 2 and all("unit m;" in f.message for f in told)
