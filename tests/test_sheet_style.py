# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets in every format, standard, language and unit: readable, whole, searchable, joined."""

import ast
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from test_sheet import strip_member

from BendTorsionWB.core.beds.control_record import ControlSection, CutPlate
from BendTorsionWB.core.drawings.sheet import outside_frame, overlapping_texts
from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_layout import member_sheets, piece_record
from BendTorsionWB.core.drawings.sheet_style import FORMATS, INCH_HEADINGS, SheetStyle, feet_inches
from BendTorsionWB.core.drawings.sheet_symbols import projection_symbol
from BendTorsionWB.core.drawings.sheet_terms import CHINESE
from BendTorsionWB.core.drawings.sheet_weld_symbol import GROOVE, weld_arrow, weld_symbol
from BendTorsionWB.core.lofting import GrossPattern
from BendTorsionWB.core.members.piece_record import Piece, PieceFigures
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.core.welds.bevel_record import EdgeBevel
from BendTorsionWB.core.welds.preps import prep_of
from BendTorsionWB.core.welds.weld_record import Weld
from BendTorsionWB.exchange.schedule_columns import SETTINGS
from BendTorsionWB.sheets.pdf import write_pdf
from BendTorsionWB.sheets.pdf_join import joined_pdf
from BendTorsionWB.sheets.techdraw import template_path, template_svg

ROOT = Path(__file__).resolve().parent.parent
CORNER = prep_of("corner: bevel angle=45 land=6 outer")
BUTT = prep_of("butt: v angle=60 land=2 gap=2 outer")
SITE = SiteDatum(1e6, 2e6, 1e4, np.pi / 2, "m")


def section(marks, s, label, piece=1):
    """A box of 800 x 800 x 20, its top and bottom between the webs."""
    rings = {
        "top": ((380, 400), (-380, 400), (-380, 380), (380, 380)),
        "bottom": ((380, -400), (-380, -400), (-380, -380), (380, -380)),
        "left": ((400, 400), (400, -400), (380, -400), (380, 400)),
        "right": ((-400, 400), (-400, -400), (-380, -400), (-380, 400)),
    }
    cut = tuple(
        CutPlate(mark, face, 20.0, np.array(rings[face], float)) for mark, face in marks.items()
    )
    return ControlSection(piece, label, s, cut)


def welded_member(lengths=(2500.0, 3000.0)):
    """A member with sections, seams and joints, a field joint among them."""
    record = strip_member(lengths=lengths)
    by_face = {}
    for plate in record.plates:
        by_face.setdefault(plate.face, []).append(plate)
    welds = []
    for flange in ("top", "bottom"):
        for web in ("left", "right"):
            one, other = by_face[flange][0], by_face[web][0]
            name = flange[0].upper() + web[0].upper()
            welds.append(
                Weld(f"M1-{name}", "M1", 1, "seam", name, (one.mark, other.mark), 0.0, 2500.0,
                     2500.0, (20.0, 20.0), np.pi / 2, CORNER, "shop", "UT 20%")
            )  # fmt: skip
    for face in by_face:
        one, other = by_face[face][:2]
        welds.append(
            Weld(f"{one.mark}/{other.letter}2", "M1", 1, "joint", "", (one.mark, other.mark),
                 one.s_end, one.s_end, 800.0, (20.0, 20.0), np.pi, BUTT, "field", "")
        )  # fmt: skip
    first = {face: plates[0].mark for face, plates in by_face.items()}
    marks = {mark: face for face, mark in first.items()}
    last = {plates[-1].mark: face for face, plates in by_face.items()}
    controls = (
        section(marks, 0.0, "E-1"),
        section(marks, 1200.0, "F1"),
        section(marks, 2400.0, "M"),
        section(last, record.length, "E-2"),
    )
    centre = np.array([2750.0, 300.0, 900.0])
    return replace(record, welds=tuple(welds), controls=controls, centre_of_gravity=centre)


RECORD = welded_member()
STYLES = [SheetStyle("Concert hall", "A. N.", name, site=SITE) for name in FORMATS] + [
    SheetStyle("Concert hall", "", "A1", "AWS", "zh", "ft-in", SITE),
    SheetStyle("Concert hall", "", "A3", "ISO", "zh", "ft-in", SITE),
    SheetStyle("Concert hall", "", "A4", "AWS", "zh", "mm", SITE),
]


@pytest.mark.parametrize("style", STYLES, ids=lambda s: f"{s.format}-{s.language}-{s.unit}")
def test_every_sheet_is_readable_and_whole(style):
    sheets = (*member_sheets(RECORD, style), *arrangement_sheets([RECORD], style))
    for sheet in sheets:
        assert (sheet.width, sheet.height) == (style.page.width, style.page.height)
        assert [(a.text, b.text) for a, b in overlapping_texts(sheet.all_texts())] == []
        assert outside_frame(sheet) == []
        assert min(text.height for text in sheet.all_texts()) >= 1.8
        left, bottom, right, top = style.page.title_block
        for line in [line for view in sheet.views for line in view.on_page()]:
            x, y = np.array(line.points).T
            assert not np.any((x > left) & (x < right) & (y > bottom) & (y < top))


def words_of(sheets):
    return [text.text for sheet in sheets for text in sheet.all_texts()]


def test_the_assembly_drawing_says_what_the_shop_asks():
    style = SheetStyle(site=SITE)
    sheets = member_sheets(RECORD, style)
    first = words_of(sheets[:1])
    assert {"+s", "TOP", "M1-S", "CG"} <= set(first)
    for plate in RECORD.plates:
        place = re.compile(rf"(E-1 |F1 |M )?[TBLR,]+ {plate.s_start:.1f}")
        assert any(place.fullmatch(word) for word in first)
    # Turned by a right angle: the site's x is minus the model's y, and its y the model's x.
    assert "999.700, 2002.750, 10.900" in first
    sections = words_of(sheet for sheet in sheets if "sections and welds" in sheet.title)
    for weld in RECORD.welds:
        assert weld.mark in sections
    assert {"E-1 end  s 0.0", "F1 fold  s 1200.0"} <= set(sections)
    assert sections.count("400.0") == 4 * len(RECORD.controls)
    assert sum("t20" in word for word in sections) == 4 * len(RECORD.controls)


def test_plate_drawings_have_panels_points_edges_and_figures():
    first = RECORD.plates[0]
    joint = next(w for w in RECORD.welds if w.kind == "joint" and first.mark in w.plates)
    cut = EdgeBevel("end", "E-2", joint.mark, "butt", 0.0, 800.0, 0.0, (np.pi / 6, 18.0))
    larger = GrossPattern(
        first.outline, 2600.5, 810.5, 2.1e6, 333.3, 1.0, 1.0, np.zeros(2), 0.0, 0.0
    )
    first = replace(first, bevels=(cut,), gross=larger, flattened_surface="inner", contour="widest")
    record = replace(RECORD, plates=(first, *RECORD.plates[1:]))
    sheets = [sheet for sheet in member_sheets(record) if "flat patterns" in sheet.title]
    words = " | ".join(words_of(sheets))
    for plate in record.plates:
        assert f"{plate.mark}: points, mm" in words and f"{plate.mark}: edges, mm" in words
        assert f"net {plate.length:.1f} × {plate.width:.1f} mm, {plate.mass:.1f} kg" in words
    rows = [row for s in sheets for t in s.tables for row in t.rows if row[0] == "E-2"]
    wanted = ("0.0", "800.0", "", "", joint.mark.removeprefix("M1-"))
    assert rows[0][2:11] == (*wanted, "2.0", "30.0° × 18.0", "–", "0.0")
    for wanted in (
        *("gross 2600.5 × 810.5 mm, 333.3 kg", "quantity 1", "marking face: inside, up"),
        *("rolling direction along u", "E-2 bevel 30° outside", "before forming, its inner face"),
        *("contour of the widest outline", "radii and angles are of the finished plate"),
    ):
        assert wanted in words.replace("\n", " ").replace(" | ", " "), wanted


def test_third_angle_has_the_plan_above_the_elevation():
    for standard, first in (("ISO", "Elevation"), ("AWS", "Plan")):
        view = member_sheets(RECORD, SheetStyle(standard=standard))[0].views[0]
        assert view.name == first


def test_projection_symbols_show_the_small_end_the_right_way():
    """The circles are what is seen from the side they stand away from in first angle, and from
    their own side in third; both ends are seen, so it is the small end that is looked at."""
    for first_angle in (True, False):
        cone, circle = projection_symbol((0.0, 0.0), first_angle)[:2]
        points = np.array(cone.points[:4])
        small = points[np.argsort(np.abs(points[:, 1]))[:2], 0].mean()
        large = points[np.argsort(np.abs(points[:, 1]))[2:], 0].mean()
        beside = np.array(circle.points)[:, 0].mean()
        assert small < large
        assert (beside > large) == first_angle


def heights(lines, texts=()):
    """Lowest and highest ordinate of the lines of a groove, which are as high as one."""
    found = [np.array(line.points)[:, 1] for line in lines if line.style == "medium"]
    return [(y.min(), y.max()) for y in found if np.ptp(y) > 0.9 * GROOVE]


def symbol(words, style, thickness=20.0, place="shop", ndt=""):
    return weld_symbol(prep_of(words), thickness, place, ndt, (0.0, 0.0), style)


@pytest.mark.parametrize("standard", ["ISO", "AWS"])
def test_weld_symbols_stand_on_the_side_of_the_standard(standard):
    """The arrow's side: on the continuous line in ISO 2553, the other on the dashed one below it;
    below the line in AWS A2.4, the other above."""
    style, iso = SheetStyle(standard=standard), standard == "ISO"
    lines, texts = symbol("butt: v angle=60 land=2 gap=2 outer", style, place="field", ndt="UT")
    (low, high), *_ = heights([line for line in lines if len(line.points) == 3])
    assert (low, high) == ((0.0, GROOVE) if iso else (-GROOVE, 0.0))
    dashed = [line for line in lines if line.style == "dashed"]
    assert len(dashed) == iso and all(y < 0.0 for line in dashed for _, y in line.points)
    assert any(len(line.points) == 4 for line in lines)  # the field flag
    assert {text.text for text in texts} == {"60°", "2", "butt UT"}
    lines, _ = symbol("v angle=60 inner", style)
    (low, high), *_ = heights([line for line in lines if len(line.points) == 3])
    assert high < 0.0 if iso else low == 0.0
    assert not any(len(line.points) == 4 for line in lines)
    lines, _ = symbol("double-v angle=60", style)
    both = sorted(heights([line for line in lines if len(line.points) == 3]))
    assert both == [(-GROOVE, 0.0), (0.0, GROOVE)]
    assert not any(line.style == "dashed" for line in lines)


def test_the_upright_leg_of_a_bevel_is_on_the_left_whichever_way_the_line_runs():
    for leftward in (True, False):
        lines, _ = weld_symbol(CORNER, 20.0, "shop", "", (0.0, 0.0), SheetStyle(), leftward)
        legs = [np.array(line.points) for line in lines if len(line.points) == 2]
        upright = next(leg for leg in legs if leg[0, 0] == leg[1, 0])
        slope = next(leg for leg in legs if leg[0, 0] != leg[1, 0] and leg[0, 1] != leg[1, 1])
        assert upright[:, 0].max() <= slope[:, 0].min()


@pytest.mark.parametrize(
    ("words", "iso", "aws"),
    [
        ("bevel angle=45 land=6", "s14", "14"),  # a thick root face stays
        ("bevel angle=45 land=2 gap=2", None, None),  # melted through
        ("bevel angle=45 land=6 gap=6 backing=30x6", None, None),
        ("double-v angle=60 land=8", "s6", "6"),  # each side
        ("fillet leg=8", "z8", "8"),
        ("double-fillet leg=6", "z6", "6"),
        ("square gap=1", None, None),
    ],
)
def test_depth_of_penetration_stands_left_of_the_symbol(words, iso, aws):
    for style, wanted in ((SheetStyle(), iso), (SheetStyle(standard="AWS"), aws)):
        prep = prep_of(words)
        _, texts = symbol(words, style)
        sizes = [text for text in texts if text.anchor == "end"]
        sides = 2 if prep.type.startswith("double") else 1
        assert [text.text for text in sizes] == ([wanted] * sides if wanted else [])


def test_a_backing_bar_stands_opposite_the_groove():
    for style, sign in ((SheetStyle(), -1.0), (SheetStyle(standard="AWS"), 1.0)):
        lines, texts = symbol("v angle=45 gap=6 backing=30x6", style)
        box = [np.array(line.points) for line in lines if len(line.points) == 4]
        assert len(box) == 1 and sign * box[0][:, 1].mean() > 0.0
        assert ("M" in {text.text for text in texts}) == style.first_angle


def test_aws_breaks_the_arrow_to_the_one_plate_that_is_cut():
    ends = ((6.0, 0.0), (0.0, -4.0))
    assert len(weld_arrow(CORNER, *ends, SheetStyle(standard="AWS"))) == 3
    assert len(weld_arrow(BUTT, *ends, SheetStyle(standard="AWS"))) == 2
    assert len(weld_arrow(CORNER, *ends, SheetStyle())) == 2


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, '0"'),
        (0.5, '0"'),
        (25.4, '1"'),
        (25.4 / 16, '1/16"'),
        (304.8, "1'-0\""),
        (12 * 304.8 + 3.0625 * 25.4, "12'-3 1/16\""),
        (304.8 - 0.1, "1'-0\""),
        (-40.0, '-1 9/16"'),
        (7 * 304.8 + 0.25 * 25.4, "7'-0 1/4\""),
    ],
)
def test_feet_and_inches(value, text):
    assert feet_inches(value) == text


def test_feet_and_inches_are_within_a_thirtysecond():
    for value in np.linspace(3.0, 30000.0, 211):
        feet, _, inches = feet_inches(value).rstrip('"').rpartition("'-")
        parts = [eval(part) for part in inches.split()]
        assert abs((int(feet or 0) * 12 + sum(parts)) * 25.4 - value) <= 25.4 / 32 + 1e-9


def test_a_piece_has_its_own_drawing():
    half = 0.5 * RECORD.length
    plates = tuple(
        replace(plate, piece=1 + (plate.s_start > 0.4 * half)) for plate in RECORD.plates
    )
    pieces = tuple(
        PieceFigures(
            Piece(k, a, b), tuple(p.mark for p in plates if p.piece == k), 100.0 * k, np.zeros(3)
        )
        for k, a, b in ((1, 0.0, half), (2, half, RECORD.length))
    )
    record = replace(RECORD, plates=plates, pieces=pieces)
    contents = [sheet.title for sheet in member_sheets(record)]
    assert [t for t in contents if "overview" in t or "assembly" in t] == [
        "M1 overview",
        "M1 assembly P1",
        "M1 assembly P2",
    ]
    one = piece_record(record, pieces[0])
    assert {p.mark for p in one.plates} == set(pieces[0].marks) and one.mass == 100.0
    axis = one.wireframe["axis"]
    assert np.sqrt((np.diff(axis, axis=0) ** 2).sum(axis=1)).sum() == pytest.approx(half, rel=1e-3)
    drawn = [sheet for sheet in member_sheets(record) if sheet.title == "M1 assembly P2"]
    assert "M1-P2-S" in words_of(drawn)


def test_the_general_arrangement_lists_every_member():
    other = replace(strip_member("M2"), centre_of_gravity=np.zeros(3))
    wires = {key: line + (0.0, 9000.0, 0.0) for key, line in other.wireframe.items()}
    failed = replace(strip_member("M3"), plates=(), wireframe={})
    sheets = arrangement_sheets([RECORD, replace(other, wireframe=wires), failed], STYLES[1])
    rows = [row for table in sheets[0].tables for row in table.rows if table.header[0] == "member"]
    assert [row[0] for row in rows] == ["M1", "M2", "M3"]
    assert rows[1][-1] == "1000.000, 2000.000, 10.000" and rows[2][1] == "in error"
    words = words_of(sheets)
    assert words.count("M1") >= 3 and "N" in words and "1000.000" in words
    # North, the site's y, is along the model's x there: to the right.
    assert arrangement_sheets([failed], STYLES[1]) == ()


def test_every_label_has_its_chinese_term():
    said = set()
    for path in sorted((ROOT / "BendTorsionWB" / "core" / "drawings").glob("sheet*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                name = getattr(node.func, "attr", getattr(node.func, "id", ""))
                if name in ("say", "said", "headings") and node.args:
                    said |= {
                        part.value
                        for part in ast.walk(node.args[0])
                        if isinstance(part, ast.Constant) and isinstance(part.value, str)
                    }
    said |= set(INCH_HEADINGS.values())
    assert len(said) > 80
    assert said - set(CHINESE) == set()
    for english, chinese in CHINESE.items():
        assert english.count("{}") == chinese.count("{}")


def test_chinese_sheets_are_in_chinese_and_can_be_searched(tmp_path):
    style = SheetStyle("音乐厅", "", "A3", "ISO", "zh")
    sheets = member_sheets(RECORD, style)
    write_pdf(sheets, tmp_path / "M1.pdf")
    text = subprocess.run(
        ["pdftotext", "-raw", str(tmp_path / "M1.pdf"), "-"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout
    for wanted in ("音乐厅", "组装图", "板件展开", "截面与焊缝", "轧制方向沿", "净质量"):
        assert wanted in text
    fonts = subprocess.run(
        ["pdffonts", str(tmp_path / "M1.pdf")], capture_output=True, encoding="utf-8", check=True
    ).stdout
    assert "DejaVu" in fonts and len(fonts.splitlines()) > 3
    english = {"plates", "points", "projection", "assembly", "flat patterns", "edge", "panel"}
    assert english.isdisjoint(words_of(sheets))


def test_joined_pdfs_have_all_pages_in_order_and_all_text(tmp_path):
    parts = []
    for name, record in (("M1", RECORD), ("B7", strip_member("B7", (900.0, 700.0)))):
        write_pdf(member_sheets(record, SheetStyle(format="A4")), tmp_path / f"{name}.pdf")
        parts.append(tmp_path / f"{name}.pdf")
    whole = joined_pdf([part.read_bytes() for part in parts])
    assert whole == joined_pdf([part.read_bytes() for part in parts])
    (tmp_path / "set.pdf").write_bytes(whole)

    def read(*arguments):
        done = subprocess.run(arguments, capture_output=True, encoding="utf-8", check=True)
        assert done.stderr == ""
        return done.stdout

    counts = [int(re.search(r"Pages:\s+(\d+)", read("pdfinfo", str(p)))[1]) for p in parts]
    information = read("pdfinfo", str(tmp_path / "set.pdf"))
    assert f"Pages:           {sum(counts)}\n" in information and "(A4)" in information
    assert read("pdftotext", str(tmp_path / "set.pdf"), "-") == "".join(
        read("pdftotext", str(part), "-") for part in parts
    )
    with pytest.raises(ValueError, match="no pages"):
        joined_pdf([])


def test_each_format_has_its_template_with_fields_in_the_title_block():
    for name, form in FORMATS.items():
        sheet = member_sheets(RECORD, SheetStyle(format=name))[0]
        path = Path(template_path(sheet))
        assert path.read_text(encoding="utf-8") == template_svg(form)
        left, bottom, right, top = form.title_block
        places = re.findall(r'editable="\w+" x="([\d.]+)" y="([\d.]+)"', template_svg(form))
        assert len(places) == 5
        for x, y in places:
            assert left < float(x) < right and bottom < form.height - float(y) < top


def test_every_format_can_be_set_in_the_schedule():
    choices = SETTINGS["sheet_format"].parse.known
    assert choices == tuple(FORMATS)
