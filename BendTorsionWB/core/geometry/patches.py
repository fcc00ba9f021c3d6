# SPDX-License-Identifier: LGPL-2.1-or-later
"""A surface of NURBS patches, oriented outwards as a whole."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components, minimum_spanning_tree
from scipy.spatial import cKDTree

from .nurbs import NurbsPatch
from .patch_trim import inside, trim_border, trim_gap
from .surface import AMBIGUITY, Foot, Surface

# A point held by the border is past it when it is this far from the surface's normal there, mm.
PAST_BORDER = 0.01
# Feet on two patches nearer than this, relative to the surface's size, are one place.
_SAME_PLACE = 1e-8
# Normals of two patches at one place that differ by more (rad) make a crease.
CREASE = 1e-3
_NEIGHBOURS = 12
_BORDER_SAMPLES = 33


@dataclass(frozen=True, eq=False)
class PatchSurface(Surface):
    """One or more NURBS patches as one surface.

    Normals are made consistent over patches that share borders, whatever the patches' own senses
    and parameter directions, then turned outwards: Σ n·(x − centroid) dA > 0; where that is below
    1e-3 of size × area, n_z > 0, then n_x, n_y. Each connected group is turned by itself. A foot
    beyond the wires of a trimmed patch is still exact, but it is `outside`, and a patch that has
    the foot inside its wires goes before it.
    """

    patches: tuple[NurbsPatch, ...]

    @cached_property
    def size(self) -> float:
        """Largest extent of the poles, mm."""
        low = np.min([patch.poles.min((0, 1)) for patch in self.patches], axis=0)
        high = np.max([patch.poles.max((0, 1)) for patch in self.patches], axis=0)
        return float((high - low).max())

    @cached_property
    def signs(self) -> np.ndarray:
        """+1 or -1 per patch: turns its normals outwards."""
        signs, groups = self._consistent()
        for group in range(groups.max() + 1):
            members = np.flatnonzero(groups == group)
            areas = [_trimmed_area(self.patches[k]) for k in members]
            element = np.concatenate([area[0] for area in areas])
            points = np.concatenate([area[1] for area in areas])
            normals = np.concatenate(
                [signs[k] * area[2] for k, area in zip(members, areas, strict=True)]
            )
            total = element.sum()
            flux = normals * element[:, None]
            size = np.ptp(points, axis=0).max()
            centred = points - (points * element[:, None]).sum(0) / total
            measure = (flux * centred).sum()
            if abs(measure) < 1e-3 * size * total:
                sums = flux.sum(0)[[2, 0, 1]]
                clear = np.flatnonzero(np.abs(sums) > 1e-6 * total)
                measure = sums[clear[0]] if len(clear) else measure
            if measure < 0:
                signs[members] *= -1
        return signs

    def _consistent(self) -> tuple[np.ndarray, np.ndarray]:
        """Signs that agree over shared borders, and the connected group of each patch.

        Along a shared border (direction e) two patches agree when e, the direction into the patch
        and the normal have opposite hands; this holds at any angle between them. Borders are
        compared by samples: the longest common borders decide.
        """
        number = len(self.patches)
        if number == 1:
            return np.ones(1), np.zeros(1, int)
        owner, points, along, into, normals, reach = self._borders()
        if not len(points):
            return np.ones(number), np.arange(number)
        tree = cKDTree(points)
        distance, other = tree.query(points, k=min(_NEIGHBOURS, len(points)))
        votes = np.zeros((number, number))
        unit = along / np.linalg.norm(along, axis=1)[:, None]
        # Side of each sample's own frame, and of the matched one's against the same direction.
        hand = np.sign(np.einsum("ij,ij->i", np.cross(unit, into), normals))
        for k in range(other.shape[1]):
            match = other[:, k]
            near = (owner != owner[match]) & (distance[:, k] <= 0.75 * reach)
            mine, theirs = np.flatnonzero(near), match[near]
            parallel = np.einsum("ij,ij->i", unit[mine], unit[theirs])
            agree = -hand[mine] * hand[theirs] * np.sign(parallel) * parallel**2
            close = 1 - distance[mine, k] / reach[mine]
            np.add.at(votes, (owner[mine], owner[theirs]), agree * close)
        votes += votes.T
        rows, columns = np.nonzero(np.abs(votes) > 1.0)
        strength = np.abs(votes[rows, columns])
        graph = coo_matrix((1.0 / strength, (rows, columns)), shape=(number, number)).tocsr()
        count, groups = connected_components(graph, directed=False)
        best = minimum_spanning_tree(graph)
        signs = np.ones(number)
        for group in range(count):
            start = int(np.flatnonzero(groups == group)[0])
            order, before = breadth_first_order(best, start, directed=False)
            for patch in order[1:]:
                signs[patch] = signs[before[patch]] * np.sign(votes[before[patch], patch])
        return signs, groups

    def _borders(self) -> tuple[np.ndarray, ...]:
        """Border samples of all patches: owner, point, along, into, normal, spacing."""
        parts = []
        for k, patch in enumerate(self.patches):
            for border in _sides(patch):
                points, along, into, normals = border
                if len(points) < 2:
                    continue
                spacing = np.linalg.norm(np.gradient(points, axis=0), axis=1)
                sound = np.linalg.norm(along, axis=1) > 0
                parts.append(
                    (
                        np.full(sound.sum(), k),
                        points[sound],
                        along[sound],
                        into[sound],
                        normals[sound],
                        spacing[sound],
                    )
                )
        if not parts:
            empty = np.zeros((0, 3))
            return np.zeros(0, int), empty, empty, empty, empty, np.zeros(0)
        return tuple(np.concatenate(part) for part in zip(*parts, strict=True))

    @cached_property
    def _starts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, cKDTree]:
        samples = [patch.samples for patch in self.patches]
        owner = np.repeat(np.arange(len(samples)), [len(sample[0]) for sample in samples])
        u, v, points, reach = (np.concatenate(part) for part in zip(*samples, strict=True))
        return owner, u, v, reach, cKDTree(points)

    def closest(self, points: np.ndarray) -> Foot:
        """Closest points to points (n, 3) mm.

        Newton from the nearest sample; then from the nearest sample of every other patch, and of
        every other part of the same patch, that may still hold a nearer point.
        """
        points = np.asarray(points, float).reshape(-1, 3)
        owner, u, v, reach, tree = self._starts
        count = min(_NEIGHBOURS, len(owner))
        near, which = tree.query(points, k=np.arange(1, count + 1))
        best = _Best(self, points)
        best.improve(np.arange(len(points)), which[:, 0])
        used = np.zeros(which.shape, bool)
        used[:, 0] = True
        for k in range(1, count):
            rows = np.flatnonzero(near[:, k] - reach[which[:, k]] < best.distance)
            rows = rows[self._may_hold(points[rows], which[rows, k], best.distance[rows])]
            for earlier in range(k):
                # A start beside one already used on the same patch leads to the same foot.
                mine, theirs = which[rows, k], which[rows, earlier]
                gap = np.linalg.norm(tree.data[mine] - tree.data[theirs], axis=1)
                beside = (owner[mine] == owner[theirs]) & (gap <= 2 * reach[theirs])
                rows = rows[~(beside & used[rows, earlier])]
            used[rows, k] = True
        used[:, 0] = False
        rows, ranks = np.nonzero(used)
        best.improve(rows, which[rows, ranks])
        if len(self.patches) > 1:
            self._leave_borders(best)
        return best.foot()

    def _leave_borders(self, best: _Best) -> None:
        """Try every patch within reach for the points that are held by a border."""
        rows = np.flatnonzero(best.astray())
        if not len(rows):
            return
        *_, reach, _ = self._starts
        first = 0
        for patch, tree in zip(self.patches, self._trees, strict=True):
            near, which = tree.query(best.points[rows])
            wanted = near - reach[first + which] < best.distance[rows]
            best.improve(rows[wanted], first + which[wanted])
            first += len(patch.samples[0])

    @cached_property
    def _cells(self) -> tuple[np.ndarray, ...]:
        """Of each start's cell: two directions, half widths along them, and a margin."""
        return tuple(
            np.concatenate(part)
            for part in zip(*(_flat_cells(patch) for patch in self.patches), strict=True)
        )

    def _may_hold(self, points, starts, distance) -> np.ndarray:
        """Whether the cells of `starts` may hold points nearer than `distance`: by the distance to
        a flat rectangle that covers the cell but for its curvature."""
        first, second, wide, high, margin = (part[starts] for part in self._cells)
        away = points - self._starts[4].data[starts]
        along, across = (away * first).sum(axis=1), (away * second).sum(axis=1)
        up = np.maximum((away * away).sum(axis=1) - along**2 - across**2, 0.0)
        beyond = np.maximum(np.abs(along) - wide, 0.0) ** 2
        beside = np.maximum(np.abs(across) - high, 0.0) ** 2
        return np.sqrt(up + beyond + beside) - margin < distance

    @cached_property
    def _trees(self) -> list[cKDTree]:
        return [cKDTree(patch.samples[2]) for patch in self.patches]


def _sides(patch: NurbsPatch) -> list[tuple[np.ndarray, ...]]:
    """Samples of the borders of a patch: its four sides, inside the wires, and its wires."""
    sides = []
    for side in range(4):
        if patch.closed[side // 2] or patch.degenerate.flat[side]:
            continue
        kept = inside(patch, *patch.side(side, _BORDER_SAMPLES))
        sides.append(tuple(part[kept] for part in patch.border(side, _BORDER_SAMPLES)))
    return sides if patch.trim is None else [*sides, trim_border(patch, 4 * _BORDER_SAMPLES)]


def _flat_cells(patch: NurbsPatch) -> tuple[np.ndarray, ...]:
    """Two unit directions (m, 3) in the tangent plane at each sample, half widths along them of a
    rectangle that covers the cell's parallelogram, and a margin for curvature, all (m,)."""
    u, v, _, reach = patch.samples
    half_u, half_v = patch.half_cells
    _, su, sv, *_ = patch.evaluate(u, v)
    along, across = su * half_u[:, None], sv * half_v[:, None]
    size = np.linalg.norm(along, axis=1)
    first = along / np.maximum(size, 1e-300)[:, None]
    lean = (across * first).sum(axis=1)
    rest = across - lean[:, None] * first
    high = np.linalg.norm(rest, axis=1)
    second = rest / np.maximum(high, 1e-300)[:, None]
    return first, second, size + np.abs(lean), high, 0.2 * reach


def _trimmed_area(patch: NurbsPatch) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Area elements, points and normals inside the wires (the whole patch for the thinnest)."""
    kept = inside(patch, *patch.samples[:2])
    return tuple(part[kept] for part in patch.area) if kept.any() else patch.area


class _Best:
    """The nearest feet found so far; distance: to the foot, or to the border short of it."""

    def __init__(self, surface: PatchSurface, points: np.ndarray):
        self.surface = surface
        self.points = points
        number = len(points)
        self.feet = np.zeros((number, 3))
        self.normals = np.zeros((number, 3))
        self.distance = np.full(number, np.inf)
        self.ambiguous = np.zeros(number, bool)
        self.bound = np.zeros(number, bool)
        self.gap = np.zeros(number)

    def improve(self, rows: np.ndarray, starts: np.ndarray) -> None:
        """Refine the points `rows` from the samples `starts`; keep what is nearer."""
        owner, u, v, *_ = self.surface._starts
        for patch in np.unique(owner[starts]):
            chosen = owner[starts] == patch
            mine, begin = rows[chosen], starts[chosen]
            place_u, place_v, feet, normals, focal, bound = self.surface.patches[patch].refine(
                self.points[mine], u[begin], v[begin]
            )
            gap = trim_gap(self.surface.patches[patch], place_u, place_v, feet)
            normals = self.surface.signs[patch] * normals
            # A point with several starts is merged once per start.
            left = np.arange(len(mine))
            while len(left):
                _, once = np.unique(mine[left], return_index=True)
                pick = left[once]
                self._merge(
                    mine[pick], feet[pick], normals[pick], focal[pick], bound[pick], gap[pick]
                )
                left = np.delete(left, once)

    def astray(self) -> np.ndarray:
        """Points held by a border that are beside the normal there, or past the wires (n,)."""
        residual = self.points - self.feet
        signed = np.einsum("ij,ij->i", residual, self.normals)
        slip = np.linalg.norm(residual - signed[:, None] * self.normals, axis=1)
        return (self.bound & (slip > PAST_BORDER)) | (self.gap > PAST_BORDER)

    def _merge(self, rows, feet, normals, focal, bound, gap) -> None:
        size = self.surface.size
        residual = self.points[rows] - feet
        # A foot beyond the wires stands for the border, which is about this far.
        distance = np.hypot(np.linalg.norm(residual, axis=1), gap)
        apart = np.linalg.norm(feet - self.feet[rows], axis=1)
        tie = np.abs(distance - self.distance[rows]) <= AMBIGUITY * size
        same = tie & (apart <= _SAME_PLACE * size)
        # Two feet at one place meet on a common border. On a crease the point belongs there when
        # it lies between the two normals; elsewhere it must lie on the normal as everywhere.
        across = np.cross(normals, self.normals[rows])
        turned = np.linalg.norm(across, axis=1)
        crease = same & (turned > CREASE)
        astray = np.abs((residual * across).sum(1)) > PAST_BORDER * turned
        self.bound[rows[same]] &= bound[same]
        self.gap[rows[same]] = np.minimum(self.gap[rows[same]], gap[same])
        self.bound[rows[crease & ~astray]] = False
        rival = tie & (apart > 1e-6 * size)
        nearer = (distance < self.distance[rows]) & ~same
        new = rows[nearer]
        self.feet[new] = feet[nearer]
        self.normals[new] = normals[nearer]
        self.distance[new] = distance[nearer]
        self.bound[new] = bound[nearer]
        self.gap[new] = gap[nearer]
        self.ambiguous[new] = focal[nearer]
        self.ambiguous[rows[crease | rival]] = True

    def foot(self) -> Foot:
        residual = self.points - self.feet
        signed = np.einsum("ij,ij->i", residual, self.normals)
        return Foot(self.feet, self.normals, signed, self.ambiguous, self.astray())
