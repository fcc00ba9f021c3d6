# SPDX-License-Identifier: LGPL-2.1-or-later
"""What refused, undone and repeated commands leave behind in the window; what a command tells of
what it does not write; menus of a right click."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("leftovers", tmp_path_factory)


@pytest.mark.parametrize("command", ["Development", "AssemblyBed"])
def test_what_is_refused_for_one_of_several_leaves_nothing(window, command):
    """No object, no undo step, nothing to compute, and no badge in the tree."""
    seen = step(window, "refused")
    assert seen["in error"] != "ok"
    said, changed = seen[command]
    assert len(said) == 1 and "M3" in said[0]
    assert changed == {}


def test_patterns_refused_for_one_of_several_leave_no_badge_on_its_plates(window):
    """The error was that of an object that is gone."""
    said, changed = step(window, "refused")["patterns"]
    assert said == ["M2: cannot be laid flat: widen it."] and changed == {}


def test_plates_that_are_cancelled_leave_their_member_shown(window):
    assert step(window, "refused")["cancelled"] == {}


@pytest.mark.parametrize("label", ["M1", "M1 plates", "B", "Ground", "M1-axis", "M1 patterns"])
def test_what_is_deleted_and_undone_is_computed_and_looks_as_before(window, label):
    """Also deleted again by redo."""
    seen = step(window, "undone")[label]
    assert seen["gone"]
    for after in ("undone", "redone", "undone again"):
        assert set(seen[after]) <= {"undo"}, after


def test_what_is_made_undone_and_redone_is_folded_where_it_was(window):
    assert set(step(window, "undone")["made"]["redone"]) <= {"undo"}


def test_an_edit_undone_is_computed(window):
    assert set(step(window, "undone")["edit"]["undone"]) <= {"undo"}


@pytest.mark.parametrize("command", ["Section", "Member", "Surface"])
def test_a_panel_left_as_it_was_opened_takes_no_redo_away(window, command):
    undos, undone, redos, again, open_still = step(window, "redone")[command]
    assert undone and again == 600.0
    assert len(undos) == 1 and redos == undos and open_still is None


def test_members_of_the_same_sizes_share_their_section(window):
    """Others have one of their own; one that follows an expression is not theirs."""
    seen = step(window, "sections")
    assert seen["made"] == [["M1", "Section"], ["M2", "Section"], ["M3", "Section 2"]]
    assert len(seen["undo"]) == 3
    assert seen["bound"] == "Section 3"


def test_members_left_out_are_told_by_package_and_report(window):
    seen = step(window, "left_out")
    assert seen["shown"] == [] and seen["said"].startswith("1 members written")
    assert len(seen["warned"]) == 2
    for text in seen["warned"]:
        assert "not laid flat" in text and "M2" in text and "M1" not in text
    assert "NOT in this package:\n  M2: its plates are not laid flat" in seen["readme"]


def test_read_only_files_stay_and_are_told_in_a_line(window):
    seen = step(window, "read_only")
    assert seen.pop("first") == []
    assert len(seen) == 5
    for name, ((line,), kept) in seen.items():
        assert "read-only" in line and "another name" in line and kept, name


def test_a_schedule_written_and_read_in_the_window_says_the_same(window):
    """Also written a second time, from what was read."""
    seen = step(window, "round_trip")
    assert seen["written"] == seen["read"] == seen["written again"] == []
    assert seen["found"].keys() == seen["wanted"].keys()
    for label, (kind, status, size) in seen["wanted"].items():
        assert seen["found"][label][:2] == [kind, status]
        assert seen["found"][label][2] == pytest.approx(size, rel=1e-9)
    first, second = seen["sheets"]
    assert first == second and {"Members", "Axes", "Sections"} <= set(first)
    # Skins in the faces of their plates would flicker.
    assert seen["shown"] == [False, True]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("half", "cut short"),
        ("empty", "empty"),
        ("folder", "folder"),
        ("words", "not an excel workbook"),
        ("zip", "workbook"),
        ("cells", "nowhere"),
        ("gone", "no such file"),
    ],
)
def test_a_broken_workbook_opens_nothing_and_is_told_in_a_line(window, name, words):
    (line, *more), same = step(window, "round_trip")["broken"][name]
    assert more == [] and words in line.lower() and same
    assert "Traceback" not in line and "Error" not in line


OFFERED = {
    "M1": {"Member", "Plates", "Development", "Cut point", "Show outer skin"},
    "M1 plates": {"Plates", "Split editor", "Development", "Assembly bed", "Colour by"},
    "M1 patterns": {"Development", "Sheets"},
    "M1-axis": {"Axis from selection", "Member", "Show frames"},
    "B": {"Section"},
    "N1": {"Node"},
    "M1 sheets": {"Sheets"},
    "": set(),
}


@pytest.mark.parametrize("label", list(OFFERED))
def test_a_right_click_in_the_tree_offers_what_suits(window, label):
    offered = {text for text, enabled in step(window, "menus")["tree"][label] if enabled}
    assert OFFERED[label] <= offered
    if not label:
        assert not offered & {"Section", "Development", "Plates"}


@pytest.mark.parametrize("label", ["M1", "M1 plates", "M1 patterns", "M1-axis", ""])
def test_a_right_click_in_the_view_offers_what_suits(window, label):
    offered = {text for text, enabled in step(window, "menus")["view"][label] if enabled}
    assert offered
    assert OFFERED[label] - {"Show outer skin"} <= offered
    if not label:
        assert not offered & {"Section", "Development", "Plates"}


def test_an_entry_of_the_menu_does_what_it_says(window):
    seen = step(window, "menus")
    assert seen["chosen"] and seen["skin"] == [[False, True], [True, False]]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
