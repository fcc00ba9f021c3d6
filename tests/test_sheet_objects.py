# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets in a document: TechDraw shows what the sheet model says, and follows every edit."""

import json
import os
import re
import subprocess
import sys
import types
from pathlib import Path

import FreeCAD
import numpy as np
import Part
import pytest
import TechDraw  # noqa: F401
from sheet_checks import told
from test_sheet import strip_member

from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_page import SIGNED_CELLS
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.objects import sheet as sheet_objects
from BendTorsionWB.objects.arrangement import ArrangementSet
from BendTorsionWB.objects.sheet_content import style_of
from BendTorsionWB.sheets.pdf import start_qt, write_pdf
from BendTorsionWB.sheets.techdraw import symbol_svg, template_path

STYLE = SheetStyle("Concert hall")
FRAME, TITLE_BLOCK = STYLE.page.frame, STYLE.page.title_block
FAULT = error("thickness", "M1", "too thick", "reduce t")
RECORDS = {
    1: strip_member(lengths=(2500.0, 3000.0)),
    2: strip_member(lengths=(2500.0, 3000.0, 1500.0)),
    9: strip_member(lengths=tuple(1500.0 + 100.0 * k for k in range(12))),
    -1: MemberRecord("M1", "", "box1", findings=(FAULT,)),
}


class Source:
    """Stands for an Unfold: Choice says which record it gives."""

    def execute(self, obj):
        pass

    def declared(self, obj):
        return ()

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__ = dumps
    __setstate__ = loads


def add_choice(source):
    source.addProperty("App::PropertyInteger", "Choice")
    source.addProperty("App::PropertyString", "BT_Type")
    source.addProperty("App::PropertyStringList", "Findings")
    source.addProperty("App::PropertyString", "Status")
    source.Choice, source.BT_Type, source.Status = 1, "Unfold", "ok"


class Failing(Source):
    def execute(self, obj):
        raise ValueError("always")


@pytest.fixture(autouse=True)
def records(monkeypatch):
    module = types.ModuleType("BendTorsionWB.objects.unfold")
    module.member_record_of = lambda obj: RECORDS[obj.Choice]
    monkeypatch.setitem(sys.modules, "BendTorsionWB.objects.unfold", module)


@pytest.fixture
def document():
    document = FreeCAD.newDocument("Sheets")
    document.UndoMode = 1
    source = document.addObject("App::FeaturePython", "Source")
    source.Proxy = Source()
    add_choice(source)
    sheets = document.addObject("App::FeaturePython", "M1_Sheets")
    sheet_objects.SheetSet(sheets)
    sheets.Unfold, sheets.Project = source, "Concert hall"
    document.recompute()
    document.clearUndos()
    yield document
    settle()
    FreeCAD.closeDocument(document.Name)


def pages(document):
    found = [obj for obj in document.Objects if obj.isDerivedFrom("TechDraw::DrawPage")]
    return sorted(found, key=lambda page: outlines_of(page).Index)


def view_of(page):
    (view,) = [view for view in page.Views if view.isDerivedFrom("TechDraw::DrawViewPart")]
    return view


def symbol_of(page):
    (view,) = [view for view in page.Views if view.isDerivedFrom("TechDraw::DrawViewSymbol")]
    return view


def outlines_of(page):
    return view_of(page).Source[0]


def shown(document):
    """Per page, the symbol and the vertices of the view on paper, rounded to 1e-4 mm."""
    return [
        (symbol_of(page).Symbol, sorted(map(tuple, np.round(vertices(page), 4))))
        for page in pages(document)
    ]


def settle():
    """FreeCAD 1.0 removes hidden lines in threads, and takes their results in an event loop."""
    core, _ = start_qt()
    for _ in range(3):
        core.QThreadPool.globalInstance().waitForDone()
        core.QCoreApplication.processEvents()


def vertices(page):
    settle()
    view = view_of(page)
    count = len(outlines_of(page).Shape.Vertexes)
    points = []
    for k in range(count):
        try:
            points.append(view.getVertexByIndex(k).Point)
        except ValueError:
            break
    return np.array(points)[:, :2] * view.Scale + (view.X.Value, view.Y.Value)


def solid_points(sheet):
    left, bottom, right, top = sheet.frame
    points = [(left, bottom), (right, bottom), (right, top), (left, top)]
    for view in sheet.views:
        for line in view.on_page():
            if line.style in ("wide", "medium", "narrow"):
                points += line.points
    return np.array(points)


def farthest(points, others):
    return max(np.min(np.hypot(*(others - point).T)) for point in points)


def check(document, choice):
    settle()
    sheets = member_sheets(RECORDS[choice], STYLE)
    assert document.M1_Sheets.PageCount == len(sheets) == len(pages(document))
    assert len(document.Objects) == 2 + 5 * len(sheets)
    assert all(obj.State == ["Up-to-date"] for obj in document.Objects)
    for page, sheet in zip(pages(document), sheets, strict=True):
        assert symbol_of(page).Symbol == symbol_svg(sheet)
        assert page.Label == f"M1_Sheets {sheet.number}"


def test_views_show_the_sheet_model_within_a_hundredth_of_a_millimetre(document):
    check(document, 1)
    for page, sheet in zip(pages(document), member_sheets(RECORDS[1], STYLE), strict=True):
        drawn, model = vertices(page), solid_points(sheet)
        assert len(drawn) > 4 or not sheet.views
        assert farthest(drawn, model) < 0.01
        assert farthest(model, drawn) < 0.01
        if sheet.views:
            assert view_of(page).Scale == pytest.approx(1.0 / sheet.views[0].scale, rel=1e-12)


def test_edits_add_and_remove_pages_by_plain_recompute(document):
    before = shown(document)
    for choice in (2, 9, 1, -1, 9, 1):
        document.Source.Choice = choice
        document.recompute()
        check(document, choice)
    assert shown(document) == before


def test_parts_of_a_page_are_labelled_after_it_unless_they_were_given_a_label(document):
    """In the tree; their names, which the file knows them by, stay."""
    first = pages(document)[0]
    view, symbol = view_of(first), symbol_of(first)
    parts = first.Template, view, symbol, outlines_of(first)
    names = [part.Name for part in parts]
    words = ["fields", "views", "text", "lines"]
    assert [part.Label for part in parts] == [f"{first.Label} {word}" for word in words]
    symbol.Label = "Mine"
    document.M1_Sheets.Label = "Other"
    document.M1_Sheets.touch()
    document.recompute()
    assert first.Label.startswith("Other ") and symbol.Label == "Mine"
    assert view.Label == f"{first.Label} views" and [part.Name for part in parts] == names


def test_a_recompute_asks_for_the_record_once_however_many_pages(document, monkeypatch):
    module, asked = sys.modules["BendTorsionWB.objects.unfold"], []
    given = module.member_record_of
    monkeypatch.setattr(module, "member_record_of", lambda obj: asked.append(obj) or given(obj))
    for choice in (9, 2):
        document.Source.Choice = choice
        document.recompute()
        check(document, choice)
    assert len(pages(document)) > 1 and len(asked) == 2


def test_undo_and_redo_bring_pages_back(document):
    before = shown(document)
    for choice in (9, -1):
        document.openTransaction("edit")
        document.Source.Choice = choice
        document.recompute()
        document.commitTransaction()
    document.undo()
    document.recompute()
    check(document, 9)
    document.undo()
    document.recompute()
    check(document, 1)
    assert shown(document) == before
    document.redo()
    document.redo()
    document.recompute()
    check(document, -1)


def test_saved_and_reopened_sheets_are_the_same_and_still_follow(document, tmp_path):
    before = shown(document)
    document.saveAs(str(tmp_path / "sheets.FCStd"))
    again = FreeCAD.openDocument(str(tmp_path / "sheets.FCStd"))
    try:
        assert shown(again) == before
        for obj in again.Objects:
            obj.touch()
        again.recompute()
        check(again, 1)
        assert shown(again) == before
        again.Source.Choice = 9
        again.recompute()
        check(again, 9)
    finally:
        if again.Name != document.Name:
            FreeCAD.closeDocument(again.Name)


def test_outlines_are_saved_alike_before_and_after_techdraw_took_them(document, tmp_path):
    """It puts them into a compound of its own, which Open CASCADE notes in the shape."""
    outlines = outlines_of(pages(document)[0])
    outlines.recompute()
    made = _saved(outlines.Shape, tmp_path)
    assert Part.Compound([outlines.Shape]).Edges and _saved(outlines.Shape, tmp_path) == made


def _saved(shape, folder):
    shape.exportBinary(str(folder / "shape.bin"))
    return (folder / "shape.bin").read_bytes()


def test_a_member_in_error_empties_its_sheets_and_mending_restores_them(document):
    before = shown(document)
    document.Source.Choice = -1
    document.recompute()
    (page,) = pages(document)
    assert "M1: IN ERROR" in told(symbol_of(page).Symbol) and "reduce t" in told(
        symbol_of(page).Symbol
    )
    assert vertices(page).min(axis=0) == pytest.approx(FRAME[:2], abs=0.01)
    assert len(vertices(page)) == 4
    assert document.M1_Sheets.Status == FAULT.line()
    document.Source.Choice = 1
    document.recompute()
    assert shown(document) == before
    document.Source.Findings = [json.dumps(FAULT.as_dict())]
    document.recompute()
    (page,) = pages(document)
    assert "IN ERROR" in told(symbol_of(page).Symbol) and "reduce t" in told(symbol_of(page).Symbol)


def test_a_deleted_source_and_a_deleted_page_are_dealt_with(document):
    document.removeObject(pages(document)[1].Name)
    document.M1_Sheets.touch()
    document.recompute()
    document.recompute()
    assert [outlines_of(page).Index for page in pages(document)] == list(
        range(document.M1_Sheets.PageCount)
    )
    document.removeObject("Source")
    document.recompute()
    (page,) = pages(document)
    assert "link-missing" in document.M1_Sheets.Findings[0]
    assert "Unfold is not set" in told(symbol_of(page).Symbol)


def test_surplus_pages_wait_for_a_recompute_without_errors(document):
    bad = document.addObject("App::FeaturePython", "Bad")
    bad.Proxy = Failing()
    document.Source.Choice = -1
    document.recompute()
    assert document.M1_Sheets.PageCount == 1 < len(pages(document))
    assert "no longer used" in told(symbol_of(pages(document)[1]).Symbol)
    document.removeObject("Bad")
    document.recompute()
    check(document, -1)


EXPORT = """
import os, sys, types
from BendTorsionWB.gui.qt import QtWidgets
application = QtWidgets.QApplication([])
import test_sheet_objects as this
import FreeCAD, FreeCADGui
FreeCADGui.showMainWindow()
import TechDrawGui
unfold = types.ModuleType("BendTorsionWB.objects.unfold")
unfold.member_record_of = lambda obj: this.RECORDS[obj.Choice]
sys.modules["BendTorsionWB.objects.unfold"] = unfold
document = FreeCAD.newDocument("Sheets")
source = document.addObject("App::FeaturePython", "Source")
source.Proxy = this.Source()
this.add_choice(source)
sheets = document.addObject("App::FeaturePython", "M1_Sheets")
this.sheet_objects.SheetSet(sheets)
sheets.Unfold, sheets.Project = source, "Concert hall"
document.recompute()
TechDrawGui.exportPageAsPdf(this.pages(document)[1], sys.argv[1])
source.Choice = 9
document.recompute()
source.Choice = -1
document.recompute()
os._exit(0 if len(this.pages(document)) == 1 else 1)
"""


def pixels(pdf, page):
    """The page at 10 dots per mm, True where black."""
    done = subprocess.run(
        ["pdftoppm", "-r", "254", "-gray", "-f", str(page), "-l", str(page), str(pdf)],
        capture_output=True,
        check=True,
    )
    header = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", done.stdout)
    shape = int(header[2]), int(header[1])
    return np.frombuffer(done.stdout[header.end() :], np.uint8).reshape(shape) < 110


def test_techdraw_page_and_pdf_put_the_same_ink_in_the_same_places(tmp_path):
    here = Path(__file__).resolve().parent
    program = "import sys; sys.path[:0] = sys.argv[2:4]; import conftest\n" + EXPORT
    environment = {**os.environ, "PYTHONUTF8": "1"}
    # Another test's platform raises no windows: FreeCAD 1.0 waits for itself when told so.
    environment.pop("QT_QPA_PLATFORM", None)
    subprocess.run(
        [
            *("xvfb-run", "-a", sys.executable, "-c", program),
            *(str(tmp_path / "page.pdf"), str(here), str(here.parent)),
        ],
        env=environment,
        check=True,
        timeout=120,
        capture_output=True,
    )
    write_pdf(member_sheets(RECORDS[1], STYLE), tmp_path / "ours.pdf")
    techdraw, ours = pixels(tmp_path / "page.pdf", 1), pixels(tmp_path / "ours.pdf", 2)
    for one, other in ((techdraw, ours), (ours, techdraw)):
        rows, columns = min(len(one), len(other)), min(one.shape[1], other.shape[1])
        near = np.zeros((rows, columns), bool)
        reach = 4  # 0.4 mm: half a line width; letters of long lines drift further apart
        for down in range(-reach, reach + 1):
            for right in range(-reach, reach + 1):
                near |= np.roll(other, (down, right), (0, 1))[:rows, :columns]
        ink = one[:rows, :columns]
        assert ink.sum() > 100_000
        assert (ink & ~near).sum() < 1e-2 * ink.sum()


def test_template_fields_stand_in_the_blank_cells_of_the_title_block(document):
    template = pages(document)[0].Template
    assert template.Template.endswith("A3.svg") or template.PageResult
    assert sorted(template.EditableTexts) == sorted(SIGNED_CELLS)
    assert (template.Width, template.Height) == (420.0, 297.0)
    text = open(template_path(member_sheets(RECORDS[1])[0]), encoding="utf-8").read()
    width = (TITLE_BLOCK[2] - TITLE_BLOCK[0]) / len(SIGNED_CELLS)
    for number, cell in enumerate(SIGNED_CELLS):
        left = TITLE_BLOCK[0] + number * width
        x = float(text.split(f'editable="{cell}" x="')[1].split('"')[0])
        assert left < x < left + 3.0


def test_format_standard_language_and_site_follow_their_properties(document):
    before = shown(document)
    sheets = document.M1_Sheets
    document.openTransaction("format")
    sheets.SheetFormat, sheets.SheetStandard, sheets.SheetUnit = "A1", "AWS", "ft-in"
    sheets.SheetLanguage, sheets.SiteRotation = "zh", 90.0
    document.recompute()
    document.commitTransaction()
    style = style_of(sheets)
    assert (style.format, style.standard, style.language, style.unit) == (
        "A1",
        "AWS",
        "zh",
        "ft-in",
    )
    assert style.site.rotation == pytest.approx(np.pi / 2, abs=1e-12)
    wanted = member_sheets(RECORDS[1], style)
    document.recompute()
    assert len(pages(document)) == len(wanted)
    for page, sheet in zip(pages(document), wanted, strict=True):
        assert symbol_of(page).Symbol == symbol_svg(sheet)
        assert (page.Template.Width.Value, page.Template.Height.Value) == (841.0, 594.0)
        drawn, model = vertices(page), solid_points(sheet)
        assert farthest(drawn, model) < 0.01
        assert farthest(model, drawn) < 0.01
    document.undo()
    document.recompute()
    assert shown(document) == before


def test_the_general_arrangement_is_a_page_that_follows_its_members(document):
    arrangement = document.addObject("App::FeaturePython", "Arrangement")
    ArrangementSet(arrangement)
    arrangement.Sheets = [document.M1_Sheets]
    document.recompute()
    own = [page for page in pages(document) if outlines_of(page).Set == arrangement]
    assert arrangement.PageCount == len(own) == 1 and arrangement.Status == "ok"
    wanted = arrangement_sheets([RECORDS[1]], style_of(document.M1_Sheets))
    assert symbol_of(own[0]).Symbol == symbol_svg(wanted[0])
    document.Source.Choice = 9
    document.recompute()
    wanted = arrangement_sheets([RECORDS[9]], style_of(document.M1_Sheets))
    assert symbol_of(own[0]).Symbol == symbol_svg(wanted[0])
    document.Source.Choice = -1
    document.recompute()
    assert "no member can be drawn" in told(symbol_of(own[0]).Symbol)
    arrangement.Sheets = []
    document.recompute()
    assert arrangement.PageCount == 1 and "no member can be drawn" in told(symbol_of(own[0]).Symbol)
