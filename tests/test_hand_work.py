# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work by hand in a document of a folder is never lost, whatever is built over it; the document of
a split model names those it links to; what an update leaves is told as long as it is there."""

import shutil

import FreeCAD
import pytest
from test_build import APART, schedule
from test_update import edit

from BendTorsionWB import make
from BendTorsionWB.__main__ import main
from BendTorsionWB.exchange.linked_documents import linked_documents

FLAGS = ["--no-sheets", "--jobs", "1"]


def run(capsys, *arguments):
    """Exit code, and all that is printed."""
    capsys.readouterr()
    code = main([str(word) for word in arguments])
    printed = capsys.readouterr()
    return code, printed.out + printed.err


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A schedule, its build with a spreadsheet added by hand, brought up to another schedule."""
    folder = tmp_path_factory.mktemp("hand")
    path = schedule(folder / "two.xlsx", APART)
    out = folder / "out"
    assert main(["build", str(path), "--out", str(out), *FLAGS]) == 0
    add_notes(out / "model.FCStd")
    edit(path, {("Sections", 3, "h"): 520})
    assert main(["update", str(path), "--out", str(out), *FLAGS]) == 0
    assert has_notes(out / "model.FCStd")
    return folder


@pytest.fixture
def place(first, tmp_path):
    shutil.copytree(first, tmp_path / "copy")
    return tmp_path / "copy" / "two.xlsx", tmp_path / "copy" / "out"


def add_notes(path):
    document = FreeCAD.openDocument(str(path), hidden=True)
    document.addObject("Spreadsheet::Sheet", "Notes")
    document.save()
    FreeCAD.closeDocument(document.Name)


def has_notes(path):
    document = FreeCAD.openDocument(str(path), hidden=True)
    try:
        return document.getObject("Notes") is not None
    finally:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)


def test_a_build_without_a_model_sets_an_updated_document_aside(place, capsys):
    path, out = place
    code, told = run(capsys, "build", path, "--out", out, "--no-model", *FLAGS)
    assert code == 0 and "kept as model.former.FCStd" in told
    assert not (out / "model.FCStd").exists() and has_notes(out / "model.former.FCStd")
    assert not (out / "model.step").exists()


def test_a_build_anew_says_where_the_former_document_is(place, capsys):
    path, out = place
    code, told = run(capsys, "build", path, "--out", out, *FLAGS)
    assert code == 0 and "kept as model.former.FCStd" in told
    assert has_notes(out / "model.former.FCStd") and not has_notes(out / "model.FCStd")
    code, told = run(capsys, "build", path, "--out", out, *FLAGS)
    assert code == 0 and "former" not in told


def test_an_update_in_error_is_by_hand_still(place, capsys):
    """An object made by hand fails: the document is computed each time, and no less by hand."""
    path, out = place
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    make.make_section(document, "Spare", h=500, b=400, t=12).Height = 20
    document.save()
    FreeCAD.closeDocument(document.Name)
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 1 and "Spare" in told
    assert has_notes(out / "model.FCStd")
    code, told = run(capsys, "build", path, "--out", out, "--no-model", *FLAGS)
    assert "kept as model.former.FCStd" in told and has_notes(out / "model.former.FCStd")


def test_an_update_that_splits_and_one_that_joins_again_keep_what_was_there(place, capsys):
    path, out = place
    code, told = run(capsys, "update", path, "--out", out, "--split", 1, *FLAGS)
    assert code == 0 and "kept as model.former.FCStd" in told
    assert linked_documents(out / "model.FCStd") == ("model/001.FCStd", "model/002.FCStd")
    assert has_notes(out / "model.former.FCStd")
    add_notes(out / "model" / "001.FCStd")
    code, _ = run(capsys, "update", path, "--out", out, "--split", 1, *FLAGS)
    assert code == 0 and has_notes(out / "model" / "001.FCStd")
    # One document again: not the links with members added to them.
    edit(path, {("Sections", 3, "h"): 530})
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and linked_documents(out / "model.FCStd") == ()
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    assert not [obj for obj in document.Objects if obj.TypeId == "App::Link"]
    FreeCAD.closeDocument(document.Name)
    kept = list((out / "model").glob("001*.FCStd"))
    assert len(kept) == 1 and has_notes(kept[0])


def test_a_document_exported_into_its_own_folder_stays(place, capsys):
    _, out = place
    before = (out / "model.FCStd").read_bytes()
    code, told = run(capsys, "export", out / "model.FCStd", "--out", out, *FLAGS)
    assert code == 0 and "former" not in told
    assert (out / "model.FCStd").read_bytes() == before


def test_what_a_split_model_links_to_is_named_and_nothing_is_written(place, capsys, tmp_path):
    path, out = place
    split = tmp_path / "split"
    assert run(capsys, "build", path, "--out", split, "--split", 1, *FLAGS)[0] == 0
    model = split / "model.FCStd"
    for words in (
        ["diff", path, model],
        ["report", model],
        ["repair", model],
        ["export", model, "--out", tmp_path / "exported"],
        ["export", model, "--out", tmp_path / "back.xlsx"],
    ):
        code, told = run(capsys, *words)
        assert code == 2 and len(told.splitlines()) == 1, told
        assert "model/001.FCStd, model/002.FCStd" in told
    assert not (tmp_path / "exported" / "report.json").exists()
    assert not list(tmp_path.glob("back*"))
    code, told = run(capsys, "report", split / "model" / "001.FCStd", "--jobs", 1)
    assert code == 0 and "M1" in told


def test_a_document_without_members_is_written_back_to_no_file(tmp_path, capsys):
    document = FreeCAD.newDocument("none", hidden=True)
    document.addObject("Part::Box", "Crane")
    document.saveAs(str(tmp_path / "none.FCStd"))
    FreeCAD.closeDocument(document.Name)
    code, told = run(capsys, "export", tmp_path / "none.FCStd", "--out", tmp_path / "back.xlsx")
    assert code == 2 and len(told.splitlines()) == 1 and "no member" in told
    assert not list(tmp_path.glob("back*"))


def test_what_lost_its_row_is_told_each_time_and_goes_when_it_shall(place, capsys):
    path, out = place
    edit(path, drop=["M2"])
    for _ in range(3):
        code, told = run(capsys, "update", path, "--out", out, *FLAGS)
        lines = [line for line in told.splitlines() if "no longer in the schedule" in line]
        members = [line for line in lines if "Member M2" in line]
        assert code == 0 and len(members) == 1 and "M2 patterns" in members[0]
    code, told = run(capsys, "update", path, "--out", out, "--remove", *FLAGS)
    assert code == 0 and "removed: Member M2" in told and "no longer in" not in told
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    labels = [obj.Label for obj in document.Objects]
    FreeCAD.closeDocument(document.Name)
    assert "M1 plates" in labels and not [name for name in labels if name.startswith("M2")]
    assert "Notes" in labels
    # Nothing is left to tell, and nothing to do.
    when = (out / "model.FCStd").stat().st_mtime_ns
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and "no longer in" not in told
    assert (out / "model.FCStd").stat().st_mtime_ns == when
