# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every command of the window is one undo step, and a macro of it runs without a window."""

import sys

import FreeCAD
import pytest
from freecad_window import ROOT, run_in_window

sys.path.insert(0, str(ROOT / "tests" / "window"))
import macro_base
from test_command_table import PROMISED

SCRIPT = ROOT / "tests" / "window" / "macro_session.py"
PICTURES = ROOT / "build" / "pictures" / "macro"
CHANGE_NOTHING = {
    *("ShowAs", "ShowFrames", "ShowMarks", "ShowPoints", "MemberTable", "Check", "Findings"),
    "FitMembers",
    *("WriteSchedule", "Report", "ExportPackage", "Repair", "SupportBundle"),
}
"""Commands that look at a document or write files."""
ELSEWHERE = {"ImportSchedule", "Example", "Preferences"}
"""Commands that open another document, or none."""

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """A session in which every command is used once."""
    folder = tmp_path_factory.mktemp("macro")
    seen = run_in_window(SCRIPT, folder, time_limit=400, pictures=PICTURES)
    for step in ("all_commands", "opened", "two_documents"):
        assert "failed" not in seen[step], seen[step]["failed"]
    return seen


def test_every_command_does_what_it_says(window):
    """None shows an error instead."""
    seen = window["all_commands"]
    assert {name: text for name, text in seen["shown"].items() if text} == {}
    assert set(seen["shown"]) | ELSEWHERE == set(PROMISED)
    assert window["opened"]["shown"] == []
    assert "Traceback" not in window["report_view"]


def test_every_command_is_one_undo_step(window):
    """Those that change the document; the others leave no step behind."""
    undo = window["all_commands"]["undo"]
    assert {name for name, steps in undo.items() if steps == 0} == CHANGE_NOTHING
    assert {steps for name, steps in undo.items() if name not in CHANGE_NOTHING} == {1}


def test_the_macro_makes_the_same_objects_without_a_window(window):
    """Line by line in plain Python, in a document with the same shapes; lines that only concern the
    view do nothing there."""
    wanted = window["all_commands"]["figures"]
    assert len(wanted) > 15 and {status for _, status, _ in wanted.values()} == {"ok"}
    document = macro_base.base("Again")
    before = set(FreeCAD.listDocuments())
    try:
        exec("\n".join(window["all_commands"]["lines"]), {})
        found = macro_base.figures(document)
    finally:
        for name in {"Again", *FreeCAD.listDocuments()} - (before - {"Again"}):
            FreeCAD.closeDocument(name)
    assert found.keys() == wanted.keys()
    for label, (kind, status, size) in wanted.items():
        assert found[label][:2] == [kind, status]
        assert found[label][2] == pytest.approx(size, rel=1e-7)


def test_schedules_and_templates_open_by_a_macro(window):
    """The schedule that was written gives the members it was written from."""
    assert {"M1 plates", "M2 plates", "M3 plates"} <= set(window["opened"]["imported"])
    lines = window["opened"]["lines"]
    assert sum("make_files.open_schedule(" in line for line in lines) == 1
    assert sum("make_files.open_template('member'" in line for line in lines) == 1


def test_a_step_about_two_documents_names_each(window):
    """Replayed, another may be active by then: only the first is the one that is active."""
    seen = window["two_documents"]
    assert seen["One"] == ["First", "Third"] and seen["Two"] == ["Second", "Fourth"]
    named = [line for line in seen["lines"] if line.startswith("document = ")]
    assert named == [
        "document = FreeCAD.ActiveDocument",
        "document = FreeCAD.getDocument('Two')",
        "document = FreeCAD.getDocument('One')",
        "document = FreeCAD.getDocument('Two')",
    ]
