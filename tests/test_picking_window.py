# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picking with the mouse in the 3D view of FreeCAD's window: cuts, alignments, links."""

import pytest
from freecad_window import session


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("picking", tmp_path_factory)


def seen(window, step):
    """What a step saw; fails with its traceback when it raised."""
    assert "failed" not in window[step], window[step]["failed"]
    return window[step]


def place_in(text):
    """The arc length a read-out says, mm."""
    return float(text.split("s = ")[1].split()[0])


def test_a_cut_is_dragged_along_the_axis_and_followed_on_the_way(window):
    """To within a few pixels (one is some 17 mm); the plates follow before the button is up."""
    found = seen(window, "drag_cut")
    assert found["texts"][0] == "Cut 2: s = 5000 mm, transition 250 mm"
    texts, cut, volume = found["on_the_way"]
    assert abs(cut - 7000.0) < 60.0
    assert place_in(texts[0]) == cut == found["field"] == found["cuts"][1]
    # Less of the 800 section: its steel area is 200 × 2 × 16 mm² above that of the 600.
    assert volume - found["volumes"][0] == pytest.approx(-6400.0 * (cut - 5000.0), rel=0.01)
    assert found["shown"] == 2
    assert found["selected"] == []


def test_esc_takes_a_drag_back_and_leaves_the_panel_open(window):
    found = seen(window, "drag_cut")
    dragged, after = found["third"]
    assert abs(dragged - 13500.0) < 60.0 and after == 11000.0
    assert found["still_open"]


def test_ok_keeps_a_drag_as_one_undo_step(window):
    found = seen(window, "drag_cut")
    texts, second, third, undo = found["after"]
    assert texts == [] and third == 11000.0 and abs(second - 7000.0) < 60.0
    assert len(undo) == 1
    assert found["undone"] == 5000.0


def test_cancel_takes_drags_back_and_beside_a_cut_nothing_is_dragged(window):
    found = seen(window, "drag_nothing")
    untouched, dragged, cancelled = found["cut"]
    assert untouched == cancelled == 5000.0 and abs(dragged - 6000.0) < 60.0
    assert found["texts"] == []


def test_the_alignment_is_clicked_on_the_member(window):
    """On the middle of its top, and near its left edge; the drawing of the section follows."""
    found = seen(window, "align_on_the_member")
    assert found["top"] == ["top", "top"]
    assert found["left"] == ["top-left", "top-left"]
    assert found["back"] == "centre"


def test_a_link_is_picked_only_after_its_button(window):
    found = seen(window, "link_picked")
    assert found["axes"] == ["A1", "A2", "A1"]
    assert not found["pressed"]


def test_closing_the_document_ends_the_picking(window):
    assert not seen(window, "view_closed")["open"]
    assert "Traceback" not in window["report_view"]


def test_a_cut_is_put_where_a_large_section_was_clicked(window):
    """On the edge of a section of 2.5 m, 1.8 m from the axis."""
    found = seen(window, "large_section")
    assert sorted(map(abs, found["off"])) == pytest.approx([1250.0, 1250.0], abs=0.1)
    assert found["shown"] == [] and found["cuts"] == [2, 4000.0]
