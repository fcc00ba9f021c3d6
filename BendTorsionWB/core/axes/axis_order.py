# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points in order: shuffled segments chained by their ends, bare points by nearest neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, note, warning
from ..geometry.curve import Curve
from ..geometry.curve_edit import joined, turned
from .axis_check import check_coordinates, place

CHAIN_TOLERANCE = 1.0
"""mm: ends of segments closer than this are one place."""
CURVES_MEET = 0.01
"""mm: the same for exact curves, whose ends are then one pole."""
AMBIGUOUS = 1.15
"""Another order no longer than this times the shortest, and no more bent, makes doubt."""
SAME_BEND = np.radians(60.0)
"""Orders whose polygons turn by this much more, in all, are not as good."""
_MOST_RIVALS = 200
MOST_TOLD = 20
"""Branches and chains told one by one; of more, how many there are."""
SEGMENTS_TOLD = 6
"""Segments of a branch that are named."""
MOST_POINTS = 1000
"""Bare points: their time grows with the third power of their number."""
LEVEL = 1.0
"""mm: ends whose heights differ by less are level."""


@dataclass(frozen=True, eq=False)
class Chain:
    """Points (k, 3) in order; order: per point (bare points) or per segment, its index as given;
    turned: per segment, whether it runs backwards; closed: the last end meets the first."""

    points: np.ndarray
    order: np.ndarray
    turned: np.ndarray
    closed: bool
    findings: tuple[Finding, ...]


def chain_segments(
    name: str, segments: tuple[np.ndarray, ...], tolerance: float = CHAIN_TOLERANCE
) -> Chain:
    """Polylines (m, 3) in any order and direction as one run of points.

    Ends within `tolerance` mm are one place (their mean when they differ). The chain starts at
    the free end that comes first in the input, in the direction that keeps that segment's own;
    a ring starts at the first segment. Segments given twice are left out and reported. Raises
    BendTorsionError, naming places, for branches and for gaps, with the width of each gap.
    """
    given = [np.asarray(segment, float).reshape(-1, 3) for segment in segments]
    left_out: dict[int, Finding] = {}
    index = []
    for k, part in enumerate(given):
        check_coordinates(name, part, f"segment {k + 1}")
        if len(part) < 2 or np.ptp(part, axis=0).max() <= tolerance:
            left_out[k] = note(
                "axis-segment-short",
                name,
                "segment has no length: left out",
                position=f"segment {k + 1}",
            )
        else:
            index.append(k)
    if not index:
        raise BendTorsionError(
            error(
                "axis-too-few-points",
                name,
                "no segment with any length",
                "add segments",
                value=len(given),
                limit=1,
            )
        )
    ends = np.array([[given[k][0], given[k][-1]] for k in index])
    node = _places(ends.reshape(-1, 3), tolerance).reshape(-1, 2)
    twins = _twins([given[k] for k in index], node, tolerance)
    for k, first in twins.items():
        twin = index[first]
        left_out[index[k]] = note(
            "axis-segment-twice",
            name,
            f"segment repeats segment {twin + 1}: left out",
            position=f"segment {index[k] + 1}",
        )
    single = [k for k in range(len(index)) if k not in twins]
    ends, node = ends[single], node[single]
    index = [index[k] for k in single]
    parts = [given[k] for k in index]
    degree = np.bincount(node.ravel())
    problems = _branches(name, node, degree, ends, index)
    runs = [] if problems else _runs(node, degree)
    if len(runs) > 1:
        problems = _gaps(name, runs, ends, index, tolerance)
    if problems:
        raise BendTorsionError(problems)
    (run,) = runs
    (first, first_back), (last, last_back) = run[0], run[-1]
    closed = bool(node[first, int(first_back)] == node[last, int(not last_back)])
    points: list[np.ndarray] = []
    for segment, back in run:
        part = parts[segment][::-1] if back else parts[segment]
        if points:
            part = np.vstack([0.5 * (points[-1][-1:] + part[:1]), part[1:]])
            points[-1] = points[-1][:-1]
        points.append(part)
    chained = np.vstack(points)
    if closed:
        chained = chained[:-1]
    return Chain(
        chained,
        np.array([index[k] for k, _ in run]),
        np.array([back for _, back in run]),
        closed,
        tuple(left_out[k] for k in sorted(left_out)),
    )


def chain_curves(
    name: str, curves: tuple[Curve, ...], tolerance: float = CURVES_MEET
) -> tuple[Curve, tuple[Finding, ...]]:
    """Exact curves in any order and direction as one, joined end to end as chain_segments does."""
    if len(curves) == 1:
        return curves[0], ()
    ends = tuple(
        curve.evaluate(np.array([curve.domain[0], np.mean(curve.domain), curve.domain[1]]))[0]
        for curve in curves
    )
    chain = chain_segments(name, ends, tolerance)
    return joined(
        [
            turned(curves[k]) if back else curves[k]
            for k, back in zip(chain.order, chain.turned, strict=True)
        ]
    ), chain.findings


def chain_points(name: str, points: np.ndarray, closed: bool = False) -> Chain:
    """Bare points (k, 3) in the order of the shortest nearest-neighbour chain over all starts.

    The chain runs in the direction in which the earlier given of its ends comes first; a ring
    starts at the first point given. Points given twice are left out and reported; a warning when
    another order is nearly as short. Raises BendTorsionError for more than MOST_POINTS.
    """
    given = np.asarray(points, float).reshape(-1, 3)
    if len(given) > MOST_POINTS:
        raise BendTorsionError(
            error(
                "axis-too-many-points",
                name,
                "bare points are too many to find their order",
                "draw a polyline through them, or number them",
                value=len(given),
                limit=MOST_POINTS,
            )
        )
    check_coordinates(name, given, "point", range(1, len(given) + 1))
    node = _places(given, tolerances.POINTS_COINCIDE)
    _, first = np.unique(node, return_index=True)
    kept = np.sort(first)
    findings = [
        note(
            "axis-point-twice",
            name,
            f"point repeats point {int(np.flatnonzero(node == node[k])[0]) + 1}: left out",
            position=f"point {k + 1}",
        )
        for k in np.setdiff1d(np.arange(len(given)), kept)
    ]
    distance = np.linalg.norm(given[kept][:, None] - given[kept][None], axis=2)
    paths, lengths = _nearest_chains(distance, closed)
    best = int(np.argmin(lengths))
    path = paths[best]
    rival, rival_length = _rival(given[kept], distance, paths, lengths, best, closed)
    if rival is not None:
        where = int(np.flatnonzero(rival != path)[0])
        findings.append(
            warning(
                "axis-order-ambiguous",
                name,
                "the points can be put in order in another way that is nearly as short",
                "number the points, or add some where the order is unclear",
                position=f"point {kept[path[where]] + 1} {place(given[kept[path[where]]])}",
                value=float(rival_length / lengths[best]),
                limit=AMBIGUOUS,
            )
        )
    if closed:
        path = np.roll(path, -int(np.argmin(path)))
        if len(path) > 2 and path[-1] < path[1]:
            path = np.concatenate([path[:1], path[:0:-1]])
    elif path[-1] < path[0]:
        path = path[::-1]
    order = kept[path]
    return Chain(given[order], order, np.zeros(len(order), bool), closed, tuple(findings))


def rule_turns(axis) -> bool:
    """Whether the direction rule turns this axis.

    Open: low end to high; level: −x to +x; then −y to +y. Closed: counter-clockwise seen from
    above.
    """
    if axis.closed:
        x, y = axis.position(np.linspace(0.0, axis.length, 400)).T[:2]
        return bool(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) < 0)
    start, end = axis.position(np.array([0.0, axis.length]))
    for component in (2, 0, 1):
        if abs(end[component] - start[component]) > LEVEL:
            return bool(end[component] < start[component])
    return False


def _same(first: np.ndarray, second: np.ndarray, tolerance: float) -> bool:
    if first.shape != second.shape:
        return False
    return min(np.abs(first - second).max(), np.abs(first - second[::-1]).max()) <= tolerance


def _places(points: np.ndarray, tolerance: float) -> np.ndarray:
    """Number of the place (n,) of each point; points within tolerance share one."""
    tree = cKDTree(points)
    place_of = np.full(len(points), -1)
    count = 0
    for k, point in enumerate(points):
        if place_of[k] < 0:
            near = np.array(tree.query_ball_point(point, tolerance))
            place_of[near[place_of[near] < 0]] = count
            count += 1
    return place_of


def _twins(parts: list[np.ndarray], node: np.ndarray, tolerance: float) -> dict[int, int]:
    """By segment, the earlier one it repeats, among those between the same two places."""
    between: dict[tuple[int, int], list[int]] = {}
    twins = {}
    for k, (a, b) in enumerate(node.tolist()):
        others = between.setdefault((min(a, b), max(a, b)), [])
        # More than two make a branch, whether some of them are twins or not.
        if len(others) > 2:
            continue
        twin = next((j for j in others if _same(parts[k], parts[j], tolerance)), None)
        if twin is None:
            others.append(k)
        else:
            twins[k] = twin
    return twins


def _branches(name, node, degree, ends, index) -> list[Finding]:
    mend = "leave out the segments of the other branch"
    branches = np.flatnonzero(degree > 2)
    if len(branches) > MOST_TOLD:
        row, side = np.argwhere(node == branches[0])[0]
        message = f"three segments or more meet at each of {len(branches)} places"
        return [error("axis-branch", name, message, mend, position=place(ends[row, side]))]
    problems = []
    for branch in branches:
        rows, sides = np.nonzero(node == branch)
        numbers = ", ".join(str(index[row] + 1) for row in rows[:SEGMENTS_TOLD])
        if len(rows) > SEGMENTS_TOLD:
            numbers += ", …"
        problems.append(
            error(
                "axis-branch",
                name,
                f"segments {numbers} all meet at one place",
                mend,
                position=place(ends[rows[0], sides[0]]),
                value=int(degree[branch]),
                limit=2,
            )
        )
    return problems


def _runs(node: np.ndarray, degree: np.ndarray) -> list[list[tuple[int, bool]]]:
    """Chains of (segment, turned) over segments (m, 2) whose places have at most two ends."""
    at: dict[int, list[int]] = {}
    for segment, (a, b) in enumerate(node):
        at.setdefault(int(a), []).append(segment)
        at.setdefault(int(b), []).append(segment)
    free = [k for k in range(len(node)) if (degree[node[k]] == 1).any()]
    used: set[int] = set()
    runs = []
    for start in [*free, *range(len(node))]:
        if start in used:
            continue
        back = bool(degree[node[start, 0]] != 1 and degree[node[start, 1]] == 1)
        run, segment = [], start
        while segment is not None:
            run.append((segment, back))
            used.add(segment)
            leaving = int(node[segment, 0 if back else 1])
            segment = next((k for k in at[leaving] if k not in used), None)
            if segment is not None:
                back = bool(node[segment, 0] != leaving)
        runs.append(run)
    return runs


def _gaps(name, runs, ends, index, tolerance) -> list[Finding]:
    """One finding per gap between the chains, at the nearest ends of different chains."""
    tips = []
    for run in runs:
        (first, first_back), (last, last_back) = run[0], run[-1]
        tips.append((ends[first, 1 if first_back else 0], ends[last, 0 if last_back else 1]))
    mend = "close the gap, or leave out what does not belong to the axis"
    if len(runs) > MOST_TOLD:
        message = f"the segments form {len(runs)} chains that do not meet"
        return [error("axis-segment-gap", name, message, mend, position=place(tips[0][1]))]
    joined, problems = {0}, []
    while len(joined) < len(runs):
        gap, inside, outside, side = min(
            (float(np.linalg.norm(tips[a][i] - tips[b][j])), a, b, i)
            for a in joined
            for b in range(len(runs))
            if b not in joined
            for i in (0, 1)
            for j in (0, 1)
        )
        joined.add(outside)
        problems.append(
            error(
                "axis-segment-gap",
                name,
                f"segment {index[runs[inside][-side][0]] + 1} and segment "
                f"{index[runs[outside][0][0]] + 1}'s chain do not meet",
                mend,
                position=place(tips[inside][side]),
                value=gap,
                limit=tolerance,
                unit="mm",
            )
        )
    return problems


def _nearest_chains(distance: np.ndarray, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Nearest-neighbour chain (n, n) from every start, and their lengths (n,)."""
    count = len(distance)
    starts = np.arange(count)
    paths = np.empty((count, count), int)
    paths[:, 0] = starts
    left = np.ones((count, count), bool)
    left[starts, starts] = False
    for k in range(1, count):
        reach = np.where(left, distance[paths[:, k - 1]], np.inf)
        paths[:, k] = np.argmin(reach, axis=1)
        left[starts, paths[:, k]] = False
    lengths = distance[paths[:, :-1], paths[:, 1:]].sum(axis=1)
    if closed:
        lengths = lengths + distance[paths[:, -1], paths[:, 0]]
    return paths, lengths


def _rival(points, distance, paths, lengths, best, closed):
    """Another order nearly as short as the best that bends no more, and its length; (None, 0)
    where there is none.

    Candidates: chains from other starts, the best with a stretch turned (2-opt), and the best
    opened at another link than between its ends. Length alone is no sign: two close points
    swapped cost little, but make the curve turn back twice.
    """
    path, count = paths[best], len(paths)
    if count < 4:
        return None, 0.0
    candidates = [paths[k] for k in np.flatnonzero(lengths < AMBIGUOUS * lengths[best])]
    if not closed:
        candidates += [np.roll(path, -k) for k in range(1, count)]
    i, j = np.triu_indices(count, 1)
    inner = ~((i == 0) & (j == count - 1))
    if closed:
        inner &= (i > 0) & (j < count - 1)
    i, j = i[inner], j[inner]
    before, after = path[i - 1], path[(j + 1) % count]
    change = np.where(closed | (i > 0), distance[before, path[j]] - distance[before, path[i]], 0.0)
    change += np.where(
        closed | (j < count - 1), distance[path[i], after] - distance[path[j], after], 0.0
    )
    near = np.flatnonzero(change < (AMBIGUOUS - 1.0) * lengths[best])
    for k in near[np.argsort(change[near])][:_MOST_RIVALS]:
        turned_over = path.copy()
        turned_over[i[k] : j[k] + 1] = path[i[k] : j[k] + 1][::-1]
        candidates.append(turned_over)
    own, bend = _links(path, closed), _bend(points[path], closed)
    found = (None, AMBIGUOUS * lengths[best])
    for other in candidates:
        length = distance[other[:-1], other[1:]].sum() + closed * distance[other[-1], other[0]]
        if (
            length < found[1]
            and _bend(points[other], closed) < bend + SAME_BEND
            and _links(other, closed) != own
        ):
            found = (other, length)
    return found if found[0] is not None else (None, 0.0)


def _links(order: np.ndarray, closed: bool) -> set[frozenset]:
    pairs = {frozenset(pair) for pair in zip(order[1:].tolist(), order[:-1].tolist(), strict=True)}
    return pairs | {frozenset((int(order[0]), int(order[-1])))} if closed else pairs


def _bend(points: np.ndarray, closed: bool) -> float:
    """Sum of the angles, rad, by which the polygon through points (k, 3) turns."""
    run = np.vstack([points, points[:2]]) if closed else points
    legs = np.diff(run, axis=0)
    legs /= np.linalg.norm(legs, axis=1, keepdims=True)
    return float(np.arccos(np.clip((legs[1:] * legs[:-1]).sum(axis=1), -1.0, 1.0)).sum())
