# SPDX-License-Identifier: LGPL-2.1-or-later
"""The combined DXF files of a project, joined from those of its plates: by a worker, if any, while
the rest of the project's files is made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from functools import partial
from hashlib import sha256
from pathlib import Path

from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.parallel import Workers, done_or
from BendTorsionWB.exchange import report
from BendTorsionWB.exchange.dxf_file import Frame
from BendTorsionWB.exchange.dxf_nest import groups_of, nest_dxf, nest_frame
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.exchange.whole_file import write_whole


class CombinedFiles:
    """The combined DXF files of a folder."""

    def __init__(self, folder: OutputFolder, executor: Executor | None):
        self._folder, self._executor = folder, executor
        self._frames: dict[str, tuple[list[str], Future]] = {}
        self._begun: list[tuple[str, str, partial, Future | None]] = []

    @property
    def begun(self) -> list[str]:
        """Names of the files that `finish` writes."""
        return [name for name, *_ in self._begun]

    def start_frames(self, records: Sequence[MemberRecord], keys: Mapping[str, str]) -> None:
        """Have the frames of files that are not there made by the executor, which take their time.
        keys: of what the records are written from, by member."""
        if self._executor is None:
            return
        for name, group in groups_of(records).items():
            if not self._folder.has(name, _key(group, keys)):
                marks = [plate.mark for plate in group]
                self._frames[name] = marks, self._executor.submit(nest_frame, marks)

    def start(self, records: Sequence[MemberRecord], keys: Mapping[str, str]) -> None:
        """Begin the files that are not there; those of the plates stand by now: drawing them is the
        most work. keys: as of `start_frames`."""
        for name, group in groups_of(records).items():
            key = _key(group, keys)
            if self._folder.has(name, key):
                self._folder.keep(name)
                continue
            marks = [plate.mark for plate in group]
            same = name in self._frames and marks == self._frames[name][0]
            frame = done_or(self._frames[name][1], lambda: None) if same else None
            self._folder.begin(name)
            join = partial(joined, self._folder.out, name, marks, frame)
            # Workers of others may see another folder.
            own = isinstance(self._executor, Workers)
            self._begun.append((name, key, join, self._executor.submit(join) if own else None))

    def finish(self, progress: Callable[[str, int, int], None]) -> None:
        """Write what was begun. Raises BendTorsionError."""
        count = len(self._begun)
        while self._begun:
            progress("combined DXF", count - len(self._begun), count)
            name, key, join, future = self._begun.pop(0)
            written = join() if future is None else done_or(future, join)
            self._folder.wrote(name, key, sha256=written)
            progress("combined DXF", count - len(self._begun), count)


def joined(out: Path, name: str, marks: Sequence[str], frame: Frame | None) -> str:
    """Write a file of these plates into the folder; its hash. frame: of the marks, where it was
    made before. Raises BendTorsionError."""
    parts = [(mark, (out / report.dxf_name(mark)).read_bytes()) for mark in marks]
    content = nest_dxf(parts, frame)
    write_whole(out / name, content)
    return sha256(content).hexdigest()


def _key(plates: Sequence[DevelopedPlate], keys: Mapping[str, str]) -> str:
    members = {plate.member: keys[plate.member] for plate in plates}
    return key_of(members, [plate.mark for plate in plates]) if all(members.values()) else ""
