# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench speaks the language of FreeCAD's window."""

import re
import sys

import pytest
from freecad_window import ROOT, run_in_window

sys.path.insert(0, str(ROOT / "scripts"))
import translations

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """A session in Simplified Chinese."""
    script = ROOT / "tests" / "window" / "language_session.py"
    found = run_in_window(
        script, tmp_path_factory.mktemp("language"), language="Chinese Simplified"
    )
    for step in ("commands", "pages"):
        assert "failed" not in found[step], found[step]["failed"]
    return found


def test_every_command_is_in_chinese(window):
    """As the .ts says, on the buttons and in the menu."""
    known = translations.translations(translations.FOLDER / "BendTorsion_zh-CN.ts")
    actions = window["commands"]["actions"]
    assert len(actions) > 20
    for name, text in actions.items():
        wanted = known[name, window["commands"]["menu"][name]]
        assert text.replace("&", "") == wanted.replace("&", "")
        assert re.search(r"[\u4e00-\u9fff]", text)


def test_menu_and_toolbars_are_in_chinese(window):
    assert any("弯扭构件" in text for text in window["commands"]["menus"])
    assert "弯扭 板件" in window["commands"]["toolbars"]


def test_pages_are_in_chinese(window):
    assert window["pages"]["title"] == "新对象"
    assert {"高度 h", "规则包"} <= set(window["pages"]["labels"])
    assert window["pages"]["legend"] == "展开应变"
