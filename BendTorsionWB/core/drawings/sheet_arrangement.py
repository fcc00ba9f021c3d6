# SPDX-License-Identifier: LGPL-2.1-or-later
"""The general arrangement of a project: all members in elevation and plan, and their list."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..lofting import MemberRecord
from .sheet import Polyline, Sheet, Table, Text, View, text_box, text_width
from .sheet_labels import Labels, as_points, label_beyond, segments_of
from .sheet_overview import DRAWN_TOLERANCE, HEADING, SCALES, line_ends
from .sheet_page import TEXT, Page, Subject, finished
from .sheet_pattern import simplified
from .sheet_style import PLAIN_STYLE, SheetStyle, fixed
from .sheet_symbols import arrow, north_arrow
from .sheet_tables import ROW_HEIGHT, Listing, listing_pages, widths_of

LABEL_ROOM = 14.0
"""mm round each view, for the marks."""
NORTH_ROOM = 30.0
AXIS_LENGTH = 9.0


def arrangement_sheets(
    records: Sequence[MemberRecord], style: SheetStyle = PLAIN_STYLE
) -> tuple[Sheet, ...]:
    """The sheets of the general arrangement; none without a member that can be drawn. Members in
    error are in the list only."""
    drawn = [record for record in records if record.plates and record.wireframe]
    if not drawn:
        return ()
    pages = _pages(records, drawn, style)
    materials = dict.fromkeys(p.material for r in drawn for p in r.plates if p.material)
    subject = Subject(
        style.say("general arrangement"),
        style.say("{} members", len(records)),
        ", ".join(materials),
        sum(record.mass or 0.0 for record in drawn),
        ("drawing of", "extent", "members on this sheet", "total mass (net)"),
        "GA",
    )
    return tuple(
        finished(page, subject, style, number, len(pages))
        for number, page in enumerate(pages, start=1)
    )


def member_listing(records: Sequence[MemberRecord], style: SheetStyle) -> Listing:
    """The members with sections, length, mass, plates, pieces and centre of gravity."""
    say, site = style.say, style.site
    header = style.headings(("member", "sections", "length", "mass, kg", "plates", "pieces"))
    header += (say("CG on the site, {}", site.unit),)
    digits = 3 if site.unit == "m" else 0
    rows = []
    for record in records:
        if not record.plates:
            rows.append((record.member, say("in error"), *("",) * 5))
            continue
        centre = record.centre_of_gravity
        place = () if centre is None else site.of(np.asarray(centre, float)).tolist()
        rows.append(
            (
                record.member,
                record.sections,
                style.length(record.length or 0.0, 0),
                fixed(record.mass or 0.0, 1),
                str(len(record.plates)),
                str(max(len(record.pieces), 1)),
                ", ".join(fixed(value, digits) for value in place),
            )
        )
    return Listing(say("Members"), header, tuple(rows), "<<>>>>>")


def _pages(records, drawn, style: SheetStyle) -> list[Page]:
    form, say = style.page, style.say
    listing = member_listing(records, style)
    datum = _datum(style)
    wide = max(sum(listing.widths), sum(datum.widths))
    beside_width = form.right - form.left - wide - 8.0
    best = None
    # The list stands right of the views, or below them, left of the title block where it can.
    if beside_width > 60.0:
        room = form.top - form.clear_bottom - datum.height - 6.0
        views = _Views(drawn, (form.left, form.bottom, form.right - wide - 8.0, form.top), style)
        if form.right - wide - 8.0 > form.title_block[0] - 2.0:
            views = replace(views, area=(form.left, form.clear_bottom, *views.area[2:]))
        best = (views.scale, views, form.right - wide, form.top, int(room // ROW_HEIGHT) - 1)
    left_of_title = wide < form.note_width
    base = form.bottom if left_of_title else form.clear_bottom
    most = int(0.4 * (form.top - base) / ROW_HEIGHT)
    rows = min(len(listing.rows), most)
    top = base + ROW_HEIGHT * (rows + 1) + datum.height + 4.0
    views = _Views(
        drawn, (form.left, max(top + 3.0, form.clear_bottom), form.right, form.top), style
    )
    if best is None or views.scale < best[0]:
        best = (views.scale, views, form.left, top, rows)
    scale, views, x, y, rows = best
    table = Table(
        x,
        y - datum.height - 4.0,
        *(listing.widths, listing.header, listing.rows[:rows], listing.align, ROW_HEIGHT, TEXT),
    )
    page = views.drawn()
    page = replace(page, tables=(replace(datum, x=x, y=y), table))
    rest = replace(listing, rows=listing.rows[rows:])
    return [page, *listing_pages(say("members"), rest, style)]


def _datum(style: SheetStyle) -> Table:
    """Where the model's origin and axes lie on the site."""
    say, site = style.say, style.site
    digits = 3 if site.unit == "m" else 1
    origin = site.of(np.zeros(3)).tolist()
    header = style.said(("site datum", "x", "y", "z", "rotation, °"))
    turn = fixed(math.degrees(site.rotation), 4)
    row = (say("model origin, {}", site.unit), *(fixed(v, digits) for v in origin), turn)
    return Table(0.0, 0.0, widths_of(header, [row]), header, (row,), "<>>>>", ROW_HEIGHT, TEXT)


@dataclass(frozen=True)
class _Views:
    """Elevation and plan of members within an area, at the largest scale that fits."""

    records: Sequence[MemberRecord]
    area: tuple[float, float, float, float]
    style: SheetStyle

    @property
    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        points = np.concatenate([line for r in self.records for line in r.wireframe.values()])
        points = np.vstack([points, np.zeros(3)]) if _near(points) else points
        return points.min(axis=0), points.max(axis=0)

    @property
    def scale(self) -> int:
        low, high = self.bounds
        left, bottom, right, top = self.area
        width = right - left - 2 * LABEL_ROOM
        height = top - bottom - 2 * HEADING - 4 * LABEL_ROOM
        for scale in SCALES:
            size = (high - low) / scale
            across = size[0] + (NORTH_ROOM if self._north_beside(size, width) else 0.0)
            if across <= width and size[1] + size[2] <= height:
                return scale
        return SCALES[-1]

    @staticmethod
    def _north_beside(size, width) -> bool:
        return size[0] + NORTH_ROOM <= width or size[0] > width

    def drawn(self) -> Page:
        """The page of both views, with a north arrow and the axes at the model's origin."""
        style, scale = self.style, self.scale
        say = style.say
        low, high = self.bounds
        left, bottom, right, top = self.area
        size = (high - low) / scale
        spare = max(0.0, top - bottom - 2 * HEADING - 4 * LABEL_ROOM - float(size[1] + size[2]))
        x0 = left + LABEL_ROOM - float(low[0]) / scale
        x0 += 0.5 * max(0.0, right - left - 2 * LABEL_ROOM - NORTH_ROOM - float(size[0]))
        parts = [("Elevation", 2), ("Plan", 1)]
        views, lines, texts = [], [], []
        for name, up in parts if style.first_angle else parts[::-1]:
            texts.append(Text(left, top - 4.5, 3.5, f"{say(name)}  1:{scale}"))
            y0 = top - HEADING - LABEL_ROOM - float(high[up]) / scale
            view = self._view(name, scale, (x0, y0), (0, up))
            views.append(view)
            first = len(lines), len(texts)
            self._axes(lines, texts, view, "xy" if up == 1 else "xz", low, scale, up)
            if up == 1:
                angle = -style.site.rotation
                middle = y0 + 0.5 * float(low[1] + high[1]) / scale
                more, words = north_arrow(right - 14.0, middle, angle, say("N"))
                lines += more
                texts += words
            own = self._marks(view, (0, up), scale, lines[first[0] :], texts[first[1] :])
            lines += own.leaders
            texts += own.texts
            top = y0 + float(low[up]) / scale - LABEL_ROOM - 0.5 * spare
        marks = tuple(record.member for record in self.records)
        heading = say("plan and elevation")
        return Page(heading, marks, f"1:{scale}", tuple(views), tuple(lines), tuple(texts))

    def _view(self, name: str, scale: int, origin, plane) -> View:
        polylines = []
        for record in self.records:
            for key, line in record.wireframe.items():
                if "-" in key:  # rings of diaphragms and end plates: too fine here
                    continue
                points = simplified(line[:, plane], DRAWN_TOLERANCE * scale)
                polylines.append(
                    Polyline(as_points(points), "chain" if key == "axis" else "narrow")
                )
            for ends in _member_ends(record):
                polylines.append(Polyline(as_points(ends[:, plane]), "narrow"))
        return View(name, float(scale), origin, tuple(polylines))

    def _marks(self, view: View, plane, scale: int, beside, words) -> Labels:
        """Marks beyond an end of each axis, where there is room beside other lines and texts."""
        boxes = [text_box(text) for text in words]
        around = [Polyline(as_points(np.vstack([box, box[[0, 2]]]))) for box in boxes]
        lines = [*view.on_page(), *beside, *around]
        labels = Labels(segments_of(line.points for line in lines))
        for record in self.records:
            axis = record.wireframe.get("axis")
            if axis is None:
                axis = max(record.wireframe.values(), key=lambda line: np.ptp(line, axis=0).max())
            path = axis[:, plane] / scale + view.origin
            ends = ((path[0], path[1]), (path[-1], path[-2]))
            width = text_width(record.member, TEXT)
            for end, inner in ends:
                away = (end - inner) / max(np.hypot(*(end - inner)), 1e-9)
                inside = self.area[0] + width < end[0] + 8 * away[0] < self.area[2] - width
                if inside and label_beyond(labels, record.member, end + 2.0 * away, inner):
                    break
        return labels

    def _axes(self, lines, texts, view: View, names: str, low, scale: int, up: int) -> None:
        """Arrows along the model's axes: at its origin when that is shown, else at the corner."""
        x, y = view.origin
        if not (low[0] <= 0.0 <= self.bounds[1][0] and low[up] <= 0.0 <= self.bounds[1][up]):
            x = self.area[0] + 3.0
            y += float(low[up]) / scale - LABEL_ROOM + 2.0
        lines += arrow((x, y), (x + AXIS_LENGTH, y)) + arrow((x, y), (x, y + AXIS_LENGTH))
        # Members may lie along an axis: its name stands beside them.
        labels = Labels(segments_of(line.points for line in (*view.on_page(), *lines)))
        for right, above, name in ((AXIS_LENGTH + 1.0, -0.9, names[0]),
                                   (-0.6, AXIS_LENGTH + 1.0, names[1])):  # fmt: skip
            aside = (0.0, 1.7, -1.7, 3.4, -3.4, 5.1, -5.1, 6.8, -6.8, 8.5, -8.5)
            places = [(0.0, a) if right > 0.0 else (a, 0.0) for a in aside]
            named = [Text(x + right + dx, y + above + dy, TEXT, name) for dx, dy in places]
            texts.append(next((text for text in named if labels.put(text)), named[0]))


def _member_ends(record: MemberRecord) -> list[np.ndarray]:
    """The lines (2, 3) that end the faces of a member: those its first plates begin at and its
    last ones end at."""
    found = []
    for face in dict.fromkeys(plate.face for plate in record.plates if plate.lines):
        own = [plate for plate in record.plates if plate.face == face and plate.lines]
        first, last = min(p.s_start for p in own), max(p.s_end for p in own)
        found += [line_ends(p, "E-1") for p in own if p.s_start < first + 1.0]
        found += [line_ends(p, "E-2") for p in own if p.s_end > last - 1.0]
    return [ends for ends in found if len(ends) == 2]


def _near(points: np.ndarray) -> bool:
    """True when the model's origin lies about the members and may be shown with them."""
    low, high = points.min(axis=0), points.max(axis=0)
    reach = 0.25 * float((high - low)[:2].max())
    return bool(
        np.all(low[:2] - reach <= 0.0)
        and np.all(high[:2] + reach >= 0.0)
        and np.all((low[2] - reach <= 0.0) & (high[2] + reach >= 0.0))
    )
