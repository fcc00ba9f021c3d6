# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files each member is written to: sheets and cut files, made by workers if any."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from weakref import WeakKeyDictionary

from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import BETWEEN, BendTorsionError, error
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.parallel import done_or
from BendTorsionWB.core.patterns.numbering import shared_marks
from BendTorsionWB.exchange import dxf, nc1, report
from BendTorsionWB.exchange.file_name import same_file
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.report import PROJECT_SHEETS
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.exchange.template_dxf import template_dxf
from BendTorsionWB.exchange.whole_file import in_temporary_folder


@dataclass(frozen=True, eq=False)
class MemberFile:
    """A file of a member: `write` makes its content from `given`; made_from: key of that input;
    plate: mark of the plate it is of, empty for others."""

    name: str
    member: str
    made_from: str
    write: Callable
    given: object
    plate: str = ""


@dataclass(frozen=True, eq=False)
class Started:
    """A file that is being made: its place in what its task makes."""

    task: Future
    place: int


FILES_AT_ONCE = 60
"""Files a worker makes of one member before others have their turn."""


_record_keys: WeakKeyDictionary[MemberRecord, dict[str, str]] = WeakKeyDictionary()


def record_key(key: str, record: MemberRecord) -> str:
    """The key of what is written of a member: besides its own input that shows what the whole
    project tells, such as marks shared by equal plates. Empty for an empty key."""
    if not key:
        return ""
    # Asked for by every file of a member and of its project.
    known = _record_keys.setdefault(record, {})
    if key not in known:
        known[key] = key_of(
            key,
            repr(shared_marks(record)),
            [finding.line() for finding in record.findings],
            [weld.plates for weld in record.welds if weld.kind == "node"],
        )
    return known[key]


def member_files(
    records: Mapping[str, MemberRecord],
    keys: Mapping[str, str],
    style: SheetStyle,
    sheets: bool = True,
    layers: Mapping[str, Mapping[str, str]] | None = None,
) -> list[MemberFile]:
    """The files of these members, sheets first; raises BendTorsionError where two would have one
    name. keys: of what the members come from; style: the
    project's name, and how its sheets are drawn; sheets: whether they are; layers: by member, other
    names for layers of its DXF files."""
    keys = {name: record_key(keys[name], record) for name, record in records.items()}
    files = []
    for name, record in records.items():
        if sheets and record.plates:
            given = (record, style)
            key = key_of(keys[name], style)
            files.append(MemberFile(report.sheet_name(name), name, key, sheets_pdf, given))
    for name, record in records.items():
        names, key, write = (layers or {}).get(name), keys[name], dxf.plate_dxf
        if names:
            key, write = key and key_of(key, names), partial(dxf.plate_dxf, layers=names)
        for plate in record.plates:
            file_name = report.dxf_name(plate.mark)
            files.append(MemberFile(file_name, name, key, write, plate, plate.mark))
    for name, record in records.items():
        key = keys[name] and key_of(keys[name], style.project)
        for plate in record.plates:
            given = (plate, style.project)
            file_name = report.nc1_name(plate.mark)
            files.append(MemberFile(file_name, name, key, plate_nc1, given, plate.mark))
    for name, record in records.items():
        for board in [board for bed in record.beds for board in bed.templates]:
            file_name = report.template_name(board.name)
            files.append(MemberFile(file_name, name, keys[name], template_dxf, board))
    _refuse_one_name(files)
    return files


def _refuse_one_name(files: Sequence[MemberFile]) -> None:
    """Raises BendTorsionError for files that would overwrite each other or those of the project."""
    of_project = {same_file(name) for name in PROJECT_SHEETS}
    owners: dict[str, str] = {}
    found = []
    for file in files:
        name = same_file(file.name)
        if name in of_project:
            message = f"{file.name} is a file of the whole project"
            found.append(error("file-name-twice", file.member, message, "rename the member"))
        elif name in owners:
            both = BETWEEN.join((owners[name], file.member))
            message = f"both have a file {file.name}"
            found.append(error("file-name-twice", both, message, "rename one of the members"))
        owners[name] = file.member
    if found:
        raise BendTorsionError(found)


def start_all(files: Sequence[MemberFile], executor: Executor | None) -> dict[str, Started | None]:
    """Have the files made by the executor, member by member; without one, each when it is asked
    for."""
    if executor is None:
        return dict.fromkeys(file.name for file in files)
    found = {}
    for own in _tasks(files):
        task = executor.submit(_contents, [(file.write, file.given) for file in own])
        found |= {file.name: Started(task, place) for place, file in enumerate(own)}
    return found


def _tasks(files: Sequence[MemberFile]) -> list[list[MemberFile]]:
    """The files each task makes, those of one plate together: they share its contour and its
    pickle."""
    by_member: dict[tuple, list[MemberFile]] = {}
    for file in files:
        by_member.setdefault((file.member, file.write is sheets_pdf), []).append(file)
    tasks = []
    for own in by_member.values():
        tasks.append([])
        for file in sorted(own, key=lambda file: file.plate):
            task = tasks[-1]
            if len(task) >= FILES_AT_ONCE and task[-1].plate != file.plate:
                tasks.append([])
            tasks[-1].append(file)
    return tasks


def _contents(files: Sequence[tuple[Callable, object]]) -> list[bytes | BendTorsionError]:
    """What these make of what they are given, or why they cannot."""
    found = []
    for write, given in files:
        try:
            found.append(write(given))
        except BendTorsionError as problem:
            found.append(problem)
    return found


def written(file: MemberFile, started: Started | None) -> bytes:
    """The content of a file; made here when the worker at it was lost. Raises what making it
    raised."""
    made = done_or(started.task, tuple) if started else ()
    if not made:
        return file.write(file.given)
    content = made[started.place]
    if isinstance(content, BendTorsionError):
        raise content
    return content


def write_member_files(
    folder: OutputFolder,
    files: Sequence[MemberFile],
    made: dict[str, Started | None],
    healthy: set[str],
    progress: Callable[[str, int, int], None],
) -> None:
    """Write the files that are being made, of healthy members, and let go of what made them; those
    there already stay."""
    wanted = [file for file in files if file.member in healthy]
    for done, file in enumerate(wanted, start=1):
        if file.name in made:
            content = written(file, made.pop(file.name))
            folder.write(file.name, content, file.made_from, file.member)
        else:
            folder.keep(file.name)
        progress("sheets and cut files", done, len(wanted))


def plate_nc1(given: tuple[DevelopedPlate, str]) -> bytes:
    """The NC1 file of a plate. given: it and the name of its project, the order in the header."""
    plate, project = given
    return nc1.plate_nc1(plate, project)


def sheets_pdf(given: tuple[MemberRecord, SheetStyle]) -> bytes:
    """The sheets of a member as PDF. given: its record and how they are drawn."""
    return pdf_bytes(member_sheets(*given))


def pdf_bytes(sheets: Sequence[Sheet]) -> bytes:
    """The sheets as PDF."""
    from BendTorsionWB.sheets.pdf import write_pdf

    with in_temporary_folder(), tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sheets.pdf"
        write_pdf(sheets, path)
        return path.read_bytes()
