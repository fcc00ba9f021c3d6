# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files each member is written to: sheets and cut files, made by workers if any."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.patterns.numbering import shared_marks
from BendTorsionWB.exchange import dxf, nc1, report
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.exchange.template_dxf import template_dxf
from BendTorsionWB.exchange.whole_file import not_written


@dataclass(frozen=True, eq=False)
class MemberFile:
    """A file of a member: `write` makes its content from `given`; made_from: key of that input."""

    name: str
    member: str
    made_from: str
    write: Callable
    given: object


def record_key(key: str, record: MemberRecord) -> str:
    """The key of what is written of a member: besides its own input that shows what the whole
    project tells, such as marks shared by equal plates. Empty for an empty key."""
    return (
        key_of(
            key,
            shared_marks(record),
            [finding.line() for finding in record.findings],
            [weld.plates for weld in record.welds if weld.kind == "node"],
        )
        if key
        else ""
    )


def member_files(
    records: Mapping[str, MemberRecord],
    keys: Mapping[str, str],
    style: SheetStyle,
    sheets: bool = True,
    layers: Mapping[str, Mapping[str, str]] | None = None,
) -> list[MemberFile]:
    """The files of these members, sheets first. keys: of what the members come from; style: the
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
            files.append(MemberFile(report.dxf_name(plate.mark), name, key, write, plate))
    for name, record in records.items():
        key = keys[name] and key_of(keys[name], style.project)
        for plate in record.plates:
            given = (plate, style.project)
            files.append(MemberFile(report.nc1_name(plate.mark), name, key, plate_nc1, given))
    for name, record in records.items():
        for board in [board for bed in record.beds for board in bed.templates]:
            file_name = report.template_name(board.name)
            files.append(MemberFile(file_name, name, keys[name], template_dxf, board))
    return files


def start_all(files: Sequence[MemberFile], executor: Executor | None) -> dict[str, Future | None]:
    """Have the files made by the executor; without one, each when it is asked for."""
    if executor is None:
        return dict.fromkeys(file.name for file in files)
    return {file.name: executor.submit(file.write, file.given) for file in files}


def written(file: MemberFile, started: Future | None) -> bytes:
    """The content of a file; made here when the worker at it died."""
    if started is not None:
        try:
            return started.result()
        except BrokenExecutor:
            return file.write(file.given)
    return file.write(file.given)


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

    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "sheets.pdf"
            write_pdf(sheets, path)
            return path.read_bytes()
    except OSError as failure:
        raise BendTorsionError(not_written(Path(tempfile.gettempdir()), failure)) from failure
