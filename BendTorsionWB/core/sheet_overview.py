# SPDX-License-Identifier: LGPL-2.1-or-later
"""The overview of a member: elevation and plan along its chord, plate ends and marks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .lofting import DevelopedPlate, MemberRecord
from .sheet import Polyline, Text, View, text_width
from .sheet_pattern import as_points, simplified

SCALES = (5, 10, 15, 20, 25, 30, 40, 50, 75, 100, 150, 200, 250, 300, 400, 500, 750, 1000)
DRAWN_TOLERANCE = 0.04  # mm on paper; hidden-line removal takes time with the square of the edges
MARK_HEIGHT = 2.0
ROW = 4.2  # mm between rows of marks
HEADING = 7.0
PLAN_FACES = ("top", "bottom")


@dataclass(frozen=True)
class Overview:
    """Two views at one scale with their texts and leaders, page mm."""

    scale: int
    views: tuple[View, ...]
    lines: tuple[Polyline, ...]
    texts: tuple[Text, ...]


def chord_frame(record: MemberRecord) -> np.ndarray:
    """(3, 3) rows: along the axis' end-to-end chord, across it, and up (z where it can be)."""
    axis = record.wireframe.get("axis")
    if axis is None:
        axis = max(record.wireframe.values(), key=lambda line: np.ptp(line, axis=0).max())
    along = axis[-1] - axis[0]
    if np.linalg.norm(along) < 1e-6 * max(np.ptp(axis, axis=0).max(), 1e-9):
        along = axis[len(axis) // 2] - axis[0]
    along = along / np.linalg.norm(along)
    up = np.array([0.0, 0.0, 1.0]) - along[2] * along
    if np.linalg.norm(up) < 0.05:
        up = np.array([0.0, 1.0, 0.0]) - along[1] * along
    up = up / np.linalg.norm(up)
    return np.array([along, np.cross(up, along), up])


def overview(record: MemberRecord, area: tuple[float, float, float, float]) -> Overview:
    """The member's wireframe in elevation (webs marked) and plan (flanges marked) within `area`.

    area: (left, bottom, right, top) page mm. The largest scale of SCALES that fits is taken.
    """
    frame = chord_frame(record)
    origin = np.mean([line.mean(axis=0) for line in record.wireframe.values()], axis=0)
    lines = {name: (line - origin) @ frame.T for name, line in record.wireframe.items()}
    lines |= {
        f"{plate.mark} {label}": (ends - origin) @ frame.T
        for plate in record.plates
        for label in ("E-1", "E-2")
        if len(ends := _line_ends(plate, label)) == 2
    }
    middles = {
        plate.mark: (np.mean([p.xyz for p in plate.points], axis=0) - origin) @ frame.T
        for plate in record.plates
        if plate.points
    }
    faces = {plate.mark: plate.face for plate in record.plates}
    parts = (
        ("Elevation", (0, 2), {m: p for m, p in middles.items() if faces[m] not in PLAN_FACES}),
        ("Plan", (0, 1), {m: p for m, p in middles.items() if faces[m] in PLAN_FACES}),
    )
    left, bottom, right, top = area

    def drawn(scale: int, gap: float) -> tuple[Overview, float]:
        views, leaders, texts, y = [], [], [], top
        for name, plane, marks in parts:
            view, new_leaders, new_texts, y = _view(
                name,
                scale,
                {key: line[:, plane] for key, line in lines.items()},
                {mark: point[list(plane)] for mark, point in marks.items()},
                faces,
                left,
                right,
                y - gap,
            )
            views.append(view)
            leaders += new_leaders
            texts += new_texts
        return Overview(scale, tuple(views), tuple(leaders), tuple(texts)), y - bottom

    length = np.ptp(np.concatenate(list(lines.values()))[:, 0])
    for scale in SCALES:
        if length / scale > right - left - 10.0:
            continue
        result, spare = drawn(scale, 0.0)
        if spare >= 0.0:
            return drawn(scale, min(spare / 3.0, 20.0))[0]
    return result


def _view(name, scale, lines, marks, faces, left, right, top):
    """One view hanging from height `top`; gives view, leaders, texts and the height used up."""
    points = np.concatenate(list(lines.values()))
    low, high = points.min(axis=0), points.max(axis=0)
    x0 = (left + right) / 2.0 - (low[0] + high[0]) / 2.0 / scale
    first = [m for m in marks if faces[m] in ("top", "left")]
    upper = _rows(first, marks, scale, x0, left, right)
    lower = _rows([m for m in marks if m not in first], marks, scale, x0, left, right)
    count = [1 + max((row for _, row in rows.values()), default=-1) for rows in (upper, lower)]
    head = Text(left, top - HEADING + 2.5, 3.5, f"{name}  1:{scale}")
    edge = top - HEADING - count[0] * ROW - (2.0 if count[0] else 0.0)
    y0 = edge - high[1] / scale
    foot = y0 + low[1] / scale
    polylines = tuple(
        Polyline(as_points(simplified(line, DRAWN_TOLERANCE * scale)), _style(key))
        for key, line in lines.items()
    )
    texts, leaders = [head], []
    for rows, side in ((upper, 1.0), (lower, -1.0)):
        for mark, (x, row) in rows.items():
            start = edge + 2.0 + row * ROW if side > 0 else foot - 2.0 - row * ROW - MARK_HEIGHT
            texts.append(Text(x, start, MARK_HEIGHT, mark, anchor="middle"))
            end = np.array([x0, y0]) + marks[mark] / scale
            near = start - 0.9 if side > 0 else start + MARK_HEIGHT + 0.5
            leaders.append(Polyline(((x, near), (float(end[0]), float(end[1])))))
            leaders.append(_dot(end))
    bottom = foot - count[1] * ROW - (2.0 if count[1] else 0.0) - 3.0
    view = View(name, float(scale), (float(x0), float(y0)), polylines)
    return view, leaders, texts, bottom


def _rows(names, marks, scale, x0, left, right) -> dict[str, tuple[float, int]]:
    """Where each mark stands: x of its middle and its row; row 0 is nearest to the view.

    Outer rows take what does not fit; leaders of outer rows must not run through inner marks, so
    a mark keeps its distance from the leaders that pass it.
    """
    ends: list[float] = []
    placed: dict[str, tuple[float, int]] = {}
    for mark in sorted(names, key=lambda m: marks[m][0]):
        half = text_width(mark, MARK_HEIGHT) / 2.0 + 0.8
        x = float(min(max(x0 + marks[mark][0] / scale, left + half), right - half))
        row = next((k for k, end in enumerate(ends) if x - half >= end), len(ends))
        if row == len(ends):
            ends.append(0.0)
        ends[row] = x + half
        placed[mark] = (x, row)
    return placed


def _line_ends(plate: DevelopedPlate, label: str) -> np.ndarray:
    """The arris points (n, 3) of one line of a plate."""
    return np.array(
        [point.xyz for point in plate.points if point.line == label and point.kind == "arris"]
    )


def _style(name: str) -> str:
    if name == "axis":
        return "chain"
    return "narrow" if name.endswith((" E-1", " E-2")) else "medium"


def _dot(center, radius: float = 0.35) -> Polyline:
    angles = np.linspace(0.0, 2.0 * np.pi, 9)
    ring = np.column_stack([np.cos(angles), np.sin(angles)]) * radius + center
    return Polyline(as_points(ring), "medium")
