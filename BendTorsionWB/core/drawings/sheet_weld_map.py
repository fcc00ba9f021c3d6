# SPDX-License-Identifier: LGPL-2.1-or-later
"""The weld map of a delivery piece: its faces and seams side by side along s, each weld named.

A face is a band of its plates with the butt joints between them, a seam a line between ticks. The
letter after a weld's name is that of its symbol. Along s the map is to scale, across it is not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..lofting import DevelopedPlate, MemberRecord
from ..welds.weld_record import Weld
from .sheet import Polyline, Text, text_width
from .sheet_overview import spread
from .sheet_pack import Block
from .sheet_style import SheetStyle

TEXT, CAPTION = 1.8, 2.5
LABEL_SPACING = 2.9
LEFT, RIGHT = 12.0, 4.0
"""mm beside the map, for the names of its rows."""
BAND, LEADER, GAP = 6.0, 3.5, 2.0
HEAD = 6.5
AROUND = ("R", "T", "L", "B")
"""Faces of a box as they lie when it is opened along its bottom right corner."""
FLAG = 3.2


@dataclass(frozen=True)
class _Row:
    """A row of the map: of a face with its plates and joints, or of a seam with its welds."""

    name: str
    plates: tuple[DevelopedPlate, ...]
    welds: tuple[Weld, ...]


def weld_map_blocks(
    record: MemberRecord,
    letters: dict[tuple, str],
    size: tuple[float, float],
    style: SheetStyle,
) -> list[Block]:
    """The map on pages of this width and height, mm, in as many strips of the length as the names
    of the welds need."""
    width, height = size
    rows = _rows(record)
    if not rows:
        return []
    places = [s for row in rows for w in row.welds for s in (w.start, w.end)]
    places += [s for row in rows for plate in row.plates for s in (plate.s_start, plate.s_end)]
    start, end = min(places), max(places)
    room = width - LEFT - RIGHT
    crowd = max(len(row.welds) for row in rows)
    count = max(1, math.ceil(crowd * LABEL_SPACING / room))
    step = (end - start) / count
    blocks: list[Block] = []
    for k in range(count):
        span = (start + k * step, start + (k + 1) * step)
        parts = [_row(row, span, letters, width, style) for row in rows]
        while parts:
            # As many rows as a page holds.
            high, own = HEAD, 0
            while own < len(parts) and (not own or high + parts[own].size[1] + GAP <= height):
                high += parts[own].size[1] + GAP
                own += 1
            blocks.append(_stacked(parts[:own], span, bool(blocks), width, style))
            parts = parts[own:]
    return blocks


def _stacked(parts, span, continued: bool, width: float, style: SheetStyle) -> Block:
    """Rows one below the other under a caption, hanging from (0, 0)."""
    caption = style.say("Weld map (continued)" if continued else "Weld map")
    more = style.say("s {} to {}, +s to the right; face: plates and joints; seam: welds",
                     *map(style.length, span))  # fmt: skip
    texts = [Text(0.0, -CAPTION - 1.0, CAPTION, caption)]
    beside = text_width(caption, CAPTION) + 5.0
    if beside + text_width(more, TEXT) <= width:
        texts.append(Text(beside, -CAPTION - 1.0, TEXT, more))
    lines: list[Polyline] = []
    y = -HEAD
    for part in parts:
        moved = part.moved(0.0, y)
        lines += moved.lines
        texts += moved.texts
        y -= part.size[1] + GAP
    return Block("", (), tuple(lines), tuple(texts), (0.0, y, width, 0.0))


def _rows(record: MemberRecord) -> list[_Row]:
    plates = [plate for plate in record.plates if plate.lines]
    joints = [weld for weld in record.welds if weld.kind in ("joint", "node", "diaphragm", "end")]
    seams: dict[str, list[Weld]] = {}
    for weld in record.welds:
        if weld.kind in ("seam", "lane"):
            seams.setdefault(weld.name, []).append(weld)
    faces: dict[str, list[DevelopedPlate]] = {}
    for plate in plates:
        faces.setdefault(plate.letter, []).append(plate)
    names = list(faces)
    if set(names) == set(AROUND):
        names = list(AROUND)
    rows: list[_Row] = []
    left = dict(seams)
    for k, name in enumerate(names):
        marks = {plate.mark for plate in faces[name]}
        # A seam stands before the later of its faces.
        for seam in [s for s in left if name in s and set(s) & set(names[:k])]:
            last = k == len(names) - 1 and names[0] in seam
            if not (last and len(names) > 2):
                rows.append(_Row(seam, (), tuple(left.pop(seam))))
        own = tuple(weld for weld in joints if set(weld.plates) & marks)
        rows.append(_Row(name, tuple(faces[name]), own))
    return [*rows, *(_Row(seam, (), tuple(welds)) for seam, welds in left.items())]


def _row(
    row: _Row,
    span: tuple[float, float],
    letters: dict[tuple, str],
    width: float,
    style: SheetStyle,
) -> Block:
    """A row of the map between two arc lengths, hanging from (0, 0)."""
    lines: list[Polyline] = []
    texts: list[Text] = []
    (start, end), right, y = span, width - RIGHT, 0.0

    def at(s: float) -> float:
        return LEFT + (min(max(s, start), end) - start) / (end - start) * (right - LEFT)

    tracks = _tracks(row.plates)
    flags = any(weld.place == "field" for weld in row.welds)
    y -= FLAG if flags else 0.0
    top = y
    for track in tracks:
        for plate in track:
            if plate.s_end > start and plate.s_start < end:
                _plate(plate, at(plate.s_start), at(plate.s_end), y, lines, texts)
        y -= BAND
    y -= 0.0 if tracks else 1.0
    texts.append(Text(0.0, 0.5 * (top + y) - 0.5 * TEXT, TEXT, row.name))
    named = []
    for weld in row.welds:
        if weld.end < start or weld.start > end:
            continue
        low, high = at(weld.start), at(weld.end)
        if not tracks:
            lines.append(Polyline(((low, y), (high, y)), "wide"))
            lines += [Polyline(((x, y - 0.8), (x, y + 0.8)), "medium") for x in (low, high)]
        middle = 0.5 * (weld.start + weld.end)
        # One of two strips names a weld: that with its middle, the first of two at their seam.
        if start < middle <= end or (middle == start and weld.start == weld.end == 0.0):
            named.append((at(middle), weld))
    y = _names(named, letters, y, (LEFT, right), style, len(tracks), lines, texts)
    return Block("", (), tuple(lines), tuple(texts), (0.0, y, width, 0.0))


def _tracks(plates: Iterable[DevelopedPlate]) -> list[list[DevelopedPlate]]:
    """Plates of a face in rows that lie beside one another, as lanes do."""
    tracks: list[list[DevelopedPlate]] = []
    for plate in sorted(plates, key=lambda plate: plate.s_start):
        track = next((own for own in tracks if own[-1].s_end <= plate.s_start + 1.0), None)
        if track is None:
            tracks.append(track := [])
        track.append(plate)
    return tracks


def _plate(plate, left: float, right: float, top: float, lines, texts) -> None:
    low = top - BAND
    ring = ((left, top), (right, top), (right, low), (left, low), (left, top))
    lines.append(Polyline(ring, "medium"))
    name = plate.mark.split("-")[-1]
    x, y = 0.5 * (left + right), top - 0.5 * BAND - 0.5 * TEXT
    if text_width(name, TEXT) + 1.0 <= right - left:
        texts.append(Text(x, y, TEXT, name, anchor="middle"))
    elif right - left > TEXT + 1.6 and text_width(name, TEXT) + 0.8 <= BAND:
        texts.append(Text(x + 0.5 * TEXT, top - 0.5 * BAND, TEXT, name, 90.0, "middle"))


def _names(
    named: Sequence[tuple[float, Weld]],
    letters: dict[tuple, str],
    y: float,
    sides: tuple[float, float],
    style: SheetStyle,
    tracks: int,
    lines: list[Polyline],
    texts: list[Text],
) -> float:
    """Upright names of welds under a row at height y, each with a line to its place, a flag on it
    when it is made in the field; gives the height below them."""
    if not named:
        return y
    named = sorted(named, key=lambda item: item[0])
    wanted = [x for x, _ in named]
    level, deepest = y - LEADER, 0.0
    placed = spread(wanted, LABEL_SPACING, sides[0] + 1.0, sides[1] - 1.0)
    for (x, weld), stands in zip(named, placed, strict=True):
        short = weld.mark.split("-")[-1]
        text = f"{short} {letters[weld.prep, weld.place, weld.ndt]}"
        if tracks:
            text += f"  {style.length(weld.start)}"
        texts.append(Text(stands + 0.5 * TEXT, level - 0.8, TEXT, text, 90.0, "end"))
        deepest = max(deepest, text_width(text, TEXT))
        lines.append(Polyline(((stands, level), (stands, level + 0.9), (x, y))))
        if weld.place == "field":
            tip = (x, y + tracks * BAND + FLAG)
            foot = (x, y)
            flag = ((tip[0] + 2.2, tip[1] - 0.9), (tip[0], tip[1] - 1.8))
            lines.append(Polyline((foot, tip, *flag), "medium"))
    return level - 0.8 - deepest - 0.4
