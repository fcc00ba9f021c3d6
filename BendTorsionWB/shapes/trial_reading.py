# SPDX-License-Identifier: LGPL-2.1-or-later
"""Geometry of others read on trial in a process of its own first: Open CASCADE's readers crash or
run away on damaged files, and would take this program along.

Where processes cannot be forked (Windows), and in FreeCAD's window, the process is FreeCAD's
program without a window; only where there is none are files read without trial.
"""

from __future__ import annotations

import os
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import FreeCAD

from .trial_program import failure_in_program

try:
    import resource
except ImportError:
    resource = None

LARGEST_FILE = 500e6
"""Bytes."""
MEMORY = 4 << 30
"""Bytes a reader may take beyond what the program has."""
SHORTEST_TRIAL = 60.0
BYTES_PER_SECOND = 0.5e6
"""A reader may take SHORTEST_TRIAL seconds, and one more for each of these."""


def failure_of_file(path: Path, read: Callable[[], object]) -> str:
    """Why a file cannot be read by `read`, as `failure_of`, where processes are not forked too."""
    size = path.stat().st_size
    if size <= LARGEST_FILE and not can_fork():
        with tempfile.TemporaryDirectory() as folder:
            return failure_in_program(path.resolve(), _patience(size), Path(folder))
    return failure_of(read, size)


def can_fork() -> bool:
    """Whether this process can be forked: not on Windows, and not with a window."""
    return resource is not None and hasattr(os, "fork") and not FreeCAD.GuiUp


def _patience(size: float) -> float:
    """Seconds a reader may take."""
    return SHORTEST_TRIAL + size / BYTES_PER_SECOND


def failure_of(read: Callable[[], object], size: float) -> str:
    """Why a file of this size cannot be read: what became of the process that tried, empty when it
    was read. A failure `read` reports itself is none here."""
    if size > LARGEST_FILE:
        return f"it is larger than {LARGEST_FILE / 1e6:.0f} MB"
    seconds = _patience(size)
    child = os.fork()
    if child == 0:
        try:
            _limit()
            read()
        except MemoryError:
            os._exit(2)
        finally:
            os._exit(0)
    status = _waited_for(child, seconds)
    if status is None:
        return f"it takes longer than {seconds:.0f} s"
    if os.WIFSIGNALED(status):
        return f"the reader crashed ({signal.Signals(os.WTERMSIG(status)).name})"
    return f"it takes more than {MEMORY >> 30} GB" if os.WEXITSTATUS(status) else ""


def _limit() -> None:
    """Bound what the child may take, and keep its last words from the console."""
    # FreeCAD's own handlers would print, and an interrupt is for the parent.
    for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGFPE, signal.SIGBUS, signal.SIGILL):
        signal.signal(number, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open("/proc/self/statm", encoding="ascii") as stream:
        taken = int(stream.read().split()[0]) * resource.getpagesize()
    given = resource.getrlimit(resource.RLIMIT_AS)[1]
    most = taken + MEMORY if given == resource.RLIM_INFINITY else min(taken + MEMORY, given)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)


def _waited_for(child: int, seconds: float) -> int | None:
    """Exit status of a child; None when it had to be ended."""
    end, pause = time.monotonic() + seconds, 0.0005
    try:
        while time.monotonic() < end:
            done, status = os.waitpid(child, os.WNOHANG)
            if done:
                return status
            time.sleep(pause)
            pause = min(2.0 * pause, 0.05)
    except BaseException:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        raise
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None
