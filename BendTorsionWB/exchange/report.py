# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of a build: report.json for programs, a table against the limits for people."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from itertools import chain

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


PROJECT_SHEETS = tuple(map(sheet_name, ("general_arrangement", "nodes", "set")))
"""Paths of the sheets of a whole project in the output folder."""
ARRANGEMENT, NODES, SHEET_SET = PROJECT_SHEETS


def all_findings(
    records: Sequence[MemberRecord], findings: Iterable[Finding] = ()
) -> list[Finding]:
    """The given findings, then those of the members' records and their figures, each once."""
    collected = list(findings)
    for record in records:
        collected.extend(record.findings)
        collected.extend(limit_findings(record))
    return list(dict.fromkeys(collected))


def findings_by_member(
    records: Sequence[MemberRecord], findings: Iterable[Finding]
) -> dict[str, list[Finding]]:
    """Those of `findings` that concern each member: its own, and those naming it or its plates."""
    # Each looked at once: a building has as many as plates.
    members: dict[str | Finding, list[str]] = {}
    for record in records:
        names = {record.member, *(plate.mark for plate in record.plates)}
        for key in (*names, *record.findings):
            members.setdefault(key, []).append(record.member)
    found: dict[str, list[Finding]] = {record.member: [] for record in records}
    for finding in findings:
        concerned = (members.get(key, ()) for key in (finding, *finding.objects))
        for name in dict.fromkeys(chain.from_iterable(concerned)):
            found[name].append(finding)
    return found


def of_members(names: Iterable[str], findings: Iterable[Finding]) -> dict[str, tuple[Finding, ...]]:
    """Those of `findings` that concern each of these members or one of its plates."""
    found: dict[str, dict[int, Finding]] = {name: {} for name in names}
    for place, finding in enumerate(findings):
        for own in finding.objects:
            ends = [k for k, letter in enumerate(own) if letter == "-"]
            for end in (*ends, len(own)):
                if own[:end] in found:
                    found[own[:end]][place] = finding
    return {name: tuple(own.values()) for name, own in found.items()}


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
        "nodes": _nodes(records, nodes),
        "findings": _findings(records, findings),
    }


def write_report(
    records: Sequence[MemberRecord],
    findings: Iterable[Finding],
    version: str,
    path: str | os.PathLike,
    nodes: Sequence[NodeRecord] | None = None,
    members: Sequence[str] | None = None,
) -> None:
    """Write report.json: strict JSON, UTF-8, a line for each member, node and finding. members:
    member_line of each record, where they were made before. Raises BendTorsionError when it cannot
    be written."""
    lines = {"members": list(map(member_line, records)) if members is None else members}
    lines["nodes"] = map(_ENCODER.encode, _nodes(records, nodes))
    lines["findings"] = map(_ENCODER.encode, _findings(records, findings))
    parts = [f'{{"version": {_ENCODER.encode(version)}']
    for key, own in lines.items():
        every = ",\n".join(own)
        parts.append(f'"{key}": [\n{every}\n]')
    write_whole(path, (",\n".join(parts) + "}\n").encode("utf-8", "replace"))


def member_line(record: MemberRecord) -> str:
    """A member in report.json, which changes with it alone."""
    return _ENCODER.encode(_member(record))


# An encoder that indents takes ten times as long.
_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)


def _nodes(records: Sequence[MemberRecord], nodes: Sequence[NodeRecord] | None) -> list[dict]:
    return [
        {**node_json(node), "other": node.other, "status": node.status}
        for node in (nodes_of(records) if nodes is None else nodes)
    ]


def _findings(records: Sequence[MemberRecord], findings: Iterable[Finding]) -> list[dict]:
    return [_plain(finding.as_dict()) for finding in all_findings(records, findings)]


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


def verdict(record: MemberRecord, own: Iterable[Finding]) -> str:
    """`FAIL` of a member in error, `over` of one beyond a limit, else `ok`. own: of what was found
    that which concerns it."""
    if not record.plates or has_error(own):
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
    told = findings_by_member(records, known)
    lines = [_table_row([name for name, _, _ in _HEADINGS])]
    lines.append("-" * len(lines[0]))
    good = 0
    for record in records:
        result = verdict(record, told[record.member])
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
