# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheet Nodes of a schedule: its columns, and what its rows must be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.nodes.node_jobs import jobs_with_nodes
from BendTorsionWB.core.nodes.nodes import Found
from BendTorsionWB.core.rules import node_rules

NODE_COLUMNS = (
    "node",
    "through",
    "other",
    "s",
    "type",
    "gap",
    "stub_length",
    "diaphragms",
    "blend",
)


def check_nodes(records, faults: list) -> None:
    """Appends (place, finding) of rows that cannot be a node."""

    def fault(record, column, code, message, mend, **fields):
        faults.append((record.place, record.error(column, code, message, mend, **fields)))

    for record in records:
        if record.bad & {"through", "other", "type", "stub_length"}:
            continue
        if record["through"] == record["other"]:
            fault(
                record,
                "other",
                "node-of-itself",
                "a member does not meet itself",
                "name the member that ends here",
                value=record["other"],
            )
        if record["type"] == "stub" and not record["stub_length"]:
            fault(
                record,
                "stub_length",
                "value-missing",
                "a stub needs its length",
                "write the distance from the node to the field joint in mm",
            )
        if record["type"] == "direct" and record["stub_length"]:
            fault(
                record,
                "stub_length",
                "not-used",
                "a direct node has no stub",
                "clear the cell, or write stub under type",
                value=record["stub_length"],
            )


def node_input(row) -> NodeInput:
    """What a row asks for; its place as mm is resolved with the axis."""
    place = row.s.value if row.s is not None else None
    return NodeInput(
        row.through,
        row.other,
        row.name or "",
        place,
        row.type,
        row.gap,
        row.stub_length,
        row.diaphragms,
        row.blend,
        row.s is not None and row.s.is_ratio,
    )


def with_nodes(schedule, jobs: Mapping[str, MemberJob]) -> tuple[dict[str, MemberJob], Found]:
    """The jobs of all members with their nodes, and what was found. Without ranks and rows no
    node can be resolved, and none is looked for.

    Raises BendTorsionError at the cells of rows that name no node.
    """
    ranks = {row.name: row.rank for row in schedule.members}
    if not schedule.nodes and not any(rank is not None for rank in ranks.values()):
        return dict(jobs), Found()
    rows = [node_input(row) for row in schedule.nodes]
    made, found = jobs_with_nodes(jobs, ranks, rows, node_rules(schedule.settings.rule_pack))
    of_rows = [own for f in found.findings for own in _at_row(schedule.nodes, f)]
    if of_rows:
        raise BendTorsionError(dict.fromkeys(of_rows))
    return made, found


def _at_row(rows, finding: Finding) -> Iterator[Finding]:
    """A finding at the cell of the row it is about, if it is about one."""
    if finding.position.startswith("row "):
        row = rows[int(finding.position.split()[1]) - 1]
        yield row.error("other", finding.code, finding.message, finding.mend)
    elif finding.code == "node-gap":
        own = [r for r in rows if {r.through, r.other} == set(finding.objects)]
        for row in own:
            if row.gap == finding.value:
                fields = {key: getattr(finding, key) for key in ("value", "limit", "unit")}
                yield row.error("gap", finding.code, finding.message, finding.mend, **fields)
