# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every sheet and column of results.xlsx stands in the documentation, every sheet of a schedule."""

import re
from pathlib import Path

import openpyxl
import pytest
from flat_plates import member, rectangle

from BendTorsionWB.exchange.results_workbook import write_results
from BendTorsionWB.exchange.schedule_columns import OPTIONAL_SHEETS

DOCS = Path(__file__).resolve().parent.parent / "docs"


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    path = tmp_path_factory.mktemp("book") / "results.xlsx"
    write_results([member("M1", (rectangle(),))], (), path, length=str)
    return openpyxl.load_workbook(path)


def sections(text, heading):
    """What is said below a heading of each sheet, by its name in bold."""
    own = text[text.index(f"\n## {heading}") :]
    own = own[: own.find("\n## ", 4)] if "\n## " in own[4:] else own
    parts = re.split(r"\*\*(\w+)\*\*", own)[1:]
    return dict(zip(parts[::2], parts[1::2], strict=True))


def test_every_column_of_the_results_is_described(workbook):
    said = sections((DOCS / "files.md").read_text(encoding="utf-8"), "results.xlsx")
    missing = [
        f"{sheet.title}.{cell.value}"
        for sheet in workbook
        for cell in sheet[1]
        if not re.search(rf"\b{cell.value}\b", said.get(sheet.title, ""))
    ]
    assert missing == []


def test_the_schedule_says_which_sheets_may_be_missing():
    text = (DOCS / "schedule.md").read_text(encoding="utf-8")
    may = re.search(r"\*\*Settings,([^*]*)\*\* may be missing", text)[1]
    assert set(re.findall(r"\w+", may)) == set(OPTIONAL_SHEETS) - {"Settings"}
