# SPDX-License-Identifier: LGPL-2.1-or-later
"""The first panel of a session in FreeCAD's window, opened after a dialog of ours has gone."""

from freecad_window import session, step

from BendTorsionWB.gui import standard_buttons


def test_the_first_panel_after_a_dialog_has_the_keyboard_and_its_buttons(tmp_path_factory):
    window = session("first_panel", tmp_path_factory)
    seen = step(window, "first_panel")
    assert seen["keyboard"] and seen["good"] and not seen["bad"]
    assert not seen["open"] and seen["undo"] == ["Members from selection"]
    assert "Traceback" not in window["report_view"]


def test_buttons_of_a_dialog_that_is_gone_are_asked_for_again():
    """PySide gives them once, for as long as they are not collected."""

    class Box:
        def standardButtons(self):
            return 0

    class Gone(Box):
        def standardButtons(self):
            raise RuntimeError("Internal C++ object already deleted.")

    class Dock:
        answers = [[Gone(), Box()], [Box(), Box()]]

        def findChildren(self, _):
            return self.answers.pop(0)

    found = standard_buttons.boxes_in(Dock())
    assert [type(box) for box in found] == [Box, Box]
    Dock.answers = [[Gone()], [Gone(), Box()]]
    assert [type(box) for box in standard_buttons.boxes_in(Dock())] == [Box]
