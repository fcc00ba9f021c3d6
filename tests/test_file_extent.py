# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units and bounding boxes of architects' files: told on import, doubted where hard to believe."""

import sys

import ezdxf
import FreeCAD
import numpy as np
import Part
import pytest
from test_surface_files import write_schedule

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.curve_files import dxf_unit
from BendTorsionWB.exchange.file_extent import extent_findings, unit_of
from BendTorsionWB.exchange.rhino_files import rhino_axis

POINTS = [["A1", n, 20000.0 * c, 20000.0 * s, 0.0] for n, (c, s) in enumerate(
    [(1.0, 0.0), (0.8, 0.6), (0.0, 1.0)], start=1)]  # fmt: skip


def box(size, at=(0.0, 0.0, 0.0)):
    return np.array([at, np.add(at, size)])


def codes(findings):
    return [finding.code for finding in findings]


def test_a_surface_of_a_building_is_told_and_believed():
    [told] = extent_findings("roof.step", box((80e3, 60e3, 20e3)), 1.0, 30e3)
    assert told.severity == "note" and "unit mm" in told.message
    assert "80.000 x 60.000 x 20.000 m" in told.message


@pytest.mark.parametrize(
    ("size", "beside", "word"),
    [
        ((80.0, 60.0, 20.0), 30e3, "1000 times too small"),
        ((80e6, 60e6, 20e6), 30e3, "1000 times too large"),
        ((80e3, 60e3, 20e3), 30.0, "1000 times too large"),
        ((0.08, 0.06, 0.02), None, ""),
        ((8e6, 6e6, 2e6), None, ""),
    ],
)
def test_sizes_hard_to_believe_are_questioned(size, beside, word):
    _, doubt = extent_findings("roof.step", box(size), 1.0, beside)
    assert doubt.severity == "warning" and doubt.code == "file-unit-doubtful"
    assert "?" in doubt.message and word in doubt.mend


def test_a_file_that_should_tell_its_unit_and_does_not_is_questioned():
    assert codes(extent_findings("a.dxf", box((20e3, 20e3, 0)), None, 30e3, True)) == [
        "file-read",
        "file-unit-unknown",
    ]
    assert codes(extent_findings("a.brep", box((20e3, 20e3, 0)), None, 30e3)) == ["file-read"]


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));", 1.0),
        ("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) );", 1000.0),
        ("(CONVERSION_BASED_UNIT('INCH',#7)LENGTH_UNIT()NAMED_UNIT(#8));", 25.4),
        ("no unit", None),
    ],
)
def test_the_unit_of_a_step_file(tmp_path, text, unit):
    path = tmp_path / "roof.step"
    path.write_text(f"ISO-10303-21;\nDATA;\n#1={text}\nENDSEC;\n", encoding="utf-8")
    assert unit_of(path) == unit


def test_units_of_files_written_by_freecad(tmp_path):
    sphere = Part.makeSphere(20e3)
    for name in ("roof.step", "roof.iges"):
        sphere.exportStep(str(tmp_path / name)) if name.endswith("step") else sphere.exportIges(
            str(tmp_path / name)
        )
        assert unit_of(tmp_path / name) == 1.0
    sphere.exportBrep(str(tmp_path / "roof.brep"))
    assert unit_of(tmp_path / "roof.brep") is None


def drawing(path, code, scale):
    document = ezdxf.new(units=code)
    if not code:
        del document.header["$INSUNITS"]
    document.modelspace().add_spline(
        [(scale * x, scale * y, 0.0) for _, _, x, y, _ in POINTS], dxfattribs={"layer": "A1"}
    )
    document.saveas(path)


@pytest.mark.parametrize(
    ("code", "scale", "told", "doubts"),
    [
        (4, 1.0, "unit mm", []),
        (6, 1e-3, "unit m", []),
        (0, 1.0, "tells no unit", ["file-unit-unknown"]),
        (4, 1e-3, "unit mm", ["file-unit-doubtful"]),
        (6, 1.0, "unit m", ["file-unit-doubtful"]),
    ],
)
def test_the_unit_of_a_drawing_is_told_on_import(tmp_path, code, scale, told, doubts):
    drawing(tmp_path / "axes.dxf", code, scale)
    assert dxf_unit(tmp_path / "axes.dxf") == {4: 1.0, 6: 1000.0, 0: None}[code]
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "sphere", None, "r=20000"]],
        [["A1", "Hall", None, "axes.dxf#A1", None, None, None]],
        [["M1", "A1"]],
    )
    _, _, found = project.read_project(path)
    note, *others = [f for f in found.findings if f.code.startswith("file")]
    assert told in note.message and note.position == "axis A1"
    assert codes(others) == doubts


def test_check_shows_unit_and_size_and_doubts(tmp_path, capsys):
    document = FreeCAD.newDocument("roof", hidden=True)
    try:
        shell = document.addObject("Part::Feature", "Roof")
        shell.Shape = Part.makeSphere(20.0).Faces[0]
        Part.export([shell], str(tmp_path / "roof.step"))
    finally:
        FreeCAD.closeDocument(document.Name)
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "file", "roof.step", None]],
        [["A1", "Hall", None, None, None, "keep", None]],
        [["M1", "A1"]],
        POINTS,
    )
    _, _, found = project.read_project(path)
    note, doubt = [f for f in found.findings if f.code.startswith("file")]
    assert "0.040 x 0.040 x 0.040 m" in note.message
    assert "1000 times too small" in doubt.mend
    main(["check", str(path), "--jobs", "1"])
    printed = capsys.readouterr()
    assert "roof.step" in printed.out + printed.err


def sphere_file(folder, radius):
    """A STEP file in mm of a sphere, and the name of it."""
    document = FreeCAD.newDocument("roof", hidden=True)
    try:
        shell = document.addObject("Part::Feature", "Roof")
        shell.Shape = Part.makeSphere(radius).Faces[0]
        Part.export([shell], str(folder / "roof.step"))
    finally:
        FreeCAD.closeDocument(document.Name)
    return "roof.step"


@pytest.mark.parametrize("command", ["check", "build"])
def test_a_surface_in_the_wrong_unit_is_questioned_when_its_axis_fails(tmp_path, capsys, command):
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "file", sphere_file(tmp_path, 20.0), None]],
        [["A1", "Hall", None, None, None, None, None]],
        [["M1", "A1"]],
        POINTS,
    )
    out = ["--out", str(tmp_path / "out")] if command == "build" else []
    assert main([command, str(path), *out, "--jobs", "1"]) == 2
    told = [line for line in capsys.readouterr().err.splitlines() if ":" in line]
    note, doubt, error = told
    assert note.startswith("note: roof.step") and "0.040 x 0.040 x 0.040 m" in note
    assert "(value" not in note
    assert doubt.startswith("warning: roof.step") and "0.06928 m" in doubt
    assert "the surface is likely in metres and taken for mm" in error
    assert "1000 times larger" in error
    assert main([command, str(path), *out, "--jobs", "1", "--quiet"]) == 2
    [only] = capsys.readouterr().err.splitlines()
    assert only == error


def test_a_drawing_that_tells_a_wrong_unit_is_questioned_when_its_axis_fails(tmp_path, capsys):
    document = ezdxf.new(units=6)
    document.modelspace().add_arc((0, 0, 0), 20000.0, 0.0, 90.0, dxfattribs={"layer": "A1"})
    document.saveas(tmp_path / "axes.dxf")
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "sphere", None, "r=20000"]],
        [["A1", "Hall", None, "axes.dxf#A1", None, None, None]],
        [["M1", "A1"]],
    )
    assert main(["check", str(path), "--jobs", "1"]) == 2
    note, doubt, error = (line for line in capsys.readouterr().err.splitlines() if ":" in line)
    assert "unit m;" in note and "is its unit right?" in doubt
    assert "the coordinates are likely in mm and taken for metres" in error
    assert " at x, y, z" in error and "at at" not in error


def test_the_box_of_a_surface_is_that_of_its_faces_and_not_of_its_poles(tmp_path):
    half = FreeCAD.Matrix()
    half.scale(2.0, 1.5, 1.0)
    Part.makeSphere(20000.0).transformGeometry(half).Faces[0].exportBrep(str(tmp_path / "r.brep"))
    axes = [["A1", "Hall", None, None, None, "keep", None]]
    path = write_schedule(
        tmp_path / "hall.xlsx", [["Hall", "file", "r.brep", None]], axes, [["M1", "A1"]], POINTS
    )
    _, _, found = project.read_project(path)
    [told] = [f for f in found.findings if f.code == "file-read"]
    assert "80.000 x 60.000 x 40.000 m" in told.message


def test_an_axis_of_a_file_with_several_curves_must_be_named(tmp_path):
    drawing(tmp_path / "axes.dxf", 4, 1.0)
    other = ezdxf.readfile(tmp_path / "axes.dxf")
    other.modelspace().add_line((0, 0, 0), (1, 0, 0), dxfattribs={"layer": "OTHER"})
    other.saveas(tmp_path / "axes.dxf")
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "plane", None, None]],
        [["A1", "Hall", None, "axes.dxf", None, "keep", None]],
        [["M1", "A1"]],
    )
    with pytest.raises(BendTorsionError) as problem:
        project.read_project(path)
    [told] = problem.value.findings
    assert "the file holds several curves" in told.message and "OTHER" in told.mend


def test_without_rhino3dm_a_rhino_file_is_one_clear_line(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rhino3dm", None)
    path = write_schedule(
        tmp_path / "hall.xlsx",
        [["Hall", "file", "roof.3dm#Dome", None]],
        [["A1", "Hall", None, "roof.3dm#A1", None, None, None]],
        [["M1", "A1"]],
    )
    # A surface and an axis, and the package is missing once.
    assert project.read_schedule(path).axis("A1").source.file == "roof.3dm"
    with pytest.raises(BendTorsionError) as problem:
        project.read_jobs(path)
    [finding] = problem.value.findings
    assert finding.position == "sheet Surfaces, row 2, column file"
    assert "rhino3dm" in finding.message and "pip install rhino3dm" in finding.mend
    with pytest.raises(BendTorsionError):
        rhino_axis(tmp_path / "roof.3dm")
