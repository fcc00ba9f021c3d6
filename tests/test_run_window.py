# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example opened from its command and stopped in the middle; panels with two documents open."""

import pytest
from freecad_window import session, step
from test_build import APART, schedule


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw, a small schedule in the place of the hall's."""
    book = schedule(tmp_path_factory.mktemp("book") / "two.xlsx", APART)
    return session("run", tmp_path_factory, schedule=book)


@pytest.mark.parametrize("way", ["alone", "window", "document"])
def test_the_example_is_opened(window, way):
    """With a bar that tells how far it is; the window stays when it is told to close meanwhile,
    and other documents may be closed."""
    seen = step(window, "runs")[way]
    assert len(seen["bars"]) == 1 and seen["left"] == [] and seen["visible"]
    assert seen["shown"] == [] and seen["members"] == [2]


def test_the_example_is_stopped_in_the_middle(window):
    """No half of it is left, and it is told."""
    seen = step(window, "runs")["stopped"]
    ((_, done, count),) = seen["bars"]
    assert 0 < done < count
    assert seen["documents"] == [] and seen["said"] == "Stopped" and seen["left"] == []


@pytest.mark.parametrize("button", ["Cancel", "Ok"])
def test_a_panel_edits_its_own_document(window, button):
    """While another is the active one: that has no change, no new object, no undo step."""
    seen = step(window, "two_documents")
    assert seen[f"while {button}"] == [620.0, 500.0, 0]
    height, other, undo, undo_of_other, is_open, touched = seen[button]
    assert other == 500.0 and undo_of_other == [] and not is_open and touched == []
    assert [height, undo] == ([500.0, []] if button == "Cancel" else [620.0, ["Section"]])


def test_a_panel_goes_with_its_document(window):
    assert step(window, "two_documents")["closed"] == [True, False, True, False]


def test_a_panel_goes_when_its_object_and_its_document_do(window):
    assert step(window, "gone_at_once") == {"panel": False}


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
