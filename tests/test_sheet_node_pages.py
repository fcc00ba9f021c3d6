# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawings of nodes in a document: pages that show the same as the files, and follow edits."""

import FreeCAD
import Part  # noqa: F401
import pytest
from carried_document import make_document
from sheet_checks import told

from BendTorsionWB import make
from BendTorsionWB.core.drawings.sheet_node import node_sheets
from BendTorsionWB.core.welds.landed_marks import with_landed_marks
from BendTorsionWB.objects.sheet_content import record_of, style_of
from BendTorsionWB.sheets.pdf import start_qt
from BendTorsionWB.sheets.techdraw import symbol_svg


def of_kind(document, kind):
    return [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == kind]


def node_pages(document):
    """Page and symbol of each page of the node sheets, in order."""
    symbols = [s for s in of_kind(document, "PageSymbol") if s.Set.BT_Type == "NodeSheets"]
    symbols.sort(key=lambda symbol: symbol.Index)
    return [(page, symbol) for symbol in symbols for page in symbol.InList]


@pytest.fixture
def document():
    start_qt()
    document = make_document("NodePages")
    sets = of_kind(document, "SheetSet")
    branch = next(obj for obj in of_kind(document, "Unfold") if obj is not sets[0].Unfold)
    sets.append(make.make_sheets(document, branch, plate_pages=False))
    make.make_node_sheets(document, sets)
    document.recompute()
    yield document
    FreeCAD.closeDocument(document.Name)


def test_the_pages_of_nodes_show_what_the_files_show_and_follow_edits(document, tmp_path):
    (drawn,) = of_kind(document, "NodeSheets")
    for edited in (False, True):
        if edited:
            (node,) = of_kind(document, "Node")
            node.Gap = 5.0
            document.recompute()
        records = with_landed_marks([record_of(one) for one in drawn.Sheets])
        wanted = node_sheets(records, style_of(drawn.Sheets[0]))
        pages = node_pages(document)
        assert drawn.PageCount == len(pages) == len(wanted) > 0
        for (page, symbol), sheet in zip(pages, wanted, strict=True):
            assert symbol.Symbol == symbol_svg(sheet, alone=True)
            assert page.Views == [symbol] and page.Template.Width.Value == sheet.width
        assert ("root gap 5.0" in pages[0][1].Symbol) == edited
        # Welds tell the plate landed on by its mark, also of one that has another now.
        through = next(r for r in records if not r.nodes)
        landed = {w.plates[1] for r in records for w in r.welds if w.kind == "node"}
        assert landed <= {plate.mark for plate in through.plates}
        table = [c for s in wanted for t in s.tables for row in t.rows for c in row]
        assert not [c for c in table if c.startswith(f"{through.member} ")]
    path = tmp_path / "nodes.FCStd"
    document.saveCopy(str(path))
    again = FreeCAD.openDocument(str(path), hidden=True)
    try:
        kept = [symbol.Symbol for _, symbol in node_pages(again)]
        assert kept == [symbol.Symbol for _, symbol in node_pages(document)]
        assert not [obj.Label for obj in again.Objects if obj.MustExecute]
    finally:
        FreeCAD.closeDocument(again.Name)


def test_without_a_node_that_can_be_drawn_one_page_says_so_and_surplus_pages_go(document):
    (drawn,) = of_kind(document, "NodeSheets")
    drawn.Sheets[0].SheetFormat = "A4"
    document.recompute()
    assert drawn.PageCount == len(node_pages(document)) > 1
    (node,) = of_kind(document, "Node")
    for plates in of_kind(document, "PlateSet"):
        plates.Nodes = [one for one in plates.Nodes if one != node]
    document.removeObject(node.Name)
    document.recompute()
    ((_, symbol),) = node_pages(document)
    assert drawn.PageCount == 1 and "no node can be drawn" in told(symbol.Symbol)
    document.recompute()
    names = {obj.Name for obj in document.Objects}
    assert not [name for name in names if name.startswith(f"{drawn.Name}_Page02")]
