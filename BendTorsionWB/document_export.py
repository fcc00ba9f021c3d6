# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a document as it is, edits by hand included: no schedule has a say."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import FreeCAD

from BendTorsionWB import __version__
from BendTorsionWB.combined_files import CombinedFiles
from BendTorsionWB.core import detailing
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import BendTorsionError, Finding, error, has_error
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord, failed_record
from BendTorsionWB.core.nodes.node_jobs import all_records
from BendTorsionWB.core.nodes.node_record import NodeRecord
from BendTorsionWB.core.parallel import Workers, workers_for
from BendTorsionWB.core.patterns.layer_names import layer_names
from BendTorsionWB.core.patterns.numbering import numbered
from BendTorsionWB.core.patterns.strain_map import StrainMap, strain_map
from BendTorsionWB.core.stages import MemberGeometry
from BendTorsionWB.core.welds.landed_marks import with_landed_marks
from BendTorsionWB.document_errors import told_of_members
from BendTorsionWB.document_left_out import without_patterns
from BendTorsionWB.document_nodes import nodes_told
from BendTorsionWB.document_settings import style_in
from BendTorsionWB.document_update import open_document
from BendTorsionWB.exchange import report, results_workbook
from BendTorsionWB.exchange.file_kind import FIGURES, check_ending
from BendTorsionWB.exchange.folder_lock import locked
from BendTorsionWB.exchange.issued_folder import refuse_issued
from BendTorsionWB.exchange.known_hashes import file_hash
from BendTorsionWB.exchange.nc1_text import text_findings
from BendTorsionWB.exchange.output_folder import (
    OutputFolder,
    check_folder,
    check_project,
    read_manifest,
)
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.exchange.schedule_cells import BadCell, Name
from BendTorsionWB.member_files import member_files, start_all, write_member_files
from BendTorsionWB.members_left_out import LeftOut, check_named, left_out
from BendTorsionWB.model_files import IFC, STEP, checked_recompute
from BendTorsionWB.objects import assembly_bed, plate_set
from BendTorsionWB.objects.proxy import type_of
from BendTorsionWB.objects.unfold import member_record_of, pattern_input
from BendTorsionWB.package_files import Background, write_package
from BendTorsionWB.project import (
    BuildResult,
    Progress,
    Timing,
    detail_members,
    read_project,
    silent,
)
from BendTorsionWB.report_files import write_reports
from BendTorsionWB.sheet_files import write_sheet_set
from BendTorsionWB.solid_files import StepFiles, write_ifc


@dataclass(frozen=True)
class DocumentRecords:
    """The members of a document: their records by name, the hash of what each comes from, every
    finding, what the title blocks say, and by member other names for layers of cut files; nodes,
    with meetings that are none, or None for those of the records."""

    records: dict[str, MemberRecord]
    keys: dict[str, str]
    findings: tuple[Finding, ...]
    titles: SheetStyle
    layers: dict[str, dict[str, str]] = field(default_factory=dict)
    nodes: tuple[NodeRecord, ...] | None = None


def records_of(document, only: Sequence[str] = ()) -> DocumentRecords:
    """Recompute a document and collect the lofting record of every member with patterns; one in
    error has no plates, one without patterns is told of. Raises BendTorsionError when there is
    none, or for unknown names."""
    findings = told_of_members(document, checked_recompute(document))
    kinds: dict[str, list] = {}
    for obj in document.Objects:
        kinds.setdefault(type_of(obj), []).append(obj)
    beds = {bed.Plates.Name: bed for bed in kinds.get("AssemblyBed", ()) if bed.Plates}
    records, keys, layers, geometry = {}, {}, {}, {}
    for unfold in kinds.get("Unfold", ()):
        plates = unfold.Plates
        if plates is None or plates.Member is None or (only and plates.Member.Label not in only):
            continue
        name = plates.Member.Label
        bed = beds.get(plates.Name)
        try:
            record = member_record_of(unfold)
            layers[name] = layer_names(unfold.LayerNames, unfold.Label)
            keys[name] = record._made_from
            if bed is not None:
                found = assembly_bed.value(bed)
                keys[name] = key_of(keys[name], found)
                record = detailing.with_beds(record, found)
            geometry[name] = plate_set.value(plates).geometry
        except BendTorsionError as problem:
            record = failed_record(name, problem.findings)
            keys[name] = ""
        records[name] = record
    findings += without_patterns(document, only)
    findings += _clashes(geometry, kinds.get("Node", ()))
    for name, own in report.of_members(records, findings).items():
        if has_error(own):
            records[name] = failed_record(name, own)
    records = _as_written(records)
    _check_known(document, only, records)
    titles = style_in(document)
    findings += text_findings(records.values(), titles.project)
    members = {name: own.member for name, own in geometry.items()}
    nodes = nodes_told(kinds.get("Node", ()), members, records, findings)
    return DocumentRecords(records, keys, findings, titles, layers, nodes)


def _check_known(document, only: Sequence[str], records: Container[str]) -> None:
    """Raises BendTorsionError for names that are of no member, and where there is no member."""
    members = [obj.Label for obj in document.Objects if type_of(obj) == "Member"]
    check_named(document.Label, only, members)
    bare = [name for name in only if name not in records]
    if bare or not records:
        told = "has no flat patterns" if bare else "no member of the document has flat patterns"
        mend = "give its members plates and flat patterns, or open another document"
        raise BendTorsionError(
            error("member-unknown", name, told, mend) for name in bare or [document.Label]
        )


def _as_written(records: Mapping[str, MemberRecord]) -> dict[str, MemberRecord]:
    """The records with what all members together tell of each: marks where others land, parts."""
    marked = with_landed_marks(tuple(records.values()))
    return {record.member: record for record in numbered(marked)}


def _clashes(geometry: Mapping[str, MemberGeometry], nodes: Iterable) -> tuple[Finding, ...]:
    """Members that run through each other; those that meet at a Node do not."""
    from BendTorsionWB.shapes.clash import clashes

    met = set()
    for node in nodes:
        for other in (node.Through, *node.EndsOn):
            if other is not None and node.Other is not None:
                met.add(frozenset((other.Label, node.Other.Label)))
    return clashes(geometry, met)


def source_records(
    path: str | os.PathLike,
    only: Sequence[str] = (),
    workers: int | None = None,
    progress: Progress = silent,
) -> DocumentRecords:
    """The records of a schedule or of a document; raises BendTorsionError as building or opening
    it does."""
    if Path(path).suffix.lower() == ".fcstd":
        document = open_document(Path(path))
        try:
            return records_of(document, only)
        finally:
            FreeCAD.closeDocument(document.Name)
    schedule, jobs, found = read_project(path, only)
    with workers_for(workers, len(jobs)) as executor:
        detailed, lost = detail_members(schedule, jobs, executor, progress)
    records = {}
    for name, own in report.of_members(jobs, (*lost, *found.findings)).items():
        healthy = name in detailed and not has_error(own)
        records[name] = detailed[name].record if healthy else failed_record(name, own)
    records = _as_written(records)
    titles = schedule.settings.sheet_style
    findings = (*lost, *found.findings, *text_findings(records.values(), titles.project))
    nodes = all_records(found, (), {}, list(jobs))
    return DocumentRecords(records, dict.fromkeys(jobs, ""), findings, titles, nodes=nodes)


def write_figures(given: DocumentRecords, path: str | os.PathLike) -> None:
    """Write the figures as the results workbook (.xlsx), or as report.json when the name ends in
    .json. Raises BendTorsionError, for another ending too."""
    check_ending(path, FIGURES)
    refuse_issued(path)
    records = tuple(given.records.values())
    if Path(path).suffix.lower() == ".json":
        report.write_report(records, given.findings, __version__, path, given.nodes)
    else:
        titles = given.titles
        results_workbook.write_results(
            records,
            given.findings,
            path,
            titles.project,
            titles.site,
            given.nodes,
            length=titles.told_length,
        )


def _check_names(names: Iterable[str]) -> None:
    """Raises BendTorsionError for labels of members that cannot name files."""
    findings = []
    for name in names:
        try:
            Name(names_files=True)(name)
        except BadCell as problem:
            findings.append(error("label-names-files", name, problem.message, problem.mend))
    if findings:
        raise BendTorsionError(findings)


def _uncertainties(document, members: Container[str]) -> Callable[[], dict[str, float]]:
    """What tells how uncertain the axes of the members are, mm, as their objects have found."""
    found = {
        obj.Label: obj.Axis.InSurfaceUncertainty.Value
        for obj in document.Objects
        if type_of(obj) == "Member" and obj.Label in members and obj.Axis
    }
    return lambda: found


def _strain_maps(document):
    """What finds the strain map of a plate of the document, None of a flat part."""
    unfolds = {
        obj.Plates.Member.Label: obj
        for obj in document.Objects
        if type_of(obj) == "Unfold" and obj.Plates and obj.Plates.Member
    }

    def found(plate: DevelopedPlate) -> StrainMap | None:
        unfold = unfolds[plate.member]
        given = pattern_input(unfold)
        for item in plate_set.value(unfold.Plates).plates:
            if item.plate.mark == plate.mark:
                return strain_map(item.plate, given.mode, given.marking_face, given.surface)
        return None

    return found


def _without(given: DocumentRecords, left: LeftOut) -> DocumentRecords:
    """The members of a document but for those left out, and what is found of these."""
    names = [name for name in given.records if name not in left.members]
    return replace(
        given,
        records={name: given.records[name] for name in names},
        keys={name: given.keys[name] for name in names},
        findings=(*left.findings, *left.without_theirs(given.findings)),
        nodes=given.nodes and tuple(n for n in given.nodes if {n.through, n.other} & set(names)),
    )


def export_document(
    path: str | os.PathLike,
    out: str | os.PathLike,
    only: Sequence[str] = (),
    workers: int | None = None,
    progress: Progress = silent,
    sheets: bool = True,
    force: bool = False,
    svg: bool = False,
) -> BuildResult:
    """Write STEP, IFC, sheets, cut files, workbook and report of a document into a folder. Raises
    BendTorsionError for a document that cannot be opened or holds no member, and for a folder
    another build is writing into. only: members to write; others are in what is written of the
    whole project where their files in the folder are as in the document, and named otherwise."""
    out = Path(out)
    check_folder(out)
    # However many members it holds: threads of the document would not survive a fork.
    with locked(out), workers_for(workers, sys.maxsize) as executor:
        return _export(path, out, only, executor, progress, sheets, force, svg)


def _export(
    path: str | os.PathLike,
    out: Path,
    only: Sequence[str],
    executor: Workers | None,
    progress: Progress,
    sheets: bool,
    force: bool,
    svg: bool,
) -> BuildResult:
    timing = Timing()
    with timing.stage("read"):
        document = open_document(Path(path))
    try:
        with timing.stage("document"):
            given = records_of(document)
            _check_known(document, only, given.records)
            check_project(out, given.titles.project, force)
            folder = OutputFolder(out, read_manifest(out), given.titles.project)
            # Exported into its own folder, the document itself is not what a former build left.
            for name, own in folder.former.items():
                place = out / name
                if place.resolve() == Path(path).resolve() and file_hash(place) == own.sha256:
                    folder.keep(name)
            files = member_files(given.records, given.keys, given.titles, sheets, given.layers)
            current = {f.member for f in files}
            current -= {f.member for f in files if not folder.has(f.name, f.made_from)}
            left = left_out(document.Label, given.records, only, current, folder.former)
            given = _without(given, left)
            _check_names(given.records)
            files = [f for f in files if f.member in given.records]
        healthy = {name for name, record in given.records.items() if record.plates}
        todo = [f for f in files if f.member in healthy and not folder.has(f.name, f.made_from)]
        made, steps = start_all(todo, executor), StepFiles(folder, None, executor)
        if healthy:
            with timing.stage("step"):
                steps.start(document, sorted(healthy), STEP, "")
            with timing.stage("ifc"):
                own, titles = given.records, given.titles
                folder.begin(IFC)
                write_ifc(document, sorted(healthy), own, titles.site, titles.project, out / IFC)
                folder.wrote(IFC, "")
        with timing.stage("files"):
            write_member_files(folder, files, made, healthy, progress)
        with timing.stage("step"):
            steps.write(wait=True)
        records = tuple(given.records.values())
        if sheets:
            given_keys = list(given.keys.values())
            write_sheet_set(folder, records, given_keys, given.titles, svg)
        with timing.stage("package"):
            behind = Background(_uncertainties(document, healthy), _strain_maps(document))
            keys = list(given.keys.values())
            combined = CombinedFiles(folder, executor)
            told, titles, nodes = given.findings, given.titles, given.nodes
            write_package(folder, records, told, keys, titles, behind, combined, nodes, progress)
            combined.finish(progress)
    finally:
        FreeCAD.closeDocument(document.Name)
    with timing.stage("results"):
        keys, titles = list(given.keys.values()), given.titles
        told, nodes = given.findings, given.nodes
        write_reports(folder, records, told, keys, titles, titles.site, nodes, progress)
        known = report.all_findings(records, given.findings)
        refused = given.records.keys() - healthy
        outdated = folder.close(left.members, left.outdated, refused, known)
    found = tuple(report.all_findings(records, (*given.findings, *outdated)))
    return BuildResult(records, found, timing.stages, style=titles)
