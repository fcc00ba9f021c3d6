# SPDX-License-Identifier: LGPL-2.1-or-later
"""The first panel of a session in FreeCAD's window, opened after a dialog of ours has gone."""

from freecad_window import session, step


def test_the_first_panel_refuses_what_cannot_be(tmp_path_factory):
    """Its OK is one that Qt made: PySide let go of it with the dock it was asked for through."""
    window = session("first_panel", tmp_path_factory)
    seen = step(window, "first_panel")
    assert not seen["ok"] and "-5" in seen["told"]
    assert "Traceback" not in window["report_view"] and "Error" not in window["report_view"]
