# SPDX-License-Identifier: LGPL-2.1-or-later
"""A build of some members: the files of the whole project stay whole, or say what they lack."""

import json
import shutil

import FreeCAD
import openpyxl
import Part
import pytest
from test_build import APART, changed, schedule

from BendTorsionWB import document_export, project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document_update import open_document
from BendTorsionWB.model_files import Wanted

assert Part
NO_MODEL = Wanted(model=False, sheets=False)
M1_CHANGED = {("Members", 3, "cut"): "50%"}
M2_CHANGED = {("Members", 4, "align"): "centre"}
MEMBERS_OF = ("M1", "M2")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A schedule and the folder all its members were built into."""
    folder = tmp_path_factory.mktemp("whole")
    path = schedule(folder / "two.xlsx", APART)
    assert not project.build(path, folder / "out", workers=1, wanted=NO_MODEL).failed
    return path, folder / "out"


@pytest.fixture
def there(whole, tmp_path):
    """A schedule and a folder to change, as `whole`."""
    shutil.copy(whole[0], tmp_path / "two.xlsx")
    shutil.copytree(whole[1], tmp_path / "out")
    return tmp_path / "two.xlsx", tmp_path / "out"


def contents(out):
    return {
        str(p.relative_to(out)): p.read_bytes()
        for p in out.rglob("*")
        if p.is_file() and p.name != "timing.json" and ".cache" not in p.parts
    }


def members_in(out):
    """The members each table, list and report of the project holds."""
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    of_plates = {row[0] for row in book["Plates"].iter_rows(min_row=2, values_only=True)}
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    nesting = (out / "nesting.csv").read_text(encoding="utf-8-sig")
    return (
        {name for name in MEMBERS_OF if name in of_plates},
        {member["member"] for member in report["members"]},
        {name for name in MEMBERS_OF if f"{name}-" in nesting},
    )


def test_others_stay_as_they_were_while_nothing_of_theirs_changed(there, tmp_path):
    path, out = there
    changed(path, APART, M1_CHANGED)
    result = project.build(path, out, only=["M1"], workers=1, wanted=NO_MODEL)
    assert {f.code for f in result.findings}.isdisjoint({"member-outdated", "members-not-built"})
    assert members_in(out) == ({"M1", "M2"},) * 3
    project.build(path, tmp_path / "anew", workers=1, wanted=NO_MODEL)
    assert contents(out) == contents(tmp_path / "anew")


def test_others_that_changed_are_named_and_not_issued(there):
    path, out = there
    changed(path, APART, M1_CHANGED | M2_CHANGED)
    before = {p.name: p.read_bytes() for p in out.glob("plates/M2-*.dxf")}
    result = project.build(path, out, only=["M1"], workers=1, wanted=NO_MODEL)
    [told] = [f for f in result.findings if f.code == "member-outdated"]
    assert (told.severity, told.object) == ("warning", "M2") and told.mend
    assert members_in(out) == ({"M1"},) * 3
    checks = openpyxl.load_workbook(out / "results.xlsx")["Checks"]
    assert "member-outdated" in {row[1] for row in checks.iter_rows(values_only=True)}
    assert {p.name: p.read_bytes() for p in out.glob("plates/M2-*.dxf")} == before != {}
    with pytest.raises(BendTorsionError) as refused:
        project.issue_folder(out, "A")
    assert [(f.code, f.object) for f in refused.value.findings] == [("issue-outdated", "M2")]
    assert not (out / "issued").exists()
    # Asked for as well, the second is built, and the folder can be issued.
    result = project.build(path, out, only=["M2"], workers=1, wanted=NO_MODEL)
    assert members_in(out) == ({"M1", "M2"},) * 3
    project.issue_folder(out, "A")


def test_others_never_built_are_named_in_one_note(tmp_path):
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    result = project.build(path, out, only=["M1"], workers=1, wanted=NO_MODEL)
    [told] = [f for f in result.findings if f.code == "members-not-built"]
    assert told.severity == "note" and "M2" in told.message and told.value == 1
    assert members_in(out) == ({"M1"},) * 3
    # Members that are in no file of the folder are not in the way of an issue of those that are.
    assert project.issue_folder(out, "A").files


def test_a_fault_of_another_member_is_not_in_the_way(there):
    path, out = there
    book = openpyxl.load_workbook(path)
    book["Surfaces"].append(["Roof", "file", None, "roof.step"])
    book["Surfaces"].cell(1, 4, "file")
    book["Axes"].cell(3, 2, "Roof")
    book.save(path)
    result = project.build(path, out, only=["M1"], workers=1, wanted=NO_MODEL)
    assert [f.object for f in result.findings if f.code == "member-outdated"] == ["M2"]
    assert members_in(out) == ({"M1"},) * 3
    with pytest.raises(BendTorsionError, match=r"roof\.step"):
        project.build(path, out, only=["M2"], workers=1, wanted=NO_MODEL)


@pytest.mark.parametrize("removing", [False, True])
def test_an_update_of_some_leaves_the_others_in_the_document(tmp_path, removing):
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    updated = Wanted(sheets=False, update=True, removing=removing)
    project.build(path, out, workers=1, wanted=updated)
    changed(path, APART, M1_CHANGED | M2_CHANGED)
    result = project.build(path, out, ["M1"], 1, wanted=updated)
    assert not [f for f in result.findings if f.code == "row-removed"]
    assert {change.what for change in result.changes} == {"changed"}
    document = open_document(out / "model.FCStd")
    labels = {obj.Label for obj in document.Objects}
    FreeCAD.closeDocument(document.Name)
    assert {"M1", "M2"} <= labels


def test_an_export_of_some_members_is_whole_or_says_what_it_lacks(tmp_path):
    path = schedule(tmp_path / "two.xlsx", APART)
    project.build(path, tmp_path / "built", workers=1, wanted=Wanted(sheets=False))
    model, out = tmp_path / "built" / "model.FCStd", tmp_path / "out"
    result = document_export.export_document(model, out, ["M2"], 1, sheets=False)
    assert [f.code for f in result.findings if "not-built" in f.code] == ["members-not-built"]
    assert members_in(out) == ({"M2"},) * 3
    document_export.export_document(model, out, (), 1, sheets=False)
    before = contents(out)
    document_export.export_document(model, out, ["M2"], 1, sheets=False)
    assert members_in(out) == ({"M1", "M2"},) * 3
    assert contents(out).keys() == before.keys()
    document = open_document(model)
    section = next(obj for obj in document.Objects if obj.Label == "B500")
    section.Height = 520.0
    document.recompute()
    document.saveAs(str(model))
    FreeCAD.closeDocument(document.Name)
    result = document_export.export_document(model, out, ["M2"], 1, sheets=False)
    assert [f.object for f in result.findings if f.code == "member-outdated"] == ["M1"]
    assert members_in(out) == ({"M2"},) * 3
    assert {p.name for p in out.glob("plates/M1-*.dxf")}


def test_a_member_left_out_moves_no_other_to_another_document_of_a_split_model(tmp_path):
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    split = Wanted(sheets=False, split=1)
    project.build(path, out, workers=1, wanted=split)
    place = out / "model" / "002.FCStd"
    before = place.stat().st_ino, place.read_bytes()
    changed(path, APART, M1_CHANGED)
    project.build(path, out, ["M2"], 1, wanted=split)
    assert (place.stat().st_ino, place.read_bytes()) == before
    assert [p.name for p in sorted((out / "model").glob("*.FCStd"))] == ["002.FCStd"]
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    try:
        assert [obj.Label for obj in document.Objects] == ["M2"]
    finally:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
