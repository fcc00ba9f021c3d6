# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces and axes from files: read, named, located when wrong, built from end to end."""

import json
import math

import ezdxf
import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from exact_axes import curves

from BendTorsionWB import project
from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.frames import torsion_angle
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Torus
from BendTorsionWB.core.memo import forget_all
from BendTorsionWB.shapes.from_part import surface_from_part
from BendTorsionWB.shapes.surface_files import faces_from_file, shape_from_file

SECTIONS = [["section", "type", "h", "b", "t"], ["S1", "box1", 600, 500, 16]]
HEAD = ["axis", "surface", "frame", "source", "closed", "fit", "start_extension"]


def write_schedule(path, surfaces, axes, members, points=(), **more):
    book = openpyxl.Workbook()
    book.remove(book.active)
    sheets = {
        "Surfaces": [["surface", "kind", "file", "parameters"], *surfaces],
        "Points": [["axis", "no", "x", "y", "z"], *points],
        "Axes": [HEAD, *axes],
        "Sections": SECTIONS,
        "Members": [
            ["member", "segment", "axis", "section"],
            *([name, 1, axis, "S1"] for name, axis in members),
        ],
        **more,
    }
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


@pytest.fixture
def files(tmp_path):
    """A folder with roof.step (parts ring, dome, ridge), roof.brep and axes.dxf."""
    document = FreeCAD.newDocument("out", hidden=True)
    shapes = {
        "ring": Part.makeTorus(30e3, 8e3).Faces[0],
        "dome": Part.makeSphere(20e3).Faces[0],
        "ridge": Part.makeCircle(22e3, FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(0, 0, 1)),
    }
    for label, shape in shapes.items():
        feature = document.addObject("Part::Feature", "Part")
        feature.Label, feature.Shape = label, shape
    document.recompute()
    import Import

    Import.export(document.Objects, str(tmp_path / "roof.step"))
    FreeCAD.closeDocument(document.Name)
    shapes["ring"].exportBrep(str(tmp_path / "ring.brep"))
    drawing = ezdxf.new("R2000", units=4)
    points = curves()["T-diag"].points(9, 3)
    for k in (4, 0, 6, 2, 7, 1, 5, 3):
        a, b = points[k], points[k + 1]
        drawing.modelspace().add_line(a, b) if k % 2 else drawing.modelspace().add_line(b, a)
    drawing.modelspace().query("LINE").groupby("layer")
    for line in drawing.modelspace():
        line.dxf.layer = "A1"
    drawing.saveas(tmp_path / "axes.dxf")
    return tmp_path


def test_one_named_part_of_a_step_file(files):
    path = files / "roof.step"
    assert len(shape_from_file(path).Faces) == 2
    dome = faces_from_file(path, "dome")
    assert [len(dome.Faces), dome.BoundBox.XMax] == [1, pytest.approx(20e3, rel=1e-6)]
    surface = surface_from_part(faces_from_file(path, "ring"))
    given = np.random.default_rng(1).uniform(-40e3, 40e3, (300, 3)) * [1, 1, 0.2]
    assert (
        np.abs(surface.closest(given).distance - Torus(30e3, 8e3).closest(given).distance).max()
        < 1e-7
    )
    ridge = shape_from_file(path, "ridge")
    assert (len(ridge.Faces), ridge.Length) == (0, pytest.approx(2 * math.pi * 22e3))


@pytest.mark.parametrize(
    ("name", "part", "code"),
    [
        ("nothing.step", "", "file-missing"),
        ("roof.txt", "", "file-kind"),
        ("roof.step", "wall", "file-name-unknown"),
        ("ring.brep", "ring", "file-name-unknown"),
        ("nothing.igs", "curve1", "file-missing"),
        ("roof.step", "ridge", "surface-file-empty"),
        ("torn.step", "", "file-unreadable"),
        ("torn.igs", "", "file-unreadable"),
        ("torn.brep", "", "file-unreadable"),
    ],
)
def test_a_file_without_a_surface_is_named(files, name, part, code):
    if name.startswith("torn"):
        (files / name).write_text("torn", encoding="utf-8")
    with pytest.raises(BendTorsionError) as caught:
        faces_from_file(files / name, part, "Roof")
    (finding,) = caught.value.findings
    assert (finding.code, finding.object, finding.value) == (code, "Roof", name)
    assert finding.mend


def test_a_bad_file_is_an_error_at_its_cell(files, tmp_path):
    path = write_schedule(
        tmp_path / "a.xlsx",
        [["Ring", "file", "roof.step#wall", None]],
        [["A1", "Ring", None, "axes.dxf#A7", None, None, None]],
        [("M1", "A1")],
    )
    with pytest.raises(BendTorsionError) as caught:
        project.read_jobs(path)
    assert [f.position for f in caught.value.findings] == [
        "sheet Surfaces, row 2, column file",
        "sheet Axes, row 2, column source",
    ]
    assert all(f.object == "a.xlsx" for f in caught.value.findings)


def test_a_schedule_of_files_builds_the_same_members_as_one_of_numbers(files, tmp_path):
    points = curves()["T-diag"].points(9, 3)
    turn = np.radians([0, 30, 75, 110, 160, 200, 250, 290, 335])
    ring = np.column_stack([9e3 + 2e3 * np.cos(turn), 2e3 * np.sin(turn), 0 * turn + 19e3])
    rows = [["A2", k + 1, *map(float, p)] for k, p in enumerate(points)]
    rows += [["R", k + 1, *map(float, p)] for k, p in enumerate(ring)]
    path = write_schedule(
        tmp_path / "a.xlsx",
        [
            ["Ring", "file", "roof.step#ring", None],
            ["Same", "torus", None, "R=30000 r=8000"],
            ["Hall", "ellipsoid", None, "a=40000 b=30000 c=20000"],
        ],
        [
            ["A1", "Ring", None, "axes.dxf#A1", None, None, -19000],
            ["A2", "Same", None, None, None, None, -19000],
            ["R", "Hall", "minimal", None, "yes", None, None],
        ],
        [("M1", "A1"), ("M2", "A2"), ("M3", "R")],
        rows,
        Frames=[
            ["axis", "s", "angle"],
            ["A1", "0%", 0],
            ["A1", "100%", 12],
            ["A2", "0%", 0],
            ["A2", "100%", 12],
        ],
    )
    _, jobs = project.read_jobs(path)
    built = []
    for name in ("M1", "M2"):
        job = jobs[name]
        axis = detailing.axis_of(job.axis, job.surface)
        frames = detailing.member_of(job.member, axis, job.surface).member.frames
        built.append((axis.length, torsion_angle(frames)[1][-1]))
    # Rounding of coordinates in the files aside, they are one axis with one frame.
    assert built[0] == pytest.approx(built[1], abs=1e-4)
    out = tmp_path / "out"
    forget_all()
    result = project.build(path, out, only=("M1", "M3"), workers=1)
    assert not result.failed, [f.line() for f in result.findings if f.severity == "error"]
    assert max(record.torsion_error_max for record in result.records) < 5e-5
    third = result.records[1]
    assert {plate.face for plate in third.plates} == {"top", "bottom", "left", "right"}
    # The document holds what the files held, and needs them no more.
    for name in ("roof.step", "axes.dxf"):
        (files / name).unlink()
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    for item in document.Objects:
        item.touch()
    document.recompute()
    status = {o.Label: o.Status for o in document.Objects if "Status" in o.PropertiesList}
    FreeCAD.closeDocument(document.Name)
    assert set(status.values()) == {"ok"}
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    assert len(report["members"]) == 2
