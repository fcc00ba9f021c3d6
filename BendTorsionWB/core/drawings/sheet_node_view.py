# SPDX-License-Identifier: LGPL-2.1-or-later
"""The views of a node: plates about it, cut off at planes across their members, with their marks.

Three views: along the surface normal from outside, along the member that runs through, and along
the first branch.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..geometry import arc_contour
from ..lofting import DevelopedPlate, MemberRecord
from ..nodes.node_ends import axis_at, corner_lines, middle_at, ring
from .sheet import Polyline, Text, View, text_box
from .sheet_labels import (
    LABEL_HEIGHT,
    Labels,
    as_points,
    label_along,
    label_beyond,
    segments_of,
)
from .sheet_node_joining import Joining, node_frame
from .sheet_node_weld import Pointed, point_at, pointed
from .sheet_pack import GAP, Block
from .sheet_style import SheetStyle

HEADING = 3.0
LABEL_ROOM = 15.0
"""mm about a view that its labels are given when its scale is chosen."""
FACING = 0.5
"""Cosine of a plate's normal to the line of sight beyond which it is not seen edge-on."""
SYMBOL_SIZE = (30.0, 20.0)
"""mm that symbols add to the width of the first view, on either side, and to the height of the
others."""
HEAD_ROOM = 20.0
"""mm of a view's height for its title and labels."""
GRID = 9
"""Places tried for a mark on a plate, each way."""


@dataclass(frozen=True, eq=False)
class _Drawn:
    """What is drawn of a plate. runs: of its outline (n, 3); breaks: where it is cut off; normal:
    outwards. branch: False for the member that runs through; way: of a branch's side."""

    plate: DevelopedPlate
    runs: tuple[np.ndarray, ...]
    breaks: tuple[np.ndarray, ...]
    normal: np.ndarray
    branch: bool
    way: int

    @property
    def middle(self) -> np.ndarray:
        return np.concatenate(self.runs).mean(axis=0)


@dataclass(frozen=True, eq=False)
class _Sight:
    """A view: its title, right, up and towards the viewer (3, 3)."""

    title: str
    axes: np.ndarray


@dataclass(frozen=True, eq=False)
class NodeViews:
    """What the three views of a node show, before they have a scale. sizes: of each, mm."""

    through: MemberRecord
    joinings: tuple[Joining, ...]
    style: SheetStyle
    place: np.ndarray
    drawn: tuple[_Drawn, ...]
    axes: dict[str, np.ndarray]
    sights: tuple[_Sight, ...]
    welds: tuple[Pointed, ...]
    sizes: tuple[np.ndarray, ...]

    def room(self, scale: int) -> list[tuple[float, float]]:
        """About the width and height of each view with its labels and symbols, mm on paper."""
        count = [sum(one.view == number for one in self.welds) for number in range(3)]
        return [
            (
                size[0] / scale + 2 * LABEL_ROOM + (SYMBOL_SIZE[0] * min(own, 2) if high else 0.0),
                size[1] / scale + HEAD_ROOM + (0.0 if high else SYMBOL_SIZE[1] * min(own, 1)),
            )
            for size, own, high in zip(self.sizes, count, (True, False, False), strict=True)
        ]

    def blocks(self, scale: int) -> tuple[list[Block], list[str]]:
        """The views, and the marks that found no room in any of them."""
        named: set[str] = set()
        views = [_view(number, self, scale, named) for number in range(len(self.sights))]
        return views, [one.plate.mark for one in self.drawn if one.plate.mark not in named]


def node_views(through: MemberRecord, joinings: Sequence[Joining], style: SheetStyle) -> NodeViews:
    """The views along the surface normal, the member that runs through and the first branch."""
    node = joinings[0].node
    place = np.array([node.x, node.y, node.z])
    frame = node_frame(through, place)
    drawn, axes = _region(through, joinings, place)
    _, along = axis_at(joinings[0].record, place)
    along = along - frame[2] * (along * frame[2]).sum()
    along = along / np.linalg.norm(along)
    x, y, z = frame
    sights = [
        _Sight(style.say("Along the surface normal, from outside"), np.array([x, y, z])),
        _Sight(style.say("Along {}, +s away", through.member), np.array([-y, z, -x])),
        _Sight(
            style.say("Along {}, +s away", joinings[0].record.member),
            np.array([np.cross(along, z), z, -along]),
        ),
    ]
    points = np.concatenate([run for one in drawn for run in one.runs]) - place
    sizes = tuple(np.ptp(points @ sight.axes[:2].T, axis=0) for sight in sights)
    welds = tuple(pointed(through, joinings, frame))
    return NodeViews(
        through, tuple(joinings), style, place, tuple(drawn), axes, tuple(sights), welds, sizes
    )


def _half(record: MemberRecord, point: np.ndarray) -> float:
    """Half the diagonal of the section at a point, mm."""
    k = 2 * int(np.argmin(((record.wireframe["axis"] - point) ** 2).sum(axis=1)))
    corners = np.array([line[k] for line in corner_lines(record).values()])
    if not len(corners):
        return 100.0
    return float(np.linalg.norm(corners - corners.mean(axis=0), axis=1).max())


def _region(
    through: MemberRecord, joinings: Sequence[Joining], place: np.ndarray
) -> tuple[list[_Drawn], dict[str, np.ndarray]]:
    """Plates near the node, and the axes there by name of the member, clipped."""
    drawn, axes = [], {}
    own = _half(through, place)
    length = 0.0
    for joining in joinings:
        node, record = joining.node, joining.record
        foot, along = axis_at(record, place)
        size = _half(record, foot)
        sine = math.sin(node.angle)
        length = max(length, size / sine + 0.8 * own + float(np.linalg.norm(foot - place)))
        away = own / sine + 1.2 * size
        if node.type == "stub":
            away = max(away, node.stub_length + 0.5 * size)
        ways = {end.way for end in joining.ends}
        plates = [
            plate
            for plate in record.plates
            if plate.lines
            and plate.s_start < node.s_other + away + own
            and plate.s_end > node.s_other - away - own
        ]
        for plate in plates:
            way = -1 if 0.5 * (plate.s_start + plate.s_end) < node.s_other else 1
            if way in ways:
                drawn += _cut_off(plate, foot, along, away, record, True, way)
        low = -away if -1 in ways else 0.0
        high = away if 1 in ways else 0.0
        axes[record.member] = np.array([foot + low * along, foot + high * along])
    foot, along = axis_at(through, place)
    for plate in through.plates:
        if plate.lines or plate.face == "diaphragm":
            drawn += _cut_off(plate, foot, along, length, through, False, 0)
    axes[through.member] = np.array([foot - length * along, foot + length * along])
    return drawn, axes


def _cut_off(
    plate: DevelopedPlate, foot, along, length, record, branch: bool, way: int
) -> list[_Drawn]:
    """The plate between two planes across its member; nothing when it has no part there."""
    runs, breaks = clipped(ring(plate), foot, along, length)
    # A flat part lies whole on the page or not at all: a sliver of one tells nothing.
    if not runs or (breaks and not plate.lines):
        return []
    points = np.concatenate(runs)
    middle = points.mean(axis=0)
    spread = points - middle
    normal = np.linalg.svd(spread, full_matrices=False)[2][2]
    if ((middle - middle_at(record, middle)) * normal).sum() < 0.0:
        normal = -normal
    return [_Drawn(plate, tuple(runs), tuple(breaks), normal, branch, way)]


def clipped(
    line: np.ndarray, foot: np.ndarray, along: np.ndarray, length: float
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """What of a closed line (n, 3) lies within `length` of the plane through a foot across a
    direction, in runs; and a line (2, 3) between the ends on each plane it is cut at."""
    s = (line - foot) @ along
    points, places = [line[0]], [s[0]]
    for a, b, p, q in zip(s[:-1], s[1:], line[:-1], line[1:], strict=True):
        shares = [(edge - a) / (b - a) for edge in (-length, length) if (a - edge) * (b - edge) < 0]
        for share in sorted(shares):
            points.append(p + share * (q - p))
            places.append(a + share * (b - a))
        points.append(q)
        places.append(b)
    inside = np.abs(np.array(places)) <= length + 1e-6
    runs, run = [], []
    for k, point in enumerate(points):
        # Two points on one plane with the line beyond it between them are no part of the line.
        middle = 0.5 * (places[k] + places[k - 1]) if k else 0.0
        if inside[k] and (not run or abs(middle) < length - 1e-6 or abs(places[k]) < length - 1e-6):
            run.append(point)
            continue
        if len(run) > 1:
            runs.append(np.array(run))
        run = [point] if inside[k] else []
    if len(run) > 1:
        runs.append(np.array(run))
    breaks = []
    for edge in (-length, length):
        ends = [p for p, at in zip(points, places, strict=True) if abs(at - edge) < 1e-6]
        if len(ends) == 2:
            breaks.append(np.array(ends))
    return runs, breaks


def _view(number: int, views: NodeViews, scale: int, named: set[str]) -> Block:
    """The view as a block, with the labels that find room; the marks shown go to `named`."""
    sight, place, drawn, style = views.sights[number], views.place, views.drawn, views.style
    axes, joinings = views.axes, views.joinings
    plane = sight.axes[:2].T
    lines = []
    for one in drawn:
        if one.plate.lines and float((one.normal * sight.axes[2]).sum()) < -FACING:
            continue  # Its edges are those of the plates beside it.
        style_of = "medium" if one.plate.lines else "dashed"
        for run in one.runs:
            lines.append(Polyline(as_points((run - place) @ plane), style_of))
        for cut in one.breaks:
            lines.append(Polyline(as_points((cut - place) @ plane), "narrow"))
    ends = [end for joining in joinings for end in joining.ends]
    lines += [Polyline(as_points((end.corners - place) @ plane), "wide") for end in ends]
    chains = {name: (line - place) @ plane for name, line in axes.items()}
    lines += [Polyline(as_points(line), "chain") for line in chains.values()]
    labels = Labels(segments_of(line.points for line in lines) / scale)
    paper = plane / scale
    if number == 0:
        for name, line in chains.items():
            _end_label(labels, name, line / scale)
        for joining in joinings:
            _gap_label(labels, joining, place, paper, style)
            if joining.node.type == "stub":
                _stub_label(labels, joining, place, paper, style)
    for one in sorted(drawn, key=lambda one: _turn(number, one)):
        mark = one.plate.mark
        if mark in named and not _wanted(number, one):
            continue
        middle = (one.middle - place) @ paper
        out = one.normal @ sight.axes[:2].T
        front = float((one.normal * sight.axes[2]).sum())
        outline = (np.concatenate(one.runs) - place) @ paper
        if abs(front) > FACING:
            if number < 2 and mark not in named and front < 0.0 and one.plate.lines:
                continue
            done = _label_on(labels, mark, middle, outline)
        elif one.plate.lines:
            done = label_beyond(labels, mark, middle, middle - out)
        else:
            across = (outline - middle) @ np.array([-out[1], out[0]])
            ends = outline[[int(np.argmin(across)), int(np.argmax(across))]]
            done = label_along(labels, mark, ends, None)
        if done:
            named.add(mark)
    view = View(sight.title, float(scale), (0.0, 0.0), tuple(lines))
    points = [np.array(line.points) for line in view.on_page()]
    everything = np.concatenate(points)
    bounds = np.array([everything.min(axis=0), everything.max(axis=0)])
    symbols: list[Polyline] = []
    for one in views.welds:
        if one.view == number:
            tip = (one.place - place) @ paper
            symbols += point_at(labels, one, tip, bounds, style)
    points += [np.array(line.points) for line in symbols]
    points += [text_box(text) for text in labels.texts]
    points = np.concatenate(points)
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    title = Text(low[0], high[1] + 3.0, HEADING, f"{sight.title}  1:{scale}")
    right = max(high[0], float(text_box(title)[:, 0].max()))
    box = (low[0] - 1.0, low[1] - 1.0, right + 1.0, high[1] + 3.0 + HEADING + 1.0)
    return Block("", (view,), (*labels.leaders, *symbols), (*labels.texts, title), box)


def _turn(number: int, one: _Drawn) -> tuple:
    """Marks wanted in a view come first, in the order of names."""
    return not _wanted(number, one), not one.branch, one.plate.mark


def _wanted(number: int, one: _Drawn) -> bool:
    """Marks a view shows whether another shows them or not: along the member that runs through,
    that member's; along the branch, those of its near side."""
    if number == 1:
        return not one.branch and bool(one.plate.lines)
    return number == 2 and one.branch and one.way < 0


def _end_label(labels: Labels, name: str, line: np.ndarray) -> None:
    """The member's name where its axis leaves the view, with +s at the far end."""
    if np.hypot(*(line[1] - line[0])) < 5.0:
        return
    if not label_beyond(labels, f"{name} +s", line[1], line[0]):
        label_beyond(labels, name, line[0], line[1])


def _gap_label(labels: Labels, joining: Joining, place, paper, style: SheetStyle) -> None:
    """The root gap, at a corner of a cut."""
    text = style.say("root gap {}", style.fine(joining.node.gap))
    for end in joining.ends:
        for corner in (end.corners - place) @ paper:
            if label_beyond(labels, text, corner, 0.5 * corner):
                return


def _stub_label(labels: Labels, joining: Joining, place, paper, style: SheetStyle) -> None:
    """The field joint of a stub, at a corner of one."""
    text = style.say("field joint, stub {}", style.length(joining.node.stub_length, 0))
    for end in joining.ends:
        lines = ring(end.plate)
        count = len(end.plate.lines)
        far = (lines[count - 1 : count + 1] if end.way > 0 else lines[[0, -2]]) - place
        far = far @ paper
        for corner, other in ((far[0], far[1]), (far[1], far[0])):
            if np.hypot(*(corner - other)) > 3.0 and label_beyond(labels, text, corner, other):
                return


def _label_on(labels: Labels, mark: str, middle: np.ndarray, outline: np.ndarray) -> bool:
    """A mark on a plate seen from the front, as near to its middle as there is room, level or
    along the plate; else above or below it with a leader."""
    contour = np.column_stack([outline, np.zeros(len(outline))])
    low, high = outline.min(axis=0), outline.max(axis=0)
    shares = np.linspace(0.0, 1.0, GRID)
    places = np.stack(np.meshgrid(*(low + shares[:, None] * (high - low)).T), axis=2).reshape(-1, 2)
    places = np.concatenate([middle[None], places[arc_contour.inside(contour, places)]])
    places = places[np.argsort(np.hypot(*(places - middle).T), kind="stable")]
    along = np.linalg.svd(outline - outline.mean(axis=0), full_matrices=False)[2][0]
    along = -along if along[0] < 0.0 else along
    for x_way, y_way in ((1.0, 0.0), along.tolist()):
        angle = math.degrees(math.atan2(y_way, x_way))
        feet = places - 0.5 * LABEL_HEIGHT * np.array([-y_way, x_way])
        for x, y in feet.tolist():
            if labels.put(Text(x, y, LABEL_HEIGHT, mark, angle, "middle")):
                return True
    ends = (np.array([middle[0], high[1]]), np.array([middle[0], low[1]]))
    return any(label_beyond(labels, mark, end, middle) for end in ends)


def spread_out(blocks: Sequence[Block], width: float) -> list[Block]:
    """The blocks of a row made equally high, and wider by the room they leave of a width; as they
    are when they are too wide for one row."""
    high = max(block.size[1] for block in blocks)
    spare = width - sum(block.size[0] for block in blocks) - GAP * (len(blocks) - 1) - 0.1
    if spare < 0.0:
        return list(blocks)
    each = spare / (2 * len(blocks))
    return [
        replace(block, box=(left - each, top - high, right + each, top))
        for block in blocks
        for left, _, right, top in (block.box,)
    ]
