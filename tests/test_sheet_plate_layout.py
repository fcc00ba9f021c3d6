# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates with their tables share pages: in order, whole where they can be, as large as they can."""

import numpy as np
import pytest
from sheet_checks import faults
from test_sheet import strip_member

from BendTorsionWB.core.drawings.sheet import View
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_pack import GAP, Block
from BendTorsionWB.core.drawings.sheet_plate import EDGE_CUTS, EDGE_PLACES, plate_pages
from BendTorsionWB.core.drawings.sheet_plate_layout import COLUMN_GAP, columns_of, standing
from BendTorsionWB.core.drawings.sheet_style import SheetStyle

AREA = (10.0, 20.0, 410.0, 220.0)


def block(mark, wide, high):
    views = (View(mark, 10.0, (0.0, 0.0), ()),) if mark else ()
    return Block(mark, views, (), (), (0.0, 0.0, wide, high))


def placed_clear(blocks, columns, top):
    """That blocks stand in columns, none nearer to another than GAP."""
    for k, one in enumerate(blocks):
        left, bottom, right, up = one.box
        assert any(c.left - 1e-6 <= left and right <= c.left + c.width + 1e-6 for c in columns)
        assert up <= top + 1e-6 and bottom >= top - columns[0].height - 1e-6
        for other in blocks[:k]:
            apart = max(left - other.box[2], other.box[0] - right)
            assert max(apart, bottom - other.box[3], other.box[1] - up) >= GAP - 1e-6


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("seed", range(6))
def test_groups_stand_whole_in_order_column_by_column(seed, count):
    random = np.random.default_rng(seed)
    columns = columns_of(AREA, count)
    assert columns[-1].left + columns[-1].width == pytest.approx(AREA[2])
    groups = [
        [block(f"P{k}", *random.uniform(40, 150, 2)), block("", *random.uniform(20, 60, 2))]
        for k in range(6)
    ]
    seen, rest = [], groups
    while rest:
        placed, left = standing(rest, columns, AREA[3])
        assert placed
        placed_clear(placed, columns, AREA[3])
        assert len(placed) % 2 == 0 and len(left) + len(placed) // 2 == len(rest)
        marks = [one.mark for one in placed[::2]]
        seen, rest = seen + marks, left
        places = [
            (one.box[0] // (columns[0].width + COLUMN_GAP), -one.box[3]) for one in placed[::2]
        ]
        assert [place[0] for place in places] == sorted(place[0] for place in places)
    assert seen == [group[0].mark for group in groups]


def test_one_higher_than_a_column_goes_on_with_its_pattern_beside_a_table():
    columns = columns_of(AREA, 1)
    high = [block("P1", 300, 80), *(block("", 200, 90) for _ in range(3))]
    placed, rest = standing([high], columns, AREA[3])
    assert [one.mark for one in placed] == ["P1", ""] and [len(own) for own in rest] == [2]
    # Below something else it does not begin without room for a table.
    placed, rest = standing([[block("", 100, 100)], high], columns, AREA[3])
    assert [one.mark for one in placed] == [""] and [len(own) for own in rest] == [4]
    # One that a column holds is divided only where that is asked for.
    whole = [block("P2", 300, 40), block("", 200, 40), block("", 300, 80)]
    assert len(standing([[block("", 100, 80)], whole], columns, AREA[3])[1]) == 1
    placed, rest = standing([[block("", 100, 80)], whole], columns, AREA[3], True)
    assert [len(own) for own in rest] == [1]


@pytest.mark.parametrize("form", ["A4", "A3", "A1", "ARCH D"])
def test_plates_come_in_order_each_once_with_its_tables_readable(form):
    record, style = strip_member(), SheetStyle("Hall", "", form)
    pages = plate_pages(record, style)
    drawn = [view.name for page in pages for view in page.views if " " not in view.name]
    assert drawn == [plate.mark for plate in record.plates]
    rows = {}
    for page in pages:
        for table in page.tables:
            if table.header[0] == "point":
                for row in table.rows:
                    rows[row] = rows.get(row, 0) + 1
    assert sum(rows.values()) == sum(len(plate.points) for plate in record.plates)
    assert [fault for sheet in member_sheets(record, style) for fault in faults(sheet)] == []


def test_larger_pages_hold_more_plates_or_draw_them_larger():
    record = strip_member()
    found = {}
    for form in ("A4", "A3", "A1"):
        pages = [p for p in plate_pages(record, SheetStyle(format=form)) if p.views]
        found[form] = len(pages), min(view.scale for page in pages for view in page.views)
    assert found["A1"] <= found["A3"] <= found["A4"]  # the scale counts where pages do not


def test_two_lists_of_edges_on_a_narrow_page_have_all_columns_of_the_one():
    assert sorted({*EDGE_PLACES, *EDGE_CUTS}) == list(range(12))
    assert set(EDGE_PLACES) & set(EDGE_CUTS) == {0, 2}
