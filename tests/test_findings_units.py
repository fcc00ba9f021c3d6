# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lengths of findings in the unit of the sheets, with millimetres beside them."""

import openpyxl
import pytest
from flat_plates import rectangle

from BendTorsionWB.console import print_findings
from BendTorsionWB.core.drawings.sheet_findings import finding_text
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE, SheetStyle
from BendTorsionWB.core.finding import warning
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.exchange.html_report import html_report
from BendTorsionWB.exchange.results_workbook import write_results

FEET = SheetStyle(unit="ft-in")
SHORT = warning("piece-too-short", "M1-T1", "too short", value=635.0, limit=1219.2, unit="mm")
TOLD = "value 2'-1\" (635 mm), limit 4'-0\" (1219.2 mm)"


def test_a_length_is_told_as_on_the_sheets_and_in_mm():
    assert TOLD in SHORT.line(FEET.told_length)
    assert SHORT.line(PLAIN_STYLE.told_length) == SHORT.line()
    assert "value 635 mm, limit 1219.2 mm" in SHORT.line()


def test_a_length_finer_than_a_sixteenth_is_told_in_decimals():
    fine = warning("length-error", "M1-T1", "off", value=0.0254, limit=0.012, unit="mm")
    assert 'value 0.001" (0.0254 mm)' in fine.line(FEET.told_length)


@pytest.mark.parametrize("unit", ["deg", "MPa", ""])
def test_what_is_no_length_stays_what_it_is(unit):
    other = warning("locked-in-stress", "M1-T1", "stress", value=70.5, limit=35.0, unit=unit)
    assert other.line(FEET.told_length) == other.line()


def test_sheets_report_workbook_and_console_tell_it(tmp_path, capsys):
    assert TOLD in finding_text(SHORT, FEET)
    chinese = finding_text(SHORT, SheetStyle(unit="ft-in", language="zh"))
    assert "2'-1\" (635 mm)" in chinese
    records = [MemberRecord("M1", "", "", plates=(rectangle(),))]
    page = html_report(records, (SHORT,), "Hall", "1.0", length=FEET.told_length)
    assert "2&#x27;-1&quot; (635 mm)" in page
    print_findings([SHORT], length=FEET.told_length)
    assert TOLD in capsys.readouterr().err
    write_results(records, (SHORT,), tmp_path / "r.xlsx", length=FEET.told_length)
    head, row, *_ = openpyxl.load_workbook(tmp_path / "r.xlsx")["Checks"].iter_rows(
        values_only=True
    )
    cells = dict(zip(head, row, strict=True))
    assert (cells["value"], cells["value_told"], cells["limit_told"]) == (635.0, "2'-1\"", "4'-0\"")
    write_results(records, (SHORT,), tmp_path / "mm.xlsx")
    head = next(openpyxl.load_workbook(tmp_path / "mm.xlsx")["Checks"].iter_rows(values_only=True))
    assert "value_told" not in head
