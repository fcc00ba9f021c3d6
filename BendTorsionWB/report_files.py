# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of a whole project as files: the workbook of results and report.json."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from BendTorsionWB import __version__
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.nodes.node_record import NodeRecord
from BendTorsionWB.core.site import SiteDatum
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
    site: SiteDatum,
    nodes: Sequence[NodeRecord] | None,
    progress: Callable[[str, int, int], None],
    fragments: Fragments | None = None,
) -> None:
    """Write the workbook of results and the report unless they are there. keys: of the records;
    nodes: of the project, with meetings that are none, or those of the records; fragments: of the
    members, where they are made."""
    # The rows of each member, then the workbook and the report of all, which take as long.
    out, steps = folder.out, 3 * len(records)
    progress("results", 0, steps)
    own = [record_key(key, record) for key, record in zip(keys, records, strict=True)]
    names = [record.member for record in records]
    key = key_of(own, names, [finding.line() for finding in findings], titles, site, nodes)
    if folder.has(RESULTS, key) and folder.has(REPORT, key):
        folder.keep(RESULTS)
        folder.keep(REPORT)
        progress("results", steps, steps)
        return
    rows, lines = [], []
    for number, record in enumerate(records, start=1):
        own = fragments.of(record.member) if fragments is not None and record.plates else None
        rows.append(own.rows if own else results_workbook.member_rows(record, site))
        lines.append(own.told if own else report.member_line(record))
        progress("results", number, steps)
    folder.begin(RESULTS)
    results_workbook.write_results(
        records, findings, out / RESULTS, titles.project, site, nodes, titles.told_length, rows
    )
    folder.wrote(RESULTS, key)
    progress("results", 2 * len(records), steps)
    folder.begin(REPORT)
    report.write_report(records, findings, __version__, out / REPORT, nodes, lines)
    folder.wrote(REPORT, key)
    progress("results", steps, steps)
