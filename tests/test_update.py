# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document brought up to a changed schedule: same objects, hand-made additions kept, counts of
what is recomputed; and what two documents or schedules differ in."""

import json
import shutil

import FreeCAD
import openpyxl
import pytest
from schedule_books import write
from test_build import APART, schedule, short
from test_round_trip import book

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.document import build_document
from BendTorsionWB.document_difference import document_changes
from BendTorsionWB.document_update import Update
from BendTorsionWB.exchange.csv_folder import write_folder
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.round_trip import difference

THREE = (*APART, short(0.35, 0.55))


def edit(path, cells=(), drop=()):
    book = openpyxl.load_workbook(path)
    for (sheet, row, column), value in dict(cells).items():
        headings = [cell.value for cell in book[sheet][1]]
        book[sheet].cell(row, headings.index(column) + 1, value)
    for name in drop:
        for sheet in {"Members", "Splits"}.intersection(book.sheetnames):
            for row in range(book[sheet].max_row, 1, -1):
                if book[sheet].cell(row, 1).value == name:
                    book[sheet].delete_rows(row)
    book.save(path)
    return path


@pytest.fixture
def path(tmp_path):
    return schedule(tmp_path / "three.xlsx", THREE)


def brought(document, path, removing=False):
    given, jobs = project.read_jobs(path)
    template = build_document(given, jobs, sheets=False)
    update = Update(removing)
    update.bring(document, template, sheets=False)
    FreeCAD.closeDocument(template.Name)
    return update


def of_label(document, label, kind):
    [obj] = [o for o in document.Objects if o.Label == label and getattr(o, "BT_Type", "") == kind]
    return obj


def labels(document):
    return [obj.Label for obj in document.Objects]


@pytest.fixture
def ran(made, monkeypatch):
    """Labels of the objects whose build runs."""
    names = []
    for kind in {type(obj.Proxy) for obj in made.Objects if hasattr(obj, "Proxy")}:

        def spy(self, obj, real=kind.build):
            names.append(obj.Label)
            return real(self, obj)

        monkeypatch.setattr(kind, "build", spy)
    return names


def test_the_same_schedule_changes_nothing_and_recomputes_nothing(made, path, ran):
    update = brought(made, path)
    assert update.changes == [] == update.findings
    made.recompute()
    assert ran == []


def test_a_changed_cell_changes_one_property_and_what_depends_on_it(made, path, ran):
    names = {obj.Label: obj.Name for obj in made.Objects}
    edit(path, {("Sections", 3, "h"): 520})
    update = brought(made, path)
    [change] = update.changes
    assert (change.kind, change.name, change.property) == ("SectionSpec", "B500", "Height")
    assert (change.before, change.after, change.member) == (500.0, 520.0, "M1")
    made.recompute()
    assert {name for name in ran if "M" in name and "bed" not in name} == {
        "M1",
        "M1 plates",
        "M1 patterns",
    }
    assert not [name for name in ran if "M2" in name or "M3" in name or name.startswith("A")]
    assert {obj.Label: obj.Name for obj in made.Objects} == names


def test_new_rows_are_added_and_gone_rows_named_before_they_go(made, path, tmp_path):
    four = schedule(tmp_path / "four.xlsx", (*THREE, short(0.6, 0.7)))
    edit(four, drop=["M2"])
    before = labels(made)
    update = brought(made, four)
    added = {(c.kind, c.name) for c in update.changes if c.what == "added"}
    assert {("Member", "M4"), ("PlateSet", "M4 plates"), ("Axis", "A4")} <= added
    assert all("4" in name for _, name in added)
    assert [name for name in labels(made) if name in before] == before, "nothing went"
    told = {f.object: f.message for f in update.findings}
    assert len(told) == len(update.findings) and set(told) == {"M2", "A2"}, "one line a member"
    assert "M2 plates" in told["M2"] and "M2 patterns" in told["M2"]
    assert all(f.code == "row-removed" and "--remove" in f.mend for f in update.findings)
    update = brought(made, four, removing=True)
    assert not [name for name in labels(made) if "M2" in name or name == "A2"]
    gone = {c.name for c in update.changes if c.what == "removed"}
    assert {"M2", "M2 plates", "M2 patterns", "A2"} <= gone and all("2" in name for name in gone)
    made.recompute()
    assert all(obj.Status == "ok" for obj in made.Objects if hasattr(obj, "Status"))
    given, jobs = project.read_jobs(four)
    anew = build_document(given, jobs, sheets=False)
    assert document_changes(made, anew) == ()
    FreeCAD.closeDocument(anew.Name)


def test_sheets_in_the_arrangement_are_told_by_their_members(tmp_path):
    """Not as a line about the arrangement, unless somebody left one out of it."""
    given, jobs = project.read_jobs(schedule(tmp_path / "three.xlsx", THREE))
    document = build_document(given, jobs, sheets=True)

    def brought_with_sheets(book, removing=False):
        given, jobs = project.read_jobs(book)
        template, update = build_document(given, jobs, sheets=True), Update(removing=removing)
        try:
            update.bring(document, template)
        finally:
            FreeCAD.closeDocument(template.Name)
        return [c for c in update.changes if c.property == "Sheets"]

    try:
        [drawn] = [o for o in document.Objects if getattr(o, "BT_Type", "") == "ArrangementSet"]
        four = schedule(tmp_path / "four.xlsx", (*THREE, short(0.6, 0.7)))
        assert brought_with_sheets(four) == [] and len(drawn.Sheets) == 4
        edit(four, drop=["M4"])
        assert brought_with_sheets(four, removing=True) == [] and len(drawn.Sheets) == 3
        drawn.Sheets = drawn.Sheets[1:]
        [change] = brought_with_sheets(four)
        assert len(change.after) == 3 and len(drawn.Sheets) == 3
    finally:
        FreeCAD.closeDocument(document.Name)


def test_the_axis_a_removed_member_leaves_in_its_table_is_named(path, tmp_path):
    """So is one that a member comes for; one whose members still stand is not."""
    other = edit(shutil.copy(path, tmp_path / "other.xlsx"), drop=["M2"])
    there = [change.line() for change in difference(path, other)]
    assert sorted(there) == ["axes A2: member M2 -> nothing (members M2)", "removed: members M2"]
    back = [change.line() for change in difference(other, path)]
    assert sorted(back) == ["added: members M2", "axes A2: member nothing -> M2 (members M2)"]
    renamed = edit(shutil.copy(path, tmp_path / "renamed.xlsx"), {("Members", 4, "member"): "R2"})
    assert [c.line() for c in difference(path, renamed)] == [
        "renamed, by its content: members M2 -> R2"
    ]


def test_a_node_goes_with_its_meeting_and_not_with_a_member(tmp_path):
    """Equal ranks leave no node: the object is not there to tell an error of its own beside that of
    the meeting. A member whose row is gone keeps its cut while it is there."""
    from test_node_objects import schedule as crossing

    given, jobs = project.read_jobs(crossing(tmp_path / "s.xlsx"))
    document = build_document(given, jobs, sheets=False)
    try:
        document.recompute()
        update = brought(document, edit(tmp_path / "s.xlsx", drop=["M2"]))
        assert "N1" in labels(document) and "N1" in {f.object for f in update.findings}
        update = brought(document, crossing(tmp_path / "s.xlsx", ranks=(2, 2)))
        assert [(c.what, c.kind, c.name) for c in update.changes if c.what != "changed"] == [
            ("removed", "Node", "N1")
        ]
        assert not update.findings and "N1" not in labels(document)
        document.recompute()
        assert all(obj.Status == "ok" for obj in document.Objects if hasattr(obj, "Status"))
        # Back again, and used by something made by hand.
        brought(document, crossing(tmp_path / "s.xlsx"))
        document.recompute()
        node = of_label(document, "N1", "Node")
        assert node.Status == "ok" and node.Kind == "crossing"
        document.addObject("Part::Mirroring", "Mirror").Source = node
        update = brought(document, crossing(tmp_path / "s.xlsx", ranks=(2, 2)))
        (told,) = update.findings
        assert told.object == "N1" and "Mirror" in told.message and "N1" in labels(document)
        document.recompute()
        assert node.Status.startswith("error") and not node.Shape.Edges
    finally:
        FreeCAD.closeDocument(document.Name)


def test_hand_made_additions_stay_and_are_named_when_they_use_what_is_gone(made, path):
    sheet = made.addObject("Spreadsheet::Sheet", "Sizes")
    sheet.set("A1", "=510 mm")
    sheet.setAlias("A1", "wanted")
    mirror = made.addObject("Part::Mirroring", "Mirror")
    mirror.Source = of_label(made, "M2 plates", "PlateSet")
    section = of_label(made, "B500", "SectionSpec")
    section.setExpression("Height", "Sizes.wanted")
    made.recompute()
    edit(path, {("Sections", 3, "h"): 520}, drop=["M2"])
    update = brought(made, path)
    bound = [f for f in update.findings if f.code == "bound-by-hand"]
    assert [f.object for f in bound] == ["B500"] and update.changes == []
    made.recompute()
    assert section.Height.Value == 510.0 and sheet in made.Objects and mirror in made.Objects
    [member] = [f for f in update.findings if f.object == "M2"]
    assert "M2 plates" in member.message and "Mirror" in member.message


def test_a_label_or_value_changed_by_hand_is_brought_back_and_told(made, path):
    member = of_label(made, "M1", "Member")
    member.Label = "M1 old"
    member.OffsetZ = 30.0
    update = brought(made, path)
    assert {(c.name, c.property) for c in update.changes} == {
        ("M1", "Label"),
        ("M1", "OffsetZ"),
    } or {c.property for c in update.changes} == {"Label", "OffsetZ"}
    assert member.Label == "M1" and member.OffsetZ.Value == 0.0


def test_a_member_and_its_axis_may_bear_one_name_and_two_members_one_axis(tmp_path):
    path = schedule(tmp_path / "one.xlsx", APART)
    book = openpyxl.load_workbook(path)
    for sheet, column in (("Axes", 1), ("Points", 1), ("Members", 3)):
        for row in book[sheet].iter_rows(min_row=2):
            row[column - 1].value = row[column - 1].value.replace("A", "M")
    book.save(path)
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    try:
        document.recompute()
        plates = of_label(document, "M1 plates", "PlateSet")
        assert plates.Member.Label == "M1" == plates.Member.Axis.Label
        assert all(mark.startswith("M1-") for mark in plates.Marks)
    finally:
        FreeCAD.closeDocument(document.Name)


def test_update_on_the_command_line_keeps_the_document_and_what_was_drawn_in_it(
    path, tmp_path, capsys
):
    out = tmp_path / "out"
    flags = ["--no-sheets", "--jobs", "1"]
    assert main(["build", str(path), "--out", str(out), *flags]) == 0
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    document.addObject("Part::Box", "Crane")
    document.saveAs(str(out / "model.FCStd"))
    FreeCAD.closeDocument(document.Name)
    edit(path, {("Sections", 3, "h"): 520})
    capsys.readouterr()
    assert main(["update", str(path), "--out", str(out), *flags]) == 0
    printed = capsys.readouterr().out
    assert "SectionSpec B500: Height 500 -> 520 (members M1)" in printed
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    assert document.getObject("Crane") is not None
    FreeCAD.closeDocument(document.Name)
    updated = (out / "report.json").read_bytes()
    step = (out / "model.step").read_bytes()
    assert main(["build", str(path), "--out", str(tmp_path / "anew"), *flags]) == 0
    assert updated == (tmp_path / "anew" / "report.json").read_bytes()
    assert len(step) == pytest.approx(
        len((tmp_path / "anew" / "model.step").read_bytes()), rel=0.01
    )
    # A build makes the document anew, but never loses what was drawn in the one there was.
    assert main(["build", str(path), "--out", str(out), *flags]) == 0
    document = FreeCAD.openDocument(str(out / "model.former.FCStd"), hidden=True)
    assert document.getObject("Crane") is not None
    FreeCAD.closeDocument(document.Name)


def test_the_difference_of_two_schedules_per_member_and_property(path, tmp_path, capsys):
    other = tmp_path / "later.xlsx"
    other.write_bytes(path.read_bytes())
    edit(
        other,
        {
            ("Sections", 3, "h"): 520,
            ("Points", 4, "z"): 11111.0,
            ("Members", 3, "cut"): "50%",
            ("Splits", 2, "joints"): "0.4 1",
        },
        drop=["M3"],
    )
    changes = difference(path, other)
    found = {(c.what, c.kind, c.name, c.property, c.member) for c in changes}
    assert ("changed", "sections", "B500", "h", "M1") in found
    assert ("changed", "axes", "A1", "point 3 z", "M1") in found
    assert ("changed", "members", "M1", "segment 2 cut", "M1") in found
    assert ("removed", "members", "M3", "", "M3") in found
    assert any(kind == "splits" and name == "M1 top" for _, kind, name, _, _ in found)
    assert {member for *_, member in found} == {"M1", "M3"}
    target = tmp_path / "changes.xlsx"
    assert main(["diff", str(path), str(other), "--report", str(target)]) == 0
    printed = capsys.readouterr().out
    assert "sections B500: h 500 -> 520 (members M1)" in printed
    rows = list(openpyxl.load_workbook(target)["Changes"].values)
    assert len(rows) == len(changes) + 1 and "before" in rows[0]
    assert main(["diff", str(path), str(other), "--report", str(tmp_path / "c.json")]) == 0
    assert len(json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))) == len(changes)
    assert difference(path, path) == ()


def test_a_difference_reads_as_the_sheets_do(tmp_path):
    """Degrees, kg/m3 and places as in their cells, a line for each cell of a row about plates."""
    given = book(0)
    path = write(tmp_path / "given.xlsx", given)

    def cell(sheet, column, value, **where):
        heading, *rows = given[sheet]
        [row] = [r for r in rows if all(r[heading.index(k)] == v for k, v in where.items())]
        row[heading.index(column)] = value

    cell("Settings", "value", 450, key="station_spacing")
    cell("Settings", "value", 650, key="bed_height")
    cell("Materials", "density", 7900, material="Q355")
    cell("Surfaces", "parameters", "r=15100", surface="Drum")
    cell("Members", "roll", 9.5, member="M3", segment=1)
    cell("Members", "cut", 5000, member="M3", segment=2)
    cell("Splits", "joints", "4000 8000", member="M1")
    cell("Splits", "joints", "auto", member="M3", face="left")
    cell("Diaphragms", "t", 14, member="M3", s="80%")
    cell("Preps", "angle", 41, prep="B6")
    cell("Nodes", "gap", 9.5, node="K1")
    cell("Status", "status", "scrap", plate="M3-T1")
    told = {change.line() for change in difference(path, write(tmp_path / "later.xlsx", given))}
    assert told >= {
        "materials Q355: density 7850 -> 7900 (members M2, M3, M4)",
        "surfaces Drum: r 15000 -> 15100 (members M3)",
        "splits M1 top: joints 0.3 0.7 -> 4000 8000 (members M1)",
        "diaphragms M3 80%: t 10 -> 14 (members M3)",
        "statuses M3-T1: status cut -> scrap (members M3)",
    }
    for start, end in (
        ("settings: station_spacing ", " -> 450"),
        ("members M3: segment 2 cut ", "% -> 5000"),
        ("members M3: roll ", " -> 9.5"),
        ("splits M3 left: joints ", " -> auto (members M3)"),
        ("edges M1 TL 10%: prep B6: bevel angle=", "members M1)"),
        ("nodes K1: gap ", " -> 9.5 (members M1, M2)"),
    ):
        assert [1 for line in told if line.startswith(start) and line.endswith(end)] == [1], start


def test_moved_rows_and_another_form_of_file_are_no_difference(path, tmp_path):
    book = openpyxl.load_workbook(path)
    sheets = {sheet.title: [list(row) for row in sheet.values] for sheet in book}
    write_folder(tmp_path / "csv", sheets)
    book["Members"].insert_rows(2, 3)
    book.save(tmp_path / "moved.xlsx")
    assert difference(path, tmp_path / "csv") == ()
    assert difference(path, tmp_path / "moved.xlsx") == ()
    assert read_schedule(tmp_path / "csv").members


def test_a_document_differs_from_a_schedule_by_what_was_edited_in_it(made, path, tmp_path):
    of_label(made, "B500", "SectionSpec").Thickness = 14
    made.saveCopy(str(tmp_path / "edited.FCStd"))
    [change] = difference(path, tmp_path / "edited.FCStd")
    assert (change.name, change.property) == ("B500", "Thickness")
    assert (change.before, change.after, change.member) == (12.0, 14.0, "M1")


def test_with_sheets_an_edit_reaches_the_pages_of_its_members_and_no_others(path, monkeypatch):
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs)
    try:
        document.recompute()
        ran = []
        for kind in {type(obj.Proxy) for obj in document.Objects if hasattr(obj, "Proxy")}:

            def spy(self, obj, real=kind.build):
                ran.append(obj)
                return real(self, obj)

            monkeypatch.setattr(kind, "build", spy)
        of_label(document, "B500", "SectionSpec").Height = 520
        document.recompute()
        counts = {}
        for obj in ran:
            counts[obj.BT_Type] = counts.get(obj.BT_Type, 0) + 1
        pages = of_label(document, "M1 sheets", "SheetSet").PageCount
        pages += of_label(document, "general arrangement", "ArrangementSet").PageCount
        once = ("SectionSpec", "Member", "PlateSet", "Unfold", "SheetSet", "ArrangementSet")
        assert {kind: counts[kind] for kind in once} == dict.fromkeys(once, 1)
        assert counts["PageOutlines"] == counts["PageSymbol"] == pages > 1
        assert counts.get("Axis", 0) == counts.get("Surface", 0) == 0
        ran.clear()
        document.recompute()
        assert ran == []
    finally:
        FreeCAD.closeDocument(document.Name)
