# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents as they are saved: shapes to the last digit, the same bytes, preferences untouched."""

import zipfile

import FreeCAD
import Part
import pytest

from BendTorsionWB.model_files import save
from BendTorsionWB.objects.preference import preference

SETTINGS = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Document")


@pytest.fixture
def document():
    made = FreeCAD.newDocument("saving", hidden=True)
    points = [FreeCAD.Vector(0.1 * k, (1.0 / 3.0) ** k, 2.0**0.5 * k) for k in range(7)]
    spline = Part.BSplineCurve()
    spline.interpolate(points)
    made.addObject("Part::Feature", "Curve").Shape = spline.toShape()
    made.addObject("Part::Feature", "Box").Shape = Part.makeBox(1.0 / 3.0, 2.0, 3.0)
    made.recompute()
    yield made
    FreeCAD.closeDocument(made.Name)


def test_shapes_come_back_to_the_last_digit(document, tmp_path):
    save(document, tmp_path / "model.FCStd")
    again = FreeCAD.openDocument(str(tmp_path / "model.FCStd"), hidden=True)
    try:
        curve, saved = document.Curve.Shape.Edge1.Curve, again.Curve.Shape.Edge1.Curve
        assert [tuple(pole) for pole in saved.getPoles()] == [tuple(p) for p in curve.getPoles()]
        assert saved.getKnots() == curve.getKnots()
        corners = [[tuple(v.Point) for v in d.Box.Shape.Vertexes] for d in (document, again)]
        assert corners[0] == corners[1] and again.Box.Shape.isValid()
    finally:
        FreeCAD.closeDocument(again.Name)


def test_the_same_document_gives_the_same_bytes_packed_and_without_times(document, tmp_path):
    for name in ("one", "two"):
        save(document, tmp_path / f"{name}.FCStd")
    assert (tmp_path / "one.FCStd").read_bytes() == (tmp_path / "two.FCStd").read_bytes()
    with zipfile.ZipFile(tmp_path / "one.FCStd") as saved:
        assert {info.compress_type for info in saved.infolist()} == {zipfile.ZIP_DEFLATED}
        assert {info.date_time for info in saved.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert sum(name.endswith(".bin") for name in saved.namelist()) == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.FCStd", "two.FCStd"]


def test_what_was_set_to_what_it_is_changes_no_byte_and_what_is_to_be_computed_is_kept(
    document, tmp_path
):
    """TechDraw sets results of its views anew, sooner or later: that is no edit."""
    box = document.Box
    output = 8
    box.addProperty("App::PropertyStringList", "Lines", "Result", "", output)
    box.Lines = ["one"]
    box.touch()
    document.recompute()
    save(document, tmp_path / "one.FCStd")
    box.Lines = ["one"]
    assert "Touched" not in box.State
    save(document, tmp_path / "two.FCStd")
    assert (tmp_path / "one.FCStd").read_bytes() == (tmp_path / "two.FCStd").read_bytes()
    box.touch()
    save(document, tmp_path / "two.FCStd")
    again = FreeCAD.openDocument(str(tmp_path / "two.FCStd"), hidden=True)
    try:
        assert "Touched" in again.Box.State and "Touched" not in again.Curve.State
    finally:
        FreeCAD.closeDocument(again.Name)


@pytest.mark.parametrize("binary", [None, True, False])
def test_how_documents_are_saved_otherwise_stays(document, tmp_path, binary):
    SETTINGS.RemBool("SaveBinaryBrep")
    if binary is not None:
        SETTINGS.SetBool("SaveBinaryBrep", binary)
    SETTINGS.SetInt("CompressionLevel", 7)
    try:
        save(document, tmp_path / "model.FCStd")
        assert SETTINGS.GetInt("CompressionLevel", 3) == 7
        assert ("SaveBinaryBrep" in SETTINGS.GetBools()) is (binary is not None)
        assert SETTINGS.GetBool("SaveBinaryBrep", False) is bool(binary)
    finally:
        SETTINGS.RemBool("SaveBinaryBrep")
        SETTINGS.RemInt("CompressionLevel")


def test_a_number_that_is_a_preference_holds_inside_the_block_only():
    with preference("Document", "CompressionLevel", 2):
        assert SETTINGS.GetInt("CompressionLevel", 3) == 2
    assert "CompressionLevel" not in SETTINGS.GetInts()
