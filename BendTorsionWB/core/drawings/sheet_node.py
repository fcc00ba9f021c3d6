# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing of each node: views, branches, flange steps, plates that end there, diaphragms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ..lofting import MemberRecord
from ..nodes.node_ends import PlateEnd, plate_ends
from ..nodes.node_record import FlangeStep, NodeRecord
from .sheet import Sheet, Text, wrapped
from .sheet_node_diaphragm import diaphragm_block, diaphragm_listing, inside, place_listing
from .sheet_node_joining import Joining
from .sheet_node_view import node_views, spread_out
from .sheet_node_weld import node_weld_listing, on_face, welds_of_node
from .sheet_overview import SCALES
from .sheet_pack import Block, filled, packed, shelf_height
from .sheet_page import TEXT, Page, Subject, finished
from .sheet_style import PLAIN_STYLE, SheetStyle, fixed
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing, even_rows, table_blocks
from .sheet_weld import kind_letters, symbol_blocks

BRANCHES = (
    "branch", "s", "s of through", "angle, °", "axes apart", "type", "root gap", "stub", "lands on",
)  # fmt: skip
STEPS = (
    "branch", "side of node", "face", "edge", "against", "step", "limit", "angle, °", "limit, °",
    "rule",
)  # fmt: skip
ENDS = (
    "plate",
    "end",
    "side of node",
    "t",
    "cut length",
    "angle of cut, °",
    "dihedral, °",
    "on face",
)
NOTE = (
    "Views show plates by the edges of their outer faces; broken: diaphragms; wide: cuts at the "
    "node. Side of node: before or behind it along the branch. Step: of the branch's face over "
    "that of the member that runs through; held against the rule where both plates are in line. "
    "Angle of cut: of the end as it lies on the face, without its groove, against square, at its "
    "two corners, positive where the outer face is the longer. Dihedral: between plate and face "
    "on the inner side. Places of diaphragms: the middle of each side at mid-thickness, from the "
    "node, x along the member that runs through, y to the left, z outwards. Symbols: one for each "
    "kind of weld, its letter in the tail."
)
SMALLEST_ROWS = 8
SMALLEST_VIEW = 70.0
"""mm; height of the highest view with its labels below which no smaller scale is tried to save a
page."""


def node_sheets(
    records: Sequence[MemberRecord], style: SheetStyle = PLAIN_STYLE
) -> tuple[Sheet, ...]:
    """The drawings of all nodes whose member that runs through is among the records, with the
    branches that are."""
    drawn = {record.member: record for record in records if record.plates and record.wireframe}
    found: dict[str, list[tuple[NodeRecord, MemberRecord]]] = {}
    for record in drawn.values():
        for node in record.nodes:
            if node.through in drawn:
                found.setdefault(node.node, []).append((node, record))
    order = list(drawn)
    nodes = sorted(
        found.values(), key=lambda own: (order.index(own[0][0].through), own[0][0].s_through)
    )
    pages = []
    for own in nodes:
        through = drawn[own[0][0].through]
        names = ", ".join(dict.fromkeys([through.member, *(record.member for _, record in own)]))
        sections = "; ".join(
            dict.fromkeys([through.sections, *(record.sections for _, record in own)])
        )
        materials = ", ".join(
            dict.fromkeys(p.material for r in (through, *(r for _, r in own)) for p in r.plates)
        )
        subject = Subject(names, sections, materials, None, code="NODES")
        pages += [(page, subject) for page in _pages_of(through, tuple(own), style)]
    return tuple(
        finished(page, subject, style, number, len(pages))
        for number, (page, subject) in enumerate(pages, start=1)
    )


@lru_cache(maxsize=128)
def _pages_of(
    through: MemberRecord, own: tuple[tuple[NodeRecord, MemberRecord], ...], style: SheetStyle
) -> tuple[Page, ...]:
    # An edit of one member leaves the nodes of all others as they are.
    joinings = [Joining(node, record, plate_ends(node, record)) for node, record in own]
    return tuple(node_pages(through, joinings, style))


def has_nodes(records: Sequence[MemberRecord]) -> bool:
    """True when `node_sheets` of these records draws any node."""
    names = {record.member for record in records if record.plates}
    return any(node.through in names for record in records for node in record.nodes)


def node_pages(
    through: MemberRecord, joinings: Sequence[Joining], style: SheetStyle = PLAIN_STYLE
) -> list[Page]:
    """The page of a node, its views as large as leaves the fewest pages; what of its tables finds
    no room follows on pages of its own."""
    form, say = style.page, style.say
    views = node_views(through, joinings, style)
    given = listings(through, joinings, style)
    flats = inside(through, joinings)
    lines = wrapped(say(NOTE), TEXT, form.note_width or form.right - form.left)
    foot = form.bottom + 1.0 if form.note_width else form.clear_bottom
    # One line more, for marks without room.
    bottom = max(form.clear_bottom, foot + 3.2 * (len(lines) + 1) + 2.0)
    area = (form.left, bottom, form.right, form.top)
    width, height = area[2] - area[0], area[3] - area[1]
    welds = welds_of_node(through, joinings)
    symbols = symbol_blocks(welds, kind_letters(welds), style)

    def below(scale: int) -> list[Block]:
        shapes = [diaphragm_block(plate, scale, style) for plate in flats]
        return _below(given, shapes, symbols, (width, height), say("continued"))

    guessed = []
    for scale in SCALES:
        rooms = views.room(scale)
        wide, high = (max(room[k] for room in rooms) for k in (0, 1))
        if guessed and high < SMALLEST_VIEW:
            break
        if (wide <= width and high <= height) or scale == SCALES[-1]:
            blocks = [Block("", (), (), (), (0.0, 0.0, *room)) for room in rooms]
            rest = below(scale)
            guessed.append((len(_arranged(blocks, rest, area)), scale, rest))
    best: tuple | None = None
    for count, scale, rest in sorted(guessed, key=lambda one: one[:2]):
        if best is not None and count >= len(best[2]):
            break
        blocks, left_out = views.blocks(scale)
        pages = _arranged(spread_out(blocks, width), rest, area)
        if best is None or len(pages) < len(best[2]):
            best = (scale, left_out, pages)
    scale, left_out, pages = best
    if left_out:
        more = say("No room for the marks {}.", ", ".join(left_out))
        lines = wrapped(f"{say(NOTE)} {more}", TEXT, form.note_width or form.right - form.left)
    notes = tuple(
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), TEXT, line)
        for k, line in enumerate(lines)
    )
    marks = tuple(end.plate.mark for own in joinings for end in own.ends)
    marks += tuple(plate.mark for plate in flats)
    heading = say("node {}", joinings[0].node.node)
    return [
        Page(
            heading,
            marks,
            f"1:{scale}" if any(block.views for block in page) else "–",
            tuple(view for block in page for view in block.views),
            tuple(line for block in page for line in block.lines),
            (*(text for block in page for text in block.texts), *notes),
            tuple(table for block in page for table in block.tables),
        )
        for page in pages
    ]


def _arranged(views: list[Block], rest: list[Block], area) -> list[list[Block]]:
    """The blocks of each page: the views, the rest in rows of its own where one page holds all;
    else filled in without rows, at need those of the largest area, height or width first; else on
    several pages."""
    left, bottom, right, top = area
    pages = packed([views, rest], area)
    if len(pages) == 1:
        return pages
    for order in (lambda _: 0, math.prod, lambda size: size[::-1], lambda size: size):
        blocks = [*views, *sorted(rest, key=lambda b, order=order: order(b.size), reverse=True)]
        places, high = filled([block.size for block in blocks], right - left)
        if high <= top - bottom:
            spots = zip(blocks, places, strict=True)
            return [[b.moved(left + x - b.box[0], top - y - b.box[3]) for b, (x, y) in spots]]
    return packed([[*views, *rest]], area)


def _below(
    given: Sequence[Listing],
    shapes: Sequence[Block],
    symbols: Sequence[Block],
    size: tuple[float, float],
    continued: str,
) -> list[Block]:
    """The tables, shapes and symbols below the views, the tables cut so that all of them take the
    least height of pages of this width and height, in as few tables as that allows."""
    width, height = size
    given = [listing.within(width) for listing in given]
    most = int((height - TITLE_ROOM) // ROW_HEIGHT) - 1
    best: tuple[float, list[Block]] | None = None
    for rows in (most, 16, SMALLEST_ROWS):
        tables = [
            block
            for listing in given
            for block in table_blocks(
                listing, even_rows(len(listing.rows), min(rows, most)), continued
            )
        ]
        # Those of about one height side by side.
        blocks = [*sorted([*tables, *shapes], key=lambda block: -block.size[1]), *symbols]
        high = shelf_height([block.size for block in blocks], width)
        if best is None or high < best[0] - 4.0:
            best = (high, blocks)
    return best[1]


def listings(
    through: MemberRecord, joinings: Sequence[Joining], style: SheetStyle
) -> list[Listing]:
    """The tables of a node, those with rows."""
    say, node = style.say, joinings[0].node
    flats = inside(through, joinings)
    title = say("Node {}: {}, {} runs through", node.node, say(node.kind), through.member)
    digits = 3 if style.site.unit == "m" else 1
    model = np.array([node.x, node.y, node.z])
    places = (
        (say("model, {}", style.measured_in), *(style.measure(value) for value in model.tolist())),
        (
            say("site, {}", style.site.unit),
            *(fixed(value, digits) for value in style.site.of(model).tolist()),
        ),
    )
    found = [
        Listing(title, style.said(BRANCHES), _branches(joinings, style), "<>>>><>><"),
        Listing(say("Place"), (say("system"), "x", "y", "z"), places, "<>>>"),
        Listing(
            say("Flange steps, {}", style.measured_in),
            style.said(STEPS),
            tuple(_step(own.node, step, style) for own in joinings for step in own.node.steps),
            "<<<<<>>>><",
        ),
        Listing(
            say("Plates that end at the node"),
            style.headings(ENDS),
            tuple(_end(end, style) for own in joinings for end in own.ends),
            "<<<>>>><",
        ),
        diaphragm_listing(flats, style),
        place_listing(through, joinings, flats, style),
        node_weld_listing(welds_of_node(through, joinings), style),
    ]
    return [listing for listing in found if listing.rows]


def _branches(joinings: Sequence[Joining], style: SheetStyle) -> tuple[tuple[str, ...], ...]:
    say = style.say
    return tuple(
        (
            node.other,
            style.length(node.s_other),
            style.length(node.s_through),
            fixed(math.degrees(node.angle), 2),
            style.measure(node.axis_distance, 2),
            say(node.type),
            style.fine(node.gap),
            style.length(node.stub_length) if node.type == "stub" else "–",
            ", ".join(_faces(text, style) for text in node.faces),
        )
        for node in (own.node for own in joinings)
    )


def _side(way: int, style: SheetStyle) -> str:
    return style.say("before" if way < 0 else "behind")


def _step(node: NodeRecord, step: FlangeStep, style: SheetStyle) -> tuple[str, ...]:
    say = style.say
    ruled = step.in_line and node.limits is not None
    within = ruled and abs(step.step) <= node.limits[0] and step.angle <= node.limits[1]
    return (
        node.other,
        _side(step.way, style),
        say(step.face),
        say(step.edge),
        say(step.through_face),
        style.measure(step.step, 2),
        style.measure(node.limits[0], 2) if ruled else "–",
        fixed(math.degrees(step.angle), 2),
        fixed(math.degrees(node.limits[1]), 2) if ruled else "–",
        say("kept" if within else "broken") if ruled else say("not in line"),
    )


def _end(end: PlateEnd, style: SheetStyle) -> tuple[str, ...]:
    return (
        end.plate.mark,
        end.line,
        _side(end.way, style),
        style.thickness(end.plate.thickness),
        style.length(end.length),
        _range(end.bevel),
        _range(end.dihedral),
        _faces(end.face, style),
    )


def _faces(names: str, style: SheetStyle) -> str:
    """The names of faces joined by `and`, in the style's language."""
    return " + ".join(on_face(name, style) for name in names.split(" and "))


def _range(angles: np.ndarray) -> str:
    """Two angles, rad, as a range in degrees."""
    low, high = (fixed(math.degrees(value), 1) for value in sorted(angles.tolist()))
    return low if low == high else f"{low} … {high}"
