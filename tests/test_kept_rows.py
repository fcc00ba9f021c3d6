# SPDX-License-Identifier: LGPL-2.1-or-later
"""What no object of a document says comes back from it all the same: rows that no member needs,
defaults for empty cells, statuses of plates."""

import FreeCAD
import openpyxl
from test_build import APART, schedule
from test_write_back import SPHERE

from BendTorsionWB import make, project
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.round_trip import difference, write_back, write_document_back


def test_defaults_for_empty_cells_come_back_and_edits_by_hand_stay(tmp_path):
    """The members have what came of them; rows to come are to take them as well."""
    path, back = schedule(tmp_path / "two.xlsx", APART), tmp_path / "back.xlsx"
    book = openpyxl.load_workbook(path)
    for name, rows in {
        "Settings": [("key", "value"), ("default_slope", 4), ("default_material", "Q420")],
        "Materials": [("material", "fy"), ("Q420", 420)],
    }.items():
        if name in book.sheetnames:
            book.remove(book[name])
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    book.save(path)
    document = build_document(*project.read_jobs(path), sheets=False)
    try:
        assert write_back(document, back) == () and difference(path, back) == ()
        [member] = [obj for obj in document.Objects if obj.Label == "M1"]
        member.Slope1 = 2.5
        for obj in document.Objects:
            if getattr(obj, "BT_Type", "") == "SectionSpec":
                obj.Material, obj.YieldStrength = "S460", "460 MPa"
        assert write_back(document, back) == ()
    finally:
        FreeCAD.closeDocument(document.Name)
    again = read_schedule(back)
    assert [row.segments[0].slope for row in again.members] == [2.5, 4.0]
    # No row of it is there any more: it is the built-in one again.
    assert again.settings.default_material == "S355"
    assert {row.material for row in again.sections} == {"S460"}


def test_rows_that_no_member_needs_and_statuses_come_back(tmp_path):
    """A section in reserve, its material and strips, an axis to come, what the shop has cut."""
    path, back = schedule(tmp_path / "two.xlsx", APART), tmp_path / "back.xlsx"
    book = openpyxl.load_workbook(path)
    book["Sections"].append(["B700", "box1", 700, 650, 20])
    book["Sections"].append(["Free", "strips"])
    book["Sections"].cell(1, 6, "material")
    book["Sections"].cell(4, 6, "Q420")
    book["Axes"].append(["A9", "Hall"])
    for number, point in enumerate(SPHERE, start=1):
        book["Points"].append(["A9", number, *point])
    for name, rows in {
        "Materials": [("material", "fy"), ("Q420", 420), ("Q460", 460)],
        "Strips": [
            ("section", "face", "letter", "y1", "z1", "y2", "z2", "t"),
            ("Free", "web", "W", 0, -300, 0, 300, "12,5"),
        ],
        "Preps": [("prep", "type", "angle"), ("B6", "bevel", 35)],
        "Status": [("plate", "status"), ("M1-T1", "cut"), ("M2-L1", "trim")],
    }.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    book.save(path)
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    try:
        document.saveAs(str(tmp_path / "model.FCStd"))
    finally:
        FreeCAD.closeDocument(document.Name)
    assert write_document_back(tmp_path / "model.FCStd", back) == ()
    assert difference(path, back) == ()
    again = read_schedule(back)
    assert again.section("Free").strips[0].t == 12.5
    assert [(row.name, row.status) for row in again.statuses] == [
        ("M1-T1", "cut"),
        ("M2-L1", "trim"),
    ]
    # What the document has since of the same name counts, and what lost its surface stays out.
    document = FreeCAD.openDocument(str(tmp_path / "model.FCStd"), hidden=True)
    try:
        make.make_section(document, "B700", h=720, b=650, t=20)
        [surface] = [obj for obj in document.Objects if obj.Label == "Hall"]
        surface.Label = "Dome"
        write_back(document, back)
    finally:
        FreeCAD.closeDocument(document.Name)
    again = read_schedule(back)
    assert [row.h for row in again.sections if row.name == "B700"] == [720.0]
    assert [row.name for row in again.axes] == ["A1", "A2"]


def test_a_status_alone_is_brought_into_the_document_and_the_rest_stays_as_built(tmp_path):
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    plain = project.Wanted(sheets=False)
    project.build(path, out, workers=1, wanted=plain)
    names = ("model.FCStd", "model.step", "model.ifc")
    before = [(out / name).stat().st_mtime_ns for name in names]
    book = openpyxl.load_workbook(path)
    sheet = book.create_sheet("Status")
    for row in (("plate", "status"), ("M1-T1", "cut"), ("M2-<&'\\1", "scrap")):
        sheet.append(row)
    book.save(path)
    project.build(path, out, workers=1, wanted=plain)
    after = [(out / name).stat().st_mtime_ns for name in names]
    assert after[0] != before[0] and after[1:] == before[1:], "solids are not made again"
    write_document_back(out / "model.FCStd", tmp_path / "back.xlsx")
    assert [row.name for row in read_schedule(tmp_path / "back.xlsx").statuses] == [
        "M1-T1",
        "M2-<&'\\1",
    ]
    project.build(path, tmp_path / "anew", workers=1, wanted=plain)
    assert (out / names[0]).read_bytes() == (tmp_path / "anew" / names[0]).read_bytes()
    project.build(path, out, workers=1, wanted=plain)
    assert [(out / name).stat().st_mtime_ns for name in names] == after
