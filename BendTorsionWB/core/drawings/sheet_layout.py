# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member's record laid out as sheets: assemblies, sections and welds, plates, beds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..finding import has_error
from ..lofting import MemberRecord, ZoneRecord
from ..members.piece_record import Piece, PieceFigures
from .sheet import Sheet, Text, wrapped
from .sheet_assembly import assembly_pages
from .sheet_bed import (
    PINS_HEADER,
    PINS_NOTE,
    POINTS_NOTE,
    SEATS_HEADER,
    bed_page,
    pin_rows,
    point_listings,
    seat_rows,
    seats_shown,
)
from .sheet_findings import finding_text
from .sheet_page import Page, finished, subject_of
from .sheet_plate import plate_pages
from .sheet_references import with_numbers
from .sheet_section import section_pages
from .sheet_style import PLAIN_STYLE, SheetStyle
from .sheet_tables import Listing, listing_pages


def member_sheets(
    record: MemberRecord, style: SheetStyle = PLAIN_STYLE, with_plates: bool = True
) -> tuple[Sheet, ...]:
    """All sheets of one member: assemblies, beds, then the plates unless they are left out; a
    record in error gives the one sheet that says so."""
    if has_error(record.findings):
        pages = [_error_page(record, style)]
    else:
        pages = [*_assemblies(record, style), *_bed_pages(record, style)]
        pages += plate_pages(record, style) if with_plates else []
    subject = subject_of(record)
    pages = with_numbers(pages)
    return tuple(
        finished(page, subject, style, number, len(pages))
        for number, page in enumerate(pages, start=1)
    )


def _error_page(record: MemberRecord, style: SheetStyle) -> Page:
    form = style.page
    lines = wrapped(
        style.say("{}: IN ERROR, NOT DRAWN", record.member), 7.0, form.right - form.left
    )
    y = form.top - 10.0
    texts = []
    for line in lines:
        texts.append(Text(form.left, y, 7.0, line))
        y -= 14.0
    for finding in record.findings:
        for line in wrapped(finding_text(finding, style), 2.5, form.right - form.left):
            if y < form.clear_bottom:
                break
            texts.append(Text(form.left, y, 2.5, line))
            y -= 4.6
        y -= 2.0
    return Page(style.say("in error"), texts=tuple(texts))


def _assemblies(record: MemberRecord, style: SheetStyle) -> list[Page]:
    """The assembly drawing of each delivery piece, after an overview when there are several."""
    say = style.say
    if len(record.pieces) < 2:
        pages = assembly_pages(record, record.member, say("assembly"), style)
        return [*pages, *section_pages(record, say("sections and welds"), style)]
    pages = assembly_pages(record, record.member, say("overview"), style)
    for own in record.pieces:
        number = own.piece.number
        part, name = piece_record(record, own), f"{record.member}-P{number}"
        pages += assembly_pages(part, name, say("assembly P{}", number), style)
        pages += section_pages(part, say("sections and welds P{}", number), style)
    return pages


def piece_record(record: MemberRecord, own: PieceFigures) -> MemberRecord:
    """What of a member's record belongs to one of its delivery pieces."""
    piece = own.piece
    start, end = max(piece.start, 0.0), min(piece.end, record.length or piece.end)
    plates = tuple(plate for plate in record.plates if plate.piece == piece.number)
    marks = {plate.mark for plate in record.plates} - {plate.mark for plate in plates}
    zones = tuple(
        ZoneRecord(
            zone.label,
            zone.group,
            max(zone.start, start),
            min(zone.end, end),
            zone.slope,
            zone.steps,
        )
        for zone in record.zones
        if zone.end > start + 1.0 and zone.start < end - 1.0
    )
    return replace(
        record,
        length=end - start,
        mass=own.mass,
        plates=plates,
        wireframe=_clipped(
            {name: line for name, line in record.wireframe.items() if name not in marks},
            piece,
            {plate.letter: plate.face for plate in record.plates if plate.lines},
        ),
        findings=tuple(f for f in record.findings if f.object in {p.mark for p in plates}),
        zones=zones,
        centre_of_gravity=own.centre_of_gravity,
        painted_area=None,
        beds=tuple(bed for bed in record.beds if bed.piece == piece.number),
        pieces=(),
        welds=tuple(weld for weld in record.welds if weld.piece == piece.number),
        controls=tuple(one for one in record.controls if one.piece == piece.number),
    )


def _clipped(
    wireframe: dict[str, np.ndarray], piece: Piece, faces: dict[str, str]
) -> dict[str, np.ndarray]:
    """The lines along a member between the ends of a piece, a corner line as far as the longer of
    its two faces; others, such as rings, as they are. faces: by the letter that names a corner."""
    axis = wireframe.get("axis")
    if axis is None:
        return wireframe
    step = np.sqrt((np.diff(axis, axis=0) ** 2).sum(axis=1))
    s = np.concatenate([[0.0], np.cumsum(step)])
    clipped = {}
    for name, line in wireframe.items():
        if len(line) not in (len(s), 2 * len(s)):
            clipped[name] = line
            continue
        places = s if len(line) == len(s) else np.repeat(s, 2)
        own = [faces[letter] for letter in name if letter in faces] if name != "axis" else []
        start = max(min(map(piece.start_of, own), default=piece.start), 0.0)
        end = min(max(map(piece.end_of, own), default=piece.end), float(s[-1]))
        inside = line[(places > start) & (places < end)]
        ends = np.array(
            [[np.interp(at, places, line[:, k]) for k in range(3)] for at in (start, end)]
        )
        clipped[name] = np.vstack([ends[:1], inside, ends[1:]])
    return clipped


def _bed_pages(record: MemberRecord, style: SheetStyle) -> list[Page]:
    pages, say = [], style.say
    for bed in record.beds:
        page, with_points = bed_page(bed, style)
        pages.append(page)
        rest = seat_rows(bed, style)[seats_shown(style) :]
        points = () if with_points else point_listings(bed, style)
        tables = (
            (
                "seats",
                _table(SEATS_HEADER, rest, "<" + ">" * 8 + "<>>>", style),
                "",
            ),
            *((what, own, POINTS_NOTE) for what, own in points),
            ("pins", _table(PINS_HEADER, pin_rows(bed, style), ">" * 6, style), PINS_NOTE),
        )
        for what, listing, note in tables:
            heading = say("bed {}: {}", bed.name, say(what))
            words = say(note, style.measured_in) if note else ""
            pages += listing_pages(heading, listing, style, words)
    return pages


def _table(header, rows, align: str, style: SheetStyle) -> Listing:
    return Listing("", style.said(header), tuple(rows), align)
