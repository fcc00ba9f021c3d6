# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole project: a schedule computed, its document built and checked, its files written."""

from __future__ import annotations

import json
import logging
import os
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from BendTorsionWB.combined_files import CombinedFiles
from BendTorsionWB.core import detailing
from BendTorsionWB.core.collection import without_collection
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE, SheetStyle
from BendTorsionWB.core.finding import BendTorsionError, Finding, has_error
from BendTorsionWB.core.lofting import MemberRecord, failed_record
from BendTorsionWB.core.memo import stamped
from BendTorsionWB.core.nodes.node_jobs import all_records
from BendTorsionWB.core.nodes.nodes import Found
from BendTorsionWB.core.parallel import attempts, mapping, workers_for
from BendTorsionWB.core.patterns.layer_names import named_layers
from BendTorsionWB.core.site import datum_findings
from BendTorsionWB.core.welds.landed_marks import with_landed_marks
from BendTorsionWB.document import build_document
from BendTorsionWB.document_update import Update
from BendTorsionWB.exchange import report
from BendTorsionWB.exchange.difference import Change
from BendTorsionWB.exchange.folder_lock import locked
from BendTorsionWB.exchange.issue import (
    KEPT_OUTLINES,
    Issue,
    compared,
    comparison_files,
    issue,
    write_comparison,
)
from BendTorsionWB.exchange.nc1_text import text_findings
from BendTorsionWB.exchange.output_folder import (
    OutputFolder,
    check_folder,
    check_project,
    read_manifest,
)
from BendTorsionWB.exchange.part_marks import built_from, keep_part_marks, part_marks
from BendTorsionWB.exchange.plate_status import status_findings
from BendTorsionWB.exchange.result_cache import FOLDER as CACHE
from BendTorsionWB.exchange.result_cache import ResultCache, key_of
from BendTorsionWB.exchange.revision import cut_findings
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_jobs import at_rows, located
from BendTorsionWB.exchange.schedule_nodes import with_nodes
from BendTorsionWB.exchange.schedule_rows import Schedule, StatusRow
from BendTorsionWB.exchange.whole_file import write_whole
from BendTorsionWB.ifc_fragments import kept_key as ifc_key
from BendTorsionWB.interrupts import to_the_end
from BendTorsionWB.member_files import (
    member_files,
    record_key,
    start_all,
    write_member_files,
)
from BendTorsionWB.member_fragments import Fragments
from BendTorsionWB.members_left_out import check_named, left_out, read_jobs_of
from BendTorsionWB.model_files import Wanted, write_model
from BendTorsionWB.package_files import background_of, write_package
from BendTorsionWB.report_files import write_reports
from BendTorsionWB.sheet_files import write_sheet_set
from BendTorsionWB.solid_files import StepFiles
from BendTorsionWB.step_fragments import kept_key as step_key

TIMING = "timing.json"

_log = logging.getLogger(__name__)

EVERYTHING = Wanted()

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
    """records in schedule order; findings: everything found; timing in seconds per stage;
    changes: what an update changed in the document; style: of its sheets, and of findings."""

    records: tuple[MemberRecord, ...]
    findings: tuple[Finding, ...]
    timing: dict[str, float]
    changes: tuple[Change, ...] = ()
    style: SheetStyle = PLAIN_STYLE

    @property
    def failed(self) -> bool:
        """True when any member is in error."""
        return has_error(self.findings)


def read_jobs(
    path: str | os.PathLike, only: Sequence[str] = ()
) -> tuple[Schedule, dict[str, detailing.MemberJob]]:
    """The schedule and the jobs of its members (those in `only`, when given); raises
    BendTorsionError for an invalid schedule or an unknown member."""
    return read_project(path, only)[:2]


def read_project(
    path: str | os.PathLike, only: Sequence[str] = (), others: bool = False
) -> tuple[Schedule, dict[str, detailing.MemberJob], Found]:
    """As read_jobs, and the nodes of the project, with what was found at them and in files.
    others: the jobs of other members than `only` come along, but for those with faults."""
    schedule = read_schedule(path)
    check_named(schedule.file, only, [row.name for row in schedule.members])
    # Nodes lie between all members, whichever of them are built.
    has_nodes = schedule.nodes or any(row.rank is not None for row in schedule.members)
    every = has_nodes or others or not only
    rows = [row for row in schedule.members if every or row.name in only]
    plain, files = read_jobs_of(schedule, rows, () if has_nodes else only)
    jobs, found = with_nodes(schedule, plain)
    jobs = {name: job for name, job in jobs.items() if not only or others or name in only}
    at_nodes = [f for f in found.findings if not jobs.keys().isdisjoint(f.objects)]
    at_site = datum_findings(schedule.settings.site)
    return schedule, jobs, replace(found, findings=(*at_site, *files.findings, *at_nodes))


def compute(
    schedule: Schedule,
    jobs: Mapping[str, detailing.MemberJob],
    executor: Executor | None = None,
    progress: Progress = silent,
) -> dict[str, detailing.DetailedMember]:
    """All members, through any concurrent.futures executor; the results are also kept in this
    process's memo. Raises BendTorsionError with every finding located at its cell, and for
    members whose worker died."""
    detailed, lost = detail_members(schedule, jobs, executor, progress)
    if lost:
        raise BendTorsionError(lost)
    return detailed


def detail_members(
    schedule: Schedule,
    jobs: Mapping[str, detailing.MemberJob],
    executor: Executor | None = None,
    progress: Progress = silent,
    cache: ResultCache | None = None,
    keys: Mapping[str, str] | None = None,
    of_files: Sequence[Finding] = (),
) -> tuple[dict[str, detailing.DetailedMember], tuple[Finding, ...]]:
    """The members in schedule order, from the cache where it has them, and an error for each whose
    worker died. keys: of the jobs, for the cache. Raises BendTorsionError with every finding
    located at its cell, and then keeps nothing; of_files: what was found in the files that the
    members come from, which may explain those and is told before them."""
    # The collector would walk all that is read so far, again and again.
    with without_collection():
        found = {name: cache.find(keys[name]) for name in jobs} if cache else {}
    results = {name: result for name, result in found.items() if result is not None}
    pending = {name: job for name, job in jobs.items() if name not in results}
    if executor is not None:
        # The longest first, so that workers end together.
        pending = dict(sorted(pending.items(), key=lambda item: -_length(item[1])))
    faults, lost, packed = [], [], {}
    try:
        for done, (name, outcome) in enumerate(
            attempts(_attempt, pending, executor), start=len(results) + 1
        ):
            if outcome.failure:
                lost.append(outcome.failure)
                _log.debug("%s: %s", name, outcome.trace)
            elif isinstance(outcome.value, detailing.DetailedMember):
                results[name] = outcome.value
                packed[name] = outcome.packed if cache else b""
            else:
                row = schedule.member(name)
                faults += [located(schedule, row, finding) for finding in outcome.value]
            progress("members", done, len(jobs))
    finally:
        # Also when interrupted: what was computed until then need not be again.
        for name in pending if cache and not faults else ():
            if name in results:
                cache.keep(keys[name], results[name], packed.pop(name))
    if faults:
        units = [finding for finding in of_files if finding.code.startswith("file-")]
        raise BendTorsionError(dict.fromkeys([*units, *faults]))
    for result in results.values():
        detailing.adopt(result)
    return {name: results[name] for name in jobs if name in results}, tuple(lost)


def _length(job: detailing.MemberJob) -> float:
    """About how long a member is, mm, as far as points tell."""
    points = job.axis.points
    if points is None or len(points) < 2:
        return 0.0
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


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
    wanted: Wanted = EVERYTHING,
    executor: Executor | None = None,
    statuses: Sequence[StatusRow] = (),
    force: bool = False,
) -> BuildResult:
    """Build a schedule into a folder: document, STEP, IFC, cut files, sheets, workbook, reports.

    What is there already and made from the same input is left as it is. only: members to compute;
    others are in what is written of the whole project as far as they are known to be unchanged
    since a build before, and named where they are left out. workers: processes of a
    pool of its own; executor: any other to use instead; statuses: of plates in the shop, besides
    those of the schedule; force: into the folder of another project as well. Raises
    BendTorsionError, with nothing written, for an invalid schedule (geometry decidable from it
    included), and for a folder another build is writing into. Members in error keep no files;
    healthy ones are written whole.
    """
    out = Path(out)
    check_folder(out)
    with locked(out):
        return _build(path, out, only, workers, progress, wanted, executor, statuses, force)


def _build(
    path: str | os.PathLike,
    out: Path,
    only: Sequence[str],
    workers: int | None,
    progress: Progress,
    wanted: Wanted,
    executor: Executor | None,
    statuses: Sequence[StatusRow],
    force: bool,
) -> BuildResult:
    timing = Timing()
    with timing.stage("read"):
        schedule, jobs, found = read_project(path, only, others=True)
        check_project(out, schedule.settings.project, force)
        cache, keys = ResultCache(out / CACHE), {n: key_of(stamped(job)) for n, job in jobs.items()}
        former = read_manifest(out)
        built = built_from(out)
        known = {n for n, key in keys.items() if cache.has(key) or built.get(n) == key}
        members = [row.name for row in schedule.members]
        left = left_out(schedule.file, members, only, known, former)
        jobs, keys = ({n: own[n] for n in own if n not in left.members} for own in (jobs, keys))
        found = replace(found, findings=left.without_theirs(found.findings))
    update = Update(wanted.removing, bool(left.members))
    with workers_for(workers, len(jobs), given=executor) as executor:
        with timing.stage("members"):
            detailed, lost = detail_members(
                schedule, jobs, executor, progress, cache, keys, found.findings
            )
        with timing.stage("clashes"):
            from BendTorsionWB.shapes.clash import clashes

            geometry = {name: item.geometry for name, item in detailed.items()}
            findings = (*lost, *left.findings, *found.findings, *clashes(geometry, found.met))
            members = {name: own.member for name, own in geometry.items()}
            nodes = all_records(found, findings, members, list(jobs))
        folder = OutputFolder(out, former, schedule.settings.project)
        titles = schedule.settings.sheet_style
        with timing.stage("numbering"):
            own = [item.record for item in detailed.values()]
            own = [replace(one, findings=at_rows(schedule, one.findings)) for one in own]
            own = with_landed_marks(own)
            marks = part_marks(out, own, keys, bool(left.members))
            developed = {record.member: record for record in marks.records}
            findings += (*marks.findings, *text_findings(marks.records, titles.project))
        rows = (*schedule.statuses, *statuses)
        statuses = {row.name: row.status for row in rows}
        with timing.stage("revision"):
            # Before any file is made: nothing of a member refused here may reach the model.
            run, kept = mapping(executor), out / KEPT_OUTLINES
            since = compared(out, kept, developed.values(), statuses, left.members, run)
            findings += cut_findings(since.changes)
            slips = status_findings(rows, since.marks, {*left.members, *(jobs.keys() - developed)})
        layers = dict.fromkeys(developed, named_layers(schedule.settings.layer_names))
        files = member_files(developed, keys, titles, wanted.sheets, layers)
        # Workers make the files of all members while this process builds the document.
        made = start_all([f for f in files if not folder.has(f.name, f.made_from)], executor)
        site = schedule.settings.site
        combined = CombinedFiles(folder, executor)
        written_from = {name: record_key(keys[name], own) for name, own in developed.items()}
        combined.start_frames(list(developed.values()), written_from)
        fragments = Fragments(developed, jobs, keys, site, cache, executor)
        if wanted.model:
            with to_the_end():
                findings += write_model(
                    folder,
                    schedule,
                    jobs,
                    developed,
                    findings,
                    wanted,
                    update.document_of if wanted.update else _new_document,
                    StepFiles(folder, cache, executor),
                    timing.stage,
                    progress,
                )
        told = report.of_members(jobs, findings)
        records = tuple(_record(name, developed.get(name), told[name]) for name in jobs)
        healthy = {record.member for record in records if record.plates}
        refused = jobs.keys() - healthy
        findings += slips  # about the list, whatever its file is named after
        with timing.stage("files"):
            write_member_files(folder, files, made, healthy, progress)
            if wanted.sheets:
                write_sheet_set(folder, records, list(keys.values()), titles, wanted.svg)
        with timing.stage("package"):
            behind = background_of(jobs, detailed, fragments)
            own = list(keys.values())
            write_package(folder, records, findings, own, titles, behind, combined, nodes, progress)
            keep_part_marks(out, marks)
        with timing.stage("results"):
            write_reports(folder, records, findings, own, titles, site, nodes, progress, fragments)
            fragments.keep_all()
        with timing.stage("package"):
            combined.finish(progress)
    with timing.stage("revision"):
        for name in comparison_files(since):
            folder.begin(name)
        for name in write_comparison(since, out, kept, statuses, refused):
            folder.wrote(name, "")
    with timing.stage("tidy"):
        known = report.all_findings(records, findings)
        findings += folder.close(left.members, left.outdated, refused, known)
        if not left.members:
            solids = [key(name) for name in jobs for key in (step_key, ifc_key)]
            cache.sweep([*keys.values(), *fragments.keys.values(), *solids])
    write_whole(out / TIMING, _json({**timing.stages, "total": sum(timing.stages.values())}))
    found = tuple(report.all_findings(records, findings))
    return BuildResult(records, found, timing.stages, tuple(update.changes), titles)


def issue_folder(out: str | os.PathLike, revision: str, note: str = "") -> Issue:
    """Freeze the files of a folder under a revision; raises BendTorsionError as `issue` does."""
    out = Path(out)
    if not out.is_dir():
        return issue(out, revision, out / KEPT_OUTLINES, note)
    with locked(out):
        return issue(out, revision, out / KEPT_OUTLINES, note)


def _new_document(schedule, jobs, sheets: bool, path: Path):
    return build_document(schedule, jobs, sheets), ()


def _record(name: str, developed: MemberRecord | None, own: tuple[Finding, ...]) -> MemberRecord:
    """A member's record; without plates when the member is in error."""
    if developed is None or has_error(own):
        return failed_record(name, own)
    return developed


def _json(content: dict) -> bytes:
    return (json.dumps(content, indent=1) + "\n").encode()
