# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands on documents: export, report, writing back; and what is refused in one line."""

import json
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from test_build import APART, schedule

from BendTorsionWB import arguments, project
from BendTorsionWB.__main__ import main
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.project import Wanted


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A schedule, its build, and its document as saved."""
    folder = tmp_path_factory.mktemp("line")
    path = schedule(folder / "two.xlsx", APART)
    project.build(path, folder / "out", workers=1, wanted=Wanted(sheets=False))
    return path, folder / "out"


def report(out):
    return json.loads((out / "report.json").read_text(encoding="utf-8"))


def test_export_writes_the_files_of_the_document_as_it_is(built, tmp_path, capsys):
    _, out = built
    flags = ["--no-sheets", "--jobs", "1"]
    same = tmp_path / "same"
    assert main(["export", str(out / "model.FCStd"), "--out", str(same), *flags]) == 0
    for name in sorted(p.relative_to(out) for p in out.glob("plates/*.dxf")):
        assert (same / name).read_bytes() == (out / name).read_bytes()
    assert report(same)["members"] == report(out)["members"]
    assert (same / "model.step").exists() and not (same / "model.FCStd").exists()
    # An edit by hand is what is exported; no schedule has a say.
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    section = next(o for o in document.Objects if o.Label == "B500")
    section.Height = 520
    document.saveCopy(str(tmp_path / "edited.FCStd"))
    section.Height = 20
    document.saveCopy(str(tmp_path / "broken.FCStd"))
    FreeCAD.closeDocument(document.Name)
    edited = tmp_path / "edited"
    assert main(["export", str(tmp_path / "edited.FCStd"), "--out", str(edited), *flags]) == 0
    masses = [[m["mass_kg"] for m in report(o)["members"]] for o in (out, edited)]
    assert masses[1][0] > masses[0][0] and masses[1][1] == masses[0][1]
    capsys.readouterr()
    broken = tmp_path / "broken"
    assert main(["export", str(tmp_path / "broken.FCStd"), "--out", str(broken), *flags]) == 1
    assert "B500" in capsys.readouterr().err
    assert [bool(m["plates"]) for m in report(broken)["members"]] == [False, True]
    assert not list(broken.glob("*/M1*")) and list(broken.glob("plates/M2*"))


def test_a_second_export_leaves_the_cut_files_as_they_are(built, tmp_path):
    _, out = built
    for _ in range(2):
        arguments = ["export", out / "model.FCStd", "--out", tmp_path / "x", "--no-sheets"]
        assert main([str(a) for a in [*arguments, "--jobs", 1, "--only", "M2"]]) == 0
        when = {p: p.stat().st_mtime_ns for p in (tmp_path / "x").glob("plates/*")}
    arguments = [str(a) for a in [*arguments, "--jobs", 1, "--only", "M2"]]
    assert main(arguments) == 0
    assert {p: p.stat().st_mtime_ns for p in when} == when and when


def test_report_of_a_schedule_and_of_its_document_tell_the_same(built, tmp_path, capsys):
    path, out = built
    tables = []
    for source in (path, out / "model.FCStd"):
        target = tmp_path / f"{source.stem}.json"
        assert main(["report", str(source), "--jobs", "1", "--report", str(target)]) == 0
        tables.append(capsys.readouterr().out)
        assert json.loads(target.read_text(encoding="utf-8"))["members"] == report(out)["members"]
    assert tables[0] == tables[1] and "M1" in tables[0]
    assert main(["report", str(path), "--only", "M2", "--report", str(tmp_path / "r.xlsx")]) == 0
    assert openpyxl.load_workbook(tmp_path / "r.xlsx")["Summary"]["A2"].value == "M2"


@pytest.mark.parametrize("name", ["back.xlsx", "back.csv"])
def test_export_to_a_workbook_writes_the_document_back(built, tmp_path, capsys, name):
    path, out = built
    assert main(["export", str(out / "model.FCStd"), "--out", str(tmp_path / name)]) == 0
    assert "0 things" in capsys.readouterr().out
    target = tmp_path / (name if name.endswith("xlsx") else "back")
    assert main(["diff", str(path), str(target)]) == 0
    assert capsys.readouterr().out == "0 changes\n"


@pytest.mark.parametrize("command", ["export", "report", "diff", "update", "build", "check"])
def test_what_is_not_there_is_one_line_and_exit_2(tmp_path, capsys, command):
    missing = str(tmp_path / "none.FCStd")
    arguments = {
        "export": ["export", missing, "--out", str(tmp_path / "out")],
        "report": ["report", missing],
        "diff": ["diff", missing, missing],
        "update": ["update", str(tmp_path / "none.xlsx"), "--out", str(tmp_path / "out")],
        "build": ["build", str(tmp_path / "none.xlsx"), "--out", str(tmp_path / "out")],
        "check": ["check", str(tmp_path / "none")],
    }[command]
    assert main(arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == "" and len(printed.err.splitlines()) == 1 and "none" in printed.err
    assert not (tmp_path / "out").exists()


def test_a_document_that_is_none_or_holds_no_member_is_one_line(tmp_path, capsys):
    bad = tmp_path / "bad.FCStd"
    bad.write_bytes(b"PK\x03\x04 not a document")
    assert main(["report", str(bad)]) == 2
    empty = FreeCAD.newDocument("empty", hidden=True)
    empty.saveAs(str(tmp_path / "empty.FCStd"))
    FreeCAD.closeDocument(empty.Name)
    assert main(["report", str(tmp_path / "empty.FCStd")]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2 and all(line.startswith("error") for line in lines)


def test_two_members_of_one_name_in_a_document_and_in_a_schedule(tmp_path, capsys):
    path = schedule(tmp_path / "two.xlsx", APART)
    book = openpyxl.load_workbook(path)
    book["Members"]["A4"] = "M1"
    book.save(path)
    assert main(["check", str(path)]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert "segment 1 of M1 is already in row 2" in line and "another name" in line
    assert "two members share the name, or the segment is given twice, in rows 2 and 4" in line


def test_a_cycle_of_links_is_named_and_nothing_stale_is_exported(tmp_path, capsys):
    given, jobs = project.read_jobs(schedule(tmp_path / "two.xlsx", APART))
    document = build_document(given, jobs, sheets=False)
    axis = next(o for o in document.Objects if o.Label == "A1")
    member = next(o for o in document.Objects if o.Label == "M1")
    file = document.addObject("Part::Feature", "Loop")
    axis.Source = (file, [""])
    file.Shape = Part.makeLine((0, 0, 0), (1, 0, 0))
    file.addProperty("App::PropertyLink", "Back")
    file.Back = member
    document.saveAs(str(tmp_path / "loop.FCStd"))
    FreeCAD.closeDocument(document.Name)
    out = tmp_path / "out"
    code = main(["export", str(tmp_path / "loop.FCStd"), "--out", str(out), "--no-sheets"])
    printed = capsys.readouterr().err
    assert code == 2 and not list(out.glob("*"))
    assert {line.split(":")[1].strip() for line in printed.splitlines()} >= {"A1", "M1", "Loop"}
    assert "in a cycle of" in printed


@pytest.mark.parametrize("name", ["results.xlsx", "report.json"])
def test_a_results_file_that_cannot_be_replaced_is_one_line(tmp_path, capsys, name, monkeypatch):
    """Another program holds it open (as on Windows): the former file stays whole."""
    import os

    path = schedule(tmp_path / "two.xlsx", APART)
    out = tmp_path / "out"
    arguments = ["build", str(path), "--out", str(out), "--jobs", "1", "--no-model", "--no-sheets"]
    assert main(arguments) == 0
    before = (out / name).read_bytes()
    shutil.rmtree(out / ".cache")
    book = openpyxl.load_workbook(path)
    book["Sections"]["C3"] = 520
    book.save(path)
    real = os.replace

    def locked(source, target):
        if str(target).endswith(name):
            raise PermissionError(13, "Permission denied")
        real(source, target)

    monkeypatch.setattr(os, "replace", locked)
    capsys.readouterr()
    assert main(arguments) == 1
    [line] = [x for x in capsys.readouterr().err.splitlines() if x.startswith("error")]
    assert name in line and "close the program" in line
    assert (out / name).read_bytes() == before
    monkeypatch.undo()
    assert main(arguments) == 0
    assert read_schedule(path) and (out / name).read_bytes() != before


def test_a_full_disk_is_one_line_and_leaves_whole_files(tmp_path, capsys, monkeypatch):
    from pathlib import Path

    path = schedule(tmp_path / "two.xlsx", APART)
    out = tmp_path / "out"
    real, room = Path.write_bytes, [5]  # the record of the folder, then four plates

    def full(self, data):
        if ".part" in self.name and ".cache" not in self.parts:
            room[0] -= 1
            if room[0] < 0:
                real(self, data[: len(data) // 2])
                raise OSError(28, "No space left on device")
        return real(self, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    arguments = ["build", str(path), "--out", str(out), "--jobs", "1", "--no-model", "--no-sheets"]
    assert main(arguments) == 1
    [line] = [x for x in capsys.readouterr().err.splitlines() if x.startswith("error")]
    assert "No space left" in line and "free space" in line
    assert not [p for p in out.rglob("*") if ".part" in p.name]
    assert len(list(out.glob("plates/*"))) == 4
    monkeypatch.undo()
    assert main(arguments) == 0


def test_a_full_disk_while_the_model_is_saved_leaves_the_former_one(built, tmp_path, monkeypatch):
    from BendTorsionWB.core.finding import BendTorsionError
    from BendTorsionWB.model_files import save

    document = FreeCAD.newDocument("full", hidden=True)
    try:
        save(document, tmp_path / "model.FCStd")
        before = (tmp_path / "model.FCStd").read_bytes()
        monkeypatch.setattr(
            "BendTorsionWB.model_files.timeless_document",
            lambda part, shown: (_ for _ in ()).throw(OSError(28, "No space left on device")),
        )
        with pytest.raises(BendTorsionError) as problem:
            save(document, tmp_path / "model.FCStd")
        assert "No space left" in problem.value.findings[0].message
        assert (tmp_path / "model.FCStd").read_bytes() == before
        assert [p.name for p in tmp_path.iterdir()] == ["model.FCStd"]
    finally:
        FreeCAD.closeDocument(document.Name)


def test_a_member_that_is_not_there_is_told_with_the_nearest_name(built, capsys):
    path, out = built
    for source in (path, out / "model.FCStd"):
        assert main(["report", str(source), "--only", "m2,Rib"]) == 2
        name = "model" if source.suffix == ".FCStd" else source.name
        assert capsys.readouterr().err.splitlines() == [
            f"error: {name}: there is no such member (value m2, limit M1, M2) -> did you mean M2?",
            f"error: {name}: there is no such member (value Rib, limit M1, M2) "
            "-> use names of its members",
        ]


def test_a_fault_of_the_program_is_one_line_and_debug_tells_where(tmp_path, capsys, monkeypatch):
    def broken(*given, **named):
        raise ZeroDivisionError("a fault of ours")

    monkeypatch.setattr(project, "build", broken)
    call = ["build", str(tmp_path / "s.xlsx"), "--out", str(tmp_path / "out")]
    assert main(call) == 1
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and "ZeroDivisionError" in told and "--debug" in told
    assert main([*call, "--debug"]) == 1
    told = capsys.readouterr().err
    assert "Traceback" in told and "in broken" in told


def test_warnings_of_numpy_are_for_debug_alone(tmp_path, monkeypatch):
    def overflowing(*given, **named):
        return np.float64(1e300) * np.array([1e300])

    monkeypatch.setattr(project, "build", overflowing)
    call = ["build", str(tmp_path / "s.xlsx"), "--out", str(tmp_path / "out")]
    for options, count in (([], 0), (["--debug"], 1)):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            main([*call, *options])
        assert len(told) == count


def test_names_of_files_that_cannot_be_are_told_before_anything_is_computed(tmp_path, capsys):
    path = schedule(tmp_path / "two.xlsx", APART)
    for name in ("loop", "loop.FCStd"):
        (tmp_path / name).symlink_to(tmp_path / name)
    before = sorted(tmp_path.iterdir())
    for words, told in (
        (["report", path, "--report", tmp_path / "r.txt"], "r.txt"),
        (["report", path, "--report", tmp_path / "r.csv"], ".xlsx, .json"),
        (["diff", path, path, "--report", tmp_path / "r.pdf"], ".xlsx, .csv, .json"),
        (["export", path, "--out", tmp_path / "out"], ".FCStd"),
        (["build", path, "--out", tmp_path / "out", "--status", "no.csv"], "no such file"),
        (["build", tmp_path / "loop", "--out", tmp_path / "out"], "leads back to itself"),
        (["report", tmp_path / "loop.FCStd"], "leads back to itself"),
        (["new", "--template", "member"], "--out is missing"),
        (["new", "--out", tmp_path / "new.FCStd"], "--template is missing"),
    ):
        assert main([str(word) for word in words]) == 2, words
        printed = capsys.readouterr()
        [line] = printed.err.splitlines()
        assert line.startswith("error") and told in line, words
        assert "members" not in printed.out or words[0] == "new"
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("command", ["build", "update", "check", "report", "export"])
@pytest.mark.parametrize("names", ["", " , "])
def test_no_name_of_a_member_is_not_all_of_them(tmp_path, capsys, command, names):
    words = [command, str(tmp_path / "two.xlsx"), "--only", names]
    words += ["--out", str(tmp_path / "out")] if command in ("build", "update", "export") else []
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    assert "--only: names no member" in capsys.readouterr().err


def test_every_command_and_option_is_in_the_documentation():
    """And no other is."""
    text = (Path(__file__).parent.parent / "docs/projects.md").read_text(encoding="utf-8")
    rows = [line.split("|") for line in text.splitlines() if line.startswith("| `")]
    told = {word for row in rows for word in re.findall(r"`(--[a-z-]+|[a-z]+)\b", row[1])}
    [commands] = [a for a in arguments.parser()._actions if a.dest == "command"]
    options = {
        option
        for command in commands.choices.values()
        for action in command._actions
        for option in action.option_strings
        if option.startswith("--") and option != "--help"
    }
    # Of one command and told with it.
    elsewhere = {"--out", "--rev", "--note", "--template", "--report"}
    missing = (set(commands.choices) | options) - elsewhere - told
    assert not missing
    assert {word for word in told if word.startswith("--")} - elsewhere <= options
    assert "$ python3" not in text and "`python3" not in text


def test_ctrl_c_while_the_program_starts_is_one_line():
    """Before any file is read: modules are being imported."""
    words = (
        "import builtins, runpy, sys; real = builtins.__import__\n"
        "def stopped(name, *rest, **more):\n"
        "    if name == 'argparse':\n"
        "        raise KeyboardInterrupt\n"
        "    return real(name, *rest, **more)\n"
        "builtins.__import__ = stopped; sys.argv[1:] = ['new']\n"
        "runpy.run_module('BendTorsionWB', run_name='__main__')\n"
    )
    process = subprocess.run(
        [sys.executable, "-c", words],
        cwd=Path(__file__).resolve().parent.parent,
        capture_output=True,
        encoding="utf-8",
    )
    assert process.returncode in (130, -2)
    assert process.stderr == "stopped; files already written are whole\n"
