# SPDX-License-Identifier: LGPL-2.1-or-later
"""A split model is written back and compared as the whole it is, from the document that links to
its parts: with what meets across them, and with what no member needs."""

import json

import FreeCAD
import openpyxl
import pytest
from test_hand_work import FLAGS, run
from test_node_objects import schedule as crossing

from BendTorsionWB import make_files, project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.linked_documents import linked_documents


def with_rest(path):
    """The schedule with what no member needs: a default, a section, what the shop has cut."""
    book = openpyxl.load_workbook(path)
    for title, rows in (
        ("Settings", (("key", "value"), ("default_slope", 3), ("station_spacing", 400))),
        ("Status", (("plate", "status"), ("M1-T1", "cut"), ("M2-T1", "trim"))),
    ):
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book["Sections"].append(["S9", "box1", 300, 300, 10])
    book.save(path)
    return path


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A schedule of two members that cross, and its model with each in a document of its own."""
    folder = tmp_path_factory.mktemp("split")
    path = with_rest(crossing(folder / "s.xlsx", [["K1", "M1", "M2", None, "stub", 4, 1200, None]]))
    assert project.build(
        path, folder / "out", workers=1, wanted=project.Wanted(sheets=False, split=1)
    ).records
    return path, folder / "out" / "model.FCStd"


@pytest.fixture(autouse=True)
def none_left_open():
    """Every document a command opens is closed again, whatever becomes of it."""
    before = {*FreeCAD.listDocuments()}
    yield
    assert {*FreeCAD.listDocuments()} == before


def set_in(path, label, name, value):
    """Change a property of an object in a saved document."""
    document = FreeCAD.openDocument(str(path), hidden=True)
    try:
        [obj] = [o for o in document.Objects if o.Label == label and hasattr(o, name)]
        setattr(obj, name, value)
        document.save()
    finally:
        FreeCAD.closeDocument(document.Name)


def test_it_is_written_back_whole_and_builds_to_the_same(built, tmp_path, capsys):
    path, model = built
    assert linked_documents(model) == ("model/001.FCStd", "model/002.FCStd")
    back = tmp_path / "back.xlsx"
    code, told = run(capsys, "export", model, "--out", back)
    assert code == 0 and "0 things a schedule cannot say" in told, told
    jobs, again = (project.read_jobs(own)[1] for own in (path, back))
    assert list(again) == list(jobs) == ["M1", "M2"]
    for name, job in jobs.items():
        assert content_hash(again[name].member) == content_hash(job.member)
        assert len(again[name].meets) == 1
    # What is told of it is where the node was found to be, and no more.
    code, told = run(capsys, "diff", path, back)
    assert [line.split(":")[0] for line in told.splitlines()[:-1]] == ["nodes K1"], told
    assert run(capsys, "diff", model, back)[1].splitlines() == ["0 changes"]
    assert run(capsys, "export", model, "--out", tmp_path / "csv.csv")[0] == 0
    assert run(capsys, "diff", back, tmp_path / "csv")[1].splitlines() == ["0 changes"]


def test_it_is_compared_with_schedules_documents_and_other_divisions(built, tmp_path, capsys):
    path, model = built
    assert run(capsys, "diff", path, model)[1].splitlines() == ["0 changes"]
    assert run(capsys, "diff", model, model)[1].splitlines() == ["0 changes"]
    one = tmp_path / "one.FCStd"
    given, jobs = project.read_jobs(path)
    whole = build_document(given, jobs, sheets=True)
    parts = [build_document(given, {name: jobs[name]}, sheets=True) for name in jobs]
    whole.saveAs(str(one))
    (tmp_path / "model").mkdir()
    for number, part in enumerate(parts, start=1):
        part.saveAs(str(tmp_path / "model" / f"{number:03d}.FCStd"))
    for document in (whole, *parts):
        FreeCAD.closeDocument(document.Name)
    from BendTorsionWB.model_files import ModelPart, write_linked_model

    divided = tmp_path / "model.FCStd"
    write_linked_model([ModelPart(f"model/00{n}", (f"M{n}",)) for n in (1, 2)], divided, 1)
    # With sheets: the arrangement of each part has its own members, and that of all has all.
    assert run(capsys, "diff", one, divided)[1].splitlines() == ["0 changes"]
    assert run(capsys, "diff", divided, path)[1].splitlines() == ["0 changes"]
    set_in(tmp_path / "model" / "002.FCStd", "M2 plates", "StationSpacing", 500)
    told = run(capsys, "diff", divided, one)[1].splitlines()
    assert told == ["PlateSet M2 plates: StationSpacing 500 -> 400 (members M1, M2)", "1 change"]


def test_a_section_of_several_documents_names_the_members_of_all(built, tmp_path, capsys):
    import shutil

    path, model = built
    out = tmp_path / "out"
    shutil.copytree(model.parent, out)
    for part in ("001", "002"):
        set_in(out / "model" / f"{part}.FCStd", "S1", "Height", 820)
    told = run(capsys, "diff", model, out / "model.FCStd", "--report", tmp_path / "d.json")[1]
    assert told.splitlines()[0].startswith("SectionSpec S1: Height 800 -> 820"), told
    [change] = json.loads((tmp_path / "d.json").read_text(encoding="utf-8"))
    assert change["member"] == "M1"


def test_what_is_of_one_document_names_those_to_give(built, tmp_path, capsys):
    """On the command line and for scripts, and nothing is written."""
    model, out = built[1], tmp_path / "out"
    before = model.read_bytes()
    for words in (("export", model, "--out", out), ("report", model), ("repair", model)):
        code, told = run(capsys, *words)
        assert code == 2 and "one of these: model/001.FCStd, model/002.FCStd" in told, words
    document = FreeCAD.openDocument(str(model), hidden=True)
    try:
        with pytest.raises(BendTorsionError, match="one of these: model/001.FCStd"):
            make_files.write_schedule(document, tmp_path / "back.xlsx")
    finally:
        for name in tuple(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
    assert model.read_bytes() == before and not out.exists()
    assert not (tmp_path / "back.xlsx").exists()


@pytest.mark.parametrize("command", ["diff", "export"])
def test_documents_that_disagree_are_refused_by_name(built, tmp_path, capsys, command):
    """One section, two heights: no schedule says both, and neither may win unseen."""
    import shutil

    path, model = built
    out = tmp_path / "out"
    shutil.copytree(model.parent, out)
    set_in(out / "model" / "002.FCStd", "S1", "Height", 820)
    words = [path] if command == "diff" else ["--out", tmp_path / "back.xlsx"]
    code, told = run(capsys, command, out / "model.FCStd", *words)
    assert code == 2 and "Height is 800 in model/001.FCStd and 820 in model/002.FCStd" in told
    assert not (tmp_path / "back.xlsx").exists()
    (out / "model" / "002.FCStd").unlink()
    code, told = run(capsys, command, out / "model.FCStd", *words)
    assert code == 2 and "002.FCStd" in told and "Traceback" not in told


def test_what_no_member_needs_follows_the_schedule_in_the_model_too(tmp_path, capsys):
    path, out = with_rest(crossing(tmp_path / "s.xlsx", far=True)), tmp_path / "out"
    assert run(capsys, "build", path, "--out", out, "--split", 1, *FLAGS)[0] == 0
    parts = {own: own.read_bytes() for own in (out / "model").glob("*")}
    book = openpyxl.load_workbook(path)
    book["Status"].cell(3, 2, "scrap")
    book.save(path)
    assert run(capsys, "build", path, "--out", out, "--split", 1, *FLAGS)[0] == 0
    assert parts == {own: own.read_bytes() for own in (out / "model").glob("*")}
    back = tmp_path / "back.xlsx"
    assert run(capsys, "export", out / "model.FCStd", "--out", back)[0] == 0
    rows = openpyxl.load_workbook(back)["Status"].iter_rows(min_row=2, values_only=True)
    assert [row[:2] for row in rows] == [("M1-T1", "cut"), ("M2-T1", "scrap")]
    assert run(capsys, "diff", path, back)[1].splitlines() == ["0 changes"]
