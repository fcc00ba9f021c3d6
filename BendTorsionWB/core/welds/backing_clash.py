# SPDX-License-Identifier: LGPL-2.1-or-later
"""Backing bars that run into diaphragms: the snipe that clears each, and what to do without one.

A bar lies with its width on the inside of the plate that ends at the seam, against the other plate.
A diaphragm keeps its gap from both and has its corner cut off by the snipe.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from .. import tolerances
from ..finding import Finding, warning
from ..lofting import DevelopedPlate, WeldedSide
from ..plates.diaphragm_input import Diaphragm
from .weld_record import Weld


def snipe_needed(
    bar: tuple[float, float],
    gaps: tuple[float, float],
    dihedral: float,
    corner: float | None = None,
    slants: tuple[float, float] = (1.0, 1.0),
) -> float:
    """Legs, mm, of the snipe that clears a bar, width and thickness mm, in a corner of walls at an
    angle, rad; gaps: mm from the diaphragm to the wall the bar lies on and to the other. 0 where
    the bar lies within a gap. Of a diaphragm askew to the seam corner is its own angle there, rad,
    and slants the sines of the angles of its sides on the two walls with the seam.

    In coordinates along the two walls the far corner of the bar is at (b - t cot, t / sin), the
    corner of the diaphragm at (gap of the other, gap of the own) / sin."""
    width, thickness = bar
    sine = math.sin(dihedral if corner is None else corner)
    beyond = (width - thickness / math.tan(dihedral)) / slants[0] - gaps[1] / sine
    above = thickness / math.sin(dihedral) / slants[1] - gaps[0] / sine
    return 0.0 if min(beyond, above) <= tolerances.WELD_FIGURE else beyond + above


def backing_clashes(
    member: str,
    length: float,
    welds: Sequence[Weld],
    faces: Mapping[str, str],
    rows: Sequence[Diaphragm],
) -> Iterator[Finding]:
    """A warning, by `diaphragm k`, for each diaphragm that a backing bar inside the member runs
    into, of the bar that asks for most. length: of the axis, mm; faces: of plates by their marks;
    rows: of sheet Diaphragms."""
    backed = [
        weld
        for weld in welds
        if weld.kind in ("seam", "lane") and weld.prep.backing and weld.prep.side == "outer"
    ]
    for number, row in enumerate(rows, start=1):
        place = row.s * (length if row.s_is_ratio else 1.0)
        here = [w for w in backed if not row.end and w.start <= place <= w.end]
        across = [(w, w.prep.backing[1]) for w in here if w.kind == "lane"]
        across = [
            (w, t) for w, t in across if t > _gap(row, faces[w.plates[0]]) + tolerances.WELD_FIGURE
        ]
        if across:
            weld, thickness = max(across, key=lambda item: item[1])
            yield _clash(
                member,
                number,
                weld,
                "between its corners, where no snipe clears it",
                f"give a gap of {thickness:g} mm, weld without a bar, or end the bar there",
                _gap(row, faces[weld.plates[0]]),
                thickness,
            )
        corners = [
            (w, snipe_needed(w.prep.backing, _gaps(row, w, faces), w.dihedral))
            for w in here
            if w.kind == "seam"
        ]
        if not corners:
            continue
        weld, needed = max(corners, key=lambda item: item[1])
        if needed > row.snipe + tolerances.WELD_FIGURE:
            whole = math.ceil(needed - tolerances.WELD_FIGURE)
            yield _clash(
                member,
                number,
                weld,
                f"with its snipe of {row.snipe:g} mm",
                f"give a snipe of {whole} mm, or a narrower bar, or end the bar at the diaphragm",
                row.snipe,
                needed,
            )


def node_backing_clashes(
    plates: Sequence[DevelopedPlate], welds: Sequence[Weld]
) -> Iterator[Finding]:
    """A warning for each diaphragm of a node that the backing bar of a seam runs into, of the bar
    that asks for most. plates: of the member, walls and flat parts."""
    walls = {plate.mark: plate for plate in plates if plate.lines}
    backed = [
        weld
        for weld in welds
        if weld.kind == "seam" and weld.prep.backing and weld.prep.side == "outer"
    ]
    for flat in plates if backed else ():
        found = []
        for one, two, leg in _corners(flat):
            for weld in backed:
                on, other = (walls[mark].face for mark in weld.plates)
                clear = weld.end < flat.s_start or weld.start > flat.s_end
                if clear or {on, other} != {one.face, two.face}:
                    continue
                pair = (one, two) if one.face == on else (two, one)
                along = _seam_direction(walls[weld.plates[0]], other, flat.s_start)
                needed = snipe_needed(
                    weld.prep.backing,
                    tuple(_near_gap(side, flat.thickness) for side in pair),
                    weld.dihedral,
                    math.acos(float((_direction(flat, one) * -_direction(flat, two)).sum())),
                    tuple(_sine(_direction(flat, side), along) for side in pair),
                )
                found.append((needed, leg, weld))
        found = [item for item in found if item[0] > item[1] + tolerances.WELD_FIGURE]
        if found:
            needed, leg, weld = max(found, key=lambda item: item[0] - item[1])
            bar = "{:g}x{:g}".format(*weld.prep.backing)
            yield warning(
                "backing-clash",
                flat.mark,
                f"the backing bar {bar} of weld {weld.mark} runs into the diaphragm of the node "
                f"with its snipe of {leg:.0f} mm",
                "give a narrower bar, weld the seam without one, or end the bar at the diaphragm",
                value=float(leg),
                limit=float(needed),
                unit="mm",
            )


def _corners(flat: DevelopedPlate) -> Iterator[tuple[WeldedSide, WeldedSide, float]]:
    """Pairs of sides of a flat part, one after the other, that meet in a corner of two walls, and
    the shorter leg, mm, of the snipe between them, 0 without one."""
    sides = [side for side in flat.welded if side.edge and side.how == "walls"]
    for one, two in itertools.permutations(sides, 2):
        (a, b), (c, d) = flat.side_ends(one.edge), flat.side_ends(two.edge)
        count = len(flat.points)
        last, first = (int(label.split("-")[1]) for label in _between(one, two))
        if (first - last) % count > 1:
            continue
        u, v = b - a, d - c
        cross = float(u[0] * v[1] - u[1] * v[0])
        if cross <= 1e-6 * float(np.hypot(*u) * np.hypot(*v)):
            continue
        along = float((c - b)[0] * v[1] - (c - b)[1] * v[0]) / cross * float(np.hypot(*u))
        back = float((c - b)[0] * u[1] - (c - b)[1] * u[0]) / cross * float(np.hypot(*v))
        yield one, two, min(abs(along), abs(back))


def _between(one: WeldedSide, two: WeldedSide) -> tuple[str, str]:
    """The corner a side ends at and the one the next begins at."""
    return one.edge.split("/")[1], two.edge.split("/")[0]


def _direction(flat: DevelopedPlate, side: WeldedSide) -> np.ndarray:
    """Unit vector (3,) along a side of a flat part, in the model."""
    space = {point.label: point.xyz for point in flat.points}
    a, b = (space[label] for label in side.edge.split("/"))
    return (b - a) / np.sqrt(((b - a) ** 2).sum())


def _near_gap(side: WeldedSide, thickness: float) -> float:
    """Gap, mm, of a square edge along the face that is nearer to the wall."""
    return max(side.gap - thickness / math.tan(side.dihedral), 0.0)


def _seam_direction(wall: DevelopedPlate, other: str, s: float) -> np.ndarray:
    """Unit vector (3,) along the edge of a plate on another face, near a place s, mm."""
    edge = next(own.edge for own in wall.edges if own.neighbour == other)
    points = sorted(
        (p for p in wall.points if p.kind == "arris" and p.edge == edge), key=lambda p: abs(p.s - s)
    )
    way = points[1].xyz - points[0].xyz
    return way / np.sqrt((way * way).sum())


def _sine(one: np.ndarray, two: np.ndarray) -> float:
    cosine = float((one * two).sum())
    return math.sqrt(max(1.0 - cosine * cosine, 1e-6))


def _gaps(row: Diaphragm, weld: Weld, faces: Mapping[str, str]) -> tuple[float, float]:
    return _gap(row, faces[weld.plates[0]]), _gap(row, faces[weld.plates[1]])


def _gap(row: Diaphragm, face: str) -> float:
    closing = row.closing
    own = closing and closing.face == face and closing.gap is not None
    return closing.gap if own else row.gap


def _clash(member, number, weld, where, mend, value, limit) -> Finding:
    bar = "{:g}x{:g}".format(*weld.prep.backing)
    return warning(
        "backing-clash",
        member,
        f"the backing bar {bar} of weld {weld.mark} runs into the diaphragm {where}",
        mend,
        position=f"diaphragm {number}",
        value=float(value),
        limit=float(limit),
        unit="mm",
    )
