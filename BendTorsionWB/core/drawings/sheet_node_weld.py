# SPDX-License-Identifier: LGPL-2.1-or-later
"""The welds of a node: their list, and on each view symbols with arrows at welds it shows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate, MemberRecord
from ..nodes.node_ends import ring
from ..welds.weld_record import Weld
from .sheet import Polyline, text_box
from .sheet_labels import Labels, segments_of
from .sheet_node_diaphragm import inside
from .sheet_node_joining import Joining
from .sheet_style import SheetStyle
from .sheet_tables import Listing
from .sheet_weld import kind_letters, weld_kind
from .sheet_weld_symbol import weld_arrow, weld_symbol

WELDS = ("weld", "cut / on", "t", "length", "dihedral, °", "symbol", "groove, °", "gap", "place")
ABOVE, ACROSS, ALONG = range(3)
"""The views: along the normal, along the member that runs through, along the branch."""
LEVELS = (5.0, -5.0, 11.0, -11.0, 17.0, -17.0, 24.0, -24.0, 32.0, -32.0, 40.0, -40.0)
ASIDE = (6.0, 14.0, 24.0)
"""mm from a weld up or down, and from the view's side, where its symbol is tried."""
UP, DOWN = 10.0, 14.0
"""mm from a view up and down to the reference line of a symbol over or under it."""
SPILL = 20.0
"""mm that a symbol over a view may reach beyond its sides."""
EDGE_ON = 0.5
"""Cosine of a diaphragm's normal to the line of sight below which its welds are seen."""


@dataclass(frozen=True, eq=False)
class Pointed:
    """A weld whose symbol stands on a view: its kind's letter, and where its arrow points (3,)."""

    view: int
    weld: Weld
    letter: str
    place: np.ndarray


def welds_of_node(through: MemberRecord, joinings: Sequence[Joining]) -> list[Weld]:
    """The welds of plates that end at the node, the field joints of its stubs, and those of the
    diaphragms inside."""
    found = []
    for own in joinings:
        marks = {end.plate.mark for end in own.ends}
        for weld in own.record.welds:
            at_node = weld.kind == "node" and weld.name == own.node.node
            at_stub = weld.kind == "joint" and own.node.type == "stub"
            if at_node or (at_stub and not marks.isdisjoint(weld.plates)):
                found.append(weld)
    marks = {plate.mark for plate in inside(through, joinings)}
    found += [w for w in through.welds if w.kind == "diaphragm" and w.plates[0] in marks]
    return found


def node_weld_listing(welds: Sequence[Weld], style: SheetStyle) -> Listing:
    """The list of a node's welds."""
    letters = kind_letters(welds)
    rows = tuple(_row(weld, letters[weld_kind(weld)], style) for weld in welds)
    return Listing(style.say("Welds"), style.headings(WELDS), rows, "<<>>><>><")


def _row(weld: Weld, letter: str, style: SheetStyle) -> tuple[str, ...]:
    prep = weld.prep
    return (
        weld.mark,
        " / ".join(on_face(text, style) for text in weld.plates),
        "/".join(map(style.thickness, dict.fromkeys(weld.thickness))),
        style.length(weld.length),
        f"{math.degrees(weld.dihedral):.1f}",
        letter,
        f"{math.degrees(prep.angle):g}" if prep.is_cut else "–",
        style.fine(prep.gap) if prep.gap else "–",
        style.say(weld.place),
    )


def on_face(text: str, style: SheetStyle) -> str:
    """A plate by its mark, a face of another member in the style's language."""
    member, _, face = text.rpartition(" ")
    return f"{member} {style.say(face)}" if member else style.say(text)


def pointed(through: MemberRecord, joinings: Sequence[Joining], frame: np.ndarray) -> list[Pointed]:
    """For each kind of weld at the node one that its symbol points at, on the view that shows it
    and has the fewest symbols. frame (3, 3): rows, at the node: along the member that runs through,
    across, and off its top."""
    welds = welds_of_node(through, joinings)
    letters = kind_letters(welds)
    ends = {(end.plate.mark, own.node.node): end for own in joinings for end in own.ends}
    own = {end.plate.mark: end for end in ends.values()}
    flats = {plate.mark: plate for plate in inside(through, joinings)}
    near = min((end.way for end in joinings[0].ends), default=0)
    found: list[Pointed] = []
    for letter in letters.values():
        seen: list[Pointed] = []
        for weld in welds:
            if letters[weld_kind(weld)] != letter:
                continue
            first = joinings[0].record.member == weld.member
            if weld.kind == "diaphragm" and flats[weld.plates[0]].welded:
                place = _wall_middle(flats[weld.plates[0]], weld)
                normal = _normal(flats[weld.plates[0]])
                sights = [v for v, k in ((ACROSS, 0), (ABOVE, 2)) if
                          abs(float((normal * frame[k]).sum())) < EDGE_ON]  # fmt: skip
                seen += [Pointed(view, weld, letter, place) for view in sights]
            elif weld.kind == "node" and weld.plates[0] in own:
                end = own[weld.plates[0]]
                place = end.corners.mean(axis=0)
                if first and end.way == near:
                    seen.append(Pointed(ALONG, weld, letter, place))
                if end.plate.face != "bottom":
                    seen.append(Pointed(ABOVE, weld, letter, place))
            elif weld.kind == "joint":
                end = next(own[mark] for mark in weld.plates if mark in own)
                if end.plate.face != "bottom":
                    seen.append(Pointed(ABOVE, weld, letter, _far_middle(end)))
        if seen:
            taken = [one.view for one in found]
            found.append(min(seen, key=lambda one: taken.count(one.view)))
    return found


def _normal(plate: DevelopedPlate) -> np.ndarray:
    """The normal (3,) of a flat part."""
    return plate.placing[2, :3]


def _wall_middle(flat: DevelopedPlate, weld: Weld) -> np.ndarray:
    """The middle (3,) of the side of a diaphragm a weld runs along: the one as long as it."""
    return min(flat.welded, key=lambda side: abs(side.length - weld.length)).middle


def _far_middle(end) -> np.ndarray:
    """The middle (3,) of the end line of a plate that is not at the node."""
    lines = ring(end.plate)
    count = len(end.plate.lines)
    return (lines[count - 1 : count + 1] if end.way > 0 else lines[[0, -2]]).mean(axis=0)


def point_at(
    labels: Labels, one: Pointed, tip: np.ndarray, bounds: np.ndarray, style: SheetStyle
) -> list[Polyline]:
    """The lines of a weld's symbol about a view, its texts among the labels; none where there is
    no room. tip (2,): of the arrow; bounds (2, 2): least and greatest x, y drawn, mm on paper."""
    weld = one.weld
    (left, low), (right, high) = bounds.tolist()
    x, y = tip.tolist()
    ways = (True, False) if x - left < right - x else (False, True)
    beside = [
        ((left - aside if leftward else right + aside, y + level), leftward)
        for aside in ASIDE
        for level in LEVELS
        for leftward in ways
    ]
    levels = [(high + UP, low - DOWN), (high + 2 * UP, low - 2 * DOWN)]
    beyond = [
        ((x + (-aside if leftward else aside), level), leftward)
        for pair in levels
        for level in (pair if high - y < y - low else pair[::-1])
        for aside in ASIDE
        for leftward in ways[::-1]
    ]
    # The view from above is the highest; the others have room over and under them.
    for at, leftward in (*beside, *beyond) if one.view == ABOVE else (*beyond, *beside):
        lines, texts = weld_symbol(
            *(weld.prep, weld.cut_thickness, weld.place, weld.ndt, at, style),
            *(leftward, one.letter),
        )
        points = np.concatenate(
            [np.array(line.points) for line in lines] + [text_box(text) for text in texts]
        )
        (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
        if one.view != ABOVE and at[1] > high and (x0 < left - SPILL or x1 > right + SPILL):
            continue
        box = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
        arrow = weld_arrow(weld.prep, at, tip, style)
        if labels.put_group(box, texts, segments_of(line.points for line in arrow)):
            return [*lines, *arrow]
    return []
