# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window by real keys alone: members from a selection, Tab, Esc and Enter in the panels."""

import pytest
from freecad_window import session, step

PANELS = ("Section", "Axis", "Surface", "Node", "Plates", "CutPoint", "Development")
PANELS += ("AssemblyBed", "Alignment")


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("keys", tmp_path_factory)


def test_members_are_made_by_keys_alone(window):
    """Arrows in the tree choose a ball and two arcs on it; B, F opens the dialog at its height, Tab
    goes on, an arrow chooses the alignment, Enter makes the members."""
    seen = step(window, "members")
    assert seen["active"] and seen["selected"] == ["Ball", "Arc10", "Arc25"]
    assert seen["dialog"] == [True, "h", "b", "t", "align", "first"]
    assert seen["made"] == ["M7", "M8"] and seen["section"] == ["box1", 700.0, 500.0, 14.0]
    assert seen["align"] == "top"
    assert seen["undo"] == ["Members from selection"]
    # The shapes alone; with surface and section, and axis, member and plates of each.
    assert seen["undone"] == 3 and seen["redone"] == 3 + 2 + 2 * 3


@pytest.mark.parametrize("name", PANELS)
def test_tab_goes_through_a_panel(window, name):
    """From the field that has the keyboard first, downwards, missing none; Esc closes it."""
    seen = step(window, "order")["seen"][name]
    assert seen["inside"] and seen["missed"] == [] and len(seen["names"]) > 3
    assert [y for _, y in seen["down"]] == sorted(y for _, y in seen["down"])
    assert seen["closed"] and step(window, "order")["undo"] == []


def test_enter_keeps_what_was_typed(window):
    """As one undo step, and closes the panel."""
    assert step(window, "enter")["first"] == [False, 560.0, ["Section"]]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
