# SPDX-License-Identifier: LGPL-2.1-or-later
"""Open documents and files in scripts: layers by other names, schedules with sheets or without."""

import FreeCAD
import pytest

from BendTorsionWB import make, make_files
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.patterns.layer_names import LAYERS, layer_names
from BendTorsionWB.exchange import dxf


@pytest.fixture(scope="module")
def document():
    """One short member with patterns, whose outer contours go on the layer 10."""
    document = FreeCAD.newDocument("files", hidden=True)
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (2500, 0, 0)])
    section = make.make_section(document, "S", h=400, b=300, t=12)
    plates = make.make_plates(document, make.make_member(document, "M1", axis, [section]))
    make.make_unfold(document, plates, layers={"CUT_OUTER": "10", "MARK_TEXT": "MARK_TEXT"})
    document.recompute()
    yield document
    FreeCAD.closeDocument(document.Name)


def test_imported_shapes_hold_faces_and_free_curves(tmp_path):
    """A face and two curves that belong to none, which FreeCAD's own import may leave out."""
    import Part

    path = tmp_path / "roof.step"
    curves = [Part.makeLine((0, y, 100), (900, y, 100)) for y in (200, 400)]
    Part.Compound([Part.makePlane(1000, 500), *curves]).exportStep(str(path))
    document = FreeCAD.newDocument("shapes", hidden=True)
    try:
        made = make_files.import_shapes(document, path)
        assert made.Label == "roof" and len(made.Shape.Faces) == 1
        assert len(made.Shape.Edges) == 4 + 2
        assert made.Shape.BoundBox.ZMax == pytest.approx(100.0, abs=1e-6)
        path.write_text("nothing", encoding="ascii")
        with pytest.raises(BendTorsionError) as caught:
            make_files.import_shapes(document, path)
        assert caught.value.findings[0].code == "file-unreadable"
        assert document.Objects == [made]
    finally:
        FreeCAD.closeDocument(document.Name)


def test_layers_of_cut_files_by_other_names(document, tmp_path):
    """The package has them, read back by ezdxf; the rest keeps the names of the contract."""
    import ezdxf

    make_files.write_package(document, tmp_path)
    drawing = ezdxf.readfile(tmp_path / "plates" / "M1-T1.dxf")
    names = {layer.dxf.name for layer in drawing.layers}
    assert "10" in names and "CUT_OUTER" not in names and "MARK_LINE" in names
    outlines = drawing.modelspace().query("LWPOLYLINE[layer=='10']")
    assert len(outlines) == 1 and outlines[0].closed
    assert FreeCAD.ActiveDocument is None or FreeCAD.ActiveDocument.Name == document.Name


def test_changed_names_write_changed_files_only(document, tmp_path):
    """A package written again keeps its files; with another name it writes them anew."""
    unfold = next(item for item in document.Objects if getattr(item, "BT_Type", "") == "Unfold")
    before = list(unfold.LayerNames)
    make_files.write_package(document, tmp_path)
    path = tmp_path / "plates" / "M1-T1.dxf"
    first = path.read_bytes()
    unfold.LayerNames = ["CUT_OUTER=11"]
    make_files.write_package(document, tmp_path)
    assert path.read_bytes() != first
    unfold.LayerNames = before
    make_files.write_package(document, tmp_path)
    assert path.read_bytes() == first


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (["CUT=10"], "layer 'CUT' is not written"),
        (["CUT_OUTER=a/b"], "cannot be a layer name"),
        (["CUT_OUTER="], "cannot be a layer name"),
        (["CUT_OUTER=punch"], "two layers have one name"),
    ],
)
def test_names_that_cannot_be(document, lines, words):
    """Refused by the function; an error of the patterns when typed into their property."""
    with pytest.raises(BendTorsionError, match=words.replace("'", ".")):
        layer_names(lines, "M1 patterns")
    unfold = next(item for item in document.Objects if getattr(item, "BT_Type", "") == "Unfold")
    before = list(unfold.LayerNames)
    unfold.LayerNames = lines
    document.recompute()
    assert words in unfold.Status
    unfold.LayerNames = before
    document.recompute()
    assert unfold.Status == "ok"


def test_the_layers_are_those_of_the_cut_files():
    assert set(LAYERS) == set(dxf.LAYERS)


def test_a_schedule_opens_with_sheets_or_without(document, tmp_path):
    """Written from the document, it gives the same plates; progress is told on the way."""
    path = tmp_path / "back.xlsx"
    make_files.write_schedule(document, path)
    told = []
    token = make_files.PROGRESS.set(lambda what, done, count: told.append(what))
    try:
        kinds = []
        for sheets in (False, True):
            again = make_files.open_schedule(path, sheets=sheets)
            kinds.append([getattr(item, "BT_Type", "") for item in again.Objects])
            plates = next(i for i in again.Objects if getattr(i, "BT_Type", "") == "PlateSet")
            assert plates.Volume.Value == pytest.approx((400 * 300 - 376 * 276) * 2500.0)
            FreeCAD.closeDocument(again.Name)
    finally:
        make_files.PROGRESS.reset(token)
    assert "SheetSet" not in kinds[0] and "SheetSet" in kinds[1]
    assert {"members", "document"} <= set(told)


def test_stopped_work_leaves_no_document(document, tmp_path):
    """What progress raises comes out, and the half-made document is gone."""
    path = tmp_path / "back.xlsx"
    make_files.write_schedule(document, path)
    open_before = set(FreeCAD.listDocuments())

    class Stop(Exception):
        pass

    def stop(what, done, count):
        if what == "document" and done == 3:
            raise Stop

    token = make_files.PROGRESS.set(stop)
    try:
        with pytest.raises(Stop):
            make_files.open_schedule(path)
    finally:
        make_files.PROGRESS.reset(token)
    assert set(FreeCAD.listDocuments()) == open_before


def test_templates_open_and_are_not_written_over(tmp_path):
    path = tmp_path / "mine.FCStd"
    opened = make_files.open_template("member", path)
    try:
        assert opened.FileName == str(path)
        with pytest.raises(BendTorsionError, match="is there already"):
            make_files.open_template("member", path)
    finally:
        FreeCAD.closeDocument(opened.Name)
