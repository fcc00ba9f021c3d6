# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing of each node: views, branches, flange steps, plates that end there, diaphragms."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord
from ..nodes.node_ends import PlateEnd, axis_at, plate_ends
from ..nodes.node_record import FlangeStep, NodeRecord
from ..welds.weld_record import Weld
from .sheet import Sheet, Text, wrapped
from .sheet_node_view import Joining, node_views, spread_out
from .sheet_pack import packed
from .sheet_page import TEXT, Page, Subject, finished
from .sheet_style import PLAIN_STYLE, SheetStyle, fixed
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing, table_blocks
from .sheet_weld import kind_letters, symbol_blocks, weld_kind

BRANCHES = (
    "branch", "s", "s of through", "angle, °", "axes apart", "type", "root gap", "stub", "lands on",
)  # fmt: skip
STEPS = (
    "branch", "side of node", "face", "edge", "against", "step", "limit", "angle, °", "limit, °",
    "rule",
)  # fmt: skip
ENDS = ("plate", "end", "side of node", "t", "cut length", "bevel, °", "dihedral, °", "on face")
DIAPHRAGMS = ("diaphragm", "t", "length", "width", "mass, kg")
WELDS = ("weld", "cut / on", "t", "length", "dihedral, °", "symbol", "groove, °", "gap", "place")
NOTE = (
    "Views show plates by the edges of their outer faces; broken: diaphragms; wide: cuts at the "
    "node. Side of node: before or behind it along the branch. Step: of the branch's face over "
    "that of the member that runs through; held against the rule where both plates are in line. "
    "Bevel: of the cut against square at its two corners, positive where the outer face is the "
    "longer. Dihedral: between plate and face on the inner side."
)
SMALLEST_ROWS = 8
FIRST_TABLES = 4
"""Tables of the branches and their ends, that stand together."""


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
        joinings = [Joining(node, record, plate_ends(node, record)) for node, record in own]
        names = ", ".join(dict.fromkeys([through.member, *(record.member for _, record in own)]))
        sections = "; ".join(
            dict.fromkeys([through.sections, *(record.sections for _, record in own)])
        )
        materials = ", ".join(
            dict.fromkeys(p.material for r in (through, *(r for _, r in own)) for p in r.plates)
        )
        subject = Subject(names, sections, materials, None, code="NODES")
        pages += [(page, subject) for page in node_pages(through, joinings, style)]
    return tuple(
        finished(page, subject, style, number, len(pages))
        for number, (page, subject) in enumerate(pages, start=1)
    )


def has_nodes(records: Sequence[MemberRecord]) -> bool:
    """True when `node_sheets` of these records draws any node."""
    names = {record.member for record in records if record.plates}
    return any(node.through in names for record in records for node in record.nodes)


def node_pages(
    through: MemberRecord, joinings: Sequence[Joining], style: SheetStyle = PLAIN_STYLE
) -> list[Page]:
    """The page of a node; what of its tables finds no room follows on pages of its own."""
    form, say = style.page, style.say
    scale, views, left_out = node_views(through, joinings, style)
    words = say(NOTE)
    if left_out:
        words += " " + say("No room for the marks {}.", ", ".join(left_out))
    lines = wrapped(words, TEXT, form.note_width or form.right - form.left)
    foot = form.bottom + 1.0 if form.note_width else form.clear_bottom
    bottom = max(form.clear_bottom, foot + 3.2 * len(lines) + 2.0)
    notes = tuple(
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), TEXT, line)
        for k, line in enumerate(lines)
    )
    area = (form.left, bottom, form.right, form.top)
    most = int((area[3] - area[1] - TITLE_ROOM) // ROW_HEIGHT) - 1
    rows = most if form.is_small else max(SMALLEST_ROWS, most // 3)
    given = listings(through, joinings, style)
    tables = [
        [
            block
            for listing in part
            for block in table_blocks(listing, _even(len(listing.rows), rows), say("continued"))
        ]
        for part in (given[:FIRST_TABLES], given[FIRST_TABLES:])
    ]
    welds = _of_node(through, joinings)
    symbols = symbol_blocks(welds, kind_letters(welds), style)
    node = joinings[0].node
    marks = tuple(end.plate.mark for own in joinings for end in own.ends)
    marks += tuple(plate.mark for plate in inside(through, joinings))
    heading = say("node {}", node.node)
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
        for page in packed(
            [spread_out(views, area[2] - area[0]), tables[0], [*tables[1], *symbols]], area
        )
    ]


def _even(count: int, most: int) -> int:
    """Rows of each part of a table that is parted so that none has more than `most`."""
    return -(-count // -(-count // most))


def inside(through: MemberRecord, joinings: Sequence[Joining]) -> list[DevelopedPlate]:
    """The diaphragms of the member that runs through between the ends of the branches' cuts."""
    ends = [end for own in joinings for end in own.ends]
    if not ends:
        return []
    node = joinings[0].node
    foot, along = axis_at(through, np.array([node.x, node.y, node.z]))
    places = [float(((corner - foot) * along).sum()) for e in ends for corner in e.corners]
    low, high = min(places), max(places)
    return [
        plate
        for plate in through.plates
        if plate.face == "diaphragm"
        and low <= float(((plate.centre_of_gravity - foot) * along).sum()) <= high
    ]


def listings(
    through: MemberRecord, joinings: Sequence[Joining], style: SheetStyle
) -> list[Listing]:
    """The tables of a node, those with rows."""
    say, node = style.say, joinings[0].node
    welds = _of_node(through, joinings)
    letters = kind_letters(welds)
    title = say("Node {}: {}, {} runs through", node.node, say(node.kind), through.member)
    digits = 3 if style.site.unit == "m" else 1
    model = np.array([node.x, node.y, node.z])
    places = (
        (say("model, mm"), *(fixed(value, 1) for value in model)),
        (
            say("site, {}", style.site.unit),
            *(fixed(value, digits) for value in style.site.of(model).tolist()),
        ),
    )
    found = [
        Listing(title, style.said(BRANCHES), _branches(joinings, style), "<>>>><>><"),
        Listing(say("Place"), (say("system"), "x", "y", "z"), places, "<>>>"),
        Listing(
            say("Flange steps, mm"),
            style.said(STEPS),
            tuple(_step(own.node, step, style) for own in joinings for step in own.node.steps),
            "<<<<<>>>><",
        ),
        Listing(
            say("Plates that end at the node"),
            style.said(ENDS),
            tuple(_end(end, style) for own in joinings for end in own.ends),
            "<<<>>>><",
        ),
        Listing(
            say("Diaphragms inside"),
            style.said(DIAPHRAGMS),
            tuple(
                (
                    plate.mark,
                    f"{plate.thickness:g}",
                    style.length(plate.length),
                    style.length(plate.width),
                    fixed(plate.mass, 1),
                )
                for plate in inside(through, joinings)
            ),
            "<>>>>",
        ),
        Listing(
            say("Welds"),
            style.said(WELDS),
            tuple(_weld(weld, letters[weld_kind(weld)], style) for weld in welds),
            "<<>>><>><",
        ),
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
            fixed(node.axis_distance, 2),
            say(node.type),
            style.length(node.gap),
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
        fixed(step.step, 2),
        fixed(node.limits[0], 2) if ruled else "–",
        fixed(math.degrees(step.angle), 2),
        fixed(math.degrees(node.limits[1]), 2) if ruled else "–",
        say("kept" if within else "broken") if ruled else say("not in line"),
    )


def _end(end: PlateEnd, style: SheetStyle) -> tuple[str, ...]:
    return (
        end.plate.mark,
        end.line,
        _side(end.way, style),
        f"{end.plate.thickness:g}",
        style.length(end.length),
        _range(end.bevel),
        _range(end.dihedral),
        _faces(end.face, style),
    )


def _faces(names: str, style: SheetStyle) -> str:
    """The names of faces joined by `and`, in the style's language."""
    return " + ".join(_on(name, style) for name in names.split(" and "))


def _range(angles: np.ndarray) -> str:
    """Two angles, rad, as a range in degrees."""
    low, high = (fixed(math.degrees(value), 1) for value in sorted(angles.tolist()))
    return low if low == high else f"{low} … {high}"


def _of_node(through: MemberRecord, joinings: Sequence[Joining]) -> list[Weld]:
    """The welds of plates that end at the node, the field joints of its stubs, and those of the
    diaphragms inside."""
    found = []
    for own in joinings:
        marks = {end.plate.mark for end in own.ends}
        for weld in own.record.welds:
            at_node = weld.kind == "node" and weld.name == own.node.node
            at_stub = weld.kind == "joint" and own.node.type == "stub"
            if at_node or (at_stub and not marks.isdisjoint(weld.plates)):
                found.append(weld)
    marks = {plate.mark for plate in inside(through, joinings)}
    found += [w for w in through.welds if w.kind == "diaphragm" and w.plates[0] in marks]
    return found


def _weld(weld: Weld, letter: str, style: SheetStyle) -> tuple[str, ...]:
    prep = weld.prep
    return (
        weld.mark,
        " / ".join(_on(text, style) for text in weld.plates),
        "/".join(dict.fromkeys(f"{t:g}" for t in weld.thickness)),
        style.length(weld.length),
        fixed(math.degrees(weld.dihedral), 1),
        letter,
        f"{math.degrees(prep.angle):g}" if prep.is_cut else "–",
        style.length(prep.gap) if prep.gap else "–",
        style.say(weld.place),
    )


def _on(text: str, style: SheetStyle) -> str:
    """A plate by its mark, a face of another member in the style's language."""
    member, _, face = text.rpartition(" ")
    return f"{member} {style.say(face)}" if member else style.say(text)
