# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of architects that were cut short are told as such, whole ones are read."""

import ezdxf
import FreeCAD
import Part
import pytest

from BendTorsionWB.core.file_end import is_cut_short
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.curve_files import dxf_axes
from BendTorsionWB.shapes import surface_files
from BendTorsionWB.shapes.curve_files import part_axis
from BendTorsionWB.shapes.surface_files import faces_from_file

KINDS = {"roof.step": "STEP", "roof.igs": "IGES", "roof.brep": "BREP", "axes.dxf": "DXF"}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A folder with a torus and a dome in each kind of file, and lines as DXF."""
    folder = tmp_path_factory.mktemp("whole")
    shape = Part.Compound([Part.makeTorus(30e3, 8e3).Faces[0], Part.makeSphere(20e3).Faces[0]])
    shape.exportStep(str(folder / "roof.step"))
    shape.exportIges(str(folder / "roof.igs"))
    shape.exportBrep(str(folder / "roof.brep"))
    drawing = ezdxf.new("R2000", units=4)
    for k in range(40):
        drawing.modelspace().add_line((k, 0, 0), (k + 1, 0, 0), dxfattribs={"layer": "A1"})
    drawing.saveas(folder / "axes.dxf")
    drawing.saveas(folder / "binary.dxf", fmt="bin")
    return folder


def read(path):
    return dxf_axes(path) if path.suffix == ".dxf" else faces_from_file(path, "", "Roof")


@pytest.mark.parametrize("name", [*KINDS, "binary.dxf"])
def test_a_whole_file_is_whole_with_other_line_ends_and_blanks_behind_too(whole, tmp_path, name):
    content = (whole / name).read_bytes()
    variants = [content]
    if name != "binary.dxf":
        lines = content.replace(b"\r\n", b"\n")
        variants += [lines, lines.replace(b"\n", b"\r\n"), content.rstrip(), content + b"\n \n\n"]
    for number, variant in enumerate(variants):
        path = tmp_path / f"{number}-{name}"
        path.write_bytes(variant)
        assert not is_cut_short(path, KINDS.get(name, "DXF")), number
    assert read(whole / name)


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7, 0.9, 0.99])
@pytest.mark.parametrize("name", [*KINDS, "binary.dxf"])
def test_one_cut_short_is_refused_and_told(whole, tmp_path, name, share):
    content = (whole / name).read_bytes().rstrip()
    path = tmp_path / name
    path.write_bytes(content[: min(int(share * len(content)), len(content) - 4)])
    with pytest.raises(BendTorsionError) as caught:
        read(path)
    [finding] = caught.value.findings
    assert "the file is cut short" in finding.message and "copy it again" in finding.mend
    assert finding.code == ("axis-file" if name.endswith("dxf") else "file-unreadable")


def test_the_named_part_of_a_step_file_cut_short_is_refused_for_axes_and_surfaces(tmp_path):
    """Its first half may hold the whole part."""
    import Import

    document = FreeCAD.newDocument("named", hidden=True)
    for label, shape in (
        ("shell", Part.makeTorus(30e3, 8e3).Faces[0]),
        ("b", Part.makeBox(1, 2, 3)),
    ):
        feature = document.addObject("Part::Feature", "Part")
        feature.Label, feature.Shape = label, shape
    document.recompute()
    path = tmp_path / "roof.step"
    Import.export(document.Objects, str(path))
    FreeCAD.closeDocument(document.Name)
    content = path.read_bytes()
    assert faces_from_file(path, "shell").Faces
    path.write_bytes(content[: content.index(b"END-ISO")])
    for reader in (faces_from_file, part_axis):
        with pytest.raises(BendTorsionError, match="cut short"):
            reader(path, "shell")


def test_a_file_that_may_not_be_read_is_named_with_its_reason(whole, monkeypatch):
    def refused(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(surface_files, "is_cut_short", refused)
    with pytest.raises(BendTorsionError) as told:
        surface_files.shape_from_file(whole / "roof.step")
    [finding] = told.value.findings
    assert "Permission denied" in finding.message and "allow reading it" in finding.mend


def test_a_signature_may_follow_the_end_of_a_step_file(whole, tmp_path):
    """ISO 10303-21:2016, 13: of any length."""
    path = tmp_path / "signed.step"
    signature = b"SIGNATURE;\n" + b"MIIB" * 3000 + b"\nENDSEC;\n"
    path.write_bytes((whole / "roof.step").read_bytes() + signature)
    assert not is_cut_short(path, "STEP") and len(faces_from_file(path).Faces) == 2


@pytest.mark.parametrize("name", ["a.step", "a.igs", "a.brep", "a.dxf"])
def test_what_is_no_file_of_its_kind_is_not_called_cut_short(tmp_path, name):
    (tmp_path / name).write_text("torn", encoding="utf-8")
    with pytest.raises(BendTorsionError) as caught:
        read(tmp_path / name)
    assert "cut short" not in str(caught.value)
