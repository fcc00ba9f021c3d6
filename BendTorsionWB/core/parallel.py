# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many items through any concurrent.futures executor; a worker that dies costs its item only."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import sys
import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from .finding import BendTorsionError, Finding, error
from .unpacking import unpacked
from .worker_processes import Workers

Made = TypeVar("Made")

WAITING_PER_WORKER = 2
"""Items handed to the pool ahead of each worker: these are looked at when a worker dies."""


@dataclass(frozen=True)
class Outcome:
    """What became of an item: its value, or the error why there is none; packed: the value as its
    worker packed it (a pickle), empty when it was made in this process; trace: where a fault of the
    program arose, empty when the worker was lost or memory ran out."""

    value: object = None
    failure: Finding | None = None
    packed: bytes = b""
    trace: str = ""


class Lasting(Executor):
    """An executor of others, which may end with one of its workers, as Python's own pool does: then
    a worker of this program's takes over."""

    def __init__(self, given: Executor):
        self._given, self._own = given, None

    def submit(self, function, /, *arguments, **named) -> Future:
        if self._own is None:
            try:
                return self._given.submit(function, *arguments, **named)
            except BrokenExecutor:
                self._own = Workers(1)
        return self._own.submit(function, *arguments, **named)

    def renew(self) -> None:
        """Of the worker that took over."""
        if self._own is not None:
            self._own.renew()

    def shutdown(self, wait=True, *, cancel_futures=False):
        """Of the worker that took over; the executor given goes on."""
        if self._own is not None:
            self._own.shutdown(wait, cancel_futures=cancel_futures)


@contextmanager
def workers_for(
    count: int | None,
    items: int,
    start_method: str | None = None,
    given: Executor | None = None,
):
    """Worker processes for a number of items, or None where one process will do. When the block
    fails what still waits is dropped, and what they are at is done before it ends; interrupted,
    they stop at once. count: None for one per core; given: an executor of others, to be used
    instead."""
    if given is not None:
        executor = Lasting(given)
        try:
            yield executor
        finally:
            executor.shutdown(cancel_futures=True)
        return
    count = min(count or os.cpu_count() or 1, max(items, 1))
    method = start_method or multiprocessing.get_start_method()
    # Other start methods run sys.executable, which inside FreeCAD opens another FreeCAD.
    inside_freecad = "python" not in Path(sys.executable or "").name.lower()
    if count == 1 or (inside_freecad and method != "fork"):
        yield None
        return
    executor = Workers(count, method)
    # Started now: a fork later on would be of all that is loaded meanwhile, each page of it copied
    # when it is touched, and without the threads that FreeCAD computes pages in.
    executor.submit(abs, 0)
    try:
        yield executor
    except KeyboardInterrupt:
        executor.stop()
        raise
    except BaseException:
        # What workers write is written while the folder is still locked.
        executor.shutdown(cancel_futures=True)
        raise
    executor.shutdown()


def attempts(
    function: Callable, items: Mapping[str, object], executor: Executor | None = None
) -> Iterator[tuple[str, Outcome]]:
    """(name, outcome) of function(item) for each item, as they are done.

    In this process without an executor. What fails becomes the outcome of its item; one whose
    worker dies is tried once more alone, as is what else was under way where the whole pool dies.
    """
    if executor is None:
        for name, item in items.items():
            yield name, _attempt(function, name, item)
        return
    count = getattr(executor, "count", None)
    renew = getattr(executor, "renew", lambda: None)
    ahead = len(items) if count is None else WAITING_PER_WORKER * count
    waiting = deque(items)
    running: dict[Future, str] = {}
    while waiting or running:
        while waiting and len(running) < ahead:
            name = waiting.popleft()
            running[executor.submit(_packed, function, name, items[name])] = name
        done, rest = wait(running, return_when=FIRST_COMPLETED)
        if any(_died(future) for future in done):
            done |= wait(rest).done
        suspects = []
        for future in done:
            name = running.pop(future)
            if _died(future):
                suspects.append(name)
            else:
                yield name, _outcome(name, future)
        for name in sorted(suspects, key=list(items).index):
            renew()
            future = executor.submit(_packed, function, name, items[name])
            wait([future])
            yield name, _outcome(name, future)
        if suspects:
            renew()


def _died(future: Future) -> bool:
    return not future.cancelled() and isinstance(future.exception(), BrokenExecutor)


def done_or(future: Future, make: Callable[[], Made]) -> Made:
    """What a worker made; made here where it was lost: its worker died, was taken away or failed.
    Raises BendTorsionError as the worker did."""
    try:
        return future.result()
    except BendTorsionError:
        raise
    except Exception:  # noqa: BLE001 - executors of others raise their own; here it tells itself
        return make()


def mapping(executor: Executor | None) -> Callable:
    """`map` through an executor; what a lost worker was at is done here."""
    return map if executor is None else partial(_mapped, executor)


def _mapped(executor: Executor, function: Callable, *columns: Iterable) -> Iterator:
    started = [(executor.submit(function, *row), row) for row in zip(*columns)]
    for future, row in started:
        yield done_or(future, partial(function, *row))


def _attempt(function: Callable, name: str, item) -> Outcome:
    try:
        return Outcome(function(item))
    except MemoryError as failure:
        mend = "build again; with fewer workers (--jobs) when memory is short"
        told = f"memory ran out: {_told(failure)}"
        return Outcome(failure=error("worker-failed", name, told, mend))
    except Exception as failure:  # noqa: BLE001 - told of its item, whatever it is
        fault = f"computing it failed: unexpected {_told(failure)}"
        report = "run again with --debug and report what it prints"
        trace = "".join(traceback.format_exception(failure))
        return Outcome(failure=error("worker-failed", name, fault, report), trace=trace)


def _packed(function: Callable, name: str, item) -> bytes | Outcome:
    """The value of a function, packed once for its way here and for whoever keeps it; of what
    failed the outcome."""
    outcome = _attempt(function, name, item)
    return outcome if outcome.failure else pickle.dumps(outcome.value, 5)


def _outcome(name: str, future: Future) -> Outcome:
    mend = "build again; with fewer workers (--jobs) when memory is short"
    try:
        made = future.result()
    except BrokenExecutor:
        told = "its worker process died (out of memory, or killed)"
        return Outcome(failure=error("worker-failed", name, told, mend))
    except CancelledError:
        told = "its worker was taken away"
        return Outcome(failure=error("worker-failed", name, told, mend))
    except Exception as failure:  # noqa: BLE001 - each executor has words of its own
        told = f"its worker was lost: {_told(failure)}"
        return Outcome(failure=error("worker-failed", name, told, mend))
    if isinstance(made, Outcome):
        return made
    return Outcome(unpacked(made), packed=made)


def _told(failure: Exception) -> str:
    return " ".join(f"{type(failure).__name__}: {failure}".rstrip(": ").split())
