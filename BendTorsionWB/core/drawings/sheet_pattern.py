# SPDX-License-Identifier: LGPL-2.1-or-later
"""One flat pattern as a drawing block: outline to scale with labels that never overlap.

A block is laid out around the pattern's own origin (the lower left corner of its bounding box at
(0, 0) page mm) and then moved to its place on a page.
"""

from __future__ import annotations

import numpy as np

from ..lofting import DevelopedPlate, StationLine
from ..patterns.forming import fold_direction
from ..patterns.forming_record import FormingRecord
from ..welds.bevel_record import EdgeBevel
from .sheet import Polyline, Text, View, text_box, text_width, wrapped
from .sheet_inner import hole_middle, label_inner
from .sheet_labels import (
    LABEL_HEIGHT,
    Labels,
    as_points,
    label_along,
    label_beyond,
    segments_of,
)
from .sheet_pack import Block
from .sheet_references import reference
from .sheet_style import PLAIN_STYLE, SheetStyle, fixed

FORMING_RULES = {
    "flat_within": "out of flat",
    "cold_radius_mild": "radius",
    "cold_radius_low_alloy": "radius",
    "membrane_yield": "membrane stress",
    "elastic_stress": "bending stress",
    "fold_without_press": "fold angle",
}
"""What the rules that decide how a plate is formed look at."""
BARE = "points, stations and roll lines are named in the details on sheet {}"
CAPTION_HEIGHT = 2.5
MARK_HEIGHT = 3.5
CAPTION_ROOM = 120.0
"""mm; width of the caption at least."""
CAPTION_ROW = 3.2
SAME_PLACE = 1.0
"""mm along the axis; stretches of bevels that share less with two stations are not theirs."""
DRAWN_TOLERANCE = 0.01  # mm on paper between a curve and its drawn polyline


def simplified(points: np.ndarray, tolerance: float) -> np.ndarray:
    """The points (n, 2) that keep a polyline within `tolerance` (Douglas and Peucker)."""
    keep = np.zeros(len(points), dtype=bool)
    keep[[0, -1]] = True
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        chord = points[last] - points[first]
        offsets = points[first + 1 : last] - points[first]
        length = np.hypot(*chord)
        if length > 0.0:
            distance = np.abs(chord[0] * offsets[:, 1] - chord[1] * offsets[:, 0]) / length
        else:
            distance = np.hypot(offsets[:, 0], offsets[:, 1])
        worst = int(np.argmax(distance))
        if distance[worst] > tolerance:
            middle = first + 1 + worst
            keep[middle] = True
            spans += [(first, middle), (middle, last)]
    return points[keep]


def _is_curved(line: StationLine) -> bool:
    """True of an end line along a curved cut, which the outline shows."""
    along = line.flat[1] - line.flat[0]
    return line.length_flat - float(np.sqrt((along * along).sum())) > DRAWN_TOLERANCE


def pattern_block(
    plate: DevelopedPlate,
    scale: float,
    style: SheetStyle = PLAIN_STYLE,
    part: str = "",
    bare: bool = False,
) -> Block:
    """The plate's pattern at 1:scale with caption, labels, folds, bevels and overall dimensions.

    part: what a detail of it shows, in place of the caption; it has no origin and no dimensions.
    bare: points, stations and roll lines are named in details only.
    """
    say = style.say
    corner = np.concatenate(plate.outline).min(axis=0)
    outline = [simplified(run - corner, DRAWN_TOLERANCE * scale) for run in plate.outline]
    stations = [np.asarray(line.flat, float) - corner for line in plate.lines]
    folds = [np.asarray(fold.flat, float) - corner for fold in plate.folds]
    # Plates that drop in or are clamped are not rolled.
    rolled_up = plate.forming_data is not None and plate.forming in ("cold", "hot")
    rolls = plate.forming_data.roll_lines if rolled_up else ()
    rolled = [roll.flat - corner for roll in rolls]
    inner = [
        simplified(run - corner, DRAWN_TOLERANCE * scale) for h in plate.holes for run in h.runs
    ]
    marked = [
        simplified(mark.flat - corner, DRAWN_TOLERANCE * scale)
        for mark in plate.marks
        if mark.kind == "line"
    ]
    named = {fold.label for fold in plate.folds}  # folds are among the measuring lines as well
    polylines = (
        *(Polyline(as_points(run), "wide") for run in outline),
        *(
            Polyline(as_points(ends), "narrow")
            for line, ends in zip(plate.lines, stations, strict=True)
            if line.label not in named and not _is_curved(line)
        ),
        *(Polyline(as_points(fold), "dashed") for fold in folds),
        *(Polyline(as_points(ends), "chain") for ends in rolled),
        *(Polyline(as_points(run), "medium") for run in inner),
        *(Polyline(as_points(line), "narrow") for line in marked),
    )
    curves = [*outline, *inner, *marked]
    edges = segments_of(curves)
    rulings = np.array(stations + folds + rolled).reshape(-1, 2, 2)
    crosses = [] if part else _cross(np.zeros(2), 1.6)
    for point in plate.points:
        if point.kind == "witness":
            crosses += _cross((np.asarray(point.flat, float) - corner) / scale, 0.5)
    for mark in plate.marks:
        if mark.kind == "punch":
            crosses += _cross((mark.flat[0] - corner) / scale, 0.5)
    for hole in plate.holes:
        crosses += _cross((hole_middle(hole) - corner) / scale, 0.8)
    ticks = np.array([line.points for line in crosses]).reshape(-1, 2, 2)
    labels = Labels(np.concatenate([edges / scale, rulings / scale, ticks]))
    size = np.concatenate(plate.outline).max(axis=0) - corner
    left_out = 0
    middle = size / 2.0 / scale
    # Folds first: a figure without which the plate cannot be made.
    for fold, ends in zip(plate.folds, folds, strict=True):
        way = say(fold_direction(fold.angle, plate.marking_face))
        text = f"{fold.label} {abs(np.degrees(fold.angle)):.1f}° {way}"
        left_out += not (
            label_along(labels, text, ends / scale, None)
            or label_beyond(labels, text, ends[0] / scale, ends[1] / scale)
            or label_beyond(labels, text, ends[1] / scale, ends[0] / scale)
        )
    left_out += 0 if bare else _label_points(plate, labels, corner, scale)
    left_out += label_inner(plate, labels, corner, scale, style)
    left_out += _label_bevels(plate, labels, stations, scale, middle, style)
    # End lines first, with how they are cut.
    order = sorted(range(len(stations)), key=lambda k: not plate.lines[k].label.startswith("E-"))
    for line, ends in ((plate.lines[k], stations[k]) for k in order):
        if line.label in named or (bare and not line.label.startswith("E-")):
            continue
        outer = middle if line.label.startswith("E-") else None
        text = _line_text(plate, line.label, style)
        left_out += not (
            label_along(labels, text, ends / scale, outer)
            or (outer is not None and label_beyond(labels, text, ends.mean(axis=0) / scale, outer))
            or label_beyond(labels, text, ends[0] / scale, ends[1] / scale)
            or label_beyond(labels, text, ends[1] / scale, ends[0] / scale)
        )
    # Radii stand where there is room; all are in the forming tables.
    for roll, ends in () if bare else zip(rolls, rolled, strict=True):
        left_out += not (
            label_along(labels, roll.text(), ends / scale, None)
            or label_along(labels, roll.label, ends / scale, None)
            or label_beyond(labels, roll.label, ends[0] / scale, ends[1] / scale)
            or label_beyond(labels, roll.label, ends[1] / scale, ends[0] / scale)
        )
    lines = [*labels.leaders, *crosses]
    # Roll lines of a detail may begin or end beside it.
    reach = np.concatenate([rulings.reshape(-1, 2), np.zeros((1, 2)), size[None]]) / scale
    bounds = np.array([*labels.bounds, (*reach.min(axis=0), *reach.max(axis=0))])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    sizes, figures = dimensions(size, scale, low[1] - 5.5, high[0] + 5.5, style)
    left, room = min(low[0], 0.0), max(size[0] / scale, CAPTION_ROOM)
    if part:
        sizes, figures = [], []
        caption = _detail_caption(plate, part, scale, left_out, left, high[1] + 3.0, style)
    else:
        words = say(BARE, reference(plate.mark)) if bare else ""
        words = words or _left_out(plate.mark, left_out, style)
        caption = _caption(plate, words, left, high[1] + 3.0, room, style)
    texts = (*labels.texts, *figures, *caption)
    boxes = np.array([[*text_box(text).min(axis=0), *text_box(text).max(axis=0)] for text in texts])
    box = (
        float(min(boxes[:, 0].min(), 0.0)),
        float(min(boxes[:, 1].min(), low[1] - 7.0)),
        float(max(boxes[:, 2].max(), high[0] + 7.0)),
        float(boxes[:, 3].max()),
    )
    name = f"{plate.mark} {part}" if part else plate.mark
    view = View(name, float(scale), (0.0, 0.0), polylines)
    return Block(plate.mark, (view,), (*lines, *sizes), texts, box, left_out=left_out)


def _line_text(plate: DevelopedPlate, label: str, style: SheetStyle) -> str:
    """The label of a line, of an end with its bevels."""
    bevels = dict.fromkeys(bevel_text(b, style) for b in plate.bevels if b.edge == label)
    return f"{label} {', '.join(bevels)}" if bevels else label


def _label_bevels(
    plate: DevelopedPlate, labels: Labels, stations, scale: float, middle, style: SheetStyle
) -> int:
    """How each stretch of the long edges is cut, beside it; the number that found no room."""
    if len(stations) < 2:
        return 0
    left_out = 0
    s = np.array([line.s for line in plate.lines])
    along = np.array(stations) / scale
    for bevel in plate.bevels:
        if bevel.side not in ("first", "second"):
            continue
        text, edge = bevel_text(bevel, style), along[:, 0 if bevel.side == "first" else 1]
        # Pairs of stations in the stretch, those about its middle first.
        centre = 0.5 * (bevel.start + bevel.end)
        inside = [
            k
            for k in range(len(s) - 1)
            if s[k] < bevel.end - SAME_PLACE and s[k + 1] > bevel.start + SAME_PLACE
        ]
        inside.sort(key=lambda k: abs(0.5 * (s[k] + s[k + 1]) - centre))
        places = [edge[k : k + 2] for k in inside]
        left_out += not (
            any(label_along(labels, text, place, middle) for place in places)
            or any(label_beyond(labels, text, place.mean(axis=0), middle) for place in places)
        )
    return left_out


def bevel_text(bevel: EdgeBevel, style: SheetStyle) -> str:
    """The grooves of an edge by their angle against square, or its tilt where none is cut, and its
    chamfer."""
    chamfer = [chamfer_text(bevel, side, style) for side in ("outer", "inner")]
    chamfer = [
        f"{text} {style.say(side)}"
        for text, side in zip(chamfer, ("outside", "inside"), strict=True)
        if text
    ]
    angles = [
        f"{fixed(np.degrees(angle), 1).removesuffix('.0')}° {style.say(side)}"
        for (angle, depth), side in ((bevel.outer, "outside"), (bevel.inner, "inside"))
        if depth
    ]
    if not angles and (bevel.natural or not chamfer):
        angles = [f"{fixed(np.degrees(bevel.natural), 1)}°"]
    bevels = [f"{style.say('bevel')} {' / '.join(angles)}"] if angles else []
    return ", ".join(bevels + chamfer)


def opening_text(angle: float, face: str, style: SheetStyle) -> str:
    """What a side cut square leaves open to a wall askew, rad, and on which face,
    `up` or `down`."""
    where = "open {}° marked face" if face == "up" else "open {}° other face"
    return style.say(where, fixed(np.degrees(angle), 1).removesuffix(".0"))


def chamfer_text(bevel: EdgeBevel, side: str, style: SheetStyle) -> str:
    """The chamfer of an edge on its `outer` or `inner` face: slope and depth; empty without."""
    chamfer = bevel.chamfer
    if chamfer is None or chamfer.faces not in (side, "both"):
        return ""
    slope = fixed(chamfer.slope, 1).removesuffix(".0")
    return f"{style.say('chamfer')} 1:{slope} × {style.fine(chamfer.depth)}"


def _label_points(plate: DevelopedPlate, labels: Labels, corner, scale: float) -> int:
    """P labels beyond the ends of their lines, on leaders where crowded; the number that found no
    room."""
    left_out = 0
    lines = {line.label: np.asarray(line.flat, float) - corner for line in plate.lines}
    middle = 0.5 * (np.concatenate(plate.outline).max(axis=0) - corner)
    for point in plate.points:
        if point.kind != "arris":
            continue
        if point.line not in lines:
            # A corner of a flat part.
            end = np.asarray(point.flat, float) - corner
            left_out += not label_beyond(labels, point.label, end / scale, middle / scale)
            continue
        ends = lines[point.line]
        flat = np.asarray(point.flat, float) - corner
        near = int(np.argmin(np.hypot(*(ends - flat).T)))
        left_out += not label_beyond(
            labels, point.label, ends[near] / scale, ends[1 - near] / scale
        )
    return left_out


def _cross(center: np.ndarray, arm: float) -> list[Polyline]:
    """The origin u = v = 0, or a witness mark, as an upright cross."""
    return [
        Polyline(as_points(np.array([center - step, center + step])), "narrow")
        for step in np.diag((arm, arm))
    ]


def dimensions(
    size, scale: float, y: float, x: float, style: SheetStyle
) -> tuple[list[Polyline], list[Text]]:
    """Overall length below the pattern at height y, overall width right of it at x."""
    length, width = float(size[0]) / scale, float(size[1]) / scale
    lines = [
        Polyline(((-1.5, y), (length + 1.5, y))),
        Polyline(((x, -1.5), (x, width + 1.5))),
        *(Polyline(((end, y - 1.5), (end, y + 3.0))) for end in (0.0, length)),
        *(Polyline(((x - 3.0, end), (x + 1.5, end))) for end in (0.0, width)),
        *(Polyline(((end - 1.0, y - 1.0), (end + 1.0, y + 1.0)), "medium") for end in (0, length)),
        *(Polyline(((x - 1.0, end - 1.0), (x + 1.0, end + 1.0)), "medium") for end in (0, width)),
    ]
    figures = [style.length(size[0]), style.length(size[1])]
    across, up = (text_width(figure, CAPTION_HEIGHT) + 2.0 for figure in figures)
    low = y - 0.5 * CAPTION_HEIGHT
    texts = [
        Text(length / 2.0, y + 0.9, CAPTION_HEIGHT, figures[0], anchor="middle")
        if across <= length
        else Text(length + 2.5, low, CAPTION_HEIGHT, figures[0]),
        Text(x - 0.9, width / 2.0, CAPTION_HEIGHT, figures[1], 90.0, "middle")
        if up <= width
        else Text(x + 2.5, width / 2.0 - 0.5 * CAPTION_HEIGHT, CAPTION_HEIGHT, figures[1]),
    ]
    return lines, texts


def _caption(
    plate: DevelopedPlate, words: str, x: float, y: float, room: float, style: SheetStyle
) -> list[Text]:
    """Mark and plate above the pattern in large, what else the shop asks of it below them."""
    say, gross = style.say, plate.gross
    cut = plate if gross is None else gross
    parts = [
        say("net {}, {} kg", style.size(plate.length, plate.width), fixed(plate.mass, 1)),
        say("gross {}, {} kg", style.size(cut.length, cut.width), fixed(cut.mass, 1)),
        say("quantity {}", plate.quantity),
        say("part {}", plate.part) if plate.part != plate.mark else "",
        say("opposite hand of {}", plate.opposite_hand) if plate.opposite_hand else "",
        say("face {}", say(plate.face)),
        say("marking face: {}, up", say(plate.marking_face)),
        say("rolling direction along u"),
        words,
    ]
    lines = wrapped("; ".join(part for part in parts if part), LABEL_HEIGHT, room)
    if plate.forming_data is not None:
        lines += wrapped(forming_note(plate.forming_data, style), LABEL_HEIGHT, room)
    texts = [
        Text(x, y + CAPTION_ROW * (len(lines) - 1 - k), LABEL_HEIGHT, line)
        for k, line in enumerate(lines)
    ]
    top = y + CAPTION_ROW * len(lines) + 0.6
    start = x + text_width(plate.mark, MARK_HEIGHT) + 5.0
    stock = f"PL {style.plate(plate.thickness)}"
    return [
        Text(x, top, MARK_HEIGHT, plate.mark),
        Text(start, top, CAPTION_HEIGHT, f"{stock}  {plate.material}".rstrip()),
        *texts,
    ]


def _detail_caption(
    plate: DevelopedPlate, part: str, scale: float, left_out: int, x: float, y: float, style
) -> list[Text]:
    start = x + text_width(plate.mark, MARK_HEIGHT) + 5.0
    texts = [
        Text(x, y + 1.0, MARK_HEIGHT, plate.mark),
        Text(start, y + 1.0, CAPTION_HEIGHT, f"{part}  1:{scale:g}"),
    ]
    words = _left_out(plate.mark, left_out, style)
    beyond = start + text_width(texts[1].text, CAPTION_HEIGHT) + 5.0
    return [*texts, Text(beyond, y + 1.0, LABEL_HEIGHT, words)] if words else texts


def _left_out(mark: str, count: int, style: SheetStyle) -> str:
    """How many labels found no room, and where what they tell is found."""
    words = "labels left out: {}, see sheet {}"
    return style.say(words, count, reference(mark)) if count else ""


def forming_note(data: FormingRecord, style: SheetStyle) -> str:
    """How a plate is formed, one line; as FormingRecord.note says it."""
    say, kind, down = style.say, data.forming_class, data.pull_down
    sign = "≤" if kind.name == "flat" else "<" if kind.rule.startswith("cold_") else ">"
    why = f"({say(FORMING_RULES.get(kind.rule, kind.rule))} "
    why += f"{kind.value:.1f} {sign} {kind.limit:.1f} {kind.unit})"
    parts = [say("forming: {}", say(kind.name)) + f" {why}"]
    if kind.name in ("cold", "hot"):
        pressed = kind.rule == "fold_without_press"
        parts.append(say("press at the folds") if pressed else say("pre-form"))
    elif kind.name != "flat" and not down.drops_in:
        if down.clamp_middle:
            parts.append(say("clamp with {} kN at mid-length", fixed(down.clamp_middle, 1)))
        if down.clamp_corner:
            parts.append(say("clamp with {} kN at each free corner", fixed(down.clamp_corner, 1)))
    else:
        parts.append(say("may stay flat") if kind.name == "flat" else say("drops in"))
    if not data.may_stay_flat:
        if np.isfinite(data.bending_radius_min):
            parts.append(say("R min {} m", fixed(1e-3 * data.bending_radius_min, 1)))
        parts.append(say("twist {}°/m", fixed(np.degrees(1e3 * data.twist_max), 2)))
        parts.append(say("locked-in stress {} MPa", fixed(data.locked_in_stress, 0)))
    return "; ".join(parts)
