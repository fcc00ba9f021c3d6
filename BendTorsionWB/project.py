# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole project: a schedule computed, its document built and checked, its files written."""

from __future__ import annotations

import itertools
import json
import os
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from BendTorsionWB import __version__
from BendTorsionWB.core import detailing
from BendTorsionWB.core.finding import BendTorsionError, Finding, error, has_error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.sheet_layout import member_sheets
from BendTorsionWB.document import build_document, read_files
from BendTorsionWB.exchange import dxf, nc1, report, results_workbook
from BendTorsionWB.exchange.schedule import Schedule, read_schedule
from BendTorsionWB.exchange.schedule_jobs import job_of, located
from BendTorsionWB.exchange.timeless import timeless_document, timeless_step
from BendTorsionWB.exchange.whole_file import whole_file, write_whole

MODEL, STEP, RESULTS, REPORT, TIMING = (
    "model.FCStd",
    "model.step",
    "results.xlsx",
    "report.json",
    "timing.json",
)
MANIFEST = ".bendtorsion.json"
"""Which sheets and cut files in the folder are ours, and of which member."""

Progress = Callable[[str, int, int], None]
"""Called with what is being done, how many are done and how many there are."""


def silent(what: str, done: int, count: int) -> None:
    """Progress for callers that show none."""


@dataclass
class Timing:
    """Seconds spent in each stage of a build."""

    stages: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str):
        """Adds the time of a block to a stage."""
        start = time.perf_counter()
        try:
            yield
        finally:
            spent = time.perf_counter() - start
            self.stages[name] = self.stages.get(name, 0.0) + spent


@dataclass(frozen=True)
class BuildResult:
    """records in schedule order; findings: everything found; timing in seconds per stage."""

    records: tuple[MemberRecord, ...]
    findings: tuple[Finding, ...]
    timing: dict[str, float]

    @property
    def failed(self) -> bool:
        """True when any member is in error."""
        return has_error(self.findings)


def read_jobs(
    path: str | os.PathLike, only: Sequence[str] = ()
) -> tuple[Schedule, dict[str, detailing.MemberJob]]:
    """The schedule and the jobs of its members (those in `only`, when given); raises
    BendTorsionError for an invalid schedule or an unknown member."""
    schedule = read_schedule(path)
    names = [row.name for row in schedule.members]
    unknown = [name for name in only if name not in names]
    if unknown:
        raise BendTorsionError(
            error(
                "member-unknown",
                schedule.file,
                f"no member {name!r} in the schedule",
                "use names of the Members sheet",
                value=name,
            )
            for name in unknown
        )
    rows = [row for row in schedule.members if not only or row.name in only]
    files = read_files(schedule, rows)
    return schedule, {row.name: job_of(schedule, row, files) for row in rows}


def compute(
    schedule: Schedule,
    jobs: dict[str, detailing.MemberJob],
    executor: Executor | None = None,
    progress: Progress = silent,
) -> dict[str, detailing.DetailedMember]:
    """All members, through any concurrent.futures executor; the results are also kept in this
    process's memo. Raises BendTorsionError with every finding located at its cell."""
    results, faults = {}, []
    names = list(jobs)
    found = executor.map(_attempt, jobs.values()) if executor else map(_attempt, jobs.values())
    for done, (name, outcome) in enumerate(zip(names, found, strict=True), start=1):
        if isinstance(outcome, detailing.DetailedMember):
            detailing.adopt(outcome)
            results[name] = outcome
        else:
            row = schedule.member(name)
            faults += [located(schedule, row, finding) for finding in outcome]
        progress("members", done, len(names))
    if faults:
        raise BendTorsionError(dict.fromkeys(faults))
    return results


def _attempt(job: detailing.MemberJob):
    try:
        return detailing.detail(job)
    except BendTorsionError as problem:
        return problem.findings


def build(
    path: str | os.PathLike,
    out: str | os.PathLike,
    only: Sequence[str] = (),
    workers: int | None = None,
    progress: Progress = silent,
) -> BuildResult:
    """Build a schedule into a folder: document, STEP, DXF, sheets, workbook, report.

    Raises BendTorsionError, with nothing written, for an invalid schedule (geometry decidable
    from it included). Members in error keep no files; healthy ones are written whole.
    """
    timing = Timing()
    out = Path(out)
    with timing.stage("read"):
        schedule, jobs = read_jobs(path, only)
        _check_folder(out)
    with pool(workers, len(jobs)) as executor:
        with timing.stage("members"):
            detailed = compute(schedule, jobs, executor, progress)
        with timing.stage("clashes"):
            from BendTorsionWB.shapes.clash import clashes

            findings = clashes({name: item.geometry for name, item in detailed.items()})
        # Workers make the files of all members while this process builds the document.
        made = _made_files([d.record for d in detailed.values()], schedule, executor)
        with timing.stage("document"):
            document = build_document(schedule, jobs, progress)
            findings = (*findings, *checked_recompute(document))
        records = tuple(_record(name, item, findings) for name, item in detailed.items())
        healthy = tuple(record for record in records if record.plates)
        former = _former_files(out)
        _write(document, schedule, records, healthy, findings, out, made, timing, progress)
    with timing.stage("tidy"):
        own = set(_own_files(healthy))
        built = {record.member for record in records}
        kept = {name for name, member in former.items() if only and member not in built}
        for name in former.keys() - own - kept:
            (out / name).unlink(missing_ok=True)
        owners = {name: former[name] for name in kept} | _owners(healthy)
        write_whole(out / MANIFEST, _json(dict(sorted(owners.items()))))
    write_whole(out / TIMING, _json({**timing.stages, "total": sum(timing.stages.values())}))
    return BuildResult(records, tuple(report.all_findings(records, findings)), timing.stages)


@contextmanager
def pool(workers: int | None, jobs: int):
    """A process pool for `jobs` members, or None where one worker will do; what is still waiting
    is dropped when the block fails or is interrupted."""
    count = min(workers or os.cpu_count() or 1, max(jobs, 1))
    if count == 1:
        yield None
        return
    executor = ProcessPoolExecutor(count)
    try:
        yield executor
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        raise
    executor.shutdown()


def _record(
    name: str, detailed: detailing.DetailedMember, findings: Iterable[Finding]
) -> MemberRecord:
    """A member's record; without plates when the member is in error."""
    own = tuple(f for f in findings if f.object == name or f.object.startswith(f"{name}-"))
    if has_error(own):
        return detailing.failed_record(name, own)
    return detailed.record


def checked_recompute(document) -> tuple[Finding, ...]:
    """Recompute and return the errors of all objects: `recompute` itself never tells."""
    document.recompute()
    from BendTorsionWB.objects.proxy import findings_of

    findings = []
    for obj in document.Objects:
        if "Findings" in obj.PropertiesList:
            findings += [f for f in findings_of(obj) if f.severity == "error"]
        elif not obj.isValid():
            findings.append(
                error("object-invalid", obj.Label, obj.getStatusString(), "see the report view")
            )
    return tuple(dict.fromkeys(findings))


def _made_files(
    records: Sequence[MemberRecord], schedule: Schedule, executor: Executor | None
) -> Iterator[tuple[str, bytes]]:
    """Name and content of every sheet and cut file of the records, in order."""
    run = executor.map if executor else map
    plates = [plate for record in records for plate in record.plates]
    settings = schedule.settings
    pages = [(record, settings.project, settings.author) for record in records]
    sheets = zip(
        (report.sheet_name(r.member) for r in records), run(_sheets_pdf, pages), strict=True
    )
    cut_files = zip(
        (report.dxf_name(p.mark) for p in plates), run(dxf.plate_dxf, plates), strict=True
    )
    nc1_files = zip(
        (report.nc1_name(p.mark) for p in plates), run(nc1.plate_nc1, plates), strict=True
    )
    return itertools.chain(sheets, cut_files, nc1_files)


def _write(
    document, schedule, records, healthy, findings, out: Path, made, timing: Timing, progress
) -> None:
    with timing.stage("files"):
        wanted = set(_own_files(healthy))
        done = 0
        for name, content in made:
            if name in wanted:
                write_whole(out / name, content)
                done += 1
                progress("sheets and cut files", done, len(wanted))
    with timing.stage("step"):
        progress("model", 0, 2)
        if healthy:
            write_step(document, [record.member for record in healthy], out / STEP)
        else:
            (out / STEP).unlink(missing_ok=True)
    with timing.stage("save"):
        progress("model", 1, 2)
        save(document, out / MODEL)
        progress("model", 2, 2)
    with timing.stage("results"):
        results_workbook.write_results(records, findings, out / RESULTS, schedule.settings.project)
        report.write_report(records, findings, __version__, out / REPORT)


def _sheets_pdf(given: tuple[MemberRecord, str, str]) -> bytes:
    from BendTorsionWB.sheets.pdf import write_pdf

    record, project, author = given
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sheets.pdf"
        write_pdf(member_sheets(record, project, author), path)
        return path.read_bytes()


def _own_files(healthy: Iterable[MemberRecord]) -> list[str]:
    names = []
    for record in healthy:
        names.append(report.sheet_name(record.member))
        names += [report.dxf_name(plate.mark) for plate in record.plates]
        names += [report.nc1_name(plate.mark) for plate in record.plates]
    return names


def _owners(healthy: Iterable[MemberRecord]) -> dict[str, str]:
    return {name: record.member for record in healthy for name in _own_files([record])}


def _former_files(out: Path) -> dict[str, str]:
    """The sheets and cut files earlier builds left in the folder, with their members."""
    try:
        former = json.loads((out / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    inside = out.resolve()
    return {
        name: str(member)
        for name, member in (former.items() if isinstance(former, dict) else ())
        if inside in (out / name).resolve().parents
    }


def _check_folder(out: Path) -> None:
    """Raises BendTorsionError when the folder cannot be written to, before hours of computing."""
    existing = next(path for path in (out, *out.absolute().parents) if path.exists())
    if existing.is_dir() and os.access(existing, os.W_OK | os.X_OK):
        return
    problem = "cannot be written to" if existing.is_dir() else "is a file, not a folder"
    raise BendTorsionError(
        error("file-not-written", str(existing), problem, "choose another folder for --out")
    )


def write_step(document, members: Sequence[str], path: Path) -> None:
    """STEP of the members' plates; raises BendTorsionError naming a member in error."""
    import Import

    wanted = set(members)
    sets = [
        obj
        for obj in document.Objects
        if getattr(obj, "BT_Type", "") == "PlateSet" and obj.Member and obj.Member.Label in wanted
    ]
    refused = [obj for obj in sets if obj.Status != "ok"]
    if refused:
        raise BendTorsionError(
            error("export-refused", obj.Label, "is in error and is not exported", "mend it first")
            for obj in refused
        )
    with whole_file(path) as part:
        Import.export(sets, str(part))
        part.write_bytes(timeless_step(part.read_bytes(), path.name, f"BendTorsion {__version__}"))


def save(document, path: Path) -> None:
    """Save a document whole or not at all."""
    with whole_file(path) as part:
        document.saveCopy(str(part))
        timeless_document(part)


def _json(content: dict) -> bytes:
    return (json.dumps(content, indent=1) + "\n").encode()
