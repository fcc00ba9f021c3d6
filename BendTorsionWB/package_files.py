# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a whole project besides its tables: nesting list, combined DXF, HTML report."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from BendTorsionWB import __version__
from BendTorsionWB.core.detailing import DetailedMember, MemberJob, uncertainty_of
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.error_sources import error_sources
from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.core.lofting import DevelopedPlate, MemberRecord
from BendTorsionWB.core.patterns.strain_map import StrainMap, strain_map
from BendTorsionWB.exchange import folder_guide, report
from BendTorsionWB.exchange.cutting_tables import nesting_csv
from BendTorsionWB.exchange.dxf_nest import groups_of, nest_dxf
from BendTorsionWB.exchange.html_report import Picture, html_report
from BendTorsionWB.exchange.model_picture import model_svg
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.pattern_picture import pattern_svg
from BendTorsionWB.exchange.patterns_picture import patterns_svg
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.member_files import record_key
from BendTorsionWB.sheets.strain_picture import strain_svg

NESTING, HTML = "nesting.csv", "report.html"


@dataclass(frozen=True)
class Background:
    """What the report shows besides the records, asked for when it is written: uncertainty of
    every member's axis, mm, and the strain map of a plate, None where there is none."""

    uncertainty: Callable[[], Mapping[str, float]] = dict
    strain: Callable[[DevelopedPlate], StrainMap | None] = lambda plate: None


def background_of(
    jobs: Mapping[str, MemberJob], detailed: Mapping[str, DetailedMember]
) -> Background:
    """Of members computed in this build."""

    def uncertainty() -> dict[str, float]:
        found = {}
        for name in detailed:
            job = jobs[name]
            try:
                found[name] = uncertainty_of(job.axis, job.surface).largest
            except BendTorsionError:
                # Too few points for two axes: nothing can be told, and the axis itself was good.
                continue
        return found

    def strain(plate: DevelopedPlate) -> StrainMap | None:
        own = [item.plate for item in detailed[plate.member].plates.plates]
        given = jobs[plate.member].patterns
        for candidate in own:
            if candidate.mark == plate.mark:
                return strain_map(candidate, given.mode, given.marking_face, given.surface)
        return None

    return Background(uncertainty, strain)


def write_package(
    folder: OutputFolder,
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    keys: Sequence[str],
    titles: SheetStyle,
    background: Background,
) -> None:
    """Write the nesting list, the combined DXF files and the HTML report unless they are there,
    after the files of the members. keys: of what the records come from."""
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
        folder.write(name, nest_dxf(parts), key)
    if plates and folder.has(NESTING, whole):
        folder.keep(NESTING)
    elif plates:
        folder.write(NESTING, nesting_csv(tuple(records)), whole)
    told = [finding.line() for finding in findings]
    files = list(folder_guide.rows(folder.now))
    key = key_of(whole, [r.member for r in records], told, titles, files) if whole else ""
    if folder.has(HTML, key):
        folder.keep(HTML)
    else:
        page = report_page(records, findings, titles.project, background, files)
        folder.write(HTML, page.encode("utf-8", "replace"), key)
    text = folder_guide.readme(titles.project, __version__, files)
    if folder.has(folder_guide.README, key_of(text)):
        folder.keep(folder_guide.README)
    else:
        folder.write(folder_guide.README, text.encode("utf-8", "replace"), key_of(text))


def _group_key(plates: Sequence[DevelopedPlate], keys: Mapping[str, str]) -> str:
    members = {plate.member: keys[plate.member] for plate in plates}
    return key_of(members, [plate.mark for plate in plates]) if all(members.values()) else ""


def report_page(
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    project: str,
    background: Background,
    files: Sequence[tuple[str, str]] = (),
) -> str:
    """The HTML report: the model, strain and pattern of the plate with the largest strain, the
    patterns of all; files: of the folder, and what is in them."""
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
    patterns = [Picture(record.member, patterns_svg(record, highest)) for record in records]
    return html_report(records, findings, project, __version__, pictures, sources, patterns, files)
