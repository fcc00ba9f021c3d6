# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it adds to a plate's volume that the rulings of its faces are turned out of section planes.

A face is ruled between two edges, P and R. Beside a mitre a ruling runs from P at one place a on
the axis to R at another, b = a + e: the mitres of two edges lie apart, and outer and inner edges
are paired evenly between them. A plate's ends are section planes, where e is nothing. So a cut
turns the rulings between itself and the mitre back, and the face moves by w (1 - w) e (R' - P'),
w across it, though its edges stay. With c = (a + b) / 2 and rulings turned by a part k of e, the
volume passed is, exactly,

    dV/dk = 1/6 integral of e det(P'(c - k e/2), R'(c + k e/2), R - P) dc

which is so nearly linear in k that k = 1/2 stands for all of 0 to 1.
"""

import numpy as np

from BendTorsionWB.core.geometry.vectors import crossed, dots

NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
STEP = 1e-3
"""Of half a span, for rates of rates."""
RING = ((0, 0), (0, 1), (1, 1), (1, 0))
"""Outer (0) or inner (1) surface and edge, round the plate."""


def turned_volume(member, plate) -> float:
    """mm3 a plate has more than it would have with all its rulings in section planes."""
    rails = plate.rails
    if not rails.boundaries:
        return 0.0
    groups = (rails.outer, rails.outer_folds), (rails.inner, rails.inner_folds)
    edges = [[group.start, *folds, group.end] for group, folds in groups]
    total = 0.0
    for k in range(len(edges[0]) - 1):
        stretches = [
            (group, own[k], own[k + 1]) for (group, _), own in zip(groups, edges, strict=True)
        ]
        u, half = _nodes(stretches)
        weights = half * np.tile(WEIGHTS, len(half) // len(WEIGHTS))
        ring = [_edge(member, *stretches[side], edge, u, half) for side, edge in RING]
        for one, other in zip(ring, [*ring[1:], ring[0]], strict=True):
            total += (weights * _passed(one, other)).sum()
    return total * _orientation(member, rails)


def _nodes(stretches):
    """Nodes on [0, 1] and half the span of each, smooth on each span of all the rails."""
    breaks = [np.array([0.0, 1.0])]
    for group, start, end in stretches:
        inside = group.breaks[(group.breaks > start) & (group.breaks < end)]
        breaks.append((inside - start) / (end - start))
    breaks = np.unique(np.concatenate(breaks))
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > 1e-12])]
    half, middle = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
    return (middle[:, None] + half[:, None] * NODES).ravel(), np.repeat(half, len(NODES))


def _edge(member, group, start, end, edge, u, half):
    """At u: points, the place on the axis whose section plane each lies in, its rate by u, and the
    first and second derivative of the points by that place."""
    own, count = slice(3 * edge, 3 * edge + 3), len(u)
    s = start + np.concatenate([u, u + STEP * half, u - STEP * half]) * (end - start)
    points, rates = group(s)[:, own], group.derivative(s)[:, own] * (end - start)
    place = s
    for _ in range(4):
        frame = member.frames.at(place)
        out = points - frame.origin
        bend = 1.0 - frame.ky * dots(out, frame.y) - frame.kz * dots(out, frame.z)
        place = place + dots(out, frame.x) / bend
    rate = dots(rates, frame.x) / bend
    first, ahead, behind = np.split(rates / rate[:, None], 3)
    second = (ahead - behind) / (place[count : 2 * count] - place[2 * count :])[:, None]
    return points[:count], place[:count], rate[:count], first, second


def _passed(one, other):
    """The integrand by u for the face between two edges."""
    (p, a, a_rate, p1, p2), (r, b, b_rate, r1, r2) = one, other
    gap, apart = r - p, b - a

    def determinant(x, y):
        return dots(crossed(x, y), gap)

    # At k = 1/2 both places are a quarter of e nearer their middle.
    nearer = 0.25 * apart * (determinant(p1, r2) - determinant(p2, r1))
    return apart * (determinant(p1, r1) - nearer) * 0.5 * (a_rate + b_rate) / 6.0


def _orientation(member, rails) -> float:
    """+1 when the ring runs to the left about the axis, else -1."""
    middle = np.array([0.5 * (rails.outer.start + rails.outer.end)])
    outer, inner = (group(middle).reshape(2, 3) for group in (rails.outer, rails.inner))
    normal = np.cross(outer[1] - outer[0], inner[1] - outer[1])
    return float(np.sign(normal @ member.frames.at(middle).x[0]))
