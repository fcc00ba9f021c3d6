# SPDX-License-Identifier: LGPL-2.1-or-later
"""Building again: only what changed is computed and written, and nothing stale is ever used."""

import os
import pickle
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import FreeCAD
import openpyxl
import Part
import pytest
from test_build import APART, schedule

from BendTorsionWB import ifc_fragments, member_fragments, project
from BendTorsionWB.__main__ import main
from BendTorsionWB.exchange import result_cache
from BendTorsionWB.model_files import Wanted

ROOT = Path(__file__).resolve().parent.parent
PLAIN = Wanted(sheets=False)
NO_MODEL = Wanted(model=False, sheets=False)


@pytest.fixture
def book(tmp_path):
    return schedule(tmp_path / "two.xlsx", APART)


@pytest.fixture
def computed(monkeypatch):
    """Names of the members computed."""
    names = []
    real = project._attempt

    def spy(job):
        names.append(job.member.name)
        return real(job)

    monkeypatch.setattr(project, "_attempt", spy)
    return names


def build(path, out, wanted=NO_MODEL):
    result = project.build(path, out, workers=1, wanted=wanted)
    assert not result.failed
    return result


@pytest.fixture(scope="module")
def first_builds(tmp_path_factory):
    """What the schedule gives in a new folder, built once with a model and once without."""
    folder = tmp_path_factory.mktemp("first")
    path = schedule(folder / "two.xlsx", APART)
    return {
        wanted: (build(path, folder / str(wanted.model), wanted), folder / str(wanted.model))
        for wanted in (NO_MODEL, PLAIN)
    }


@pytest.fixture
def begun(book, tmp_path, first_builds):
    """Start with a folder the schedule has been built into: the result of that build."""

    def copied(out, wanted=NO_MODEL):
        result, folder = first_builds[wanted]
        shutil.copytree(folder, out)
        return result

    return copied


def change(path, sheet, row, column, value):
    book = openpyxl.load_workbook(path)
    headings = [cell.value for cell in book[sheet][1]]
    book[sheet].cell(row, headings.index(column) + 1, value)
    book.save(path)


def state(out):
    """When each file was last put in place, the log of times apart."""
    return {
        str(p.relative_to(out)): (p.stat().st_ino, p.stat().st_mtime_ns)
        for p in out.rglob("*")
        if p.is_file() and p.name not in ("timing.json", ".bendtorsion.json")
    }


def contents(out):
    return {
        str(p.relative_to(out)): p.read_bytes()
        for p in out.rglob("*")
        if p.is_file() and p.name != "timing.json" and ".cache" not in p.parts
    }


def cached(out):
    return sorted((out / ".cache").glob("*.member"))


def test_a_second_build_computes_and_writes_nothing(book, tmp_path, computed):
    out = tmp_path / "out"
    first = build(book, out, PLAIN)
    assert computed == ["M1", "M2"]
    before = state(out)
    second = build(book, out, PLAIN)
    assert computed == ["M1", "M2"]
    assert state(out) == before
    assert [r.mass for r in second.records] == [r.mass for r in first.records]
    assert second.findings == first.findings


def test_a_changed_member_is_computed_alone_and_all_is_as_in_a_new_folder(
    book, tmp_path, computed, begun
):
    out = tmp_path / "out"
    begun(out, PLAIN)
    before = state(out)
    change(book, "Members", 4, "align", "centre")
    build(book, out, PLAIN)
    assert computed == ["M2"]
    after = state(out)
    for name in before:
        if Path(name).name.startswith("M1-"):
            assert after[name] == before[name]
    assert after["report.json"] != before["report.json"]
    assert len(cached(out)) == 2, "the former result of M2 is swept away"
    build(book, tmp_path / "anew", PLAIN)
    assert contents(out) == contents(tmp_path / "anew")


def test_of_a_changed_member_alone_rows_and_pictures_are_made_anew(book, tmp_path, monkeypatch):
    out, made, in_ifc = tmp_path / "out", [], []
    real, real_ifc = member_fragments.fragment_of, ifc_fragments.ifc_fragment

    def spy_ifc(name, assemblies):
        in_ifc.append(assemblies[0].member)
        return real_ifc(name, assemblies)

    def spy(given):
        made.append(given.record.member)
        return real(given)

    def green(value):
        """Of one member: no strain changes, so that no picture has other colours."""
        given = openpyxl.load_workbook(book)
        sheet = given["Members"]
        heads = [cell.value for cell in sheet[1]]
        column = heads.index("green_start") + 1 if "green_start" in heads else len(heads) + 1
        sheet.cell(1, column, "green_start")
        row = next(k for k in range(2, sheet.max_row + 1) if sheet.cell(k, 1).value == "M2")
        sheet.cell(row, column, value)
        given.save(book)

    monkeypatch.setattr(member_fragments, "fragment_of", spy)
    monkeypatch.setattr(ifc_fragments, "ifc_fragment", spy_ifc)
    build(book, out, PLAIN)
    assert sorted(made) == in_ifc == ["M1", "M2"]
    made.clear(), in_ifc.clear()
    green(5)
    build(book, out, PLAIN)
    assert made == in_ifc == ["M2"]
    made.clear(), in_ifc.clear()
    for kept in (out / ".cache").glob("*.fragment"):
        kept.write_bytes(kept.read_bytes()[:-1])
    green(6)
    build(book, out, PLAIN)
    assert sorted(made) == in_ifc == ["M1", "M2"], "what is damaged is as good as absent"
    build(book, tmp_path / "anew", PLAIN)
    assert contents(out) == contents(tmp_path / "anew")


def test_a_row_moved_or_another_members_section_changes_nothing_else(
    book, tmp_path, computed, begun
):
    out = tmp_path / "out"
    begun(out)
    change(book, "Sections", 3, "h", 520)
    build(book, out)
    assert computed == ["M1"], "B500 is used by M1 only"


class Bomb:
    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return (os.mkdir, (str(self.path),))


def _stamped(key, body):
    return result_cache._stamp(key, body) + b"\n" + body


@pytest.mark.parametrize("harm", ["cut", "bit", "empty", "swapped", "bomb", "other", "gone"])
def test_a_damaged_or_foreign_cache_is_not_used(book, tmp_path, computed, harm, begun):
    out = tmp_path / "out"
    first = begun(out)
    one, two = cached(out)
    content = one.read_bytes()
    trap = tmp_path / "trap"
    match harm:
        case "cut":
            one.write_bytes(content[: len(content) // 2])
        case "bit":
            one.write_bytes(content[:-500] + bytes([content[-500] ^ 1]) + content[-499:])
        case "empty":
            one.write_bytes(b"")
        case "swapped":
            one.write_bytes(two.read_bytes())
        case "bomb":
            one.write_bytes(_stamped(one.stem, pickle.dumps(Bomb(trap))))
        case "other":
            one.write_bytes(_stamped(one.stem, pickle.dumps({"plates": []})))
        case "gone":
            one.unlink()
    again = build(book, out)
    assert len(computed) == 1 and not trap.exists()
    assert [r.mass for r in again.records] == [r.mass for r in first.records]
    assert cached(out)[0].read_bytes()[:64] == _stamp_of(one)


def _stamp_of(path):
    content = path.read_bytes()
    return result_cache._stamp(path.stem, content.partition(b"\n")[2])


def test_another_program_does_not_use_these_results(book, tmp_path, computed, monkeypatch, begun):
    out = tmp_path / "out"
    begun(out)
    monkeypatch.setattr(result_cache, "program_key", lambda: "another version")
    build(book, out)
    assert computed == ["M1", "M2"]


def test_the_key_of_the_program_follows_its_source(tmp_path, monkeypatch):
    source = tmp_path / "package"
    source.mkdir()
    (source / "one.py").write_text("x = 1", encoding="utf-8")
    monkeypatch.setattr(result_cache, "_PACKAGE", source)
    first = result_cache.program_key.__wrapped__()
    (source / "one.py").write_text("x = 2", encoding="utf-8")
    assert result_cache.program_key.__wrapped__() != first


def test_a_cut_file_touched_by_hand_is_written_again(book, tmp_path, begun):
    out = tmp_path / "out"
    begun(out)
    place = next((out / "plates").glob("M1-*.dxf"))
    good = place.read_bytes()
    place.write_bytes(good + b"\n")
    next((out / "nc1").glob("M2-*.nc1")).unlink()
    build(book, out)
    assert place.read_bytes() == good
    assert len(list((out / "nc1").glob("M2-*.nc1"))) == len(list((out / "plates").glob("M2-*")))


def test_a_cache_that_cannot_be_written_costs_time_only(book, tmp_path, computed):
    out = tmp_path / "out"
    out.mkdir()
    (out / ".cache").write_text("in the way", encoding="utf-8")
    build(book, out)
    build(book, out)
    assert computed == ["M1", "M2"] * 2


def test_without_a_model_a_former_one_does_not_stay_unless_changed_by_hand(book, tmp_path, begun):
    out = tmp_path / "out"
    begun(out, PLAIN)
    build(book, out, NO_MODEL)
    assert not (out / "model.FCStd").exists() and not (out / "model.step").exists()
    build(book, out, PLAIN)
    (out / "model.FCStd").write_bytes(b"drawn over by hand")
    result = build(book, out, NO_MODEL)
    assert (out / "model.FCStd").read_bytes() == b"drawn over by hand"
    [finding] = [f for f in result.findings if f.code == "file-outdated"]
    assert finding.object == "model.FCStd" and finding.severity == "warning"


def test_a_model_changed_by_hand_is_set_aside_not_lost(book, tmp_path, begun):
    out = tmp_path / "out"
    begun(out, PLAIN)
    good = (out / "model.FCStd").read_bytes()
    (out / "model.FCStd").write_bytes(b"drawn over by hand")
    build(book, out, PLAIN)
    assert (out / "model.FCStd").read_bytes() == good
    assert (out / "model.former.FCStd").read_bytes() == b"drawn over by hand"


def test_a_split_model_links_to_a_document_per_group_and_only_a_changed_one_is_written(
    book, tmp_path
):
    out = tmp_path / "out"
    result = build(book, out, Wanted(sheets=False, split=1))
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    try:
        links = {link.Label: link for link in document.Objects}
        counts = {label: len(Part.getShape(link).Solids) for label, link in links.items()}
        assert counts == {r.member: len(r.plates) for r in result.records}
    finally:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
    before = state(out)
    change(book, "Members", 4, "align", "centre")
    build(book, out, Wanted(sheets=False, split=1))
    changed = {name for name, when in state(out).items() if before.get(name) != when}
    models = {name for name in changed if name.startswith("model")}
    assert {"model/002.FCStd", "model/002.step"} <= models
    assert all(name.startswith("model/002.") for name in models)
    build(book, out, PLAIN)
    assert not list((out / "model").iterdir()) and (out / "model.step").exists()


def test_an_interrupted_build_leaves_whole_files_and_goes_on_later(book, tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-m", "BendTorsionWB", "build", book, "--out", out, "--jobs", "2"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        start_new_session=True,
    )
    try:
        for line in process.stderr:
            if line.startswith(("sheets", "model")):
                break
        time.sleep(0.3)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130 and "Traceback" not in errors
    assert "whole" in errors
    assert not [p for p in out.rglob("*") if ".part" in p.name]
    for place in out.rglob("*.FCStd"):
        assert zipfile.ZipFile(place).testzip() is None
    assert len(cached(out)) == 2, "what was computed need not be again"


def test_quiet_prints_nothing_when_all_is_good(book, tmp_path, capsys):
    arguments = ["build", book, "--out", tmp_path / "out", "--jobs", 1, "--quiet"]
    assert main([str(a) for a in [*arguments, "--no-model", "--no-sheets"]]) == 0
    printed = capsys.readouterr()
    assert printed.out == "" and printed.err == ""
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert {"nc1", "plates", "report.json", "results.xlsx"} <= names
    assert not names & {"sheets", "model.FCStd", "model.step"}
