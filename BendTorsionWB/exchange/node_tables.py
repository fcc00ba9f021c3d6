# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets Nodes and NodeSteps of the results workbook, and the nodes in report.json."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..core.lofting import MemberRecord
from ..core.nodes.node_record import NodeRecord, in_order
from .xlsx_file import FINE, TENTH, TEXT, WHOLE, Column, Table

NODES = (
    Column("node", TEXT, 12),
    Column("kind", TEXT, 10),
    Column("through", TEXT, 10),
    Column("other", TEXT, 10),
    *(Column(name, TENTH, 11) for name in ("s_through", "s_other", "x", "y", "z", "angle")),
    Column("axis_distance", FINE, 14),
    Column("type", TEXT, 8),
    Column("gap", TENTH, 8),
    Column("stub_length", TENTH, 12),
    Column("lands_on", TEXT, 18),
    Column("step_max", FINE, 10),
    Column("step_angle_max", FINE, 15),
    Column("diaphragms", WHOLE, 11),
    Column("manhole", TENTH, 9),
    Column("status", TEXT, 24),
)
STEPS = (
    Column("node", TEXT, 12),
    Column("other", TEXT, 10),
    Column("side", TEXT, 7),
    Column("face", TEXT, 9),
    Column("edge", TEXT, 9),
    Column("through_face", TEXT, 13),
    Column("step", FINE, 10),
    Column("angle", FINE, 10),
    Column("in_line", TEXT, 8),
)


def nodes_of(records: Sequence[MemberRecord]) -> list[NodeRecord]:
    """The nodes of records by the member that runs through, in their order, and the place on it."""
    return in_order(
        [node for record in records for node in record.nodes], [own.member for own in records]
    )


def node_tables(
    records: Sequence[MemberRecord], nodes: Sequence[NodeRecord] | None = None
) -> tuple[Table, Table]:
    """A row per branch of every node, and one per edge of its faces; mm and degrees. nodes: of the
    project, or those of the records."""
    nodes = nodes_of(records) if nodes is None else nodes
    return (
        Table("Nodes", NODES, map(_row, nodes)),
        Table("NodeSteps", STEPS, (row for node in nodes for row in _steps(node))),
    )


def node_json(node: NodeRecord) -> dict:
    """A branch of a node as plain JSON data."""
    return {
        "node": node.node,
        "kind": node.kind,
        "through": node.through,
        "s_through_mm": node.s_through,
        "s_mm": node.s_other,
        "x_mm": node.x,
        "y_mm": node.y,
        "z_mm": node.z,
        "angle_deg": math.degrees(node.angle),
        "axis_distance_mm": node.axis_distance,
        "type": node.type,
        "gap_mm": node.gap,
        "stub_length_mm": node.stub_length,
        "lands_on": list(node.faces),
        "step_max_mm": node.largest_step,
        "step_angle_max_deg": _degrees(node.largest_angle),
        "diaphragms": node.diaphragms,
        "manhole_mm": node.manhole,
    }


def _row(node: NodeRecord) -> tuple:
    return (
        node.node,
        node.kind,
        node.through,
        node.other,
        node.s_through,
        node.s_other,
        node.x,
        node.y,
        node.z,
        math.degrees(node.angle),
        node.axis_distance,
        node.type,
        node.gap,
        node.stub_length,
        ", ".join(node.faces),
        node.largest_step,
        _degrees(node.largest_angle),
        node.diaphragms,
        node.manhole,
        node.status,
    )


def _steps(node: NodeRecord):
    for step in node.steps:
        yield (
            node.node,
            node.other,
            "before" if step.way < 0 else "behind",
            step.face,
            step.edge,
            step.through_face,
            step.step,
            math.degrees(step.angle),
            "yes" if step.in_line else "no",
        )


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else math.degrees(angle)
