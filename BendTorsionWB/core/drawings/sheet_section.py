# SPDX-License-Identifier: LGPL-2.1-or-later
"""Control sections, weld symbols and the list of welds of a delivery piece, packed on pages."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np

from ..beds.control_record import ControlSection
from ..lofting import MemberRecord
from ..welds.weld_record import Weld
from .sheet import Polyline, Text, View, text_box, text_width, wrapped
from .sheet_labels import Labels, as_points, label_beyond
from .sheet_overview import SCALES
from .sheet_pack import Block, packed
from .sheet_page import Page
from .sheet_style import SheetStyle, fixed
from .sheet_symbols import GROOVE, arrow, weld_symbol, weld_symbol_width
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing, table_blocks

CAPTION, FIGURES = 2.5, 1.8
SECTION_ROOM = 62.0
"""mm on paper that the largest section takes at most, where a choice of scale is left."""
DIMENSION_GAP = 6.0
_WHAT = {"E": "end", "F": "fold", "M": "mid-length"}
NOTE = (
    "Sections are seen along +s, up as the section's z axis; cross: the axis, to which dimensions "
    "are given. Weld symbols: the arrow points at the outer face."
)


def section_pages(record: MemberRecord, heading: str, style: SheetStyle) -> list[Page]:
    """Pages of the sections and welds of a record; none when it has neither."""
    form = style.page
    lines = wrapped(style.say(NOTE), FIGURES, form.note_width or form.right - form.left)
    foot = form.bottom + 1.0 if form.note_width else form.clear_bottom
    bottom = form.clear_bottom if form.note_width else foot + 3.2 * len(lines) + 2.0
    notes = [
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), FIGURES, line)
        for k, line in enumerate(lines)
    ]
    area = (form.left, bottom, form.right, form.top)
    groups = []
    scale = _scale(record.controls)
    if record.controls:
        groups.append([section_block(one, scale, style) for one in record.controls])
    if record.welds:
        symbols = _symbol_blocks(record, scale, style)
        most = int((area[3] - area[1] - TITLE_ROOM) // ROW_HEIGHT) - 1
        listing = weld_listing(record, style)
        wide = max(1, int((area[2] - area[0] + 5.0) // (sum(listing.widths) + 5.0)))
        rows = min(most, max(8, -(-len(listing.rows) // wide)))
        groups += [symbols, table_blocks(listing, rows, style.say("continued"))]
    return [
        Page(
            heading,
            (),
            f"1:{scale}" if any(block.views for block in page) else "–",
            tuple(view for block in page for view in block.views),
            tuple(line for block in page for line in block.lines),
            (*(text for block in page for text in block.texts), *notes),
            tuple(table for block in page for table in block.tables),
        )
        for page in packed(groups, area)
    ]


def _scale(sections: tuple[ControlSection, ...]) -> int:
    size = max((max(s.reach[0] + s.reach[1], s.reach[2] + s.reach[3]) for s in sections), default=1)
    return next((scale for scale in SCALES if size / scale <= SECTION_ROOM), SCALES[-1])


def _paper(ring: np.ndarray) -> np.ndarray:
    """(y, z) as seen along +s: y to the left."""
    return np.stack([-ring[:, 0], ring[:, 1]], axis=1)


def section_block(section: ControlSection, scale: int, style: SheetStyle) -> Block:
    """One section with its plates marked, height, breadth and place of the axis."""
    rings = [_paper(plate.ring) for plate in section.plates]
    polylines = [Polyline(as_points(np.vstack([ring, ring[:1]])), "medium") for ring in rings]
    left, right, up, down = (value / scale for value in section.reach)
    cross = [
        Polyline(((-3.0, 0.0), (3.0, 0.0)), "chain"),
        Polyline(((0.0, -3.0), (0.0, 3.0)), "chain"),
    ]
    segments = [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) / scale for ring in rings]
    segments += [np.array([line.points]) for line in cross]
    x_dim, y_dim = right + DIMENSION_GAP, -down - DIMENSION_GAP
    lines = [
        Polyline(((-left, y_dim), (right, y_dim))),
        Polyline(((x_dim, -down), (x_dim, up))),
        *(Polyline(((x, y_dim - 1.5), (x, -down - 1.0))) for x in (-left, 0.0, right)),
        *(Polyline(((right + 1.0, y), (x_dim + 1.5, y))) for y in (-down, 0.0, up)),
    ]
    lines += [
        Polyline(((x - 0.9, y_dim - 0.9), (x + 0.9, y_dim + 0.9)), "medium")
        for x in (-left, 0, right)
    ] + [
        Polyline(((x_dim - 0.9, y - 0.9), (x_dim + 0.9, y + 0.9)), "medium") for y in (-down, 0, up)
    ]
    labels = Labels(np.concatenate([*segments, *(np.array([line.points]) for line in lines)]))
    y_left, y_right, z_up, z_down = section.reach
    for value, x, y, angle in (
        (y_left, -0.5 * left, y_dim + 0.8, 0.0),
        (y_right, 0.5 * right, y_dim + 0.8, 0.0),
        (z_up, x_dim - 0.8, 0.5 * up, 90.0),
        (z_down, x_dim - 0.8, -0.5 * down, 90.0),
    ):
        if value > 0.5:
            text = Text(x, y, FIGURES, style.length(value), angle, "middle")
            if not labels.put(text):
                # Outside the narrow gap, beyond the dimension line.
                step = (0.0, -3.4) if angle == 0.0 else (3.4, 0.0)
                labels.put(Text(x + step[0], y + step[1], FIGURES, text.text, angle, "middle"))
    middle = np.mean([ring.mean(axis=0) for ring in rings], axis=0) / scale
    left_out = 0
    for plate, ring in zip(section.plates, rings, strict=True):
        own = ring.mean(axis=0) / scale
        along = ring[1] - ring[0]
        normal = np.array([along[1], -along[0]]) / max(np.hypot(*along), 1e-9)
        normal = normal if (own - middle) @ normal > 0.0 else -normal
        reach = np.max((ring / scale - own) @ normal)
        text = f"{plate.mark} t{plate.thickness:g}"
        out = own + normal * reach
        beyond = ((out, own - normal), (own - normal * reach, own + normal))
        # Dimensions stand right and below, so the marks of those sides go inside.
        inside = normal[0] > 0.5 or normal[1] < -0.5
        left_out += not any(
            label_beyond(labels, text, end, far) for end, far in beyond[:: -1 if inside else 1]
        )
    caption = f"{section.label} {style.say(_WHAT[section.label[0]])}  s {style.length(section.s)}"
    bounds = np.array(
        [text_box(text) for text in labels.texts]
        + [[(-left, y_dim - 2.0)] * 4, [(x_dim + 2.0, up)] * 4]
    )
    low, high = bounds.min(axis=(0, 1)), bounds.max(axis=(0, 1))
    texts = [*labels.texts, Text(float(low[0]), float(high[1]) + 2.0, CAPTION, caption)]
    if left_out:
        texts.append(
            Text(
                float(low[0]),
                float(low[1]) - 3.0,
                FIGURES,
                style.say("labels left out: {}, see the tables", left_out),
            )
        )
    boxes = np.concatenate([text_box(text) for text in texts])
    low, high = np.minimum(low, boxes.min(axis=0)), np.maximum(high, boxes.max(axis=0))
    view = View(section.label, float(scale), (0.0, 0.0), tuple(polylines))
    box = (float(low[0]), float(low[1]), float(high[0]), float(high[1]) + 1.0)
    return Block("", (view,), (*cross, *lines, *labels.leaders), tuple(texts), box)


def _symbol_blocks(record: MemberRecord, scale: int, style: SheetStyle) -> list[Block]:
    """The welds at the section nearest to mid-length, then a symbol for each kind of weld."""
    blocks = []
    if record.controls:
        half = 0.5 * (record.controls[0].s + record.controls[-1].s)
        section = min(record.controls, key=lambda one: abs(one.s - half))
        block = _welded_section(section, record, scale, style)
        if block is not None:
            blocks.append(block)
    kinds = Counter((weld.prep, weld.place, weld.ndt) for weld in record.welds)
    for (prep, place, ndt), count in kinds.items():
        lines, texts = weld_symbol(prep, place, ndt, 6.0, 0.0, style)
        lines += arrow((6.0, 0.0), (0.0, -4.0))
        words = f"{prep.name or prep.type}: {style.say(prep.type)}, {style.say(place)}, × {count}"
        texts.append(Text(0.0, 8.0, FIGURES, words))
        wide = max(8.0 + weld_symbol_width(prep, ndt), text_width(words, FIGURES))
        blocks.append(Block("", (), tuple(lines), tuple(texts), (0.0, -8.0, wide + 2.0, 11.0)))
    return blocks


def _welded_section(section: ControlSection, record: MemberRecord, scale: int, style: SheetStyle):
    """A section with the symbols of the seams it cuts at its corners."""
    rings = {plate.mark: _paper(plate.ring) / scale for plate in section.plates}
    seams = [
        weld
        for weld in record.welds
        if weld.kind == "seam"
        and set(weld.plates) <= set(rings)
        and weld.start - 1.0 <= section.s <= weld.end + 1.0
    ]
    if not seams:
        return None
    points = np.concatenate(list(rings.values()))
    low, high = points.min(axis=0), points.max(axis=0)
    middle = 0.5 * (low + high)
    polylines = tuple(
        Polyline(as_points(np.vstack([ring, ring[:1]]) * scale), "medium")
        for ring in rings.values()
    )
    lines, texts = [], []
    for leftward in (True, False):
        corners = [(weld, _meeting(rings[weld.plates[0]], rings[weld.plates[1]])) for weld in seams]
        own = [(w, c) for w, c in corners if (c[0] < middle[0]) == leftward]
        own.sort(key=lambda item: item[1][1])
        level = -math.inf
        for weld, corner in own:
            side = 1.0 if corner[1] > middle[1] else -1.0
            level = max(level + 2 * GROOVE + 8.0, float(corner[1]) + 4.0 * side)
            x = float(low[0]) - 6.0 if leftward else float(high[0]) + 6.0
            more, words = weld_symbol(weld.prep, weld.place, weld.ndt, x, level, style, leftward)
            lines += [*more, *arrow((x, level), corner)]
            texts += words
    caption = style.say("Welds at {}", f"{section.label}  s {style.length(section.s)}")
    bounds = [points, *(np.array(line.points) for line in lines), *(text_box(t) for t in texts)]
    low, high = (
        np.min([b.min(axis=0) for b in bounds], axis=0),
        np.max([b.max(axis=0) for b in bounds], axis=0),
    )
    texts.append(Text(float(low[0]), float(high[1]) + 2.0, CAPTION, caption))
    right = max(float(high[0]), float(low[0]) + text_width(caption, CAPTION))
    view = View(f"welds {section.label}", float(scale), (0.0, 0.0), polylines)
    box = (float(low[0]), float(low[1]), right, float(high[1]) + 6.0)
    return Block("", (view,), tuple(lines), tuple(texts), box)


def _meeting(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Where two plates of a section come nearest, on their outer faces."""
    distance = np.hypot(*(first[:2, None] - second[None, :2]).transpose(2, 0, 1))
    i, j = np.unravel_index(int(np.argmin(distance)), distance.shape)
    return 0.5 * (first[i] + second[j])


def weld_listing(record: MemberRecord, style: SheetStyle) -> Listing:
    """The list of welds: mark, plates, type, sizes, length, place, NDT."""
    say = style.say
    header = style.said(
        ("weld", "plates", "t", "prep", "type", "angle, °", "land", "gap", "side", "from", "to",
         "length", "place", "NDT")
    )  # fmt: skip
    rows = tuple(_weld_row(weld, style) for weld in record.welds)
    return Listing(say("Welds and joints"), header, rows, "<<><<>>><>>><<")


def _weld_row(weld: Weld, style: SheetStyle) -> tuple[str, ...]:
    prep, say = weld.prep, style.say
    return (
        weld.mark,
        " / ".join(weld.plates),
        "/".join(dict.fromkeys(f"{t:g}" for t in weld.thickness)),
        prep.name,
        say(prep.type),
        f"{math.degrees(prep.angle):g}" if prep.angle else "–",
        fixed(prep.land, 1),
        fixed(prep.gap, 1),
        say(prep.side),
        style.length(weld.start),
        style.length(weld.end),
        style.length(weld.length),
        say(weld.place),
        weld.ndt or "–",
    )
