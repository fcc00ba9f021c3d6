# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closed contours of lines and arcs: exact areas and centroids, places and points along them.

A contour is an (m, 3) array of vertices x, y, bulge as in `arc_fit`, counter-clockwise, the first
vertex not repeated.
"""

from __future__ import annotations

import numpy as np

from .arc_fit import enclosed_area

SAGITTA = 0.001
"""mm; largest distance of an arc from the chords between its dense points."""

_STRAIGHT = 1e-9
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


def polygon(points: np.ndarray) -> np.ndarray:
    """The contour (m, 3) with straight sides between points (m, 2), turned counter-clockwise."""
    contour = np.column_stack([points, np.zeros(len(points))])
    return contour if enclosed_area(contour) > 0.0 else contour[::-1].copy()


def rounded_rectangle(length: float, breadth: float, radius: float = 0.0) -> np.ndarray:
    """A rectangle about the origin, `length` along x, its corners rounded: a circle or a slot
    where the rounding leaves no straight side."""
    x, y = 0.5 * length, 0.5 * breadth
    if radius <= 0.0:
        return polygon(np.array([[-x, -y], [x, -y], [x, y], [-x, y]]))
    a, b = x - radius, y - radius
    quarter = np.tan(np.pi / 8.0)
    corners = np.array(
        [
            [-a, -y, 0.0],
            [a, -y, quarter],
            [x, -b, 0.0],
            [x, b, quarter],
            [a, y, 0.0],
            [-a, y, quarter],
            [-x, b, 0.0],
            [-x, -b, quarter],
        ]
    )
    if a <= _STRAIGHT and b <= _STRAIGHT:
        return np.array([[x, 0.0, 1.0], [-x, 0.0, 1.0]])
    if b <= _STRAIGHT:
        return np.array([[-a, -y, 0.0], [a, -y, 1.0], [a, y, 0.0], [-a, y, 1.0]])
    if a <= _STRAIGHT:
        return np.array([[x, -b, 0.0], [x, b, 1.0], [-x, b, 0.0], [-x, -b, 1.0]])
    return corners


def moved(contour: np.ndarray, angle: float = 0.0, shift=(0.0, 0.0)) -> np.ndarray:
    """The contour turned counter-clockwise by `angle` (rad), then shifted."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y, bulge = contour.T
    return np.column_stack([x * cos - y * sin + shift[0], x * sin + y * cos + shift[1], bulge])


def reversed_contour(contour: np.ndarray) -> np.ndarray:
    """The same contour run through the other way, from the same vertex."""
    turned = contour[[0, *range(len(contour) - 1, 0, -1)]].copy()
    turned[:, 2] = -contour[::-1, 2]
    return turned


def area(contour: np.ndarray) -> float:
    """Area, exact."""
    return enclosed_area(contour)


def first_moments(contour: np.ndarray) -> np.ndarray:
    """∫x dA and ∫y dA, (2,), exact: the polygon's and those of the circular segments."""
    p, bulge = contour[:, :2], contour[:, 2]
    q = np.roll(p, -1, axis=0)
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    moments = ((p + q) * cross[:, None]).sum(axis=0) / 6.0
    for a, b, bent in zip(p, q, bulge, strict=True):
        if abs(bent) < _STRAIGHT:
            continue
        chord = float(np.hypot(*(b - a)))
        angle = 4.0 * np.arctan(bent)
        radius = chord * (1.0 + bent**2) / (4.0 * bent)
        left = np.array([-(b - a)[1], (b - a)[0]]) / chord
        centre = 0.5 * (a + b) + radius * np.cos(0.5 * angle) * left
        segment = 0.5 * radius**2 * (angle - np.sin(angle))
        moments += segment * centre - chord**3 / 12.0 * left
    return moments


def centroid(contour: np.ndarray) -> np.ndarray:
    """Centroid (2,), exact."""
    return first_moments(contour) / area(contour)


def extents(contour: np.ndarray) -> tuple[float, float]:
    """The largest x and the largest y of a contour, its arcs between vertices included."""
    p, bulge = contour[:, :2], contour[:, 2]
    high = p.max(axis=0)
    curved = np.abs(bulge) > _STRAIGHT
    p, q, bulge = p[curved], np.roll(p, -1, axis=0)[curved], bulge[curved]
    sweep = 4.0 * np.arctan(bulge)
    half = 0.5 * (q - p)
    left = np.column_stack([-half[:, 1], half[:, 0]])
    centre = p + half + left / np.tan(0.5 * sweep)[:, None]
    radius = np.hypot(half[:, 0], half[:, 1]) / np.abs(np.sin(0.5 * sweep))
    first = np.arctan2(p[:, 1] - centre[:, 1], p[:, 0] - centre[:, 0])
    for axis, towards in enumerate((0.0, 0.5 * np.pi)):
        turn = np.where(sweep > 0.0, towards - first, first - towards) % (2.0 * np.pi)
        reach = np.where(turn <= np.abs(sweep), centre[:, axis] + radius, high[axis])
        high[axis] = max(high[axis], reach.max(initial=high[axis]))
    return float(high[0]), float(high[1])


def runs(contour: np.ndarray, sagitta: float = SAGITTA) -> tuple[np.ndarray, ...]:
    """The sides as dense runs (k, 2), head to tail: a line its two ends, an arc points so close
    that no chord is farther than `sagitta` from it."""
    return tuple(_along(contour, k, _count(contour, k, sagitta)) for k in range(len(contour)))


def fine_runs(contour: np.ndarray, longest: float) -> tuple[np.ndarray, ...]:
    """The sides as `runs`, lines too with points no farther apart than `longest`, for contours
    that are bent by a map."""
    ends = np.roll(contour[:, :2], -1, axis=0) - contour[:, :2]
    length = np.hypot(ends[:, 0], ends[:, 1])
    return tuple(
        _along(contour, k, max(8, _count(contour, k, SAGITTA), int(np.ceil(length[k] / longest))))
        for k in range(len(contour))
    )


def inner_nodes(contour: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) inside a contour that is star-shaped about the origin, and weights (n,) whose
    sum is its area: Gauss along each side, and from the origin to it."""
    places, weights = [], []
    for k in range(len(contour)):
        point, rate = _side(contour, k, 0.5 * (_NODES + 1.0))
        sweep = 0.5 * _WEIGHTS * (point[:, 0] * rate[:, 1] - point[:, 1] * rate[:, 0])
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            share = 0.5 * (node + 1.0)
            places.append(share * point)
            weights.append(0.5 * weight * share * sweep)
    return np.concatenate(places), np.concatenate(weights)


def inside(contour: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(n,) whether points (n, 2) lie inside the contour, by crossings with its dense sides."""
    ring = _ring(contour, 0.01)
    a, b = ring[None], np.concatenate([ring[1:], ring[:1]])[None]
    x, y = points[:, :1], points[:, 1:]
    level = (a[..., 1] > y) != (b[..., 1] > y)
    rise = np.where(level, b[..., 1] - a[..., 1], 1.0)
    reach = a[..., 0] + (y - a[..., 1]) * (b[..., 0] - a[..., 0]) / rise
    return ((level & (x < reach)).sum(axis=1) % 2).astype(bool)


def clearance(contour: np.ndarray, points: np.ndarray) -> float:
    """Smallest distance of points (n, 2) from the contour; negative when one lies outside."""
    ring = _ring(contour, 0.01)
    step = np.roll(ring, -1, axis=0) - ring
    off = points[:, None] - ring[None]
    share = (off * step).sum(axis=2) / (step * step).sum(axis=1)
    away = off - np.minimum(np.maximum(share, 0.0), 1.0)[..., None] * step
    distance = np.sqrt((away * away).sum(axis=2)).min()
    return float(distance if inside(contour, points).all() else -distance)


def _ring(contour: np.ndarray, sagitta: float) -> np.ndarray:
    """The points of the dense sides once each, (n, 2)."""
    if (np.abs(contour[:, 2]) < _STRAIGHT).all():
        return contour[:, :2]
    return np.concatenate([run[:-1] for run in runs(contour, sagitta)])


def _count(contour: np.ndarray, k: int, sagitta: float) -> int:
    bulge = abs(contour[k, 2])
    if bulge < _STRAIGHT:
        return 1
    chord = np.hypot(*(contour[(k + 1) % len(contour), :2] - contour[k, :2]))
    radius = chord * (1.0 + bulge**2) / (4.0 * bulge)
    return max(8, int(np.ceil(4.0 * np.arctan(bulge) / np.sqrt(8.0 * sagitta / radius))))


def _along(contour: np.ndarray, k: int, count: int) -> np.ndarray:
    if count == 1:
        return contour[[k, (k + 1) % len(contour)], :2]
    points = _side(contour, k, np.arange(count + 1) / count)[0]
    points[0], points[-1] = contour[k, :2], contour[(k + 1) % len(contour), :2]
    return points


def _side(contour: np.ndarray, k: int, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points and rates (n, 2) of side k at t (n,) in 0 … 1."""
    a, b, bulge = contour[k, :2], contour[(k + 1) % len(contour), :2], contour[k, 2]
    if abs(bulge) < _STRAIGHT:
        return a + t[:, None] * (b - a), np.broadcast_to(b - a, (len(t), 2))
    half = 2.0 * np.arctan(bulge)
    chord = np.hypot(*(b - a))
    radius = chord / (2.0 * np.sin(half))
    along = (b - a) / chord
    left = np.array([-along[1], along[0]])
    angle = half * (2.0 * t - 1.0)
    sine, cosine = np.sin(angle)[:, None], np.cos(angle)[:, None]
    middle = 0.5 * (a + b) + radius * np.cos(half) * left
    points = middle + radius * (sine * along - cosine * left)
    return points, 2.0 * half * radius * (cosine * along + sine * left)
