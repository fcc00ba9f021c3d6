# SPDX-License-Identifier: LGPL-2.1-or-later
"""Section outlines at chosen places, as flat shapes to cut and hold against the assembly."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..finding import BendTorsionError, error
from ..members.member import Member, cell_corners
from ..members.strips import rails_between
from .bed_record import Template


def section_outline(member: Member, s: float, side: str = "later") -> np.ndarray:
    """The outer outline (n, 2) in (y, z) of the section plane at s, in ring order.

    Of a closed section its corners; of an open one, or one whose corners are not on its outer
    faces, the convex hull of its plates. side: which section where it steps at s.
    """
    if on_corners(member):
        cells = member.law.cells
        starts = np.array([cell.start for cell in cells[1:]])
        at = int(np.searchsorted(starts, s, side="right" if side == "later" else "left"))
        return cell_corners(cells[at], np.array([s]))[0]
    points = []
    at = member.frames.at(np.array([s]))
    for strip in range(len(member.law.strips)):
        edges = [0.0, *member.law.joints_of(strip), member.length]
        k = int(np.searchsorted(edges[1:-1], s, side="right" if side == "later" else "left"))
        (rails,) = rails_between(member, [(strip, edges[k], edges[k + 1])])
        for surface in (rails.outer, rails.inner):
            off = surface(np.array([s])).reshape(2, 3) - at.origin
            points.append(np.stack([(off * at.y).sum(axis=1), (off * at.z).sum(axis=1)], axis=1))
    return convex_hull(np.concatenate(points))


def on_corners(member: Member) -> bool:
    """True when the corners are a ring on the outer faces."""
    section = member.law.sections[0]
    return section.closed and all(strip.line == 0.0 for strip in section.strips)


def convex_hull(points: np.ndarray) -> np.ndarray:
    """The convex hull (m, 2) of points (n, 2), counter-clockwise (Andrew's monotone chain)."""
    # Rounded, so that points above one another come in order whatever their last bits.
    points = points[np.lexsort(np.round(points.T[::-1], 6))]

    def chain(ordered):
        hull = []
        for point in ordered:
            while len(hull) > 1 and _turn(hull[-2], hull[-1], point) <= 1e-6:
                hull.pop()
            hull.append(point)
        return hull[:-1]

    return np.array([*chain(points), *chain(points[::-1])])


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def template(
    member: Member, name: str, line: str, s: float, clearance: float = 0.0, side: str = "later"
) -> Template:
    """The template of the section at s; raises BendTorsionError when a clearance below zero
    leaves nothing of it."""
    outline = section_outline(member, s, side)
    section = np.stack([-outline[:, 0], outline[:, 1]], axis=1)
    if _area(section) < 0.0:
        section = section[::-1]
    board = offset_outline(section, clearance)
    # An outline turned inside out keeps its sign in even dimensions: its sides turn round.
    along, former = (np.roll(ring, -1, axis=0) - ring for ring in (board, section))
    if _area(board) <= 0.0 or ((along * former).sum(axis=1) <= 0.0).any():
        raise BendTorsionError(
            error(
                "template-clearance",
                member.name,
                "the clearance leaves nothing of the template",
                "use a smaller clearance",
                position=f"line {line}",
                value=float(clearance),
                unit="mm",
            )
        )
    return Template(name, member.name, line, float(s), section, board, float(clearance))


def offset_outline(outline: np.ndarray, distance: float) -> np.ndarray:
    """A counter-clockwise polygon (n, 2) with every side moved out by `distance`."""
    if distance == 0.0:
        return outline
    side = np.roll(outline, -1, axis=0) - outline
    side = side / np.sqrt((side * side).sum(axis=1, keepdims=True))
    out = np.stack([side[:, 1], -side[:, 0]], axis=1)
    before, after = np.roll(out, 1, axis=0), out
    # Both sides at a corner move by `distance`: the corner moves along their bisector.
    bisector = before + after
    return outline + distance * bisector * (2.0 / (bisector * bisector).sum(axis=1))[:, None]


def _area(outline: np.ndarray) -> float:
    after = np.roll(outline, -1, axis=0)
    return 0.5 * float((outline[:, 0] * after[:, 1] - after[:, 0] * outline[:, 1]).sum())


def template_lines(
    stations: np.ndarray, start: float, end: float, pitch: float, chosen: Sequence[str] = ()
) -> list[tuple[str, float, str]]:
    """Label, place and side of a piece's templates: its ends, the chosen member stations `L-k`
    inside it, and as many more that none are farther apart than `pitch` where stations allow."""
    inside = {f"L-{k}": float(s) for k, s in enumerate(stations) if start + 1.0 < s < end - 1.0}
    wanted = {label: inside[label] for label in chosen if label in inside}
    count = int(np.ceil((end - start) / pitch - 1e-9))
    labels = list(inside)
    for place in np.linspace(start, end, count + 1)[1:-1]:
        if labels:
            near = min(labels, key=lambda label: abs(inside[label] - place))
            wanted.setdefault(near, inside[near])
    between = sorted(wanted.items(), key=lambda item: item[1])
    return [
        ("E-1", start, "later"),
        *((label, s, "later") for label, s in between),
        ("E-2", end, "earlier"),
    ]
