# SPDX-License-Identifier: LGPL-2.1-or-later
"""A build with a member in error: what of it is written, what is told, and that it is not issued;
slips in the list of what is cut."""

import json
import shutil

import openpyxl
import pytest
from test_build import APART, schedule
from test_update import edit

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.plate_status import read_statuses
from BendTorsionWB.project import Wanted

PLAIN = Wanted(model=False, sheets=False)


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A build issued as A: its schedule, with further sections, and its folder."""
    folder = tmp_path_factory.mktemp("issue")
    path = schedule(folder / "two.xlsx", APART)
    book = openpyxl.load_workbook(path)
    for row in (("B590", "box1", 590, 600, 16), ("B620", "box1", 620, 600, 16)):
        book["Sections"].append(row)
    book["Sections"].append(("B18", "box1", 600, 600, 18))
    book.save(path)
    project.build(path, folder / "out", workers=1, wanted=PLAIN)
    project.issue_folder(folder / "out", "A")
    return path, folder / "out"


@pytest.fixture
def issued(first, tmp_path):
    """A copy to change at will."""
    shutil.copytree(first[1], tmp_path / "out")
    return shutil.copy(first[0], tmp_path / "two.xlsx"), tmp_path / "out"


def listed(path, *rows):
    target = path.parent / "cut.csv"
    target.write_text("plate,status\n" + "".join(f"{row}\n" for row in rows), encoding="utf-8")
    return target


def build(path, out, *rows, wanted=PLAIN, **given):
    statuses = read_statuses(listed(path, *rows)) if rows else ()
    return project.build(path, out, workers=1, wanted=wanted, statuses=statuses, **given)


def refused(out, revision="B"):
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(out, revision)
    assert sorted(p.name for p in (out / "issued").iterdir()) == ["A"]
    return [(f.code, f.object) for f in problem.value.findings]


def of_code(result, code):
    return [f for f in result.findings if f.code == code]


def test_a_build_with_an_error_of_a_cut_plate_is_not_issued(issued, capsys):
    path, out = issued
    edit(path, {("Members", 4, "section"): "B590"})
    assert build(path, out, "M2-L1,cut").failed
    assert refused(out) == [("issue-in-error", "M2-L1")]
    capsys.readouterr()
    assert main(["issue", str(out), "--rev", "B"]) == 2
    assert "M2-L1" in capsys.readouterr().err
    # Another member built by itself does not take the error away, nor an older build of M2.
    edit(path, {("Members", 3, "cut"): "50%", ("Members", 4, "section"): "B18"})
    build(path, out, "M2-L1,cut", only=["M1"])
    assert refused(out) == [("issue-in-error", "M2-L1")]
    # Agreed to, it is issued.
    assert not build(path, out, "M2-L1,scrap").failed
    project.issue_folder(out, "B")


def test_a_cut_plate_that_is_void_is_not_issued_either(issued):
    path, out = issued
    book = openpyxl.load_workbook(path)
    sheet = book["Members"]
    [gone] = [row[0].row for row in sheet.iter_rows() if row[0].value == "M2"]
    sheet.delete_rows(gone)
    book.save(path)
    told = of_code(build(path, out, "M2-L1,cut"), "cut-plate-changes")
    assert [f.object for f in told] == ["M2-L1"]
    assert "limit" not in told[0].line() and told[0].value is None
    assert refused(out) == [("issue-in-error", "M2-L1")]
    assert not build(path, out, "M2-L1,scrap").failed
    project.issue_folder(out, "B")


def test_a_member_in_error_is_not_issued(issued, monkeypatch):
    path, out = issued
    found = error("members-clash", "M1, M2", "run through each other")
    monkeypatch.setattr("BendTorsionWB.shapes.clash.clashes", lambda *given: (found,))
    assert build(path, out).failed
    assert refused(out) == [("issue-in-error", "M1, M2")]
    plates = json.loads((out / "revision.json").read_text(encoding="utf-8"))["plates"]
    assert {plate["what"] for plate in plates} == {"same"}, "no file of theirs to have other marks"
    monkeypatch.undo()
    assert not build(path, out).failed
    project.issue_folder(out, "B")


def test_nothing_of_a_refused_member_goes_to_others(issued):
    path, out = issued
    edit(path, {("Members", 4, "section"): "B590"})
    before = len(list(out.glob("*/M2-*")))
    result = build(path, out, "M2-L1,cut", wanted=Wanted(sheets=False))
    assert result.failed
    for name in ("model.step", "model.ifc"):
        assert "M1-T1" in (out / name).read_text(encoding="utf-8"), name
    for_others = (".step", ".ifc", ".dxf", ".nc1", ".csv")
    files = [p for p in out.rglob("*") if p.suffix in for_others and "issued" not in p.parts]
    assert len(files) > 10
    assert not [p for p in files if "M2-" in p.read_text(encoding="utf-8", errors="replace")]
    [told] = of_code(result, "file-removed")
    assert (told.severity, told.object) == ("warning", "M2") and told.value >= before > 0
    again = build(path, out, "M2-L1,cut", wanted=Wanted(sheets=False))
    assert not of_code(again, "file-removed"), "told once"


@pytest.mark.parametrize(
    ("row", "near"),
    [("m1-b1,cut", "M1-B1"), ("M1_L1,cut", "M1-L1"), ("M77-B1,cut", "-B1"), ("XYZ,cut", "")],
)
def test_a_mark_that_is_no_plates_is_told_with_its_row(issued, row, near):
    path, out = issued
    result = build(path, out, "M1-T1,cut", row)
    [told] = of_code(result, "plate-unknown")
    assert (told.severity, told.object) == ("error", "cut.csv")
    assert told.position == "row 3, column plate" and told.value == row.split(",")[0]
    assert near in told.mend and ("if that is meant" in told.mend) == bool(near)
    assert list(out.glob("plates/M1-*")) and list(out.glob("plates/M2-*")), "all are written"
    assert refused(out) == [("issue-in-error", "cut.csv")]


def test_marks_of_issues_and_of_members_left_out_are_no_slips(issued, tmp_path):
    path, out = issued
    assert not of_code(build(path, out, "M1-T1,cut", "M2-L1,cut", only=["M1"]), "plate-unknown")
    # A folder that knows nothing of M2 says nothing of it.
    result = build(path, tmp_path / "trial", "M1-T1,cut", "M2-L1,cut", only=["M1"])
    assert not result.failed and not of_code(result, "plate-unknown")
    # What was scrapped in an issue stays in the shop's list.
    edit(path, {("Splits", 2, "joints"): "0.3 1"})
    gone = [p.stem for p in out.glob("plates/M1-T*.dxf")]
    build(path, out)
    gone = sorted(set(gone) - {p.stem for p in out.glob("plates/M1-T*.dxf")})
    assert gone
    project.issue_folder(out, "B")
    project.issue_folder(out, "C")
    assert not build(path, out, f"{gone[0]},scrap").failed


def test_a_mark_in_the_schedule_is_told_with_its_sheet(issued):
    path, out = issued
    book = openpyxl.load_workbook(path)
    sheet = book.create_sheet("Status")
    for row in (("plate", "status"), ("m2-l1", "cut")):
        sheet.append(row)
    book.save(path)
    [told] = of_code(build(path, out), "plate-unknown")
    assert told.position == "sheet Status, row 2, column plate" and "M2-L1" in told.mend


def test_a_row_without_a_plate_is_refused(issued, capsys):
    path, out = issued
    command = ["build", str(path), "--out", str(out), "--no-model", "--no-sheets", "--status"]
    assert main([*command, str(listed(path, "M1-T1,cut", ",cut"))]) == 2
    assert "row 3, column plate" in capsys.readouterr().err
    assert main([*command, str(path.parent)]) == 2
    told = capsys.readouterr().err
    assert "is a folder" in told and "Errno" not in told and "save it" not in told


def test_a_plate_that_cannot_be_trimmed_is_questioned(issued):
    path, out = issued
    edit(path, {("Members", 4, "section"): "B620"})
    result = build(path, out, "M2-L1,trim")
    [told] = of_code(result, "cut-plate-no-trim")
    assert (
        told.severity == "error" and f"cannot be trimmed, {told.value:.2f} mm off" in told.message
    )
    assert ": scrap: " in told.message
    assert "scrap" in told.mend and result.failed
    assert not build(path, out, "M2-L1,scrap").failed
    # What can be trimmed may be scrapped.
    edit(path, {("Members", 4, "section"): "B590"})
    assert not build(path, out, "M2-L1,scrap").failed


def test_a_plate_that_is_cut_but_was_never_issued_is_told(issued):
    path, out = issued
    edit(path, {("Members", 3, "member"): "M3"})
    book = openpyxl.load_workbook(path)
    for sheet in book:
        for row in sheet.iter_rows():
            for cell in row:
                if cell.value == "M1":
                    cell.value = "M3"
    book.save(path)
    result = build(path, out, "M3-T1,cut")
    [told] = of_code(result, "cut-plate-new")
    assert (told.severity, told.object) == ("error", "M3-T1") and not of_code(
        result, "cut-plate-changes"
    )


def test_deviations_are_hundredths_of_a_millimetre(issued):
    path, out = issued
    edit(path, {("Members", 4, "section"): "B590"})
    build(path, out)
    project.issue_folder(out, "B")
    for name, columns in (
        ("revision.xlsx", ("deviation", "length_change", "width_change")),
        ("issued/B/transmittal.xlsx", ("deviation",)),
    ):
        sheet = openpyxl.load_workbook(out / name).worksheets[0]
        heading, *rows = sheet.iter_rows()
        for column in columns:
            index = [cell.value for cell in heading].index(column)
            cells = [r[index] for r in rows if isinstance(r[index].value, (int, float))]
            assert any(abs(cell.value) > 1.0 for cell in cells), (name, column)
            for cell in cells:
                assert cell.value == round(cell.value, 2) and cell.number_format == "0.00"


def test_small_slips_on_the_command_line_are_said_plainly(issued, capsys):
    path, out = issued
    assert main(["issue", str(out), "--rev", ""]) == 2
    assert capsys.readouterr().err.startswith("error: --rev: ")
    assert main(["build", str(path), "--out", str(listed(path))]) == 2
    assert "is a file, not a folder" in capsys.readouterr().err
    assert error("code", "", "text").line() == "error: text"
