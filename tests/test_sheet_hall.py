# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every sheet of the concert hall can be read: in every format, standard, language and unit."""

from dataclasses import replace

import pytest
from sheet_checks import faults
from test_build_folder import HALL

from BendTorsionWB import project
from BendTorsionWB.core.drawings.sheet import Polyline, Text
from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_node import node_sheets
from BendTorsionWB.core.drawings.sheet_style import FORMATS, SheetStyle

USUAL = SheetStyle("Concert hall, entrance ribs", "A. N.")
STYLES = [
    *(SheetStyle("Concert hall", "", name, "ISO", "en", "mm") for name in FORMATS if name != "A3"),
    *(SheetStyle("音乐厅", "", name, "ISO", "zh", "mm") for name in ("A4", "A3", "A1")),
    *(
        SheetStyle("Hall", "", name, "AWS", "en", "ft-in")
        for name in ("ARCH A", "ARCH B", "ARCH D")
    ),
    SheetStyle("音乐厅", "", "A4", "AWS", "zh", "ft-in"),
]


@pytest.fixture(scope="module")
def records():
    schedule, jobs = project.read_jobs(HALL)
    return [result.record for result in project.compute(schedule, jobs).values()]


def test_every_sheet_of_the_hall_can_be_read(records):
    sheets = [sheet for record in records for sheet in member_sheets(record, USUAL)]
    sheets += arrangement_sheets(records, USUAL)
    assert len(sheets) > 300
    assert [fault for sheet in sheets for fault in faults(sheet)] == []


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(STYLES)), ids=lambda k: str(STYLES[k].format))
def test_sheets_of_the_hall_can_be_read_in_every_style(records, number):
    style = STYLES[number]
    # A member in each style, another in each; all are in the usual one.
    sheets = [*member_sheets(records[number], style), *arrangement_sheets(records, style)]
    assert [fault for sheet in sheets for fault in faults(sheet)] == []


@pytest.mark.slow
@pytest.mark.parametrize("unit", ["mm", "ft-in"])
def test_chamfered_edges_and_crowded_plates_stay_on_the_smallest_page(records, unit):
    """Lists of edges with chamfers are wider than A4; plates named in details have longer words."""
    sheets = member_sheets(records[3], SheetStyle("Hall", "", "A4", "AWS", "en", unit))
    assert [fault for sheet in sheets for fault in faults(sheet)] == []


def test_tables_that_leave_no_room_for_views_follow_them(records):
    style = SheetStyle("Hall", "", "ARCH B", "AWS", "en", "ft-in")
    sheets = member_sheets(records[3], style, with_plates=False)
    assert [fault for sheet in sheets for fault in faults(sheet)] == []
    assert dict(sheets[0].fields)["scale"] == "1:75"


@pytest.fixture(scope="module")
def meeting():
    schedule, jobs = project.read_jobs(HALL.with_name("concert_hall_nodes.xlsx"))
    return [result.record for result in project.compute(schedule, jobs).values()]


@pytest.mark.slow
@pytest.mark.parametrize("form", ["A4", "A3", "A1", "ARCH D"])
def test_every_node_of_the_hall_can_be_read_on_few_pages(meeting, form):
    count = len({node.node for record in meeting for node in record.nodes})
    for standard, language in (("ISO", "en"), ("AWS", "en"), ("ISO", "zh"), ("AWS", "zh")):
        sheets = node_sheets(meeting, SheetStyle("Hall", "", form, standard, language))
        assert [fault for sheet in sheets for fault in faults(sheet)] == []
        most = 3 * count if form == "A4" else count
        assert 30 <= count <= len(sheets) <= most


def test_what_cannot_be_read_is_found(records):
    sheet = member_sheets(records[0], USUAL)[0]
    assert faults(sheet) == []
    text = next(text for text in sheet.texts if text.text.startswith("M1-"))
    x, y = text.x, text.y + 0.5 * text.height
    left, bottom, right, top = sheet.frame
    planted = {
        "on": replace(sheet, texts=(*sheet.texts, replace(text, x=x + 1.0))),
        "crossed by a line": replace(
            sheet, lines=(*sheet.lines, Polyline(((x - 9.0, y), (x + 9.0, y))))
        ),
        "outside: 'far'": replace(sheet, texts=(*sheet.texts, Text(right - 1, top - 9, 2, "far"))),
        "outside: line": replace(
            sheet, lines=(*sheet.lines, Polyline(((right, bottom), (right + 1.0, bottom))))
        ),
        "too small": replace(sheet, texts=(*sheet.texts, Text(left + 5, top - 40, 1.7, "low"))),
        "cut off": replace(sheet, texts=(*sheet.texts, Text(left + 5, top - 40, 2, "too long.."))),
    }
    for what, spoilt in planted.items():
        found = faults(spoilt)
        assert found and any(what in fault for fault in found), what
