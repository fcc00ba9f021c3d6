# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must not happen in the window: the wrong one edited, a half of it kept, texts lost."""

import pytest
from freecad_window import session, step
from test_build import APART, schedule

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    book = schedule(tmp_path_factory.mktemp("book") / "two.xlsx", APART)
    return session("refusals", tmp_path_factory, schedule=book)


def test_where_one_is_edited_several_are_refused(window):
    """None of them is meant more than the others; the line says what to select."""
    seen = step(window, "several")
    for name, (line, is_open) in seen["shown"].items():
        assert ": select " in line and line.endswith(".") and not is_open, name
    assert "2 members are selected" in seen["shown"]["Plates"][0]
    assert "2 sections are selected" in seen["shown"]["Section"][0]


def test_a_selected_surface_is_edited_and_not_made_again(window):
    is_open, while_open, after = step(window, "several")["surface"]
    assert is_open and while_open == after


def test_a_bed_stands_for_its_member(window):
    assert step(window, "several")["of_bed"] == [[], True]


def test_delete_and_undo_wait_for_an_open_panel(window):
    """Held by menu, button and key, the key saying why; given back when the panel is gone."""
    seen = step(window, "held")
    assert seen["Std_Delete"] == seen["Std_Undo"] == [600.0, True]
    another, delete = seen["told"]
    assert "panel" in delete and "panel" not in another
    assert seen["cancelled"] == [500.0, []]
    assert seen["deletes again"]


def test_a_panel_leaves_the_window_as_wide_as_it_was(window):
    before, during, after = step(window, "held")["widths"]
    assert during > before and after == pytest.approx(before, abs=3)


def test_cancel_takes_all_back_though_another_step_ended_the_trial(window):
    """The values of what there was, and what was new."""
    seen = step(window, "held")
    assert seen["another B"] == [500.0, 0] and seen["another "] == [500.0, 0]


@pytest.mark.parametrize("label", ["M2 plates", "M2", "B"])
def test_a_panel_goes_with_its_object(window, label):
    """The deletion stands, and one undo brings the object back."""
    assert step(window, "held")[f"deleted {label}"] == [False, True, True]


def test_docks_follow_deletions_and_undo(window):
    """Members without a section or a surface stay, in error; those deleted go."""
    seen = step(window, "docks")
    assert seen["B"]["rows"] == ["M1", "M2"] and seen["B"]["sections"] == ["", ""]
    assert any("section of segment 1" in text for text in seen["B"]["errors"])
    assert any("Surface" in text for text in seen["Ground"]["errors"])
    assert seen["M2"]["rows"] == ["M1"] and seen["M2"]["errors"]
    assert any("Plates" in text for text in seen["M1 plates"]["errors"])
    assert {tuple(seen[label]["undone"]) for label in ("B", "Ground", "M2")} == {
        (2, seen["M1 plates"]["undone"][1])
    }
    assert seen["closed"] == [0, 0]


def test_segments_are_added_and_taken_away_in_the_table(window):
    """Ins divides the segment of the row in its middle, its cuts being given in mm or as a part of
    the length; Ctrl+Del takes rows away; each one undo step. A member keeps its last segment."""
    seen = step(window, "segments")
    middle = 0.5 * (5000.0 + 0.75 * seen["length"])
    assert seen["added"][0] == 4 and seen["added"][2] == 7
    assert seen["added"][1] == pytest.approx(middle, abs=0.06)
    assert len(seen["added"][3]) == 1
    assert seen["removed"] == [3, 5000.0, 2] and seen["undone"] == 4
    segments, told = seen["only one"]
    assert segments == 1 and "needs one segment" in told[0]


def test_texts_without_a_cell_are_told(window):
    """Which cells, and why: no cut before the first segment, rows beyond the table. The others of
    the block are taken."""
    seen = step(window, "segments")
    assert seen["pasted"][:2] == [5100.0, 3.5]
    assert "first segment" in seen["pasted"][2]
    assert "row 1 cut, row 1 slope" in seen["said"]
    label, said = seen["beyond"]
    assert label == "B800" and "row 7 section" in said


def test_keys_of_the_table_are_not_freecads(window):
    """Del in a cell deletes nothing in the tree."""
    assert all(step(window, "segments")["kept"])


def test_a_read_only_document_is_worked_with(window):
    """It is edited in memory and exported; its file stays; what cannot be written is one line."""
    seen = step(window, "read_only")
    assert seen["height"] == 450.0 and len(seen["undo"]) == 1
    for name in ("package", "Report", "WriteSchedule", "SupportBundle"):
        (line,) = seen[name]
        assert "cannot be written" in line, name
    assert seen["written"] == [] and seen["same"]


def test_a_run_ends_with_its_document(window):
    seen = step(window, "closed_in_a_run")["document"]
    assert seen["bars"] == 1 and seen["shown"] == []
    assert not seen["there"] and seen["visible"]


def test_the_window_stays_while_a_run_goes_on(window):
    """It is closed to the mouse then; the run comes to its end."""
    seen = step(window, "closed_in_a_run")["window"]
    assert seen["bars"] == 1 and seen["visible"] and seen["made"] and len(seen["undo"]) == 1


def test_what_was_saved_without_the_workbench_is_told_and_repaired(window):
    seen = step(window, "saved_without")
    assert seen["whole"] == [[], []]
    (line,), is_open = seen["told"]
    assert "Repair document" in line and not is_open
    shown, undo, count = seen["repaired"]
    assert shown == [] and len(undo) == 1 and str(count) in seen["said"]
    assert seen["statuses"] == ["ok"] and seen["height"] == pytest.approx(620.0)


def test_a_support_bundle_has_the_tables_of_the_document(window):
    """Without a document versions and preferences alone; the document stays the active one."""
    seen = step(window, "saved_without")
    shown, names = seen["without"]
    assert shown == [] and set(names) == {"about.txt", "versions.json", "preferences.json"}
    shown, more = seen["with"]
    assert shown == [] and {"findings.txt", "schedule/Members.csv", *names} <= set(more)
    assert seen["active"] == ["Bare", ["Bare"]]


def test_colours_of_several_members_have_one_scale_and_one_legend(window):
    """16 and 30 mm are told apart; no pattern is laid out again for a colour."""
    seen = step(window, "colours")
    ((by, lines, labels),) = seen["thickness"]
    assert by == "thickness" and [line.split()[1] for line in lines] == ["16", "30"]
    assert labels == ["M1 plates", "M2 plates"]
    ((by, lines, labels),) = seen["curvature"]
    assert by == "curvature" and len(lines) == 5 and len(labels) == 2
    assert seen["ranges"][0] == seen["ranges"][1] == seen["kept"][0] == seen["kept"][1]
    assert seen["own"][0] != seen["own"][1]
    assert seen["touched"] == [] and len(seen["undo"]) == 2 and seen["patterns"] == "ok"


def test_the_hall_is_opened_from_its_schedule(window):
    """The choice of the example opens a schedule without errors, its plates in sight."""
    seen = step(window, "hall")
    assert seen["shown"] == [] and seen["real"]
    assert seen["statuses"] == ["ok"] and seen["members"] == 2 == len(seen["seen"])
    assert all(seen["seen"])


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
