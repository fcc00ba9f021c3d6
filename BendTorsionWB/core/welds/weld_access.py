# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds made from inside a closed box that is too small to get into."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from ..finding import BendTorsionError, Finding, error, warning
from ..members.cells import SectionLaw
from ..sections.strip_lines import edge_points
from .preps import Prep
from .weld_record import Weld


def from_inside(prep: Prep) -> bool:
    """Whether a weld is made from the inner side, alone or as well."""
    return prep.side == "inner" or prep.type.startswith("double")


def clear_sizes(law: SectionLaw, s: float) -> tuple[float, float]:
    """The smallest and the largest clear size, mm, of a box at arc length s: from the middle of
    each plate's inner face square across to the first other plate."""
    cell = np.array([law.cells.index(law.cell_at(s))])
    place, zero = np.array([s]), np.zeros(1)
    sites = law.sites(cell, place, zero, zero, zero)

    def point(strip: int, edge: int, depth: float) -> np.ndarray:
        return edge_points(law.table, sites, *(np.array([v]) for v in (strip, edge, depth)))[0]

    count = range(len(law.strips))
    inner = np.array([[point(k, edge, 1.0) for edge in (0, 1)] for k in count])
    sizes = []
    for k in count:
        middle = inner[k].mean(axis=0)
        along = inner[k, 1] - inner[k, 0]
        across = np.array([-along[1], along[0]]) / np.hypot(*along)
        if (across * (inner.mean(axis=(0, 1)) - middle)).sum() < 0.0:
            across = -across
        met = [_met(middle, across, *inner[j]) for j in count if j != k]
        sizes.append(min(met))
    return min(sizes), max((size for size in sizes if np.isfinite(size)), default=np.inf)


def _met(start: np.ndarray, way: np.ndarray, one: np.ndarray, two: np.ndarray) -> float:
    """How far along a ray it meets a segment; infinite where it does not."""
    side = two - one
    area = way[0] * side[1] - way[1] * side[0]
    if abs(area) < 1e-9 * np.hypot(*side):
        return np.inf
    off = one - start
    along = (off[0] * side[1] - off[1] * side[0]) / area
    part = (off[0] * way[1] - off[1] * way[0]) / area
    return float(along) if along > 0.0 and -1e-9 <= part <= 1.0 + 1e-9 else np.inf


def access_findings(
    member: str,
    law: SectionLaw,
    welds: Sequence[Weld],
    faces: Mapping[str, str],
    closing: Collection[str],
    has_openings: bool,
    limit: float,
) -> tuple[Finding, ...]:
    """Warnings, by `edge k`, of welds made from inside a box with less than `limit` mm clear: at
    nodes and between delivery pieces, and of seams where no face is left that can be closed last.

    faces: of plates by their marks; closing: faces named to be closed last, empty for any of them.
    Raises BendTorsionError where all walls are welded so on site, in a member without openings a
    hand could reach through.
    """
    if not law.sections[0].closed:
        return ()
    walls = {strip.face for strip in law.strips}
    found = [*_seams(member, law, welds, faces, closing or walls, limit)]
    ends: dict[tuple[str, str], list[Weld]] = {}
    for weld in welds:
        if weld.kind == "node":
            ends.setdefault(("node", weld.name), []).append(weld)
        elif weld.kind == "joint" and weld.place == "field":
            ends.setdefault(("joint", f"the joints of piece {weld.piece}"), []).append(weld)
    for (_, name), own in ends.items():
        inside = [weld for weld in own if from_inside(weld.prep)]
        if not inside:
            continue
        least, most = clear_sizes(law, 0.5 * (inside[0].start + inside[0].end))
        if least >= limit:
            continue
        marks = ", ".join(dict.fromkeys(weld.plates[0] for weld in inside))
        row = max(weld.row for weld in inside)
        told = {
            "position": f"edge {row}" if row else "",
            "value": least,
            "limit": limit,
            "unit": "mm",
        }
        shut = {faces[weld.plates[0]] for weld in inside} >= walls and len(inside) == len(own)
        if shut and not has_openings and all(weld.place == "field" for weld in inside):
            found.append(
                error(
                    "weld-access",
                    member,
                    f"{name} is welded on site from inside at all walls of a box with "
                    f"{least:.0f} x {most:.0f} mm clear, where nobody gets in: {marks}",
                    "weld it from outside alone (bevel or v, side outer; a backing bar then lies "
                    "inside), or give a hand hole in sheet Openings",
                    **told,
                )
            )
        else:
            found.append(
                warning(
                    "weld-access",
                    member,
                    f"{name} is welded from inside a box with {least:.0f} x {most:.0f} mm clear: "
                    f"{marks}",
                    "make sure that it can be reached, or weld it from outside alone (side outer; "
                    "a backing bar then lies inside)",
                    **told,
                )
            )
    if any(one.severity == "error" for one in found):
        raise BendTorsionError([one for one in found if one.severity == "error"])
    return tuple(found)


def _seams(member, law, welds, faces, closing, limit) -> Iterator[Finding]:
    """A warning for each row of seams welded from inside when no face can be closed last: one
    whose seams are all welded from outside."""
    inside = []
    for weld in welds:
        if weld.kind == "seam" and from_inside(weld.prep):
            sizes = clear_sizes(law, 0.5 * (weld.start + weld.end))
            if sizes[0] < limit:
                inside.append((weld, sizes))
    beside = {faces[mark] for weld, _ in inside for mark in weld.plates}
    if not set(closing) <= beside:
        return
    told: dict[int, tuple[float, float, dict[str, None]]] = {}
    for weld, (least, most) in inside:
        if {faces[mark] for mark in weld.plates}.isdisjoint(closing):
            continue
        *_, names = told.setdefault(weld.row, (least, most, {}))
        names[weld.name] = None
    for row, (least, most, names) in told.items():
        yield warning(
            "weld-access",
            member,
            f"seams {', '.join(names)} are welded from inside a box with {least:.0f} x {most:.0f} "
            "mm clear, and no face is left to be closed last from outside",
            "weld both seams of the face that is closed last from outside alone (side outer; a "
            "backing bar then lies inside)",
            position=f"edge {row}" if row else "",
            value=least,
            limit=limit,
            unit="mm",
        )
