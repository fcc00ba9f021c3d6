# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a shop reads off sheets: sizes in the sheet's unit, welds of ends, overall lengths, site."""

import ast
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from sheet_checks import faults
from test_sheet import strip_member
from test_sheet_style import RECORD, SITE

from BendTorsionWB.core.beds.bed_record import ControlPoint
from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_bed import point_listings, point_rows, points_header
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.drawings.sheet_terms import PREPARATIONS
from BendTorsionWB.core.lofting import FlatHole
from BendTorsionWB.core.welds.preps import prep_of

WELDS = Path(__file__).resolve().parent.parent / "BendTorsionWB" / "core" / "welds"


def words(sheets):
    return [text.text for sheet in sheets for text in sheet.all_texts()]


def with_hole(title):
    """The member with an opening in the middle of its first plate."""
    first = RECORD.plates[0]
    ring = np.array([(-50, -14), (50, -14), (50, 14), (-50, 14), (-50, -14)], float)
    corner = np.concatenate(first.outline).min(axis=0)
    hole = FlatHole("O-1", title, (ring + corner + (254.0, 127.0),), None, 2800.0)
    return replace(RECORD, plates=(replace(first, holes=(hole,)), *RECORD.plates[1:]))


@pytest.mark.parametrize(
    ("title", "wanted"),
    [
        ("slot 100x28", 'O-1 slot 3.937"x1.102" at 10.000", 5.000"'),
        ("200x100 r=20", 'O-1 7.874"x3.937" r=0.787" at 10.000", 5.000"'),
        ("d=300", 'O-1 d=11.811" at 10.000", 5.000"'),
    ],
)
def test_openings_are_told_in_the_unit_of_the_sheet(title, wanted):
    record = with_hole(title)
    assert wanted in words(member_sheets(record, SheetStyle(unit="ft-in", format="A1")))
    assert f"O-1 {title} at 254.0, 127.0" in words(member_sheets(record, SheetStyle(format="A1")))


@pytest.mark.parametrize(
    ("thickness", "cell", "plate"),
    [
        (16.0, "0.630 (16)", '0.630" (16 mm)'),
        (15.875, "5/8", '5/8"'),
        (15.88, "5/8", '5/8"'),
        (25.4, "1", '1"'),
        (25.0, "0.984 (25)", '0.984" (25 mm)'),
        (323.85, "12 3/4", '12 3/4"'),
        (0.5, "0.020 (0.5)", '0.020" (0.5 mm)'),
    ],
)
def test_thicknesses_in_inches_keep_the_millimetres_of_metric_plates(thickness, cell, plate):
    style = SheetStyle(unit="ft-in")
    assert (style.thickness(thickness), style.plate(thickness)) == (cell, plate)
    assert SheetStyle().plate(thickness) == f"{thickness:g} mm"
    inches = sum(float(Fraction(word)) for word in cell.partition(" (")[0].split())
    assert abs(25.4 * inches - thickness) <= 0.0127  # half a thousandth of an inch


@pytest.mark.parametrize("thickness", [*range(1, 127), 4.5, 12.5])
def test_no_usual_metric_plate_is_taken_for_one_in_inches(thickness):
    assert SheetStyle(unit="ft-in").thickness(thickness).endswith(f" ({thickness:g})")


def test_sheets_in_inches_tell_thicknesses_in_inches_everywhere():
    record = RECORD
    sheets = member_sheets(record, SheetStyle("Hall", "", "ARCH D", "AWS", "en", "ft-in"))
    said = words(sheets)
    assert sum(text.startswith('PL 0.787" (20 mm)') for text in said) == len(record.plates)
    assert sum("t0.787 (20)" in text for text in said) == 4 * len(record.controls)
    listings = [t for s in sheets for t in s.tables if "t, in (mm)" in t.header]
    assert len(listings) >= 2  # plates and welds
    cells = {r[t.header.index("t, in (mm)")] for t in listings for r in t.rows}
    assert cells - {""} == {"0.787 (20)"}
    assert not any(table.header.count("t") for sheet in sheets for table in sheet.tables)
    fields = [dict(sheet.fields) for sheet in sheets]
    assert all(own["sections, mm"] == record.sections for own in fields)
    assert all("t: in (mm)" in own["units"] for own in fields)


def test_small_sizes_in_inches_are_as_fine_as_in_millimetres():
    style = SheetStyle(unit="ft-in")
    for size in (0.0, 0.8, 2.0, 6.0, 17.5, 18.0):
        told = style.fine(size)
        assert told.endswith('"') and abs(25.4 * float(told[:-1]) - size) < 0.05
    assert style.shape("30x6") == '1.181"x0.236"'
    assert SheetStyle().shape("30x6") == "30x6" and SheetStyle().fine(18.0) == "18.0"


def with_end_plate(kind, at_end=True):
    """The member with a weld of its last top plate to an end plate, or to a node."""
    plates = [plate for plate in RECORD.plates if plate.face == "top"]
    own = plates[-1] if at_end else plates[0]
    place = own.s_end if at_end else own.s_start
    pair = ("M1-E1", own.mark) if kind == "end" else (own.mark, "M2 top")
    weld = replace(
        RECORD.welds[0],
        mark=f"M1-X/{own.mark[3:]}",
        kind=kind,
        plates=pair,
        start=place - 3.0,
        end=place + 20.0,
        prep=prep_of("fillet leg=8"),
    )
    return own.mark, weld.mark[3:], replace(RECORD, welds=(*RECORD.welds, weld))


def edge_rows(sheets, mark):
    tables = [table for sheet in sheets for table in sheet.tables if table.header[0] == "edge"]
    titles = [
        (text.text, text.x, text.y)
        for sheet in sheets
        for text in sheet.texts
        if text.text.startswith(f"{mark}: edges")
    ]
    return [
        row
        for _, x, y in titles
        for table in tables
        if abs(table.x - x) < 1.0 and 0.0 < y - table.y < 3.0
        for row in table.rows
    ]


@pytest.mark.parametrize("kind", ["end", "node"])
@pytest.mark.parametrize("at_end", [True, False])
def test_an_end_tells_the_weld_to_its_end_plate_or_node(kind, at_end):
    mark, weld, record = with_end_plate(kind, at_end)
    rows = edge_rows(member_sheets(record, SheetStyle(format="A1")), mark)
    own = [row for row in rows if row[0] == ("E-2" if at_end else "E-1")]
    assert [row[6] for row in own] == [weld]
    assert own[0][8:10] == ("square", "square")


@pytest.mark.parametrize("form", ["A4", "A3", "A1", "ARCH D"])
def test_the_assembly_has_the_length_over_the_ends(form):
    sheet = member_sheets(RECORD, SheetStyle(format=form))[0]
    points = np.concatenate(list(RECORD.wireframe.values()))
    axis = RECORD.wireframe.get("axis")
    if axis is None:
        axis = max(RECORD.wireframe.values(), key=lambda line: np.ptp(line, axis=0).max())
    along = (axis[-1] - axis[0]) / np.linalg.norm(axis[-1] - axis[0])
    wanted = np.ptp((points * along).sum(axis=1))
    found = [word for word in words([sheet]) if word.endswith(" over the ends")]
    assert len(found) == 1
    assert abs(float(found[0].split()[0]) - wanted) < 0.06
    assert faults(sheet) == []


def test_the_length_over_the_ends_takes_in_end_plates():
    axis = next(iter(RECORD.wireframe.values()))
    end = max(line[:, 0].max() for line in RECORD.wireframe.values())
    ring = np.array([(0, -300, 0), (0, 300, 0), (0, 300, 600), (0, -300, 600), (0, -300, 0)], float)
    ring[:, 0] += end + 12.5
    flat = replace(RECORD.plates[-1], mark="M1-E1", face="end", thickness=25.0, lines=(), points=())
    straight = {"axis": np.array([axis[0] * (1, 0, 0), (end, 0.0, 0.0)])}
    record = replace(
        RECORD, plates=(*RECORD.plates, flat), wireframe=straight | {"M1-E1": ring}, beds=()
    )
    sheet = member_sheets(record, with_plates=False)[0]
    start = float(axis[0][0])
    assert f"{end + 25.0 - start:.1f} over the ends" in words([sheet])


def test_a_few_plates_are_one_table_on_a_large_page():
    sheet = member_sheets(RECORD, SheetStyle(format="ARCH D"))[0]
    lists = [table for table in sheet.tables if table.header[0] == "mark"]
    assert [len(table.rows) for table in lists] == [len(RECORD.plates)]


def test_small_pages_put_the_figures_below_views_of_the_same_scale():
    for form in ("A4", "ARCH A"):
        sheets = member_sheets(RECORD, SheetStyle(format=form), with_plates=False)
        assert "net mass" in words(sheets[:1]) or "net mass" in words(sheets[1:2])
        marks = [
            row[0] for s in sheets for t in s.tables if t.header[0] == "mark" for row in t.rows
        ]
        assert sorted(marks) == sorted(plate.mark for plate in RECORD.plates)
        assert sum((faults(sheet) for sheet in sheets), []) == []
    first = member_sheets(RECORD, SheetStyle(format="A4"), with_plates=False)[0]
    assert "net mass" in words([first])


def test_members_of_the_general_arrangement_are_closed_at_their_ends():
    record = strip_member()
    view = arrangement_sheets([record], SheetStyle())[0].views[0]
    lines = [np.array(line.points) for line in view.polylines]
    for plates, label in ((record.plates[:1], "E-1"), (record.plates[-1:], "E-2")):
        for plate in plates:
            own = [p.xyz for p in plate.points if p.line == label and p.kind == "arris"]
            wanted = np.array(own)[:, [0, 2]]
            assert any(
                len(line) == 2 and np.allclose(np.sort(line, 0), np.sort(wanted, 0), atol=1.0)
                for line in lines
            )


class OneBed:
    """As much of a bed as its control points need."""

    points = (
        ControlPoint("E-1", "TL", 0.0, np.array([1000.0, 2000.0, 3000.0]), np.zeros(3)),
        ControlPoint("E-2", "BR", 900.0, np.array([0.0, 0.0, 0.0]), np.ones(3)),
    )


def test_control_points_have_their_places_on_the_site_where_that_has_a_datum():
    style = SheetStyle(site=SITE)
    assert points_header(style)[-3:] == ("site x, m", "site y, m", "site z, m")
    # Turned by a right angle: the site's x is minus the model's y, and its y the model's x.
    first, second = point_rows(OneBed, style)
    assert first[-3:] == ("998.000", "2001.000", "13.000")
    assert second[-3:] == ("1000.000", "2000.000", "10.000")
    assert len(points_header(SheetStyle())) == len(point_rows(OneBed)[0]) == 9


def test_places_on_the_site_too_wide_for_a_page_are_a_list_of_their_own():
    far = replace(SITE, x=123456789.0, y=987654321.0, unit="mm")
    lists = point_listings(OneBed, SheetStyle(format="A4", site=far))
    room = SheetStyle(format="A4").page
    for _, listing in lists:
        assert sum(listing.widths) <= room.right - room.left
    columns = [name for _, listing in lists for name in listing.header]
    assert set(columns) == set(points_header(SheetStyle(site=far)))
    assert len(point_listings(OneBed, SheetStyle(format="A1", site=far))) == 1


def test_names_the_program_gives_preparations_have_their_chinese():
    named = set()
    for path in WELDS.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Prep" and node.args:
                if isinstance(node.args[0], ast.Constant):
                    named.add(node.args[0].value)
    named.discard("")
    assert {"corner", "end plate"} <= named
    assert named <= set(PREPARATIONS)


@pytest.mark.parametrize("turn", [0.0, 0.5, 1.9, -2.6])
def test_axes_and_north_are_named_clear_of_members_and_arrows(turn):
    """A member along the model's x axis from its origin, and the site turned."""
    ring = np.array([(0.0, -300.0, -300.0), (0.0, 300.0, -300.0), (0.0, 300.0, 300.0)])
    lines = {f"{k}": np.array([start, start + (9000.0, 0, 0)]) for k, start in enumerate(ring)}
    record = replace(
        RECORD,
        wireframe={"axis": np.array([(0.0, 0, 0), (9000.0, 0, 0)])} | lines,
    )
    for form in ("A4", "A3"):
        style = SheetStyle(format=form, site=replace(SITE, rotation=turn))
        sheets = arrangement_sheets([record], style)
        assert sum((faults(sheet) for sheet in sheets), []) == []
        assert words(sheets).count("x") == 3  # of both views and of the site datum


def welded(count):
    """The member with so many welds."""
    seam = RECORD.welds[0]
    welds = tuple(replace(seam, mark=f"M1-TL-T{k}/L{k}") for k in range(count))
    return replace(RECORD, welds=welds)


def weld_tables(sheets):
    """The tables of the list of welds, by sheet."""
    own = [[t for t in sheet.tables if "cut / on" in t.header] for sheet in sheets]
    return [tables for tables in own if tables]


@pytest.mark.parametrize("form", ["A4", "A3", "A1"])
@pytest.mark.parametrize("count", [8, 9, 16])
def test_a_list_of_welds_that_its_page_holds_is_one_table(count, form):
    ((table,),) = weld_tables(member_sheets(welded(count), SheetStyle(format=form)))
    assert len(table.rows) == count + 1 and table.rows[-1][0] == "total"


@pytest.mark.parametrize("form", ["A4", "A3", "A1", "ARCH D"])
def test_the_total_of_a_list_of_welds_never_stands_alone(form):
    for count in (*range(30, 60), 100, 250):
        pages = weld_tables(member_sheets(welded(count), SheetStyle(format=form), False))
        rows = [len(table.rows) for tables in pages for table in tables]
        assert sum(rows) == count + 1
        assert pages[-1][-1].rows[-1][0] == "total" and rows[-1] >= min(8, rows[0] - 8)


@pytest.mark.parametrize(("language", "word"), [("en", "piece"), ("zh", "单元")])
@pytest.mark.parametrize("form", ["A4", "A3"])
def test_the_figures_of_a_piece_are_told_as_the_pieces(delivered, form, language, word):
    style = SheetStyle(format=form, language=language)
    heads = [
        (table.header[:2], table.rows[1][1])
        for sheet in member_sheets(delivered.record, style, with_plates=False)
        for table in sheet.tables
        if table.header[2:] == style.said(("figure", "value"))
    ]
    record = delivered.record
    wanted = [((style.say("member"), record.member), f"{record.mass:.1f} kg")] + [
        ((word, f"{record.member}-P{own.piece.number}"), f"{own.mass:.1f} kg")
        for own in record.pieces
    ]
    assert heads == wanted


def test_the_list_of_welds_stands_beside_the_sections_where_that_saves_a_page():
    sheets = [sheet for sheet in member_sheets(RECORD) if "sections and welds" in sheet.title]
    first, second = sheets
    assert first.views and any("cut / on" in table.header for table in first.tables)
    assert "Weld map" in {text.text for text in second.texts}
