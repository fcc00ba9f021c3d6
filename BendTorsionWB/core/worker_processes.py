# SPDX-License-Identifier: LGPL-2.1-or-later
"""Worker processes with pipes of their own: whichever is killed, at whatever moment, costs what it
was at and nothing else.

Python's own pool has one queue of calls and one of results for all its workers. A worker killed
while it writes leaves half a result that is waited for, and calls nobody reads any more hold the
pool's end back, both for ever. Here the end of a pipe tells the end of its worker.
"""

from __future__ import annotations

import atexit
import gc
import multiprocessing
import os
import pickle
import queue
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

RESULT_SIZE = 1 << 20
"""Bytes; a member of twenty plates has 600,000. As much as systems allow usually."""
PLENTY = 2
"""Calls waiting for each worker from which on one has the next handed over while it is at another:
fewer are better left to whoever is free first."""
PATIENCE = 5.0
"""Seconds for a worker that is told to end; one deep in code of FreeCAD does not hear it."""


@dataclass(frozen=True)
class _Worker:
    process: BaseProcess
    calls: Connection
    answers: Connection


@dataclass
class _Call:
    future: Future
    function: Callable
    arguments: tuple
    named: Mapping[str, object]
    begun: bool = False

    def begins(self) -> bool:
        """Whether it is still wanted."""
        self.begun = self.begun or self.future.set_running_or_notify_cancel()
        return self.begun

    def drop(self) -> None:
        """It will not be made."""
        if self.future.cancel():
            self.future.set_running_or_notify_cancel()
        else:
            self.lose()

    def lose(self) -> None:
        """Nobody is left that makes it."""
        if self.begins():
            self.future.set_exception(BrokenProcessPool("the worker process died"))


class Workers(Executor):
    """Worker processes, with or without a fork. Their number is made whole by `renew` only: a fork
    lacks the threads that FreeCAD computes in once it has begun, and would wait for them. What the
    last worker leaves raises BrokenProcessPool."""

    def __init__(self, count: int, start_method: str | None = None):
        self.count = count
        self._context = multiprocessing.get_context(start_method)
        self._changed = threading.Condition()
        self._waiting: deque[_Call] = deque()
        self._workers: list[_Worker] = []
        self._threads: list[threading.Thread] = []
        self._started = self._closed = False

    @property
    def processes(self) -> list[int]:
        """Process numbers of the workers there are."""
        with self._changed:
            return [worker.process.pid for worker in self._workers]

    def submit(self, function, /, *arguments, **named) -> Future:
        if not self._started:
            self.renew()
        call = _Call(Future(), function, arguments, named)
        with self._changed:
            if self._closed:
                raise RuntimeError("workers that were shut down take no more calls")
            if self._workers:
                self._waiting.append(call)
                self._changed.notify()
                return call.future
        call.lose()
        return call.future

    def renew(self) -> None:
        """Start a worker for each that is missing, as far as the system has room for processes."""
        with self._changed:
            if not self._started:
                # Before Python waits for all processes that are left.
                atexit.register(self.shutdown, wait=False, cancel_futures=True)
                self._started = True
            # A worker that nobody knows of would not be stopped, and be waited for.
            with _later():
                self._start_missing()

    def _start_missing(self) -> None:
        new = []
        with suppress(OSError, MemoryError):
            while len(self._workers) + len(new) < self.count:
                new.append(self._start())
        self._threads = [thread for thread in self._threads if thread.is_alive()]
        for worker in new:
            thread = threading.Thread(target=self._serve, args=(worker,), daemon=True)
            thread.start()
            # Not before: one without a thread would be waited for.
            self._workers.append(worker)
            self._threads.append(thread)

    def shutdown(self, wait=True, *, cancel_futures=False):
        with self._changed:
            self._closed = True
            dropped = list(self._waiting) if cancel_futures else []
            if cancel_futures:
                self._waiting.clear()
            self._changed.notify_all()
        for call in dropped:
            call.drop()
        for thread in self._threads if wait else ():
            thread.join()
        atexit.unregister(self.shutdown)

    def stop(self) -> None:
        """Drop everything, what the workers are at as well: they remove what they have in temporary
        folders, and end. One that does not within PATIENCE is killed: this program would wait for
        it when it ends."""
        self.shutdown(wait=False, cancel_futures=True)
        with self._changed:
            for worker in self._workers:
                worker.process.terminate()
        until = time.monotonic() + PATIENCE
        for thread in self._threads:
            thread.join(max(until - time.monotonic(), 0.0))
        with self._changed:
            for worker in self._workers:
                worker.process.kill()

    def _start(self) -> _Worker:
        given, calls = self._context.Pipe(duplex=False)
        answers, made = self._context.Pipe(duplex=False)
        _widen(answers)
        process = self._context.Process(target=_work, args=(given, made))
        with _uninterrupted():
            process.start()
        # The worker's alone, so that its death ends them; those that are forked later have neither.
        given.close()
        made.close()
        return _Worker(process, calls, answers)

    def _serve(self, worker: _Worker) -> None:
        """Give a worker its calls, one after the other, until there are no more or it is lost."""
        under_way: deque[_Call] = deque()
        try:
            while self._hand_over(worker, under_way):
                answer = worker.answers.recv_bytes()
                answered = under_way.popleft()
                try:
                    self._hand_over(worker, under_way, idle=False)
                finally:
                    _settle(answered.future, answer)
            worker.calls.send_bytes(b"")
        except (OSError, EOFError, MemoryError):
            worker.process.kill()
        finally:
            self._ended(worker, under_way)

    def _hand_over(self, worker: _Worker, under_way: deque, idle: bool = True) -> bool:
        """Send calls, while plenty wait one more than the worker is at; idle: wait for the first.
        Whether the worker has any."""
        while call := self._next(len(under_way), idle):
            try:
                packed = pickle.dumps((call.function, call.arguments, call.named), 5)
            except Exception as failure:  # noqa: BLE001 - told to whoever asks for the result
                call.future.set_exception(failure)
                continue
            try:
                worker.calls.send_bytes(packed)
            except BaseException:
                # Not there as a whole, so not begun.
                self._put_back([call])
                raise
            under_way.append(call)
        return bool(under_way)

    def _next(self, under_way: int, idle: bool) -> _Call | None:
        with self._changed:
            while True:
                enough = PLENTY * self.count if under_way else 1
                while under_way < 2 and len(self._waiting) >= enough:
                    call = self._waiting.popleft()
                    if call.begins():
                        return call
                if under_way or not idle or self._closed:
                    return None
                self._changed.wait()

    def _put_back(self, calls: list[_Call]) -> None:
        with self._changed:
            self._waiting.extendleft(reversed(calls))
            self._changed.notify_all()

    def _ended(self, worker: _Worker, under_way: deque) -> None:
        """The worker is gone: what it was at is lost, what it had besides is for the others."""
        for end in (worker.calls, worker.answers):
            end.close()
        worker.process.join()
        lost = [under_way.popleft()] if under_way else []
        self._put_back(list(under_way))
        with self._changed:
            self._workers.remove(worker)
            if not self._workers:
                lost += self._waiting
                self._waiting.clear()
        for call in lost:
            call.lose()


@contextmanager
def _later() -> Iterator[None]:
    """Signals that ask this program to stop are heard after the block."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    former = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    # One that is not Python's could not be put back.
    former = {number: handler for number, handler in former.items() if handler is not None}
    for number in former:
        signal.signal(number, lambda heard, _: came.append(heard))
    try:
        yield
    finally:
        for number, handler in former.items():
            signal.signal(number, handler)
        for number in came:
            signal.raise_signal(number)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """What begins meanwhile hears no interrupts: Python, interrupted before it is ready, tells of a
    fatal error. This program hears them after."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _settle(future: Future, answer: bytes) -> None:
    try:
        made, value = pickle.loads(answer)
    except Exception as failure:  # noqa: BLE001 - told to whoever asks for the result
        made, value = False, failure
    if made:
        future.set_result(value)
    else:
        future.set_exception(value)


def _widen(answers: Connection) -> None:
    """Let a whole result into the pipe, where that can be: a worker would wait with the rest of it
    until its parent is done with what came before."""
    try:
        import fcntl

        fcntl.fcntl(answers.fileno(), fcntl.F_SETPIPE_SZ, RESULT_SIZE)
    except (ImportError, AttributeError, OSError):
        return


def _work(calls: Connection, answers: Connection) -> None:
    """Answer calls until there are no more. Interrupts are left to the parent, and a worker ends
    with it also when it was killed."""
    # A collection would walk what the fork shares with the parent, and copy every page of it.
    gc.freeze()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _stop)
    threading.Thread(target=_end_with_the_parent, daemon=True).start()
    # Taken in at once: the parent would wait with a call, and leave the answer before it unread.
    waiting: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_take_in, args=(calls, waiting), daemon=True).start()
    try:
        while packed := waiting.get():
            answers.send_bytes(_answer(packed))
    except _Stopped:
        os._exit(1)


class _Stopped(BaseException):
    """Raised in a worker that is to end at once."""


def _stop(*_) -> None:
    # Qt would tell of pages left half drawn.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    raise _Stopped


def _end_with_the_parent() -> None:
    multiprocessing.parent_process().join()
    os._exit(1)


def _take_in(calls: Connection, waiting: queue.SimpleQueue) -> None:
    with suppress(OSError, EOFError):
        while packed := calls.recv_bytes():
            waiting.put(packed)
    waiting.put(b"")


def _answer(packed: bytes) -> bytes:
    try:
        function, arguments, named = pickle.loads(packed)
        return pickle.dumps((True, function(*arguments, **named)), 5)
    except _Stopped:
        raise
    except BaseException as failure:  # noqa: BLE001 - raised where the result is asked for
        return _failed(failure)


def _failed(failure: BaseException) -> bytes:
    try:
        packed = pickle.dumps((False, failure), 5)
        pickle.loads(packed)
    except Exception:  # noqa: BLE001 - what cannot be sent is told
        return pickle.dumps((False, RuntimeError(f"{type(failure).__name__}: {failure}")), 5)
    return packed
