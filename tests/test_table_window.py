# SPDX-License-Identifier: LGPL-2.1-or-later
"""The member table in FreeCAD's window: keys, reasons, what it did not take."""

import pytest
from freecad_window import session, step


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw; its keys are typed by a process of its own."""
    return session("table", tmp_path_factory)


def test_enter_goes_down_in_the_table(window):
    """While a cell is typed, offered words or not, and between; with Shift up. Units and words in
    capital letters are those of panels."""
    seen = step(window, "enter")
    assert seen["offsets"] == [25.0, 50.0, 0.0] and seen["aligned"] == ["top", "bottom", "top"]
    assert seen["down"] == [1, 2, 2] and seen["up"] == 1


def test_the_table_says_why_after_enter(window):
    """Of a text it does not take, and of a value the checks refuse, in words beside it."""
    seen = step(window, "reasons")
    assert "row 1 offset_y" in seen["told"] and "can mean 1200 or 1.2" in seen["told"]
    assert "In error: row 2 cut" in seen["checks"] and "beyond the end" in seen["checks"]
    assert "value 99000 mm, limit 3" in seen["checks"]
    assert seen["mended"] == ""


def test_every_cell_that_is_not_taken_is_told(window):
    """Each with its reason; more lines than there is room for can be scrolled to."""
    seen = step(window, "block")
    assert seen["pasted"] == ["1,200", "2,300", "3,400", "4,500"] and seen["scrolls"]
    lines = seen["told"].splitlines()
    cells = [f"row {row} {name}" for row in (1, 2) for name in ("offset_y", "offset_z")]
    assert len(lines) == 4 and "more" not in seen["told"]
    for line, cell, text in zip(lines, cells, seen["pasted"], strict=True):
        assert cell in line and f"{text} can mean" in line


def test_escape_drops_the_cell_it_is_pressed_in_and_says_so(window):
    """Others of the same paste stay; with all selected all are dropped."""
    seen = step(window, "block")
    texts, told, status = seen["one"]
    assert texts == ["0", "2,300", "3,400", "4,500"] and len(told.splitlines()) == 3
    assert "1,200" in status and "2,300" not in status
    texts, told, status = seen["all"]
    assert texts == ["0"] * 4 and told == ""
    assert "1,200" not in status
    assert all(text in status for text in ("2,300", "3,400", "4,500"))


def test_sections_are_told_with_their_sizes_and_members_with_their_length(window):
    """Beside the name, in the cell and in the list that is offered; the name alone is copied."""
    seen = step(window, "sizes")
    assert seen["cell"] == "B   (600 × 600 × 16)" and seen["copied"] == "B"
    assert seen["list"] == ["B   (600 × 600 × 16)", "C   (400 × 300 × 10/20)"]
    assert seen["taken"] == ["B", "C", "B"]
    assert seen["heading"] == "length"
    for text, length in zip(seen["lengths"], seen["wanted"], strict=True):
        assert float(text) == pytest.approx(length, abs=0.051) and length > 30000.0


def test_a_table_without_members_says_what_makes_them(window):
    shown, table, text = step(window, "empty")["without"]
    assert shown and not table
    assert "Members from selection" in text and "Import schedule" in text
    assert step(window, "empty")["with"] == [False, True]


def test_the_table_keeps_what_it_did_not_take_when_it_is_closed(window):
    """The status bar says so; it is there again, with its reason, also after another document."""
    seen = step(window, "closed")
    assert "1,200" in seen["status"] and "member table" in seen["status"]
    assert seen["again"] == ["1,200", True, True]
    assert seen["other document"] == "" and seen["back"] == ["1,200", True, True]
    assert seen["dropped"] == ["0", False, False]


def test_what_was_typed_goes_with_its_document(window):
    """Another of that name shows its own."""
    assert step(window, "same_name") == [["1,200", "Twice"], ["0", "Twice"]]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
