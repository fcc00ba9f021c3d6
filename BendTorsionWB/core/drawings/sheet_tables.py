# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of sheets: how wide columns are, a table as a block, and a member's pieces and zones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ..lofting import MemberRecord
from .sheet import Table, Text, text_width, wrapped
from .sheet_pack import GAP, Block
from .sheet_page import TEXT, Page
from .sheet_style import SheetStyle, fixed

ROW_HEIGHT = 3.8
MOST_ROWS = 9
"""Rows of a table of pieces or zones; the last one says how many more there are in
results.xlsx."""
LEAST_COLUMN = 40
"""Rows of a table beside which the rest of a listing begins a column of its own."""
TITLE_HEIGHT, TITLE_ROOM = 2.5, 5.0
LEAST_WIDTH = 10.0
"""mm; columns are made no narrower than this."""


@dataclass(frozen=True)
class Listing:
    """Rows under a title and a header, before they are cut into tables. align as Table's;
    together: so many rows from the first on stay in one table, and so on; room: mm, width of the
    tables at most."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str
    together: int = 1

    def most(self, rows: int) -> int:
        """Of at most `rows` rows those a table has with none torn from its group."""
        return max(rows // self.together, 1) * self.together

    room: float = math.inf

    @cached_property
    def widths(self) -> tuple[float, ...]:
        """Of the columns, mm: what their cells take; where all of them are wider than the room
        there is, the widest are made narrower, and cells too wide for them are cut."""
        widths = list(widths_of(self.header, self.rows))
        while sum(widths) > self.room and max(widths) > LEAST_WIDTH:
            widths[widths.index(max(widths))] -= 0.5
        return tuple(widths)

    def within(self, room: float) -> Listing:
        """The listing with columns that together are no wider than `room`, mm."""
        return replace(self, room=room)


def table_blocks(listing: Listing, most: int, continued: str) -> list[Block]:
    """The listing as tables of at most `most` rows, each a block hanging from (0, 0); the title
    stands above, with `continued` after it above all but the first."""
    widths = listing.widths
    wide = sum(widths)
    most, blocks = listing.most(most), []
    for start in range(0, len(listing.rows), most):
        rows = listing.rows[start : start + most]
        title = f"{listing.title} ({continued})" if start else listing.title
        fits = text_width(title, TITLE_HEIGHT) <= wide
        height = TITLE_HEIGHT if fits else TEXT
        texts = (Text(0.0, -3.4, height, title),) if title else ()
        top = -TITLE_ROOM if title else 0.0
        table = Table(0.0, top, widths, listing.header, rows, listing.align, ROW_HEIGHT, TEXT)
        room = max([wide, *(text_width(text.text, text.height) for text in texts)])
        box = (0.0, top - table.height, room, 0.0)
        blocks.append(Block("", (), (), texts, box, (table,)))
    return blocks


def even_rows(count: int, most: int) -> int:
    """Rows of each part of a table that is parted so that none has more than `most`."""
    return -(-count // -(-count // most))


def piece_table(record: MemberRecord, x: float, y: float, style: SheetStyle) -> Table | None:
    """The delivery pieces of a member of several, up to MOST_ROWS."""
    if len(record.pieces) < 2:
        return None
    say = style.say
    header = style.headings(
        ("piece", "from", "to", "starts", "ends", "gap", "parts", "mass, kg", "centre x, y, z")
    )
    rows = [
        (
            str(own.piece.number),
            style.length(own.piece.start),
            style.length(own.piece.end),
            say("stepped") if own.piece.start_offsets else say("square"),
            say("stepped") if own.piece.end_offsets else say("square"),
            style.fine(own.piece.gap),
            str(len(own.marks)),
            fixed(own.mass, 1),
            ", ".join(style.measure(value, 0) for value in own.centre_of_gravity),
        )
        for own in record.pieces[:MOST_ROWS]
    ]
    if len(record.pieces) > MOST_ROWS:
        rows.append((f"+{len(record.pieces) - MOST_ROWS}", "…", *("",) * 7))
    return _standing(x, y, header, rows, ">>><<>>>>")


def zone_table(record: MemberRecord, x: float, y: float, style: SheetStyle) -> Table | None:
    """The zones of a member whose section changes, up to MOST_ROWS; steps and slopes."""
    if len(record.zones) < 2:
        return None
    header = style.said(
        ("zone", "group", "from", "to", "slope", "d top", "d bottom", "d left", "d right")
    )
    rows = [
        (
            zone.label,
            zone.group,
            style.length(zone.start),
            style.length(zone.end),
            f"1:{zone.slope:.4g}" if zone.slope else style.say("step") if zone.steps else "",
            *(style.fine(step) for step in zone.steps or ()),
            *("",) * (0 if zone.steps else 4),
        )
        for zone in record.zones[:MOST_ROWS]
    ]
    if len(record.zones) > MOST_ROWS:
        rows.append((f"+{len(record.zones) - MOST_ROWS}", "…", *("",) * 7))
    return _standing(x, y, header, rows, "<<>>>>>>>")


def fold_table(record: MemberRecord, x: float, y: float, style: SheetStyle) -> Table | None:
    """How far each face is folded where zones begin, degrees, positive where its outer side is
    convex; up to MOST_ROWS. None without folds."""
    faces = list(dict.fromkeys(plate.face for plate in record.plates if plate.lines))
    found: dict[int, dict[str, float]] = {}
    for plate in record.plates:
        for fold in plate.folds:
            found.setdefault(round(fold.s), {})[plate.face] = math.degrees(fold.angle)
    if not found:
        return None
    header = (style.say("fold, s"), *(style.say("{}, °", style.say(face)) for face in faces))
    rows = [
        (style.length(s), *(fixed(own[face], 1) if face in own else "–" for face in faces))
        for s, own in sorted(found.items())[:MOST_ROWS]
    ]
    if len(found) > MOST_ROWS:
        rows.append((f"+{len(found) - MOST_ROWS}", *("…" for _ in faces)))
    return _standing(x, y, header, rows, ">" * len(header))


def _standing(x: float, y: float, header, rows, align: str) -> Table:
    """A table whose lower left corner is (x, y)."""
    top = y + ROW_HEIGHT * (len(rows) + 1)
    return Table(x, top, widths_of(header, rows), header, tuple(rows), align, ROW_HEIGHT, TEXT)


def widths_of(header: Sequence[str], rows: Sequence[Sequence[str]]) -> tuple[float, ...]:
    """Column widths that hold every cell, mm, in steps of half a millimetre."""
    columns = zip(header, *rows, strict=True)
    widest = (max(text_width(cell, TEXT) for cell in set(column)) for column in columns)
    return tuple(-(-(width + 2.2) // 0.5) * 0.5 for width in widest)


def listing_pages(heading: str, listing: Listing, style: SheetStyle, note: str = "") -> list[Page]:
    """A listing as tables side by side, on as many pages as they need; none without rows."""
    if not listing.rows:
        return []
    form, widths = style.page, listing.widths
    wide = sum(widths)
    count = max(1, int((form.right - form.left + GAP) // (wide + GAP)))
    lines = wrapped(note, TEXT, form.note_width or form.right - form.left) if note else []
    foot = form.bottom + 1.0 if form.note_width else form.clear_bottom
    texts = tuple(
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), TEXT, line)
        for k, line in enumerate(lines)
    )
    bottom = foot + 3.2 * len(lines) + 2.0 if lines else form.bottom
    pages, start = [], 0
    # A few rows are no single column beside an empty page.
    columns = min(count, -(-len(listing.rows) // LEAST_COLUMN))
    even = -(-len(listing.rows) // columns)
    while start < len(listing.rows):
        tables = []
        for k in range(count):
            x = form.left + k * (wide + GAP)
            clear = x + wide < form.title_block[0] - 1.0
            floor = (
                bottom if clear else max(bottom if not form.note_width else 0.0, form.clear_bottom)
            )
            fits = min(int((form.top - floor) // ROW_HEIGHT) - 1, even)
            part = tuple(listing.rows[start : start + fits])
            if part:
                tables.append(
                    Table(
                        x, form.top, widths, listing.header, part, listing.align, ROW_HEIGHT, TEXT
                    )
                )
            start += len(part)
        pages.append(Page(heading, texts=texts, tables=tuple(tables)))
    return pages
