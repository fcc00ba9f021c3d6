# SPDX-License-Identifier: LGPL-2.1-or-later
"""One program at a time in an output folder: a lock that the system gives back when it dies."""

from __future__ import annotations

import errno
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..core.finding import BendTorsionError, error
from .whole_file import not_written

try:
    import fcntl
except ImportError:
    fcntl = None
    import msvcrt

LOCK = ".bendtorsion.lock"
_UNKNOWN = {errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP, errno.EINVAL}
_held: set[str] = set()
_guard = threading.Lock()


@contextmanager
def locked(out: Path) -> Iterator[None]:
    """Hold a folder, made when missing, against every other program and thread that locks it.

    Raises BendTorsionError when another holds it, or the folder cannot be written to. A folder
    made for this and still empty at the end goes again. File systems without locks are taken as
    they are: there nobody is refused.
    """
    out = Path(out)
    made = [path for path in (out, *out.parents) if not os.path.lexists(path)]
    name = os.path.realpath(out)
    with _guard:
        if name in _held:
            raise _in_use(out)
        _held.add(name)
    try:
        handle = _taken(out)
        try:
            yield
        finally:
            _given_back(out / LOCK, handle)
            for path in made:
                # Only empty folders can be removed so.
                with suppress(OSError):
                    path.rmdir()
    finally:
        with _guard:
            _held.discard(name)


def _taken(out: Path) -> int:
    path = out / LOCK
    while True:
        try:
            out.mkdir(parents=True, exist_ok=True)
            handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        except OSError as failure:
            raise BendTorsionError(not_written(out, failure)) from failure
        try:
            _lock(handle)
        except OSError as failure:
            if failure.errno in _UNKNOWN:
                return handle
            os.close(handle)
            raise _in_use(out) from failure
        # The one before may have removed the file between our opening and locking it.
        with suppress(OSError):
            if _same(handle, path):
                return handle
        os.close(handle)


def _same(handle: int, path: Path) -> bool:
    return os.path.samestat(os.fstat(handle), os.stat(path))


def _lock(handle: int) -> None:
    # Record locks are of one process: workers forked from it do not keep them when it is killed.
    if fcntl is not None:
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    else:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)


def _given_back(path: Path, handle: int) -> None:
    """Remove the file while it is held; where an open file cannot go, after that."""
    with suppress(OSError):
        path.unlink()
    os.close(handle)
    if fcntl is None:
        with suppress(OSError):
            path.unlink()


def _in_use(out: Path) -> BendTorsionError:
    return BendTorsionError(
        error(
            "folder-in-use",
            str(out),
            "another build is writing into this folder",
            "wait until it is done, or choose another folder for --out",
        )
    )
