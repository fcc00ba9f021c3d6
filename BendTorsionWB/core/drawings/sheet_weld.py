# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds of a delivery piece: symbols at a section, one of each kind, map, list, backing bars."""

from __future__ import annotations

import math
import string
from collections.abc import Sequence

import numpy as np

from ..beds.control_record import ControlSection
from ..lofting import MemberRecord
from ..welds.backing import backing_bars
from ..welds.preps import SLOT, Prep
from ..welds.weld_record import Weld
from .sheet import Polyline, Text, View, text_box, text_width, wrapped
from .sheet_labels import as_points
from .sheet_pack import Block
from .sheet_style import SheetStyle, fixed
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing, even_rows, table_blocks
from .sheet_weld_map import weld_map_blocks
from .sheet_weld_symbol import (
    SYMBOL_ROOM,
    prep_title,
    weld_arrow,
    weld_symbol,
    weld_symbol_width,
)

CAPTION, FIGURES, ROW = 2.5, 1.8, 2.8
LEAST_ROWS = 8
"""Rows of a list of welds beside which the rest begins another column."""
CAPTION_ROOM = 100.0
"""mm; width of what is said of a symbol at most."""


def weld_groups(
    record: MemberRecord, scale: int, area: tuple[float, float, float, float], style: SheetStyle
) -> list[list[Block]]:
    """Blocks of the welds of a record, the symbols together and then each strip of the map;
    scale: of the section drawn. area: (left, bottom, right, top) of a page, mm."""
    if not record.welds:
        return []
    wide, high = area[2] - area[0], area[3] - area[1]
    letters = kind_letters(record.welds)
    groups = [_section_blocks(record, letters, scale, wide, style)]
    groups[0] += symbol_blocks(record.welds, letters, style)
    return groups + [[block] for block in weld_map_blocks(record, letters, (wide, high), style)]


def list_groups(
    record: MemberRecord, area: tuple[float, float, float, float], whole: bool, style: SheetStyle
) -> list[list[Block]]:
    """The lists of the welds of a record and of their backing bars, each a group of tables. whole:
    those that a page of the area holds are one table, else parts side by side."""
    if not record.welds:
        return []
    wide, high = area[2] - area[0], area[3] - area[1]
    letters, groups = kind_letters(record.welds), []
    for listing in (
        *weld_listings(record, letters, style, wide),
        bar_listing(record, style),
    ):
        if listing.rows:
            listing = listing.within(wide)
            most = int((high - TITLE_ROOM) // ROW_HEIGHT) - 1
            beside = max(1, int((wide + 5.0) // (sum(listing.widths) + 5.0)))
            parted = max(LEAST_ROWS, -(-len(listing.rows) // beside))
            rows = even_rows(len(listing.rows), most if whole else min(most, parted))
            groups.append(table_blocks(listing, rows, style.say("continued")))
    return groups


def kind_letters(welds: Sequence[Weld]) -> dict[tuple, str]:
    """A letter for each kind of weld, of one preparation, place and test: A, B ... Z, AA ..."""
    kinds = dict.fromkeys(weld_kind(weld) for weld in welds)
    names = string.ascii_uppercase
    return {
        kind: (names[k // 26 - 1] if k >= 26 else "") + names[k % 26]
        for k, kind in enumerate(kinds)
    }


def type_word(prep: Prep) -> str:
    """The type of a preparation as sheets write it."""
    return "V" if prep.type == "v" else prep.type


def weld_kind(weld: Weld) -> tuple:
    """What welds of one letter have in common."""
    return weld.prep, weld.place, weld.ndt


def _section_blocks(
    record: MemberRecord, letters: dict[tuple, str], scale: int, room: float, style: SheetStyle
) -> list[Block]:
    """The welds at the section nearest to mid-length that cuts any; with the letters of their kinds
    alone where all that symbols tell is wider than `room`, mm."""
    if not record.controls:
        return []
    half = 0.5 * (record.controls[0].s + record.controls[-1].s)
    nearest = sorted(record.controls, key=lambda one: abs(one.s - half))
    for section in nearest:
        for brief in (False, True):
            block = _welded_section(section, record, letters, scale, brief, style)
            if block is not None and (brief or block.size[0] <= room):
                return [block]
    return []


def symbol_blocks(
    welds: Sequence[Weld], letters: dict[tuple, str], style: SheetStyle
) -> list[Block]:
    """A symbol for each kind of weld."""
    say, blocks = style.say, []
    for (prep, place, ndt), letter in letters.items():
        own = [weld for weld in welds if weld_kind(weld) == (prep, place, ndt)]
        depths = {weld.cut_thickness for weld in own}
        thickness = depths.pop() if len(depths) == 1 else None
        at = (6.0, -SYMBOL_ROOM)
        lines, texts = weld_symbol(prep, thickness, place, ndt, at, style)
        lines += weld_arrow(prep, at, (0.0, at[1] - 4.0), style)
        total = style.length(sum(weld.length for weld in own), 0)
        unit = "" if style.unit == "ft-in" else " mm"
        named = prep_title(prep, style)
        kind = f"{named + ': ' if named else ''}{say(type_word(prep))}, {say(place)}"
        words = f"{letter}  {kind}, × {len(own)}, {say('in all {}', total + unit)}"
        captions = wrapped(words, FIGURES, CAPTION_ROOM)
        high = ROW * (len(captions) - 1)
        texts += [
            Text(0.0, high - FIGURES - ROW * k, FIGURES, line) for k, line in enumerate(captions)
        ]
        wide = max(text_width(line, FIGURES) for line in captions)
        wide = max(8.0 + weld_symbol_width(prep, ndt, style), wide)
        low = min(float(text_box(text)[:, 1].min()) for text in texts)
        low = min(low, *(y for line in lines for _, y in line.points))
        box = (0.0, low - 2.0, wide + 2.0, high + 1.0)
        blocks.append(Block("", (), tuple(lines), tuple(texts), box))
    return blocks


def _welded_section(
    section: ControlSection,
    record: MemberRecord,
    letters: dict[tuple, str],
    scale: int,
    brief: bool,
    style: SheetStyle,
) -> Block | None:
    """A section with the symbols of the seams it cuts at its corners; None without seams."""
    rings = {
        plate.mark: np.stack([-plate.ring[:, 0], plate.ring[:, 1]], axis=1) / scale
        for plate in section.plates
    }
    seams = {
        weld.name: weld
        for weld in record.welds
        if weld.kind == "seam"
        and set(weld.plates) <= set(rings)
        and weld.start - 1.0 <= section.s <= weld.end + 1.0
    }
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
        corners = [(w, _cut_corner(rings[w.plates[0]], rings[w.plates[1]])) for w in seams.values()]
        own = [(w, c) for w, c in corners if (c[0] < middle[0]) == leftward]
        own.sort(key=lambda item: item[1][1])
        level = -math.inf
        for weld, corner in own:
            side = 1.0 if corner[1] > middle[1] else -1.0
            level = max(level + 2.0 * SYMBOL_ROOM, float(corner[1]) + 5.0 * side)
            at = (float(low[0]) - 6.0 if leftward else float(high[0]) + 6.0, level)
            thickness = weld.cut_thickness
            more, words = weld_symbol(
                *(weld.prep, thickness, weld.place, weld.ndt, at, style, leftward),
                *(letters[weld_kind(weld)], brief),
            )
            lines += [*more, *weld_arrow(weld.prep, at, corner, style)]
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


def _cut_corner(cut: np.ndarray, beside: np.ndarray) -> np.ndarray:
    """The end of the outer face of the plate that is cut which lies nearest to the other plate."""
    distance = np.hypot(*(cut[:2, None] - beside[None]).transpose(2, 0, 1))
    return cut[int(np.argmin(distance.min(axis=1)))]


_COLUMNS = {
    "weld": "<", "cut / on": "<", "t": ">", "symbol": "<", "type": "<", "angle, °": ">",
    "land": ">", "gap": ">", "depth": ">", "side": "<", "backing": "<", "from": ">", "to": ">",
    "length": ">", "place": "<", "NDT": "<",
}  # fmt: skip
_OF_KIND = ("type", "angle, °", "land", "gap", "side", "backing", "place", "NDT")
"""Columns that are the same for all welds of one letter."""
_IF_ANY = ("side", "backing", "NDT")
"""Columns left out when nothing stands in them."""


def weld_listings(
    record: MemberRecord, letters: dict[tuple, str], style: SheetStyle, room: float
) -> list[Listing]:
    """The list of welds: mark, plates, type, sizes, length, place, NDT, and the total length.
    Where that is wider than `room`, mm, what all welds of a kind have in common is in a list of the
    kinds before it."""
    say = style.say
    unit = " (mm)" if style.unit == "mm" else ""
    cells = [
        dict(
            zip(
                _COLUMNS,
                _weld_row(weld, letters[weld_kind(weld)], record.member, style),
                strict=True,
            )
        )
        for weld in record.welds
    ]
    total = {"weld": say("total"), "length": style.length(sum(w.length for w in record.welds))}
    used = {name for name in _IF_ANY for row in cells if row[name] not in ("–", say("outer"))}
    shown = [name for name in _COLUMNS if name not in _IF_ANY or name in used]
    whole = _listing(say(f"Welds and joints{unit}"), shown, [*cells, total], style)
    if sum(whole.widths) <= room:
        return [whole]
    own = [name for name in shown if name not in _OF_KIND]
    common = ["symbol", *(name for name in shown if name in _OF_KIND)]
    kinds = {row["symbol"]: row for row in cells}
    return [
        _listing(say(f"Kinds of welds{unit}"), common, list(kinds.values()), style),
        _listing(whole.title, own, [*cells, total], style),
    ]


def _listing(title: str, columns: list[str], cells: list[dict], style: SheetStyle) -> Listing:
    rows = tuple(tuple(row.get(name, "") for name in columns) for row in cells)
    return Listing(
        title, style.headings(tuple(columns)), rows, "".join(_COLUMNS[name] for name in columns)
    )


def _weld_row(weld: Weld, letter: str, member: str, style: SheetStyle) -> tuple[str, ...]:
    prep, say = weld.prep, style.say
    depth = "–"
    if prep.is_cut:
        deep = prep.depth(weld.cut_thickness)
        both = prep.type.startswith("double")
        depth = "/".join([style.fine(deep)] * (2 if both else 1))
    elif prep.type == SLOT:
        depth = style.shape(prep.name.removeprefix("slot "))
    elif prep.leg:
        depth = f"z {style.fine(prep.leg)}"
    return (
        weld.mark,
        " / ".join(mark.removeprefix(f"{member}-") for mark in weld.plates),
        "/".join(map(style.thickness, dict.fromkeys(weld.thickness))),
        letter,
        say(type_word(prep)),
        f"{math.degrees(prep.angle):g}" if prep.angle else "–",
        style.fine(prep.land),
        style.fine(prep.gap),
        depth,
        say(prep.side),
        style.shape("{:g}x{:g}".format(*prep.backing)) if prep.backing else "–",
        style.length(weld.start),
        style.length(weld.end),
        style.length(weld.length),
        say(weld.place),
        weld.ndt or "–",
    )


def bar_listing(record: MemberRecord, style: SheetStyle) -> Listing:
    """The backing bars of a record's welds."""
    header = style.headings(("mark", "weld", "width", "t", "length", "material", "mass, kg"))
    rows = tuple(
        (
            bar.mark,
            bar.weld,
            style.fine(bar.width) if style.unit == "ft-in" else f"{bar.width:g}",
            style.thickness(bar.thickness),
            style.length(bar.length),
            bar.material,
            fixed(bar.mass, 1),
        )
        for bar in backing_bars(record)
    )
    title = style.say("Backing bars (not in the mass of the member)")
    return Listing(title, header, rows, "<<>>><>")
