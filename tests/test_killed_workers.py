# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers killed at any moment: what they were at is made again, and the end comes."""

import json
import os
import pickle
import signal
import struct
import subprocess
import sys
import threading
import time
from concurrent.futures import BrokenExecutor
from multiprocessing.connection import Connection

import killed_workers
import pytest

from BendTorsionWB.core.parallel import Workers, attempts, done_or, workers_for

LIMIT = 30
"""Seconds a test may take that takes 1."""


@pytest.fixture(autouse=True)
def ends():
    """Stops what waits for ever."""

    def stop(*_):
        raise TimeoutError("waits for ever")

    former = signal.signal(signal.SIGALRM, stop)
    signal.alarm(LIMIT)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, former)


def doubled(content, seconds=0.0):
    time.sleep(seconds)
    return content * 2


def kill(executor, count=1):
    for pid in executor.processes[:count]:
        os.kill(pid, signal.SIGKILL)


@pytest.mark.parametrize("count", [1, 2])
def test_calls_larger_than_a_pipe_hold_no_end_back(count):
    content = bytes(300_000)
    with workers_for(2, 40) as executor:
        started = [executor.submit(doubled, content, 0.04) for _ in range(40)]
        started[3].result()
        kill(executor, count)
        started[-1].exception()
        started.append(executor.submit(doubled, content))
        made = [done_or(future, lambda: b"here") for future in started]
    lost = made.count(b"here")
    assert all(one in (b"here", content * 2) for one in made)
    # With a worker left nothing but what the other was at.
    assert lost == 1 if count == 1 else lost >= 2


def begin_to_answer():
    """The worker dies with the beginning of its answer written."""

    def half(self, content):
        os.write(self.fileno(), struct.pack("!i", len(content)) + content[:5])
        os.kill(os.getpid(), signal.SIGKILL)

    Connection._send_bytes = half


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_half_an_answer_is_waited_for_by_nobody(method):
    executor = Workers(2, method)
    futures = [executor.submit(begin_to_answer)]
    futures += [executor.submit(doubled, b"a", 0.02) for _ in range(9)]
    with pytest.raises(BrokenExecutor):
        futures[0].result()
    assert [future.result() for future in futures[1:]] == [b"aa"] * 9
    executor.shutdown()


def test_idle_workers_that_die_cost_nothing():
    executor = Workers(2)
    assert executor.submit(doubled, 2).result() == 4
    kill(executor)
    time.sleep(0.1)
    assert [executor.submit(doubled, k).result() for k in range(6)] == [0, 2, 4, 6, 8, 10]
    executor.shutdown()


def test_without_any_worker_left_work_is_told_to_be_lost_at_once():
    executor = Workers(2)
    futures = [executor.submit(doubled, k, 0.2) for k in range(20)]
    kill(executor, 2)
    found = [done_or(future, lambda: "here") for future in futures]
    assert found.count("here") >= 18
    assert executor.processes == []
    assert isinstance(executor.submit(doubled, 1).exception(), BrokenExecutor)
    assert len(dict(attempts(doubled, {"a": 1}, executor))) == 1
    executor.renew()
    assert len(executor.processes) == 2 and executor.submit(doubled, 4).result() == 8
    executor.shutdown()


@pytest.mark.parametrize("room", [1, 0])
def test_without_room_for_processes_fewer_do_the_work_or_none(monkeypatch, room):
    fork, forked = os.fork, []

    def full():
        if len(forked) == room:
            raise BlockingIOError(11, "Resource temporarily unavailable")
        forked.append(fork())
        return forked[-1]

    monkeypatch.setattr(os, "fork", full)
    with workers_for(3, 9, "fork") as executor:
        assert len(executor.processes) == room
        found = dict(attempts(doubled, {str(k): k for k in range(6)}, executor))
        if room:
            kill(executor)
            time.sleep(0.1)
            found |= dict(attempts(doubled, {"after": 4}, executor))
    lost = {name for name, outcome in found.items() if outcome.failure}
    assert lost == ({"after"} if room else {*map(str, range(6))})
    assert all("--jobs" in found[name].failure.mend for name in lost)


def test_members_are_made_again_at_any_moment_of_a_kill():
    items = {str(k): bytes([k]) * 100_000 for k in range(24)}
    with workers_for(2, len(items)) as executor:
        found = {}
        for count, (name, outcome) in enumerate(attempts(doubled, items, executor)):
            found[name] = outcome.value
            if count in (0, 5, 11):
                kill(executor, 1 + count % 2)
        assert len(executor.processes) == 2
    assert found == {name: item * 2 for name, item in items.items()}


def test_what_cannot_be_sent_is_told_and_the_worker_goes_on():
    with workers_for(2, 4) as executor:
        here, there = executor.submit(doubled, lambda: 0), executor.submit(threading.Lock)
        assert isinstance(here.exception(), (pickle.PicklingError, AttributeError))
        assert "pickle" in str(there.exception())
        assert len(executor.processes) == 2 and executor.submit(doubled, 3).result() == 6


def test_what_waits_is_dropped_when_the_block_fails():
    with pytest.raises(LookupError), workers_for(2, 40) as executor:
        futures = [executor.submit(doubled, k, 0.1) for k in range(40)]
        raise LookupError
    begun = [future for future in futures if not future.cancelled()]
    assert len(begun) <= 4
    assert [future.result() for future in begun] == [2 * k for k in range(len(begun))]


def test_what_is_begun_when_the_block_fails_is_done_at_its_end():
    # Workers write files: no later than whoever locked their folder lets go of it.
    with pytest.raises(LookupError), workers_for(2, 40) as executor:
        futures = [executor.submit(doubled, k, 0.2) for k in range(40)]
        futures[0].result()
        raise LookupError
    assert all(future.done() for future in futures)
    assert any(future.cancelled() for future in futures)


KILLS = (
    "members:0.1:1",
    "members:0.3:2",
    "revision:0:1",
    "document:0:1",
    "document:0.2:2",
    "step:0:2",
    "ifc:0:1",
    "save:0:2",
    "files:0:2",
    "package:0:1",
    "results:0:2",
)


@pytest.fixture(scope="module")
def every(tmp_path_factory):
    """Of each build with a kill how it ended and which of its files differ."""
    folder = tmp_path_factory.mktemp("killed")
    command = [sys.executable, killed_workers.__file__, str(folder), *KILLS]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr[-4000:]
    return {kill: rest for kill, *rest in map(json.loads, done.stdout.splitlines())}


@pytest.mark.slow
def test_a_kill_at_any_stage_changes_no_file(every):
    assert list(every) == ["", *KILLS]
    assert {kill: rest for kill, rest in every.items() if rest != ["", []]} == {}
