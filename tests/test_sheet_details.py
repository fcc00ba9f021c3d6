# SPDX-License-Identifier: LGPL-2.1-or-later
"""Weld maps, details of crowded patterns, warnings in Chinese: nothing is left out."""

import ast
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sheet_checks import faults
from test_sheet import strip_member, strip_plate
from test_sheet_style import RECORD, words_of

from BendTorsionWB.core.drawings import sheet_pattern, sheet_plate
from BendTorsionWB.core.drawings.sheet import text_width, wrapped
from BendTorsionWB.core.drawings.sheet_detail import detail_blocks
from BendTorsionWB.core.drawings.sheet_findings import finding_text
from BendTorsionWB.core.drawings.sheet_layout import member_sheets, piece_record
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.drawings.sheet_terms import CHINESE
from BendTorsionWB.core.drawings.sheet_weld import kind_letters, weld_kind
from BendTorsionWB.core.drawings.sheet_weld_map import LABEL_SPACING, weld_map_blocks
from BendTorsionWB.core.finding import warning
from BendTorsionWB.core.finding_language import in_chinese
from BendTorsionWB.core.welds.bevel_record import EdgeBevel
from BendTorsionWB.core.welds.preps import prep_of

ROOT = Path(__file__).resolve().parent.parent
STYLE = SheetStyle()


def named(blocks):
    return Counter(text.text.split("  ")[0] for block in blocks for text in block.texts)


@pytest.mark.parametrize("size", [(380.0, 230.0), (170.0, 230.0), (380.0, 60.0)])
def test_the_weld_map_names_every_weld_once_with_the_letter_of_its_symbol(size):
    letters = kind_letters(RECORD.welds)
    blocks = weld_map_blocks(RECORD, letters, size, STYLE)
    texts = named(blocks)
    for weld in RECORD.welds:
        assert texts[f"{weld.mark.split('-')[-1]} {letters[weld_kind(weld)]}"] == 1
    for block in blocks:
        assert block.size[0] <= size[0] and (len(blocks) == 1 or block.size[1] <= size[1])
    flags = [line for block in blocks for line in block.lines if len(line.points) == 4]
    assert len(flags) == sum(weld.place == "field" for weld in RECORD.welds) > 0


def test_a_map_with_more_welds_than_it_is_wide_goes_on_in_strips():
    seam = RECORD.welds[0]
    count, length = 200, 5500.0
    cuts = np.linspace(0.0, length, count + 1)
    welds = tuple(
        replace(seam, mark=f"M1-TL-T{k}/L{k}", start=cuts[k], end=cuts[k + 1]) for k in range(count)
    )
    record = replace(RECORD, welds=welds)
    blocks = weld_map_blocks(record, kind_letters(welds), (300.0, 230.0), STYLE)
    assert len(blocks) >= count * LABEL_SPACING / 300.0
    texts = named(blocks)
    assert all(texts[f"T{k}/L{k} A"] == 1 for k in range(count))


def test_the_list_of_welds_has_depths_and_bars_and_the_total_length():
    bar = prep_of("bar: v angle=45 gap=6 backing=30x6")
    welds = (replace(RECORD.welds[0], prep=bar), *RECORD.welds[1:])
    sheets = member_sheets(replace(RECORD, welds=welds))
    rows = {
        row[0]: dict(zip(table.header, row, strict=True))
        for sheet in sheets
        for table in sheet.tables
        if "cut / on" in table.header
        for row in table.rows
    }
    assert rows[welds[0].mark]["backing"] == "30x6" and rows[welds[0].mark]["depth"] == "20.0"
    assert rows[welds[1].mark]["depth"] == "14.0"
    assert float(rows["total"]["length"]) == pytest.approx(sum(w.length for w in welds), abs=0.05)
    words = words_of(sheets)
    assert "Backing bars (not in the mass of the member)" in words and "M1-K1" in words


def test_details_name_every_point_a_long_plate_has_no_room_for():
    plate = strip_plate("M1-T1", "top", 24000.0, 800.0, radius=60000.0)
    sheets = member_sheets(replace(strip_member(), plates=(plate,)))
    whole = [sheet for sheet in sheets if sheet.title == "M1 flat patterns"]
    parts = [sheet for sheet in sheets if sheet.title == "M1 flat patterns: details"]
    # By the numbers of the sheets with its details and tables.
    numbers = {sheet.number for sheet in parts}
    numbers |= {s.number for s in sheets if any(t.text.startswith("M1-T1:") for t in s.texts)}
    told = re.search(r"(?:details on|see) sheet ([0-9–, ]+)", " ".join(words_of(whole)))[1]
    spans = [list(map(int, run.split("–"))) for run in re.split(", *", told.strip()) if run]
    assert {n for span in spans for n in range(span[0], span[-1] + 1)} == numbers
    drawn = set(words_of(parts))
    labels = {point.label for point in plate.points if point.kind == "arris"}
    assert labels | {line.label for line in plate.lines} <= drawn
    assert not any("left out" in word for word in drawn)
    assert [fault for sheet in sheets for fault in faults(sheet)] == []
    # Each stretch of the outline is drawn where it lies, and none twice but at the cuts.
    length = sum(
        np.hypot(*np.diff(line.points, axis=0).T).sum()
        for sheet in parts
        for view in sheet.views
        for line in view.polylines
        if line.style == "wide"
    )
    outline = sum(np.hypot(*np.diff(run, axis=0).T).sum() for run in plate.outline)
    assert length == pytest.approx(outline, rel=1e-3)


def test_a_plate_with_room_for_its_labels_has_no_details():
    plate = strip_plate()
    assert sheet_pattern.pattern_block(plate, 15).left_out == 0
    assert detail_blocks([], 15, (380.0, 230.0), STYLE) == {}
    titles = {sheet.title for sheet in member_sheets(strip_member(lengths=(4000.0, 5200.0)))}
    assert "M1 flat patterns: details" not in titles


def told_places():
    """The places that warnings and notes name, a figure for each value in them."""
    for path in sorted((ROOT / "BendTorsionWB" / "core").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            texts = []
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("warning", "note"):
                texts = [word.value for word in node.keywords if word.arg == "position"]
            if isinstance(node, ast.FunctionDef) and node.name in ("_place", "place"):
                texts = [one.value for one in ast.walk(node) if isinstance(one, ast.Return)]
            for text in texts:
                parts = text.values if isinstance(text, ast.JoinedStr) else []
                if parts:
                    yield "".join(
                        part.value if isinstance(part, ast.Constant) else "3" for part in parts
                    )


def test_places_of_warnings_in_chinese_hold_no_english_word():
    places = {
        *("s = 2573 mm of M1", "NS, bottom and top of S1, s = 2573 mm", "face top, s = 5 mm"),
        *("end E-2, 0 to 376 mm along it", "first TL, 10 to 90 mm on the axis"),
        *("at x, y, z = 1, 2, 3 mm", "s = 5 to 90 mm"),
    }
    named = set(told_places())
    assert len(named) > 12
    told = {one: in_chinese(one) for one in named | places}
    left = {one: re.findall("[a-z]{2,}", text.replace("mm", "")) for one, text in told.items()}
    assert {one: words for one, words in left.items() if words} == {}
    assert told["NS, bottom and top of S1, s = 2573 mm"] == "NS, S1 的 下 与 上, s = 2573 mm"
    assert told["end E-2, 0 to 376 mm along it"] == "终端 E-2, 沿边 0 至 376 mm"


def test_the_joint_too_close_to_a_node_tells_its_face_in_chinese():
    found = warning(
        *("joint-beside-node", "M1", "a joint of face top is too close to a node"),
        *("move the joint farther from the node",),
        **{"position": "s = 3200 mm", "value": 470.532, "limit": 600.0, "unit": "mm"},
    )
    text = finding_text(found, SheetStyle(language="zh"))
    place, told = text.split("：", 1)
    assert place == "M1，s = 3200 mm" and "面上的拼接缝离节点过近" in told
    assert "（实际 470.532 mm，限值 600 mm）。请将拼接缝移远离节点" in told
    beyond = warning("bevel-beyond-head", "X1-L1", "", value=74.0, limit=52.0, unit="deg")
    assert finding_text(beyond, SheetStyle(language="zh")).endswith("（实际 74 °，限值 52 °）")


def test_the_shape_of_an_opening_is_told_in_chinese():
    chinese = SheetStyle(language="zh")
    assert chinese.shape("manhole D210") == "人孔 D210"
    assert chinese.shape("slot 120x40") == "长圆孔 120x40"
    assert STYLE.shape("manhole D210") == "manhole D210"


def test_a_warning_in_chinese_keeps_its_object_place_and_figures():
    found = warning(
        "joints-not-staggered",
        "M1",
        "joints of faces bottom and left are too close",
        "move one of them",
        position="s = 7600 mm",
        value=50.2,
        limit=200.0,
        unit="mm",
    )
    text = finding_text(found, SheetStyle(language="zh"))
    assert all(word in text for word in ("M1", "s = 7600 mm", "下", "左", "50.2", "200"))
    assert not re.search("[a-z]{3,}", text)
    assert finding_text(found, STYLE) == found.line().removeprefix("warning: ")


def test_words_chosen_by_a_value_have_their_chinese_terms():
    words = {
        *sheet_pattern.FORMING_RULES.values(),
        *sheet_plate.SURFACES.values(),
        *sheet_plate.CONTOURS.values(),
    }
    assert words - set(CHINESE) == set()


def test_corner_lines_of_a_stepped_piece_end_where_the_longer_of_their_faces_does(delivered):
    first, second, _ = delivered.record.pieces
    assert dict(first.piece.end_offsets) == {"top": 80.0, "bottom": -80.0, "right": 40.0}
    ends = {"TL": 80.0, "TR": 80.0, "BR": 40.0, "BL": 0.0, "axis": 0.0}
    before, after = (piece_record(delivered.record, one).wireframe for one in (first, second))
    for name, step in ends.items():
        assert before[name][-1, 0] == pytest.approx(first.piece.end + step)
    starts = {"TL": 0.0, "TR": 40.0, "BR": -80.0, "BL": -80.0}
    for name, step in starts.items():
        assert after[name][0, 0] == pytest.approx(second.piece.start + step, abs=0.1)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_welds_with_backing_tests_and_a_preparation_written_out_stay_on_a_small_page(language):
    inline = prep_of("bevel angle=40 land=6 gap=2 inner backing=30x6")
    named = prep_of("thick seam with a long name of the workshop: v angle=45 gap=6 backing=30x6")
    tests = ("UT 100 % ISO 17640 level B", "MT 20 %", "")
    welds = tuple(
        replace(weld, prep=(inline, named, weld.prep)[k % 3], ndt=tests[k % 3], place="field")
        for k, weld in enumerate(RECORD.welds)
    )
    record = replace(RECORD, welds=welds)
    style = SheetStyle(format="A4", language=language)
    sheets = [s for s in member_sheets(record, style) if s.number > 1]
    assert [fault for sheet in sheets for fault in faults(sheet)] == []
    say = style.say
    cells = {}
    for sheet in sheets:
        for table in sheet.tables:
            if say("symbol") in table.header:
                for row in table.rows:
                    known = dict(zip(table.header, row, strict=True))
                    cells.setdefault(known[say("symbol")], {}).update(known)
    for weld in welds:
        own = cells[kind_letters(welds)[weld_kind(weld)]]
        assert own[say("NDT")] == (weld.ndt or "–")
        assert own[say("backing")] == ("30x6" if weld.prep.backing else "–")
    words = words_of(sheets)
    # What a preparation's type and sizes say its symbol shows.
    assert not any("angle=" in word or "land=" in word for word in words)
    if language == "zh":
        assert not {"corner", "butt"} & {part for word in words for part in word.split()}


def test_rows_of_edges_tell_where_their_stretch_lies_on_the_pattern(delivered):
    """A straight box: u runs with s, and stretches follow one another along the edge."""
    plate = next(p for p in delivered.record.plates if p.mark == "M1-T2")
    edge = plate.edges[0].edge
    half = 0.5 * (plate.s_start + plate.s_end)
    spans = ((plate.s_start, half), (half, plate.s_end))
    sides = tuple(EdgeBevel("first", edge, "", "", *span, 0.1 * k) for k, span in enumerate(spans))
    record = replace(delivered.record, plates=(replace(plate, bevels=sides),), pieces=(), beds=())
    rows = [
        dict(zip(table.header, row, strict=True))
        for sheet in member_sheets(record)
        for table in sheet.tables
        if "u from" in table.header
        for row in table.rows
        if row[0] == edge
    ]
    assert len(rows) == 2
    points = [p for p in plate.points if p.kind == "arris" and p.edge == edge]
    for row, (start, end) in zip(rows, spans, strict=True):
        for name, at in (("from", start), ("to", end)):
            assert float(row[f"s {name}"]) == pytest.approx(at, abs=0.06)
            wanted = points[0].flat[0] + at - points[0].s
            assert float(row[f"u {name}"]) == pytest.approx(wanted, abs=0.11)


@pytest.mark.parametrize("width", [20.0, 40.0, 60.0])
def test_chinese_is_wrapped_between_characters_but_not_before_closing_marks(width):
    text = "展开图为成形前净尺寸，按中面展开，自划线面看。u 向右、v 向上，L：测站线；x, y, z 12。"
    lines = wrapped(text, 1.8, width)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert all(text_width(line, 1.8) <= width for line in lines)
    # No line but the last has room for two characters more.
    assert all(text_width(line, 1.8) > width - 4 * 1.8 for line in lines[:-1] if "z" not in line)
    assert not any(line[0] in "，。；：、" for line in lines)
    assert wrapped("one two  three", 1.8, 1e3) == ["one two three"]
