# SPDX-License-Identifier: LGPL-2.1-or-later
"""PDF and SVG sheets, read back by poppler and by an XML parser."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from test_sheet import strip_member

from BendTorsionWB.core.drawings.sheet import WIDTH_MARGIN, Polyline, Sheet, Text, text_width
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.sheets.pdf import write_pdf
from BendTorsionWB.sheets.svg import sized_anew, svg_document, svg_text, write_svg
from BendTorsionWB.sheets.techdraw import symbol_svg

RECORD = strip_member(lengths=(2500.0, 3000.0))


def poppler(*arguments):
    done = subprocess.run(arguments, capture_output=True, encoding="utf-8", check=True)
    return done.stdout


def test_pdf_has_a_page_per_sheet_and_searchable_text(tmp_path):
    sheets = member_sheets(RECORD, SheetStyle("Concert hall"))
    write_pdf(sheets, tmp_path / "M1.pdf")
    information = poppler("pdfinfo", str(tmp_path / "M1.pdf"))
    assert re.search(rf"Pages:\s+{len(sheets)}\n", information)
    assert "(A3)" in information
    for sheet in sheets:
        page = str(sheet.number)
        text = poppler("pdftotext", "-raw", "-f", page, "-l", page, str(tmp_path / "M1.pdf"), "-")
        found = "".join(text.split())
        for wanted in sheet.all_texts():
            if wanted.angle == 0.0:
                assert "".join(wanted.text.split()) in found


def test_pdf_is_to_scale(tmp_path):
    cross = (
        Polyline(((20.0, 100.0), (120.0, 100.0)), "wide"),
        Polyline(((30.0, 50.0), (30.0, 250.0)), "medium"),
    )
    text = Text(200.0, 100.0, 10.0, "HHHH")
    sheet = Sheet("scale", 1, 1, 420.0, 297.0, (10, 10, 410, 287), lines=cross, texts=(text,))
    write_pdf([sheet], tmp_path / "scale.pdf")
    poppler("pdftoppm", "-r", "508", "-gray", str(tmp_path / "scale.pdf"), str(tmp_path / "s"))
    import numpy as np

    (file,) = tmp_path.glob("s*.pgm")
    data = file.read_bytes()
    header = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", data)
    width, height = int(header[1]), int(header[2])
    black = np.frombuffer(data[header.end() :], np.uint8).reshape(height, width) < 128

    def extent(rows, columns, axis):
        hits = np.flatnonzero(black[rows, columns].any(axis=axis))
        return (hits[-1] - hits[0] + 1) / 20.0

    row = black[:, 60 * 20]  # a column of pixels at x = 60 mm meets the level line only
    assert np.flatnonzero(row).mean() / 20.0 == pytest.approx(297.0 - 100.0, abs=0.1)
    level = slice(int(196.9 * 20), int(197.1 * 20))
    assert extent(level, slice(0, 150 * 20), 0) == pytest.approx(100.5, abs=0.1)
    upright = slice(int(29.95 * 20), int(30.05 * 20))
    assert extent(slice(0, height), upright, 1) == pytest.approx(200.35, abs=0.1)
    assert row.sum() / 20.0 == pytest.approx(0.5, abs=0.1)
    capitals = slice(195 * 20, 300 * 20)
    assert extent(slice(0, height), capitals, 1) == pytest.approx(10.0, abs=0.15)


def test_same_sheets_give_the_same_bytes_in_another_process_and_time_zone(tmp_path):
    write_pdf(member_sheets(RECORD), tmp_path / "a.pdf")
    script = (
        "import sys; sys.path[:0] = sys.argv[2:]\n"
        "from test_sheet_files import *\n"
        "write_pdf(member_sheets(RECORD), sys.argv[1])\n"
    )
    here = Path(__file__).resolve().parent
    subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "b.pdf"), str(here.parent), str(here)],
        check=True,
        env={**os.environ, "TZ": "Asia/Shanghai", "PYTHONHASHSEED": "7"},
        capture_output=True,
    )
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.pdf", "b.pdf"]


def test_a_symbol_of_another_qt_gets_the_size_of_this_one():
    (sheet, *_) = member_sheets(RECORD)
    pixels = svg_document(sheet, [], sheet.all_texts(), "", 96.0 / 25.4)
    millimetres = svg_document(sheet, [], sheet.all_texts(), "mm")
    assert pixels != millimetres == sized_anew(pixels, "mm")
    assert sized_anew(millimetres, "", 96.0 / 25.4) == pixels


def test_a_failed_pdf_leaves_the_old_file_and_no_other(tmp_path):
    target = tmp_path / "M1.pdf"
    target.write_bytes(b"old")
    broken = Sheet(
        "broken",
        1,
        1,
        420.0,
        297.0,
        (10, 10, 410, 287),
        lines=(Polyline(((0.0, 0.0), (1.0, 1.0)), "no such style"),),
    )
    with pytest.raises(KeyError):
        write_pdf([broken], target)
    assert target.read_bytes() == b"old"
    assert [path.name for path in tmp_path.iterdir()] == ["M1.pdf"]


def test_svg_holds_every_text_and_line_in_millimetres(tmp_path):
    sheet = member_sheets(RECORD, SheetStyle("Hall & <garden>"))[1]
    write_svg(sheet, tmp_path / "M1-2.svg")
    root = ElementTree.parse(tmp_path / "M1-2.svg").getroot()
    name = "{http://www.w3.org/2000/svg}"
    assert (root.get("width"), root.get("height")) == ("420mm", "297mm")
    assert root.get("viewBox") == "0 0 420 297"
    texts = [element.text for element in root.iter(f"{name}text")]
    assert texts == [text.text for text in sheet.all_texts()]
    assert "Hall & <garden>" in texts
    lines = list(root.iter(f"{name}polyline"))
    drawn = [line for view in sheet.views for line in view.on_page()]
    assert len(lines) == len(drawn) + len(sheet.all_lines())
    first = [tuple(map(float, pair.split(","))) for pair in lines[0].get("points").split()]
    for (x, y), (u, v) in zip(first, drawn[0].points, strict=True):
        assert (x, 297.0 - y) == pytest.approx((u, v), abs=1e-4)
    assert svg_text(sheet) == (tmp_path / "M1-2.svg").read_text(encoding="utf-8")


def test_long_lines_on_a_page_of_the_document_stand_in_parts_each_in_its_place():
    """A reader whose letters drift starts anew with each part; together they are the line."""
    words = "Views show plates by the edges of their outer faces; broken: diaphragms; wide: cuts"
    long, short = Text(20.0, 40.0, 2.0, words), Text(20.0, 50.0, 2.0, "short")
    turned = Text(20.0, 60.0, 2.0, words, 90.0)
    frame = (20.0, 10.0, 410.0, 287.0)
    sheet = Sheet("page", 1, 1, 420.0, 297.0, frame, texts=(long, short, turned))
    root = ElementTree.fromstring(symbol_svg(sheet, alone=True))
    found = list(root.iter("{http://www.w3.org/2000/svg}text"))
    assert [text.text for text in found[-2:]] == ["short", words]
    parts = found[:-2]
    assert len(parts) > 1
    assert " ".join(part.text for part in parts) == words
    for k, part in enumerate(parts):
        before = "".join(f"{one.text} " for one in parts[:k])
        width = text_width(before, 2.0) / WIDTH_MARGIN
        # Letters of a symbol are in hundredths of a mm.
        assert float(part.get("x")) / 100.0 == pytest.approx(20.0 + width, abs=1e-3)
