# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where things stand in panels, tree and 3D view: a dark window of a laptop's size, in Chinese."""

import pytest
from freecad_window import DARK, session, step

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("layout", tmp_path_factory, look=DARK, language="Chinese Simplified")


def test_ok_and_cancel_keep_the_language_of_the_window(window):
    """Whatever FreeCAD loads while a panel is open; a choice and a warning have them, too."""
    seen = step(window, "first_panel")
    assert seen["panel"] == ["确定", "取消"]
    assert seen["choice"] == ["确定", "取消"] and seen["warning"] == ["确定"]
    assert seen["chosen"] is None and seen["chosen two"] == "two"


def test_what_is_found_leaves_the_fields_where_they_are(window):
    """Many lines are scrolled in a box below the fields, which folds to its heading."""
    seen = step(window, "many_findings")
    assert seen["before"] == seen["after"] and len(seen["before"]) > 4
    assert seen["text before"] == "" and seen["text"].count("<p") == 4
    text, area = seen["heights"]
    assert text > area > 60 and seen["scrolls"] >= text - area - 1
    assert seen["heading"] == "警告：4"
    assert seen["folded"] == [False, True, True] and seen["unfolded"]


@pytest.mark.parametrize("name", ["OffsetY", "OffsetZ1"])
def test_an_error_comes_into_view_in_a_panel_that_is_scrolled(window, name):
    """Beside the field it is made in, which stays in view."""
    seen = step(window, "error_in_view")
    assert seen["hidden"] > 20
    text, told, own, line = seen[name]
    assert "abc" in text and told >= line and own >= line


def test_an_error_without_room_below_stands_at_its_field(window):
    hidden, visible, text, told, own = step(window, "error_in_view")["at field"]
    assert hidden > 250 and told == 0 and own > 10
    assert visible and "abc" in text


def test_rows_that_are_hidden_leave_no_gap(window):
    """Fields follow each other at one distance, whichever kind is chosen."""
    seen = step(window, "hidden_rows")
    assert seen["plane"] == seen["again"] and len(seen["dome"]) == len(seen["plane"]) + 3
    for name in ("plane", "dome"):
        gaps = [low[1] - high[2] for high, low in zip(seen[name], seen[name][1:], strict=False)]
        assert min(gaps) >= 0 and max(gaps) <= 12, (name, seen[name])


def test_a_table_of_parts_shows_all_its_columns(window):
    for name, (count, hidden, typed_into) in step(window, "tables_of_parts").items():
        assert count >= 4 and hidden == 0 and typed_into, name


def test_a_wide_panel_leaves_its_place_as_wide_as_it_was(window):
    before, wide, after = step(window, "width_given_back")
    assert wide > before + 50 and after == before


def test_names_of_faces_can_be_read_in_a_dark_window(window):
    seen = step(window, "split_names")
    assert seen["ground"] < 100 and min(seen["names"].values()) > seen["ground"] + 60


def test_a_member_is_seen_in_the_tree_as_long_as_its_plates_are(window):
    """[grey, skin shown, plates shown, properties say so]: Space hides and shows all of it; of
    skin and plates never both."""
    seen = step(window, "members_in_tree")
    plates, hidden = [False, False, True, True], [True, False, False, True]
    assert seen["plates"] == seen["shown"] == seen["plates shown"] == plates
    assert seen["hidden"] == seen["plates hidden"] == seen["axis"] == hidden
    assert seen["skin"] == [False, True, False, True] and seen["skin hidden"] == hidden
    assert seen["plates again"] == plates


def test_plates_made_for_a_hidden_member_are_seen(window):
    assert step(window, "new_plates") == [False, True]


def test_plates_redone_for_a_hidden_member_are_seen(window):
    assert step(window, "plates_redone") == [[False, True], [False, True]]


def test_every_mark_turned_to_the_eye_is_shown(window):
    """Where two would lie on each other one stands at another corner of its place."""
    seen = step(window, "crowded_marks")
    assert len(seen["turned"]) > 3 and set(seen["turned"]) <= set(seen["boxes"])
    boxes = list(seen["boxes"].values())
    for k, (x0, y0, x1, y1) in enumerate(boxes):
        for a0, b0, a1, b1 in boxes[k + 1 :]:
            assert x1 <= a0 + 1 or a1 <= x0 + 1 or y1 <= b0 + 1 or b1 <= y0 + 1
    for text, (across, up) in seen["drawn"].items():
        wanted = ("LEFT", "RIGHT")[seen["corners"][text] % 2]
        assert (across, up) == (wanted, ("BOTTOM", "TOP")[seen["corners"][text] // 2])


def test_members_made_on_a_huge_surface_fill_the_view(window):
    """The view looks the same way, at them."""
    seen = step(window, "small_on_huge")
    assert seen["shown"] == [] and seen["selected"] == 0
    (far, way), (near, same) = seen["before"], seen["after"]
    assert far > 300000.0 and 0.3 * seen["length"] < near < 2.0 * seen["length"]
    assert same == pytest.approx(way, abs=1e-5)
    for spot, size in zip(seen["spot"], seen["size"], strict=True):
        assert 0.25 * size < spot < 0.75 * size


def test_the_report_view_has_no_exception(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
