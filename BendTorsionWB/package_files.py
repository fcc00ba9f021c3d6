# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a whole project besides its tables: nesting list and HTML report."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from BendTorsionWB import __version__
from BendTorsionWB.combined_files import CombinedFiles
from BendTorsionWB.core.collection import collection_of_new
from BendTorsionWB.core.detailing import DetailedMember, MemberJob
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.error_sources import error_sources
from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.nodes.node_record import NodeRecord
from BendTorsionWB.core.patterns.strain_map import StrainMap, strain_map
from BendTorsionWB.exchange import folder_guide
from BendTorsionWB.exchange.cutting_tables import nesting_csv
from BendTorsionWB.exchange.html_report import Picture, html_report, plate_rows
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
    every member's axis, mm; the strain map of a plate, None where there is none; the picture of a
    member's patterns, coloured up to the largest strain; and its rows in the table of plates."""

    uncertainty: Callable[[], Mapping[str, float]] = dict
    strain: Callable[[DevelopedPlate], StrainMap | None] = lambda plate: None
    patterns: Callable[[MemberRecord, float], str] = patterns_svg
    plates: Callable[[MemberRecord], str] = plate_rows


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

    def plates(record: MemberRecord) -> str:
        return fragments.of(record.member).plates if record.plates else ""

    return Background(uncertainty, strain, patterns, plates)


@collection_of_new()
def write_package(
    folder: OutputFolder,
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    keys: Sequence[str],
    titles: SheetStyle,
    background: Background,
    combined: CombinedFiles,
    nodes: Sequence[NodeRecord] | None,
    progress: Callable[[str, int, int], None],
) -> None:
    """Write the nesting list and the HTML report unless they are there, and start the combined DXF
    files, after the files of the members. keys: of what the records come from; nodes: of the
    project, with meetings that are none, or those of the records."""
    # A step for each member, one for the files before and one for the page itself.
    steps = len(records) + 2
    progress("package", 0, steps)
    own = {r.member: record_key(key, r) for key, r in zip(keys, records, strict=True)}
    whole = key_of(list(own.items())) if all(own.values()) else ""
    plates = [plate for record in records for plate in record.plates]
    combined.start(records, own)
    if plates and folder.has(NESTING, whole):
        folder.keep(NESTING)
    elif plates:
        folder.write(NESTING, nesting_csv(tuple(records)), whole)
    progress("package", 1, steps)
    told = [finding.line() for finding in findings]
    files = list(folder_guide.rows({*folder.now, *combined.begun}))
    names = [r.member for r in records]
    key = key_of(whole, names, told, titles, files, nodes) if whole else ""
    if folder.has(HTML, key):
        folder.keep(HTML)
    else:
        done = partial(_tell, progress, steps)
        page = report_page(records, findings, titles, background, files, nodes, done)
        folder.write(HTML, page.encode("utf-8", "replace"), key)
    missing = folder_guide.left_out(records, findings)
    text = folder_guide.readme(titles.project, __version__, files, missing)
    if folder.has(folder_guide.README, key_of(text)):
        folder.keep(folder_guide.README)
    else:
        folder.write(folder_guide.README, text.encode("utf-8", "replace"), key_of(text))
    progress("package", steps, steps)


def _tell(progress: Callable[[str, int, int], None], steps: int, members: int) -> None:
    progress("package", 1 + members, steps)


def report_page(
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    titles: SheetStyle,
    background: Background,
    files: Sequence[tuple[str, str]],
    nodes: Sequence[NodeRecord] | None,
    done: Callable[[int], None],
) -> str:
    """The HTML report: the model, strain and pattern of the plate with the largest strain, the
    patterns of all; files: of the folder, and what is in them; nodes: as of write_package; done:
    told of how many members the patterns are drawn."""
    plates = [plate for record in records for plate in record.plates if plate.lines]
    highest = max((plate.strain_max for plate in plates), default=0.0)
    patterns = []
    # Of what is asked for these take longest: workers make them, or they are drawn here.
    for number, record in enumerate(records, start=1):
        patterns.append(Picture(record.member, background.patterns(record, highest)))
        done(number)
    pictures = [Picture("The members, seen from outside", model_svg(records))]
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
        list(map(background.plates, records)),
    )
