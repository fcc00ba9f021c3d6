# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing pages in FreeCAD's window: drawn when they are opened or exported."""

import pytest
from freecad_window import ROOT, run_in_window
from test_view_window import save_document

from BendTorsionWB.sheets.pdf import start_qt
from BendTorsionWB.sheets.qt import settle_threads

pytestmark = pytest.mark.slow


def test_pages_are_drawn_when_they_are_opened_and_never_stale(tmp_path):
    """Also those written as DXF unopened, or opened while an edit is taken back."""
    window = run_in_window(
        ROOT / "tests" / "window" / "pages_session.py",
        tmp_path / "window",
        time_limit=400,
        pictures=ROOT / "build" / "pictures" / "pages",
        document=save_document(tmp_path / "headless.FCStd"),
    )
    assert "failed" not in window["pages"], window["pages"]["failed"]
    found = window["pages"]
    assert len(found["before"]) > 3
    assert all(page == [False, 0] for page in found["before"])
    (first, edges), second = found["opened"]
    assert first and edges > 10 and second == [False, 0]
    page, view, selected = found["finding"]
    assert page != view == "View3DInventor" and selected
    (drawn, edges), lines = found["dxf"]
    assert drawn and edges > 10 and lines > 10
    assert found["taken_back"][0] and found["taken_back"][1] > 0
    assert found["edited"][0] and found["edited"][1][0]
    before, opened = found["again"]
    assert before == [False, 0] and opened[0] and opened[1] > 10
    assert "Traceback" not in window["report_view"]


def test_pages_that_waited_in_the_window_are_drawn_without_one(tmp_path):
    """A document saved while its pages waited: read by plain Python they have their outlines."""
    import FreeCAD

    # From 1.0 on lines are computed in threads, which hand them over in Qt's event loop.
    start_qt()
    document = FreeCAD.openDocument(str(save_document(tmp_path / "waits.FCStd")))
    for page in pages_of(document):
        page.KeepUpdated = False
    document.save()
    FreeCAD.closeDocument(document.Name)
    again = FreeCAD.openDocument(str(tmp_path / "waits.FCStd"))
    settle_threads()
    try:
        assert len(pages_of(again)) > 3
        for page in pages_of(again):
            views = [v for v in page.Views if v.isDerivedFrom("TechDraw::DrawViewPart")]
            assert page.KeepUpdated and views[0].getVisibleEdges()
    finally:
        FreeCAD.closeDocument(again.Name)


def pages_of(document):
    """The drawing pages of a document."""
    return [item for item in document.Objects if item.isDerivedFrom("TechDraw::DrawPage")]
