# SPDX-License-Identifier: LGPL-2.1-or-later
"""The HTML report: well formed, self-contained, safe from what names hold, worst first."""

import re
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

import numpy as np
import pytest
from flat_plates import annular_sector, member, rectangle

from BendTorsionWB.core.error_sources import error_sources
from BendTorsionWB.core.finding import error, warning
from BendTorsionWB.exchange import folder_guide
from BendTorsionWB.exchange.html_report import Picture, html_report, write_html_report
from BendTorsionWB.exchange.model_picture import model_svg
from BendTorsionWB.exchange.patterns_picture import patterns_svg

VOID = {"meta", "br", "img"}


class Reader(HTMLParser):
    """Checks nesting; keeps tables as rows of texts and every attribute."""

    def __init__(self):
        super().__init__()
        self.open, self.tables, self.attributes, self.headings = [], [], [], []

    def handle_starttag(self, tag, attrs):
        self.attributes += [value or "" for name, value in attrs if name != "xmlns"]
        if tag not in VOID:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if {"td", "th"} & set(self.open):
            self.tables[-1][-1][-1] += data
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


def box_lines(shift=0.0, count=5):
    """The wireframe of a straight box 4 m long, every place held from both sides."""
    s = np.repeat(np.linspace(0.0, 4000.0, count), 2)
    frame = {
        name: np.column_stack([s, np.full(len(s), y + shift), np.full(len(s), z)])
        for name, y, z in (
            ("TL", 400, 400),
            ("TR", -400, 400),
            ("BR", -400, -400),
            ("BL", 400, -400),
        )
    }
    return frame | {"axis": np.column_stack([s[::2], np.full(count, shift), np.zeros(count)])}


def records():
    good = member("M1", (rectangle(), annular_sector()), wireframe=box_lines())
    over = member("M2", (rectangle("M2-T1", length_error_max=0.5),), wireframe=box_lines(3000.0))
    failed = member("M3", (), length=None, mass=None, findings=(error("x", "M3", "does not fit"),))
    return [good, over, failed]


def read(text):
    reader = Reader()
    reader.feed(text)
    reader.close()
    assert reader.open == []
    return reader


def test_the_page_stands_alone_and_is_well_formed():
    text = html_report(records(), (), "Hall", "1.0", [Picture("all", model_svg(records()))])
    reader = read(text)
    assert reader.headings[0] == "Figures against limits"
    assert not [value for value in reader.attributes if re.search(r"https?:|//", value)]
    assert "<script" not in text and "@import" not in text and "url(" not in text


def test_figures_beyond_their_limit_and_members_in_error_are_told():
    text = html_report(records(), (), "Hall", "1.0")
    rows = {row[0]: row for row in read(text).tables[0]}
    assert [rows[name][-1] for name in ("M1", "M2", "M3")] == ["ok", "over", "FAIL"]
    # Its length error; the factor over the bound is told in a note.
    assert text.count('class="n over"') == 1


def test_what_names_and_messages_hold_is_text_only():
    nasty = '<script>alert("x")</script>&'
    found = warning("code", nasty, nasty, nasty)
    text = html_report(records(), (found,), nasty, "1.0", [Picture(nasty, "")])
    assert "<script" not in text
    assert any(nasty in cell for row in read(text).tables[1] for cell in row)


def test_error_sources_are_ranked_and_computed_from_the_figures():
    found = error_sources(records(), {"M1": 4.0, "M2": 9.5})
    sizes = [source.size for source in found]
    assert sizes == sorted(sizes, reverse=True)
    by_name = {source.name: source for source in found}
    assert by_name["axis between the given points"].where == "M2"
    assert by_name["flat pattern"].size == 0.5 and by_name["flat pattern"].where == "M2-T1"
    torsion = by_name["torsion"]
    worst = max(r.torsion_error_max or 0.0 for r in records())
    assert torsion.size == pytest.approx(worst * np.hypot(400.0, 400.0))
    text = html_report(records(), (), "Hall", "1.0", sources=found)
    assert [row[0] for row in read(text).tables[1]][1:] == [source.name for source in found]


def test_the_picture_shows_every_face_once_and_the_nearest_last():
    svg = model_svg(records())
    root = ElementTree.fromstring(svg)
    shapes = [child for child in root if child.tag.endswith("polygon")]
    assert len(shapes) == 2 * 4 * 4
    wide, tall = (float(value) for value in root.get("viewBox").split()[2:])
    points = np.array([pair.split(",") for shape in shapes for pair in shape.get("points").split()])
    points = points.astype(float)
    assert points.min() >= 0.0 and (points.max(axis=0) <= [wide, tall]).all()
    # From straight above, the four faces drawn last are the top, seen in full breadth.
    above = ElementTree.fromstring(model_svg(records()[:1], height=90.0))
    areas = [area(shape) for shape in above if shape.tag.endswith("polygon")]
    assert len(areas) == 16 and min(areas[-4:]) > 100.0
    assert sum(one < 1.0 for one in areas) == 8
    assert model_svg([]) == ""
    assert [text.text for text in root if text.tag.endswith("text")] == ["M1", "M2"]


def test_every_pattern_is_shown_once_to_one_scale_in_the_colour_of_its_strain():
    low, high = rectangle("M1-T1", strain_max=0.0), rectangle("M1-T2", strain_max=2e-4)
    wide = annular_sector("M1-L1", strain_max=1e-4)
    root = ElementTree.fromstring(patterns_svg(member("M1", (low, high, wide)), 2e-4))
    shapes = [shape for shape in root.iter() if shape.tag.endswith("polygon")]
    assert [shape.get("fill") for shape in shapes[:2]] == ["#4a7ac2", "#fee838"]
    assert len({shape.get("fill") for shape in shapes}) == 3
    scale = np.sqrt(area(shapes[0]) / low.area)
    assert np.sqrt(area(shapes[2]) / wide.area) == pytest.approx(scale, rel=0.01)
    texts = [text.text for text in root.iter() if text.tag.endswith("text")]
    assert {"M1-T1", "M1-T2", "M1-L1", "top", "200.0 µm/m"} <= set(texts)
    frame = float(root.get("viewBox").split()[2])
    ends = [float(pair.split(",")[0]) for shape in shapes for pair in shape.get("points").split()]
    assert 0.0 < min(ends) and max(ends) < frame
    assert patterns_svg(member("M1", ()), 1.0) == ""


def test_lists_of_the_page_are_those_of_the_tables_and_files_are_links():
    files = [("sheets/set.pdf", "drawings"), ("plates/<mark>.dxf", "patterns")]
    text = html_report(records(), (), "Hall", "1.0", files=files)
    reader = read(text)
    [head, *totals] = [table for table in reader.tables if table[0][0] == "t"][0]
    plates = [plate for record in records() for plate in record.plates]
    assert sum(float(row[3]) for row in totals) == len(plates)
    assert sum(float(row[5]) for row in totals) == pytest.approx(
        sum(p.mass for p in plates), abs=0.1 * len(totals)
    )
    assert "sheets/set.pdf" in reader.attributes and "plates/<mark>.dxf" not in reader.attributes
    assert [row[0] for row in reader.tables[-1][1:]] == [name for name, _ in files]
    assert head[1] == "grade"


def test_the_guide_names_what_is_there_and_nothing_else():
    names = {"plates/M1-T1.dxf", "plates/all/20mm S355.dxf", "sheets/M1.pdf", "sheets/set.pdf"}
    listed = dict(folder_guide.rows(names))
    assert {"plates/<mark>.dxf", "plates/all/<thickness> <grade>.dxf"} <= set(listed)
    assert not {"model.ifc", "sheets/nodes.pdf", "nc1/<mark>.nc1"} & set(listed)
    # What stands by itself is no example of a kind.
    assert "sheets/<member>.pdf" not in dict(folder_guide.rows({"sheets/set.pdf"}))
    text = folder_guide.readme("Hall", "1.0", list(listed.items()))
    assert text.startswith("Fabrication package Hall") and "CUT_OUTER" in text
    assert max(map(len, text.splitlines())) <= 110
    assert "NOT in this package" not in text


def test_the_guide_names_what_the_package_is_without():
    """Members in error, and those findings tell of that no file holds; each once."""
    told = warning("member-without-patterns", "M8", "has no plates, so that it is in no file")
    other = warning("member-over", "M7", "is over a limit")
    missing = folder_guide.left_out(records(), [told, told, other])
    assert missing == [
        "M3: in error, see report.html",
        "M8: has no plates, so that it is in no file",
    ]
    text = folder_guide.readme("Hall", "1.0", [("report.html", "start here")], missing)
    assert all(f"  {line}\n" in text for line in missing)
    long = folder_guide.readme(
        "Hall", "1.0", [("report.html", "start here")], ["M9: " + 40 * "so "]
    )
    assert max(map(len, long.splitlines())) <= 110


def area(shape):
    x, y = np.array([p.split(",") for p in shape.get("points").split()], float).T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2.0


def test_the_file_appears_whole(tmp_path):
    path = tmp_path / "report.html"
    write_html_report(path, records(), (), "Hall", "1.0")
    assert read(path.read_text(encoding="utf-8")).tables
