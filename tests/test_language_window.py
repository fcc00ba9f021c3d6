# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench speaks the language of FreeCAD's window."""

import re
import sys

import pytest
from freecad_window import ROOT, run_in_window

sys.path.insert(0, str(ROOT / "scripts"))
import translations


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """A session in Simplified Chinese."""
    script = ROOT / "tests" / "window" / "language_session.py"
    found = run_in_window(
        script,
        tmp_path_factory.mktemp("language"),
        language="Chinese Simplified",
        time_limit=400,
        pictures=ROOT / "build" / "pictures" / "language",
    )
    for step in ("commands", "pages", "panels", "refusals", "findings"):
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


def test_no_label_is_cut_off(window):
    """In the panel of each kind of object, the pages of preferences and the dialog."""
    cut = window["panels"]["cut"]
    assert len(cut) >= 12
    assert {name: texts for name, texts in cut.items() if texts} == {}


def test_labels_of_panels_are_in_chinese(window):
    """But for names of sizes and layers, marks and numbers, and what the checks find."""
    latin = re.compile(r"[A-Za-z]{4,}")
    plain = {text for texts in window["panels"]["words"].values() for text in texts}
    english = {
        text for text in plain if latin.search(text) and not re.search(r"[\u4e00-\u9fff]", text)
    }
    assert {
        text for text in english if not re.fullmatch(r"[A-Z_]+|FreeCAD|BendTorsion.*", text)
    } == set()


def test_what_is_missing_in_a_selection_is_told_in_chinese(window):
    """Message and mend in one sentence, without severity and code."""
    assert len(window["refusals"]) == 12
    for name, (line,) in window["refusals"].items():
        assert line.endswith("。") and "错误" not in line and not line.startswith("选择："), name
        told = line.removesuffix("。").split("：")
        assert len(told) == 2, name
        for text in told:
            assert re.search(r"[\u4e00-\u9fff]", text), (name, text)
            assert not re.search(r"[A-Za-z]{3,}", text), (name, text)


SENTENCE = re.compile(r"(?<![\w'-])[a-z]{2,} [a-z]{2,} [a-z]{2,}", re.ASCII)


def test_findings_are_told_in_chinese(window):
    """An error, a warning and a refusal, wherever the window shows them, hold no English words in
    a row; texts that the window shows are Chinese."""
    found = window["findings"]
    assert found["warnings"]
    rows = [dict(zip(found["headings"], row, strict=True)) for row in found["rows"]]
    assert found["headings"] == ["级别", "对象", "位置", "内容", "实际", "限值", "处理"]
    assert {"错误", "警告"} <= {row["级别"] for row in rows}
    told = [row[name] for row in rows for name in ("内容", "处理")]
    told += [found["label"], found["field"], found["status_bar"]]
    told += [*found["tooltips"], *found["cells"], *found["boxes"]]
    assert len(found["tooltips"]) >= 3 and found["cells"] and len(found["boxes"]) == 2
    for text in told:
        assert re.search(r"[\u4e00-\u9fff]", text), text
        plain = re.sub(r"<[^>]+>|No such file or directory", "", text)
        assert not SENTENCE.search(plain), text
    assert found["boxes"][0].startswith("错误：M2") and found["status_bar"].startswith("错误：M2")


def test_what_objects_hold_of_findings_stays_english(window):
    assert not re.search(r"[\u4e00-\u9fff]", " ".join(window["findings"]["held"]))
    assert window["findings"]["held"][-1].startswith("error: M2")
