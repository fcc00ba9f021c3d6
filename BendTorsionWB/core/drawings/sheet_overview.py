# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elevation and plan of a member or piece along its chord: plates, joints, orientation, centre."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord
from .sheet import Polyline, Text, View, boxes_overlap, text_box, text_width
from .sheet_labels import as_points
from .sheet_pattern import simplified
from .sheet_style import PLAIN_STYLE, SheetStyle
from .sheet_symbols import arrow, centre_mark

SCALES = (
    *(5, 10, 15, 20, 25, 30, 40, 50, 75, 100, 150, 200, 250, 300, 400, 500, 750),
    *(1000, 1500, 2000, 2500, 5000, 10000),
)
DRAWN_TOLERANCE = 0.04  # mm on paper; hidden-line removal takes time with the square of the edges
MARK_HEIGHT = 2.0
ROW = 4.2  # mm between rows of marks
KNEE, LEADER_ROOM = 0.9, 0.8
"""mm from a view to where leaders of outer rows turn to it, and from a leader to a mark."""
HEADING = 7.0
PLAN_FACES = ("top", "bottom")
PLACE_HEIGHT, PLACE_SPACING = 1.8, 2.9
ARROW_ROOM = 26.0
"""mm left of a view, for the orientation at the start."""
END_ROOM = 4.0
"""mm right of a view."""
NEAR = 0.5
"""mm; a text farther from a line needs no closer look."""
DIMENSION_ROOM = 6.0
"""mm above a view with its overall length."""


@dataclass(frozen=True)
class Overview:
    """Two views at one scale with their texts and leaders, page mm."""

    scale: int
    views: tuple[View, ...]
    lines: tuple[Polyline, ...]
    texts: tuple[Text, ...]


@dataclass(frozen=True)
class _Place:
    """A place along a view: its text, and where it lies (2,) in the view's model mm."""

    text: str
    point: np.ndarray


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


def overview(
    record: MemberRecord,
    area: tuple[float, float, float, float],
    style: SheetStyle = PLAIN_STYLE,
    name: str = "",
) -> Overview:
    """The wireframe in elevation (webs marked) and plan (flanges marked) within `area`, places of
    joints and folds below each view, in first or third angle.

    area: (left, bottom, right, top) page mm. name: written at the start end. The largest scale of
    SCALES that fits is taken.
    """
    frame = chord_frame(record)
    origin = np.mean([line.mean(axis=0) for line in record.wireframe.values()], axis=0)
    lines = {name: (line - origin) @ frame.T for name, line in record.wireframe.items()}
    lines |= {
        f"{plate.mark} {label}": (ends - origin) @ frame.T
        for plate in record.plates
        for label in ("E-1", "E-2")
        if len(ends := line_ends(plate, label)) == 2
    }
    middles = {
        plate.mark: (np.mean([p.xyz for p in plate.points], axis=0) - origin) @ frame.T
        for plate in record.plates
        if plate.points
    }
    faces = {plate.mark: plate.face for plate in record.plates}
    centre = record.centre_of_gravity
    centre = None if centre is None else (centre - origin) @ frame.T
    places = _places(record, style)
    views = (
        ("Elevation", (0, 2), [m for m in middles if faces[m] not in PLAN_FACES]),
        ("Plan", (0, 1), [m for m in middles if faces[m] in PLAN_FACES]),
    )
    ends = _ends(record, lines, frame)
    parts = []
    for heading, plane, marks in views if style.first_angle else views[::-1]:
        axes = list(plane)
        parts.append(
            _Part(
                style.say(heading),
                {key: line[:, plane] for key, line in lines.items()},
                {mark: middles[mark][axes] for mark in marks},
                faces,
                [
                    _Place(text, ((point - origin) @ frame.T)[axes])
                    for text, point, face in places
                    if (face in PLAN_FACES) == (heading == "Plan")
                ]
                + ([] if centre is None else [_Place(style.say("CG"), centre[axes])]),
                None if centre is None else centre[axes],
                _start(lines, axes),
                name,
                style,
                ends if heading == "Elevation" else None,
            )
        )
    left, bottom, right, top = area
    length = float(np.ptp(ends))
    for scale in SCALES:
        if length / scale > right - left - ARROW_ROOM - END_ROOM:
            continue
        result, spare = _drawn(parts, scale, 0.0, area)
        if spare >= 0.0:
            return _drawn(parts, scale, min(spare / 3.0, 20.0), area)[0]
    return result


@dataclass(frozen=True)
class _Part:
    """What one view shows, in its plane's model mm. start: where the axis begins, its direction
    and the way up there; ends: of all along the chord, where the overall length is shown."""

    name: str
    lines: dict[str, np.ndarray]
    marks: dict[str, np.ndarray]
    faces: dict[str, str]
    places: list[_Place]
    centre: np.ndarray | None
    start: tuple[np.ndarray, np.ndarray, np.ndarray]
    member: str
    style: SheetStyle
    ends: tuple[float, float] | None = None


def _drawn(parts, scale: int, gap: float, area) -> tuple[Overview, float]:
    left, bottom, right, y = area
    views, leaders, texts = [], [], []
    for part in parts:
        view, new_leaders, new_texts, y = _view(part, scale, left, right, y - gap)
        views.append(view)
        leaders += new_leaders
        texts += new_texts
    return Overview(scale, tuple(views), tuple(leaders), tuple(texts)), y - bottom


def _start(lines: dict[str, np.ndarray], axes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    axis = lines.get("axis")
    if axis is None:
        axis = max(lines.values(), key=lambda line: np.ptp(line, axis=0).max())
    along = (axis[1] - axis[0])[axes]
    up = np.array([0.0, 1.0])
    if "TL" in lines and "BL" in lines and axes[1] == 2:
        rise = (lines["TL"][0] - lines["BL"][0])[axes]
        up = rise / max(np.hypot(*rise), 1e-9) if np.hypot(*rise) > 1.0 else up
    if axes[1] != 2:
        up = np.zeros(2)
    return axis[0][axes], along / max(np.hypot(*along), 1e-9), up


def _places(record: MemberRecord, style: SheetStyle) -> list[tuple[str, np.ndarray, str]]:
    """Text, point (3,) and face of what has a place along the member: ends of plates, folds."""
    found: dict[tuple[bool, int], tuple[list[str], float, np.ndarray, str]] = {}
    for plate in record.plates:
        for label, s in (("E-1", plate.s_start), ("E-2", plate.s_end)):
            ends = line_ends(plate, label)
            if len(ends) != 2:
                continue
            key = (plate.face in PLAN_FACES, int(round(10.0 * s)))
            one = found.setdefault(key, ([], s, ends.mean(axis=0), plate.face))
            if plate.letter not in one[0]:
                one[0].append(plate.letter)
    # Control sections are named with what lies there, or on their own.
    cuts = {int(round(10.0 * one.s)): one for one in record.controls}
    places, named = [], set()
    for (plan, key), (letters, s, point, face) in found.items():
        cut = cuts.get(key)
        named |= {(plan, key)} if cut else set()
        text = f"{cut.label} {','.join(letters)}" if cut else ",".join(letters)
        places.append((f"{text} {style.length(s)}", point, face))
    axis = record.wireframe.get("axis")
    if axis is None:
        return places
    step = np.sqrt((np.diff(axis, axis=0) ** 2).sum(axis=1))
    begin = record.zones[0].start if record.zones else 0.0
    s = begin + np.concatenate([[0.0], np.cumsum(step)])
    others = [(zone.label, zone.start, int(round(10.0 * zone.start))) for zone in record.zones[1:]]
    zones = {key for _, _, key in others}
    others += [("", one.s, key) for key, one in cuts.items() if key not in zones]
    for label, at, key in others:
        point = np.array([np.interp(at, s, axis[:, k]) for k in range(3)])
        for plan, face in ((True, PLAN_FACES[0]), (False, "left")):
            cut = None if (plan, key) in named else cuts.get(key)
            words = " ".join(word for word in (cut.label if cut else "", label) if word)
            if words:
                places.append((f"{words} {style.length(at)}", point, face))
    return places


def _view(part: _Part, scale: int, left: float, right: float, top: float):
    """One view hanging from height `top`; gives view, leaders, texts and the height used up."""
    lines, marks, faces = part.lines, part.marks, part.faces
    # The centre of gravity of a bent member lies beside it.
    centre = [] if part.centre is None else [part.centre[None]]
    points = np.concatenate([*lines.values(), *centre])
    low, high = points.min(axis=0), points.max(axis=0)
    x0 = (left + right) / 2.0 - (low[0] + high[0]) / 2.0 / scale
    x0 = max(x0, left + ARROW_ROOM - low[0] / scale)
    first = [m for m in marks if faces[m] in ("top", "left")]
    upper = _rows(first, marks, scale, x0, left, right)
    lower = _rows([m for m in marks if m not in first], marks, scale, x0, left, right)
    count = [1 + max((row for _, row in rows.values()), default=-1) for rows in (upper, lower)]
    head = Text(left, top - HEADING + 2.5, 3.5, f"{part.name}  1:{scale}")
    edge = top - HEADING - count[0] * ROW - (2.0 if count[0] else 0.0)
    edge -= DIMENSION_ROOM if part.ends else 0.0
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
            # Straight past the marks of inner rows.
            knee = ((x, edge + KNEE if side > 0 else foot - KNEE),) if row else ()
            leaders.append(Polyline(((x, near), *knee, (float(end[0]), float(end[1])))))
            leaders.append(_dot(end))
    bottom = foot - count[1] * ROW - (2.0 if count[1] else 0.0) - 1.0
    page = np.array([x0, y0])
    bottom = _draw_places(part.places, page, scale, (left, right), bottom, texts, leaders)
    _draw_start(part, page, scale, edge, texts, leaders)
    if part.ends:
        line = top - HEADING - DIMENSION_ROOM + 2.0
        leaders += _overall(part, page, scale, line, texts)
    if part.centre is not None:
        leaders += centre_mark(*(page + part.centre / scale).tolist())
    view = View(part.name, float(scale), (float(x0), float(y0)), polylines)
    return view, leaders, texts, bottom - 3.0


def _ends(record: MemberRecord, lines, frame: np.ndarray) -> tuple[float, float]:
    """Where everything begins and ends along the chord; flat parts with their thickness."""
    reach = []
    for name, line in lines.items():
        plate = next((p for p in record.plates if p.mark == name and not p.lines), None)
        half = 0.0
        if plate is not None:
            # Of the ring in the middle of its thickness, half of that along its normal.
            arms = line - line.mean(axis=0)
            normal = np.cross(arms[:-1], arms[1:]).sum(axis=0)
            half = 0.5 * plate.thickness * abs(float(normal[0])) / float(np.sqrt(normal @ normal))
        reach += [float(line[:, 0].min()) - half, float(line[:, 0].max()) + half]
    return min(reach), max(reach)


def _overall(part: _Part, page, scale: int, y: float, texts) -> list[Polyline]:
    """The overall length over the ends at height y, its extension lines broken where texts are in
    the way; adds its figure to the texts."""
    boxes = [text_box(text) for text in texts]
    points = np.concatenate(list(part.lines.values()))
    x = [float(page[0] + end / scale) for end in part.ends]
    lines = [Polyline(((x[0] - 1.5, y), (x[1] + 1.5, y)))]
    for at, end in zip(x, part.ends, strict=True):
        nearest = points[np.argmin(np.abs(points[:, 0] - end))]
        low = float(page[1] + nearest[1] / scale) + 1.0
        strip = np.array([(at - 0.2, low), (at + 0.2, low), (at + 0.2, y), (at - 0.2, y)])
        if any(boxes_overlap(strip, box, 0.2) for box in boxes):
            low = y - 1.5
        lines.append(Polyline(((at, y + 1.5), (at, low))))
        lines.append(Polyline(((at - 1.0, y - 1.0), (at + 1.0, y + 1.0)), "medium"))
    length = part.style.length(part.ends[1] - part.ends[0])
    figure = part.style.say("{} over the ends", length)
    texts.append(Text(0.5 * (x[0] + x[1]), y + 0.9, MARK_HEIGHT, figure, anchor="middle"))
    return lines


def _draw_places(places, page, scale, sides, y: float, texts, leaders) -> float:
    """Upright texts below the view at height y, each with a line up to its place unless a mark is
    in the way; gives the height below them."""
    if not places:
        return y
    ordered = sorted(places, key=lambda place: float(place.point[0]))
    wanted = [float(page[0] + place.point[0] / scale) for place in ordered]
    left, right = sides
    spacing = min(PLACE_SPACING, (right - left) / len(wanted))
    boxes = np.array([text_box(text) for text in texts])
    low, high = boxes.min(axis=1) - NEAR, boxes.max(axis=1) + NEAR
    level = y - 3.0
    for place, x, want in zip(
        ordered, spread(wanted, spacing, left + 2.0, right - 1.0), wanted, strict=True
    ):
        end = float(page[1] + place.point[1] / scale)
        texts.append(
            Text(x + 0.5 * PLACE_HEIGHT, level - 0.8, PLACE_HEIGHT, place.text, 90.0, "end")
        )
        line = np.array([(want - 0.2, y), (want + 0.2, y), (want + 0.2, end), (want - 0.2, end)])
        near = ((low < line.max(axis=0)) & (line.min(axis=0) < high)).all(axis=1)
        clear = not any(boxes_overlap(line, box, 0.2) for box in boxes[near])
        leaders.append(Polyline(((x, level), (want, y), *(((want, end),) if clear else ()))))
    return level - 1.6 - max(text_width(place.text, PLACE_HEIGHT) for place in ordered)


def spread(wanted: list[float], spacing: float, left: float, right: float) -> list[float]:
    """Places in order, as near to those wanted (in order) as a spacing and two sides allow."""
    placed: list[float] = []
    for want in wanted:
        placed.append(max([want, left, *(last + spacing for last in placed[-1:])]))
    limit = right
    for k in range(len(placed) - 1, -1, -1):
        placed[k] = min(placed[k], limit)
        limit = placed[k] - spacing
    return placed


def _draw_start(part: _Part, page, scale, edge: float, texts, leaders) -> None:
    """At the start end: the arrow along +s, which way is up, and the mark of the end."""
    at, along, up = part.start
    here = page + at / scale
    low = page[0] + np.concatenate(list(part.lines.values()))[:, 0].min() / scale
    # Below the view's upper edge, so that the arrow up keeps off the heading.
    tail = np.array([min(here[0], low) - 16.0, min(here[1], edge - 5.0)])
    leaders += arrow(tail, tail + 9.0 * along)
    texts.append(Text(tail[0] - 2.0, tail[1] - 4.6, MARK_HEIGHT, "+s", anchor="middle"))
    if np.hypot(*up) > 0.0:
        leaders += arrow(tail, tail + 6.5 * up)
        x, y = (tail + 6.5 * up).tolist()
        texts.append(Text(x - 1.5, y - 1.0, MARK_HEIGHT, part.style.say("TOP"), anchor="end"))
    if part.member:
        texts.append(
            Text(tail[0] - 9.0, tail[1] - 8.4, MARK_HEIGHT, f"{part.member}-S", anchor="start")
        )


def _rows(names, marks, scale, x0, left, right) -> dict[str, tuple[float, int]]:
    """Where each mark stands: x of its middle and its row; row 0 is nearest to the view.

    Outer rows take what does not fit. Their leaders run straight past the inner rows, beside the
    marks there, so that such a mark stands as far right as that takes, and later ones of inner rows
    keep their distance from its leader.
    """
    ends: list[float] = []
    placed: dict[str, tuple[float, int]] = {}
    for mark in sorted(names, key=lambda m: marks[m][0]):
        half = text_width(mark, MARK_HEIGHT) / 2.0 + 0.8
        x = float(min(max(x0 + marks[mark][0] / scale, left + half), right - half))
        row = next((k for k, end in enumerate(ends) if x - half >= end), len(ends))
        if row == len(ends):
            ends.append(0.0)
        x = min(max([x, *ends[:row]]), right - half)
        ends[:row] = [max(end, x + LEADER_ROOM) for end in ends[:row]]
        ends[row] = x + half
        placed[mark] = (x, row)
    return placed


def line_ends(plate: DevelopedPlate, label: str) -> np.ndarray:
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
