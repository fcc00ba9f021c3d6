# SPDX-License-Identifier: LGPL-2.1-or-later
"""Issues: what is frozen, what later builds say of each plate, and plates already cut."""

import csv
import errno
import hashlib
import json
import re
import shutil

import openpyxl
import pytest
from test_build import APART, schedule
from test_update import edit

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.plate_status import read_statuses
from BendTorsionWB.exchange.whole_file import not_written
from BendTorsionWB.project import Wanted

PLAIN = Wanted(model=False, sheets=False)


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A build issued as A: its schedule and folder."""
    folder = tmp_path_factory.mktemp("issue")
    path = schedule(folder / "two.xlsx", APART)
    build(path, folder / "out")
    project.issue_folder(folder / "out", "A", "for approval")
    return path, folder / "out"


@pytest.fixture
def issued(first, tmp_path):
    """A copy to change at will."""
    path, out = first
    shutil.copytree(out, tmp_path / "out")
    return shutil.copy(path, tmp_path / "two.xlsx"), tmp_path / "out"


def build(path, out, **given):
    return project.build(path, out, workers=1, wanted=PLAIN, **given)


def told(out):
    content = json.loads((out / "revision.json").read_text(encoding="utf-8"))
    return {plate["mark"]: plate for plate in content["plates"]}


def _without_revision(copy, revision):
    """A file of an issue as it was built; the comment with the revision is there."""
    content = copy.read_bytes()
    comments = {".dxf": b"999\nrevision %s\n", ".nc1": b"** revision %s\r\n"}
    if copy.suffix not in comments:
        return content
    comment = comments[copy.suffix] % revision.encode()
    assert content.count(comment) == 1
    return content.replace(comment, b"")


def transmittal(out, revision):
    content = json.loads(
        (out / "issued" / revision / "transmittal.json").read_text(encoding="utf-8")
    )
    return {item["name"]: item for item in content["files"]}


def test_an_issue_holds_every_file_with_its_hash_and_cannot_be_written_again(issued):
    _, out = issued
    files = transmittal(out, "A")
    names = {str(p.relative_to(out)) for p in out.rglob("*") if p.is_file()}
    names = {n for n in names if not n.startswith((".", "issued"))}
    names -= {"report.json", "timing.json"}
    assert set(files) == names
    for name, item in files.items():
        copy = out / "issued" / item["issued_as"]
        assert copy.stem.endswith("_A") and item["revision"] == "A" and item["what"] == "new"
        assert hashlib.sha256(copy.read_bytes()).hexdigest() == item["sha256"]
        built = (out / name).read_bytes()
        assert hashlib.sha256(built).hexdigest() == item["built"]
        assert _without_revision(copy, "A") == built
        assert not copy.stat().st_mode & 0o222
    rows = list(openpyxl.load_workbook(out / "issued/A/transmittal.xlsx")["Transmittal"].values)
    assert [row[0] for row in rows[1 : len(files) + 1]] == sorted(files)
    with open(out / "issued/A/transmittal.csv", encoding="utf-8-sig", newline="") as stream:
        assert [row["sha256"] for row in csv.DictReader(stream)] == [
            files[name]["sha256"] for name in sorted(files)
        ]
    before = {p: p.read_bytes() for p in (out / "issued").rglob("*") if p.is_file()}
    for revision in ("A", "a"):
        with pytest.raises(BendTorsionError) as problem:
            project.issue_folder(out, revision)
        assert problem.value.findings[0].code == "revision-exists"
    assert {p: p.read_bytes() for p in (out / "issued").rglob("*") if p.is_file()} == before


def test_the_same_schedule_leaves_every_plate_the_same(issued):
    path, out = issued
    build(path, out)
    plates = told(out)
    assert plates and {plate["what"] for plate in plates.values()} == {"same"}


def test_plates_are_same_changed_new_or_void_and_the_next_issue_holds_what_changed(issued, capsys):
    path, out = issued
    before = {p: p.read_bytes() for p in (out / "issued").rglob("*") if p.is_file()}
    # One joint less on top of M1; M2 loses its last point and some length.
    edit(path, {("Splits", 2, "joints"): "0.3 1"})
    book = openpyxl.load_workbook(path)
    book["Sections"].append(["B610", "box1", 610, 600, 16])
    for row in book["Members"].iter_rows(min_row=2):
        if row[0].value == "M2":
            row[3].value = "B610"
    book.save(path)
    build(path, out)
    plates = told(out)
    # M2 is 10 mm higher: its webs are 10 mm wider, 5 mm at each edge; top and bottom turn with it.
    webs = [p for mark, p in plates.items() if mark.startswith(("M2-L", "M2-R"))]
    assert webs and all(p["what"] == "changed" for p in webs)
    for plate in webs:
        assert plate["deviation"] == pytest.approx(5.0, abs=0.05)
        assert plate["width"] == pytest.approx(10.0, abs=0.1)
    gone = [mark for mark, plate in plates.items() if plate["what"] == "void"]
    assert len(gone) == 1 and gone[0].startswith("M1-T")
    same = [mark for mark, plate in plates.items() if plate["what"] == "same"]
    assert any(mark.startswith("M1-B") for mark in same)
    assert main(["issue", str(out), "--rev", "B", "--note", "web height"]) == 0
    assert "revision B" in capsys.readouterr().out
    files = transmittal(out, "B")
    for mark in same:
        assert files[f"plates/{mark}.dxf"]["revision"] == "A"
        assert files[f"plates/{mark}.dxf"]["what"] == "same"
        assert not (out / f"issued/B/plates/{mark}_B.dxf").exists()
    for plate in webs:
        item = files[f"plates/{plate['mark']}.dxf"]
        assert (item["revision"], item["what"]) == ("B", "changed")
        assert item["deviation"] == pytest.approx(5.0, abs=0.05)
        assert (out / "issued" / item["issued_as"]).exists()
    assert files[f"plates/{gone[0]}.dxf"]["what"] == "void"
    assert {p: p.read_bytes() for p in before} == before, "revision A is as it was issued"
    build(path, out)
    assert {plate["what"] for plate in told(out).values()} == {"same"}


def statuses(tmp_path, rows):
    path = tmp_path / "status.csv"
    path.write_text(
        "plate,status\n" + "".join(f"{mark},{word}\n" for mark, word in rows.items()),
        encoding="utf-8",
    )
    return read_statuses(path)


def test_a_plate_that_is_cut_and_would_change_is_an_error_with_its_verdict(issued, tmp_path):
    path, out = issued
    book = openpyxl.load_workbook(path)
    book["Sections"].append(["B590", "box1", 590, 600, 16])
    book["Sections"].append(["B620", "box1", 620, 600, 16])
    book["Sections"].append(["B18", "box1", 600, 600, 18])
    book.save(path)
    webs = ("M2-L1", "M2-R1")

    def rebuilt(section, **given):
        edit(path, {("Members", 4, "section"): section})
        result = build(path, out, **given)
        return {
            f.object: f for f in result.findings if f.code == "cut-plate-changes"
        }, result.failed

    cut = statuses(tmp_path, {"M2-L1": "cut", "M1-B1": "cut"})
    found, failed = rebuilt("B590", statuses=cut)
    assert failed and list(found) == ["M2-L1"] and found["M2-L1"].severity == "error"
    assert "trim" in found["M2-L1"].message and "edge" in found["M2-L1"].message
    off = f", {found['M2-L1'].value:.2f} mm off where it lies best on the new one: trim "
    assert off in found["M2-L1"].message, "the value of the finding is explained"
    assert not list(out.glob("*/M2-*")) and list(out.glob("*/M1-*")), "M2 is not written"
    found, failed = rebuilt("B590", statuses=statuses(tmp_path, {"M2-L1": "trim"}))
    assert not failed and found["M2-L1"].severity == "warning"
    found, failed = rebuilt("B620", statuses=cut)
    assert failed and "scrap" in found["M2-L1"].message and "missing" in found["M2-L1"].message
    found, failed = rebuilt("B18", statuses=statuses(tmp_path, dict.fromkeys(webs, "cut")))
    assert failed and set(found) == set(webs)
    assert all("scrap: thickness 16 -> 18" in f.message for f in found.values())
    found, failed = rebuilt("B600", statuses=cut)
    assert not failed and not found


def test_the_status_may_stand_in_the_schedule(issued):
    path, out = issued
    book = openpyxl.load_workbook(path)
    sheet = book.create_sheet("Status")
    for row in (("plate", "status"), ("M2-L1", "cut")):
        sheet.append(row)
    book.save(path)
    assert not build(path, out).failed
    edit(path, {("Sections", 2, "t"): 18})
    result = build(path, out)
    assert [f.object for f in result.findings if f.severity == "error"][0] == "M2-L1"


def test_a_partial_build_says_nothing_of_members_it_leaves_out(issued):
    path, out = issued
    build(path, out, only=["M2"])
    assert {mark.split("-")[0] for mark in told(out)} == {"M1", "M2"}
    edit(path, {("Members", 3, "cut"): "50%"})
    build(path, out, only=["M2"])
    assert {mark.split("-")[0] for mark in told(out)} == {"M2"}
    project.build(path, out, workers=1, wanted=PLAIN)
    assert {mark.split("-")[0] for mark in told(out)} == {"M1", "M2"}


def torn(path, text):
    """Other text in place of a file's own."""
    path.chmod(0o644)
    path.write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    ("harm", "code"),
    [
        (lambda out: torn(next((out / "plates").iterdir()), "edited"), "file-changed"),
        (lambda out: next((out / "nc1").iterdir()).unlink(), "file-changed"),
        (lambda out: (out / ".bendtorsion-outlines.npz").unlink(), "issue-nothing"),
        (lambda out: (out / ".bendtorsion.json").unlink(), "issue-nothing"),
        (lambda out: torn(out / "issued/A/transmittal.json", "{"), "issue-unreadable"),
    ],
)
def test_what_cannot_be_issued_is_told_and_nothing_is_written(issued, harm, code):
    _, out = issued
    harm(out)
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(out, "B")
    assert problem.value.findings[0].code == code
    assert [p.name for p in (out / "issued").iterdir()] == ["A"]


def test_outlines_of_a_build_before_are_not_issued_with_the_next_one(issued):
    path, out = issued
    for kept in (".bendtorsion-outlines.npz", ".bendtorsion-parts.json"):
        (out / kept).chmod(0o444)
    build(edit(path, {("Sections", 2, "t"): 18}), out)
    assert not (out / ".bendtorsion-parts.json").exists()
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(out, "B")
    assert problem.value.findings[0].code == "issue-nothing"
    build(path, out)
    project.issue_folder(out, "B")


def test_an_issue_that_does_not_fit_is_told_by_its_own_name(issued, monkeypatch):
    _, out = issued

    def full(outlines, path):
        raise BendTorsionError(not_written(path, OSError(errno.ENOSPC, "No space left")))

    monkeypatch.setattr("BendTorsionWB.exchange.issue.write_outlines", full)
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(out, "B")
    [finding] = problem.value.findings
    assert (finding.code, finding.object) == ("file-not-written", str(out / "issued" / "B"))
    assert "free space" in finding.mend
    assert [p.name for p in (out / "issued").iterdir()] == ["A"]


@pytest.mark.parametrize("name", ["", "../B", "B/C", ".B", "B*"])
def test_a_revision_has_a_name_that_names_files(issued, name):
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(issued[1], name)
    assert problem.value.findings[0].code == "revision-name"


def test_a_status_list_with_slips_is_refused_line_by_line(tmp_path):
    path = tmp_path / "status.csv"
    path.write_text("plate;status\nM1-T1;cut\nM1-T2;gone\nM1-T1;trim\n\n", encoding="utf-8")
    with pytest.raises(BendTorsionError) as problem:
        read_statuses(path)
    assert [(f.code, f.position) for f in problem.value.findings] == [
        ("unknown-value", "row 3, column status"),
        ("duplicate", "row 4, column plate"),
    ]
    path.write_text("mark,what\n", encoding="utf-8")
    with pytest.raises(BendTorsionError) as problem:
        read_statuses(path)
    assert problem.value.findings[0].code == "heading-missing"


def test_a_status_list_may_have_a_title_and_headings_in_chinese(tmp_path):
    path = tmp_path / "status.csv"
    path.write_text(
        "Cut until Friday, hall 2, all\n\n零件号;状态;date\nM1-T1;cut;1\nM1-T2;Trim;2\n",
        encoding="utf-8",
    )
    rows = read_statuses(path)
    assert [(row.name, row.status) for row in rows] == [("M1-T1", "cut"), ("M1-T2", "trim")]
    assert rows[1].place.row == 5


def test_a_cut_plate_is_trimmed_where_its_joint_moved_and_an_opening_must_be_where_it_was(tmp_path):
    """The plate is bent so slowly that the new one would do anywhere along it; only at its own
    place marks, ends and openings hold."""
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    book = openpyxl.load_workbook(path)
    book["Splits"].append(["M2", "top", "0.5 1"])
    sheet = book.create_sheet("Openings")
    for row in (["member", "face", "s", "shape"], ["M2", "left", 2500, "200x100"]):
        sheet.append(row)
    book.save(path)
    build(path, out)
    project.issue_folder(out, "A")
    rows = "".join(f"{mark},cut\n" for mark in ("M2-T1", "M2-T2", "M2-L1"))
    (tmp_path / "cut.csv").write_text("plate,status\n" + rows, encoding="utf-8")

    def verdicts(cells):
        other = shutil.copy(path, tmp_path / "other.xlsx")
        statuses = read_statuses(tmp_path / "cut.csv")
        found = build(edit(other, cells), out, statuses=statuses).findings
        told = [f for f in found if f.code.startswith("cut-plate")]
        return {f.object: (f.severity, f.message.split(": ", 1)[1]) for f in told}

    later = verdicts({("Splits", 4, "joints"): "0.52 1"})
    assert later["M2-T1"][1].startswith("scrap: 5") and set(later) == {"M2-T1", "M2-T2"}
    assert re.fullmatch(r"trim 109\.\d mm at E-1", later["M2-T2"][1])
    earlier = verdicts({("Splits", 4, "joints"): "0.48 1"})
    assert re.fullmatch(r"trim 109\.\d mm at E-2", earlier["M2-T1"][1])
    for cells in ({("Openings", 2, "s"): 2600}, {("Openings", 2, "shape"): "100x200"}):
        lost = ("error", "scrap: it has an opening where the new one has none")
        assert verdicts(cells) == {"M2-L1": lost}


EVERY = [f"model.{ending}" for ending in ("FCStd", "step", "ifc")]


def test_an_issue_without_a_kind_of_file_the_last_one_has_is_refused_and_nothing_is_void(
    tmp_path, capsys
):
    """Left out by an option for speed, they were called void as if the model were withdrawn."""
    path, out = schedule(tmp_path / "two.xlsx", APART[:1]), tmp_path / "out"
    assert main(["build", str(path), "--out", str(out), "--svg", "--quiet", "--jobs", "1"]) == 0
    project.issue_folder(out, "A")
    assert {*EVERY, "sheets/set.pdf"} <= transmittal(out, "A").keys()
    edit(path, {("Sections", 3, "h"): 520})
    capsys.readouterr()
    plain = ["build", str(path), "--out", str(out), "--jobs", "1", "--no-model", "--no-sheets"]
    assert main(plain) == 0
    # What no longer fits is gone, and the build says so.
    told = capsys.readouterr()
    gone = "warning: model: left out of this build; the files of the build before are removed"
    assert f"{gone} (value model.FCStd, model.ifc, model.step)" in told.out + told.err
    assert not any((out / name).exists() for name in EVERY)
    assert main(["issue", str(out), "--rev", "B"]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[1].strip() for line in lines] == [
        "model",
        "drawing sheets",
        "drawing sheets as SVG",
    ]
    assert all("was left out of the last build, and issue A has it" in line for line in lines)
    assert not (out / "issued" / "B").exists()
    # One kind is enough, and a split model is a model.
    assert main([*plain[:-2], "--split", "1", "--quiet"]) == 0
    assert main(["issue", str(out), "--rev", "B"]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert "drawing sheets as SVG: " in line
    assert main([*plain[:-2], "--split", "1", "--svg", "--quiet"]) == 0
    assert main(["issue", str(out), "--rev", "B"]) == 0
    files = transmittal(out, "B")
    assert files["model/001.step"]["what"] == "new" and files["model.step"]["what"] == "void"
    assert not [n for n, own in files.items() if n.startswith("sheets") and own["what"] == "void"]
