# SPDX-License-Identifier: LGPL-2.1-or-later
"""Symbols of drawings as polylines: projection, centre of gravity, orientation, north."""

from __future__ import annotations

import math

import numpy as np

from .sheet import Polyline, Text
from .sheet_labels import as_points


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
    at = here + 12.6 * up
    return lines, [Text(float(at[0]), float(at[1]) - 1.75, 3.5, label, anchor="middle")]
