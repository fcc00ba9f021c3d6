# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ctrl-C at many moments: the program stops, says so, and leaves nothing half done."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import FreeCAD
import openpyxl
import pytest
from killed_writes import VARYING, content, leftovers
from test_build import APART, schedule

from BendTorsionWB import __main__, document_update, interrupts, make
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.exchange.whole_file import write_whole
from BendTorsionWB.model_files import checked_recompute
from BendTorsionWB.objects.proxy import Proxy, findings_of

ROOT = Path(__file__).resolve().parent.parent
STOPPED = f"{__main__.STOPPED}\n"


@pytest.fixture
def listening():
    """As during a command."""
    with interrupts.heard():
        yield


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def test_an_interrupt_outside_a_call_comes_at_once(listening):
    with pytest.raises(KeyboardInterrupt):
        interrupt()


def test_one_inside_a_call_comes_at_its_end_or_at_a_safe_point_before(listening):
    done = []
    with pytest.raises(KeyboardInterrupt), interrupts.to_the_end():
        interrupt()
        interrupt()
        done.append("call")
        assert interrupts.asked()
        interrupts.stop_if_asked()
        done.append("after")
    assert done == ["call"]


class _Lost:
    """Ends with an exception, which Python cannot raise there."""

    def __init__(self, problem, cause=None):
        self.problem, self.cause = problem, cause

    def __del__(self):
        raise self.problem from self.cause


@pytest.mark.parametrize(
    ("problem", "cause", "told"),
    [
        (KeyboardInterrupt(), None, False),
        (SystemError("returned a result with an exception set"), KeyboardInterrupt(), False),
        (SystemError("of its own"), None, True),
        (SystemError("of its own"), ValueError(), True),
    ],
)
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_one_that_cannot_be_raised_is_not_printed(problem, cause, told, monkeypatch, capfd):
    """As of those that come while Python collects what nobody uses; other faults are."""
    monkeypatch.setattr(sys, "unraisablehook", __main__._swallowed)
    lost = _Lost(problem, cause)
    del lost
    assert ("of its own" in capfd.readouterr().err) is told


def test_one_that_was_swallowed_comes_again_before_a_file_is_put_in_its_place(listening, tmp_path):
    place = tmp_path / "a.txt"
    place.write_bytes(b"old")
    try:
        interrupt()
    except KeyboardInterrupt:
        pass
    with pytest.raises(KeyboardInterrupt):
        write_whole(place, b"new")
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"] and place.read_bytes() == b"old"


def test_without_a_command_the_handler_there_was_is_back_and_nothing_is_remembered():
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt), interrupts.to_the_end():
        interrupt()
    assert signal.getsignal(signal.SIGINT) is before and not interrupts.asked()


def test_interrupts_that_are_to_be_ignored_are():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interrupts.heard(), interrupts.to_the_end():
            interrupt()
        assert not interrupts.asked()
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("background", [False, True], ids=["terminal", "background"])
def test_a_request_to_end_is_told_as_stopped_also_where_interrupts_are_ignored(
    monkeypatch, capsys, background
):
    """As in the background of a script, whose shell has Ctrl-C ignored."""
    done = []

    def held(_):
        with interrupts.to_the_end():
            os.kill(os.getpid(), signal.SIGTERM)
            done.append("call")
        done.append("after")

    monkeypatch.setitem(__main__._COMMANDS, "build", held)
    # Without the handler the tests themselves would end here.
    default = signal.signal(signal.SIGTERM, signal.SIG_DFL)
    ignored = signal.SIG_IGN if background else signal.getsignal(signal.SIGINT)
    before = signal.signal(signal.SIGINT, ignored)
    try:
        assert __main__.main(["build", "a.xlsx", "--out", "out"]) == 130
        assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    finally:
        signal.signal(signal.SIGINT, before)
        signal.signal(signal.SIGTERM, default)
    assert capsys.readouterr().err == STOPPED and done == ["call"]


def test_objects_after_an_interrupt_are_not_computed_and_never_look_it(listening, monkeypatch):
    document = FreeCAD.newDocument("stopped", hidden=True)
    built = []
    real = Proxy.execute

    def execute(self, obj):
        if not built:
            interrupt()
        built.append(obj.Label)
        real(self, obj)

    try:
        # FreeCAD keeps the method an object is made with.
        monkeypatch.setattr(Proxy, "execute", execute)
        surface = make.make_surface(document, "Roof", "sphere", r=20e3)
        make.make_surface(document, "Other", "sphere", r=30e3)
        with pytest.raises(KeyboardInterrupt):
            checked_recompute(document)
        assert set(built) == {"Roof", "Other"}
        [finding] = findings_of(surface)
        assert finding.code == "stopped" and not surface.Shape.Faces
    finally:
        FreeCAD.closeDocument(document.Name)


@pytest.mark.parametrize(
    "swallowed", [BendTorsionError(error("object-invalid", "M1", "bad", "mend it")), OSError("x")]
)
def test_a_fault_an_interrupt_leaves_is_told_as_stopped(monkeypatch, capsys, tmp_path, swallowed):
    def failing(*_, **__):
        try:
            interrupt()
        except KeyboardInterrupt:
            raise swallowed from None

    monkeypatch.setitem(__main__._COMMANDS, "build", failing)
    assert __main__.main(["build", "a.xlsx", "--out", str(tmp_path / "out")]) == 130
    assert capsys.readouterr().err == STOPPED


def test_a_command_that_swallows_an_interrupt_and_ends_has_stopped_too(monkeypatch, capsys):
    def ending(_):
        interrupt()
        return 0

    # `new` opens documents: interrupts wait for its safe points.
    monkeypatch.setitem(__main__._COMMANDS, "new", ending)
    assert __main__.main(["new"]) == 130
    assert capsys.readouterr().err == STOPPED


def changed(book, path):
    """The schedule with another alignment of M2."""
    workbook = openpyxl.load_workbook(book)
    sheet = workbook["Members"]
    columns = [cell.value for cell in sheet[1]]
    sheet.cell(4, columns.index("align") + 1, "centre")
    workbook.save(path)
    return path


def started(*words):
    return subprocess.Popen(
        [sys.executable, "-u", "-m", "BendTorsionWB", *map(str, words)],
        cwd=ROOT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        start_new_session=True,
        # A shell's background would hand down that it is ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A schedule built, another one, and what an update by that gives; seconds it takes."""
    folder = tmp_path_factory.mktemp("interrupts")
    book = schedule(folder / "two.xlsx", APART)
    other = changed(book, folder / "other.xlsx")
    assert __main__.main(["build", str(book), "--out", str(folder / "out"), "--quiet"]) == 0
    shutil.copytree(folder / "out", folder / "clean")
    begun = time.monotonic()
    assert started("update", other, "--out", folder / "clean", "--quiet").wait(120) == 0
    return book, other, folder, time.monotonic() - begun


@pytest.mark.slow
@pytest.mark.parametrize("command", ["build", "update"])
def test_stopped_at_any_moment_the_folder_is_whole_and_the_next_run_does_the_rest(
    built, tmp_path, command
):
    """The moments are spread over a run; one after the other in one folder, as users try again."""
    book, other, folder, seconds = built
    out = tmp_path / "out"
    shutil.copytree(folder / "out", out)
    before, after = content(folder / "out"), content(folder / "clean")
    stopped = 0
    for share in (0.2, 0.35, 0.5, 0.6, 0.7, 0.8):
        process = started(command, other, "--out", out)
        try:
            time.sleep(share * seconds)
            os.killpg(process.pid, signal.SIGINT)
            if share > 0.5 and process.poll() is None:
                time.sleep(0.1)
                os.killpg(process.pid, signal.SIGINT)
            _, errors = process.communicate(timeout=60)
        finally:
            process.kill()
        if process.returncode == 0:
            # It was done before: the machine is less busy than when it was timed.
            seconds *= 0.5
            shutil.rmtree(out)
            shutil.copytree(folder / "out", out)
            continue
        stopped += 1
        assert process.returncode == 130, errors
        assert errors.endswith(STOPPED), errors
        assert "error" not in errors and "Traceback" not in errors, errors
        assert not [name for name in leftovers(out) if ".part" in name or "lock" in name]
        if command == "update":
            now = content(out)
            models = [name for name in before if name.startswith("model")]
            assert models
            assert [n for n in models if now[n] not in (before[n], after[n])] == []
    assert stopped >= 3
    shutil.rmtree(out)
    if command == "update":
        shutil.copytree(folder / "out", out)
    process = started(command, other, "--out", out)
    time.sleep(0.6 * seconds)
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=60)
    assert __main__.main([command, str(other), "--out", str(out), "--quiet"]) == 0
    if command == "build":
        shutil.rmtree(tmp_path / "new", ignore_errors=True)
        assert __main__.main(["build", str(other), "--out", str(tmp_path / "new"), "--quiet"]) == 0
        after = content(tmp_path / "new")
    now = content(out)
    names = {n for n in now.keys() | after.keys() if not n.endswith(VARYING)}
    assert [n for n in sorted(names) if now.get(n) != after.get(n)] == []


@pytest.fixture
def stops_update(built, tmp_path, monkeypatch, capsys):
    """Called with an owner and the name of its method, or a module and that of its function, at
    each call of which an interrupt comes: an update stops, and the document stays as it was."""
    _, other, folder, _ = built
    out = tmp_path / "out"

    def stops(owner, name):
        shutil.copytree(folder / "out", out)
        before = content(out)
        real = getattr(owner, name)

        def interrupted(*given):
            interrupt()
            return real(*given)

        monkeypatch.setattr(owner, name, interrupted)
        command = ["update", str(other), "--out", str(out), "--quiet", "--jobs", "1"]
        assert __main__.main(command) == 130
        assert capsys.readouterr().err == STOPPED
        assert content(out)["model.FCStd"] == before["model.FCStd"]

    return stops


def test_an_update_interrupted_while_a_document_opens_is_no_fault_of_the_document(stops_update):
    """What FreeCAD calls while it opens one swallows what is raised there."""
    stops_update(Proxy, "onDocumentRestored")
    for name in list(FreeCAD.listDocuments()):
        FreeCAD.closeDocument(name)


def test_an_update_interrupted_while_values_are_copied_keeps_the_document(stops_update):
    stops_update(document_update, "same")
