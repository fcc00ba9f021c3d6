# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places of joints and cuts in FreeCAD's window: by real keys, dragged, in error."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("places", tmp_path_factory)


def test_a_member_without_joints_is_split_by_keys(window):
    """The strips have the keyboard; Ins divides the longest plate, and that of a face chosen."""
    seen = step(window, "first_joints")
    assert seen["keyboard"]
    first = [face for face, joints in seen["first"].items() if joints]
    second = [face for face, joints in seen["second"].items() if joints]
    assert len(first) == 1 and len(second) == 2 and first[0] in second
    assert all(len(joints) <= 1 for joints in seen["second"].values())
    told, enabled = seen["told"]
    assert "Ins adds one" in told and not enabled
    assert len(seen["undo"]) == 1


def test_letters_in_the_strips_are_no_command_of_the_view(window):
    """A digit begins the place of the joint chosen."""
    seen = step(window, "letters")
    assert seen["unchosen"] == [True, True, [3000.0, 6000.0]]
    assert seen["chosen"] == [True, True, [2750.0, 6000.0]]
    assert seen["cancelled"] == [3000.0, 6000.0]


def test_a_place_that_cannot_be_is_told_with_its_value_and_limit(window):
    (between, beyond), allowed, joints = step(window, "letters")["refused"]
    assert "8000 mm is not between its neighbours: 1 to 5999 mm" in between
    assert "20000 mm is beyond the member of 9000 mm" in beyond and "1 to 5999 mm" in beyond
    assert not allowed and joints == [2750.0, 6000.0]


def test_a_joint_is_dragged_on_after_a_pause(window):
    """What it comes to is shown when it is let go."""
    seen = step(window, "dragged")
    assert seen["places"][0] == 6000.0
    places = seen["places"]
    assert places == sorted(places, reverse=True) and len(set(places)) == 4
    assert seen["shown"] and seen["drawn"][0] == [3000.0, places[-1]] and seen["drawn"][1] == 2


def test_esc_puts_back_what_is_dragged_and_nothing_else(window):
    """The panel stays open, and the mouse drags it no further."""
    assert step(window, "dragged")["escaped"] == [True, 6000.0, True]


def test_keys_right_after_a_joint_was_removed(window):
    """Before the strips are drawn anew: Down chooses the one that is left, Right moves it."""
    assert step(window, "dragged")["removed"] == [3010.0]


def test_plates_without_a_joint_are_held_against_the_rules(window):
    """Each face that has none is told with its length and the limit."""
    joints, *faces = step(window, "without_joints")
    assert "Joints: 1, against the rules: 0" in joints
    assert [line.split("> ")[1] for line in faces] == [
        f"{face}: a plate of 13000 mm, at most 12000" for face in ("bottom", "left", "right")
    ]


def test_a_change_of_thickness_is_no_joint_to_be_moved(window):
    """It is shown with the reason, also on a face `auto`; Ins divides the longest plate beside."""
    seen = step(window, "forced")
    assert seen["plates"] == 2 and seen["drawn"] == []
    assert sorted(tip.split(":")[0] for tip in seen["fixed"]) == 2 * ["4800 mm"] + 2 * ["5000 mm"]
    assert seen["added"] == [[8500.0], 3] and seen["auto"] == ["top"]


@pytest.mark.parametrize("text", ["abc", ""])
def test_of_a_cut_that_is_none_nothing_is_shown(window, text):
    """Nor of what was typed before it and could not be."""
    (allowed, told), cut, still, after = step(window, "cuts")[text]
    assert told and not allowed
    assert cut == 5000.0 and not still and not after


def test_the_slider_follows_a_cut_by_an_expression(window):
    cut, slider, wanted = step(window, "cuts")["bound"]
    assert cut == 6000.0 and slider == pytest.approx(wanted, abs=1.0)
    assert step(window, "cuts")["cancelled"][0] == 5000.0


def test_a_slope_is_refused_in_plain_words(window):
    told = step(window, "cuts")["slope"]
    assert "Slope 1 : -1 is too little: 0 or more" in told and "::" not in told


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]


def test_the_list_of_segments_follows_the_section_chosen(window):
    seen = step(window, "cuts")
    text, section, segments, number = seen["listed"]
    assert segments >= number > 1 and section and text != seen["before"]
    assert text == f"Segment {number}: {section}"
