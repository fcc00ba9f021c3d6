# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels of every kind: opened by a double-click, live, refusing what cannot be, by keys."""

import pytest
from freecad_window import session, step
from test_command_table import PROMISED

pytestmark = pytest.mark.slow

KINDS = ("Ground", "M1-axis", "B", "M1", "M1 plates", "M1 patterns", "M1 bed", "N1", "M1 sheets")


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("panels", tmp_path_factory)


@pytest.mark.parametrize("label", KINDS)
def test_a_double_click_edits_every_kind_of_object(window, label):
    """The value shows while it is typed; Cancel leaves no trace, OK one undo step."""
    seen = step(window, "double_clicks")[label]
    assert seen["Cancel typed"] and seen["Ok typed"]
    assert seen["Cancel"] == [True, 0]
    assert seen["Ok"] == [False, 1]
    assert seen["status"] == "ok" and not seen["open"]
    assert seen["undone"]


def test_what_no_quantity_can_be_is_told_at_the_field(window):
    """Nothing, another unit, words, unknown names in an expression: OK is off until mended."""
    seen = step(window, "refused")
    for text in ("", "5 k", "two", "=Nothing.here", "="):
        allowed, tip, told = seen[text]
        assert not allowed, text
        assert tip and tip in told, text
    assert "missing" in seen[""][1] and "cannot be read" in seen["two"][1]
    assert "expression" in seen["=Nothing.here"][1]
    assert seen["mended"] == [True, False]


def test_an_expression_is_kept_in_one_undo_step(window):
    """2 · 600 mm + 1 m, in the document and in the macro."""
    seen = step(window, "refused")
    assert seen["bound"] == [True, 2200.0]
    assert seen["kept"][0] == 2200.0 and seen["kept"][1][0][0].lstrip(".") == "SaddleSpacing"
    assert len(seen["undo"]) == 1
    assert seen["undone"] == [2000.0, []]


def test_each_lane_of_a_face_is_drawn_and_their_joints_move_together(window):
    """Named by face and letter; every plate there is has its place."""
    seen = step(window, "lanes")
    assert {"top a", "top b", "bottom", "left", "right"} <= set(seen["names"])
    assert "top" not in seen["names"] and seen["status"] == "ok"
    assert len(seen["marks"]) == 6 and seen["plates"] == 6 + 1 + 2 + 1
    assert len(seen["moved"]) == 2 and min(seen["moved"]) > 1.0


def test_a_table_of_parts_says_how_it_is_filled(window):
    """And offers the faces, where one is asked for."""
    hint, faces, places = step(window, "part_tables")[:3]
    assert "paste" in hint and set(faces) == {"top", "bottom", "left", "right"} and places == []


def test_a_table_of_parts_reads_cells_as_fields_do(window):
    """A word in capitals, units, sums; a comma that can mean two things is at its cell."""
    (allowed, told, marked), read = step(window, "part_tables")[3:]
    assert not allowed and "row 1: 1,200 can mean" in told and "row 2: 3,400 can mean" in told
    assert marked == [False, False, True, False]
    assert read == [["top"], ["1500"], [25.0], True]


def test_joints_typed_for_a_face_take_units_and_go_back(window):
    seen = step(window, "joint_fields")
    assert seen["units"] == [[2000.0, 4505.0], True]
    assert seen["refused"] == [[2000.0, 4505.0], False]
    assert seen["cancelled"] == seen["before"]


def test_what_the_checks_refuse_cannot_be_accepted(window):
    """A thickness that leaves no box: the plates are in error, OK is off, Cancel mends."""
    seen = step(window, "refused")
    status, allowed = seen["by the checks"]
    assert status.startswith("error") and not allowed
    assert seen["cancelled"] == [12.0, "ok", []]


def test_a_gap_and_a_stub_beyond_their_limits_leave_the_model_as_it_is(window):
    """Refused at the field with the limit that the members have."""
    seen = step(window, "node_fields")
    gap, status, whole, ok, told = seen["500 mm"]
    assert (gap, status, whole, ok) == (3.0, "ok", True, False) and "20 mm or less" in told
    assert seen["4 mm"][:4] == [4.0, "ok", True, True]
    for text in ("10 mm", "0 mm"):
        length, status, whole, ok, told = seen[text]
        assert (status, whole, ok) == ("ok", True, False), text
        assert length == seen["stub"][0] and "too little" in told
    assert seen["600 mm"][:4] == [600.0, "ok", True, True]
    assert seen["cancelled"] == [3.0, "direct", "N1", "ok"]


def test_a_stub_begins_with_a_length_that_can_be(window):
    length, status, ok, told, plates, text = step(window, "node_fields")["stub"]
    assert length == 500.0 and text == "500.00 mm"
    assert status == plates == "ok" and ok and "stub_length" not in told


def test_a_node_is_not_called_as_a_member_or_nothing(window):
    """While it is typed; a name that can be is the node's once the field is left."""
    seen = step(window, "node_fields")
    for text, reason in (("M1", "M1 is a member"), (" ", "give the node a name")):
        name, status, whole, ok, told = seen[f"name {text}"]
        assert (name, status, whole, ok) == ("N1", "ok", True, False) and reason in told
    assert seen["name K7"][3] and seen["left"] == ["K7", "ok", True]


def test_what_runs_through_a_node_is_told_in_words_with_the_ranks(window):
    """What is kept is the code; members without ranks have none."""
    seen = step(window, "ranks_of_a_node")
    assert [code for code, _ in seen["choices"]] == ["link", "rank"]
    assert seen["choices"][1][1] == "the member of lower rank"
    assert len(seen["ranks"]) == 1 and seen["ranks"][0].endswith(": M1 none, M2 none")


def test_joints_are_moved_added_and_removed_by_keys(window):
    """Down goes to the next joint, Right moves it by 10 mm, Ins divides the longest plate, a place
    can be typed, Del removes; each rule is told with its figure and its limit."""
    seen = step(window, "by_keys")
    assert seen["first"][0] == 3000.0
    assert seen["second moved"] == [3000.0, 6010.0]
    assert seen["added"] == [3000.0, 4505.0, 6010.0]
    assert 5000.0 in seen["typed"] and len(seen["typed"]) == 3
    assert seen["beyond"][:2] == [seen["typed"], False] and "between" in seen["beyond"][2]
    assert len(seen["removed"]) == 2 and 5000.0 not in seen["removed"]
    for words in ("shorter plate beside it", "at least 600", "joint of the next face (left)"):
        assert words in seen["first"][1]
    assert "#43a047" in seen["verdict"] and "#e53935" not in seen["verdict"]
    assert len(seen["undo"]) == 1 and seen["undone"] == [3000.0, 6000.0]


def test_context_menus_offer_what_suits(window):
    """By the kind selected; nothing with nothing selected. The menu has every command."""
    seen = step(window, "context_menus")
    found = seen["found"]
    assert found["nothing"] == []
    assert {"Plates", "Splits", "Development", "CutPoint"} <= set(found["M1 plates"])
    assert {"Axis", "Member", "ShowFrames"} == set(found["M1-axis"])
    assert found["B"] == ["Section"] and found["N1"] == ["Node"]
    assert found["M1 bed"] == ["AssemblyBed"]
    assert "Surface" in found["face"] and "Plates" not in found["face"]
    assert "Axis" in found["edge"] and found["vertex"] == ["Axis"]
    assert {words for words, _ in PROMISED.values()} <= set(seen["menu"])


def test_long_work_can_be_stopped_and_leaves_nothing(window):
    seen = step(window, "stopped")
    assert seen["bars"] and seen["shown"] == []
    assert seen["status"] == "Stopped"
    assert seen["same"] and seen["undo"] == []


@pytest.mark.parametrize("name", ["member", "surface", "project"])
def test_the_document_templates_open_in_the_window(window, name):
    """Recomputed whole, with their plates to be seen and nothing in error."""
    seen = step(window, "templates")[name]
    assert seen["shown"] == [] and seen["file"] and seen["wrong"] == []
    assert seen["members"] >= 1 and seen["seen"]


@pytest.mark.parametrize(("label", "made"), [("B", 0), ("", 1)])
def test_a_transaction_in_another_document_makes_no_second_step(window, label, made):
    """One undo step takes back what OK kept; of what Cancel took back there is none, nor a redo."""
    seen = step(window, "elsewhere")
    names, redo, height, count, undone, left = seen[f"{label} Ok"]
    assert len(names) == 1 and redo == [] and count == made
    assert height == (500.0 if made else 620.0) and undone and left == 0
    assert seen[f"{label} Cancel"] == [[], [], 500.0, 0]
    # The other document keeps what was done in it.
    assert seen["other"] == [["Script"] * 4, 4]
    # Nor is that undone which it did in the document of the panel.
    assert seen["both"] == [500.0, "noted"]


def test_another_cut_in_the_view_waits_for_a_text_that_cannot_be(window):
    """Nothing moves, the text stays to be mended, OK stays off; the own cut is dragged beside it,
    and put back by Esc."""
    seen = step(window, "other_cut")
    assert seen["before"] == [2, ["bf"], False]
    assert seen["other"] == [2, ["bf"], False, True, True]
    assert seen["dragged"] == [2, ["bf"], False, True]
    assert seen["escaped"] == [2, ["bf"], False, True]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"]
