# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's own Delete, Undo and Redo of what others need, by menu and by real keys."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow

DIRECT = {
    "Ground": ("M1-axis", "M2-axis"),
    "B": ("M1", "M2"),
    "M1-axis": ("M1",),
    "M1": ("M1 plates", "N1"),
    "M1 plates": ("M1 patterns", "M1 bed"),
    "M1 patterns": ("M1 sheets",),
    "M2": ("M2 plates", "N1"),
}
"""What is in error for want of what was deleted."""


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("deletion", tmp_path_factory)


@pytest.mark.parametrize("label", [*DIRECT, "N1"])
def test_freecad_asks_and_no_leaves_all(window, label):
    seen = step(window, "deletions")["seen"][label]
    assert "referencing" in seen["asked"][0] and seen["refused"]


@pytest.mark.parametrize("label", DIRECT)
def test_what_misses_the_deleted_says_so(window, label):
    """In error, empty, and so is all that depends on it; nothing keeps a stale shape."""
    found = step(window, "deletions")
    deleted = found["seen"][label]["deleted"]
    assert label not in deleted
    for other in DIRECT[label]:
        assert deleted[other][0].startswith(f"error: {other}") or other == "N1"
        assert deleted[other][0].startswith("error")
    for status, size, _ in deleted.values():
        assert status == "ok" or size == ""
    for name, (status, size, _) in deleted.items():
        if not name.startswith("M1 sheets ") and status == "ok":
            assert size == found["before"][name][1], name


def test_a_member_without_its_node_is_whole_again(window):
    found = step(window, "deletions")
    deleted = found["seen"]["N1"]["deleted"]
    assert {status for status, _, _ in deleted.values()} == {"ok"}
    assert deleted["M2 plates"][1] == deleted["M2"][1]


@pytest.mark.parametrize("label", [*DIRECT, "N1"])
def test_undo_brings_all_back_and_redo_takes_it_again(window, label):
    seen = step(window, "deletions")["seen"][label]
    assert seen["undo"] == 1
    assert seen["undone"] and seen["redone"] and seen["back"]


def test_the_key_deletes_in_the_view_and_in_the_tree(window):
    """A bed, which nothing needs, goes without a question and comes back."""
    seen = step(window, "key_in_the_view")
    assert seen == {"active": True, "view": [True, True, True], "tree": [True, True, True]}


def test_keys_wait_for_an_open_panel(window):
    """Del and Ctrl+Z leave it open with what is tried in it, and say so; nothing is left over."""
    seen = step(window, "while_a_panel_is_open")
    assert seen["tried"] == 600.0 and seen["cancelled"]
    assert [held[:2] for held in seen["held"]] == [[True, 600.0]] * 3
    for _, _, told in seen["held"][:2]:
        assert "panel" in told


def test_members_from_selection_undone_and_done_again(window):
    """With everything of them, ok, folded under the member."""
    seen = step(window, "members_again")
    assert seen["undo"] == ["Members from selection"] and seen["undone"] == {}
    assert {status for status, _, _ in seen["made"].values()} == {"ok"} and len(seen["made"]) == 5
    assert seen["redone"] and seen["back"]
    assert [[3, "M1-axis"], [3, "M1 plates"]] == seen["tree"][-2:]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
