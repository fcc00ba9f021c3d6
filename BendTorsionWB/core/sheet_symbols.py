# SPDX-License-Identifier: LGPL-2.1-or-later
"""Symbols of drawings as polylines: projection, welds, centre of gravity, orientation, north.

Weld symbols follow ISO 2553 (system A, as GB/T 324: a dashed line for the other side) or AWS A2.4
(one reference line, the arrow's side below it).
"""

from __future__ import annotations

import math

import numpy as np

from .preps import Prep
from .sheet import Polyline, Text, text_width
from .sheet_labels import as_points
from .sheet_style import SheetStyle

HEIGHT = 1.8
GROOVE = 2.6
"""mm; height of a groove symbol over the reference line."""
REFERENCE = 17.0
"""mm; length of the reference line without tail."""
FLAG = 5.0


def circle(x: float, y: float, radius: float, style: str = "narrow", count: int = 24) -> Polyline:
    """A circle as a closed polyline."""
    angles = np.linspace(0.0, 2.0 * np.pi, count + 1)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + (x, y)
    return Polyline(as_points(ring), style)


def projection_symbol(middle: tuple[float, float], first_angle: bool) -> list[Polyline]:
    """The truncated cone of ISO 5456-2 about a middle: its end view right of it in first angle,
    left in third."""
    x, y = middle
    side = 1.0 if first_angle else -1.0
    cone, ends = x - 4.0 * side, x + 4.0 * side
    small, large = 1.1, 2.2
    ring = (
        (cone - 2.6, y - small),
        (cone + 2.6, y - large),
        (cone + 2.6, y + large),
        (cone - 2.6, y + small),
        (cone - 2.6, y - small),
    )
    return [
        Polyline(ring, "medium"),
        circle(ends, y, small, "medium"),
        circle(ends, y, large, "medium"),
        Polyline(((x - 7.6, y), (x + 7.6, y)), "chain"),
        Polyline(((ends, y - 2.6), (ends, y + 2.6)), "chain"),
    ]


def centre_mark(x: float, y: float, radius: float = 1.6) -> list[Polyline]:
    """The centre of gravity: a circle with a cross and two hatched quarters."""
    lines = [circle(x, y, radius, "medium")]
    lines += [
        Polyline(((x - 1.5 * radius, y), (x + 1.5 * radius, y))),
        Polyline(((x, y - 1.5 * radius), (x, y + 1.5 * radius))),
    ]
    for quarter in (0.0, math.pi):
        for part in (0.2, 0.5, 0.8):
            angle = quarter + 0.5 * math.pi * part
            end = (x + radius * math.cos(angle), y + radius * math.sin(angle))
            lines.append(Polyline(((x, y), end)))
    return lines


def arrow(tail, tip, style: str = "medium", head: float = 2.0) -> list[Polyline]:
    """A line with an arrow head at its tip."""
    tail, tip = np.asarray(tail, float), np.asarray(tip, float)
    along = (tip - tail) / np.hypot(*(tip - tail))
    aside = 0.3 * head * np.array([-along[1], along[0]])
    wings = np.array([tip - head * along + aside, tip, tip - head * along - aside])
    return [Polyline(as_points(np.array([tail, tip])), style), Polyline(as_points(wings), style)]


def north_arrow(x: float, y: float, angle: float, label: str) -> tuple[list[Polyline], list[Text]]:
    """An arrow about (x, y) that points north: `angle`, rad, counter-clockwise from upwards."""
    up = np.array([-math.sin(angle), math.cos(angle)])
    here = np.array([x, y])
    lines = arrow(here - 9.0 * up, here + 9.0 * up, "medium", 4.0)
    lines.append(circle(x, y, 5.0))
    at = here + 11.5 * up
    return lines, [Text(float(at[0]), float(at[1]) - 1.2, 3.5, label, anchor="middle")]


def weld_symbol(
    prep: Prep, place: str, ndt: str, x: float, y: float, style: SheetStyle, leftward: bool = False
) -> tuple[list[Polyline], list[Text]]:
    """The symbol of a weld whose reference line starts at (x, y), the end of its arrow, and runs
    to the right, or to the left. The arrow points at the outer face."""
    way = -1.0 if leftward else 1.0
    end = x + way * REFERENCE
    lines = [Polyline(((x, y), (end, y)), "medium")]
    iso = style.first_angle
    if iso and not prep.type.startswith("double"):
        lines.append(Polyline(((x, y - 1.0), (end, y - 1.0)), "dashed"))
    middle = x + way * 0.5 * REFERENCE
    arrow_side = 1.0 if iso else -1.0
    outer = prep.side == "outer"
    sides = (
        (1.0, -1.0) if prep.type.startswith("double") else (arrow_side if outer else -arrow_side,)
    )
    for side in sides:
        # On the dashed line of ISO, which stands for the other side.
        foot = y - 1.0 if iso and not outer and len(sides) == 1 else y
        lines += [
            Polyline(tuple((middle + u, foot + side * v) for u, v in line), "medium")
            for line in _groove(prep)
        ]
    texts = []
    label = f"{math.degrees(prep.angle):g}°" if prep.angle else ""
    if prep.is_cut and label:
        side = sides[0]
        at = y + side * (GROOVE + 0.8) - (HEIGHT if side < 0 else 0.0)
        at -= 1.0 if iso and side < 0 else 0.0
        texts.append(Text(middle, at, HEIGHT, label, anchor="middle"))
    if prep.gap and prep.is_cut:
        side = sides[0]
        at = y + side * 0.8 - (HEIGHT if side < 0 else 0.0) - (1.0 if iso and side < 0 else 0.0)
        texts.append(Text(middle + 3.2, at, HEIGHT, style.length(prep.gap, 1)))
    if place == "field":
        lines.append(
            Polyline(((x, y), (x, y + FLAG), (x + way * 2.2, y + FLAG - 1.0), (x, y + FLAG - 2.0)))
        )
    tail = " ".join(word for word in (prep.name if prep.name != prep.type else "", ndt) if word)
    if tail:
        fork = ((end + way * 1.8, y + 1.8), (end, y), (end + way * 1.8, y - 1.8))
        lines.append(Polyline(fork, "medium"))
        anchor = "end" if leftward else "start"
        texts.append(Text(end + way * 2.4, y - 0.5 * HEIGHT, HEIGHT, tail, anchor=anchor))
    return lines, texts


def weld_symbol_width(prep: Prep, ndt: str) -> float:
    """Width of the symbol, its tail included, mm."""
    tail = " ".join(word for word in (prep.name if prep.name != prep.type else "", ndt) if word)
    return REFERENCE + (2.4 + text_width(tail, HEIGHT) if tail else 0.0)


def _groove(prep: Prep) -> list[tuple[tuple[float, float], ...]]:
    """The groove above a reference line, about its middle."""
    kind = prep.type.removeprefix("double-")
    if kind == "square":
        return [((-0.6, 0.0), (-0.6, GROOVE)), ((0.6, 0.0), (0.6, GROOVE))]
    if kind == "fillet":
        return [((-1.3, 0.0), (-1.3, GROOVE), (1.3, 0.0))]
    if kind == "bevel":
        return [((-0.9, 0.0), (-0.9, GROOVE)), ((-0.9, 0.0), (1.3, GROOVE))]
    return [((-1.5, GROOVE), (0.0, 0.0), (1.5, GROOVE))]
