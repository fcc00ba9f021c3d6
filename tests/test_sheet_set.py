# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets of a whole project as a build writes them: arrangement, one set, SVG on request."""

import re
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest
from test_build_folder import HALL

from BendTorsionWB.__main__ import main


def pages(path) -> int:
    done = subprocess.run(["pdfinfo", str(path)], capture_output=True, encoding="utf-8", check=True)
    assert done.stderr == ""
    return int(re.search(r"Pages:\s+(\d+)", done.stdout)[1])


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    out = tmp_path_factory.mktemp("set") / "out"
    words = ["build", str(HALL), "--out", str(out), "--only", "M7,M16", "--no-model", "--jobs", "1"]
    assert main([*words, "--svg", "--quiet"]) == 0
    return out


def test_the_set_has_the_arrangement_first_and_every_page(out):
    sheets = out / "sheets"
    parts = [sheets / name for name in ("general_arrangement.pdf", "M7.pdf", "M16.pdf")]
    assert pages(sheets / "set.pdf") == sum(map(pages, parts))
    first = subprocess.run(
        ["pdftotext", "-l", "1", str(sheets / "set.pdf"), "-"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout
    assert "general arrangement" in first and "M7" in first and "M16" in first


def test_every_sheet_is_there_as_svg(out):
    sheets = out / "sheets"
    for name in ("general_arrangement", "M7", "M16"):
        drawn = sorted(sheets.glob(f"{name}-*.svg"))
        assert len(drawn) == pages(sheets / f"{name}.pdf")
        for path in drawn:
            assert ElementTree.parse(path).getroot().get("width") == "420mm"


def test_a_second_build_leaves_the_sheets_and_takes_the_svg_away(out):
    sheets = out / "sheets"
    before = {path: path.stat().st_mtime_ns for path in sheets.glob("*.pdf")}
    words = ["build", str(HALL), "--out", str(out), "--only", "M7,M16", "--no-model", "--jobs", "1"]
    assert main([*words, "--quiet"]) == 0
    assert {path: path.stat().st_mtime_ns for path in sheets.glob("*.pdf")} == before
    assert list(sheets.glob("*.svg")) == []
