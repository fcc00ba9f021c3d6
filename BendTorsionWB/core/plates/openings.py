# SPDX-License-Identifier: LGPL-2.1-or-later
"""Openings of plates, cut straight along the plate's normal at their middle.

The contour is found where that prism meets the outer, the mid and the inner surface; the flat
pattern has the mid-surface's, so that a circle is as round there as the plate is little curved.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from ..finding import BendTorsionError, Finding, error
from ..flattening.development import Development
from ..geometry import arc_contour
from ..lofting import FlatHole
from .hole_shape import HoleShape
from .plate_places import PlateOpening, Spot, places_along, rates, spot_at, surface_point
from .plates import Plate

LONGEST_CHORD = 20.0
"""mm; points along straight sides of an opening are no farther apart."""

CIRCLE_TOLERANCE = 0.01
"""mm; an inner contour this near to a circle is one."""


@dataclass(frozen=True)
class Opening:
    """An opening asked for: on a face, at s (mm, or a ratio of the axis length), offset mm from
    the middle of the plate's breadth towards its second edge; rotation (rad) of the shape's length
    from +s towards the second edge."""

    face: str
    s: float
    shape: HoleShape
    offset: float = 0.0
    rotation: float = 0.0
    s_is_ratio: bool = False


@dataclass(frozen=True, eq=False)
class Cut:
    """An opening to be cut: at a spot of one plate; source: what asks for it, for findings."""

    plate: int
    spot: Spot
    shape: HoleShape
    rotation: float
    source: str


def located(
    member: str, plates: Sequence[Plate], length: float, row: Opening, source: str
) -> Cut | Finding:
    """The cut of an opening asked for, or why there is none."""
    found = face_spot(member, plates, length, row, source, "opening")
    if isinstance(found, Finding):
        return found
    return Cut(*found, row.shape, row.rotation, source)


def face_spot(
    member: str, plates: Sequence[Plate], length: float, row, source: str, kind: str
) -> tuple[int, Spot] | Finding:
    """The plate and the spot a row with face, s and offset names, or the finding that says why
    there is none; kind: `opening` or `mark`."""
    faces = tuple(dict.fromkeys(plate.face for plate in plates))
    s = row.s * (length if row.s_is_ratio else 1.0)
    if row.face not in faces:
        return error(
            f"{kind}-face",
            member,
            f"the section has no face {row.face}",
            f"use {', '.join(faces)}",
            position=source,
            value=row.face,
        )
    mine = [k for k, plate in enumerate(plates) if plate.face == row.face and _reaches(plate, s)]
    if not mine:
        return error(
            f"{kind}-outside",
            member,
            "the place is not on the member",
            "give a place between its ends",
            position=source,
            value=float(s),
            limit=float(length),
            unit="mm",
        )
    # Of two plates at a joint the first; of lanes side by side the one the offset falls on.
    mine = [k for k in mine if plates[k].start == plates[mine[0]].start]
    ends = np.array(
        [surface_point(plates[k].rails.mid, np.full(2, s), np.array([0.0, 1.0])) for k in mine]
    )
    across = ends[-1, 1] - ends[0, 0]
    across = across / np.sqrt((across * across).sum())
    along = ((ends - 0.5 * (ends[0, 0] + ends[-1, 1])) * across).sum(axis=2)
    chosen = min(int((along[:-1, 1] < row.offset).sum()), len(mine) - 1)
    first, second = along[chosen]
    w = (row.offset - first) / (second - first)
    return mine[chosen], spot_at(plates[mine[chosen]].rails.mid, float(s), float(w))


def _reaches(plate: Plate, s: float) -> bool:
    return plate.start <= s <= plate.end


def cut_openings(member: str, plates: Sequence[Plate], cuts: Sequence[Cut]) -> tuple[Plate, ...]:
    """The plates with their openings, numbered `O-1` … along each.

    Raises BendTorsionError for openings that leave their plate, lie on a fold, or leave less steel
    than the plate is thick to an edge or to each other.
    """
    findings: list[Finding] = []
    made = list(plates)
    for index in sorted({cut.plate for cut in cuts}):
        plate = plates[index]
        mine = sorted((c for c in cuts if c.plate == index), key=lambda c: (c.spot.s, c.spot.w))
        openings = []
        for number, cut in enumerate(mine, start=1):
            opening, found = _opening(member, plate, cut, f"O-{number}")
            findings += found
            openings.append(opening)
        if not findings:
            findings += _too_close(member, plate, mine, openings)
        if not findings:
            made[index] = replace(plate, openings=tuple(openings))
    if findings:
        raise BendTorsionError(findings)
    return tuple(made)


def _opening(
    member: str, plate: Plate, cut: Cut, label: str
) -> tuple[PlateOpening | None, list[Finding]]:
    mid = plate.rails.mid
    at = cut.spot
    contour = arc_contour.moved(cut.shape.contour, cut.rotation)
    sides = arc_contour.fine_runs(contour, LONGEST_CHORD)
    inner, weights = arc_contour.inner_nodes(contour)
    ring = np.concatenate(sides)
    wanted = np.concatenate([ring, inner])
    levels = {}
    for name in ("mid", "outer", "inner"):
        rails = getattr(plate.rails, name)
        start = (levels["mid"][0], levels["mid"][1]) if levels else (at.s, at.w)
        # A hair of the plate's breadth per mm is a good first guess on the mid-surface.
        if not levels:
            by_s, by_w = (part[0] for part in rates(mid, np.array([at.s]), np.array([at.w])))
            start = (
                at.s + wanted[:, 0] / (by_s * at.x).sum(),
                at.w
                + (wanted[:, 1] - wanted[:, 0] * (by_s * at.y).sum() / (by_s * at.x).sum())
                / (by_w * at.y).sum(),
            )
        levels[name] = places_along(rails, at.point, at.x, at.y, wanted, start)
    findings = _outside(member, plate, cut, levels, len(ring))
    if findings:
        return None, findings
    heights = {}
    for name in ("outer", "inner"):
        s, w, _ = levels[name]
        off = surface_point(getattr(plate.rails, name), s, w) - at.point
        heights[name] = (off * at.normal).sum(axis=1)
    top, bottom = heights["outer"], heights["inner"]
    depth = (top - bottom)[len(ring) :]
    volume = float(np.abs((weights * depth).sum()))
    along = (weights * depth * 0.5 * (top + bottom)[len(ring) :]).sum()
    places = (inner * (weights * depth)[:, None]).sum(axis=0)
    sign = np.sign((weights * depth).sum())
    centre = at.point + sign * (places[0] * at.x + places[1] * at.y + along * at.normal) / volume
    both = np.concatenate([top, bottom])
    s, w, _ = levels["mid"]
    on_mid = np.column_stack([s, w])
    splits = np.cumsum([len(side) for side in sides])
    return (
        PlateOpening(
            label,
            cut.shape.title,
            at,
            contour,
            tuple(np.split(on_mid[: len(ring)], splits[:-1])),
            on_mid[len(ring) :],
            weights,
            (float(both.min() - plate.thickness), float(both.max() + plate.thickness)),
            volume,
            centre,
            {name: np.column_stack(level[:2]) for name, level in levels.items()},
        ),
        [],
    )


def _outside(member: str, plate: Plate, cut: Cut, levels: dict, count: int) -> list[Finding]:
    """Errors of an opening that leaves its plate, crosses a fold or comes too near to an edge."""

    def fault(code: str, problem: str, mend: str, value=None) -> list[Finding]:
        return [
            error(
                code,
                member,
                f"{problem} (plate {plate.mark})",
                mend,
                position=cut.source,
                value=value,
                limit=None if value is None else plate.thickness,
                unit="" if value is None else "mm",
            )
        ]

    s = np.concatenate([levels[name][0][:count] for name in levels])
    w = np.concatenate([levels[name][1][:count] for name in levels])
    found = np.concatenate([levels[name][2][:count] for name in levels])
    across = (w >= 0.0) & (w <= 1.0)
    along = found & (s >= plate.start) & (s <= plate.end)
    if not along[across].all():
        return fault(
            "opening-on-joint",
            "the opening runs over the end of its plate",
            "move it, or the joint",
        )
    at_seam = (plate.lane.first > 0.0, plate.lane.second < 1.0)
    if (at_seam[0] and w.min() < 0.0) or (at_seam[1] and w.max() > 1.0):
        return fault(
            "opening-on-seam",
            "the opening runs over the seam between two lanes of its face",
            "set its offset so that it lies on one lane, or move the seam (Splits, lanes)",
        )
    if not across.all():
        return fault(
            "opening-outside", "the opening leaves the face", "move it, or make it smaller"
        )
    folds = [f for f in plate.rails.mid_folds if s.min() <= f <= s.max()]
    if folds:
        return fault("opening-on-fold", "the opening lies on a fold", "move it off the transition")
    s, w = levels["mid"][0][:count], levels["mid"][1][:count]
    by_s, by_w = rates(plate.rails.mid, s, w)
    breadth = np.sqrt((by_w * by_w).sum(axis=1))
    advance = by_s - ((by_s * by_w).sum(axis=1) / breadth**2)[:, None] * by_w
    advance = np.sqrt((advance * advance).sum(axis=1))
    to_sides = float((np.minimum(w, 1.0 - w) * breadth).min())
    to_ends = float((np.minimum(s - plate.start, plate.end - s) * advance).min())
    for cut_end in (end for end in plate.cuts if end is not None):
        for level, (s, w, _) in levels.items():
            points = surface_point(getattr(plate.rails, level), s[:count], w[:count])
            side, slope = cut_end.surface.value_and_gradient(points)
            away = side / np.sqrt((slope * slope).sum(axis=1))
            to_ends = min(to_ends, float(away.min()))
    least = plate.thickness
    if to_ends < least:
        mend = "move it, or the joint"
        return fault("opening-on-joint", "the opening is too close to a joint", mend, to_ends)
    if to_sides < least:
        nearer = int(w.min() > (1.0 - w).min())
        if at_seam[nearer]:
            mend = "set its offset farther from the seam, or move the seam (sheet Splits, lanes)"
            problem = "the opening is too close to the seam between two lanes of its face"
            return fault("opening-on-seam", problem, mend, to_sides)
        mend = "move it, or make it smaller"
        return fault("opening-near-edge", "the opening is too close to an edge", mend, to_sides)
    return []


def _too_close(
    member: str, plate: Plate, cuts: Sequence[Cut], openings: Sequence[PlateOpening]
) -> list[Finding]:
    """Errors of openings that overlap or leave less steel between them than the plate is thick."""
    rings = []
    for opening in openings:
        places = np.concatenate(opening.runs)
        rings.append(surface_point(plate.rails.mid, places[:, 0], places[:, 1]))
    findings = []
    for j, one in enumerate(openings):
        for i in range(j):
            gap = float(cKDTree(rings[i]).query(rings[j])[0].min())
            centres = [openings[i].spot.point, one.spot.point]
            nested = any(
                arc_contour.inside(
                    host.contour,
                    np.array([[(off * host.spot.x).sum(), (off * host.spot.y).sum()]]),
                )[0]
                for host, off in (
                    (openings[i], centres[1] - centres[0]),
                    (one, centres[0] - centres[1]),
                )
            )
            if gap < plate.thickness or nested:
                findings.append(
                    error(
                        "openings-overlap",
                        member,
                        f"it overlaps or comes too close to {cuts[i].source} (plate {plate.mark})",
                        "move one of them",
                        position=cuts[j].source,
                        value=0.0 if nested else gap,
                        limit=plate.thickness,
                        unit="mm",
                    )
                )
    return findings


def flat_holes(plate: Plate, pattern) -> tuple[tuple[FlatHole, ...], float]:
    """The openings in the pattern (`pattern.Pattern`), and their area there."""
    holes, total = [], 0.0
    for opening in plate.openings:
        runs = tuple(pattern.flat(run[:, 0], run[:, 1]) for run in opening.runs)
        ring = np.concatenate([run[:-1] for run in runs])
        following = np.roll(ring, -1, axis=0)
        turn = (ring[:, 0] * following[:, 1] - ring[:, 1] * following[:, 0]).sum()
        if turn < 0.0:
            runs = tuple(run[::-1] for run in reversed(runs))
        area = _flat_area(plate, opening, pattern.development)
        total += area
        holes.append(FlatHole(opening.label, opening.title, runs, fitted_circle(ring), area))
    return tuple(holes), total


def _flat_area(plate: Plate, opening: PlateOpening, development: Development) -> float:
    """Area in the pattern, by the Jacobian of the flat map over that of the prism's section."""
    s, w = opening.nodes[:, 0].copy(), opening.nodes[:, 1].copy()
    flat_s, flat_w = development.jacobian(s, w)
    by_s, by_w = rates(plate.rails.mid, s, w)
    x, y = opening.spot.x, opening.spot.y
    spread = (by_s * x).sum(axis=1) * (by_w * y).sum(axis=1)
    spread = spread - (by_w * x).sum(axis=1) * (by_s * y).sum(axis=1)
    flat = flat_s[:, 0] * flat_w[:, 1] - flat_s[:, 1] * flat_w[:, 0]
    return float((opening.weights * np.abs(flat / spread)).sum())


def fitted_circle(points: np.ndarray) -> tuple[float, float, float] | None:
    """u, v and diameter of the circle within CIRCLE_TOLERANCE of all points (n, 2), or None."""
    middle = points.mean(axis=0)
    for _ in range(3):
        off = points - middle
        radius = np.sqrt((off * off).sum(axis=1))
        unit = off / radius[:, None]
        # Least squares of the radii: for points all round, the normal matrix is diagonal.
        middle = middle + 2.0 * ((radius - radius.mean())[:, None] * unit).mean(axis=0)
    off = points - middle
    radius = np.sqrt((off * off).sum(axis=1))
    mean = 0.5 * (radius.max() + radius.min())
    if radius.max() - mean > CIRCLE_TOLERANCE:
        return None
    return float(middle[0]), float(middle[1]), float(2.0 * mean)
