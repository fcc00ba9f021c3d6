# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of a whole project as files: the workbook of results and report.json."""

from __future__ import annotations

from collections.abc import Sequence

from BendTorsionWB import __version__
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.nodes.node_record import NodeRecord
from BendTorsionWB.core.site import AT_ORIGIN, SiteDatum
from BendTorsionWB.exchange import report, results_workbook
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.member_files import record_key
from BendTorsionWB.member_fragments import Fragments

RESULTS, REPORT = "results.xlsx", "report.json"


def write_reports(
    folder: OutputFolder,
    records: Sequence[MemberRecord],
    findings: tuple[Finding, ...],
    keys: Sequence[str],
    titles: SheetStyle,
    site: SiteDatum = AT_ORIGIN,
    nodes: Sequence[NodeRecord] | None = None,
    fragments: Fragments | None = None,
) -> None:
    """Write the workbook of results and the report unless they are there. keys: of the records;
    nodes: of the project, with meetings that are none, or those of the records; fragments: of the
    members, where they are made."""
    out = folder.out
    own = [record_key(key, record) for key, record in zip(keys, records, strict=True)]
    names = [record.member for record in records]
    key = key_of(own, names, [finding.line() for finding in findings], titles, site, nodes)
    if folder.has(RESULTS, key) and folder.has(REPORT, key):
        folder.keep(RESULTS)
        folder.keep(REPORT)
        return
    rows = None
    if fragments is not None:
        rows = [
            fragments.of(r.member).rows if r.plates else results_workbook.member_rows(r, site)
            for r in records
        ]
    folder.begin(RESULTS)
    results_workbook.write_results(
        records, findings, out / RESULTS, titles.project, site, nodes, titles.told_length, rows
    )
    folder.wrote(RESULTS, key)
    folder.begin(REPORT)
    report.write_report(records, findings, __version__, out / REPORT, nodes)
    folder.wrote(REPORT, key)
