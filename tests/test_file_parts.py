# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves and surfaces chosen from IGES and BREP files: by number, label, name property, level."""

import math

import FreeCAD
import numpy as np
import Part
import pytest
from test_surface_files import write_schedule

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.curve_files import dxf_axis
from BendTorsionWB.shapes.curve_files import part_axis
from BendTorsionWB.shapes.iges_names import named_entities
from BendTorsionWB.shapes.surface_files import faces_from_file, shape_from_file

RADIUS = 20e3


def half_sphere():
    """Of a whole one Open CASCADE 7.8 loses the breadth in IGES."""
    return Part.makeSphere(RADIUS, *(FreeCAD.Vector(0, 0, z) for z in (0, 1)), -90, 90, 180).Faces[
        0
    ]


@pytest.fixture
def parts():
    spline = Part.BSplineCurve()
    spline.interpolate([FreeCAD.Vector(*p) for p in ((0, 0, 0), (5e3, 2e3, 0), (9e3, 0, 1e3))])
    vertices = [FreeCAD.Vector(*p) for p in ((0, 0, 0), (1e3, 0, 0), (1e3, 2e3, 0))]
    return [
        spline.toShape(),
        half_sphere(),
        Part.makeCircle(22e3),
        Part.makePolygon(vertices),
    ]


@pytest.fixture
def files(tmp_path, parts):
    """roof.igs, with a spline, half a sphere, a circle and a polygon, and roof.brep of the same."""
    shape = Part.Compound(parts)
    shape.exportIges(str(tmp_path / "roof.igs"))
    shape.exportBrep(str(tmp_path / "roof.brep"))
    return tmp_path


def rewritten(path, **changes):
    """An IGES file with the directory entries of these types changed: label, level, status."""
    lines = path.read_text(encoding="latin-1").splitlines()
    heads = [k for k, line in enumerate(lines) if line[72:73] == "D"][::2]
    for k in heads:
        change = changes.get(f"of{int(lines[k][:8])}")
        if change:
            label, level = change
            lines[k] = f"{lines[k][:32]}{level:8d}{lines[k][40:]}"
            lines[k + 1] = f"{lines[k + 1][:56]}{label:>8}{0:8d}{lines[k + 1][72:]}"
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")


def fault(call, *arguments):
    with pytest.raises(BendTorsionError) as caught:
        call(*arguments)
    (found,) = caught.value.findings
    return found


@pytest.mark.parametrize("name", ["roof.igs", "roof.brep"])
def test_curves_and_surfaces_are_chosen_by_number(files, parts, name):
    whole = shape_from_file(files / name)
    lengths = set()
    for number in (1, 2, 3):
        found = shape_from_file(files / name, f"curve{number}")
        assert not found.Faces
        lengths.add(round(found.Length, 3))
    assert lengths == {round(part.Length, 3) for part in parts if not part.Faces}
    (face,) = faces_from_file(files / name, "surface1").Faces
    assert face.Area == pytest.approx(2 * math.pi * RADIUS**2, rel=1e-6)
    assert len(whole.Faces) == 1
    circle = next(k for k in (1, 2, 3) if shape_from_file(files / name, f"Curve{k}").Length > 1e5)
    curve = part_axis(files / name, f"curve{circle}").curve
    assert np.linalg.norm(curve.evaluate(curve.breaks)[0], axis=1) == pytest.approx(22e3)


def test_what_the_file_holds_is_told_with_kind_and_size(files):
    for name in ("roof.igs", "roof.brep"):
        several = fault(part_axis, files / name)
        assert several.code == "axis-source-name" and several.value == 3
        assert "circle, 138230 mm" in several.mend and "wire, 3000 mm" in several.mend
        assert "surface" not in several.mend
        unknown = fault(faces_from_file, files / name, "curve7")
        assert unknown.code == "file-name-unknown" and "'curve7'" in unknown.message
        form = "revolved" if name == "roof.igs" else "sphere"
        assert f"surface1 ({form}, 40000 x 20000 x 40000 mm)" in unknown.mend
    assert fault(part_axis, files / "roof.brep", "surface1").code == "axis-file-empty"
    assert fault(faces_from_file, files / "roof.brep", "curve1").code == "surface-file-empty"


def test_one_iges_file_gives_a_schedule_its_surface_and_its_axes(tmp_path):
    half = Part.ArcOfCircle(Part.Circle(FreeCAD.Vector(), FreeCAD.Vector(0, 0, 1), RADIUS), 0, 2)
    ring = Part.ArcOfCircle(Part.Circle(FreeCAD.Vector(), FreeCAD.Vector(0, 1, 0), RADIUS), 0, 1)
    given = [half_sphere(), half.toShape(), ring.toShape()]
    Part.Compound(given).exportIges(str(tmp_path / "a.igs"))

    def jobs(one, other):
        axes = [["A1", "Hall", *[None] * 5], ["A2", "Hall", *[None] * 5]]
        axes[0][3], axes[1][3] = one, other
        surfaces = [["Hall", "file", "a.igs#surface1", None]]
        return project.read_jobs(
            write_schedule(tmp_path / "a.xlsx", surfaces, axes, [("M1", "A1"), ("M2", "A2")])
        )

    assert jobs("a.igs#curve1", "a.igs#curve2")
    rewritten(tmp_path / "a.igs", of100=("ARC", 5))
    with pytest.raises(BendTorsionError) as caught:
        jobs("a.igs", "a.igs#curve3")
    assert [f.position for f in caught.value.findings] == [
        "sheet Axes, row 2, column source",
        "sheet Axes, row 3, column source",
    ]
    assert all("curve2 (circle, 20000 mm" in f.mend for f in caught.value.findings)
    level = fault(part_axis, tmp_path / "a.igs", "level5")
    assert "'level5'" in level.message and "curve2 (circle, 20000 mm, ARC, level5)" in level.mend


def test_iges_labels_and_levels_name_parts(files):
    path = files / "roof.igs"
    rewritten(path, of126=("RIB", 2), of102=("EDGE", 2), of144=("DOME", 1), of120=("INNER", 9))
    names = [
        (entity.kind, entity.names) for entity in named_entities(path.read_text(encoding="utf-8"))
    ]
    assert sorted(names) == [
        ("curve", ()),
        ("curve", ("EDGE", "level2")),
        ("curve", ("RIB", "level2")),
        ("surface", ("DOME", "level1")),
    ]
    axis = part_axis(path, "RIB").curve
    assert axis.evaluate(axis.breaks)[0][-1] == pytest.approx([9e3, 0, 1e3], abs=1e-3)
    assert shape_from_file(path, "rib").Length == pytest.approx(10212, abs=1)
    assert len(faces_from_file(path, "DOME").Faces) == 1
    # Part of another: no part of its own.
    assert fault(faces_from_file, path, "INNER").code == "file-name-unknown"
    assert len(shape_from_file(path, "level2").Edges) == 3
    told = fault(shape_from_file, path, "level7").mend
    assert "mm, RIB, level2)" in told and told.endswith(")") and "mm, DOME, level1)" in told


def test_every_label_names_its_own_curve(tmp_path):
    """Lines of all lengths, loose and in a group of another order: the label tells the length."""
    lines = [Part.makeLine((0, 0, 0), (1000 * k, 0, 0)) for k in (1, 2, 3, 4, 5)]
    Part.Compound(lines).exportIges(str(tmp_path / "a.igs"))
    text = (tmp_path / "a.igs").read_text(encoding="utf-8").splitlines()
    heads = [k for k, line in enumerate(text) if line[72:73] == "D"][::2]
    heads = [k for k in heads if int(text[k][:8]) == 110]
    parameters = {
        int(line[64:72]): line[:64] for line in text if line[72:73] == "P" and line[:4] == "110,"
    }
    for k in heads:
        number = int(text[k][73:80])
        end = [float(v) for v in parameters[number].rstrip(" ;").split(",")[1:]]
        length = round(abs(end[3] - end[0]))
        text[k + 1] = f"{text[k + 1][:56]}{f'L{length}':>8}{0:8d}{text[k + 1][72:]}"
    grouped = "\n".join(text) + "\n"
    first = next(line for line in text if line.startswith("402,"))
    body = first[:64].rstrip().rstrip(";").split(",")
    turned = ",".join([*body[:2], *reversed(body[2:])]) + ";"
    for content in (grouped, grouped.replace(first[:64], turned.ljust(64))):
        (tmp_path / "a.igs").write_text(content, encoding="utf-8")
        for length in (1000, 2000, 3000, 4000, 5000):
            found = shape_from_file(tmp_path / "a.igs", f"L{length}")
            assert found.Length == pytest.approx(length)


def test_a_name_property_names_its_entity():
    def entry(number, kind, first, form=0, status="00000000", level=0):
        one = f"{kind:8d}{first:8d}{0:8d}{0:8d}{level:8d}{0:8d}{0:8d}{0:8d}{status}D{number:7d}"
        other = f"{kind:8d}{0:8d}{0:8d}{1:8d}{form:8d}{'':16}{'':8}{0:8d}D{number + 1:7d}"
        return [one, other]

    lines = [
        *entry(1, 110, 1),
        *entry(3, 406, 2, 15),
        *entry(5, 110, 3, level=4),
        f"{'110,0.,0.,0.,9.,0.,0.,0,1,3;':64}{1:8d}P{1:7d}",
        f"{'406,1,7HRIB A,1;':64}{3:8d}P{2:7d}",
        f"{'110,0.,0.,0.,5.,0.,0.;':64}{5:8d}P{3:7d}",
    ]
    found = named_entities("\n".join(lines))
    assert [entity.names for entity in found] == [("RIB A,1",), ("level4",)]
    assert named_entities("torn") == () and named_entities("\n".join(lines[1:2])) == ()
    assert named_entities("\n".join(["x" * 72 + "D"] * 2)) == ()


def test_colours_choose_parts_as_levels_do(files):
    """The sphere green, the spline red, the circle in a colour of the file's own."""
    path = files / "roof.igs"
    lines = path.read_text(encoding="latin-1").splitlines()
    heads = [k for k, line in enumerate(lines) if line[72:73] == "D"][::2]
    count = sum(line[72:73] == "P" for line in lines)
    [end] = [k for k, line in enumerate(lines) if line[72:73] == "T"]
    own = 2 * len(heads) + 1
    for k in heads:
        colour = {126: 2, 144: 3, 100: -own}.get(int(lines[k][:8]), 0)
        lines[k + 1] = f"{lines[k + 1][:16]}{colour:8d}{lines[k + 1][24:]}"
    lines[end:end] = [f"{'314,100.,50.2,0.,6HORANGE;':64}{own:8d}P{count + 1:7d}"]
    last = heads[-1] + 2
    lines[last:last] = [
        f"{314:8d}{count + 1:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{'00000200'}D{own:7d}",
        f"{314:8d}{0:8d}{0:8d}{1:8d}{0:8d}{'':16}{'':8}{0:8d}D{own + 1:7d}",
    ]
    lines[-1] = f"{lines[-1][:16]}D{own + 1:7d}P{count + 1:7d}{lines[-1][32:]}"
    path.write_text("\n".join(lines) + "\n", encoding="latin-1")
    assert shape_from_file(path, "colour-red").Length == pytest.approx(10212, abs=1)
    assert len(faces_from_file(path, "colour-green").Faces) == 1
    ring = part_axis(path, "Colour-FF8000").curve
    assert np.linalg.norm(ring.evaluate(ring.breaks)[0], axis=1) == pytest.approx(22e3)
    told = fault(shape_from_file, path, "colour-blue").mend
    assert "colour-red" in told and "138230 mm, colour-ff8000" in told


def test_levels_in_a_list_are_names_each():
    head = f"{110:8d}{1:8d}{0:8d}{0:8d}{-3:8d}{0:8d}{0:8d}{0:8d}{'00000000'}D{1:7d}"
    lines = [
        head,
        f"{110:8d}{0:8d}{-9:8d}{1:8d}{0:8d}{'':16}{'':8}{0:8d}D{2:7d}",
        f"{406:8d}{2:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{'00010000'}D{3:7d}",
        f"{406:8d}{0:8d}{0:8d}{1:8d}{1:8d}{'':16}{'':8}{0:8d}D{4:7d}",
        f"{'110,0.,0.,0.,9.,0.,0.;':64}{1:8d}P{1:7d}",
        f"{'406,2,4,12;':64}{3:8d}P{2:7d}",
    ]
    [line] = named_entities("\n".join(lines))
    assert line.names == ("level4", "level12")


def test_a_missing_drawing_is_no_damaged_one(tmp_path):
    found = fault(dxf_axis, tmp_path / "none.dxf")
    assert (found.code, found.value) == ("file-missing", "none.dxf")
    assert "no such file" in found.message and "R2000" not in found.mend
