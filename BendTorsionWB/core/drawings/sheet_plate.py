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
from .sheet_pack import GAP, Block, filled
from .sheet_page import TEXT, Page
from .sheet_pattern import chamfer_text, opening_text, pattern_block
from .sheet_plate_layout import Column, Fitting, columns_of, rows_beside, standing
from .sheet_style import SheetStyle, fixed
from .sheet_tables import Listing, table_blocks

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
    "line from the first edge; chamfer 1:n × d: machined off that face after cutting, d deep at "
    "the edge and running out over n × d."
)
EDGE_PLACES, EDGE_CUTS = (0, 1, 2, 3, 4, 5), (0, 2, 6, 7, 8, 9, 10, 11)
"""Columns of the list of edges where it is two."""
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
    sets, details = _filled_pages(plates, listings, area, style)
    pages = [(heading, scale, blocks) for scale, blocks in sets]
    for larger, own in sorted(details.items(), reverse=True):
        title = say("flat patterns: details")
        rest = [own]
        while rest:
            blocks, rest = standing(rest, columns_of(area, 1), area[3])
            pages.append((title, larger, blocks))
    return [
        Page(
            title,
            tuple(dict.fromkeys(block.mark for block in page if block.mark)),
            f"1:{scale}" if any(block.views for block in page) else "–",
            tuple(view for block in page for view in block.views),
            tuple(line for block in page for line in block.lines),
            (*(text for block in page for text in block.texts), *texts),
            tuple(table for block in page for table in block.tables),
        )
        for title, scale, page in pages
    ]


def _filled_pages(
    plates: Sequence[DevelopedPlate],
    listings: dict[str, list[Listing]],
    area: tuple[float, float, float, float],
    style: SheetStyle,
) -> tuple[list[tuple[int, list[Block]]], dict[int, list[Block]]]:
    """The pages of plates in order, each with its scale: as many plates as a page holds at the
    scale of all, drawn as large as it then has room for; and details by their scale."""
    fitting = Fitting(plates, listings, area)
    drawn = _Drawn(area, style)
    usual = fitting.scale()
    pages: list[tuple[int, list[Block]]] = []
    details: dict[int, list[Block]] = {}
    start, carried = 0, []
    while start < len(plates) or carried:
        shown = plates[start : start + fitting.page(start, usual)]
        least = max([usual, *(drawn.scale(plate, usual) for plate in shown)])
        for scale, count in fitting.tries(shown, least):
            columns = columns_of(area, count)
            # With tables as whole as they can be, or cut so that plates take the least height.
            for uncut in (True, False):
                groups = [drawn.group(p, scale, columns[0], listings, 0.0, uncut) for p in shown]
                placed, rest = standing([*carried, *groups], columns, area[3])
                if not rest:
                    break
            if not rest:
                break
        whole = [group for group in rest if group[0].views]
        if carried and shown and len(whole) == len(shown):
            # The rest of a plate would have a page for itself: the next one is begun below it.
            shown, (column,) = shown[:1], columns_of(area, 1)
            taken = filled([block.size for block in carried[0]], column.width)[1] + GAP
            scale = drawn.scale(shown[0], usual)
            begun = drawn.group(shown[0], scale, column, listings, taken)
            placed, rest = standing([*carried, begun], [column], area[3], True)
            whole = [group for group in rest if group[0].views]
        if not placed:
            # A block larger than a page.
            placed = [rest[0][0].moved(area[0] - rest[0][0].box[0], area[3] - rest[0][0].box[3])]
            rest = [group for group in (rest[0][1:], *rest[1:]) if group]
            whole = [group for group in rest if group[0].views]
        pages.append((scale, placed))
        done = shown[: len(shown) - len(whole)]
        for plate in done:
            for larger, blocks in drawn.details(plate, scale).items():
                details.setdefault(larger, []).extend(blocks)
        carried = [group for group in rest if not group[0].views]
        start += len(done)
    return pages, details


class _Drawn:
    """Patterns as they are drawn at each scale, and the details of those with labels left out; each
    once."""

    def __init__(self, area: tuple[float, float, float, float], style: SheetStyle):
        self._room, self._style = (area[2] - area[0], area[3] - area[1]), style
        self._blocks: dict[tuple[str, int], Block] = {}
        self._bare: dict[tuple[str, int], Block] = {}
        self._details: dict[tuple[str, int], dict[int, list[Block]]] = {}

    def details(self, plate: DevelopedPlate, scale: int) -> dict[int, list[Block]]:
        """By their scale, the details of a plate with labels that have no room at 1:scale."""
        key = (plate.mark, scale)
        if key not in self._details:
            crowded = [plate] if self._labelled(plate, scale).left_out and plate.lines else []
            self._details[key] = detail_blocks(crowded, scale, self._room, self._style)
        return self._details[key]

    def _labelled(self, plate: DevelopedPlate, scale: int) -> Block:
        """The pattern with all labels that have room at 1:scale."""
        key = (plate.mark, scale)
        if key not in self._blocks:
            self._blocks[key] = pattern_block(plate, scale, self._style)
        return self._blocks[key]

    def block(self, plate: DevelopedPlate, scale: int) -> Block:
        """The pattern at 1:scale; where too many labels have no room, those in details are left to
        these."""
        key, block = (plate.mark, scale), self._labelled(plate, scale)
        if block.left_out <= MANY_LEFT_OUT or not self.details(plate, scale):
            return block
        if key not in self._bare:
            self._bare[key] = pattern_block(plate, scale, self._style, bare=True)
        return self._bare[key]

    def scale(self, plate: DevelopedPlate, usual: int) -> int:
        """The usual scale, or the largest smaller one at which the pattern as it is drawn fits on
        a page."""
        for scale in (one for one in SCALES if one >= usual):
            wide, high = self.block(plate, scale).size
            if wide <= self._room[0] and high <= self._room[1]:
                break
        return scale

    def group(
        self,
        plate: DevelopedPlate,
        scale: int,
        column: Column,
        listings: dict[str, list[Listing]],
        taken: float = 0.0,
        whole: bool = False,
    ) -> list[Block]:
        """The pattern at 1:scale with its tables for a column; taken, whole: as `rows_beside`."""
        block, own = self.block(plate, scale), listings[plate.mark]
        most = rows_beside(block.size, own, column, taken, whole)[0]
        words = self._style.say("continued")
        return [block, *(b for listing in own for b in table_blocks(listing, most, words))]


def _listings(plate: DevelopedPlate, record: MemberRecord, style: SheetStyle) -> list[Listing]:
    edges = _edges(plate, record, style)
    found = [_points(plate, style), _panels(plate, style)]
    found += _narrower(edges, style.page.right - style.page.left)
    return [listing for listing in found if listing.rows]


def _narrower(edges: Listing, room: float) -> list[Listing]:
    """The edges in one list; where that is wider than a page, where they are in one, and how they
    are cut in another, whose rows tell their stretch by where it begins."""
    if sum(edges.widths) <= room:
        return [edges]
    return [
        Listing(
            edges.title,
            tuple(edges.header[k] for k in columns),
            tuple(tuple(row[k] for k in columns) for row in edges.rows),
            "".join(edges.align[k] for k in columns),
        )
        for columns in (EDGE_PLACES, EDGE_CUTS)
    ]


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
    sides = ("E-1", "E-2") if plate.lines else (bevel.edge for bevel in plate.bevels)
    for name in dict.fromkeys((*long, *sides)):
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
        if bevel.opening[1]:
            # A flat part is marked on its outer face.
            opened = opening_text(*bevel.opening, style)
            grooves = (
                (opened, say("square")) if bevel.opening[1] == "up" else (say("square"), opened)
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
