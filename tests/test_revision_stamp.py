# SPDX-License-Identifier: LGPL-2.1-or-later
"""The revision in files that are issued: read back by other programs, and nothing else changed."""

import io
import re
import subprocess
from pathlib import Path

import ezdxf
import pytest
from flat_plates import member, rectangle

from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.revision_stamp import stamped
from BendTorsionWB.sheets.pdf import write_pdf


@pytest.fixture(scope="module")
def sheets(tmp_path_factory):
    """(content of a PDF of all sheets of a member, how many)"""
    pages = member_sheets(member("M1", (rectangle("M1-T1"), rectangle("M1-T2", length=3000.0))))
    path = tmp_path_factory.mktemp("sheets") / "M1.pdf"
    write_pdf(pages, path)
    return path.read_bytes(), len(pages)


def words(content: bytes, folder: Path) -> list[list[tuple[float, float, str]]]:
    """Left and lower edge, points from the upper left, and text of the words of each page."""
    path = folder / "read.pdf"
    path.write_bytes(content)
    told = subprocess.run(
        ["pdftotext", "-bbox", path, "-"], capture_output=True, encoding="utf-8", check=True
    ).stdout
    assert not told.startswith("Syntax")
    word = re.compile(r'<word xMin="([\d.]+)" .*?yMax="([\d.]+)">(.*?)</word>')
    return [
        [(float(x), float(y), text) for x, y, text in word.findall(page)]
        for page in told.split("<page ")[1:]
    ]


def test_every_sheet_has_the_revision_in_its_box_and_all_it_had(sheets, tmp_path):
    content, count = sheets
    before = words(content, tmp_path)
    after = words(stamped("sheets/M1.pdf", content, "P02"), tmp_path)
    assert len(after) == len(before) == count
    for was, now in zip(before, after, strict=True):
        (own,) = (word for word in now if word[2] == "P02")
        (label,) = (word for word in was if word[2] == "revision")
        assert sorted(now) == sorted([*was, own])
        # Under the label, left of nothing else in the box.
        assert abs(own[0] - label[0]) < 1.0 and 5.0 < own[1] - label[1] < 20.0


def test_what_was_painted_is_there_to_the_byte(sheets):
    content, _ = sheets
    assert stamped("sheets/M1.pdf", content, "B").startswith(content)


def test_a_drawing_exchange_file_says_its_revision_in_a_comment():
    stream = io.StringIO()
    drawing = ezdxf.new("R2000")
    drawing.modelspace().add_line((0, 0), (100, 0))
    drawing.write(stream)
    text = stamped("plates/M1-T1.dxf", stream.getvalue().encode(), "B").decode()
    assert text.splitlines()[:2] == ["999", "revision B"]
    (line,) = ezdxf.read(io.StringIO(text)).modelspace()
    assert line.dxf.end.x == 100


def test_a_cut_file_says_its_revision_in_a_comment():
    assert stamped("nc1/M1-T1.nc1", b"ST\n  Hall\nEN\n", "B") == b"ST\n** revision B\n  Hall\nEN\n"


@pytest.mark.parametrize("name", ["results.xlsx", "model.step", "drawings/other.pdf"])
def test_other_files_stay_as_they_were(name):
    assert stamped(name, b"anything", "B") == b"anything"


def test_a_file_that_is_no_pdf_of_sheets_is_refused():
    with pytest.raises(BendTorsionError) as problem:
        stamped("sheets/M1.pdf", b"%PDF-1.4\n%%EOF\n", "B")
    assert [finding.code for finding in problem.value.findings] == ["sheet-foreign"]
