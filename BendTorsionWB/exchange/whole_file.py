# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files appear whole or not at all: written beside their place, then moved into it."""

from __future__ import annotations

import errno
import os
import re
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..core.finding import BendTorsionError, Finding, error
from ..interrupts import stop_if_asked
from .issued_folder import is_issued

LONGEST_STEM = 40
ANY_WRITE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_TRIED = 1_000_000
"""Bytes written to learn what stops a file."""
_PART = re.compile(r"\..*\.[0-9]+\.part(\..*)?", re.DOTALL)
_MENDS = {
    errno.EACCES: "close the program that holds it open, or allow writing to its folder",
    errno.EPERM: "close the program that holds it open, or allow writing to its folder",
    errno.EROFS: "choose a folder that can be written to",
    errno.ENOSPC: "free space on the disk, or choose another folder",
    errno.EDQUOT: "free space on the disk, or choose another folder",
    errno.ENOTDIR: "a file stands where a folder is needed: rename it or choose another folder",
    errno.EEXIST: "a file stands where a folder is needed: rename it or choose another folder",
    errno.EISDIR: "a folder has the file's name: rename it or choose another folder",
    errno.EFBIG: "free space on the disk, or choose another folder",
    errno.ENAMETOOLONG: "shorten the name or the folder's path",
}


@contextmanager
def whole_file(path: str | os.PathLike, safe_point: bool = True) -> Iterator[Path]:
    """Yield the path of a temporary file that becomes `path` when the block ends well.

    The temporary file lies in the same folder (made when missing) and keeps the suffix, because
    several writers choose the format by it. When the block fails, or the program was told to
    stop, it is removed, and a file that was at `path` before stays as it was; so does one that is
    read-only. An OSError within the block becomes a BendTorsionError with one finding that names
    the path and the mend. safe_point: False for what was whole before the program was told to stop.
    """
    path = Path(path)
    part = part_beside(path)
    _refuse_read_only(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        if safe_point:
            stop_if_asked()
        os.replace(part, path)
    except OSError as failure:
        raise BendTorsionError(not_written(path, failure)) from failure
    finally:
        _remove(part)


def _refuse_read_only(path: Path) -> None:
    """Raises BendTorsionError for a file nobody may write: moving another into its place asks the
    folder only, and on Windows fails once all is made."""
    try:
        mode = path.stat().st_mode
    except OSError:
        return
    if stat.S_ISREG(mode) and not mode & ANY_WRITE:
        if is_issued(path):
            raise BendTorsionError(
                error(
                    "file-not-written",
                    str(path),
                    "cannot be written: the file is issued",
                    "choose a place outside the folder of issues",
                )
            )
        raise BendTorsionError(
            error(
                "file-not-written",
                str(path),
                "cannot be written: the file is read-only",
                "choose another name, or allow writing to the file",
            )
        )


def part_beside(path: Path) -> Path:
    """Where something is made before it becomes `path`: hidden, with this process's number; its
    name stays short where that of `path` is as long as can be."""
    return path.with_name(f".{path.stem[:LONGEST_STEM]}.{os.getpid()}.part{path.suffix}")


def remove_parts(folder: Path) -> None:
    """Remove from a folder what a process that was killed left unfinished. For folders that no
    other process is writing into."""
    try:
        # Folders hold thousands of files.
        left = [folder / name for name in os.listdir(folder) if _PART.fullmatch(name)]
    except OSError:
        return
    for path in left:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            _remove(path)


def write_whole(path: str | os.PathLike, content: bytes, safe_point: bool = True) -> None:
    """Write `content` to `path`, whole or not at all, as `whole_file`. Raises BendTorsionError."""
    with whole_file(path, safe_point) as part:
        part.write_bytes(content)


def write_changed(path: str | os.PathLike, content: bytes) -> None:
    """As write_whole, but a file that holds this already stays as it is."""
    try:
        if Path(path).read_bytes() == content:
            return
    except OSError:
        pass
    write_whole(path, content)


def write_or_remove(path: Path, content: bytes) -> None:
    """As write_changed, for what can be had again: where it cannot be written, what was there goes,
    since it is of a state before."""
    try:
        write_changed(path, content)
    except BendTorsionError:
        _remove(path)


def not_written(path: Path, failure: OSError) -> Finding:
    """The finding for what could not be written, with its mend."""
    if failure.errno is None:
        failure = _told_by_system(path) or failure
    mend = _MENDS.get(failure.errno, "check that the folder exists and can be written to")
    return error(
        "file-not-written",
        str(path),
        f"cannot be written: {failure.strerror or failure}",
        mend,
    )


@contextmanager
def in_temporary_folder() -> Iterator[None]:
    """What fails to be written in the system's temporary folder inside the block raises
    BendTorsionError that says why."""
    try:
        yield
    except OSError as failure:
        tried = Path(tempfile.gettempdir()) / "BendTorsion"
        raise BendTorsionError(not_written(tried, failure)) from failure


def _told_by_system(path: Path) -> OSError | None:
    """Why nothing can be written there: writers of other libraries only say that they cannot."""
    part = part_beside(path)
    try:
        # Beyond what there is of it: that takes up the end of a full disk.
        with open(part, "ab") as stream:
            stream.write(bytes(_TRIED))
    except OSError as failure:
        return failure
    finally:
        _remove(part)
    return None


def _remove(path: Path) -> None:
    # When the folder itself is unreachable there is nothing to remove, and the cause is on its way.
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return
