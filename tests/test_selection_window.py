# SPDX-License-Identifier: LGPL-2.1-or-later
"""What commands make of what is selected, in FreeCAD's window: several axes, pairs with a node,
deleted curves; letters typed over cells, Esc in the view."""

import re

import pytest
from freecad_window import session, step


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("selection", tmp_path_factory)


def test_shapes_imported_without_a_document(window):
    """A file that cannot be read leaves no document; the recorded lines make the one of a file that
    can."""
    seen = step(window, "no_document")
    (line,), documents = seen["bad"]
    assert "cannot be read" in line and documents == []
    assert seen["shown"] == [] and seen["labels"] == ["dome"] and seen["again"] == [1]
    assert seen["steps"] == [["Import shapes"], 1]
    assert seen["undone"] == 0 and seen["redone"] == [1]


def test_each_selected_axis_becomes_a_member_in_one_undo_step(window):
    seen = step(window, "axes")
    assert seen["shown"] == [] and not seen["open"] and seen["undo"] == ["Member"]
    assert seen["made"] == [["M3", "A1", "B800", "ok"], ["M4", "A2", "B800", "ok"]]
    assert seen["undone"] == ["M1", "M2"]


def test_a_selected_axis_is_edited(window):
    """As a surface, a section or a member is."""
    seen = step(window, "axes")
    assert seen["axis"] == [[], True]
    assert seen["extended"] == [1000.0, ["A1", "A2"], ["Axis"]]


def test_letters_typed_over_a_cell_are_no_command(window):
    """`bottom` begins with the keys of Report; keys with Ctrl stay FreeCAD's."""
    seen = step(window, "typed_into_the_table")
    assert seen["kept"] == [True, True, True] and not seen["ctrl"]


def test_enter_takes_a_text_while_its_choices_are_listed(window):
    seen = step(window, "typed_into_the_table")
    assert seen["list"] and seen["aligned"] == ["bottom", ["Member table"]]


def test_escape_in_the_view_cancels_a_panel(window):
    """Whichever way it was opened."""
    seen = step(window, "escape_in_the_view")
    assert seen["command"] == seen["double-click"] == [50.0, False, 0.0, []]


def test_a_cut_is_put_where_a_plate_is_clicked(window):
    seen = step(window, "cut_where_clicked")
    assert seen["shown"] == [] and seen["cut"] == [4, 3000.0, ["Cut point"]]


@pytest.mark.parametrize("pair", ["M1 M2", "M2 M1"])
def test_the_node_of_a_pair_is_edited_and_not_made_again(window, pair):
    """Whichever of the two is selected first."""
    shown, is_open, name, said, nodes = step(window, "node_of_a_pair")[pair]
    assert shown == [] and is_open and name == "N1" and nodes == ["N1"]
    assert "N1" in said and step(window, "node_of_a_pair")["undo"] == []


def test_members_that_meet_twice_get_two_nodes_and_no_third(window):
    """M3 passes over M1 between its first two points and back between its last two."""
    seen = step(window, "node_of_a_pair")
    places, undo = seen["two"]
    assert [status for status, _ in places] == ["ok", "ok"] and undo == ["Node", "Node"]
    first, second = (place for _, place in places)
    assert 500.0 < first < 2500.0 and 6000.0 < second < 8500.0
    (line,), is_open, nodes = seen["third"]
    assert "N2, N3" in line and not is_open and nodes == ["N1", "N2", "N3"]


def test_the_context_menu_of_sheets_and_axes_offers_to_edit_them(window):
    seen = step(window, "context_of_sheets")
    assert seen["M1 sheets"] == ["Sheets", "ExportPackage"]
    assert seen["open M1 sheets"] == [[], True]
    assert "Axis" in seen["M1-axis"]


def test_the_context_menu_of_a_page_is_that_of_its_sheets(window):
    seen = step(window, "context_of_sheets")
    assert seen["page"] == seen["M1 sheets"] and seen["open page"] == seen["open M1 sheets"]


ONE_ONLY = {"Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds", "Splits", "CutPoint"}


def test_what_edits_one_is_offered_for_one(window):
    """Both members have plates, one has patterns; a member and its plates are one."""
    seen = step(window, "context_of_sheets")
    for name in ("M1", "M1 plates"):
        assert ONE_ONLY | {"Member", "Plates", "Development"} <= set(seen[name])
        assert "Node" not in seen[name]
    for name in ("two", "plates"):
        assert not (ONE_ONLY | {"Member", "Plates"}) & set(seen[name])
        assert {"Node", "Development", "Alignment", "ColourBy"} <= set(seen[name])
    assert seen["node"] == ["Node"]
    assert "Member" in seen["axes"] and "Axis" not in seen["axes"]


def test_what_edits_the_object_comes_first(window):
    seen = step(window, "context_of_sheets")
    wanted = {"M1": "Member", "M1 plates": "Plates", "M1-axis": "Axis", "page": "Sheets"}
    assert {name: seen[name][0] for name in wanted} == wanted


def test_a_deleted_curve_is_told_and_comes_back(window):
    """Hidden sources do as well as others; a curve 30 mm off its face is told as a warning."""
    seen = step(window, "sources")
    assert seen["shown"] == [] and seen["status"] == seen["back"] == "ok"
    assert seen["said"].startswith("Warnings: 1")
    for status in seen["deleted"]:
        assert "M1-axis" in status and "no curve" in status and "deleted" in status
    assert seen["empty"]


def test_files_without_members_in_error_are_told(window):
    """With the reason, once for each file; no cut files are made."""
    seen = step(window, "in_error")
    assert seen["package"] == seen["report"] == [] and not seen["cut files"]
    assert len(seen["told"]) == 2
    for text in seen["told"]:
        assert text.startswith("Written without") and " -> " in text
        # The error of the section, of the members it stops.
        assert re.search(r"\bB(, \w+)*: ", text)


def test_a_cut_in_a_member_in_error_tells_the_error(window):
    (line,) = step(window, "in_error")["cut"]
    assert "B: " in line and "not between" not in line


def test_the_surface_of_a_face_is_used_again(window):
    """By members, axes and its own command, whether the face or the whole shape is picked; one
    that is offset is another."""
    assert step(window, "sources")["surfaces"] == ["Surface"]
    seen = step(window, "surface_used_again")
    assert seen["members"] == ["Surface", "Surface"]
    for name, offset in (("face", 5.0), ("shape", 0.0)):
        shown, said, found, surfaces = seen[name]
        assert shown == [] and "already: Surface" in said
        assert found == offset and surfaces == ["Surface"]
    assert seen["axis"] == ["Surface", ["Surface"], ["Axis"]]
    assert seen["offset"] == ["Surface 2", ["Surface", "Surface 2"]]


def test_surfaces_are_numbered_as_sections_are(window):
    assert step(window, "surface_used_again")["new"] == ["Surface", "Surface 2", "Surface 3"]


def test_a_node_of_the_tree_stands_for_what_it_holds(window):
    """A part or a compound by itself for its faces and curves, for nothing beside what is picked of
    it; what of a selection is neither is named."""
    seen = step(window, "tree_nodes")
    one = ["Ball", "Face1", [["L1", "Edge1"]]]
    for name in ("with parts", "after parts", "compound and its line", "and nothing"):
        assert seen[name] == one, name
    assert seen["alone"] == ["Ball", "", [["L1", ""], ["L2", ""]]]
    label, faces, curves = seen["compound"]
    assert [label, faces] == ["whole", ""]
    assert curves == [["whole", "Edge4"], ["whole", "Edge5"]]
    assert "no curve is selected" in seen["no curve"]
    assert "Ball.Face1" in seen["no curve"] and "empty" in seen["no curve"]
    assert "2 faces" in seen["two faces"]
    assert "Ball.Face1" in seen["two faces"] and "whole" in seen["two faces"]


def test_members_of_a_part_that_was_moved(window):
    """They stand where the part stands; what was picked with it and is of no use is told."""
    seen = step(window, "tree_nodes")
    assert seen["shown"] == [] and seen["made"] == [["M1", "ok"], ["M2", "ok"]]
    assert "Left aside" in seen["said"] and "empty" in seen["said"]
    assert seen["x"] == pytest.approx([-3000.0, 5000.0], abs=20.0)


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
