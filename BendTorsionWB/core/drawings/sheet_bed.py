# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plan of an assembly bed: the piece from above and from the side, saddles, table of seats."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..beds.bed_record import Bed, Seat
from .sheet import Polyline, Table, Text, View, text_width, wrapped
from .sheet_labels import as_points
from .sheet_overview import DRAWN_TOLERANCE, SCALES
from .sheet_page import TEXT, Page
from .sheet_pattern import simplified
from .sheet_style import PLAIN_STYLE, SheetStyle, fixed
from .sheet_tables import ROW_HEIGHT, Listing, widths_of

MOST_ROWS = 22
"""Rows of the table of seats on the page of the plan."""
LABEL = 2.5
POST_OVERHANG = 80.0
"""mm; how far a saddle's bar is drawn beyond its seats."""
HEADING, LABEL_ROOM, FIGURE_ROOM, GAP = 7.0, 9.0, 16.5, 4.0
FLOOR_ROOM = 20.0
"""mm left and right of the views, for what is said of the floor."""
PLAN, ELEVATION = ("Plan", 1, LABEL_ROOM), ("Elevation", 2, 0.0)
"""Views: name, axis up, mm above for labels."""
CLOSEST = 9.0
"""mm on paper between saddles below which their labels take turns in two rows."""

SEATS_HEADER = (
    "saddle", "s", "left x", "left y", "left height", "right x", "right y", "right height",
    "slope, °", "stop", "stop x", "stop y", "stop height",
)  # fmt: skip
POINTS_HEADER = ("line", "corner", "s", "x", "y", "z", "bed x", "bed y", "bed z")
PINS_HEADER = ("column", "row", "x", "y", "height", "tilt, °")
POINTS_NOTE = (
    "x, y, z: model coordinates. bed x, y, z: on the bed, floor at 0. Outer corners of the "
    "section at the member's stations and the piece's ends, {}."
)
PINS_NOTE = "x, y: on the bed, {}. height: above the base of the pins. tilt: of the face there."


def seat_rows(bed: Bed, style: SheetStyle = PLAIN_STYLE) -> list[tuple[str, ...]]:
    """The table of seats: places on the bed, heights above the floor, 0.1 mm."""
    return [
        (
            one.label,
            style.measure(one.s),
            *map(style.measure, one.left.place),
            *map(style.measure, one.right.place),
            fixed(np.degrees(one.slope), 2),
            style.say(one.stop_side),
            *map(style.measure, one.stop),
        )
        for one in bed.saddles
    ]


def point_rows(bed: Bed, style: SheetStyle = PLAIN_STYLE) -> list[tuple[str, ...]]:
    """The table of control points, with their places on the site where that has a datum."""
    digits = 3 if style.site.unit == "m" else 1
    return [
        (
            p.line,
            p.corner,
            *map(style.measure, (p.s, *p.xyz, *p.bed)),
            *(fixed(v, digits) for v in style.site.of(p.xyz).tolist() if style.is_sited),
        )
        for p in bed.points
    ]


def points_header(style: SheetStyle) -> tuple[str, ...]:
    """The columns of `point_rows`."""
    site = [style.say("site {}, {}", name, style.site.unit) for name in "xyz" if style.is_sited]
    return (*style.said(POINTS_HEADER), *site)


def point_listings(bed: Bed, style: SheetStyle) -> list[tuple[str, Listing]]:
    """The control points under their heading; where places on the site make the list wider than a
    page, those are a list of their own."""
    header, rows = points_header(style), tuple(point_rows(bed, style))
    whole = Listing("", header, rows, "<<" + ">" * (len(header) - 2))
    if sum(whole.widths) <= style.page.right - style.page.left:
        return [("control points", whole)]
    own, site = len(POINTS_HEADER), (0, 1, 2, *range(len(POINTS_HEADER), len(header)))
    return [
        (
            "control points",
            Listing("", header[:own], tuple(row[:own] for row in rows), whole.align[:own]),
        ),
        (
            "control points on the site",
            Listing(
                "",
                tuple(header[k] for k in site),
                tuple(tuple(row[k] for k in site) for row in rows),
                "".join(whole.align[k] for k in site),
            ),
        ),
    ]


def pin_rows(bed: Bed, style: SheetStyle = PLAIN_STYLE) -> list[tuple[str, ...]]:
    """The table of pins."""
    return [
        (
            str(pin.column),
            str(pin.row),
            *map(style.measure, (pin.x, pin.y, pin.height)),
            fixed(np.degrees(pin.tilt), 2),
        )
        for pin in bed.pins
    ]


def seats_shown(style: SheetStyle) -> int:
    """How many rows of the table of seats stand on the page of the plan."""
    return 0 if style.page.is_small else MOST_ROWS


def bed_page(bed: Bed, style: SheetStyle = PLAIN_STYLE) -> tuple[Page, bool]:
    """Plan and elevation of a piece on its bed with the first rows of its table of seats; and
    whether its control points are there, too, as on large pages where the views leave room."""
    form, say = style.page, style.say
    rows = seat_rows(bed, style)[: seats_shown(style)]
    header = style.said(SEATS_HEADER)
    frame = _frame_table(bed, style)
    words = _words(bed, style)
    tables, texts = [frame], []
    y = form.clear_bottom
    if rows:
        widths = widths_of(header, rows)
        height = ROW_HEIGHT * (len(rows) + 1)
        # The table of seats may be wider than the room beside the title block.
        clear = form.left + sum(widths) < form.title_block[0] - 2.0
        foot = form.bottom if clear else form.clear_bottom
        align = "<" + ">" * 8 + "<" + ">" * 3
        seats = Table(
            form.left, foot + height, widths, header, tuple(rows), align, ROW_HEIGHT, TEXT
        )
        tables.insert(0, seats)
        title = say("Seats ({}, on the bed; heights above the floor)", style.measured_in)
        texts.append(Text(form.left, seats.y + 1.2, LABEL, title))
        y = max(seats.y + 6.0, frame.y + 3.0 if clear else 0.0)
        if not clear:
            tables[1] = replace(frame, x=form.left, y=form.bottom + frame.height)
            left = form.left + sum(frame.widths) + 6.0
            lines = wrapped(words, TEXT, form.title_block[0] - left - 3.0)
            top = tables[1].y - 3.0
            texts += [Text(left, top - 3.3 * k, TEXT, line) for k, line in enumerate(lines)]
            words = ""
    else:
        tables[0] = replace(frame, x=form.left)
        y = frame.y + 3.0
    lines = wrapped(words, TEXT, form.right - form.left)
    room = 3.3 * len(lines) + 2.0
    drawn = _views(bed, y + room, style)
    points = _points_beside(bed, tables, style)
    if points:
        high = points[0].y + 6.0
        beside = drawn if high <= y else _views(bed, high + room, style)
        if beside[0] == drawn[0]:
            drawn, y = beside, max(y, high)
            title = say("Control points ({})", style.measured_in)
            texts.append(Text(points[0].x, points[0].y + 1.2, LABEL, title))
            note = say(POINTS_NOTE, style.measured_in)
            texts.append(Text(points[0].x, form.bottom + 1.0, TEXT, note))
            tables += points
        else:
            points = []
    for line in reversed(lines):
        texts.append(Text(form.left, y, TEXT, line))
        y += 3.3
    page = Page(
        say("bed plan {}", bed.name),
        (),
        f"1:{drawn[0]}",
        drawn[1],
        drawn[2],
        (*drawn[3], *texts),
        tuple(tables),
    )
    return page, bool(points)


def _points_beside(bed: Bed, tables: list[Table], style: SheetStyle) -> list[Table]:
    """The control points as tables between those left of the title block and it, if they find room
    in less than half of the page's height."""
    form = style.page
    header, rows = points_header(style), point_rows(bed, style)
    own = [t for t in tables if t.x + sum(t.widths) < form.title_block[0]]
    left = max((table.x + sum(table.widths) for table in own), default=form.left) + GAP
    widths = widths_of(header, rows)
    note = text_width(style.say(POINTS_NOTE, style.measured_in), TEXT)
    right = form.title_block[0] - GAP
    count = int((right - left + GAP) // (sum(widths) + GAP))
    if form.is_small or not rows or count < 1 or left + note > right:
        return []
    each = -(-len(rows) // count)
    foot = form.bottom + 4.5
    top = foot + ROW_HEIGHT * (each + 1)
    if top - form.bottom > 0.4 * (form.top - form.bottom):
        return []
    parts = [tuple(rows[start : start + each]) for start in range(0, len(rows), each)]
    align = "<<" + ">" * (len(header) - 2)
    return [
        Table(left + k * (sum(widths) + GAP), top, widths, header, part, align, ROW_HEIGHT, TEXT)
        for k, part in enumerate(parts)
    ]


HOW_BEDDED = {
    "fit": "best plane of its edges",
    "middle": "its plane at mid-length",
    "normal": "plane by given direction",
}


def _words(bed: Bed, style: SheetStyle) -> str:
    say = style.say
    words = say(
        "Face {} lies down; bed by {}, its edges within ±{}. Plan seen from above; left is up. "
        "Bar: saddle with its seats; triangle: side stop at the lower seat. Elevation: heights of "
        "the left and the right seat above the floor. Templates: {}.",
        say(bed.face),
        say(HOW_BEDDED[bed.plane]),
        style.with_unit(bed.deviation),
        ", ".join(board.name for board in bed.templates),
    )
    if bed.pins:
        words += " " + say(
            "Pins (crosses): base {} above the floor.", style.with_unit(bed.pin_base)
        )
    return words


def _frame_table(bed: Bed, style: SheetStyle) -> Table:
    back, say, form = bed.to_model, style.say, style.page
    rows = (
        (say("origin, {}", style.measured_in), *(style.measure(v, 2) for v in back[:3, 3])),
        *(
            (say("{} axis", name), *(fixed(value, 8) for value in back[:3, k]))
            for k, name in enumerate("xyz")
        ),
    )
    header = (say("bed in the model"), "x", "y", "z")
    widths = widths_of(header, rows)
    return Table(
        form.title_block[0] + 2.0,
        form.clear_bottom + ROW_HEIGHT * 5,
        *(widths, header, rows, "<>>>", ROW_HEIGHT, TEXT),
    )


def _views(bed: Bed, bottom: float, style: SheetStyle):
    """Scale, views, lines and texts of plan and elevation between `bottom` and the page's top."""
    form = style.page
    everything = np.concatenate([*bed.lines.values(), bed.face_edges.reshape(-1, 3)])
    low, high = everything.min(axis=0), everything.max(axis=0)
    low[2] = min(low[2], 0.0)
    figures = (_height_text(*seat, style) for one in bed.saddles for seat in _seats_of(one))
    figure_room = max(FIGURE_ROOM, *(text_width(text, TEXT) + 2.5 for text in figures))
    room = form.top - bottom - 2 * (HEADING + figure_room) - LABEL_ROOM - GAP
    for scale in SCALES:
        size = (high - low) / scale
        if size[0] <= form.right - form.left - 2 * FLOOR_ROOM and size[1] + size[2] <= room:
            break
    spare = max(0.0, room - float(size[1] + size[2]))
    x0 = 0.5 * (form.left + form.right) - 0.5 * float(low[0] + high[0]) / scale
    y = form.top
    places, heads = {}, {}
    # Below each view stand figures, above the plan the names of saddles.
    for name, axis, above in (ELEVATION, PLAN) if style.first_angle else (PLAN, ELEVATION):
        heads[name] = y - 4.5
        y -= HEADING + above + 0.3 * spare
        places[name] = (x0, y - float(high[axis]) / scale)
        y = places[name][1] + float(low[axis]) / scale - figure_room - GAP
    plan, side = places["Plan"], places["Elevation"]
    foot = plan[1] + float(low[1]) / scale
    views = (
        View("Plan", float(scale), plan, _polylines(bed, (0, 1), scale)),
        View("Elevation", float(scale), side, _polylines(bed, (0, 2), scale)),
    )
    title = style.say("{} on its bed: plan", bed.name)
    beside = style.say("{} on its bed: elevation", bed.name)
    texts = [
        Text(form.left, heads["Plan"], 3.5, f"{title}  1:{scale}"),
        Text(form.left, heads["Elevation"], 3.5, f"{beside}  1:{scale}"),
    ]
    lines: list[Polyline] = []
    _plan_figures(bed, scale, plan, float(high[1]), foot, lines, texts, style)
    _side_figures(bed, scale, side, low, high, lines, texts, style)
    return scale, views, tuple(lines), tuple(texts)


def _polylines(bed: Bed, plane: tuple[int, int], scale: float) -> tuple[Polyline, ...]:
    lines = [
        Polyline(as_points(simplified(line[:, plane], DRAWN_TOLERANCE * scale)), "narrow")
        for line in bed.lines.values()
    ]
    lines += [
        Polyline(as_points(simplified(edge[:, plane], DRAWN_TOLERANCE * scale)), "medium")
        for edge in bed.face_edges
    ]
    names = list(bed.lines)
    for end in (0, -1):
        ring = np.array([bed.lines[name][end][list(plane)] for name in [*names, names[0]]])
        lines.append(Polyline(as_points(ring), "medium"))
    return tuple(lines)


def _plan_figures(bed: Bed, scale, origin, high, foot, lines, texts, style) -> None:
    """Saddle bars, stops, pins, labels above and places along x below the plan."""
    x0, y0 = origin
    places = [x0 + 0.5 * (o.left.place[0] + o.right.place[0]) / scale for o in bed.saddles]
    crowded = len(places) > 1 and min(np.diff(places)) < CLOSEST
    lines.append(Polyline(((x0 - 2.0, y0), (x0 + 2.0, y0))))
    lines.append(Polyline(((x0, y0 - 2.0), (x0, y0 + 2.0))))
    for pin in bed.pins:
        x, y = x0 + pin.x / scale, y0 + pin.y / scale
        lines.append(Polyline(((x - 0.6, y), (x + 0.6, y))))
        lines.append(Polyline(((x, y - 0.6), (x, y + 0.6))))
    for k, one in enumerate(bed.saddles):
        left, right = (
            np.array([x0, y0]) + seat.place[:2] / scale for seat in (one.left, one.right)
        )
        beyond = (left - right) / np.hypot(*(left - right)) * POST_OVERHANG / scale
        lines.append(Polyline(as_points(np.array([right - beyond, left + beyond])), "wide"))
        lines += [_ring(seat, 0.7) for seat in (left, right)]
        lines.append(_triangle(np.array([x0, y0]) + one.stop[:2] / scale, left - right, one))
        level = y0 + high / scale + 2.9 + (3.6 if crowded and k % 2 else 0.0)
        texts.append(Text(float(left[0]), level, LABEL, one.label, anchor="middle"))
        lines.append(Polyline(((float(left[0]), level - 1.2), as_points((left + beyond)[None])[0])))
        low = foot - 1.5
        lines.append(Polyline((as_points((right - beyond)[None])[0], (float(right[0]), low))))
        place = style.length(one.right.place[0], 0)
        texts.append(Text(float(right[0]) + 0.7, low - 0.8, TEXT, f"x {place}", 90.0, "end"))


def _side_figures(bed: Bed, scale, origin, low, high, lines, texts, style) -> None:
    """Floor, posts and seat heights of the elevation."""
    x0, z0 = origin
    lines.append(
        Polyline(
            ((x0 + low[0] / scale - 6.0, z0), (x0 + high[0] / scale + 6.0, z0)),
            "wide",
        )
    )
    # Left of the floor line, clear of the posts.
    texts.append(Text(x0 + low[0] / scale - 7.0, z0 - 0.9, TEXT, style.say("floor 0"), 0.0, "end"))
    for one in bed.saddles:
        places = []
        for seat, dash in ((one.left, "medium"), (one.right, "dashed")):
            x, z = x0 + seat.place[0] / scale, z0 + seat.place[2] / scale
            lines.append(Polyline(((x, z0), (x, z)), dash))
            places.append(x)
        # Two figures side by side below the floor, at the middle of their posts.
        middle = 0.5 * (places[0] + places[1])
        for shift, (seat, name) in zip((-0.3, 2.5), _seats_of(one), strict=True):
            text = _height_text(seat, name, style)
            texts.append(Text(middle + shift, z0 - 1.2, TEXT, text, 90.0, "end"))


def _seats_of(saddle) -> tuple[tuple[Seat, str], ...]:
    return (saddle.left, "left"), (saddle.right, "right")


def _height_text(seat: Seat, name: str, style: SheetStyle) -> str:
    return f"{style.say(name)} {style.length(seat.place[2])}"


def _ring(centre, radius: float) -> Polyline:
    angles = np.linspace(0.0, 2.0 * np.pi, 13)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + centre
    return Polyline(as_points(ring), "medium")


def _triangle(tip: np.ndarray, leftwards: np.ndarray, saddle) -> Polyline:
    """A side stop: a triangle that touches the piece with its tip, from outside."""
    out = leftwards / np.hypot(*leftwards) * (1.0 if saddle.stop_side == "left" else -1.0)
    side = np.array([-out[1], out[0]])
    foot = tip + 2.0 * out
    return Polyline(as_points(np.array([tip, foot + side, foot - side, tip])), "medium")
