# SPDX-License-Identifier: LGPL-2.1-or-later
"""Findings in Chinese: one table of templates, all of them, and each found again with values."""

import ast
import json
import re
import sys
import time
from pathlib import Path

import pytest

from BendTorsionWB.core import finding_language
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import error, note, warning
from BendTorsionWB.core.finding_language import (
    TABLE,
    VALUE,
    chinese,
    chinese_finding,
    chinese_line,
    in_chinese,
)

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import findings_table  # noqa: E402
import findings_texts  # noqa: E402
import translations  # noqa: E402

CJK = re.compile(r"[\u4e00-\u9fff]")
KNOWN = json.loads(TABLE.read_text(encoding="utf-8"))
# Texts whose every word is typed by the reader, or a mark.
SAME = {
    "corners: *message*",
    "thicknesses: *message*",
    "scrap",
    "trim",
    "metres",
    "micrometres",
    "three",
    "two",
}


@pytest.fixture(scope="module")
def texts():
    """{template: file} of the sources."""
    return findings_texts.texts()


def test_every_text_of_the_sources_has_its_chinese(texts):
    """`python3 scripts/findings_texts.py` lists what is missing."""
    assert len(texts) > 1000
    missing = {text: path for text, path in texts.items() if text not in KNOWN}
    assert not missing, "\n".join(f"{path}: {text}" for text, path in missing.items())


def test_the_table_has_nothing_the_sources_do_not_say(texts):
    """But for words that a text is given by an attribute or a table."""
    said = set()
    for path in (ROOT / "BendTorsionWB").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant | ast.JoinedStr):
                for text in findings_table.words(node, {}):
                    said.add(re.sub(r"\s+", " ", text).strip())
    assert set(KNOWN) - set(texts) - said == set()


def test_a_translation_has_the_values_of_its_source():
    for english, told in KNOWN.items():
        assert sorted(VALUE.findall(told)) == sorted(VALUE.findall(english)), english
        plain = VALUE.sub("", told)
        assert CJK.search(plain) or english in SAME or not re.search("[a-z]{3}", plain), english
        assert told == " ".join(told.split()), english


def test_the_table_is_in_order():
    assert list(KNOWN) == sorted(KNOWN)


def filled(template: str, values) -> str:
    """A text of a template."""
    parts = VALUE.split(template)
    return "".join(part if k % 2 == 0 else values[k // 2] for k, part in enumerate(parts))


def test_each_template_is_found_again_with_values_put_in():
    """Its own Chinese or that of one with the same words, each value at the place it has there."""
    by_words = {}
    for english, told in KNOWN.items():
        by_words.setdefault(tuple(VALUE.split(english)[::2]), []).append((english, told))
    for english in KNOWN:
        names = VALUE.findall(english)
        fixed = tuple(VALUE.split(english)[::2])
        if names and not finding_language.template(english, english).words:
            continue  # These join a name and a text; they have a test of their own.
        values = [f"V{k}7" for k in range(len(names))]
        text = " ".join(filled(english, values).split())
        wanted = set()
        for other, told in by_words[fixed]:
            wanted.add(finding_language.template(other, told).filled(values))
        assert chinese(text) in wanted, english


def test_values_that_are_texts_or_words_are_chinese_too():
    known = {
        "a joint of face top is too close to the end of a piece": "面上的拼接缝离单元端部过近",
        "'x' is no preparation of sheet Preps: the preparation cannot be read: "
        "7": "坡口无法读取：7",
        "X meets Y at the change of section of Y": "截面变化处",
        "is cut already and would be changed: trim 9.3 mm at lower edge; trim 0.7 mm at upper "
        "edge": "在下边修切 9.3 mm；在上边修切 0.7 mm",
        "write a number at least 0 mm": "至少 0 mm",
        "choose an Axis": "轴线",
        "M1: the cut all but runs along the axis at start": "始端",
        "fy has no unit": "fy 没有单位",
        "the diaphragm stands too sharp to right (open at the marked face) and left (open at the "
        "other face) for fillets: its square edge leaves 11 mm there, and is listed as a groove of "
        "30 degrees welded from that side": "右（开口朝划线面）与左（开口朝另一面）",
        "nothing runs through where these members meet: Y on X, X on Z": "Y 止于 X, X 止于 Z",
    }
    for english, part in known.items():
        told = chinese(english)
        assert part in told, (english, told)
        assert not re.search(r"(?<![\w'])[a-z]{2,} [a-z]{2,}", told.replace("fy", ""), re.ASCII)


def test_names_and_what_is_typed_stay_as_they_are():
    assert "M1 plates" in chinese("M1 plates is not set")
    assert chinese("音乐 厅 is not set") == "音乐 厅未设置"
    assert "top, bottom, left, right" in chinese("use top, bottom, left, right")
    assert in_chinese("sheet Splits, row 3, column top") == "表 Splits, 行 3, 列 top"
    assert "end" in chinese("did you mean end?")


CHOSEN = re.compile(
    r"(?<![\w=-])(keep|minimal|fixed|elastic|energy|edges|direct|link|frame given|frame surface"
    r"|隔板设为 none|隔板设为 flanges)(?![\w-])(（[^）]*）)?",
    re.ASCII,
)
"""Codes of choices that fields of the window offer by their names."""


def test_what_the_window_calls_a_choice_stands_behind_its_code():
    """Who reads `fit = keep` finds it in the window under another name."""
    window = translations.translations(translations.FOLDER / "BendTorsion_zh-CN.ts")
    found = {}
    for told in KNOWN.values():
        for code, name in CHOSEN.findall(told):
            word = code.split()[-1]
            assert window["BendTorsion", word] in name, told
            found[word] = name
    assert len(found) > 10


def test_texts_without_a_template_stay_english():
    for text in ("nothing of the kind was ever said", "", "é", "off"):
        assert chinese(text) == text
    assert chinese("没有选择构件") == "没有选择构件"


def test_a_line_has_severity_place_message_figures_and_mend():
    found = error(
        "joint-beside-node",
        "M1",
        "a joint of face top is too close to a node",
        "move the joint farther from the node",
        position="s = 3200 mm",
        value=470.5,
        limit="at least 600",
        unit="mm",
    )
    line = chinese_line(found)
    assert line.startswith("错误：M1，s = 3200 mm：面上的拼接缝离节点过近")
    assert "（实际 470.5 mm，限值至少 600 mm）。请" in line
    own = chinese_finding(found)
    assert (own.severity, own.code, own.value) == (found.severity, found.code, found.value)
    feet = SheetStyle(unit="ft-in", language="zh").told_length
    assert "1'-6 1/2\" (470.5 mm)" in chinese_line(found, feet)
    assert chinese_line(warning("x", "M1", "", "")) == "警告：M1"
    assert chinese_line(note("x", "", "give a name")).startswith("提示：请")


def test_a_table_that_is_gone_leaves_findings_english(tmp_path):
    assert chinese("give a name", tmp_path / "none.json") == "give a name"


def test_a_thousand_findings_are_told_in_a_moment():
    """Distinct ones, as of a large document."""
    found = [
        warning(
            "joint-beside-node",
            f"M{k}",
            f"a joint of face top is too close to {what}",
            f"use stock {k} mm wide for 3 lanes",
            position=f"s = {k} mm",
            value=float(k),
            limit=600.0,
            unit="mm",
        )
        for k in range(500)
        for what in ("a node", "a fold")
    ]
    chinese_line(found[0])
    start = time.process_time()
    lines = {chinese_line(one) for one in found}
    assert time.process_time() - start < 0.3 and len(lines) == 1000
    start = time.process_time()
    assert {chinese_line(one) for one in found} == lines
    assert time.process_time() - start < 0.2


def test_a_new_text_is_listed(monkeypatch, tmp_path, capsys):
    """Also one that a function is given, a variable holds or a ValueError says."""
    source = tmp_path / "core" / "new.py"
    source.parent.mkdir()
    source.write_text(
        "def fault(message):\n    return error('new-code', 'M1', message, 'mend the new one')\n"
        "def judge(kind):\n    said = 'the first is odd' if kind else f'the {kind} is odd'\n"
        "    return fault(said)\n"
        "def read():\n    raise ValueError('the brand new value is bad')\n"
        "def chosen(far):\n    said = error if far else warning\n"
        "    said('other-code', far, 'it was chosen so')\n",
        encoding="utf-8",
    )
    monkeypatch.setattr(findings_texts, "ROOT", tmp_path)
    monkeypatch.setattr(findings_texts, "SOURCES", tmp_path)
    assert set(findings_texts.texts()) == {
        *("mend the new one", "the first is odd", "the *kind* is odd"),
        *("the brand new value is bad", "it was chosen so"),
    }
    assert findings_texts.main() == 1
    assert "core/new.py: it was chosen so" in capsys.readouterr().out
