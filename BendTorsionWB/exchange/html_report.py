# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of a project as one HTML file: pictures, figures against limits, tables, findings."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from urllib.parse import quote

from ..core.error_sources import ErrorSource
from ..core.finding import Finding
from ..core.lofting import MemberRecord
from ..core.nodes.node_record import NodeRecord
from . import figures, report
from .cutting_tables import cutting_tables
from .node_tables import nodes_of
from .whole_file import write_whole

_STYLE = """
body { font: 15px/1.45 "DejaVu Sans", "Noto Sans", sans-serif; color: #1d2733; margin: 0 auto;
  max-width: 1160px; padding: 24px; background: #fff }
h1 { font-size: 26px; margin: 0 0 4px } h2 { font-size: 19px; margin: 34px 0 8px }
p.sub { color: #5b6876; margin: 0 0 20px }
figure { margin: 18px 0 } figure svg { width: 100%; height: auto; max-height: 760px }
figcaption { color: #5b6876; font-size: 13px }
.tiles { display: flex; flex-wrap: wrap; gap: 10px }
.tile { border: 1px solid #d5dbe2; border-radius: 6px; padding: 8px 14px; min-width: 120px }
.tile b { display: block; font-size: 20px } .tile span { color: #5b6876; font-size: 13px }
.scroll { overflow-x: auto }
table { border-collapse: collapse; font-size: 13px; width: 100% }
th, td { text-align: left; padding: 4px 9px; border-bottom: 1px solid #e3e8ed;
  vertical-align: top }
th { background: #f2f5f8; position: sticky; top: 0 }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
td.over { color: #b3261e; font-weight: 600 }
.error { color: #b3261e } .warning { color: #8a5a00 } .note { color: #41607d }
details { margin: 6px 0 } summary { cursor: pointer } details svg { width: 100%; height: auto }
@media print { th { position: static } body { max-width: none } }
"""


@dataclass(frozen=True)
class Picture:
    """A picture for the report: caption and SVG text."""

    caption: str
    svg: str


def html_report(
    records: Sequence[MemberRecord],
    findings: Iterable[Finding],
    project: str,
    version: str,
    pictures: Sequence[Picture] = (),
    sources: Sequence[ErrorSource] = (),
    patterns: Sequence[Picture] = (),
    files: Iterable[tuple[str, str]] = (),
    length: Callable[[float], str] | None = None,
    nodes: Sequence[NodeRecord] | None = None,
    plates: Sequence[str] | None = None,
) -> str:
    """The whole page, nothing outside it needed to show it. pictures: at the top; patterns: below,
    to be unfolded; files: of the folder the page lies in, by name, and what is in them; length:
    writes lengths of findings beside mm, as of `Finding.line`; nodes: of the project, with meetings
    that are none, or those of the records; plates: plate_rows of each record, where they were made
    before."""
    known = report.all_findings(records, findings)
    title = escape(project or "BendTorsion project")
    parts = [
        f"<h1>{title}</h1>",
        f'<p class="sub">Report of BendTorsion {escape(version)}. '
        "Lengths in mm, masses in kg, angles in degrees.</p>",
        _tiles(records, known),
        *(_figure(picture) for picture in pictures if picture.svg),
        "<h2>Figures against limits</h2>",
        _figures(records, known),
        "<h2>Error sources, the largest first</h2>",
        _sources(sources),
        "<h2>Findings</h2>",
        _findings(known, length),
        "<h2>Flat patterns</h2>",
        *(_unfolding(picture) for picture in patterns if picture.svg),
        "<h2>Cutting list</h2>",
        _cutting(records),
        "<h2>Pieces</h2>",
        _pieces(records),
        *_nodes(nodes_of(records) if nodes is None else nodes),
        "<h2>Plates</h2>",
        _plates(map(plate_rows, records) if plates is None else plates),
        "<h2>Files of this folder</h2>",
        _table(["file", "what is in it"], [[_link(name), _cell(what)] for name, what in files]),
    ]
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{title}</title><style>{_STYLE}</style></head>\n<body>\n"
        + "\n".join(parts)
        + "\n</body></html>\n"
    )


def _figure(picture: Picture) -> str:
    return f"<figure>{picture.svg}<figcaption>{escape(picture.caption)}</figcaption></figure>"


def _unfolding(picture: Picture) -> str:
    return f"<details><summary>{escape(picture.caption)}</summary>{picture.svg}</details>"


def _link(name: str) -> str:
    """A file of the folder; one of several, such as `plates/<mark>.dxf`, is a name only."""
    if "<" in name:
        return _cell(name)
    return f'<td><a href="{escape(quote(name))}">{escape(name)}</a></td>'


def write_html_report(path: str | os.PathLike, *given, **more) -> None:
    """Write `html_report` whole or not at all. Raises BendTorsionError."""
    write_whole(path, html_report(*given, **more).encode("utf-8", "replace"))


def _tiles(records: Sequence[MemberRecord], known: Sequence[Finding]) -> str:
    plates = [plate for record in records for plate in record.plates]
    failed = sum(not record.plates for record in records)
    tiles = (
        (str(len(records)), "members"),
        (str(len(plates)), "plates"),
        (f"{sum(r.mass or 0.0 for r in records) / 1000.0:.1f} t", "net mass"),
        (f"{sum(r.length or 0.0 for r in records) / 1000.0:.1f} m", "length on the axes"),
        (str(failed), "members in error"),
        (str(sum(f.severity == "warning" for f in known)), "warnings"),
    )
    return (
        '<div class="tiles">'
        + "".join(f'<div class="tile"><b>{b}</b><span>{s}</span></div>' for b, s in tiles)
        + "</div>"
    )


def _figures(records: Sequence[MemberRecord], known: Sequence[Finding]) -> str:
    names = [name for name, _, _ in figures.FIGURES]
    header = ["member", "sections", "plates", "length", "mass", *names, "result"]
    told = report.findings_by_member(records, known)
    rows = []
    for record in records:
        cells = [
            _cell(record.member),
            _cell(record.sections),
            _number(float(len(record.plates)), 0),
            _number(record.length, 0),
            _number(record.mass, 1),
        ]
        values = figures.figures(record)
        for (_, _, digits), value, sign in zip(
            figures.FIGURES, values, figures.signs(values), strict=True
        ):
            cells.append(_number(value, digits, "over" if sign == "!" else ""))
        cells.append(_cell(report.verdict(record, told[record.member])))
        rows.append(cells)
    limits = [*(_cell("") for _ in range(4)), _cell("limit")]
    limits += [_number(limit, digits) for _, limit, digits in figures.FIGURES]
    return _table(header, [*rows, [*limits, _cell("")]], numbers=range(2, 10))


def _sources(sources: Sequence[ErrorSource]) -> str:
    rows = [
        [
            _cell(source.name),
            _number(source.size, 4 if source.size < 0.1 else 1),
            _cell(source.where),
            _cell(
                {"given": "in what was given", "fabrication": "in the shop"}.get(
                    source.kind, "computed here"
                )
            ),
            _cell(source.note),
        ]
        for source in sources
    ]
    return _table(["source", "size, mm", "worst at", "lies", "what it is"], rows, numbers=(1,))


def _findings(known: Sequence[Finding], length: Callable[[float], str] | None) -> str:
    if not known:
        return "<p>None.</p>"
    order = {"error": 0, "warning": 1, "note": 2}
    rows = [
        [
            f'<td class="{f.severity}">{f.severity}</td>',
            _cell(f.object),
            _cell(f.position),
            _cell(f.message),
            _value(f.value, f.unit, length),
            _value(f.limit, f.unit, length),
            _cell(f.mend),
        ]
        for f in sorted(known, key=lambda f: order.get(f.severity, 3))
    ]
    header = ["", "object", "where", "what", "value", "limit", "what mends it"]
    return _table(header, rows, numbers=(4, 5))


def _cutting(records: Sequence[MemberRecord]) -> str:
    """Totals by thickness and grade, the numbers of sheet CuttingTotals."""
    _, totals = cutting_tables(records)
    rows = [
        [
            _number(thickness, 0),
            _cell(material),
            _number(float(parts), 0),
            _number(float(plates), 0),
            *(
                _number(value * factor, digits)
                for value, factor, digits in zip(sums, (1e-6, 1.0) * 2, (2, 1) * 2, strict=True)
            ),
        ]
        for thickness, material, parts, plates, *sums in totals.rows
    ]
    header = ["t", "grade", "parts", "plates", "net, m²", "net, kg", "gross, m²", "gross, kg"]
    return _table(header, rows, numbers=(0, 2, 3, 4, 5, 6, 7))


def _pieces(records: Sequence[MemberRecord]) -> str:
    rows = [
        [
            _cell(record.member),
            _number(float(own.piece.number), 0),
            _number(own.piece.start, 0),
            _number(own.piece.end, 0),
            _number(float(len(own.marks)), 0),
            _number(own.mass, 1),
            _cell(" ".join(f"{value:.0f}" for value in own.centre_of_gravity)),
        ]
        for record in records
        for own in record.pieces
    ]
    header = ["member", "piece", "from", "to", "parts", "mass", "centre of gravity, model"]
    return _table(header, rows, numbers=(1, 2, 3, 4, 5))


def _nodes(nodes: Sequence[NodeRecord]) -> list[str]:
    """The list of nodes and of meetings that are none; nothing without any."""
    if not nodes:
        return []
    rows = [
        [
            _cell(node.node),
            _cell(node.kind),
            _cell(node.through),
            _number(node.s_through, 0),
            _cell(node.other),
            _number(node.s_other, 0),
            _number(report.degrees(node.angle), 2),
            _cell(node.type),
            _number(node.gap, 1),
            _cell(", ".join(node.faces)),
            _limited(node.largest_step, node.limits and node.limits[0]),
            _limited(
                report.degrees(node.largest_angle), node.limits and report.degrees(node.limits[1])
            ),
            _number(float(node.diaphragms), 0),
            _cell(node.status),
        ]
        for node in nodes
    ]
    header = [
        *("node", "kind", "through", "s", "branch", "s of branch", "angle", "type", "root gap"),
        *("lands on", "flange step", "flange angle", "diaphragms", "status"),
    ]
    return ["<h2>Nodes</h2>", _table(header, rows, numbers=(3, 5, 6, 8, 10, 11, 12))]


def _limited(value: float | None, limit: float | None) -> str:
    """A figure, marked where it is over its limit."""
    over = value is not None and limit is not None and value > limit
    return _number(value, 2, "over" if over else "")


def _plates(made: Iterable[str]) -> str:
    header = [
        "plate",
        "part",
        "piece",
        "t",
        "length",
        "width",
        "area, m²",
        "mass",
        "forming",
        "max error",
        "bound",
        "strain, %",
    ]
    body = "\n".join(rows for rows in made if rows)
    return _framed(header, body, (3, 4, 5, 6, 7, 9, 10, 11)) if body else "<p>None.</p>"


def plate_rows(record: MemberRecord) -> str:
    """A member's rows of the table of plates, which change with it alone."""
    return _rows(
        [
            _cell(p.mark),
            _cell(p.part),
            _cell(str(p.piece)),
            _number(p.thickness, 0),
            _number(p.length, 1),
            _number(p.width, 1),
            _number(p.area * 1e-6, 3),
            _number(p.mass, 1),
            _cell(p.forming or ""),
            _number(p.length_error_max, 4),
            _number(p.length_error_bound, 4),
            _number(100.0 * p.strain_max, 4),
        ]
        for p in record.plates
    )


def _table(header: Sequence[str], rows, numbers=()) -> str:
    return _framed(header, _rows(rows), numbers) if rows else "<p>None.</p>"


def _rows(rows: Iterable[Sequence[str]]) -> str:
    return "\n".join(f"<tr>{''.join(cells)}</tr>" for cells in rows)


def _framed(header: Sequence[str], body: str, numbers=()) -> str:
    head = "".join(
        f'<th class="n">{escape(name)}</th>' if k in numbers else f"<th>{escape(name)}</th>"
        for k, name in enumerate(header)
    )
    table = f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}\n</tbody></table>"
    return f'<div class="scroll">{table}</div>'


def _cell(text: str) -> str:
    return f"<td>{escape(str(text))}</td>"


def _number(value: float | None, digits: int, kind: str = "") -> str:
    text = "" if value is None else f"{value:.{digits}f}"
    return f'<td class="n {kind}">{text}</td>' if kind else f'<td class="n">{text}</td>'


def _value(value, unit: str, length: Callable[[float], str] | None) -> str:
    told = length(value) if length and unit == "mm" and isinstance(value, float) else ""
    if isinstance(value, float):
        value = f"{value:.4g}"
    text = "" if value is None or value == "" else f"{value} {unit}".strip()
    text = f"{told} ({text})" if told else text
    return f'<td class="n">{escape(text)}</td>'
