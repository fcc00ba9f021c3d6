# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs something in a child process that dies at its n-th write, and says what it left behind.

A point is: a file opened for writing, a write (also cut in the middle), a rename, a removal, a
folder made, a change of mode, and the same within FreeCAD's own writers, where the system kills
the child when a file passes a size.
"""

import builtins
import io
import os
import resource
import signal
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from BendTorsionWB import ifc_fragments, model_files, step_fragments

SIZES = (None, 1000, 20000, 60000)
"""Bytes at which a writer of FreeCAD is stopped: at its start, then within its file."""


@dataclass(frozen=True)
class Run:
    """A finished child. killed: whether at a point; points: how many it passed; failure: what it
    raised, as text."""

    killed: bool
    points: int
    failure: str = ""


class _Points:
    def __init__(self, last, report):
        self.count, self.last, self.report = 0, last, report

    def here(self, cut=None):
        """A point: the child dies here when it is the last one; `cut` is done before that."""
        self.count += 1
        if self.count == self.last:
            if cut is not None:
                cut()
            self.die()

    def die(self):
        os.kill(os.getpid(), signal.SIGKILL)


class _Stream:
    """A file open for writing: before and in the middle of its first, second, fourth, eighth, …
    write are points."""

    def __init__(self, stream, points):
        self._stream, self._points, self._count = stream, points, 0

    def write(self, content):
        self._count += 1
        if self._count & (self._count - 1):
            return self._stream.write(content)
        self._points.here()

        def half():
            self._stream.write(content[: len(content) // 2])
            self._stream.flush()

        self._points.here(half)
        return self._stream.write(content)

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def __enter__(self):
        self._stream.__enter__()
        return self

    def __exit__(self, *problem):
        return self._stream.__exit__(*problem)

    def __iter__(self):
        return iter(self._stream)


def _counted(real, points):
    def counted(*given, **named):
        points.here()
        return real(*given, **named)

    return counted


def _hook(points):
    """Every way this process writes, from now on, passes points."""
    for name in ("replace", "rename", "unlink", "remove", "mkdir", "rmdir", "chmod", "fsync"):
        setattr(os, name, _counted(getattr(os, name), points))
    real_open = builtins.open

    def opened(file, mode="r", *given, **named):
        if not set(mode) & set("wax+"):
            return real_open(file, mode, *given, **named)
        points.here()
        return _Stream(real_open(file, mode, *given, **named), points)

    builtins.open = io.open = opened

    @contextmanager
    def native():
        armed = False
        for size in SIZES:

            def stop_at(size=size):
                signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

            points.count += 1
            if points.count == points.last:
                if size is None:
                    points.die()
                stop_at()
                armed = True
        yield
        if armed:
            points.die()

    for module in (model_files, step_fragments, ifc_fragments):
        module.to_the_end = native


def run(action, kill_at=0, limit=120):
    """Run action() in a child; kill_at: the point it dies at, 0 for none. limit: seconds of a
    processor, and ten times as many by the clock of a machine that is busy."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        code = 70
        try:
            os.close(read)
            signal.setitimer(signal.ITIMER_PROF, limit)
            signal.alarm(10 * limit)
            with open(os.devnull, "w", encoding="utf-8") as nothing:
                os.dup2(nothing.fileno(), 1)
                if kill_at:
                    os.dup2(nothing.fileno(), 2)
            points = _Points(kill_at, write)
            _hook(points)
            failure = ""
            try:
                action()
            except BaseException as problem:  # noqa: BLE001 - told to the parent
                failure = f"{type(problem).__name__}: {problem}"
            os.write(write, f"{points.count}\n{failure}".encode("utf-8", "replace")[:60000])
            code = 0
        finally:
            os._exit(code)
    os.close(write)
    with open(read, "rb") as stream:
        told = stream.read().decode("utf-8", "replace")
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        name = os.WTERMSIG(status)
        assert name in (signal.SIGKILL, signal.SIGXFSZ), f"died of signal {name}"
        return Run(True, kill_at)
    assert os.WEXITSTATUS(status) == 0 and told, f"ended with {status}"
    count, _, failure = told.partition("\n")
    return Run(False, int(count), failure)


VARYING = ("timing.json", ".bendtorsion.json")
"""Times, and the record of the folder, which knows both what was and what is to be."""
OWN = {".bendtorsion.lock", ".bendtorsion.journal"}


def content(folder):
    """{name: bytes} of the files of a folder; the cache and unfinished files apart."""
    found = {}
    for path in sorted(Path(folder).rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and path.name not in OWN and ".cache" not in name.split("/"):
            if not any(part.startswith(".") and ".part" in part for part in name.split("/")):
                found[name] = path.read_bytes()
    return found


def leftovers(folder):
    """Names of unfinished files, locks and journals in a folder."""
    names = [p.name for p in Path(folder).rglob("*")]
    return [n for n in names if n in OWN or (n.startswith(".") and ".part" in n)]


def faults(before, after, now):
    """What is wrong with a folder after a kill: neither as before nor as it would be after."""
    wrong = []
    for name in {*before, *after, *now}:
        if name.endswith(VARYING) or "/.whole/" in name:
            continue
        allowed = {before.get(name), after.get(name)}
        if now.get(name) in allowed:
            continue
        aside = now.get(name.replace(".FCStd", ".former.FCStd"))
        if name in now and ".former" in name and now[name] in (*before.values(), *after.values()):
            continue
        if name not in now and aside is not None and aside == before.get(name):
            continue
        wrong.append(f"{name}: {'missing' if name not in now else 'neither old nor new'}")
    return wrong


if sys.platform == "win32":
    raise ImportError("killed_writes needs fork")
