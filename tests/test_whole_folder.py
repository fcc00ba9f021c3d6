# SPDX-License-Identifier: LGPL-2.1-or-later
"""One build at a time in a folder; what a killed one left; full disks, names too long or unfit."""

import csv
import os
import pickle
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import FreeCAD
import openpyxl
import pytest
from kill_scenarios import POINTS
from test_build import schedule

from BendTorsionWB import member_files, model_files, project, solid_files
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.parallel import Workers
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange import csv_folder, folder_lock
from BendTorsionWB.exchange.file_name import file_name, is_device
from BendTorsionWB.exchange.folder_lock import LOCK, locked
from BendTorsionWB.exchange.output_folder import (
    JOURNAL,
    OutputFolder,
    OwnFile,
    is_unfinished,
    read_manifest,
    write_manifest,
)
from BendTorsionWB.exchange.schedule_cells import BadCell, Name
from BendTorsionWB.exchange.schedule_writer import write_schedule
from BendTorsionWB.exchange.whole_file import part_beside, whole_file, write_whole
from BendTorsionWB.model_files import Wanted

ROOT = Path(__file__).parent.parent
NO_MODEL = Wanted(model=False, sheets=False)
HOLD = """
import sys
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from BendTorsionWB.exchange.folder_lock import locked
with locked(Path(sys.argv[2])):
    print("held", flush=True)
    sys.stdin.read()
"""


def codes(problem):
    return [finding.code for finding in problem.value.findings]


def holder(out):
    """Another program that holds the folder."""
    child = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(ROOT), str(out)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    assert child.stdout.readline() == "held\n"
    return child


def test_two_programs_in_one_folder_refuse_each_other_and_a_killed_one_holds_nothing(tmp_path):
    out = tmp_path / "out"
    child = holder(out)
    path = schedule(tmp_path / "s.xlsx", [POINTS])
    for action in (
        lambda: project.build(path, out, workers=1, wanted=NO_MODEL),
        lambda: project.issue_folder(out, "A"),
    ):
        with pytest.raises(BendTorsionError) as problem:
            action()
        assert codes(problem) == ["folder-in-use"]
    assert [p.name for p in out.iterdir()] == [LOCK]
    child.kill()
    child.communicate()
    with locked(out):
        assert (out / LOCK).exists()
    # The folder was not made by this one, so it stays.
    assert list(out.iterdir()) == []


def test_a_program_that_ends_well_gives_its_folder_back(tmp_path):
    child = holder(tmp_path / "a" / "b")
    child.communicate("")
    assert child.returncode == 0 and not (tmp_path / "a").exists()


def test_one_program_does_not_enter_its_own_folder_twice(tmp_path):
    out = tmp_path / "out"
    with locked(out):
        with pytest.raises(BendTorsionError) as problem, locked(tmp_path / "x" / ".." / "out"):
            pass
        assert codes(problem) == ["folder-in-use"]
        with locked(tmp_path / "other"):
            (tmp_path / "other" / "kept").write_text("", encoding="utf-8")
    assert not out.exists() and (tmp_path / "other" / "kept").exists()


def test_a_file_system_without_locks_refuses_nobody(tmp_path, monkeypatch):
    def none(*_):
        raise OSError(folder_lock.errno.ENOLCK, "no locks")

    monkeypatch.setattr(folder_lock, "_lock", none)
    with locked(tmp_path / "out"):
        assert (tmp_path / "out" / LOCK).exists()
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("others", [0, 1])
def test_workers_end_with_a_program_that_is_killed(others):
    """Of several workers too: each holds the pipes of those before it."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            pool = Workers(1 + others, "fork")
            tasks = [pool.submit(time.sleep, 0.2) for _ in range(1 + others)]
            [task.result() for task in tasks]
            processes = pool.processes
            os.write(write, " ".join(map(str, processes)).encode())
            time.sleep(60)
        finally:
            os._exit(1)
    pids = [int(word) for word in os.read(read, 100).split()]
    assert len(pids) >= 1
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    end = time.monotonic() + 20
    while any(alive(pid) for pid in pids) and time.monotonic() < end:
        time.sleep(0.02)
    os.close(read), os.close(write)
    assert not any(alive(pid) for pid in pids)


def alive(pid):
    try:
        return (
            Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]
            != "Z"
        )
    except OSError:
        return False


def test_files_of_a_killed_build_are_known_to_the_next_one(tmp_path):
    """Also to one of another schedule, which no longer makes them: a shop would cut them."""
    killed = OutputFolder(tmp_path, {}, "Hall")
    killed.write("plates/M1-T1.dxf", b"one", "key", "M1")
    killed.begin("model.step")
    write_whole(tmp_path / "model.step", b"solid")
    (tmp_path / "plates" / ".M1-T2.123.part.dxf").write_bytes(b"half")
    (tmp_path / "plates" / "notes.txt").write_bytes(b"not ours")
    with open(tmp_path / JOURNAL, "a", encoding="utf-8") as stream:
        stream.write('{"name": "plates/M1-T')
    assert is_unfinished(tmp_path)
    known = read_manifest(tmp_path)
    assert set(known) == {"plates/M1-T1.dxf", "model.step"}
    with pytest.raises(BendTorsionError):
        from BendTorsionWB.exchange.output_folder import check_project

        check_project(tmp_path, "Bridge")
    folder = OutputFolder(tmp_path, known, "Hall")
    assert folder.has("plates/M1-T1.dxf", "key") and not folder.has("model.step", "key")
    folder.write("plates/M2-T1.dxf", b"two", "key", "M2")
    folder.close()
    left = {p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*") if p.is_file()}
    # What was begun may have been changed since; it is told and stays.
    assert left == {"plates/M2-T1.dxf", "plates/notes.txt", ".bendtorsion.json", "model.step"}


def test_a_file_begun_and_not_written_is_still_known_as_it_was(tmp_path):
    first = OutputFolder(tmp_path, {})
    first.write("a.txt", b"old", "key one")
    first.close()
    killed = OutputFolder(tmp_path, read_manifest(tmp_path))
    killed._note("a.txt", OwnFile("", "key two", "0" * 64))
    assert OutputFolder(tmp_path, read_manifest(tmp_path)).has("a.txt", "key one")


def test_documents_set_aside_are_never_written_over(tmp_path):
    for text in ("first", "second", "third"):
        (tmp_path / "model.FCStd").write_text(text, encoding="utf-8")
        OutputFolder(tmp_path, {}).save_by_hand("model.FCStd")
    found = {p.name: p.read_text(encoding="utf-8") for p in tmp_path.iterdir()}
    assert found == {
        "model.former.FCStd": "first",
        "model.former-2.FCStd": "second",
        "model.former-3.FCStd": "third",
    }


def test_an_unfinished_build_is_not_issued(tmp_path):
    path = schedule(tmp_path / "s.xlsx", [POINTS])
    project.build(path, tmp_path / "out", workers=1, wanted=NO_MODEL)
    OutputFolder(tmp_path / "out", read_manifest(tmp_path / "out")).begin("report.html")
    with pytest.raises(BendTorsionError) as problem:
        project.issue_folder(tmp_path / "out", "A")
    assert codes(problem) == ["issue-nothing"]
    project.build(path, tmp_path / "out", workers=1, wanted=NO_MODEL)
    assert project.issue_folder(tmp_path / "out", "A").number == 1
    # A killed issue is none.
    part = part_beside(tmp_path / "out" / "issued" / "B")
    (tmp_path / "out" / "issued" / "A").rename(part)
    assert project.issue_folder(tmp_path / "out", "A").number == 1


@pytest.mark.parametrize("name", ["../out of it", "plates/../../out of it", "/tmp/x", "a\0b"])
def test_nothing_is_written_outside_the_folder(tmp_path, name):
    folder = OutputFolder(tmp_path / "out", {})
    for action in (lambda: folder.write(name, b"x", ""), lambda: folder.begin(name)):
        with pytest.raises(BendTorsionError) as problem:
            action()
        assert codes(problem) == ["file-outside"]
    assert not (tmp_path / "out of it").exists()


def test_links_that_lead_out_of_the_folder_are_not_followed(tmp_path):
    """Neither as folders nor as files, as the record of an earlier build has them either."""
    out, other = tmp_path / "out", tmp_path / "other"
    other.mkdir()
    (other / "kept.dxf").write_bytes(b"theirs")
    (out / "nc1").mkdir(parents=True)
    (out / "plates").symlink_to(other)
    (out / "nc1" / "kept.nc1").symlink_to(other / "kept.dxf")
    (out / "inside").symlink_to(out / "nc1")
    folder = OutputFolder(out, {})
    for name in ("plates/M1.dxf", "plates/kept.dxf", "nc1/kept.nc1", "inside/kept.nc1"):
        with pytest.raises(BendTorsionError) as problem:
            folder.write(name, b"ours", "")
        assert codes(problem) == ["file-outside"], name
    folder.write("inside/M1.nc1", b"ours", "")
    assert (out / "nc1" / "M1.nc1").read_bytes() == b"ours"
    assert (other / "kept.dxf").read_bytes() == b"theirs" and len(list(other.iterdir())) == 1
    names = ["plates/M1.dxf", "nc1/kept.nc1", "nc1/M1.nc1", "../other/kept.dxf", "", "a\0b"]
    write_manifest(out, dict.fromkeys(names, OwnFile("M1")))
    assert set(read_manifest(out)) == {"nc1/M1.nc1", "inside/M1.nc1"}


@pytest.mark.parametrize(
    ("folder", "name"),
    [
        ("with blanks in it", "a b.xlsx"),
        ("上海 音乐厅", "构件表.xlsx"),
        ("x" * 100, "y" * 95 + ".xlsx"),
    ],
)
def test_a_build_in_a_folder_of_any_name_writes_what_it_writes_elsewhere(tmp_path, folder, name):
    if len(folder) < 100:
        project.build(schedule(tmp_path / "plain.xlsx", [POINTS]), tmp_path / "plain", workers=1)
    place = tmp_path / folder
    place.mkdir()
    out = place / ("out " + "z" * 30)
    wanted = Wanted(sheets=False) if len(folder) == 100 else Wanted()
    result = project.build(schedule(place / name, [POINTS]), out, workers=1, wanted=wanted)
    assert not result.failed
    if len(folder) < 100:
        names = [
            sorted(p.relative_to(o).as_posix() for p in o.rglob("*") if p.is_file())
            for o in (out, tmp_path / "plain")
        ]
        assert names[0] == names[1]
        for path in ("model.step", "model.FCStd", "sheets/M1.pdf", "nc1/M1-T1.nc1"):
            assert (out / path).read_bytes() == (tmp_path / "plain" / path).read_bytes()


def test_a_name_of_nearly_255_bytes_can_be_written(tmp_path):
    path = tmp_path / ("n" * 250 + ".txt")
    write_whole(path, b"x")
    assert path.read_bytes() == b"x"


def test_a_read_only_file_stays_whoever_writes(tmp_path):
    """Its folder lets another take its place, and root may write to all: neither is asked."""
    path = tmp_path / "issued.xlsx"
    path.write_bytes(b"issued")
    path.chmod(0o444)
    with pytest.raises(BendTorsionError) as raised, whole_file(path) as part:
        part.write_bytes(b"new")
    (finding,) = raised.value.findings
    assert (finding.code, finding.object) == ("file-not-written", str(path))
    assert "read-only" in finding.message and "another name" in finding.mend
    assert path.read_bytes() == b"issued" and list(tmp_path.iterdir()) == [path]
    path.chmod(0o644)
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"


ONTO_A_FULL_DISK = """
import resource, sys
from BendTorsionWB import freecad_path
freecad_path.append()
from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
size, path, out = sys.argv[1:]
resource.setrlimit(resource.RLIMIT_FSIZE, (int(size), int(size)))
try:
    project.build(path, out, workers=1)
except BendTorsionError as problem:
    sys.exit({finding.code for finding in problem.findings} != {"file-not-written"})
sys.exit(3)
"""


def test_a_full_disk_is_named_and_what_was_there_stays(tmp_path):
    """The system's limit on the size of files stands for the end of the disk."""
    path = schedule(tmp_path / "s.xlsx", [POINTS])
    out = tmp_path / "out"
    project.build(path, out, workers=1)
    before = {p: p.read_bytes() for p in out.rglob("*") if p.is_file() and ".cache" not in p.parts}
    book = openpyxl.load_workbook(path)
    book["Sections"]["C3"] = 480
    book.save(path)
    for size in (2000, 60000):
        # No fork: a build before may have left threads behind that the child lacks.
        command = [sys.executable, "-c", ONTO_A_FULL_DISK, str(size), str(path), str(out)]
        assert subprocess.run(command, cwd=ROOT).returncode == 0
        for file, content in before.items():
            now = file.read_bytes()
            assert now == content or len(now) <= size, file
        assert not [p for p in out.rglob("*") if ".part" in p.name or p.name == LOCK]
    assert not project.build(path, out, workers=1).failed


WRITERS = {
    "document": lambda document, record, path: model_files.save(document, path),
    "linked model": lambda document, record, path: model_files.write_linked_model(
        model_files.model_parts(["M1"], 1), path, 1
    ),
    "STEP": lambda document, record, path: solid_files.write_step(document, ["M1"], path),
    "sheets": lambda document, record, path: write_whole(
        path, member_files.sheets_pdf((record, SheetStyle()))
    ),
    "schedule": lambda document, record, path: write_schedule({"Members": [["member"]]}, path),
}


@pytest.mark.parametrize("what", WRITERS)
def test_writers_that_do_not_tell_of_a_full_disk_are_not_believed(tmp_path, what):
    schedule_, jobs = project.read_jobs(schedule(tmp_path / "s.xlsx", [POINTS]))
    record = project.compute(schedule_, jobs)["M1"].record
    document = build_document(schedule_, jobs, False)
    try:
        document.recompute()
        path = tmp_path / f"file{ {'schedule': '.xlsx', 'STEP': '.step'}.get(what, '.FCStd') }"
        WRITERS[what](document, record, path)
        size, before = path.stat().st_size, path.read_bytes()
        for part in (0.05, 0.6, 0.999):
            child = os.fork()
            if child == 0:
                code = 3
                try:
                    resource.setrlimit(resource.RLIMIT_FSIZE, (int(size * part),) * 2)
                    WRITERS[what](document, record, path)
                except BendTorsionError as problem:
                    code = 0 if {f.code for f in problem.findings} == {"file-not-written"} else 4
                finally:
                    os._exit(code)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0, part
            assert path.read_bytes() == before
    finally:
        FreeCAD.closeDocument(document.Name)


def test_what_a_writer_does_not_tell_of_a_failure_the_system_does(tmp_path):
    """Open CASCADE says no more than that it cannot open a file."""
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    found = {}
    for name, size in (("full", 1000), ("free", usual[0])):
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, usual[1]))
            with pytest.raises(BendTorsionError) as raised, whole_file(tmp_path / "a.step"):
                raise OSError("Cannot open file")
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, usual)
        found[name] = raised.value.findings[0]
        assert not list(tmp_path.iterdir())
    assert found["full"].mend.startswith("free space on the disk")
    assert "Cannot open file" in found["free"].message


def test_a_folder_that_only_reads_or_cannot_be_looked_into_is_refused_by_name():
    with tempfile.TemporaryDirectory() as name:
        base = Path(name)
        base.chmod(0o755)
        path = schedule(base / "s.xlsx", [POINTS])
        (base / "read only").mkdir(mode=0o555)
        (base / "closed").mkdir(mode=0o000)
        for out in (base / "read only", base / "read only" / "out", base / "closed" / "out"):
            child = os.fork()
            if child == 0:
                code = 3
                try:
                    if os.getuid() == 0:
                        os.setuid(65534)
                    project.build(path, out, workers=1, wanted=NO_MODEL)
                except BendTorsionError as problem:
                    code = 0 if [f.code for f in problem.findings] == ["file-not-written"] else 4
                finally:
                    os._exit(code)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0, out
        (base / "closed").chmod(0o755)


def test_errors_of_workers_come_back_whole():
    problem = BendTorsionError([error("file-not-written", "a", "is full", "free it")])
    assert pickle.loads(pickle.dumps(problem)).findings == problem.findings


def test_csv_written_over_another_schedule_leaves_no_sheet_of_it(tmp_path):
    csv_folder.write_folder(tmp_path, {"Members": [["member"], ["M1"]], "Splits": [["member"]]})
    (tmp_path / "own notes.txt").write_text("mine", encoding="utf-8")
    csv_folder.write_folder(tmp_path, {"Members": [["member"], ["M2"]]})
    assert {p.name for p in tmp_path.iterdir()} == {"Members.csv", "own notes.txt"}
    # Cut short while its files are copied, the folder is read as what was to be in it.
    (tmp_path / csv_folder.WHOLE).mkdir()
    write_whole(tmp_path / csv_folder.WHOLE / "Members.csv", b"member\nM3\n")
    book = csv_folder.read_folder(tmp_path)
    assert [row[0] for row in book["Members"].iter_rows(values_only=True)] == ["member", "M3"]
    with open(tmp_path / "Members.csv", newline="", encoding="utf-8-sig") as stream:
        assert list(csv.reader(stream))[1] == ["M2"]


@pytest.mark.parametrize("name", ["CON", "nul.1", "Com1", "aux", "LPT9", "a/b", "../x", ".x", "x."])
def test_names_that_are_no_file_names_are_refused_and_replaced(name):
    with pytest.raises(BadCell):
        Name(names_files=True)(name)
    made = file_name(name)
    assert Name(names_files=True)(made) == made and made != name


def test_made_file_names_differ_where_texts_differ():
    texts = ["Dach", "a/b", "a:b", "a_b", "x" * 300, "x" * 301, "", "..", "COM1", "上海"]
    made = [file_name(text) for text in texts]
    assert len(set(made)) == len(texts) and made[0] == "Dach" and made[-1] == "上海"
    assert all(len(name) < 90 and not is_device(name) for name in made)
