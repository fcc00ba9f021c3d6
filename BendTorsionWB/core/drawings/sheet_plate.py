# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plate drawings: each plate's pattern with its points, panels and edges, packed on pages."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord, PlateEdge
from ..welds.bevel_record import EdgeBevel
from ..welds.weld_record import Weld
from .sheet import Text, wrapped
from .sheet_detail import detail_blocks
from .sheet_overview import SCALES
from .sheet_pack import GAP, Block, packed, shelf_height
from .sheet_page import TEXT, Page
from .sheet_pattern import CAPTION_ROOM, CAPTION_ROW, chamfer_text, pattern_block
from .sheet_style import SheetStyle, fixed
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing, table_blocks

STATION_ROOM = 16.0
"""mm on paper that station lines keep at least, where a choice of scale is left."""
MORE_PAGES = 1.25
"""Times the fewest pages any scale needs that a larger scale may cost."""
LABEL_ROOM = (28.0, 18.0)
"""mm; what labels and dimensions add to a pattern's width and height, about."""
LEAST_ROWS = 8
UNDIVIDED = 1.15
"""Times the height of a pattern that its tables may take beside it for being divided less."""
MANY_LEFT_OUT = 8
"""Labels without room beyond which a plate that has details names its points there alone."""
PATTERN_NOTE = (
    "Patterns show the net plate before forming, its {} laid flat, seen from the marking face, "
    "which is up. u runs right and v up from the cross at the lower left corner of each pattern's "
    "bounding box. L: station line, E: end line, P: point, small cross: witness mark W, F "
    "(dashed): fold line with its angle, up towards the eye or down, R (chain): roll line of a "
    "plate to be rolled, with its radius, O: opening with u, v of its middle. Dimensions are "
    "overall, before forming. Cut files draw the contour of the {}, with allowances where the "
    "gross size differs."
)
POINT_NOTE = (
    "Points: s: arc length on the axis; x, y, z: model coordinates; u, v: flat pattern; P: on the "
    "outer face's corner line; W: on the marking face, inside the edge. Panels: flat: before "
    "forming; formed: after forming, along the surface; chord: after forming, straight between "
    "the points P. Edges: grooves by angle against square and depth, +: face cut back; tilt: of "
    "the edge without grooves against square, +: outer face wider; a row for each stretch of one "
    "bevel: s, u: where it begins and ends on the axis and on the pattern, of E lines along the "
    "line from the first edge."
)
SURFACES = {"mid": "mid-surface", "outer": "outer face", "inner": "inner face"}
CONTOURS = {
    "top": "marking face",
    "root": "root of the grooves",
    "widest": "widest outline of the edges",
}
SPRINGBACK = "Springback is left to the shop: radii and angles are of the finished plate."


def plate_pages(record: MemberRecord, style: SheetStyle) -> list[Page]:
    """Flat parts, which have no measuring lines, have pages and a scale of their own."""
    return [
        page
        for heading, plates in (
            ("flat patterns", [plate for plate in record.plates if plate.lines]),
            ("flat parts", [plate for plate in record.plates if not plate.lines]),
        )
        for page in _drawn_pages(style.say(heading), plates, record, style)
    ]


def _drawn_pages(
    heading: str, plates: Sequence[DevelopedPlate], record: MemberRecord, style: SheetStyle
) -> list[Page]:
    if not plates:
        return []
    form, say = style.page, style.say
    surface = SURFACES[plates[0].flattened_surface]
    contour = CONTOURS.get(plates[0].contour, surface)
    notes = (say(PATTERN_NOTE, say(surface), say(contour)), say(POINT_NOTE), say(SPRINGBACK))
    words = " ".join(notes)
    bottom, texts = form.clear_bottom, []
    lines = wrapped(words, TEXT, form.note_width or form.right - form.left)
    foot = form.bottom + 1.0 if form.note_width else bottom
    texts = [
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), TEXT, line)
        for k, line in enumerate(lines)
    ]
    bottom = max(bottom, foot + 3.2 * len(lines) + 2.0)
    area = (form.left, bottom, form.right, form.top)
    listings = {plate.mark: _listings(plate, record, style) for plate in plates}
    scale = _scale(plates, listings, area)
    for scale in (s for s in SCALES if s >= scale):
        blocks = [pattern_block(plate, scale, style) for plate in plates]
        sizes = [block.size for block in blocks]
        if all(w <= area[2] - area[0] and h <= area[3] - area[1] for w, h in sizes):
            break
    crowded = [p for p, b in zip(plates, blocks, strict=True) if b.left_out and p.lines]
    room = (area[2] - area[0], area[3] - area[1])
    details = detail_blocks(crowded, scale, room, style)
    detailed = {block.mark for own in details.values() for block in own}
    blocks = [
        pattern_block(plate, scale, style, bare=True)
        if block.left_out > MANY_LEFT_OUT and plate.mark in detailed
        else block
        for plate, block in zip(plates, blocks, strict=True)
    ]
    groups = [
        [block, *_tables(block.size, listings[plate.mark], area, say("continued"))]
        for plate, block in zip(plates, blocks, strict=True)
    ]
    sets = [(heading, scale, groups)]
    for larger, own in details.items():
        sets.append((say("flat patterns: details"), larger, [[block] for block in own]))
    return [
        Page(
            title,
            tuple(dict.fromkeys(block.mark for block in page if block.mark)),
            f"1:{one}",
            tuple(view for block in page for view in block.views),
            tuple(line for block in page for line in block.lines),
            (*(text for block in page for text in block.texts), *texts),
            tuple(table for block in page for table in block.tables),
        )
        for title, one, own in sets
        for page in packed(own, area)
    ]


def _scale(plates, listings, area) -> int:
    """The one scale of the member's patterns: the largest that fits every plate and needs few
    pages, of those at which station lines do not come too close."""
    width, height = area[2] - area[0], area[3] - area[1]
    fitting = [
        scale
        for scale in SCALES
        if all(
            wide <= width and high <= height
            for wide, high in (_estimate(plate, scale) for plate in plates)
        )
    ] or [SCALES[-1]]
    pages: dict[int, int] = {}
    for scale in fitting:
        if pages and 500.0 / scale < STATION_ROOM:
            break
        pages[scale] = count = 0
        left = 0.0
        for plate in plates:
            size = _estimate(plate, scale)
            high = _most_rows(size, listings[plate.mark], area)[1]
            if high > left:
                count, left = count + max(1, math.ceil(high / height)), height
            left -= high + GAP
        pages[scale] = count
    enough = MORE_PAGES * min(pages.values())
    return next(scale for scale, count in pages.items() if count <= enough)


def _estimate(plate: DevelopedPlate, scale: float) -> tuple[float, float]:
    """About the size of a pattern's block, mm."""
    wide = max(plate.length / scale + LABEL_ROOM[0], CAPTION_ROOM)
    lines = 2 + math.ceil(400.0 / wide)
    return wide, plate.width / scale + LABEL_ROOM[1] + 6.0 + CAPTION_ROW * lines


def _tables(size, listings: Sequence[Listing], area, continued: str) -> list[Block]:
    """The tables of a plate, cut so that with its pattern they take the least height."""
    most = _most_rows(size, listings, area)[0]
    return [block for listing in listings for block in table_blocks(listing, most, continued)]


def _most_rows(size, listings: Sequence[Listing], area) -> tuple[int, float]:
    """How many rows a table has at most, and the height of pattern and tables then, mm."""
    width, height = area[2] - area[0], area[3] - area[1]
    counts = [(sum(listing.widths), len(listing.rows), listing) for listing in listings]
    longest = max((rows for _, rows, _ in counts), default=1)
    most = min(longest, int((height - TITLE_ROOM) // ROW_HEIGHT) - 1)
    found = []
    for cap in np.unique(np.geomspace(min(LEAST_ROWS, most), most, 16).astype(int)).tolist():
        sizes = [
            (wide, TITLE_ROOM + ROW_HEIGHT * (min(listing.most(cap), rows - start) + 1))
            for wide, rows, listing in counts
            for start in range(0, rows, listing.most(cap))
        ]
        high = shelf_height([size, *sizes], width)
        # A plate of several pages fills them from the first on.
        count = 1 if high <= height else _page_count([size, *sizes], area)
        found.append((count, high, cap))
    count, least, _ = min(found)
    # Whole tables rather than parts of them, where they are hardly higher.
    enough = max(least + 1.0, UNDIVIDED * size[1])
    return max((cap, high) for own, high, cap in found if own == count and high <= enough)


def _page_count(sizes: Sequence[tuple[float, float]], area) -> int:
    blocks = [Block("", (), (), (), (0.0, 0.0, wide, high)) for wide, high in sizes]
    return len(packed([blocks], area))


def _listings(plate: DevelopedPlate, record: MemberRecord, style: SheetStyle) -> list[Listing]:
    found = [_points(plate, style), _panels(plate, style), _edges(plate, record, style)]
    return [listing for listing in found if listing.rows]


def _points(plate: DevelopedPlate, style: SheetStyle) -> Listing:
    rows = tuple(
        (
            point.label,
            point.line,
            style.say(point.edge),
            style.measure(point.s),
            *(style.measure(value, 0) for value in point.xyz),
            *(style.measure(value) for value in point.flat),
        )
        for point in plate.points
    )
    header = style.said(("point", "line", "edge", "s", "x", "y", "z", "u", "v"))
    title = style.say("{}: points, {}", plate.mark, style.measured_in)
    return Listing(title, header, rows, "<<<" + ">" * 6)


def _panels(plate: DevelopedPlate, style: SheetStyle) -> Listing:
    """Edges and diagonals of the panels: a row each flat, formed and straight."""
    panels: dict[str, dict] = {}
    for measure in plate.panels:
        panels.setdefault(measure.panel, {})[measure.what] = measure
    names = list(dict.fromkeys(measure.what for measure in plate.panels))
    say = style.say
    rows = []
    for panel, own in panels.items():
        for k, (state, field) in enumerate(
            (("flat", "flat"), ("formed", "arc"), ("chord", "chord_outer"))
        ):
            values = (
                style.measure(getattr(own[name], field)) if name in own else "" for name in names
            )
            rows.append(("" if k else panel, say(state), *values))
    titles = [
        " ".join(say(word) if not word.isdigit() else word for word in name.split())
        for name in names
    ]
    header = (say("panel"), say("state"), *titles)
    return Listing(
        say("{}: panels, before and after forming, {}", plate.mark, style.measured_in),
        header,
        tuple(rows),
        "<<" + ">" * len(names),
        3,
    )


def _edges(plate: DevelopedPlate, record: MemberRecord, style: SheetStyle) -> Listing:
    """Each stretch of each edge: its weld with the root gap, the grooves cut, its tilt."""
    say = style.say
    welds = {weld.mark: weld for weld in record.welds}
    faces = {other.mark: other.face for other in record.plates}
    long = {edge.edge: edge for edge in plate.edges}
    rows = []
    for name in dict.fromkeys((*long, *(("E-1", "E-2") if plate.lines else ()))):
        edge = long.get(name)
        bevels = [bevel for bevel in plate.bevels if bevel.edge == name]
        for bevel in bevels:
            own = [welds[mark] for mark in bevel.weld.split() if mark in welds]
            rows.append(_edge_row(plate, name, edge, own, bevel, style))
        if not bevels:
            own = [
                weld
                for weld in record.welds
                if plate.mark in weld.plates and _edge_of(plate, weld, faces) == name
            ]
            rows.append(_edge_row(plate, name, edge, own, None, style))
    header = style.said(
        ("edge", "meets", "s from", "s to", "u from", "u to", "weld", "gap", "outside", "inside",
         "tilt, °", "dihedral, °")
    )  # fmt: skip
    title = say("{}: edges, {}", plate.mark, style.measured_in)
    return Listing(title, header, tuple(rows), "<<>>>><><<>>")


def _edge_row(
    plate: DevelopedPlate,
    name: str,
    edge: PlateEdge | None,
    welds: Sequence[Weld],
    bevel: EdgeBevel | None,
    style: SheetStyle,
) -> tuple[str, ...]:
    say = style.say
    names = [weld.mark.removeprefix(f"{weld.member}-") for weld in welds]
    gaps = dict.fromkeys(style.fine(weld.prep.gap) for weld in welds)
    ends = None
    if bevel is not None:
        ends = (bevel.start, bevel.end)
    elif edge is not None:
        ends = (float(edge.s[0]), float(edge.s[-1]))
    place = [style.measure(at) for at in ends] if ends else ["", ""]
    place += [style.measure(_across(plate, name, at)) for at in ends] if edge else ["", ""]
    grooves = (say("square"), say("square"))
    if bevel is not None:
        grooves = tuple(
            " + ".join(filter(None, (_groove_text(*one, style), chamfer_text(bevel, side, style))))
            or "–"
            for one, side in ((bevel.outer, "outer"), (bevel.inner, "inner"))
        )
    tilt = fixed(math.degrees(bevel.natural), 1) if bevel is not None else "0.0"
    return (
        say(name),
        say(edge.neighbour) if edge else "",
        *place,
        names[0] + (f" … {names[-1]}" if len(names) > 1 else "") if names else say("none"),
        " / ".join(gaps) or "–",
        *grooves,
        tilt,
        _dihedral(edge, ends),
    )


def _across(plate: DevelopedPlate, edge: str, s: float) -> float:
    """The u on the pattern of a place on a long edge, by its arc length on the axis, mm."""
    own = [(p.s, p.flat[0]) for p in plate.points if p.kind == "arris" and p.edge == edge]
    return float(np.interp(s, *np.array(own).T)) if own else s


def _groove_text(angle: float, depth: float, style: SheetStyle) -> str:
    """A groove of an edge: its angle against square and its depth; empty where none is cut."""
    return f"{fixed(math.degrees(angle), 1)}° × {style.fine(depth)}" if depth else ""


def _edge_of(plate: DevelopedPlate, weld: Weld, faces: dict[str, str]) -> str:
    """The edge of a plate a weld runs along: `E-1`, `E-2` or the name of a long one."""
    if weld.kind == "diaphragm":
        return ""
    if weld.kind in ("joint", "end", "node"):
        nearer_start = abs(weld.start - plate.s_start) <= abs(weld.start - plate.s_end)
        return "E-1" if nearer_start else "E-2"
    face = faces.get(weld.plates[1 - weld.plates.index(plate.mark)], "")
    named = [edge.edge for edge in plate.edges if edge.edge == weld.name]
    return (named or [edge.edge for edge in plate.edges if edge.neighbour == face] or [""])[0]


def _dihedral(edge: PlateEdge | None, ends: tuple[float, float] | None) -> str:
    """Least and greatest dihedral along a stretch of an edge, degrees."""
    if edge is None or ends is None:
        return ""
    places = [*ends, *(float(s) for s in edge.s if ends[0] < s < ends[1])]
    values = np.degrees(np.interp(places, edge.s, edge.dihedral))
    values = values[np.isfinite(values)]
    if not len(values):
        return ""
    low, high = fixed(float(values.min()), 1), fixed(float(values.max()), 1)
    return low if low == high else f"{low} … {high}"
