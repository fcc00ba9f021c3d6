# SPDX-License-Identifier: LGPL-2.1-or-later
"""results.xlsx: the lofting data of a build as tables."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ..core.finding import SEVERITIES, Finding
from ..core.lofting import DevelopedPlate, MemberRecord
from ..core.nodes.node_record import NodeRecord
from ..core.site import AT_ORIGIN, SiteDatum
from .bed_tables import bed_tables
from .bevel_tables import bevel_tables
from .column_units import with_units
from .control_table import control_table
from .cutting_tables import cutting_tables
from .figures import degrees, largest
from .forming_tables import forming_tables
from .node_tables import node_tables
from .pattern_tables import EDGES, GROSS, edge_rows, gross_cells
from .piece_table import piece_table
from .report import all_findings, dxf_name, findings_by_member, nc1_name, sheet_name
from .weld_tables import weld_tables
from .whole_file import write_whole
from .xlsx_file import (
    FINE,
    STRAIN,
    TENTH,
    TEXT,
    WHOLE,
    Column,
    RowBlock,
    Table,
    row_block,
    xlsx_bytes,
)
from .zone_table import zone_table

SUMMARY = (
    Column("member", TEXT, 14),
    Column("sections", TEXT, 28),
    Column("type", TEXT, 8),
    Column("length", TENTH, 11),
    Column("mass", TENTH, 11),
    Column("plates", WHOLE, 8),
    Column("axis_to_surface_rms", FINE, 20),
    Column("axis_to_surface_max", FINE, 20),
    Column("torsion_error_max", STRAIN, 18),
    Column("total_torsion", TENTH, 14),
    Column("length_error_max", FINE, 18),
    Column("errors", WHOLE, 8),
    Column("warnings", WHOLE, 10),
    Column("notes", WHOLE, 8),
    *(Column(f"centre_{name}", TENTH, 11) for name in "xyz"),
    Column("painted_area", TENTH, 13),
)

PLATES = (
    Column("member", TEXT, 10),
    Column("plate", TEXT, 12),
    Column("part", TEXT, 12),
    Column("face", TEXT, 8),
    Column("piece", WHOLE, 7),
    Column("thickness", TENTH, 10),
    Column("length", TENTH, 10),
    Column("width", TENTH, 10),
    Column("net_area", TENTH, 13),
    Column("net_mass", TENTH, 10),
    Column("material", TEXT, 10),
    Column("length_error_max", FINE, 17),
    Column("strain_max", STRAIN, 11),
    Column("forming", TEXT, 9),
    Column("bending_radius_min", TENTH, 19),
    Column("dxf", TEXT, 22),
    Column("nc1", TEXT, 22),
    Column("sheet", TEXT, 18),
    *(Column(f"centre_{name}", TENTH, 11) for name in "xyz"),
    Column("painted_area", TENTH, 13),
    *GROSS,
)

POINTS = (
    Column("plate", TEXT, 12),
    Column("point", TEXT, 8),
    Column("line", TEXT, 8),
    Column("edge", TEXT, 8),
    Column("kind", TEXT, 9),
    *(
        Column(name, TENTH, 11)
        for name in ("s", "x", "y", "z", "local_x", "local_y", "local_z", "flat_u", "flat_v")
    ),
)

LINES = (
    Column("plate", TEXT, 12),
    Column("line", TEXT, 8),
    Column("from", TEXT, 8),
    Column("to", TEXT, 8),
    Column("length_3d", TENTH, 12),
    Column("length_flat", TENTH, 12),
    Column("difference", FINE, 12),
)

PANELS = (
    Column("plate", TEXT, 12),
    Column("panel", TEXT, 14),
    Column("what", TEXT, 14),
    Column("flat", TENTH, 11),
    Column("arc", TENTH, 11),
    Column("chord_outer", TENTH, 12),
)

CHECKS = (
    Column("severity", TEXT, 9),
    Column("code", TEXT, 24),
    Column("object", TEXT, 14),
    Column("position", TEXT, 18),
    Column("value", FINE, 12),
    Column("limit", FINE, 12),
    Column("unit", TEXT, 7),
    Column("message", TEXT, 60),
    Column("mend", TEXT, 60),
)


def write_results(
    records: Sequence[MemberRecord],
    findings: Iterable[Finding],
    path: str | os.PathLike,
    project: str = "",
    site: SiteDatum = AT_ORIGIN,
    nodes: Sequence[NodeRecord] | None = None,
    length: Callable[[float], str] | None = None,
    rows: Sequence[Mapping[str, RowBlock]] | None = None,
) -> None:
    """Write the results workbook to `path`; mm, kg, degrees at full precision.

    A sheet for each table, header names in row 1. `findings` are those of the build, the records'
    own are added. `project` is its title; `site`: where the model lies; `nodes`: of the project,
    with meetings that are none, or those of the records; `length`: writes lengths of findings in
    the unit of the sheets, beside mm; `rows`: member_rows of each record, where they were made
    before. The same input gives the same bytes. Raises BendTorsionError when the file cannot be
    written.
    """
    known = all_findings(records, findings)
    rows = [member_rows(record, site) for record in records] if rows is None else rows
    whole = {
        table.name: replace(table, blocks=[own[table.name] for own in rows])
        for table in member_tables((), site)
    }
    tables = (
        Table("Summary", SUMMARY, _summary(records, known), _project(records, known, project)),
        *(whole[n] for n in ("Zones", "Pieces", "Plates", "Points", "Lines", "Panels", "Edges")),
        *node_tables(records, nodes),
        *(whole[n] for n in ("Joints", "Welds", "Bevels", "Bars")),
        *cutting_tables(records),
        *(whole[n] for n in ("Forming", "FormingLines", "Bed", "Pins", "BedFrames", "Control")),
        _checks(known, length),
    )
    write_whole(path, xlsx_bytes(tuple(map(with_units, tables)), project))


def member_tables(
    records: Sequence[MemberRecord], site: SiteDatum = AT_ORIGIN
) -> tuple[Table, ...]:
    """The tables that hold rows of one member after the other."""
    plates = [plate for record in records for plate in record.plates]
    return (
        zone_table(records),
        piece_table(records),
        Table("Plates", PLATES, map(_plate, plates)),
        Table("Points", POINTS, (row for plate in plates for row in _points(plate))),
        Table("Lines", LINES, (row for plate in plates for row in _lines(plate))),
        Table("Panels", PANELS, (row for plate in plates for row in _panels(plate))),
        Table("Edges", EDGES, (row for plate in plates for row in edge_rows(plate))),
        *weld_tables(records),
        *bevel_tables(records),
        *forming_tables(plates),
        *bed_tables([bed for record in records for bed in record.beds]),
        control_table(records, site),
    )


def member_rows(record: MemberRecord, site: SiteDatum = AT_ORIGIN) -> dict[str, RowBlock]:
    """The rows of one member in member_tables, by the tables' names: what takes the time of the
    workbook, and changes with this member alone."""
    return {table.name: row_block(table) for table in member_tables([record], site)}


def _summary(records: Sequence[MemberRecord], known: Sequence[Finding]) -> Iterator[tuple]:
    told = findings_by_member(records, known)
    for record in records:
        yield (
            record.member,
            record.sections,
            record.section_type,
            record.length,
            record.mass,
            len(record.plates),
            record.axis_to_surface_rms,
            record.axis_to_surface_max,
            degrees(record.torsion_error_max),
            degrees(record.total_torsion),
            largest(plate.length_error_max for plate in record.plates),
            *_counts(told[record.member]),
            *_place(record.centre_of_gravity),
            record.painted_area,
        )


def _project(
    records: Sequence[MemberRecord], known: Sequence[Finding], project: str
) -> tuple[tuple, ...]:
    """The block below the members: totals under their columns, then figures by name."""
    plates = [plate for record in records for plate in record.plates]
    return (
        (
            "total",
            f"{len(records)} members",
            None,
            sum(record.length or 0.0 for record in records),
            sum(record.mass or 0.0 for record in records),
            len(plates),
            *(None,) * 4,
            largest(plate.length_error_max for plate in plates),
            *_counts(known),
        ),
        ("project", project),
        ("net_area", None, None, sum(plate.area for plate in plates)),
        ("units", "mm, mm2, kg, degrees"),
    )


def _counts(findings: Sequence[Finding]) -> tuple[int, ...]:
    return tuple(
        sum(finding.severity == severity for finding in findings) for severity in SEVERITIES
    )


def _plate(plate: DevelopedPlate) -> tuple:
    return (
        plate.member,
        plate.mark,
        plate.part,
        plate.face,
        int(plate.piece),
        plate.thickness,
        plate.length,
        plate.width,
        plate.area,
        plate.mass,
        plate.material,
        plate.length_error_max,
        plate.strain_max,
        plate.forming,
        plate.bending_radius_min,
        dxf_name(plate.mark),
        nc1_name(plate.mark),
        sheet_name(plate.member),
        *_place(plate.centre_of_gravity),
        plate.painted_area,
        *gross_cells(plate),
    )


def _place(point) -> tuple:
    return (None,) * 3 if point is None else tuple(point.tolist())


def _points(plate: DevelopedPlate) -> Iterator[tuple]:
    for point in plate.points:
        yield (
            plate.mark,
            point.label,
            point.line,
            point.edge,
            point.kind,
            point.s,
            *point.xyz.tolist(),
            *point.local.tolist(),
            *point.flat.tolist(),
        )


def _lines(plate: DevelopedPlate) -> Iterator[tuple]:
    # The points of a line are numbered from its first edge to its second.
    ends: dict[str, list[str]] = {}
    for point in plate.points:
        if point.kind == "arris":
            ends.setdefault(point.line, []).append(point.label)
    for line in plate.lines:
        labels = ends.get(line.label, [])
        yield (
            plate.mark,
            line.label,
            labels[0] if labels else None,
            labels[-1] if labels else None,
            line.length_3d,
            line.length_flat,
            line.length_flat - line.length_3d,
        )


def _panels(plate: DevelopedPlate) -> Iterator[tuple]:
    for panel in plate.panels:
        yield plate.mark, panel.panel, panel.what, panel.flat, panel.arc, panel.chord_outer


def _checks(known: Iterable[Finding], length: Callable[[float], str] | None) -> Table:
    """The findings; with `length` lengths as sheets write them besides."""
    if length is None:
        return Table("Checks", CHECKS, (tuple(f.as_dict().values()) for f in known))
    told = (Column("value_told", TEXT, 14), Column("limit_told", TEXT, 14))
    return Table("Checks", (*CHECKS, *told), (_told(finding, length) for finding in known))


def _told(finding: Finding, length: Callable[[float], str]) -> tuple:
    is_length = finding.unit == "mm"
    figures = (
        length(float(value)) if is_length and isinstance(value, (int, float)) else None
        for value in (finding.value, finding.limit)
    )
    return (*finding.as_dict().values(), *figures)
