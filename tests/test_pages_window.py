# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing pages in FreeCAD's window: drawn when they are opened or exported."""

import pytest
from freecad_window import session, step
from test_view_window import save_document

from BendTorsionWB.sheets.pdf import start_qt
from BendTorsionWB.sheets.qt import settle_threads


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    document = save_document(tmp_path_factory.mktemp("headless") / "headless.FCStd")
    return session("pages", tmp_path_factory, document=document)


def test_pages_are_drawn_when_they_are_opened_and_never_stale(window):
    """Also those written as DXF unopened, or opened while an edit is taken back."""
    found = step(window, "pages")
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


def test_the_window_of_a_page_goes_and_comes_back_with_its_page(window):
    """Of sheets just made the one that opens is drawn alone. Sheets undone closes it, redone it
    shows the drawing as before, as often as one likes; so for a page that an edit leaves without a
    sheet."""
    found = step(window, "taken_back")
    ((label, dark),) = found["made"].items()
    assert dark > 1000 and found["front"] == "MDI view page"
    assert found["drawn"] == [label] and found["Undo"][0][1] < found["Redo"][0][1] - 3
    for shown, pages, front in found["Undo"]:
        assert shown == {} and pages == found["Undo"][0][1] and front == "View3DInventor"
    for shown, pages, front in found["Redo"]:
        assert list(shown) == [label] and shown[label] == pytest.approx(dark, rel=0.01)
        assert pages > found["Undo"][0][1] and front == "MDI view page"
    last, left = found["surplus"]
    assert left == [label] != [last]
    opened, dark = found["back"]
    assert opened == sorted([label, last]) and dark > 1000


def test_sheets_that_take_long_open_their_first_page_too(window):
    """The tree may leave out pages for a moment that come while the window settles."""
    front, drawn = step(window, "long_work")
    assert front == "MDI view page" and drawn == ["M2 sheets 1"]


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
