# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bevels of plate edges: what each stretch of an edge is cut to, by its weld and its neighbour.

The edge of a plate as modelled lies on its neighbour; that alone tilts it against square
(`natural`) by an angle that changes along a twisted member. A groove is cut from a face in
addition. Shops cut stretches with a constant angle, so an edge is divided into as few stretches as
the rule `bevel_step` allows: within one, the modelled angle is nowhere farther than half a step
from the angle that is cut, but where it changes by a step within SHORTEST_STRETCH.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..finding import BendTorsionError, error
from ..lofting import DevelopedPlate, EndPart, PlateEdge
from .bevel_record import EdgeBevel
from .preps import Prep
from .weld_record import Weld

CONTOURS = ("mid", "top", "root", "widest")
"""Faces a cut contour may be of: the edge of the flattened surface; of the marking face; the line
where groove and land meet; the outermost line of the edge."""

ROUNDED = np.radians(0.1)
"""rad; bevel angles are told in steps of this."""

SHORTEST_RANGE = 1.0
"""mm; stretches shorter than this are cut with the one beside them."""

SHORTEST_STRETCH = 50.0
"""mm; no torch turns to another angle on a shorter way: there the cut may be off by more."""

LARGEST_BEVEL = np.radians(75.0)
"""rad; no torch cuts flatter."""


@dataclass(frozen=True)
class _Cut:
    """Prep of one stretch of an edge from a place to another, by a weld; grooved: on this plate."""

    start: float
    end: float
    weld: str = ""
    prep: Prep | None = None
    grooved: bool = False
    thickness: float = 0.0


def with_bevels(
    plates: Sequence[DevelopedPlate],
    welds: Sequence[Weld],
    step: float = np.radians(1.0),
    contour: str = "mid",
) -> tuple[DevelopedPlate, ...]:
    """The plates of a member with their bevels, in the order given; step: rad; contour: one of
    CONTOURS. Raises BendTorsionError for edges no torch can cut, naming plate and weld."""
    faces = {plate.mark: plate.face for plate in plates}
    by_plate: dict[str, list[Weld]] = {}
    for weld in welds:
        for mark in weld.plates:
            by_plate.setdefault(mark, []).append(weld)
    made = []
    for plate in plates:
        bevels: list[EdgeBevel] = []
        if plate.lines and plate.edges:
            own = by_plate.get(plate.mark, ())
            for number, name in enumerate(("first", "second")):
                bevels += _along(plate, number, name, own, faces, step)
            bevels += _ends(plate, own, step)
        bevels += _square_sides(plate, by_plate.get(plate.mark, ()), faces, step)
        made.append(replace(plate, bevels=tuple(bevels), contour=contour))
    steep = [(p, b) for p in made for b in p.bevels if max(map(abs, b.angles)) > LARGEST_BEVEL]
    if steep:
        rows = {weld.mark: weld.row for weld in welds}
        raise BendTorsionError(
            error(
                "bevel-steep",
                plate.mark,
                f"weld {bevel.weld or 'none'} asks for an edge that cannot be cut: {bevel.edge} "
                f"from {bevel.start:.0f}",
                "give the preparation a smaller angle, or cut the other plate",
                position=_row_of(bevel, rows),
                value=float(np.degrees(max(map(abs, bevel.angles)))),
                limit=float(np.degrees(LARGEST_BEVEL)),
                unit="degrees",
            )
            for plate, bevel in steep
        )
    return tuple(made)


def _row_of(bevel: EdgeBevel, rows: Mapping[str, int]) -> str:
    """`edge k` of the row that prepares a bevel's weld, else the edge and where it begins."""
    number = next((rows[mark] for mark in bevel.weld.split() if rows.get(mark)), 0)
    return f"edge {number}" if number else f"{bevel.edge} {bevel.start:.0f}"


def _along(plate, number: int, name: str, welds, faces, step: float) -> Iterator[EdgeBevel]:
    edge = plate.edges[number]
    cuts = [
        _Cut(weld.start, weld.end, weld.mark, weld.prep, _is_grooved(plate, weld), plate.thickness)
        for weld in welds
        if weld.kind in ("seam", "lane") and _is_on(plate, number, edge, weld, faces)
    ]
    for cut in _whole(cuts, plate.s_start, plate.s_end):
        stretches = _stepped(edge.s, edge.bevel, cut.start, cut.end, step)
        for low, high, angle in _long_enough(list(stretches)):
            bevel = _bevel(name, edge.edge, cut, low, high, angle)
            if bevel.is_cut:
                yield bevel


def _ends(plate: DevelopedPlate, welds, step: float) -> Iterator[EdgeBevel]:
    for weld in welds:
        if weld.kind != "joint":
            continue
        at_end = weld.plates[0] == plate.mark
        grooved = _is_grooved(plate, weld)
        cut = _Cut(0.0, 0.0, weld.mark, weld.prep, grooved, weld.cut_thickness)
        name, line = ("end", "E-2") if at_end else ("start", "E-1")
        bevel = _bevel(name, line, cut, 0.0, plate.lines[-1 if at_end else 0].length_3d, 0.0)
        bevel = replace(bevel, chamfer=plate.chamfers[at_end])
        if bevel.is_cut:
            yield bevel
    for parts, name, line in zip(plate.ends, ("start", "end"), ("E-1", "E-2"), strict=True):
        for part in parts:
            weld = _weld_of(part, welds)
            low, high = float(part.along[0]), float(part.along[-1])
            cut = _Cut(low, high, thickness=plate.thickness)
            if weld is not None:
                cut = replace(cut, weld=weld.mark, prep=weld.prep, grooved=weld.prep.is_cut)
            stretches = _stepped(part.along, part.bevel, low, high, step)
            for begin, end, angle in _long_enough(list(stretches)):
                bevel = _bevel(name, line, cut, begin, end, angle)
                if bevel.is_cut:
                    yield bevel


def _square_sides(plate: DevelopedPlate, welds, faces, step: float) -> Iterator[EdgeBevel]:
    """Sides of a flat part that are cut square against what stands askew to them."""
    own = [weld for weld in welds if weld.plates[0] == plate.mark]
    for side in plate.welded:
        opening = 0.5 * np.pi - side.dihedral
        if not side.edge or opening <= 0.5 * step:
            continue
        meets = ((w, (w.plates[1], faces.get(w.plates[1]))) for w in own)
        weld = next((w for w, names in meets if side.face in names), None)
        mark, prep = (weld.mark, weld.prep.name or weld.prep.type) if weld else ("", "")
        opened = _rounded(opening), side.opens
        yield EdgeBevel("wall", side.edge, mark, prep, 0.0, side.length, 0.0, opening=opened)


def _weld_of(part: EndPart, welds) -> Weld | None:
    """The weld at a node that a stretch of a cut end is prepared for."""
    return next(
        (
            w
            for w in welds
            if w.kind == "node" and w.start == part.s.min() and w.end == part.s.max()
        ),
        None,
    )


def _is_grooved(plate: DevelopedPlate, weld: Weld) -> bool:
    """Whether the weld's groove is cut into this plate: of a V into both, else into the first."""
    both = weld.prep.type in ("v", "double-v")
    return weld.prep.is_cut and (both or weld.plates[0] == plate.mark)


def _is_on(plate, number: int, edge: PlateEdge, weld: Weld, faces) -> bool:
    if weld.kind == "lane":
        return edge.neighbour == plate.face and weld.plates.index(plate.mark) == 1 - number
    other = weld.plates[1 - weld.plates.index(plate.mark)]
    return edge.neighbour == faces.get(other)


def _whole(cuts: Sequence[_Cut], start: float, end: float) -> list[_Cut]:
    """The stretches of an edge from start to end, those without a weld too."""
    out, at = [], start
    for cut in sorted(cuts, key=lambda cut: cut.start):
        low, high = max(cut.start, at), min(cut.end, end)
        if high - low < SHORTEST_RANGE:
            continue
        if low - at >= SHORTEST_RANGE:
            out.append(_Cut(at, low, thickness=cut.thickness))
        else:
            low = at
        out.append(replace(cut, start=low, end=high))
        at = high
    if end - at >= SHORTEST_RANGE or not out:
        out.append(_Cut(at, end, thickness=out[-1].thickness if out else 0.0))
    else:
        out[-1] = replace(out[-1], end=end)
    return _merged(out)


def _merged(cuts: Sequence[_Cut]) -> list[_Cut]:
    """Stretches of one preparation as one, for all its welds."""
    out: list[_Cut] = []
    for cut in cuts:
        last = out[-1] if out else None
        if last and (last.prep, last.grooved) == (cut.prep, cut.grooved):
            weld = f"{last.weld} {cut.weld}".strip()
            out[-1] = replace(last, end=cut.end, weld=weld)
        else:
            out.append(cut)
    return out


def _stepped(
    s: np.ndarray, angle: np.ndarray, start: float, end: float, step: float
) -> Iterator[tuple[float, float, float]]:
    """Stretches (from, to, rounded angle) of a piecewise linear angle over s, as few as keep it
    within half a step of a constant in each."""
    inner = (s > start) & (s < end)
    places = np.concatenate([[start], s[inner], [end]])
    values = np.interp(places, s, angle)
    low = high = values[0]
    begin = float(start)
    for a, b, before, value in zip(places, places[1:], values, values[1:], strict=False):
        at, last = float(a), float(before)
        while max(high, value) - min(low, value) > step:
            # The angle leaves the band on its way to the next place: a new stretch begins there.
            limit = low + step if value > last else high - step
            at += (limit - last) / (value - last) * (float(b) - at)
            yield begin, at, _rounded(0.5 * (min(low, limit) + max(high, limit)))
            begin, low, high, last = at, limit, limit, float(limit)
        low, high = min(low, value), max(high, value)
    yield begin, float(end), _rounded(0.5 * (low + high))


def _long_enough(stretches: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    """The stretches, those shorter than SHORTEST_STRETCH cut with the one beside them that is
    nearest in angle."""
    out = list(stretches)
    while len(out) > 1:
        lengths = [high - low for low, high, _ in out]
        k = lengths.index(min(lengths))
        if lengths[k] >= SHORTEST_STRETCH:
            break
        beside = [j for j in (k - 1, k + 1) if 0 <= j < len(out)]
        j = min(beside, key=lambda j: abs(out[j][2] - out[k][2]))
        first, last = min(j, k), max(j, k)
        out[first : last + 1] = [(out[first][0], out[last][1], out[j][2])]
    return out


def _rounded(angle: float) -> float:
    return float(round(angle / ROUNDED)) * ROUNDED


def _bevel(side: str, edge: str, cut: _Cut, start: float, end: float, natural: float) -> EdgeBevel:
    outer = inner = (0.0, 0.0)
    if cut.grooved:
        prep, depth = cut.prep, cut.prep.depth(cut.thickness)
        double = prep.type.startswith("double")
        if prep.side == "outer" or double:
            outer = (_rounded(prep.cut_angle - natural), depth)
        if prep.side == "inner" or double:
            inner = (_rounded(prep.cut_angle + natural), depth)
    name = cut.prep.name or cut.prep.type if cut.prep else ""
    return EdgeBevel(side, edge, cut.weld, name, start, end, natural, outer, inner)


def edge_levels(
    bevel: EdgeBevel | None, outer: np.ndarray, inner: np.ndarray, thickness: float
) -> dict[str, np.ndarray]:
    """How far outside the edge of the flattened surface lie the edges (n,) of the `outer` and the
    `inner` face, and the `outer land` and `inner land`, where grooves end, mm.

    outer, inner (n,): the same of the edge without grooves.
    """
    rise = (outer - inner) / thickness
    if bevel is None:
        return {"outer": outer, "inner": inner, "outer land": outer, "inner land": inner}
    outer_angle, inner_angle = bevel.outer[0], bevel.inner[0]
    outer_depth, inner_depth = bevel.cut_depths
    outer_land, inner_land = outer - rise * outer_depth, inner + rise * inner_depth
    return {
        "outer": outer_land - outer_depth * np.tan(outer_angle),
        "inner": inner_land - inner_depth * np.tan(inner_angle),
        "outer land": outer_land,
        "inner land": inner_land,
    }


def contour_offset(
    bevel: EdgeBevel | None,
    outer: np.ndarray,
    inner: np.ndarray,
    thickness: float,
    contour: str,
    marking_face: str,
) -> np.ndarray:
    """How far the contour, one of CONTOURS, lies outside the edge of the flattened surface (n,),
    mm; outer, inner as in `edge_levels`."""
    if contour == "mid":
        return np.zeros_like(outer)
    levels = edge_levels(bevel, outer, inner, thickness)
    if contour == "top":
        return levels["inner" if marking_face == "inside" else "outer"]
    if contour == "widest":
        return np.max(list(levels.values()), axis=0)
    depths = (0.0, 0.0) if bevel is None else (bevel.outer[1], bevel.inner[1])
    if not any(depths):
        return np.zeros_like(outer)
    if all(depths):
        return 0.5 * (levels["outer land"] + levels["inner land"])
    return levels["outer land" if depths[0] else "inner land"]
