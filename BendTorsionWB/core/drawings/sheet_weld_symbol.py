# SPDX-License-Identifier: LGPL-2.1-or-later
"""Weld symbols of ISO 2553 system A (as GB/T 324) and of AWS A2.4.

ISO: the arrow's side stands on the continuous line, the other side on the dashed one. AWS: one
line, the arrow's side below it. Left of the symbol stands how deep the weld is: nothing when it
goes through the whole plate, else ISO `s14` (depth of penetration), AWS `14` (depth of the groove);
of a fillet its leg, ISO `z6`, AWS `6`. In or over the groove stand the root gap and the angle.
"""

from __future__ import annotations

import math

import numpy as np

from ..welds.preps import SLOT, TYPES, Prep
from .sheet import Polyline, Text, text_width, wrapped
from .sheet_labels import as_points
from .sheet_style import SheetStyle
from .sheet_symbols import arrow
from .sheet_terms import PREPARATIONS

HEIGHT = 1.8
GROOVE = 4.6
"""mm; height of a groove symbol over the reference line."""
REFERENCE = 22.0
"""mm; length of the reference line without tail."""
FLAG = 6.5
SYMBOL_ROOM = GROOVE + 8.5
"""mm; what a symbol takes above its reference line, and below."""
KNEE = 2.5
"""mm; how far a broken arrow of AWS bends aside at most."""
DASHED = 1.0
"""mm from the continuous to the dashed line."""
FULL_PENETRATION_LAND = 3.0
"""mm; a root face up to this is melted through, as in prequalified full penetration grooves of
AWS D1.1; a thicker one is left, and the weld is as deep as its groove."""
PERMANENT = "M"
"""ISO: a backing that stays."""
TAIL, TAIL_ROOM, TAIL_ROW = 2.6, 44.0, 2.8
"""mm; from the reference line to the text in the tail, width of that at most, of its lines."""


def weld_symbol(
    prep: Prep,
    thickness: float | None,
    place: str,
    ndt: str,
    at: tuple[float, float],
    style: SheetStyle,
    leftward: bool = False,
    letter: str = "",
    brief: bool = False,
) -> tuple[list[Polyline], list[Text]]:
    """The symbol of a weld whose reference line starts at a point, the end of its arrow, and runs
    to the right, or to the left. The arrow points at the outer face. thickness: of the plates, mm;
    None for welds of several, whose depth is told by t. letter: of its kind, for the tail; brief:
    nothing else there."""
    x, y = at
    way = -1.0 if leftward else 1.0
    end = x + way * REFERENCE
    lines = [Polyline(((x, y), (end, y)), "medium")]
    texts: list[Text] = []
    iso, double = style.first_angle, prep.type.startswith("double")
    if iso and not double:
        lines.append(Polyline(((x, y - DASHED), (end, y - DASHED)), "dashed"))
    # The depth stands left of the groove, so that side has the more room.
    middle = x + way * (0.4 if leftward else 0.6) * REFERENCE
    arrow_side = (1.0 if iso else -1.0) * (1.0 if prep.side == "outer" else -1.0)
    for side in (1.0, -1.0) if double else (arrow_side,):
        # Below the continuous line of ISO runs the dashed one.
        foot = y - DASHED if iso and side < 0.0 and not double else y
        lines += [
            Polyline(tuple((middle + u, foot + side * v) for u, v in line), "medium")
            for line in _groove(prep)
        ]
        texts += _figures(prep, thickness, middle, foot, side, style)
    if prep.backing:
        side = -arrow_side
        foot = y - DASHED if iso and side < 0.0 else y
        ring = ((-2.1, 0.0), (-2.1, 3.4), (2.1, 3.4), (2.1, 0.0))
        lines.append(Polyline(tuple((middle + u, foot + side * v) for u, v in ring), "medium"))
        if iso:
            low = foot + (0.9 if side > 0.0 else -2.5)
            texts.append(Text(middle, low, HEIGHT, PERMANENT, anchor="middle"))
    if place == "field":
        lines.append(
            Polyline(((x, y), (x, y + FLAG), (x + way * 3.0, y + FLAG - 1.3), (x, y + FLAG - 2.6)))
        )
    tail = [letter] if brief else tail_lines(prep, ndt, style, letter)
    if tail:
        fork = ((end + way * 1.8, y + 1.8), (end, y), (end + way * 1.8, y - 1.8))
        lines.append(Polyline(fork, "medium"))
        anchor = "end" if leftward else "start"
        top = y - 0.5 * HEIGHT + 0.5 * TAIL_ROW * (len(tail) - 1)
        texts += [
            Text(end + way * TAIL, top - TAIL_ROW * k, HEIGHT, line, anchor=anchor)
            for k, line in enumerate(tail)
        ]
    return lines, texts


def _figures(
    prep: Prep, thickness: float | None, middle: float, foot: float, side: float, style: SheetStyle
) -> list[Text]:
    """Depth or leg left of the groove, root gap and angle in and over it."""
    texts = []

    def stands(height: float) -> float:
        """The base line of a text whose near edge is a height over the reference line."""
        return foot + height if side > 0.0 else foot - height - HEIGHT

    depth = depth_text(prep, thickness, style)
    if depth:
        texts.append(Text(middle - 2.8, stands(1.0), HEIGHT, depth, anchor="end"))
    level = GROOVE + 0.9
    if prep.gap and not prep.type.endswith(("fillet", SLOT)):
        gap = _size(prep.gap, style)
        narrow = prep.type.endswith("square") or text_width(gap, HEIGHT) > 1.7
        # The slant of a bevel leaves less room low on its right.
        inside = middle - (0.35 if prep.type.endswith("bevel") else 0.0)
        if narrow:
            texts.append(Text(middle, stands(level), HEIGHT, gap, anchor="middle"))
            level += HEIGHT + 1.1
        else:
            texts.append(Text(inside, stands(2.75), HEIGHT, gap, anchor="middle"))
    if prep.is_cut and prep.angle:
        angle = f"{math.degrees(prep.angle):g}°"
        texts.append(Text(middle, stands(level), HEIGHT, angle, anchor="middle"))
    return texts


def depth_text(prep: Prep, thickness: float | None, style: SheetStyle) -> str:
    """How deep a weld is where it does not go through, or the leg of a fillet; empty else."""
    iso = style.first_angle
    if prep.type.endswith("fillet"):
        return ("z" if iso else "") + _size(prep.leg, style) if prep.leg else ""
    if not is_partial(prep):
        return ""
    if thickness is None:
        share = "(t-{})/2" if prep.type.startswith("double") else "t-{}"
        return ("s " if iso else "") + share.format(_size(prep.land, style))
    return ("s" if iso else "") + _size(prep.depth(thickness), style)


def is_partial(prep: Prep) -> bool:
    """True of a groove weld that leaves a part of the root face unwelded. On a backing bar a gap as
    wide as the root face is high fills it (AWS D1.1, prequalified square groove B-L1a)."""
    filled = prep.backing is not None and prep.gap >= prep.land
    return prep.is_cut and not filled and prep.land > FULL_PENETRATION_LAND


def _size(value: float, style: SheetStyle) -> str:
    return style.fine(value).removesuffix(".0")


def prep_title(prep: Prep, style: SheetStyle) -> str:
    """The name of a preparation; nothing of one that is told by its type and sizes alone, which
    the symbol shows."""
    if prep.name.partition(" ")[0] in ("", *TYPES):
        return ""
    if prep.type == SLOT:
        word, _, size = prep.name.partition(" ")
        word = PREPARATIONS[word] if style.language == "zh" else word
        return f"{word} {style.shape(size)}"
    return PREPARATIONS.get(prep.name, prep.name) if style.language == "zh" else prep.name


def tail_lines(prep: Prep, ndt: str, style: SheetStyle, letter: str = "") -> list[str]:
    """What stands in the tail, line by line: the letter of the kind of weld, the name of the
    preparation and the test."""
    words = " ".join(word for word in (letter, prep_title(prep, style), ndt) if word)
    return wrapped(words, HEIGHT, TAIL_ROOM)


def weld_symbol_width(prep: Prep, ndt: str, style: SheetStyle) -> float:
    """Width of the symbol, its tail included, mm."""
    tail = tail_lines(prep, ndt, style)
    return REFERENCE + (TAIL + max(text_width(line, HEIGHT) for line in tail) if tail else 0.0)


def weld_arrow(prep: Prep, tail, tip, style: SheetStyle) -> list[Polyline]:
    """The arrow from a reference line to a weld. AWS breaks it where one plate alone is cut: it
    points at that one."""
    tail, tip = np.asarray(tail, float), np.asarray(tip, float)
    if style.first_angle or not prep.type.endswith("bevel"):
        return arrow(tail, tip)
    along = tip - tail
    aside = min(0.18, KNEE / max(float(np.hypot(*along)), 1e-9))
    knee = tail + 0.45 * along + aside * np.array([-along[1], along[0]])
    return [Polyline(as_points(np.array([tail, knee])), "medium"), *arrow(knee, tip)]


def _groove(prep: Prep) -> list[tuple[tuple[float, float], ...]]:
    """The groove above a reference line, about its middle."""
    kind = prep.type.removeprefix("double-")
    if kind == "square":
        return [((-0.6, 0.0), (-0.6, GROOVE)), ((0.6, 0.0), (0.6, GROOVE))]
    if kind == SLOT:
        return [((-2.6, 0.0), (-2.6, 3.0), (2.6, 3.0), (2.6, 0.0))]
    if kind == "fillet":
        return [((-1.8, 0.0), (-1.8, 3.6), (1.8, 0.0))]
    if kind == "bevel":
        return [((-1.5, 0.0), (-1.5, GROOVE)), ((-1.5, 0.0), (3.1, GROOVE))]
    return [((-3.0, GROOVE), (0.0, 0.0), (3.0, GROOVE))]
