# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Chinese window has no English of ours: every text of widgets, tables, menus and properties."""

import re

import pytest
from freecad_window import session, step

from BendTorsionWB.core.part_tables import PART_COLUMNS
from BendTorsionWB.gui.member_rows import COLUMNS

pytestmark = pytest.mark.slow

CHINESE = re.compile("[\u4e00-\u9fff]")
LATIN = re.compile(r"[A-Za-z]{3,}|OK")
SENTENCE = re.compile(r"[A-Za-z]{2,}(?: [a-z]{2,}){2,}")
"""Three words in a row, where Chinese stands beside."""
CODES = {
    *("BendTorsion", "FreeCAD", "English", "ISO", "AWS", "ARCH", "REF", "PUNCH"),
    *("Ctrl+Del", "Ins", "Del", "xlsx", "zip", "JSON", "MPa"),
}
"""Names of programs, languages, standards, formats of paper, layers and keys."""
TYPED = {name for columns in PART_COLUMNS.values() for name in columns} | {*COLUMNS}
TYPED |= {"centre", "axis", "none", "auto", "punch", "line", "text"}
"""Words of the schedule, typed into cells."""
QUOTED = ("left right middle", "end plates", "bevel angle", "inner backing", "line 200")
"""Words of the schedule a tooltip quotes."""


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """A session in Simplified Chinese."""
    return session("words", tmp_path_factory, language="Chinese Simplified")


def english(texts) -> list[str]:
    """The texts that hold more Latin than codes, marks, schedule words and names of objects."""
    found = []
    for text in texts:
        told = re.sub(r"<[^>]*>|\(?BendTorsion_\w+\)?|\w*/[\w/.]+|\b[A-Z]+_[A-Z]+\b", " ", text)
        told = re.sub(r"\b[MN]\d+(-axis| plates| bed| patterns| sheets)?\b|Ground", " ", told)
        for quoted in QUOTED:
            told = told.replace(quoted, " ")
        if CHINESE.search(told):
            found += [text] if SENTENCE.search(told) else []
        elif {word for word in re.findall(r"[\w+]+", told) if LATIN.search(word)} - CODES - TYPED:
            found.append(text)
    return found


def test_what_counts_as_english():
    """The rule sees sentences, alone and beside Chinese, and lets codes pass."""
    assert english(["Kind of surface", "曲面 of the whole member", "Cancel", "severity"]) != []
    assert len(english(["Kind of surface", "曲面 of the whole member", "Cancel"])) == 3
    assert english(["ISO", "M1 plates", "CUT_OUTER", "closing_face", "Ctrl+Del", "构件 M1"]) == []


def test_commands_menus_and_toolbars(window):
    texts = step(window, "commands")
    assert len(texts) > 100 and english(texts) == []


@pytest.mark.parametrize(
    "name",
    [
        *("Surface", "SectionSpec", "Axis", "Member", "PlateSet", "Unfold", "SheetSet"),
        *("AssemblyBed", "Node", "Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds"),
        *("Splits", "Alignment", "CutPoint"),
    ],
)
def test_panels(window, name):
    """Labels, tooltips, choices, headings of tables with what they tell."""
    texts = step(window, "panels")[name]
    assert any(CHINESE.search(text) for text in texts) and english(texts) == []


@pytest.mark.parametrize("name", ["MemberTable", "FindingsPanel", "left out"])
def test_docks(window, name):
    texts = step(window, "docks")[name]
    assert any(CHINESE.search(text) for text in texts) and english(texts) == []


@pytest.mark.parametrize("name", ["members", "PreferencesPage", "OutputPage", "asked"])
def test_dialogs(window, name):
    """And what commands ask: choices, kinds of files."""
    texts = step(window, "dialogs")[name]
    assert any(CHINESE.search(text) for text in texts) and english(texts) == []


def test_what_commands_tell(window):
    texts = step(window, "told")
    assert sum(bool(CHINESE.search(text)) for text in texts) >= 8 and english(texts) == []


@pytest.mark.parametrize("name", ["legend", "labels", "menu"])
def test_the_view(window, name):
    texts = step(window, "view")[name]
    assert any(CHINESE.search(text) for text in texts) and english(texts) == []


def test_properties(window):
    """Groups and tooltips in FreeCAD's property editor; names of properties are those scripts and
    expressions use."""
    found = step(window, "properties")
    assert len(found) >= 9
    for kind, seen in found.items():
        assert seen["tips"], kind
        told = seen["tips"].values()
        assert [tip for tip in told if not CHINESE.search(tip)] == [] == english(told), kind
        assert not {*seen["groups"]} & {*seen["titles"]}, kind


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
