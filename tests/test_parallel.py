# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members through executors: threads, forked and spawned processes, workers that die or fail."""

import os
import pickle
import signal
import time
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing.process import BaseProcess

import pytest
from test_build import APART, schedule

from BendTorsionWB import interrupts, project
from BendTorsionWB.__main__ import main
from BendTorsionWB.console import Progress
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.parallel import (
    Workers,
    attempts,
    done_or,
    mapping,
    workers_for,
)
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.result_cache import ResultCache, key_of


def square(number):
    return number * number


def square_or_die(number):
    if number in (3, 7):
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def square_or_fail(number):
    if number == 3:
        raise MemoryError("no room")
    return number * number


NUMBERS = {str(number): number for number in range(10)}


@pytest.mark.parametrize("method", ["fork", "spawn", None])
def test_every_item_comes_back_with_its_name(method):
    with workers_for(2, 10, method) if method else workers_for(1, 10) as executor:
        assert (executor is None) == (method is None)
        found = dict(attempts(square, NUMBERS, executor))
    assert {name: outcome.value for name, outcome in found.items()} == {
        name: number**2 for name, number in NUMBERS.items()
    }


def test_items_whose_workers_die_are_told_and_the_rest_complete():
    with workers_for(2, 10) as executor:
        found = dict(attempts(square_or_die, NUMBERS, executor))
        # The pool is whole again for what comes after.
        assert executor.submit(square, 5).result() == 25
    assert {name for name, outcome in found.items() if outcome.failure} == {"3", "7"}
    assert all("died" in found[name].failure.message for name in "37")
    assert sum(outcome.value for outcome in found.values() if not outcome.failure) == 285 - 58


def test_values_come_as_their_workers_packed_them():
    assert [o.packed for _, o in attempts(square, NUMBERS)] == [b""] * 10
    with workers_for(2, 10) as executor:
        found = dict(attempts(square, NUMBERS, executor))
    assert all(pickle.loads(outcome.packed) == outcome.value for outcome in found.values())


def test_what_a_worker_packed_is_found_in_the_cache(tmp_path):
    given, jobs = _jobs(tmp_path)
    cache, keys = ResultCache(tmp_path / "cache"), {name: key_of(job) for name, job in jobs.items()}
    with workers_for(2, 2) as executor:
        made, _ = project.detail_members(given, jobs, executor, cache=cache, keys=keys)
    found = {name: cache.find(key) for name, key in keys.items()}
    assert list(found) == ["M1", "M2"] and _figures(found) == _figures(made)


@pytest.mark.parametrize("count", [1, 2])
def test_what_was_computed_before_an_interrupt_is_found_in_the_cache(tmp_path, count):
    given, jobs = _jobs(tmp_path)
    cache, keys = ResultCache(tmp_path / "cache"), {name: key_of(job) for name, job in jobs.items()}

    def progress(*_):
        os.kill(os.getpid(), signal.SIGINT)

    with interrupts.heard(), pytest.raises(KeyboardInterrupt), workers_for(count, 2) as executor:
        project.detail_members(given, jobs, executor, progress, cache, keys)
    assert len([name for name, key in keys.items() if cache.find(key)]) == 1


def test_a_worker_that_fails_is_told_with_its_reason():
    with ThreadPoolExecutor(2) as executor:
        found = dict(attempts(square_or_fail, NUMBERS, executor))
    assert "no room" in found["3"].failure.message
    assert sum(not outcome.failure for outcome in found.values()) == 9


class Unpackable(Exception):
    """An error that cannot be made again from what it packs."""

    def __init__(self, what, where):
        super().__init__(f"{what} at {where}")


def square_or_raise(number):
    if number == 3:
        raise Unpackable("a fault", "three")
    if number == 7:
        raise MemoryError
    return number * number


@pytest.mark.parametrize("count", [1, 2])
def test_what_fails_is_told_of_its_item_with_one_process_and_with_two(count):
    with workers_for(count, 10) as executor:
        found = dict(attempts(square_or_raise, NUMBERS, executor))
    assert sum(outcome.value for outcome in found.values() if not outcome.failure) == 285 - 58
    fault, memory = (found[name].failure for name in "37")
    assert fault.line() == (
        "error: 3: computing it failed: unexpected Unpackable: a fault at three -> run again with "
        "--debug and report what it prints"
    )
    assert "in square_or_raise" in found["3"].trace and not found["7"].trace
    assert "memory ran out" in memory.message and "--jobs" in memory.mend


def test_a_pool_of_others_that_ends_with_its_worker_costs_the_item_only():
    with ProcessPoolExecutor(2) as pool, workers_for(None, 10, given=pool) as executor:
        found = dict(attempts(square_or_die, NUMBERS, executor))
        assert executor.submit(square, 5).result() == 25
    assert {name for name, outcome in found.items() if outcome.failure} == {"3", "7"}
    assert sum(outcome.value for outcome in found.values() if not outcome.failure) == 285 - 58


def square_or_die_in_a_worker(number, parent):
    if number == 3 and os.getpid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def fail():
    raise LookupError("an executor's own")


def test_what_a_lost_worker_was_at_is_made_here():
    numbers = list(range(10))
    for executor in (None, Workers(2)):
        here = [os.getpid()] * 10
        found = list(mapping(executor)(square_or_die_in_a_worker, numbers, here))
        assert found == [number**2 for number in numbers]
    executor.shutdown()
    with ThreadPoolExecutor(1) as threads:
        assert done_or(threads.submit(square, 4), lambda: "here") == 16
        assert done_or(threads.submit(fail), lambda: "here") == "here"
        with pytest.raises(ZeroDivisionError):
            done_or(threads.submit(fail), lambda: 1 // 0)


def _jobs(tmp_path):
    return project.read_jobs(schedule(tmp_path / "two.xlsx", APART))


def _figures(detailed):
    return {
        name: [plate_dxf(plate) for plate in item.record.plates] for name, item in detailed.items()
    }


def test_spawned_processes_give_the_same_files(tmp_path):
    given, jobs = _jobs(tmp_path)
    with workers_for(2, 2, "spawn") as executor:
        spawned = project.compute(given, jobs, executor)
    assert _figures(spawned) == _figures(project.compute(given, jobs))


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_workers_begin_without_interrupts_and_the_program_hears_them(method, monkeypatch):
    """Python, interrupted before it is ready, tells of a fatal error."""
    blocked = []
    start = BaseProcess.start

    def started(self):
        blocked.append(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ()))
        start(self)

    monkeypatch.setattr(BaseProcess, "start", started)
    with workers_for(2, 2, method) as executor:
        assert list(executor.map(abs, (-1, -2))) == [1, 2]
    assert blocked == [True, True]
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def die(job):
    if job.member.name == "M1":
        os.kill(os.getpid(), signal.SIGKILL)
    return project.detailing.detail(job)


@pytest.mark.parametrize("at", [0, 1])
def test_a_worker_that_begins_while_the_program_is_interrupted_is_known_and_stopped(
    at, monkeypatch
):
    """One that nobody knew of was waited for at the program's end, for ever."""
    started, start = [], BaseProcess.start

    def interrupted(process):
        start(process)
        started.append(process)
        if len(started) == at + 1:
            os.kill(os.getpid(), signal.SIGINT)

    workers = Workers(2)
    monkeypatch.setattr(BaseProcess, "start", interrupted)
    with pytest.raises(KeyboardInterrupt), interrupts.heard():
        workers.renew()
    assert len(started) == 2 == len(workers.processes)
    workers.stop()
    for process in started:
        process.join(10.0)
        assert not process.is_alive()


def deaf(place):
    """What does not hear that it is to end, as code of FreeCAD's that comes back to no Python."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
    place.touch()
    time.sleep(60.0)


def test_a_worker_that_does_not_hear_that_it_is_to_end_is_killed(tmp_path, monkeypatch):
    """The program would wait for it for ever when it ends."""
    monkeypatch.setattr("BendTorsionWB.core.worker_processes.PATIENCE", 0.2)
    workers = Workers(2)
    running = workers.submit(deaf, tmp_path / "begun")
    while not (tmp_path / "begun").exists():
        time.sleep(0.01)
    workers.stop()
    assert isinstance(running.exception(timeout=10.0), BrokenExecutor)
    while workers.processes:
        time.sleep(0.01)


def test_a_member_whose_worker_dies_is_reported_and_the_rest_complete(tmp_path, monkeypatch):
    given, jobs = _jobs(tmp_path)
    monkeypatch.setattr(project, "_attempt", die)
    with workers_for(2, 2, "fork") as executor:
        detailed, lost = project.detail_members(given, jobs, executor)
        assert list(detailed) == ["M2"]
        [finding] = lost
        assert (finding.object, finding.code) == ("M1", "worker-failed") and finding.mend
        with pytest.raises(BendTorsionError):
            project.compute(given, jobs, executor)


def test_a_build_writes_the_others_and_leaves_no_files_of_the_lost_member(tmp_path, monkeypatch):
    path = schedule(tmp_path / "two.xlsx", APART)
    wanted = project.Wanted(model=False, sheets=False)
    project.build(path, tmp_path / "out", workers=2, wanted=wanted)
    monkeypatch.setattr(project, "_attempt", die)
    for place in (tmp_path / "out" / ".cache").iterdir():
        place.unlink()
    result = project.build(path, tmp_path / "out", workers=2, wanted=wanted)
    assert result.failed
    assert [bool(record.plates) for record in result.records] == [False, True]
    assert not list((tmp_path / "out").glob("*/M1*")) and list((tmp_path / "out").glob("*/M2*"))


def fail_at_the_first(job):
    if job.member.name == "M1":
        raise IndexError("a fault of ours")
    return project.detailing.detail(job)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_fault_of_the_program_costs_its_member_whatever_the_jobs(
    tmp_path, monkeypatch, capfd, jobs
):
    path = schedule(tmp_path / "two.xlsx", APART)
    monkeypatch.setattr(project, "_attempt", fail_at_the_first)
    out = tmp_path / "out"
    call = ["build", str(path), "--out", str(out), "--no-model", "--no-sheets", "--jobs", jobs]
    assert main(call) == 1
    told = capfd.readouterr().err
    assert "error: M1: computing it failed: unexpected IndexError: a fault of ours" in told
    assert "Traceback" not in told
    assert not list(out.glob("plates/M1*")) and list(out.glob("plates/M2*.dxf"))
    assert main([*call, "--debug"]) == 1
    assert "in fail_at_the_first" in capfd.readouterr().err


class Foreign(Executor):
    """An executor of another kind, as a cluster's: futures only."""

    def __init__(self):
        self.threads = ThreadPoolExecutor(1)

    def submit(self, function, /, *arguments, **named):
        return self.threads.submit(function, *arguments, **named)


def test_any_executor_will_do(tmp_path):
    path = schedule(tmp_path / "two.xlsx", APART)
    wanted = project.Wanted(model=False, sheets=False)
    result = project.build(path, tmp_path / "out", executor=Foreign(), wanted=wanted)
    assert not result.failed and len(result.records) == 2


def test_inside_freecad_no_process_is_spawned(monkeypatch):
    monkeypatch.setattr("sys.executable", "/usr/bin/FreeCAD")
    with workers_for(2, 10, "spawn") as executor:
        assert executor is None
    with workers_for(2, 10, "fork") as executor:
        assert isinstance(executor, Workers)


def test_the_remaining_time_follows_the_pace():
    now = [0.0]
    progress = Progress(clock=lambda: now[0])
    progress.quiet = False
    progress("members", 0, 100)
    assert progress.remaining(0, 100) == ""
    now[0] = 10.0
    assert progress.remaining(20, 100) == ", 0:40 left"
    now[0] = 100.0
    assert progress.remaining(50, 100) == ", 1:40 left"
    assert progress.remaining(99, 100) == "" == progress.remaining(100, 100)
