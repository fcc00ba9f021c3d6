# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands, task panels, member table and findings panel in FreeCAD's real window."""

import math

import pytest
from freecad_window import ROOT, run_in_window, step

SCRIPTS = ROOT / "tests" / "window"
PICTURES = ROOT / "build" / "pictures" / "commands"
# Box 800 × 600 × 16 with its top on the axis, an arc of 40 degrees on a great circle of 20 m.
AREA = 800 * 600 - 768 * 568
CENTROID = 20000.0 - 400.0


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What the session with commands and panels saw, step by step."""
    script = SCRIPTS / "commands_session.py"
    folder = tmp_path_factory.mktemp("window")
    return run_in_window(script, folder, time_limit=400, pictures=PICTURES)


@pytest.fixture(scope="module")
def output(tmp_path_factory):
    """What the session that writes and opens files saw."""
    script = SCRIPTS / "output_session.py"
    folder = tmp_path_factory.mktemp("output")
    seen = run_in_window(script, folder, time_limit=400, pictures=PICTURES)
    own = step(seen, "output") | {
        name: step(seen, name) for name in ("losses", "expressions", "split")
    }
    return own | {"report_view": seen["report_view"]}


def test_every_command_is_on_a_toolbar_with_icon_words_and_a_shortcut_of_its_own(window):
    """Shortcuts are two keys; none takes one of FreeCAD's."""
    seen = step(window, "commands")
    bars = {name: set(items) - {"Separator"} for name, items in seen["toolbars"].items()}
    assert set(bars) == {f"BendTorsion {name}" for name in ("Model", "Plates", "View", "Output")}
    assert (
        sum(map(len, bars.values())) == len(seen["registered"]) == len(set().union(*bars.values()))
    )
    assert all(seen["registered"]) and all(seen["icons"]) and all(seen["words"])
    assert len(set(seen["shortcuts"])) == len(seen["shortcuts"])
    assert not set(seen["shortcuts"]) & set(seen["used_twice"])


def test_every_button_of_the_toolbars_is_in_sight_at_1600_pixels(window):
    """None is behind the arrow of a toolbar that has no room."""
    seen = step(window, "commands")
    width, bars = seen["reachable"]
    buttons = {
        name: sum(item != "Separator" for item in items) for name, items in seen["toolbars"].items()
    }
    assert width == 1600 and bars == {name: [count, False] for name, count in buttons.items()}


def test_with_nothing_selected_commands_say_what_to_select(window):
    """One line with its mend, nothing made, no undo step; without a document they are disabled."""
    seen = step(window, "nothing_selected")
    for name, shown in {**seen["shown"], **seen["wrong"]}.items():
        assert len(shown) == 1 and ": " in shown[0] and shown[0].endswith("."), name
        assert "->" not in shown[0] and "selection:" not in shown[0] and "\n" not in shown[0], name
    assert seen["objects"] == 0 and seen["undo"] == []
    assert seen["active_without_document"] == []


def test_members_from_a_face_an_arc_and_a_compound_of_chains(window):
    """Each chain is a member, numbered on from the number asked for, all in one undo step."""
    seen = step(window, "members")
    assert seen["shown"] == []
    assert seen["too_thick"][0] is False and "2 t" in seen["too_thick"][1]
    assert seen["dialog"] == [True, "3 members from M5 on, cut into plates"]
    assert seen["undo"] == ["Members from selection"]
    assert seen["after_undo"] == []
    # Pappus: the section's centroid runs along an arc.
    wanted = AREA * CENTROID * math.radians(40.0)
    for mark in ("M5", "M6", "M7"):
        assert seen["volumes"][f"{mark} plates"] == pytest.approx(wanted, rel=1e-6)


def test_one_tree_node_per_member(window):
    """Axis and plates are folded under it."""
    tree = step(window, "members")["tree"]
    assert [text for text in tree if text.startswith("M")] == ["M5", "M6", "M7"]


def test_what_a_command_adds_is_folded_under_its_member(window):
    """Though OK makes it anew."""
    tree = [text for _, text in sorted(map(tuple, step(window, "folded")["tree"]))]
    depths = [depth for depth, _ in step(window, "folded")["tree"]]
    assert tree == ["M1", "M1 plates", "M1 patterns"]
    assert depths == [depths[0], depths[0] + 1, depths[0] + 2]


def test_the_recorded_macro_makes_the_same_again(window):
    """The lines of the Python console, run in a document with the same shapes."""
    seen = step(window, "members")
    assert seen["again"] == seen["volumes"]
    assert sum("make.make_member(" in line for line in seen["lines"]) == 3


def test_section_panel_shows_at_once_and_cancel_takes_all_back(window):
    """Mass follows while typing; after Cancel and undo everything is as before."""
    seen = step(window, "section_panel")
    before, typed, cancelled, bad_cancelled, kept, undone = seen["mass"]
    assert seen["height"] == [600.0, 900.0, 600.0, 600.0, 700.0, 600.0]
    assert typed > kept > before
    assert cancelled == bad_cancelled == undone == before
    assert seen["undo"][1:] == [[], [], ["Edit section"], []]
    assert seen["inactive"] is False and seen["open"] is False
    assert seen["new"] == [[], "Section", ["Section"]]


def test_an_accepted_edit_is_one_line_that_can_be_run(window):
    """What was tried out in between is not recorded."""
    lines = step(window, "section_panel")["lines"]
    assert lines[-2:] == [
        "document.getObject('SectionSpec').Height = 700.0",
        "document.recompute()",
    ]
    assert sum("getObject" in line for line in lines) == 1


def test_a_value_that_cannot_be_is_marked_at_its_field(window):
    """Plates as thick as the section: no plates, the reason in the panel, at the thickness."""
    seen = step(window, "section_panel")
    text, count, status = seen["bad"]
    assert "top plate thickness fills half the section" in text
    assert "make top plate thickness thinner" in text and "t_top" not in text
    assert count == 0 and status.startswith("error: B600")
    assert seen["flagged"] == [True, False] and seen["ok"] is False


def test_member_panel_edits_segments(window):
    """Transition 2.5 times the step of 100 mm per face; a cut added lies midway; Cancel undoes."""
    seen = step(window, "member_panel")
    assert seen["transition"] == ["Transition 250 mm: 5000 to 5250"]
    assert seen["cut"] == 4500.0
    assert seen["align"] == ["centre", "top"]
    assert seen["segments"] == [3, 4]
    assert seen["cuts"] == [4500.0, 7750.0, 11000.0] and seen["status"] == "ok"
    assert seen["cancelled"] == [3, 5000.0, "centre", []]


def test_cut_point_adds_a_segment_that_cancel_takes_away(window):
    """The middle of M1 lies in its second segment; the new one is the third."""
    seen = step(window, "member_panel")
    assert seen["cut_point"] == [4, 3]
    assert seen["cut_cancelled"] == [3, []]
    assert seen["cut_kept"] == [4, ["Cut point"]]


def test_joints_as_text(window):
    """A joint more is a plate more; text that is none is marked and leaves the joints alone."""
    seen = step(window, "plate_panels")
    assert seen["count"][1] == seen["count"][0] + 1
    assert seen["bad"][0] == [8000.0] and "write auto, or numbers" in seen["bad"][1]
    assert seen["bad"][2] is False
    before, told, enabled = seen["bad stock"]
    assert before == "" and "cannot be read" in told and enabled is False
    assert seen["stock"] == ["9000x2000", True]
    assert seen["kept"] == [[8000.0], ["Plates"]]


def test_split_editor_moves_joints_and_shows_the_rules(window):
    """Three key presses are 30 mm; 20 mm from the neighbour's joint breaks the stagger rule."""
    seen = step(window, "plate_panels")
    before, after = seen["moved"]
    assert sum(before) - sum(after) == pytest.approx(30.0)
    assert "joints of faces top and left are too close" in seen["rules"]
    assert seen["split_cancelled"] == before


def test_diaphragms_are_pasted_as_rows(window):
    """Tab-separated text becomes rows; a row that cannot be read is marked and not taken."""
    seen = step(window, "plate_panels")
    assert seen["diaphragms"] == [["3000", "7000"], [0.0, 2.0], "ok"]
    assert seen["bad_row"][0] == ["3000", "7000"] and "place cannot be read" in seen["bad_row"][1]
    assert seen["bad_row"][2] is False and seen["mended"] is True
    places, reason, ok = seen["half_row"]
    assert places == ["3000", "7000"] and "a number is missing" in reason and not ok
    assert seen["undo"][0] == "Diaphragms and end plates"


def test_alignment_of_several_members_by_arrow_key(window):
    """All segments of both."""
    assert step(window, "plate_panels")["aligned"] == [["bottom"] * 3] * 2


def test_table_takes_a_pasted_block_in_one_undo_step(window):
    """Cells that mean something are written; the one that does not is marked with the reason."""
    seen = step(window, "table")
    assert seen["rows"] == 6
    assert seen["cuts"] == [5200.0, 11200.0]
    assert seen["align"] == ["top", "bottom"]
    assert seen["bad"][0] == "nowhere" and "is none of centre, top" in seen["bad"][1]
    assert seen["steps"] == 1


def test_table_tells_while_one_types_and_repeats_what_is_pasted(window):
    """A cell is judged before it is left; Esc leaves it as it was. Quotes are a spreadsheet's."""
    found = step(window, "table")
    bad, good, offered, left = found["told"]
    assert bad[0] and "nowhere" in bad[1] and good == [False, ""]
    assert offered == 9 and left == "top"
    assert found["repeated"] == [3.0, 3.0, "linear", "linear"]
    # Cells between that are not selected are empty.
    assert found["copied"] == "5200\t\n\t3"


def test_table_fills_down_and_marks_members_in_error(window):
    """Fill down reaches all members; a cut beyond the axis is told at the member's name."""
    seen = step(window, "table")
    assert seen["filled"] == [25.0] * 6
    assert seen["joints"] == [["left"], [7000.0], "ok"]
    assert seen["error"][0] == seen["error"][1]
    assert "cut lies beyond the end of the axis" in seen["error"][1]


def test_findings_are_listed_and_shown_where_they_are(window):
    """A click selects the object and puts the place in the middle of the view."""
    seen = step(window, "findings")
    assert seen["title"].startswith("Findings: 2 errors")
    assert "cut lies beyond the end of the axis" in seen["texts"]
    assert seen["selected"] == ["M1"]
    assert "error" not in seen["left"]
    assert seen["positions"][0] == "s = 8000 mm"
    assert seen["off_place"] < 1.0


def test_keys_in_the_findings_go_where_a_click_does(window):
    """And keep the keyboard; a list filled anew goes nowhere."""
    at_row, off, has_keys, marked, after = step(window, "findings")["by_keys"]
    assert at_row and off < 1.0 and has_keys and after == 0


def test_headings_of_docks_follow_the_language(window):
    assert step(window, "findings")["headings"] == [["对象", "段"], ["object", "segment"]]


def test_a_panel_edits_its_own_document_and_goes_with_it(window):
    """Another document being active does not matter."""
    seen = step(window, "documents")
    assert seen["first"] == [0.0, False]
    assert seen["second"] == [650.0, ["Section"]]
    assert seen["open_after_closing"] is False


def test_a_deleted_source_is_told_in_the_panel(window):
    """The member without its axis."""
    assert "M2: Axis is not set" in step(window, "documents")["source_gone"]


def test_the_tree_keeps_its_columns_while_a_package_is_written(output):
    """FreeCAD's column of labels is as wide as they are; while the tree folds a document it stays
    so, and no column beside it comes into view. It follows its contents again afterwards."""
    seen, widths, follows = output["tree"]
    assert seen > 5 and len(widths) == 1 and follows


def test_package_is_that_of_the_command_line_and_can_be_stopped(output):
    """Stopped, it leaves neither report nor workbook; whole, a DXF per plate."""
    assert output["shown"] == [] and output["package_shown"] == [] == output["stopped_shown"]
    assert output["undo"] == ["Sheets", "Assembly bed", "Development"]
    assert output["bars"]
    assert not {"report.json", "results.xlsx"} & set(output["stopped"])
    assert {"plates", "nc1", "sheets", "model.step", "report.json", "results.xlsx"} <= set(
        output["package"]
    )
    assert {f"{mark}.dxf" for mark in output["marks"]} <= set(output["plates"])
    assert output["active"]
    seen, own = output["seen"]
    assert seen == [own]


def test_schedule_is_written_and_read_again(output):
    """The imported document has the same plates."""
    assert output["schedule"] == [[], True]
    assert output["import_shown"] == []
    assert output["import"] == pytest.approx(output["wanted"], rel=1e-9)
    assert output["report"] == [[], True]


def test_what_a_schedule_cannot_say_is_told_by_its_command(output):
    """In a box, each with its mend; of too many the Report view, which stays closed, has all."""
    shown, said, (text,), opened, listed = output["losses"]["1"]
    assert shown == [] and "spare1.xlsx" in said and not opened and listed == 0
    heading, *lines = text.splitlines()
    assert heading.startswith("Written without") and f"({len(lines)})" in heading
    assert any("section spare 0" in line and " -> " in line for line in lines)
    assert "more" not in text
    shown, _, (text,), opened, listed = output["losses"]["10"]
    heading, *lines = text.splitlines()
    assert shown == [] and not opened and listed == 1
    assert len(lines) == 9 and "more" in lines[-1] and "Report view" in lines[-1]


def test_a_lost_expression_is_told_in_the_words_of_the_window(output):
    """By object, label of the property and expression; nothing is told of what nobody set."""
    (text,), section, member = output["expressions"]
    heading, *lines = text.splitlines()
    assert "(2)" in heading
    first, second = sorted(lines, key=lambda line: member in line)
    assert section in first and "Thickness t" in first and "Sizes.A1" in first
    assert member in second and "Offset Y" in second and "Sizes.A1 - 12" in second
    assert "OffsetY" not in text and "property" not in text


def test_the_document_of_a_split_model_names_those_to_open(output):
    """It holds no member itself."""
    assert len(output["split"]) == 3
    for lines in output["split"].values():
        assert len(lines) == 1 and "open or name one of these: model/001.FCStd" in lines[0]


def test_what_cannot_be_read_or_written_is_told_in_a_line(output):
    """A folder that cannot be, a workbook that is none: a line, and no document left over."""
    assert len(output["read_only"]) == 1 and "cannot be written" in output["read_only"][0]
    assert len(output["bad_schedule"]) == 1 and "not an Excel workbook" in output["bad_schedule"][0]
    assert output["example"] == [[], True]
    assert output["documents"] == 1


def test_no_exception_in_the_report_view(window, output):
    """Over all steps of both sessions."""
    for text in (window["report_view"], output["report_view"]):
        assert "Traceback" not in text and "Error" not in text
