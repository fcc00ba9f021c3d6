# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small schedules for tests: a good one, with cells changed, and what reading them finds."""

import copy

import openpyxl
import pytest

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.schedule import read_schedule

GOOD = {
    "Settings": [["key", "value"], ["station_spacing", 400], ["default_slope", 4]],
    "Materials": [["material", "density", "E", "fy"], ["Q355", 7850, 206000, 355]],
    "Surfaces": [["surface", "kind", "parameters"], ["Hall", "sphere", "r=20000"]],
    "Points": [
        ["axis", "no", "x", "y", "z"],
        ["A1", 1, 20000, 0, 0],
        ["A1", 2, 0, 20000, 0],
        ["A1", 3, -20000, 0, 0],
    ],
    "Axes": [["axis", "surface"], ["A1", "Hall"]],
    "Sections": [
        ["section", "type", "h", "b", "t", "gap1", "gap2", "t_top", "t_web", "material"],
        ["S1", "box1", 800, 800, 20, None, None, None, None, None],
        ["S2", "box1", 600, 500, 16, 2, 3, 18, None, "Q355"],
        ["S3", "box2", 600, 600, 16, None, None, None, None, None],
    ],
    "Members": [
        ["member", "segment", "axis", "section", "cut", "slope", "align", "align_to", "roll"],
        ["M1", 1, "A1", "S1", None, None, None, None, 90],
        ["M1", 2, None, "S2", 4000, 0, "top-left", "previous", None],
        ["M1", 3, "A1", "S1", "75%", None, None, None, None],
    ],
    "Splits": [
        ["member", "face", "joints"],
        ["M1", "top", "0.2 0.4 1"],
        ["M1", "left", "900 5000"],
    ],
}


def write(path, sheets):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


@pytest.fixture
def read(tmp_path):
    """read({(sheet, row, heading): value}) reads the good schedule with these cells changed."""

    def changed(changes=(), edit=None):
        sheets = copy.deepcopy(GOOD)
        for (title, row, heading), value in dict(changes).items():
            if heading not in sheets[title][0]:
                sheets[title][0].append(heading)
            while len(sheets[title]) < row:
                sheets[title].append([])
            line = sheets[title][row - 1]
            line += [None] * (len(sheets[title][0]) - len(line))
            line[sheets[title][0].index(heading)] = value
        if edit:
            edit(sheets)
        return read_schedule(write(tmp_path / "hall.xlsx", sheets))

    return changed


def findings(call, *arguments):
    with pytest.raises(BendTorsionError) as raised:
        call(*arguments)
    for finding in raised.value.findings:
        assert finding.severity == "error" and finding.mend and finding.message
        assert "\n" not in finding.line()
    return raised.value.findings


def one(call, *arguments):
    found = findings(call, *arguments)
    assert len(found) == 1, "\n".join(finding.line() for finding in found)
    return found[0]
