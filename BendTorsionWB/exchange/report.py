# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of a build: report.json for programs, a table against the limits for people."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence

from ..core.finding import Finding, has_error
from ..core.lofting import DevelopedPlate, MemberRecord
from ..core.nodes.node_record import NodeRecord
from ..core.welds.bevel_record import EdgeBevel
from .figures import (
    FIGURES,
    degrees,
    figures,
    largest,
    limit_findings,
    number,
    signs,
    within_limits,
)
from .node_tables import node_json, nodes_of
from .piece_table import piece_json
from .weld_tables import weld_json
from .whole_file import write_whole
from .zone_table import zone_json


def dxf_name(mark: str) -> str:
    """Path of a plate's DXF file in the output folder."""
    return f"plates/{mark}.dxf"


def nc1_name(mark: str) -> str:
    """Path of a plate's NC1 file in the output folder."""
    return f"nc1/{mark}.nc1"


def template_name(template: str) -> str:
    """Path of a template's DXF file in the output folder."""
    return f"templates/{template}.dxf"


def sheet_name(member: str) -> str:
    """Path of a member's sheets in the output folder."""
    return f"sheets/{member}.pdf"


def all_findings(
    records: Sequence[MemberRecord], findings: Iterable[Finding] = ()
) -> list[Finding]:
    """The given findings, then those of the members' records and their figures, each once."""
    collected = list(findings)
    for record in records:
        collected.extend(record.findings)
        collected.extend(limit_findings(record))
    return list(dict.fromkeys(collected))


def findings_of(record: MemberRecord, findings: Iterable[Finding]) -> list[Finding]:
    """Those of `findings` that concern a member: its own, and those naming it or its plates."""
    own = set(record.findings)
    names = {record.member, *(plate.mark for plate in record.plates)}
    return [f for f in findings if f in own or not names.isdisjoint(f.objects)]


def of_member(name: str, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Those of `findings` that concern the member or one of its plates."""
    return tuple(
        f for f in findings if any(own == name or own.startswith(f"{name}-") for own in f.objects)
    )


def report_json(
    records: Sequence[MemberRecord],
    findings: Iterable[Finding],
    version: str,
    nodes: Sequence[NodeRecord] | None = None,
) -> dict:
    """The content of report.json as plain JSON data; angles in degrees, missing figures None.

    `findings` are those of the build; the records' own are added. nodes: those of the project,
    with meetings that are none, or those of the records. Members in the given order.
    """
    return {
        "version": version,
        "members": [_member(record) for record in records],
        "nodes": [
            {**node_json(node), "other": node.other, "status": node.status}
            for node in (nodes_of(records) if nodes is None else nodes)
        ],
        "findings": [_plain(finding.as_dict()) for finding in all_findings(records, findings)],
    }


def write_report(
    records: Sequence[MemberRecord],
    findings: Iterable[Finding],
    version: str,
    path: str | os.PathLike,
    nodes: Sequence[NodeRecord] | None = None,
) -> None:
    """Write report.json: strict JSON, UTF-8, a line for each member, node and finding. Raises
    BendTorsionError when it cannot be written."""
    content = report_json(records, findings, version, nodes)
    # An encoder that indents takes ten times as long.
    encoder = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
    parts = [f'{{"version": {encoder.encode(content["version"])}']
    for key in ("members", "nodes", "findings"):
        lines = ",\n".join(map(encoder.encode, content[key]))
        parts.append(f'"{key}": [\n{lines}\n]')
    write_whole(path, (",\n".join(parts) + "}\n").encode("utf-8", "replace"))


def _member(record: MemberRecord) -> dict:
    return {
        "member": record.member,
        "length_mm": number(record.length),
        "mass_kg": number(record.mass),
        "axis_to_surface_rms_mm": number(record.axis_to_surface_rms),
        "axis_to_surface_max_mm": number(record.axis_to_surface_max),
        "torsion_error_max_deg": degrees(record.torsion_error_max),
        "total_torsion_deg": degrees(record.total_torsion),
        "plates": [_plate(plate) for plate in record.plates],
        "centre_of_gravity_mm": _place(record.centre_of_gravity),
        "painted_area_mm2": number(record.painted_area),
        "zones": [zone_json(zone) for zone in record.zones],
        "pieces": [piece_json(own) for own in record.pieces],
        "nodes": [node_json(own) for own in record.nodes],
        "welds": [weld_json(own) for own in record.welds],
    }


def _place(point) -> list | None:
    return None if point is None else [number(value) for value in point]


def _plate(plate: DevelopedPlate) -> dict:
    return {
        "mark": plate.mark,
        "part": plate.part,
        "face": plate.face,
        "piece": int(plate.piece),
        "thickness_mm": number(plate.thickness),
        "area_mm2": number(plate.area),
        "mass_kg": number(plate.mass),
        "length_mm": number(plate.length),
        "width_mm": number(plate.width),
        "length_error_max_mm": number(plate.length_error_max),
        "length_error_rms_mm": number(plate.length_error_rms),
        "length_error_bound_mm": number(plate.length_error_bound),
        "strain_max": number(plate.strain_max),
        "forming": plate.forming,
        "dxf": dxf_name(plate.mark),
        "nc1": nc1_name(plate.mark),
        "centre_of_gravity_mm": _place(plate.centre_of_gravity),
        "painted_area_mm2": number(plate.painted_area),
        "material": plate.material,
        "chamfers": [_chamfer(plate, own) for own in plate.bevels if own.chamfer],
        **_gross(plate),
        **_errors(plate),
    }


def _chamfer(plate: DevelopedPlate, bevel: EdgeBevel) -> dict:
    chamfer = bevel.chamfer
    return {
        "edge": bevel.edge,
        "face": chamfer.faces,
        "slope": number(chamfer.slope),
        "length_mm": number(chamfer.length),
        "depth_mm": number(chamfer.depth),
        "land_mm": number(bevel.land(plate.thickness)),
    }


def _gross(plate: DevelopedPlate) -> dict:
    """The plate as it is cut; net figures without allowances."""
    cut = plate.gross or plate
    return {
        "gross_length_mm": number(cut.length),
        "gross_width_mm": number(cut.width),
        "gross_area_mm2": number(cut.area),
        "gross_mass_kg": number(cut.mass),
    }


def _errors(plate: DevelopedPlate) -> dict:
    """What laying it flat costs by kind, flat minus true; of flat parts there are none."""
    found = plate.errors
    return {
        "edge_error_mm": number(found and found.edge),
        "line_error_mm": number(found and found.line),
        "diagonal_error_mm": number(found and found.diagonal),
        "centre_line_error_mm": number(found and found.centre_line),
        "area_error_mm2": number(found and found.area),
        "seam_mismatch_mm": number(found and found.seam),
        "locked_in_stress_mpa": number(plate.locked_in_stress),
    }


def _plain(record: dict) -> dict:
    """A check record with numbers that JSON can hold."""
    return {
        key: value if value is None or isinstance(value, str) else number(value)
        for key, value in record.items()
    }


def verdict(record: MemberRecord, known: Iterable[Finding]) -> str:
    """`FAIL` of a member in error, `over` of one beyond a limit, else `ok`."""
    if not record.plates or has_error(findings_of(record, known)):
        return "FAIL"
    return "ok" if within_limits(record) else "over"


_HEADINGS = (
    ("member", 10, "<"),
    ("sections", 25, "<"),
    ("plates", 6, ">"),
    ("length m", 8, ">"),
    ("mass kg", 9, ">"),
    *((name, 7 if name == "x bound" else 9, ">") for name, _, _ in FIGURES),
    ("result", 6, "<"),
)


def summary_lines(records: Sequence[MemberRecord], findings: Iterable[Finding]) -> list[str]:
    """A console table: a row per member, then the totals, the limits and the counted findings.

    Columns: axis rms (mm), largest torsion error (degrees), worst flat length error of plates
    without and with folds (mm), and the worst error over its proven bound. A figure beyond its
    limit carries an exclamation mark and makes the member `over`; one that is only told in a note
    carries a star. An error makes the member `FAIL`.
    """
    known = all_findings(records, findings)
    lines = [_table_row([name for name, _, _ in _HEADINGS])]
    lines.append("-" * len(lines[0]))
    good = 0
    for record in records:
        result = verdict(record, known)
        good += result == "ok"
        lines.append(_table_row([*_facts(record), *_marked(figures(record)), result]))
    lines.append("-" * len(lines[0]))
    plates = [plate for record in records for plate in record.plates]
    length = sum(record.length or 0.0 for record in records) / 1000.0
    mass = sum(record.mass or 0.0 for record in records)
    columns = zip(*(figures(record) for record in records)) if records else [()] * len(FIGURES)
    worst = [largest(value for value in column if value is not None) for column in columns]
    results = [line.split()[-1] for line in lines[2 : 2 + len(records)]]
    result = next((v for v in ("FAIL", "over") if v in results), "ok" if records else "FAIL")
    total = [f"{len(records)} in all", "", str(len(plates)), f"{length:.3f}", f"{mass:.1f}"]
    lines.append(_table_row([*total, *_marked(worst), result]))
    limits = [f"{limit:.{digits}f}" for _, limit, digits in FIGURES]
    lines.append(_table_row(["limits", "", "", "", "", *limits, ""]))
    counts = [
        f"{count} {severity}{'' if count == 1 else 's'}"
        for severity in ("error", "warning", "note")
        for count in [sum(finding.severity == severity for finding in known)]
    ]
    lines.append(f"{good} of {len(records)} members within the limits; {', '.join(counts)}")
    if any("*" in signs(figures(record)) for record in records):
        lines.insert(-1, "* beyond the usual, told in a note: no limit")
    return lines


def _facts(record: MemberRecord) -> list[str]:
    return [
        record.member,
        record.sections,
        str(len(record.plates)),
        "" if record.length is None else f"{record.length / 1000.0:.3f}",
        "" if record.mass is None else f"{record.mass:.1f}",
    ]


def _marked(values: Sequence[float | None]) -> list[str]:
    return [
        "" if value is None else f"{value:.{digits}f}{sign}"
        for value, (_, _, digits), sign in zip(values, FIGURES, signs(values), strict=True)
    ]


def _table_row(cells: Sequence[str]) -> str:
    return "  ".join(
        f"{cell:{side}{width}}" for cell, (_, width, side) in zip(cells, _HEADINGS)
    ).rstrip()
