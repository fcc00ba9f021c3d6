# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member's record laid out as A3 sheets: overview, flat patterns, point tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from .finding import Finding, has_error
from .lofting import DevelopedPlate, MemberRecord
from .sheet import Sheet, Table, Text, text_width, wrapped
from .sheet_overview import SCALES, overview
from .sheet_page import (
    BOTTOM,
    LEFT,
    RIGHT,
    TEXT,
    TITLE_BLOCK,
    TOP,
    Page,
    finished,
    fixed,
    with_unit,
)
from .sheet_pattern import Block, pattern_block

ROW_HEIGHT = 3.8
GAP = 5.0
PATTERN_BOTTOM = TITLE_BLOCK[3] + 3.0
STATION_ROOM = 8.0  # mm on paper that station lines keep at least, where a choice of scale is left
PATTERN_NOTE = (
    "Patterns are drawn on the mid-surface as seen from the marking face. u runs right and v up "
    "from the cross at the lower left corner of each pattern's bounding box. L: station line, "
    "E: end line, P: point, small cross: witness mark W, F (dashed): fold line with its angle, "
    "positive where the outer face is convex. Dimensions are overall, in mm."
)
POINT_NOTE = (
    "s: arc length on the axis. x, y, z: model coordinates, 1 mm. u, v: flat pattern, 0.1 mm. "
    "P: on the outer face's corner line. W: witness mark on the marking face, inside the edge."
)


def member_sheets(record: MemberRecord, project: str = "", author: str = "") -> tuple[Sheet, ...]:
    """All sheets of one member, drawn by `author`; a record in error gives the one sheet that says
    so."""
    if has_error(record.findings):
        pages = [_error_page(record)]
    else:
        pages = [*_overview_pages(record), *_pattern_pages(record), *_point_pages(record)]
    return tuple(
        finished(page, record, project, author, number, len(pages))
        for number, page in enumerate(pages, start=1)
    )


# --- pages -----------------------------------------------------------------------------------


def _error_page(record: MemberRecord) -> Page:
    texts = [Text(LEFT, TOP - 10.0, 7.0, f"{record.member}: IN ERROR, NOT DRAWN")]
    y = TOP - 24.0
    for finding in record.findings:
        for line in wrapped(finding.line(), 2.5, RIGHT - LEFT):
            if y < PATTERN_BOTTOM:
                break
            texts.append(Text(LEFT, y, 2.5, line))
            y -= 4.6
        y -= 2.0
    return Page("in error", texts=tuple(texts))


def _overview_pages(record: MemberRecord) -> list[Page]:
    header = ("mark", "t", "length", "width", "mass, kg", "max error", "strain, %")
    rows = [
        (
            plate.mark,
            f"{plate.thickness:g}",
            fixed(plate.length, 1),
            fixed(plate.width, 1),
            fixed(plate.mass, 1),
            fixed(plate.length_error_max, 4),
            fixed(100.0 * plate.strain_max, 4),
        )
        for plate in record.plates
    ]
    widths = _widths(header, rows)
    columns = max(1, int((TITLE_BLOCK[0] - LEFT) // (sum(widths) + GAP)))
    most = 26
    height = min(-(-len(rows) // columns), most)
    tables = tuple(
        Table(
            LEFT + k * (sum(widths) + GAP),
            BOTTOM + ROW_HEIGHT * (height + 1),
            widths,
            header,
            tuple(rows[k * height : (k + 1) * height]),
            "<" + ">" * 6,
            ROW_HEIGHT,
            TEXT,
        )
        for k in range(columns)
        if rows[k * height : (k + 1) * height]
    )
    left_top = BOTTOM + ROW_HEIGHT * (height + 1) + 2.0
    texts = []
    if rows:
        text = "Plates (mm; length error of edges, lines and diagonals; net mass)"
        texts.append(Text(LEFT, left_top, 2.5, text))
    figures, notes, right_top = _member_data(record)
    base = max(left_top + 5.0, right_top + 2.0)
    page = Page("overview", tuple(p.mark for p in record.plates), texts=(*texts, *notes))
    page = replace(page, tables=(*tables, figures))
    if record.wireframe:
        drawn = overview(record, (LEFT, base, RIGHT, TOP))
        page = replace(
            page,
            scale=f"1:{drawn.scale}",
            views=drawn.views,
            lines=drawn.lines,
            texts=(*page.texts, *drawn.texts),
        )
    rest = rows[columns * height :]
    return [page, *_table_pages("plate list", header, rest, "<" + ">" * 6, lambda row: row[0], "")]


def _member_data(record: MemberRecord) -> tuple[Table, list[Text], float]:
    """The member's figures and warnings above the title block, and the height they reach."""
    degrees = 57.29577951308232
    rows = (
        (
            "length on the axis",
            with_unit(record.length, 0, "mm"),
            "axis to surface, rms",
            with_unit(record.axis_to_surface_rms, 4, "mm"),
        ),
        (
            "net mass",
            with_unit(record.mass, 1, "kg"),
            "axis to surface, max",
            with_unit(record.axis_to_surface_max, 4, "mm"),
        ),
        (
            "plates",
            str(len(record.plates)),
            "torsion error, max",
            with_unit(record.torsion_error_max, 5, "°", degrees),
        ),
        (
            "section type",
            record.section_type,
            "total torsion",
            with_unit(record.total_torsion, 2, "°", degrees),
        ),
    )
    x, width = TITLE_BLOCK[0] + 2.0, TITLE_BLOCK[2] - TITLE_BLOCK[0] - 4.0
    y = TITLE_BLOCK[3] + 3.0
    texts = []
    warnings = [f for f in record.findings if f.severity == "warning"]
    lines = _warning_lines(warnings, width, 14)
    for line in reversed(lines):
        texts.append(Text(x, y, TEXT, line))
        y += 3.3
    if lines:
        texts.append(Text(x, y + 0.6, 2.5, f"Warnings ({len(warnings)})"))
        y += 6.0
    table = Table(
        x,
        y + ROW_HEIGHT * (len(rows) + 1),
        (42.0, 44.0, 46.0, width - 132.0),
        ("member", record.member, "figure", "value"),
        rows,
        "<><>",
        ROW_HEIGHT,
        TEXT,
    )
    return table, texts, y + table.height


def _warning_lines(warnings: Sequence[Finding], width: float, most: int) -> list[str]:
    """Warnings wrapped to at most `most` lines; the last says how many are left out."""
    lines: list[str] = []
    for done, finding in enumerate(warnings):
        text = finding.line().removeprefix("warning: ")
        new = wrapped(text, TEXT, width)
        room = most if done == len(warnings) - 1 else most - 1
        if len(lines) + len(new) > room:
            return [*lines, f"and {len(warnings) - done} more: see the Checks of results.xlsx"]
        lines += new
    return lines


def _pattern_pages(record: MemberRecord) -> list[Page]:
    if not record.plates:
        return []
    shelves, scale = _shelved_patterns(record.plates)
    note = wrapped(PATTERN_NOTE, TEXT, TITLE_BLOCK[0] - LEFT - 6.0)
    texts = tuple(
        Text(LEFT, BOTTOM + 2.0 + 3.3 * (len(note) - 1 - k), TEXT, line)
        for k, line in enumerate(note)
    )
    pages = []
    for blocks in shelves:
        pages.append(
            Page(
                "flat patterns",
                tuple(block.mark for block in blocks),
                f"1:{scale}",
                tuple(block.view for block in blocks),
                tuple(line for block in blocks for line in block.lines),
                (*(text for block in blocks for text in block.texts), *texts),
            )
        )
    return pages


def _shelved_patterns(plates: Sequence[DevelopedPlate]) -> tuple[list[list[Block]], int]:
    """Patterns on pages at the one scale of the member: the largest that fits every plate and
    puts three on a page, unless station lines would come too close."""
    width, height = RIGHT - LEFT, TOP - PATTERN_BOTTOM
    fitting = [
        scale
        for scale in SCALES
        if all(p.length / scale + 22.0 <= width for p in plates)
        and all(p.width / scale + 32.0 <= height for p in plates)
    ] or [SCALES[-1]]
    wanted = fitting[0]
    for scale in fitting:
        if 500.0 / scale < STATION_ROOM:
            break
        wanted = scale
        sizes = [(max(p.length / scale + 20.0, 90.0), p.width / scale + 28.0) for p in plates]
        if len(plates) / _page_count(sizes, width, height) >= min(3, len(plates)):
            break
    for scale in (s for s in SCALES if s >= wanted):
        blocks = [pattern_block(plate, scale) for plate in plates]
        if all(b.box[2] - b.box[0] <= width and b.box[3] - b.box[1] <= height for b in blocks):
            break
    return _pack(blocks), scale


def _page_count(sizes: Sequence[tuple[float, float]], width: float, height: float) -> int:
    return len({page for page, _, _ in _shelf(sizes, width, height)})


def _shelf(sizes, width: float, height: float) -> list[tuple[int, float, float]]:
    """Page, left and top (downwards from 0) of each size, filled in order row by row."""
    places, page, x, y, row = [], 0, 0.0, 0.0, 0.0
    for wide, high in sizes:
        if x > 0.0 and x + wide > width:
            x, y, row = 0.0, y + row + GAP, 0.0
        if y > 0.0 and y + high > height:
            page, x, y, row = page + 1, 0.0, 0.0, 0.0
        places.append((page, x, y))
        x, row = x + wide + GAP, max(row, high)
    return places


def _pack(blocks: Sequence[Block]) -> list[list[Block]]:
    sizes = [(b.box[2] - b.box[0], b.box[3] - b.box[1]) for b in blocks]
    pages: list[list[Block]] = []
    for block, (page, x, y) in zip(
        blocks, _shelf(sizes, RIGHT - LEFT, TOP - PATTERN_BOTTOM), strict=True
    ):
        if page == len(pages):
            pages.append([])
        pages[page].append(block.moved(LEFT + x - block.box[0], TOP - y - block.box[3]))
    return pages


def _point_pages(record: MemberRecord) -> list[Page]:
    header = ("plate", "point", "line", "edge", "s", "x", "y", "z", "u", "v")
    rows = [
        (
            plate.mark,
            point.label,
            point.line,
            point.edge,
            fixed(point.s, 1),
            *(fixed(value, 0) for value in point.xyz),
            *(fixed(value, 1) for value in point.flat),
        )
        for plate in record.plates
        for point in plate.points
    ]
    align = "<<<<" + ">" * 6
    return _table_pages("points", header, rows, align, lambda row: row[0], POINT_NOTE)


def _table_pages(heading, header, rows, align, mark_of, note) -> list[Page]:
    """Rows as tables side by side, on as many pages as they need."""
    if not rows:
        return []
    widths = _widths(header, rows)
    wide = sum(widths)
    count = max(1, int((RIGHT - LEFT + GAP) // (wide + GAP)))
    pages, start = [], 0
    while start < len(rows):
        tables, first = [], start
        for k in range(count):
            x = LEFT + k * (wide + GAP)
            clear = x + wide < TITLE_BLOCK[0] - 1.0
            floor = BOTTOM + 6.0 if clear else PATTERN_BOTTOM
            fits = int((TOP - floor) // ROW_HEIGHT) - 1
            part = tuple(rows[start : start + fits])
            if part:
                tables.append(Table(x, TOP, widths, header, part, align, ROW_HEIGHT, TEXT))
            start += len(part)
        marks = tuple(dict.fromkeys(mark_of(row) for row in rows[first:start]))
        lines = wrapped(note, TEXT, TITLE_BLOCK[0] - LEFT - 4.0)[:2] if note else []
        texts = tuple(
            Text(LEFT, BOTTOM - 1.0 + 2.9 * (len(lines) - 1 - k), TEXT, line)
            for k, line in enumerate(lines)
        )
        pages.append(Page(heading, marks, texts=texts, tables=tuple(tables)))
    return pages


def _widths(header: Sequence[str], rows: Sequence[Sequence[str]]) -> tuple[float, ...]:
    """Column widths that hold every cell, mm, in steps of half a millimetre."""
    columns = zip(header, *rows, strict=True)
    widest = (max(text_width(cell, TEXT) for cell in set(column)) for column in columns)
    return tuple(-(-(width + 2.2) // 0.5) * 0.5 for width in widest)
