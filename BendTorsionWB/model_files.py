# SPDX-License-Identifier: LGPL-2.1-or-later
"""The model as files: a document, a STEP and an IFC file, or these per group of members."""

from __future__ import annotations

import errno
import os
import tempfile
import zipfile
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from BendTorsionWB.core.collection import collection_of_new
from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import Finding, error, has_error, note
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.patterns.numbering import shared_marks
from BendTorsionWB.document_cycles import refuse_cycle
from BendTorsionWB.document_errors import told_of_members
from BendTorsionWB.exchange.kept_rows import KEY as KEPT_ROWS
from BendTorsionWB.exchange.kept_rows import bring_kept, has_kept
from BendTorsionWB.exchange.linked_documents import linked_documents
from BendTorsionWB.exchange.output_folder import UPDATED, OutputFolder
from BendTorsionWB.exchange.report import of_members
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.exchange.schedule_content import content_of
from BendTorsionWB.exchange.schedule_rows import Schedule
from BendTorsionWB.exchange.split_model import SPLIT, kept_groups, split_size
from BendTorsionWB.exchange.timeless import timeless_document
from BendTorsionWB.exchange.whole_file import whole_file
from BendTorsionWB.interrupts import to_the_end
from BendTorsionWB.model_progress import ASSEMBLED, SAVED, ModelProgress
from BendTorsionWB.solid_files import StepFiles, plate_sets, write_ifc

MODEL, STEP, IFC = "model.FCStd", "model.step", "model.ifc"
GROUPS = "model"
"""Folder of the documents of a split model."""
PLATES_GROUP = "Plates"
"""Object name of the group in a group's document that the whole model links to."""


@dataclass(frozen=True)
class Wanted:
    """What of a project is written. model: document, STEP and IFC; sheets: drawing sheets, as PDF
    and in the document; split: members per document of the model, 0 for one document of all;
    update: documents that are there are brought up to the schedule instead of made anew; removing:
    objects in them go whose rows are gone from the schedule; svg: sheets as SVG as well."""

    model: bool = True
    sheets: bool = True
    split: int = 0
    update: bool = False
    removing: bool = False
    svg: bool = False


@dataclass(frozen=True)
class ModelPart:
    """A document of the model with its members; names are relative to the output folder."""

    name: str
    members: tuple[str, ...]

    def of(self, members: Container[str]) -> ModelPart:
        """The part with those of its members that are among these."""
        return replace(self, members=tuple(name for name in self.members if name in members))

    @property
    def document(self) -> str:
        """Name of the FreeCAD document."""
        return f"{self.name}.FCStd"

    @property
    def step(self) -> str:
        """Name of the STEP file."""
        return f"{self.name}.step"

    @property
    def ifc(self) -> str:
        """Name of the IFC file."""
        return f"{self.name}.ifc"

    @property
    def files(self) -> tuple[str, str, str]:
        """Names of all its files."""
        return self.document, self.step, self.ifc


def model_parts(members: Sequence[str], split: int = 0) -> list[ModelPart]:
    """One part for all members, or one per `split` members in their order."""
    if not split:
        return [ModelPart("model", tuple(members))]
    return [
        ModelPart(f"{GROUPS}/{number:03d}", tuple(members[start : start + split]))
        for number, start in enumerate(range(0, len(members), split), start=1)
    ]


def checked_recompute(document) -> tuple[Finding, ...]:
    """Recompute, also where recomputes are skipped, and return the errors of all objects:
    `recompute` itself never tells. Raises BendTorsionError for objects that lost what computes
    them, and for those that depend on each other in a circle."""
    from BendTorsionWB.objects.preference import recomputes, without_faces
    from BendTorsionWB.objects.proxy import findings_of
    from BendTorsionWB.objects.repair import refuse_bare
    from BendTorsionWB.objects.uncomputed import touch_what_follows_nothing

    refuse_bare(document.Objects)
    refuse_cycle(document)
    with to_the_end(), without_faces(), recomputes(document):
        touch_what_follows_nothing(document)
        document.recompute()
    findings = []
    for obj in document.Objects:
        if "Findings" in obj.PropertiesList:
            findings += [f for f in findings_of(obj) if f.severity == "error"]
        if not obj.isValid() and "Findings" not in obj.PropertiesList:
            findings.append(
                error("object-invalid", obj.Label, obj.getStatusString(), "see the report view")
            )
    return tuple(dict.fromkeys(findings))


def save(document, path: Path, shown: Sequence[str] = ()) -> None:
    """Save a document whole or not at all. shown: as of timeless_document."""
    from BendTorsionWB.objects.preference import saved_in_binary
    from BendTorsionWB.sheets.qt import settle_threads

    # They work on the shapes that are written.
    settle_threads()
    with whole_file(path) as part, to_the_end(), saved_in_binary():
        document.saveCopy(str(part))
        # FreeCAD does not tell when the disk is full.
        if not zipfile.is_zipfile(part):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        timeless_document(part, shown)


def group_plates(document) -> None:
    """Put the document's PlateSets into the group the whole model links to.

    A link group, because FreeCAD 0.20 does not open links to a plain group of another document.
    """
    group = document.getObject(PLATES_GROUP)
    if group is None:
        group = document.addObject("App::LinkGroup", PLATES_GROUP)
    group.setLink(plate_sets(document))
    group.recompute()


def write_linked_model(
    parts: Sequence[ModelPart], path: Path, split: int, kept: str = "{}"
) -> None:
    """The document that links to the groups of a split model; it holds no shape of its own. split:
    members per document, which it says for later updates; kept: rows of the schedule that no
    member needs, as of `kept_rows`.

    It is made beside empty documents of the same names, so that no group has to be loaded.
    """
    import FreeCAD

    documents = []
    with tempfile.TemporaryDirectory() as folder:
        try:
            whole = FreeCAD.newDocument("model", hidden=True)
            documents.append(whole)
            whole.Meta = {SPLIT: str(split), KEPT_ROWS: kept}
            whole.saveAs(str(Path(folder) / MODEL))
            for part in parts:
                group = FreeCAD.newDocument("part", hidden=True)
                documents.append(group)
                target = group.addObject("App::LinkGroup", PLATES_GROUP)
                place = Path(folder) / part.document
                place.parent.mkdir(exist_ok=True)
                group.saveAs(str(place))
                link = whole.addObject("App::Link", "Members")
                link.LinkedObject = target
                link.Label = _span(part.members) if part.members else part.name
            whole.recompute()
            save(whole, path, [link.Name for link in whole.Objects])
        finally:
            for document in documents:
                FreeCAD.closeDocument(document.Name)


def _span(members: Sequence[str]) -> str:
    first, last = members[0], members[-1]
    return first if first == last else f"{first} to {last}"


@collection_of_new()
def write_model(
    folder: OutputFolder,
    schedule: Schedule,
    jobs: Mapping[str, MemberJob],
    records: Mapping[str, MemberRecord],
    known: tuple[Finding, ...],
    wanted: Wanted,
    document_of: Callable,
    steps: StepFiles,
    stage: Callable,
    progress: Callable,
) -> tuple[Finding, ...]:
    """Write the documents, STEP and IFC files that are not there yet; what was found in them.

    records: of the members to be in them; known: findings so far, members in error have no solids
    in the STEP and IFC files; document_of: makes the document of a part, and tells what it left in
    one that was there; steps: the STEP files; stage and progress: told where the build is.
    """
    findings: tuple[Finding, ...] = ()
    members = [row.name for row in schedule.members]
    found = split_size(folder.out / MODEL) if wanted.update else 0
    kept = found and wanted.split in (0, found)
    if kept and not wanted.split:
        wanted = replace(wanted, split=found)
        findings += (_split_kept(found),)
    whole = schedule.kept
    if wanted.split:
        # None of the documents is the whole schedule's; that which links to all keeps it.
        schedule = replace(schedule, kept="")
    # By all members there are, so that one that is left out moves no other to another document.
    every = model_parts(members, wanted.split)
    if kept:
        groups = kept_groups(folder.out / MODEL, members, found)
        every = [ModelPart(name, own) for name, own in groups.items()]
    # With members left out it is not known which rows are gone.
    emptied = wanted.removing and jobs.keys() >= {*members}
    parts = []
    for part in every:
        own = part.of(records)
        if kept and part.members and not own.members and part.document in folder.former:
            # All its members are left out, and it stays as it is; those that failed have no solids.
            stays = (part.document,) if jobs.keys() & {*part.members} else part.files
            for name in folder.former.keys() & {*stays}:
                folder.keep(name)
            parts.append(part)
        elif own.members or (kept and not part.members and not emptied):
            parts.append(own)
    told = of_members(records, known)
    steps_done = ModelProgress(progress, sum(len(part.members) for part in parts))
    for part in parts:
        if part.document in folder.now:
            steps_done.keep(len(part.members))
            continue
        in_error = {name for name in part.members if has_error(told[name])}
        key = key_of(
            repr(content_of(schedule, _with_met(part.members, jobs))),
            [jobs[name] for name in part.members],
            sorted(in_error),
            wanted.sheets,
            wanted.split,
            repr([shared_marks(records[name]) for name in part.members]),
        )
        built, key = key, f"{UPDATED}{key}" if wanted.update else key
        left = folder.left_in(part.document)
        removing = wanted.removing and any(finding.code == "row-removed" for finding in left)
        # One that a build made of the same, and nobody touched, an update has nothing to bring to.
        if all(folder.has(name, built) for name in part.files):
            key = built
        if not removing and all(folder.has(name, key) for name in part.files):
            brought = has_kept(folder.out / part.document, schedule.kept)
            for name in part.files if brought else part.files[1:]:
                folder.keep(name)
            if not brought:
                folder.begin(part.document)
                bring_kept(folder.out / part.document, schedule.kept)
                folder.wrote(part.document, key, left=left)
            findings += left
            steps_done.keep(len(part.members))
            continue
        with steps_done.part(len(part.members)):
            findings += _model_part(
                folder,
                schedule,
                jobs,
                records,
                part,
                in_error,
                key,
                wanted,
                document_of,
                steps,
                stage,
                steps_done,
            )
        with stage("step"):
            steps.write()
    with stage("step"):
        steps.write(wait=True)
    if wanted.split:
        key = key_of([part.members for part in parts], wanted.split)
        if folder.has(MODEL, key) and has_kept(folder.out / MODEL, whole):
            folder.keep(MODEL)
        elif folder.has(MODEL, key):
            folder.begin(MODEL)
            bring_kept(folder.out / MODEL, whole)
            folder.wrote(MODEL, key)
        else:
            folder.save_by_hand(MODEL)
            folder.begin(MODEL)
            write_linked_model(parts, folder.out / MODEL, wanted.split, whole)
            folder.wrote(MODEL, key)
    steps_done.finish()
    return findings


def _with_met(members: Sequence[str], jobs: Mapping[str, MemberJob]) -> set[str]:
    """Members, and those they meet, which are in their document too."""
    met = {one for name in members for node in jobs[name].meets for one in node.members}
    return {*members, *met}


def _split_kept(size: int) -> Finding:
    return note(
        "split-kept",
        MODEL,
        f"the model stays split by {size}, each member in the document it is in",
        "for one document of all run build, for others update with --split",
        value=size,
    )


def _model_part(
    folder: OutputFolder,
    schedule: Schedule,
    jobs: Mapping[str, MemberJob],
    records: Mapping[str, MemberRecord],
    part: ModelPart,
    in_error: set[str],
    key: str,
    wanted: Wanted,
    document_of: Callable,
    steps: StepFiles,
    stage: Callable,
    steps_done: ModelProgress,
) -> tuple[Finding, ...]:
    import FreeCAD

    out = folder.out
    with stage("document"):
        document, left = document_of(
            schedule,
            {name: jobs[name] for name in part.members},
            wanted.sheets,
            out / part.document,
        )
        try:
            steps_done.add(ASSEMBLED * len(part.members))
            with steps_done.computing(document, len(part.members)):
                found = told_of_members(document, checked_recompute(document))
            if wanted.split:
                group_plates(document)
        except BaseException:
            FreeCAD.closeDocument(document.Name)
            raise
    # What has errors of its own is done again each time, so that it is told.
    if has_error(found):
        key = ""
    try:
        told = of_members(part.members, found)
        healthy = [
            name for name in part.members if name not in in_error and not has_error(told[name])
        ]
        with stage("step"):
            each = steps_done.add
            contents = steps.start(document, healthy, part.step, key, each) if healthy else {}
        with stage("ifc"):
            if healthy:
                settings = schedule.settings
                path = out / part.ifc
                folder.begin(part.ifc)
                site, project = settings.site, settings.project
                write_ifc(
                    document, healthy, records, site, project, path, steps.cache, contents, each
                )
                folder.wrote(part.ifc, key)
        with stage("save"):
            if not wanted.update or linked_documents(out / part.document):
                folder.save_by_hand(part.document)
            folder.begin(part.document)
            save(document, out / part.document)
            made_from = key if healthy else ""
            made_from = made_from or (UPDATED if wanted.update else "")
            folder.wrote(part.document, made_from, left=left)
        steps_done.add(SAVED * len(part.members))
    finally:
        FreeCAD.closeDocument(document.Name)
    return (*found, *left)
