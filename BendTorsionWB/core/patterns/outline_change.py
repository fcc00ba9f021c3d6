# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far two flat outlines differ in their best alignment, and whether one can be cut from the
other.

Both are linear programmes in a small rigid motion, repeated until the motion is done: the signed
distance of a point from an outline changes by its normal times the motion of the point.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import cKDTree

SAMPLE = 5.0
"""mm; least distance of the points compared."""
MOST_SAMPLES = 400
"""Points compared of a large outline, besides its vertices."""
SAME = 0.02
"""mm; outlines closer than this are cut the same: the contour of a cut file is no closer."""
MISSING = 0.1
"""mm; material that may be missing where a plate is cut from another."""
CLOSER = 2e-5
"""mm; how much more than at the best place may be missing where less comes off: edges of a slowly
changing bow would slide by decimetres for a hundredth."""
ROUNDS = 12
SIDES = ("E-1", "E-2", "lower edge", "upper edge")
PREFERENCE = (1.003, 1.0, 1.002, 1.001)
"""What comes off at a side counts by this: where two sides would do, the one is taken."""


@dataclass(frozen=True)
class Trim:
    """What a plate already cut needs to become another. missing: mm of material it lacks at worst;
    sides: (name, mm) of what comes off, empty when it can stay as it is; turn (rad) and shift (mm):
    how the new plate is laid into the old one."""

    missing: float
    sides: tuple[tuple[str, float], ...] = ()
    turn: float = 0.0
    shift: tuple[float, float] = (0.0, 0.0)

    def laid(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the new plate where they lie in the old one."""
        return _turned(points, self.turn) + self.shift

    @property
    def possible(self) -> bool:
        """Whether the new plate can be cut from the old one."""
        return self.missing <= MISSING


def apart(before: np.ndarray, after: np.ndarray) -> float:
    """Largest distance, mm, between two closed outlines (n, 2), (m, 2) as they lie, both ways."""
    _, gaps, _ = _distances(_dense(after), _dense(before))
    return float(np.abs(gaps).max())


def deviation(before: np.ndarray, after: np.ndarray) -> float:
    """Largest distance, mm, between two closed outlines (n, 2), (m, 2) where they lie best on each
    other: both ways, least over all rigid motions."""
    if before.shape == after.shape and np.array_equal(before, after):
        return 0.0
    old, new = _dense(before), _centred(_dense(after), before)
    best = np.inf
    for _ in range(ROUNDS):
        rows, gaps, _ = _distances(new, old)
        largest = float(np.abs(gaps).max())
        if largest > best - 1e-4 * SAME:
            break
        best = largest
        # Least D with |gap + row · motion| <= D.
        columns = np.column_stack([rows, -np.ones(len(rows))])
        other = np.column_stack([-rows, -np.ones(len(rows))])
        motion = _solved(np.vstack([columns, other]), np.concatenate([-gaps, gaps]), [0, 0, 0, 1])
        new = _moved(new, motion[:3])
    return best


def trim(before: np.ndarray, after: np.ndarray, end_first: bool = False) -> Trim:
    """Whether the outline `after` can be cut from a plate of outline `before`, and the least that
    comes off at each side. Of places where it would do, those are taken where no more than at the
    best is missing: edges that stay as they are lie on each other, marks on the plate hold, and
    what comes off does so at the side that moved. end_first: whether the end of the plate (E-2)
    lies at the lower u."""
    start = _dense(after, True)
    old, new = _dense(before, True), _centred(start, before)
    missing = np.inf
    for _ in range(ROUNDS):
        rows, gaps, of_new = _distances(new, old)
        worst = float(gaps[of_new].max())
        if worst > missing - 1e-4 * SAME:
            break
        missing, best = worst, new
        columns = np.column_stack([rows[of_new], -np.ones(of_new.sum())])
        motion = _solved(columns, -gaps[of_new], [0, 0, 0, 1], lowest=-1e3)
        new = _moved(new, motion[:3])
    if missing > MISSING:
        return Trim(missing)
    sides, missing = _sides(old, end_first), max(missing, 0.0)
    off, laid = _least(best, old, sides, missing + CLOSER, PREFERENCE)
    # What is a sliver at one side comes off with the rest at the other.
    weights = [1.0 if off[k] >= off[k ^ 1] else 1.01 for k in range(len(SIDES))]
    off, laid = _least(laid, old, sides, missing + 0.1 * SAME, weights)
    sides_off = tuple((name, float(mm)) for name, mm in zip(SIDES, off) if mm > 2.0 * MISSING)
    turn = _turn(start, laid)
    shift = laid.mean(axis=0) - _turned(start, turn).mean(axis=0)
    return Trim(missing, sides_off, turn, (float(shift[0]), float(shift[1])))


def _least(new: np.ndarray, old: np.ndarray, sides: np.ndarray, slack: float, weights: Sequence):
    """What comes off at each of SIDES, mm, where the sum by weights is least and no more than slack
    is missing; and the outline as it lies then. sides: of the points of old."""
    plain, least, off, laid = ~_corners(old), np.inf, [0.0] * len(SIDES), new
    for _ in range(ROUNDS):
        rows, gaps, of_new = _distances(new, old)
        depth, facing = -gaps[~of_new], plain & _facing(old, new)
        now = [depth[facing & (sides == k)].max(initial=0.0) for k in range(len(SIDES))]
        if gaps[of_new].max() <= slack + SAME and np.dot(now, weights) < least - 0.01 * MISSING:
            least, off, laid = np.dot(now, weights), now, new
        # New points stay inside the old plate; old points of a side reach out by its trim at most.
        inside = np.column_stack([rows[of_new], np.zeros((of_new.sum(), len(SIDES)))])
        own = -(sides[facing, None] == np.arange(len(SIDES))).astype(float)
        reach = np.column_stack([-rows[~of_new][facing], own])
        motion = _solved(
            np.vstack([inside, reach]),
            np.concatenate([np.maximum(slack - gaps[of_new], 0.0), -depth[facing]]),
            [0, 0, 0, *weights],
        )
        new = _moved(new, motion[:3])
        if np.abs(motion[:3]).max() < 0.01 * SAME:
            break
    return off, laid


def _turn(before: np.ndarray, after: np.ndarray) -> float:
    """The angle, rad, points were turned by that keep their distances."""
    one, other = before - before.mean(axis=0), after - after.mean(axis=0)
    across = (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum()
    return float(np.arctan2(across, (one * other).sum()))


def _turned(points: np.ndarray, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack(
        [c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]]
    )


def _solved(matrix, bounds, cost: Sequence[float], lowest: float = 0.0) -> np.ndarray:
    reach = [(-200.0, 200.0)] * 3 + [(lowest, None)] * (len(cost) - 3)
    found = linprog(cost, A_ub=matrix, b_ub=bounds, bounds=reach, method="highs")
    return found.x if found.status == 0 else np.zeros(len(cost))


def _distances(new: np.ndarray, old: np.ndarray):
    """Rows (k, 3) and gaps (k,) of the points of both outlines against the other one: the signed
    distance, outside positive, is gap + row · motion of `new`; for points of `old` both are
    negative, so that an old point outside the new outline has a negative gap. of_new (k,): which
    are points of `new`."""
    centre, lever = new.mean(axis=0), np.ptp(new, axis=0).max() / 2.0
    out, normal, foot = _signed(new, old)
    back, other, foot = _signed(old, new)
    rows = np.vstack([_row(normal, new, centre, lever), _row(other, foot, centre, lever)])
    of_new = np.arange(len(rows)) < len(new)
    return rows, np.concatenate([out, -back]), of_new


def _row(normal: np.ndarray, at: np.ndarray, centre: np.ndarray, lever: float) -> np.ndarray:
    arm = (at - centre) / lever
    return np.column_stack([normal, normal[:, 1] * arm[:, 0] - normal[:, 0] * arm[:, 1]])


def _moved(points: np.ndarray, motion: np.ndarray) -> np.ndarray:
    centre, lever = points.mean(axis=0), np.ptp(points, axis=0).max() / 2.0
    angle = motion[2] / lever
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return (points - centre) @ turn + centre + motion[:2]


def _signed(points: np.ndarray, outline: np.ndarray):
    """Signed distance (n,) of points from a closed dense outline, outside positive; its gradient
    (n, 2); the nearest points (n, 2)."""
    along = np.roll(outline, -1, axis=0) - outline
    lengths = np.linalg.norm(along, axis=1)
    outward = np.column_stack([along[:, 1], -along[:, 0]]) / lengths[:, None]
    outward *= np.sign(_area(outline))
    _, near = cKDTree(outline).query(points, k=min(3, len(outline)))
    candidates = np.concatenate([near, near - 1], axis=1) % len(outline)
    start, edge = outline[candidates], along[candidates]
    squared = lengths[candidates] ** 2
    share = np.clip(((points[:, None] - start) * edge).sum(axis=2) / squared, 0.0, 1.0)
    feet = start + share[..., None] * edge
    distance = np.linalg.norm(points[:, None] - feet, axis=2)
    index, best = np.arange(len(points)), distance.argmin(axis=1)
    size, foot, at = distance[index, best], feet[index, best], candidates[index, best]
    share = share[index, best]
    # At a vertex the mean of both normals tells inside from outside.
    normal = outward[at]
    normal = np.where((share == 0.0)[:, None], normal + outward[at - 1], normal)
    normal = np.where(
        (share == 1.0)[:, None], outward[at] + outward[(at + 1) % len(outline)], normal
    )
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    sign = np.where(((points - foot) * normal).sum(axis=1) < 0.0, -1.0, 1.0)
    clear = size > 1e-6
    away = (points - foot) / np.where(clear, sign * size, 1.0)[:, None]
    return sign * size, np.where(clear[:, None], away, normal), foot


def _facing(old: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Which points (n,) of the old outline lie straight across from the new one: those beyond its
    corners belong to what comes off at the next side."""
    _, _, foot = _signed(old, new)
    _, normal, _ = _signed(old, old)
    away = old - foot
    size = np.linalg.norm(away, axis=1)
    return (size < MISSING) | ((away * normal).sum(axis=1) > 0.9 * size)


def _area(outline: np.ndarray) -> float:
    after = np.roll(outline, -1, axis=0)
    return 0.5 * float((outline[:, 0] * after[:, 1] - outline[:, 1] * after[:, 0]).sum())


def _dense(outline: np.ndarray, close: bool = False) -> np.ndarray:
    """The same closed outline with further points on its edges, and none on another.
    close: also beside its vertices."""
    after = np.roll(outline, -1, axis=0)
    lengths = np.linalg.norm(after - outline, axis=1)
    spacing = max(SAMPLE, float(lengths.sum()) / MOST_SAMPLES)
    outline = outline[lengths > 1e-6]
    after = np.roll(outline, -1, axis=0)
    along = after - outline
    lengths = np.linalg.norm(along, axis=1)
    counts = np.maximum(1, np.ceil(lengths / spacing)).astype(int)
    edge = np.repeat(np.arange(len(outline)), counts)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[edge]
    if close:
        # A hair from the vertices, where a side is deepest but its corner belongs to two.
        (long,) = np.nonzero(lengths > 2.0 * SAMPLE)
        hair = 0.1 / lengths[long]
        edge, share = np.concatenate([edge, long, long]), np.concatenate([share, hair, 1.0 - hair])
        order = np.lexsort([share, edge])
        edge, share = edge[order], share[order]
    return outline[edge] + along[edge] * share[:, None]


def _corners(outline: np.ndarray) -> np.ndarray:
    """Which points (n,) of a dense outline are sharp corners; those belong to no side."""
    along = np.roll(outline, -1, axis=0) - outline
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    return (along * np.roll(along, 1, axis=0)).sum(axis=1) < np.cos(np.radians(20.0))


def _centred(points: np.ndarray, on: np.ndarray) -> np.ndarray:
    def middle(outline):
        return 0.5 * (outline.min(axis=0) + outline.max(axis=0))

    return points + middle(on) - middle(points)


def _sides(outline: np.ndarray, end_first: bool) -> np.ndarray:
    """The side (index of SIDES) each point of an outline lies on, by its outward normal."""
    _, normal, _ = _signed(outline, outline)
    ends = (1, 0) if end_first else (0, 1)
    across = np.abs(normal[:, 0]) > np.abs(normal[:, 1])
    end = np.where(normal[:, 0] < 0.0, ends[0], ends[1])
    return np.where(across, end, np.where(normal[:, 1] < 0.0, 2, 3))
