# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a whole project besides its tables: nesting list, combined DXF, HTML report."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from dataclasses import dataclass

from BendTorsionWB import __version__
from BendTorsionWB.core.collection import collection_of_new
from BendTorsionWB.core.detailing import DetailedMember, MemberJob
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.error_sources import error_sources
from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.nodes.node_record import NodeRecord
from BendTorsionWB.core.patterns.strain_map import StrainMap, strain_map
from BendTorsionWB.exchange import folder_guide, report
from BendTorsionWB.exchange.cutting_tables import nesting_csv
from BendTorsionWB.exchange.dxf_file import Frame
from BendTorsionWB.exchange.dxf_nest import groups_of, nest_dxf, nest_frame
from BendTorsionWB.exchange.html_report import Picture, html_report
from BendTorsionWB.exchange.model_picture import model_svg
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.pattern_picture import pattern_svg
from BendTorsionWB.exchange.patterns_picture import patterns_svg
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.member_files import record_key
from BendTorsionWB.member_fragments import Fragments
from BendTorsionWB.sheets.strain_picture import strain_svg

NESTING, HTML = "nesting.csv", "report.html"


@dataclass(frozen=True)
class Background:
    """What the report shows besides the records, asked for when it is written: uncertainty of
    every member's axis, mm; the strain map of a plate, None where there is none; and the picture
    of a member's patterns, coloured up to the largest strain."""

    uncertainty: Callable[[], Mapping[str, float]] = dict
    strain: Callable[[DevelopedPlate], StrainMap | None] = lambda plate: None
    patterns: Callable[[MemberRecord, float], str] = patterns_svg


def background_of(
    jobs: Mapping[str, MemberJob], detailed: Mapping[str, DetailedMember], fragments: Fragments
) -> Background:
    """Of members computed in this build."""

    def uncertainty() -> dict[str, float]:
        found = {name: fragments.of(name).uncertainty for name in detailed}
        return {name: value for name, value in found.items() if value is not None}

    def patterns(record: MemberRecord, highest: float) -> str:
        same = bool(record.plates) and highest == fragments.highest
        return fragments.of(record.member).patterns if same else patterns_svg(record, highest)

    def strain(plate: DevelopedPlate) -> StrainMap | None:
        own = [item.plate for item in detailed[plate.member].plates.plates]
        given = jobs[plate.member].patterns
        for candidate in own:
            if candidate.mark == plate.mark:
                return strain_map(candidate, given.mode, given.marking_face, given.surface)
        return None

    return Background(uncertainty, strain, patterns)


def start_frames(
    folder: OutputFolder,
    records: Mapping[str, MemberRecord],
    keys: Mapping[str, str],
    executor: Executor | None,
) -> dict[str, tuple[list[str], Future]]:
    """Have the frames of the combined DXF files that are not there made by the executor, which take
    their time: marks of the plates and frame by file name. keys: of what the records come from."""
    if executor is None:
        return {}
    own = {name: record_key(keys[name], record) for name, record in records.items()}
    started = {}
    for name, group in groups_of(list(records.values())).items():
        if not folder.has(name, _group_key(group, own)):
            marks = [plate.mark for plate in group]
            started[name] = marks, executor.submit(nest_frame, marks)
    return started


@collection_of_new()
def write_package(
    folder: OutputFolder,
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    keys: Sequence[str],
    titles: SheetStyle,
    background: Background,
    frames: Mapping[str, tuple[list[str], Future]] | None = None,
    nodes: Sequence[NodeRecord] | None = None,
) -> None:
    """Write the nesting list, the combined DXF files and the HTML report unless they are there,
    after the files of the members. keys: of what the records come from; frames: of start_frames;
    nodes: of the project, with meetings that are none, or those of the records."""
    own = {r.member: record_key(key, r) for key, r in zip(keys, records, strict=True)}
    whole = key_of(list(own.items())) if all(own.values()) else ""
    plates = [plate for record in records for plate in record.plates]
    for name, group in groups_of(records).items():
        key = _group_key(group, own)
        if folder.has(name, key):
            folder.keep(name)
            continue
        # Joined from the plates' own files, which stand by now: drawing them is the most work.
        parts = [(p.mark, (folder.out / report.dxf_name(p.mark)).read_bytes()) for p in group]
        marks, started = (frames or {}).get(name, ([], None))
        same = started is not None and marks == [plate.mark for plate in group]
        folder.write(name, nest_dxf(parts, _done(started) if same else None), key)
    if plates and folder.has(NESTING, whole):
        folder.keep(NESTING)
    elif plates:
        folder.write(NESTING, nesting_csv(tuple(records)), whole)
    told = [finding.line() for finding in findings]
    files = list(folder_guide.rows(folder.now))
    names = [r.member for r in records]
    key = key_of(whole, names, told, titles, files, nodes) if whole else ""
    if folder.has(HTML, key):
        folder.keep(HTML)
    else:
        page = report_page(records, findings, titles, background, files, nodes)
        folder.write(HTML, page.encode("utf-8", "replace"), key)
    text = folder_guide.readme(titles.project, __version__, files)
    if folder.has(folder_guide.README, key_of(text)):
        folder.keep(folder_guide.README)
    else:
        folder.write(folder_guide.README, text.encode("utf-8", "replace"), key_of(text))


def _done(started: Future) -> Frame | None:
    """What a worker made; None when it died."""
    try:
        return started.result()
    except BrokenExecutor:
        return None


def _group_key(plates: Sequence[DevelopedPlate], keys: Mapping[str, str]) -> str:
    members = {plate.member: keys[plate.member] for plate in plates}
    return key_of(members, [plate.mark for plate in plates]) if all(members.values()) else ""


def report_page(
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    titles: SheetStyle,
    background: Background,
    files: Sequence[tuple[str, str]] = (),
    nodes: Sequence[NodeRecord] | None = None,
) -> str:
    """The HTML report: the model, strain and pattern of the plate with the largest strain, the
    patterns of all; files: of the folder, and what is in them; nodes: as of write_package."""
    pictures = [Picture("The members, seen from outside", model_svg(records))]
    plates = [plate for record in records for plate in record.plates if plate.lines]
    if plates:
        worst = max(plates, key=lambda plate: plate.strain_max)
        field = background.strain(worst)
        if field is not None:
            # The declaration of a file of its own has no place within a page.
            svg = strain_svg(field).partition("?>\n")[2]
            caption = f"Strain of laying {worst.mark} flat, the largest of all plates"
            pictures.append(Picture(caption, svg))
        pictures.append(Picture(f"Flat pattern of {worst.mark}", pattern_svg(worst)))
    sources = error_sources(records, background.uncertainty())
    highest = max((plate.strain_max for plate in plates), default=0.0)
    patterns = [Picture(record.member, background.patterns(record, highest)) for record in records]
    return html_report(
        records,
        findings,
        titles.project,
        __version__,
        pictures,
        sources,
        patterns,
        files,
        titles.told_length,
        nodes,
    )
