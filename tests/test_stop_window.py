# SPDX-License-Identifier: LGPL-2.1-or-later
"""Long work in FreeCAD's window is stopped by a real click on Cancel, at any phase."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("stop", tmp_path_factory, time_limit=300)


@pytest.mark.parametrize("when", ["made", "drawn"])
def test_sheets_stop_while_pages_are_made_and_while_they_are_drawn(window, when):
    """At the last member: objects, what is to be computed, and undo steps are as before."""
    seen = step(window, "sheets")[when]
    assert (
        seen["clicked"] == "Sheets: M2 sheets 5"
        and seen["shown"] == []
        and seen["told"] == ["Stopped"]
    )
    assert all(seen["same"])


@pytest.mark.parametrize("when", ["made", "drawn"])
def test_the_dialog_moves_with_the_pages(window, when):
    """Processor time from one saying to the next: no more than a member's own sheets laid out."""
    seen = step(window, "sheets")[when]
    assert seen["pages"] >= 4 and seen["gap"] < 4.0
