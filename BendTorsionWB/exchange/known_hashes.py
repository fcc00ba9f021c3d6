# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hashes of the files of a folder, not taken again of files nobody touched since.

A file is untouched while its size, its place on the disk and the times of its last change, that of
its entry included, are what they were: no program sets the latter. Kept with the cache.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.whole_file import write_changed

FILE = ".cache/hashes.txt"
"""Name of the record in the folder; it may be deleted at any time."""
SETTLED = 2_000_000_000
"""ns; a file that was changed less before the record may change once more within one tick of the
disk's clock, and is hashed again. The slowest clocks tick every two seconds."""
_AT_ONCE = 65536
"""Bytes of a file that are read and hashed at once."""


@dataclass(frozen=True)
class Stamp:
    """Size, the times, ns, when content and entry were changed last, and the number on the disk, as
    text; latest: the later of those times. Empty text where nothing can be told."""

    text: str = ""
    latest: int = 0


def file_hash(path: Path) -> str:
    """sha256 of a file; empty when it cannot be read."""
    return _hashed(path)[0]


class KnownHashes:
    """The hashes of the files of a folder."""

    def __init__(self, out: Path):
        self._out = os.fspath(out)
        self._known = _read(out)
        self._now: dict[str, tuple[Stamp, str]] = {}

    def of(self, name: str) -> str:
        """sha256 of a file; empty when it cannot be read."""
        path = os.path.join(self._out, name)
        stamp = _stamp(path)
        if stamp.text and self._known.get(name, ("", ""))[0] == stamp.text:
            return self._known[name][1]
        found, stamp = _hashed(path)
        self._now[name] = stamp, found
        return found

    def wrote(self, name: str, sha256: str) -> None:
        """A file of this content has just been put in its place."""
        self._now[name] = _stamp(os.path.join(self._out, name)), sha256

    def keep(self, names: Collection[str], now: int) -> None:
        """Keep what is known of these files beside results, if there are any. now: the time, ns, by
        the clock of their disk."""
        place = Path(self._out, FILE)
        if not place.parent.is_dir():
            return
        kept = {name: own for name, own in self._known.items() if name in names}
        for name, (stamp, found) in self._now.items():
            kept.pop(name, None)
            settled = stamp.text and found and stamp.latest + SETTLED < now
            if settled and name in names and "\n" not in name:
                kept[name] = stamp.text, found
        lines = "".join(f"{text}\t{found}\t{name}\n" for name, (text, found) in kept.items())
        with suppress(BendTorsionError):
            write_changed(place, lines.encode("utf-8", "surrogateescape"))


def _read(out: Path) -> dict[str, tuple[str, str]]:
    """Stamp and hash by name; nothing of a record that is damaged."""
    try:
        text = (out / FILE).read_bytes().decode("utf-8", "surrogateescape")
        lines = (line.split("\t", 2) for line in text.split("\n") if line)
        return {name: (stamp, found) for stamp, found, name in lines}
    except (OSError, ValueError):
        return {}


def _stamp(path: str) -> Stamp:
    """Of a file that cannot be read, and where systems do not tell when an entry changed, none."""
    try:
        # Opened, since disks of other machines are asked for the truth then only.
        own = os.open(path, os.O_RDONLY)
    except OSError:
        return Stamp()
    try:
        return _stamp_of(own)
    finally:
        os.close(own)


def _stamp_of(opened: int) -> Stamp:
    if os.name != "posix":
        return Stamp()
    told = os.fstat(opened)
    times = told.st_mtime_ns, told.st_ctime_ns
    return Stamp(f"{told.st_size} {times[0]} {times[1]} {told.st_ino}", max(times))


def _hashed(path: str | Path) -> tuple[str, Stamp]:
    """The hash of a file, empty when it cannot be read, and its stamp, none when it was changed
    meanwhile."""
    digest = hashlib.sha256()
    try:
        # In parts: models are large; of thousands of small files each is one.
        with open(path, "rb", buffering=0) as stream:
            before = _stamp_of(stream.fileno())
            while part := stream.read(_AT_ONCE):
                digest.update(part)
            after = _stamp_of(stream.fileno())
    except OSError:
        return "", Stamp()
    return digest.hexdigest(), after if before == after else Stamp()
