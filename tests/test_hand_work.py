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
    # An update leaves it split; built, it is one document again, not the links with members added.
    edit(path, {("Sections", 3, "h"): 530})
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and "the model stays split by 1" in told
    assert linked_documents(out / "model.FCStd") == ("model/001.FCStd", "model/002.FCStd")
    assert has_notes(out / "model" / "001.FCStd")
    code, told = run(capsys, "build", path, "--out", out, *FLAGS)
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
        ["report", model],
        ["repair", model],
        ["export", model, "--out", tmp_path / "exported"],
    ):
        code, told = run(capsys, *words)
        assert code == 2 and len(told.splitlines()) == 1, told
        assert "model/001.FCStd, model/002.FCStd" in told
    assert not (tmp_path / "exported" / "report.json").exists()
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
    when = []
    for _ in range(3):
        code, told = run(capsys, "update", path, "--out", out, *FLAGS)
        lines = [line for line in told.splitlines() if "no longer in the schedule" in line]
        members = [line for line in lines if "Member M2" in line]
        assert code == 0 and len(members) == 1 and "M2 patterns" in members[0]
        files = [out / name for name in ("model.FCStd", "model.step", "model.ifc")]
        when.append([path.stat().st_mtime_ns for path in files])
    assert when[0] == when[1] == when[2], "told again, and nothing written again"
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


def by_hand(path, label, name, words):
    """An expression for a property of an object of a saved document."""
    document = FreeCAD.openDocument(str(path), hidden=True)
    [obj] = [o for o in document.Objects if o.Label == label and hasattr(o, "BT_Type")]
    obj.setExpression(name, words)
    document.save()
    FreeCAD.closeDocument(document.Name)


def test_what_follows_an_expression_is_told_each_time_and_written_once(place, capsys):
    path, out = place
    by_hand(out / "model.FCStd", "B500", "Height", "515 mm")
    assert run(capsys, "update", path, "--out", out, *FLAGS)[0] == 0
    when = (out / "model.FCStd").stat().st_mtime_ns
    code, told = run(capsys, "update", path, "--out", out, "--remove", *FLAGS)
    assert code == 0 and "B500, property Height: Height follows an expression" in told
    assert (out / "model.FCStd").stat().st_mtime_ns == when


@pytest.mark.parametrize("command", ["update", "export"])
def test_a_member_in_error_by_hand_names_what_is_wrong_and_stops_no_other(place, capsys, command):
    """The section has no row in error: the document does, where an expression leads it."""
    path, out = place
    by_hand(out / "model.FCStd", "B500", "Height", "20 mm")
    source, target = (path, out) if command == "update" else (out / "model.FCStd", out.parent / "x")
    code, told = run(capsys, command, source, "--out", target, *FLAGS)
    errors = [line for line in told.splitlines() if line.startswith("error")]
    assert code == 1 and len(errors) == 2 and len(set(errors)) == 2, told
    for line, plate in zip(errors, ("t_top", "t_bottom")):
        # Releases write expressions with and without a space.
        assert line.replace("20 mm'", "20mm'").startswith(
            "error: B500, M1: in the document, where Height is '20mm': "
        )
        assert f"{plate} fills half the section" in line and "value 12 mm, limit 10 mm" in line
        assert line.endswith("or delete the expression to follow the schedule again")
    assert {p.name[:2] for p in (target / "plates").glob("*.dxf")} == {"M2"}
    assert (target / "model.step").exists() and has_notes(out / "model.FCStd")
