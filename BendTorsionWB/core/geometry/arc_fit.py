# SPDX-License-Identifier: LGPL-2.1-or-later
"""Smooth curves given by dense points as few circular arcs and lines within a tolerance.

An arc polyline is an (m, 3) array of vertices x, y, bulge; bulge = tan(included angle / 4) of the
arc from the vertex to the next, positive counter-clockwise, 0 a line: the DXF convention.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..finding import BendTorsionError, error

FIT_TOLERANCE = 0.02
"""mm; largest distance of a dense point from the fitted arcs."""

STRAIGHT_SAGITTA = 0.005
"""mm; an arc lower than this is a line, here and in every file: half of what the figures of NC1
tell, and readers that flatten arcs of kilometres of radius lose their way."""

CLOSING_GAP = 1e-6
"""mm; runs of an outline are head to tail within this distance."""

_COINCIDENT = 1e-9  # mm; consecutive points closer than this are one
_LARGEST_TURN = np.radians(170.0)  # an arc stays below 180 degrees, its bulge below 1
_PROBES = 8  # intervals on which the density of arcs is first measured
_TARGET = 0.7  # share of the tolerance aimed at, so that the first partition usually passes
_REPARTITIONS = 5


def fit_outline(
    runs: Sequence[np.ndarray], tolerance: float = FIT_TOLERANCE, name: str = "outline"
) -> np.ndarray:
    """(m, 3) closed arc polyline of smooth runs (k, 2) that lie head to tail; mm.

    Every run's end is a vertex. The first vertex is not repeated. `name` is the object named in
    findings. Raises BendTorsionError when the runs do not close or do not run counter-clockwise.
    """
    return fit_runs(runs, tolerance, name)[0]


def fit_runs(
    runs: Sequence[np.ndarray], tolerance: float = FIT_TOLERANCE, name: str = "outline"
) -> tuple[np.ndarray, np.ndarray]:
    """The outline of `fit_outline`, and (m,) the number of the run each of its arcs belongs to."""
    fitted = [fit_arcs(run, tolerance) for run in runs]
    ends = np.array([arcs[-1, :2] for arcs in fitted])
    heads = np.array([arcs[0, :2] for arcs in fitted])
    gaps = np.linalg.norm(np.roll(heads, -1, axis=0) - ends, axis=1)
    if not gaps.max() <= CLOSING_GAP:
        run = int(np.argmax(gaps)) + 1
        raise BendTorsionError(
            error(
                "outline-open",
                name,
                "the flat outline does not close",
                "report this plate: its outline runs must lie head to tail",
                position=f"end of run {run}",
                value=float(gaps.max()),
                limit=CLOSING_GAP,
                unit="mm",
            )
        )
    outline = np.concatenate([arcs[:-1] for arcs in fitted])
    area = enclosed_area(outline)
    if not area > 0.0:
        raise BendTorsionError(
            error(
                "outline-clockwise",
                name,
                "the flat outline runs clockwise: the pattern is mirrored or empty",
                "check the plate's marking face and its edges",
                value=area,
                limit=0.0,
                unit="mm2",
            )
        )
    return outline, np.repeat(np.arange(len(runs)), [len(arcs) - 1 for arcs in fitted])


def fit_arcs(points: np.ndarray, tolerance: float = FIT_TOLERANCE) -> np.ndarray:
    """(m, 3) arc polyline through the ends of the dense points (k, 2) of one smooth run; mm.

    No point is farther than `tolerance` from it; first and last vertex are the first and last
    point exactly, the last bulge is 0. One line or one arc when that is enough; otherwise biarcs,
    which meet with a common tangent, on intervals of about equal deviation. Arcs lower than
    STRAIGHT_SAGITTA, or a quarter of a tolerance that is tighter, are lines.
    Raises BendTorsionError when fewer than two distinct or non-finite points are given.
    """
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise BendTorsionError(
            error(
                "outline-not-finite", "outline run", "points are not numbers", "give finite points"
            )
        )
    step = np.diff(points, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    if length.size and length.min() <= _COINCIDENT:
        kept = np.concatenate(([True], length > _COINCIDENT))
        last = points[-1]
        points = points[kept]
        points[-1] = last
        step = np.diff(points, axis=0)
        length = np.hypot(step[:, 0], step[:, 1])
    if len(points) < 2:
        raise BendTorsionError(
            error(
                "outline-run-empty", "outline run", "a run needs two points", "give two that differ"
            )
        )
    if len(points) == 2:
        return np.column_stack((points, np.zeros(2)))
    arcs = _fit(points, step, length, tolerance)
    low = min(STRAIGHT_SAGITTA, 0.25 * tolerance)
    lines = _straightened(arcs, low)
    if lines is arcs or deviation(lines, points).max() <= tolerance:
        return lines
    return _straightened(_fit(points, step, length, tolerance - low), low)


def _straightened(arcs: np.ndarray, low: float) -> np.ndarray:
    """An arc polyline with lines for its arcs lower than `low`, itself where it has none."""
    chord = np.hypot(*np.diff(arcs[:, :2], axis=0).T)
    flat = np.append((0.5 * chord * np.abs(arcs[:-1, 2]) < low) & (arcs[:-1, 2] != 0.0), False)
    if not flat.any():
        return arcs
    lines = arcs.copy()
    lines[flat, 2] = 0.0
    return lines


def _fit(points: np.ndarray, step: np.ndarray, length: np.ndarray, tolerance: float) -> np.ndarray:
    """(m, 3) arcs through dense points (k, 2) that are `step` (k - 1, 2), `length` apart."""
    tangent, turn = _tangents(step, length)
    count = max(1, int(np.ceil(_full_turn(turn) / _LARGEST_TURN)))
    if count == 1:
        return _fit_piece(points, tangent, length, tolerance)
    turned = np.cumsum(np.abs(turn))
    cuts = np.searchsorted(turned, turned[-1] * np.arange(1, count) / count) + 1
    bounds = np.unique(np.concatenate(([0], cuts, [len(points) - 1])))
    pieces = [
        _fit_piece(points[a : b + 1], tangent[a : b + 1], length[a:b], tolerance)
        for a, b in zip(bounds[:-1], bounds[1:])
    ]
    return np.concatenate([piece[:-1] for piece in pieces[:-1]] + [pieces[-1]])


def deviation(arcs: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(k,) distance of each point (k, 2) from the nearest place of the open arc polyline; mm."""
    points = np.asarray(points, dtype=float)
    best = np.full(len(points), np.inf)
    for start, end, bulge in zip(arcs[:-1, :2], arcs[1:, :2], arcs[:-1, 2]):
        off, along = _off_arc(points, start, end, bulge)
        to_ends = np.minimum(
            np.linalg.norm(points - start, axis=1), np.linalg.norm(points - end, axis=1)
        )
        best = np.minimum(best, np.where(along, np.abs(off), to_ends))
    return best


def enclosed_area(arcs: np.ndarray) -> float:
    """Signed area within the closed arc polyline, positive counter-clockwise; mm2, exact."""
    point, bulge = arcs[:, :2], arcs[:, 2]
    local = point - point[0]
    after = np.roll(local, -1, axis=0)
    polygon = 0.5 * np.sum(local[:, 0] * after[:, 1] - local[:, 1] * after[:, 0])
    chord2 = np.sum((after - local) ** 2, axis=1)
    return float(polygon + np.sum(chord2 * _segment_factor(bulge)))


def _segment_factor(bulge: np.ndarray) -> np.ndarray:
    """Area between arc and chord over chord squared: (θ - sin θ) / (8 sin²(θ/2)), tan(θ/4) = b."""
    flat = np.abs(bulge) < 1e-3
    b = np.where(flat, 1.0, bulge)
    angle = 4.0 * np.arctan(b)
    steep = (angle - np.sin(angle)) / (8.0 * np.sin(angle / 2.0) ** 2)
    return np.where(flat, bulge / 3.0 + bulge**3 / 15.0, steep)


def _tangents(step: np.ndarray, length: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k, 2) unit tangents at the points, exact on a circle, and (k - 2,) turning angles."""
    along = step / length[:, None]
    a, b = along[:-1], along[1:]
    turn = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])
    before, after = length[:-1], length[1:]
    share = turn * before / (before + after)
    cos, sin = np.cos(share), np.sin(share)
    tangent = np.empty((len(step) + 1, 2))
    tangent[1:-1, 0] = cos * a[:, 0] - sin * a[:, 1]
    tangent[1:-1, 1] = sin * a[:, 0] + cos * a[:, 1]
    # A chord of a circle halves the angle between the tangents at its ends.
    tangent[0] = 2.0 * (along[0] @ tangent[1]) * along[0] - tangent[1]
    tangent[-1] = 2.0 * (along[-1] @ tangent[-2]) * along[-1] - tangent[-2]
    return tangent, turn


def _full_turn(turn: np.ndarray) -> float:
    """Turning angle from end to end, with the half chords at both ends."""
    return float(np.abs(turn).sum() + 0.5 * (abs(turn[0]) + abs(turn[-1])))


def _fit_piece(
    points: np.ndarray, tangent: np.ndarray, length: np.ndarray, tolerance: float
) -> np.ndarray:
    """(m, 3) arc polyline of a piece that turns by less than 180 degrees."""
    bulge, worst = _one_arc(points)
    if worst <= tolerance:
        return np.array([[*points[0], bulge], [*points[-1], 0.0]])
    travelled = np.concatenate(([0.0], np.cumsum(length)))
    last = len(points) - 1
    probes = np.searchsorted(travelled, travelled[-1] * np.arange(1, _PROBES) / _PROBES)
    nodes = np.unique(np.concatenate(([0], probes, [last])))
    count = 0
    for _ in range(_REPARTITIONS):
        arcs, worst = _biarcs(points, tangent, nodes)
        if count and worst.max() <= tolerance:
            return arcs
        # Deviation grows with the cube of the length: the cube root is a density of intervals.
        load = np.cbrt(np.maximum(worst / (_TARGET * tolerance), 1e-6))
        count = max(count + 1, int(np.ceil(load.sum())))
        cumulated = np.concatenate(([0.0], np.cumsum(load)))
        wanted = np.interp(cumulated[-1] * np.arange(1, count) / count, cumulated, travelled[nodes])
        nodes = np.unique(np.concatenate(([0], np.searchsorted(travelled, wanted), [last])))
    while True:
        arcs, worst = _biarcs(points, tangent, nodes)
        failed = (worst > tolerance) & (np.diff(nodes) > 1)
        if not failed.any():
            return arcs
        middles = (nodes[:-1] + nodes[1:])[failed] // 2
        nodes = np.unique(np.concatenate((nodes, middles)))


def _one_arc(points: np.ndarray) -> tuple[float, float]:
    """Bulge of the least-squares arc through the end points, and the largest distance from it."""
    start, end = points[0], points[-1]
    chord = np.hypot(*(end - start))
    if chord <= _COINCIDENT:
        return 0.0, np.inf
    along = (end - start) / chord
    inner = points[1:-1] - start
    x = inner[:, 0] * along[0] + inner[:, 1] * along[1]
    y = inner[:, 1] * along[0] - inner[:, 0] * along[1]
    # Circles through both ends: y = k (x² + y² - chord x), linear in k and regular for a line.
    w = x * (x - chord) + y * y
    scale = (w * w).sum()
    k = (w * y).sum() / scale if scale else 0.0
    bulge = k * chord / (1.0 + np.sqrt(1.0 + (k * chord) ** 2))
    off, along_arc = _off_arc(points[1:-1], start, end, bulge)
    return float(bulge), float(np.abs(off).max()) if along_arc.all() else np.inf


def _biarcs(
    points: np.ndarray, tangent: np.ndarray, nodes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(2n + 1, 3) biarcs between the nodes' points and tangents; (n,) largest distances."""
    p, t = points[nodes], tangent[nodes]
    v, both = p[1:] - p[:-1], t[1:] + t[:-1]
    vv = np.einsum("ij,ij->i", v, v)
    vt = np.einsum("ij,ij->i", v, both)
    apart = t[1:] - t[:-1]
    reach = vv / (vt + np.sqrt(vt * vt + np.einsum("ij,ij->i", apart, apart) * vv))
    middle = 0.5 * (p[1:] + p[:-1] - reach[:, None] * apart)
    first, second = middle - p[:-1], p[1:] - middle
    arcs = np.zeros((2 * len(v) + 1, 3))
    arcs[0::2, :2], arcs[1::2, :2] = p, middle
    arcs[0:-1:2, 2] = _half_tangent(t[:-1], first)
    arcs[1::2, 2] = _half_tangent(second, t[1:])
    interval = np.repeat(np.arange(len(v)), np.diff(nodes))
    inside = points[:-1]
    joint = v - reach[:, None] * both
    beyond = np.einsum("ij,ij->i", inside - middle[interval], joint[interval]) > 0.0
    arc = 2 * interval + beyond
    off, along = _off_arc(inside, arcs[arc, :2], arcs[arc + 1, :2], arcs[arc, 2])
    distance = np.where(along, np.abs(off), np.inf)
    distance[nodes[:-1]] = 0.0
    return arcs, np.maximum.reduceat(distance, nodes[:-1])


def _half_tangent(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """tan of half the angle from a to b."""
    angle = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])
    return np.tan(0.5 * angle)


def _off_arc(
    points: np.ndarray, start: np.ndarray, end: np.ndarray, bulge: np.ndarray | float
) -> tuple[np.ndarray, np.ndarray]:
    """Signed distance of each point from its arc's circle, and whether its foot is on the arc.

    start, end: (2,) or (k, 2); bulge: scalar or (k,). Regular as the bulge goes to zero.
    """
    line = end - start
    cx, cy = line[..., 0], line[..., 1]
    chord = np.hypot(cx, cy)
    dx, dy = points[:, 0] - start[..., 0], points[:, 1] - start[..., 1]
    x = (dx * cx + dy * cy) / chord
    y = (dy * cx - dx * cy) / chord
    # Circle x² + y² - chord x = y / k, k = bulge-dependent; multiplied by k throughout.
    k = 2.0 * bulge / (chord * (1.0 - bulge * bulge))
    radius = np.hypot(0.5 * k * chord, 0.5)
    across = np.hypot(k * (x - 0.5 * chord), k * y - 0.5)
    off = (k * (x * (x - chord) + y * y) - y) / (across + radius)
    # The foot is on the arc when the ray from the centre passes between the ends' rays.
    lever = 1.0 - 2.0 * k * y
    along = (2.0 * x - chord + chord * lever >= -2.0 * _COINCIDENT) & (
        chord - 2.0 * x + chord * lever >= -2.0 * _COINCIDENT
    )
    return off, along
