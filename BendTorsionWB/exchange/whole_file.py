# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files appear whole or not at all: written beside their place, then moved into it."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..core.finding import BendTorsionError, error

_MENDS = {
    errno.EACCES: "close the program that holds it open, or allow writing to its folder",
    errno.EPERM: "close the program that holds it open, or allow writing to its folder",
    errno.EROFS: "choose a folder that can be written to",
    errno.ENOSPC: "free space on the disk, or choose another folder",
    errno.EDQUOT: "free space on the disk, or choose another folder",
    errno.ENOTDIR: "a file stands where a folder is needed: rename it or choose another folder",
    errno.EEXIST: "a file stands where a folder is needed: rename it or choose another folder",
    errno.EISDIR: "a folder has the file's name: rename it or choose another folder",
    errno.ENAMETOOLONG: "shorten the name or the folder's path",
}


@contextmanager
def whole_file(path: str | os.PathLike) -> Iterator[Path]:
    """Yield the path of a temporary file that becomes `path` when the block ends well.

    The temporary file lies in the same folder (made when missing) and keeps the suffix, because
    several writers choose the format by it. When the block fails it is removed, and a file that
    was at `path` before stays as it was. An OSError within the block becomes a BendTorsionError
    with one finding that names the path and the mend.
    """
    path = Path(path)
    part = path.with_name(f".{path.stem}.{os.getpid()}.part{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        os.replace(part, path)
    except OSError as failure:
        raise BendTorsionError(_not_written(path, failure)) from failure
    finally:
        _remove(part)


def write_whole(path: str | os.PathLike, content: bytes) -> None:
    """Write `content` to `path`, whole or not at all. Raises BendTorsionError."""
    with whole_file(path) as part:
        part.write_bytes(content)


def write_changed(path: str | os.PathLike, content: bytes) -> None:
    """As write_whole, but a file that holds this already stays as it is."""
    try:
        if Path(path).read_bytes() == content:
            return
    except OSError:
        pass
    write_whole(path, content)


def _not_written(path: Path, failure: OSError):
    mend = _MENDS.get(failure.errno, "check that the folder exists and can be written to")
    return error(
        "file-not-written",
        str(path),
        f"cannot be written: {failure.strerror or failure}",
        mend,
    )


def _remove(part: Path) -> None:
    # When the folder itself is unreachable there is nothing to remove, and the cause is on its way.
    try:
        part.unlink(missing_ok=True)
    except OSError:
        return
