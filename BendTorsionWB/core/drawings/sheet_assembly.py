# SPDX-License-Identifier: LGPL-2.1-or-later
"""The assembly drawing of a member or delivery piece: its views, its plates, its figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..finding import Finding
from ..lofting import MemberRecord
from .sheet import Table, Text, text_width, wrapped
from .sheet_findings import finding_text
from .sheet_overview import SCALES, overview
from .sheet_pack import Block
from .sheet_page import TEXT, Page, with_unit
from .sheet_style import SheetStyle, fixed
from .sheet_tables import (
    ROW_HEIGHT,
    Listing,
    fold_table,
    listing_pages,
    piece_table,
    table_blocks,
    widths_of,
    zone_table,
)

GAP = 5.0
LEAST_ROWS = 12
"""Rows of the list of plates beside which the rest begins another column."""
DEGREES = 57.29577951308232


def assembly_pages(record: MemberRecord, name: str, heading: str, style: SheetStyle) -> list[Page]:
    """The page of the views with figures and plates; what of the list of plates finds no room
    follows on pages of its own."""
    form, say = style.page, style.say
    listing = plate_listing(record, style)
    figures, notes, right_top = _figures(record, name, style)
    if form.is_small:
        return _small_pages(record, name, heading, style)
    rows, widths = listing.rows, listing.widths
    room = form.title_block[0] - form.left
    columns = int(room // (sum(widths) + GAP))
    most = int(0.4 * (form.top - form.bottom) / ROW_HEIGHT)
    # A few rows are one table, not a table each.
    each = max(-(-len(rows) // columns), min(len(rows), LEAST_ROWS)) if columns else 0
    height = min(each, most)
    tables = tuple(
        Table(
            form.left + k * (sum(widths) + GAP),
            form.bottom + ROW_HEIGHT * (height + 1),
            *(widths, listing.header, rows[k * height : (k + 1) * height]),
            *(listing.align, ROW_HEIGHT, TEXT),
        )
        for k in range(columns)
        if rows[k * height : (k + 1) * height]
    )
    left_top = form.bottom + (ROW_HEIGHT * (height + 1) + 2.0 if tables else 0.0)
    texts = []
    if tables:
        lines = wrapped(listing.title, 2.5, room - 4.0)
        texts = [
            Text(form.left, left_top + 4.0 * (len(lines) - 1 - k), 2.5, line)
            for k, line in enumerate(lines)
        ]
        left_top += 4.0 * len(lines)
    seats, words = _seats(record, form.left, 0.0, room - 4.0, style)
    if seats:
        # Laid out downwards from 0, then put above the list of plates.
        up = left_top + 2.0 - min(table.y - table.height for table in seats)
        seats = [replace(table, y=table.y + up) for table in seats]
        texts += [replace(text, y=text.y + up) for text in words]
        left_top = up
    bottom = max(left_top + 2.0, right_top + 2.0)
    tables = (*tables, *seats, *figures)
    page = Page(heading, texts=(*texts, *notes), tables=tables, lists_plates=bool(columns))
    rest = replace(listing, rows=rows[columns * height :])
    page = _with_views(page, record, bottom, style, name)
    if page.scale == f"1:{SCALES[-1]}":
        # The tables leave no room for the views.
        return _small_pages(record, name, heading, style)
    return [page, *_listed(listing_pages(say("plate list"), rest, style))]


def _small_pages(record: MemberRecord, name: str, heading: str, style: SheetStyle) -> list[Page]:
    """The pages of a small format: figures, saddles and plates below the views as far as these
    keep their scale, the rest on pages that follow."""
    form, say = style.page, style.say
    listing = plate_listing(record, style)
    figures, notes, top = _figures(record, name, style)
    box = (form.left, form.clear_bottom, form.right, top)
    blocks = [Block("", (), (), tuple(notes), box, figures)]
    seats = _seats_block(record, style)
    plates = [
        block.moved(form.left, 0.0)
        for block in table_blocks(listing, max(len(listing.rows), 1), "")
    ]
    whole = all(block.size[1] <= form.top - form.clear_bottom for block in plates)
    if whole and seats and plates and seats.size[0] + GAP <= form.right - plates[0].box[2]:
        # The plates with the saddles beside them.
        beside = seats.moved(plates[0].box[2] + GAP - seats.box[0], 0.0)
        low = min(beside.box[1], plates[0].box[1])
        plates = [
            replace(
                plates[0],
                texts=(*plates[0].texts, *beside.texts),
                tables=(*plates[0].tables, *beside.tables),
                box=(form.left, low, beside.box[2], 0.0),
            )
        ]
        seats = None
    blocks += ([seats] if seats else []) + (plates if whole else [])
    views = _with_views(Page(heading), record, form.clear_bottom, style, name)
    first, y = Page(heading), form.clear_bottom
    while blocks:
        high = blocks[0].size[1]
        drawn = _with_views(first, record, y + high + 4.0, style, name)
        if drawn.scale != views.scale or y + high > form.top:
            break
        first = _with_block(first, blocks[0], y, plates)
        y += high + GAP
        del blocks[0]
    pages = [_with_views(first, record, y, style, name)]
    room = 0.0
    for block in blocks:
        if block.size[1] > room:
            pages.append(Page(say("plate list" if block in plates else "figures")))
            room = form.top - form.clear_bottom
        pages[-1] = _with_block(pages[-1], block, form.clear_bottom + room - block.size[1], plates)
        room -= block.size[1] + GAP
    rest = [] if whole else listing_pages(say("plate list"), listing, style)
    return [*pages, *_listed(rest)]


def _seats_block(record: MemberRecord, style: SheetStyle) -> Block | None:
    """What `_seats` gives hanging from height 0; None without."""
    form = style.page
    tables, words = _seats(record, form.left, 0.0, form.right - form.left, style)
    if not tables:
        return None
    low = min(table.y - table.height for table in tables)
    right = max(table.x + sum(table.widths) for table in tables)
    right = max(right, *(text.x + text_width(text.text, text.height) for text in words))
    return Block("", (), (), tuple(words), (form.left, low, right, 0.0), tuple(tables))


def _with_block(page: Page, block: Block, y: float, plates: Sequence[Block]) -> Page:
    """The page with a block whose lower edge is at height y; known when it lists the plates."""
    placed = block.moved(0.0, y - block.box[1])
    return replace(
        page,
        texts=(*page.texts, *placed.texts),
        tables=(*page.tables, *placed.tables),
        lists_plates=page.lists_plates or block in plates,
    )


def _listed(pages: list[Page]) -> list[Page]:
    """Pages of the list of plates, known as such."""
    return [replace(page, lists_plates=True) for page in pages]


def _with_views(
    page: Page, record: MemberRecord, bottom: float, style: SheetStyle, name: str
) -> Page:
    if not record.wireframe:
        return page
    form = style.page
    drawn = overview(record, (form.left, bottom, form.right, form.top), style, name)
    return replace(
        page,
        marks=tuple(plate.mark for plate in record.plates),
        scale=f"1:{drawn.scale}",
        views=drawn.views,
        lines=drawn.lines,
        texts=(*page.texts, *drawn.texts),
    )


def _seats(
    record: MemberRecord, x: float, top: float, room: float, style: SheetStyle
) -> tuple[list[Table], list[Text]]:
    """What a piece lies on while it is put together, downwards from a height: saddles side by side
    with their places and the heights of their seats; the whole table is on the page of the bed."""
    tables, texts, y = [], [], top
    for bed in record.beds if len(record.pieces) < 2 else ():
        title = style.say(
            "Assembly bed {}: {} face down, heights above the floor, {}",
            *(bed.name, style.say(bed.face), style.measured_in),
        )
        y -= 3.4
        texts.append(Text(x, y, 2.5, title))
        names = style.said(("saddle", "s", "height left", "height right"))
        cells = [
            (one.label, *map(style.measure, (one.s, one.left.place[2], one.right.place[2])))
            for one in bed.saddles
        ]
        y -= 1.6
        while cells:
            # As many columns as there is room for.
            count = len(cells)
            while True:
                header, *rows = zip(names, *cells[:count], strict=True)
                widths = widths_of(header, rows)
                if sum(widths) <= room or count == 1:
                    break
                count -= 1
            align = "<" + ">" * count
            tables.append(Table(x, y, widths, header, tuple(rows), align, ROW_HEIGHT, TEXT))
            y -= tables[-1].height + 2.0
            cells = cells[count:]
    return tables, texts


def plate_listing(record: MemberRecord, style: SheetStyle) -> Listing:
    """The plates with size, mass, quantity, and what laying them flat costs."""
    say = style.say
    header = style.headings(("mark", "t", "length", "width", "mass, kg", "max error", "strain, %"))
    rows = tuple(
        (
            plate.mark,
            style.thickness(plate.thickness),
            style.length(plate.length),
            style.length(plate.width),
            fixed(plate.mass, 1),
            fixed(plate.length_error_max, 4),
            fixed(100.0 * plate.strain_max, 4),
        )
        for plate in record.plates
    )
    title = say("Plates (length error of edges, lines and diagonals, mm; net mass)")
    return Listing(title, header, rows, "<" + ">" * 6)


def _figures(
    record: MemberRecord, name: str, style: SheetStyle
) -> tuple[tuple[Table, ...], list[Text], float]:
    """Figures, pieces, zones and warnings above the title block, and the height they reach; name:
    of the member, or of the piece that the record is of."""
    say, form = style.say, style.page
    rows = [
        (
            say("length on the axis"),
            style.with_unit(record.length, 0),
            say("axis to surface, rms"),
            with_unit(record.axis_to_surface_rms, 4, "mm"),
        ),
        (
            say("net mass"),
            with_unit(record.mass, 1, "kg"),
            say("axis to surface, max"),
            with_unit(record.axis_to_surface_max, 4, "mm"),
        ),
        (
            say("plates"),
            str(len(record.plates)),
            say("torsion error, max"),
            with_unit(record.torsion_error_max, 5, "°", DEGREES),
        ),
        (
            say("section type"),
            record.section_type,
            say("total torsion"),
            with_unit(record.total_torsion, 2, "°", DEGREES),
        ),
    ]
    if record.centre_of_gravity is not None:
        centre = np.asarray(record.centre_of_gravity, float)
        digits = 3 if style.site.unit == "m" else 0
        rows.append(
            (
                say("CG in the model, {}", style.measured_in),
                ", ".join(style.measure(value, 0) for value in centre.tolist()),
                say("CG on the site, {}", style.site.unit),
                _triple(style.site.of(centre), digits),
            )
        )
    x, width = form.title_block[0] + 2.0, form.title_block[2] - form.title_block[0] - 4.0
    y = form.clear_bottom
    texts = []
    warnings = [f for f in record.findings if f.severity == "warning"]
    lines = _warning_lines(warnings, width, 14, style)
    for line in reversed(lines):
        texts.append(Text(x, y, TEXT, line))
        y += 3.3
    if lines:
        texts.append(Text(x, y + 0.6, 2.5, say("Warnings ({})", len(warnings))))
        y += 6.0
    more = []
    for table_of in (piece_table, zone_table, fold_table):
        table = table_of(record, x, y, style)
        if table is None:
            continue
        beside = more[-1] if more else None
        if beside and sum(beside.widths) + 4.0 + sum(table.widths) <= width:
            # Beside the one before, their upper edges level, when it is no higher.
            if table.height <= beside.height:
                more.append(replace(table, x=x + sum(beside.widths) + 4.0, y=beside.y))
                continue
        y += table.height + 2.0
        more.append(table)
    what = say("member" if name == record.member else "piece")
    header = (what, name, say("figure"), say("value"))
    widths = widths_of(header, rows)
    spare = max(0.0, width - sum(widths))
    widths = tuple(w + spare / 4.0 for w in widths)
    table = Table(
        x, y + ROW_HEIGHT * (len(rows) + 1), widths, header, tuple(rows), "<><>", ROW_HEIGHT, TEXT
    )
    return (table, *reversed(more)), texts, y + table.height


def _triple(point: np.ndarray, digits: int) -> str:
    return ", ".join(fixed(float(value), digits) for value in point)


def _warning_lines(
    warnings: Sequence[Finding], width: float, most: int, style: SheetStyle
) -> list[str]:
    """Warnings wrapped to at most `most` lines; the last says how many are left out."""
    lines: list[str] = []
    for done, finding in enumerate(warnings):
        new = wrapped(finding_text(finding, style), TEXT, width)
        room = most if done == len(warnings) - 1 else most - 1
        if len(lines) + len(new) > room:
            more = style.say("and {} more: see the Checks of results.xlsx", len(warnings) - done)
            return [*lines, more]
        lines += new
    return lines
