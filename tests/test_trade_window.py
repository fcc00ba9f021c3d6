# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a detailer who has read nothing tries first in FreeCAD's window."""

import json
from itertools import combinations

import pytest
from freecad_window import ROOT, run_in_window, session, step

from BendTorsionWB.gui import words

pytestmark = pytest.mark.slow

OPENING = ROOT / "tests" / "window" / "opening_session.py"
PICTURES = ROOT / "build" / "pictures" / "trade"


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("trade", tmp_path_factory)


@pytest.fixture(scope="module")
def opening(tmp_path_factory):
    """A model of plain Python, far from the origin, opened in the window."""
    import FreeCAD

    from BendTorsionWB import make

    folder = tmp_path_factory.mktemp("opening")
    document = FreeCAD.newDocument("Far")
    ground = make.make_surface(document, "Ground", "plane", origin=(0.0, 0.0, 30000.0))
    axis = make.make_axis(document, "A", ground, ((50000, 20000, 30000), (59000, 21000, 30000)))
    section = make.make_section(document, "B", h=500, b=400, t=12)
    member = make.make_member(document, "M1", axis, [section])
    make.make_unfold(document, make.make_plates(document, member))
    document.recompute()
    path = folder / "far.FCStd"
    document.saveAs(str(path))
    FreeCAD.closeDocument(document.Name)
    return run_in_window(OPENING, folder / "home", document=path, pictures=PICTURES)


def test_a_model_built_without_a_window_opens_whole_and_unmodified(opening):
    """All of it in the picture and as large as fits; nothing to save, nothing selected."""
    seen = step(opening, "opened")
    for least, most, size in (seen["across"], seen["down"]):
        assert -1.0 <= least <= most <= size + 1.0
    widest = max((most - least) / size for least, most, size in (seen["across"], seen["down"]))
    assert widest > 0.4 and seen["selected"] == 0
    assert "far : 1" in seen["tabs"] and not seen["modified"]


def test_a_camera_of_the_file_is_kept(opening):
    seen = step(opening, "opened_again")
    assert seen["height"] == pytest.approx(1234.0, rel=1e-3) and not seen["modified"]


def test_refusals_are_sentences_and_leave_the_report_view_alone(window):
    seen = step(window, "refusals")
    assert seen["shown"] == {
        "MembersFromSelection": [
            "0 faces are selected, one is needed: select one face, then one or more curves on it."
        ],
        "CutPoint": [
            "No member is selected: click a member where the cut is to be, then Cut point."
        ],
        "Sheets": ["No member has patterns: select members with patterns; Development makes them."],
    }
    assert seen["report"] == ""


def test_types_of_sections_are_told_in_words(window):
    """The same in the panel and in the dialog; what is kept is the code."""
    seen = step(window, "sections")
    assert {*seen["panel"]} == {*words.SECTION_TYPES}
    assert all(text.startswith(f"{code}: ") for code, text in seen["panel"].items())
    assert seen["dialog"] == {code: seen["panel"][code] for code in ("box1", "box2")}
    assert seen["value"] == "box2" and seen["apart"] >= 6


def test_the_picker_names_its_points(window):
    """The point under the mouse; itself, also to who cannot see it, by the one chosen."""
    seen = step(window, "sections")
    assert seen["points"] == ["top-left", "top", "right", "bottom"]
    tooltip, name = seen["picker"]
    assert tooltip == name and "of the section on the axis" in name


def test_new_members_are_alone_in_sight_and_undo_brings_the_face_back(window):
    seen = step(window, "members")
    assert not any(seen["visible"].values()) and seen["selected"] == []
    assert seen["undone"]


def test_patterns_lie_beside_each_other_and_clear_of_the_model(window):
    seen = step(window, "patterns")
    assert seen["states"] == ["ok"] * 3
    assert len(seen["patterns"]) == 3 and len(seen["model"]) == 4
    for one, other in combinations([*seen["patterns"].values()], 2):
        assert apart(one, other) > 100.0
    for laid in seen["patterns"].values():
        assert all(apart(laid, box) > 100.0 for box in seen["model"])


def apart(one, other) -> float:
    """Clear distance of two boxes (x, x, y, y), negative when they overlap."""
    return max(one[0] - other[1], other[0] - one[1], one[2] - other[3], other[2] - one[3])


def test_sheets_say_how_many_and_show_the_first(window):
    seen = step(window, "sheets")
    assert seen["shown"] == [] and seen["pages"] > 4
    assert seen["told"] == f"{seen['pages']} pages, in the tree below M1 sheets"
    assert seen["view"].startswith(seen["page"])


def test_nothing_to_repair_is_no_undo_step(window):
    seen = step(window, "repair")
    assert seen["before"] == seen["after"] and "Nothing to repair" in seen["told"]


def test_errors_speak_of_members_and_sections(window):
    """Of no rows where there is no schedule, of no kinds of objects of ours."""
    seen = step(window, "node")
    assert "row" not in seen["node"] and "M1 and M2 do not meet &rarr;" in seen["node"]
    assert "choose members that meet" in seen["node"]
    assert seen["labels"] == []
    found = [json.loads(text) for text in seen["section"]]
    told = [(one["message"], one["mend"]) for one in found if one["severity"] == "error"]
    assert told == [("the section of segment 1 is not set", "choose a section")]


def test_tables_of_parts_are_typed_into_at_once(window):
    assert step(window, "parts") == dict.fromkeys(
        ("Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds"), [True, 0, 0]
    )


def test_the_split_editor_gives_its_width_back(window):
    seen = step(window, "split")
    before, during, after = seen["widths"]
    assert during > before == after
    assert min(seen["texts"]) > 11.0 and min(seen["inside"]) >= 0.0
    assert "Joints: 4, against the rules: 0" in seen["verdict"]


def test_the_member_table_is_as_wide_as_the_window_and_high_enough(window):
    seen = step(window, "table")
    width, height, whole = seen["size"]
    assert width > 0.9 * whole and height >= 240
    assert min(seen["columns"].values()) >= 60 and max(seen["columns"].values()) < 300
    popup, text = seen["choices"]
    assert popup > text


def test_what_cannot_be_stays_until_it_is_mended_or_dropped(window):
    seen = step(window, "table")
    assert seen["kept"] == ["00; 20000", True] and seen["other"] == 25.0
    assert seen["mended"] == seen["dropped"] == ["6000 12000", ""]


def test_only_patterns_can_be_moved_with_the_mouse(window):
    seen = step(window, "transform")
    assert seen == {"Member": False, "PlateSet": False, "Unfold": True}


def test_severities_are_lighter_on_a_dark_ground(window):
    seen = step(window, "severities")
    for name, lightness in seen["#000000"].items():
        assert seen["#ffffff"][name] > 1.3 * lightness, name


def test_an_example_has_a_name_to_begin_with(window):
    (path,) = step(window, "example")
    assert path.endswith("project.FCStd")


def test_no_exception_in_the_report_view(window, opening):
    for seen in (window, opening):
        assert "Traceback" not in seen["report_view"] and "<class" not in seen["report_view"]
