# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many items through any concurrent.futures executor; a worker that dies costs its item only."""

from __future__ import annotations

import gc
import multiprocessing
import os
import pickle
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from .collection import without_collection

WAITING_PER_WORKER = 2
"""Items handed to the pool ahead of each worker: these are looked at when a worker dies."""


@dataclass(frozen=True)
class Outcome:
    """What became of an item: its value, or what its worker failed with; packed: the value as its
    worker packed it (a pickle), empty when it was made in this process."""

    value: object = None
    failure: str = ""
    packed: bytes = b""


class Workers(Executor):
    """Worker processes that are started anew when one of them dies, with or without a fork."""

    def __init__(self, count: int, start_method: str | None = None):
        self.count = count
        self._context = multiprocessing.get_context(start_method)
        self._pool: ProcessPoolExecutor | None = None

    def submit(self, function, /, *arguments, **named) -> Future:
        if self._pool is None:
            self._pool = self._started()
        try:
            return self._pool.submit(function, *arguments, **named)
        except BrokenExecutor:
            self._pool.shutdown(wait=False)
            self._pool = self._started()
            return self._pool.submit(function, *arguments, **named)

    def shutdown(self, wait=True, *, cancel_futures=False):
        if self._pool is not None:
            self._pool.shutdown(wait=wait, cancel_futures=cancel_futures)
            self._pool = None

    def _started(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self.count, self._context, _as_worker)


def _as_worker() -> None:
    """Leave interrupts to the parent, and end with it also when it was killed."""
    # A collection would walk what the fork shares with the parent, and copy every page of it.
    gc.freeze()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_the_parent, daemon=True).start()


def _end_with_the_parent() -> None:
    multiprocessing.parent_process().join()
    os._exit(1)


@contextmanager
def workers_for(count: int | None, items: int, start_method: str | None = None):
    """Worker processes for a number of items, or None where one process will do; what still waits
    is dropped when the block fails or is interrupted. count: None for one per core."""
    count = min(count or os.cpu_count() or 1, max(items, 1))
    method = start_method or multiprocessing.get_start_method()
    # Other start methods run sys.executable, which inside FreeCAD opens another FreeCAD.
    inside_freecad = "python" not in Path(sys.executable or "").name.lower()
    if count == 1 or (inside_freecad and method != "fork"):
        yield None
        return
    executor = Workers(count, method)
    try:
        yield executor
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        raise
    executor.shutdown()


def attempts(
    function: Callable, items: Mapping[str, object], executor: Executor | None = None
) -> Iterator[tuple[str, Outcome]]:
    """(name, outcome) of function(item) for each item, as they are done.

    In this process without an executor, where function's errors are raised as they are. Through an
    executor the failure of a worker becomes the outcome of its item; when a death takes the whole
    pool along, each item that was under way is tried once more alone.
    """
    if executor is None:
        for name, item in items.items():
            yield name, Outcome(function(item))
        return
    count = getattr(executor, "count", None)
    ahead = len(items) if count is None else WAITING_PER_WORKER * count
    waiting = deque(items)
    running: dict[Future, str] = {}
    while waiting or running:
        while waiting and len(running) < ahead:
            name = waiting.popleft()
            running[executor.submit(_packed, function, items[name])] = name
        done, _ = wait(running, return_when=FIRST_COMPLETED)
        suspects = []
        for future in done:
            name = running.pop(future)
            if not future.cancelled() and isinstance(future.exception(), BrokenExecutor):
                suspects.append(name)
            else:
                yield name, _outcome(future)
        if suspects:
            suspects += running.values()
            running.clear()
        for name in sorted(suspects, key=list(items).index):
            future = executor.submit(_packed, function, items[name])
            wait([future])
            yield name, _outcome(future)


def _packed(function: Callable, item) -> bytes:
    """The value of a function, packed once for its way here and for whoever keeps it."""
    return pickle.dumps(function(item), 5)


def _outcome(future: Future) -> Outcome:
    try:
        failure = future.exception()
    except CancelledError:
        return Outcome(failure="its worker was taken away")
    if failure is None:
        packed = future.result()
        with without_collection():
            return Outcome(pickle.loads(packed), packed=packed)
    if isinstance(failure, BrokenExecutor):
        return Outcome(failure="its worker process died (out of memory, or killed)")
    return Outcome(failure=f"its worker failed: {type(failure).__name__}: {failure}")
