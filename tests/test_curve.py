# SPDX-License-Identifier: LGPL-2.1-or-later
"""NURBS curves in space: exact circles, their derivatives, and where they run."""

import numpy as np
import pytest

from BendTorsionWB.core.geometry.curve import Curve

RADIUS, HALF = 750.0, np.sqrt(0.5)


def circle():
    """A full circle in the plane y = 20 of four rational quadratic quarters (Piegl & Tiller)."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    poles = np.array([(RADIUS * x, 20.0, RADIUS * z) for x, z in corners])
    knots = np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], float)
    return Curve(2, knots, poles, np.array([1.0, HALF] * 4 + [1.0]))


def bent(weights=None):
    """A cubic of two spans of unequal length, its knots running on beyond both ends."""
    poles = np.array([(0, 0, 0), (3, 5, 1), (7, 4, -2), (11, 9, 3), (14, 2, 6)], float)
    return Curve(3, np.array([-2.0, -1.0, -0.5, 0.0, 2.0, 5.0, 6.0, 8.0, 9.0]), poles, weights)


def test_a_rational_circle_is_round_and_bends_as_one():
    u = np.linspace(0.0, 4.0, 41)
    position, rate, bend = circle().evaluate(u, 2)
    out = position - [0.0, 20.0, 0.0]
    assert np.abs(np.linalg.norm(out, axis=1) - RADIUS).max() < 1e-12 * RADIUS
    assert np.abs((out * rate).sum(axis=1)).max() < 1e-9 * RADIUS
    speed = np.linalg.norm(rate, axis=1)
    curvature = np.linalg.norm(np.cross(rate, bend), axis=1) / speed**3
    assert curvature == pytest.approx(1.0 / RADIUS, rel=1e-12)
    assert np.array_equal(circle().breaks, [0, 1, 2, 3, 4])


@pytest.mark.parametrize("weights", [None, np.array([1.0, 2.0, 0.5, 3.0, 1.0])])
def test_derivatives_are_those_of_differences(weights):
    curve, h = bent(weights), 1e-4
    u = np.array([0.3, 0.9, 1.6, 2.4, 3.7, 4.6])
    before, at, after = (curve.evaluate(u + d)[0] for d in (-h, 0.0, h))
    position, rate, bend = curve.evaluate(u, 2)
    assert np.array_equal(position, at) and len(curve.evaluate(u, 1)) == 2
    assert rate == pytest.approx((after - before) / (2 * h), abs=1e-6)
    assert bend == pytest.approx((after - 2 * at + before) / h**2, abs=1e-5)


def test_a_line_does_not_bend_but_a_rational_one_is_passed_unevenly():
    """r = ((1 - u) w₀ p₀ + u w₁ p₁) / w, w = (1 - u) w₀ + u w₁: r' = w₀ w₁ (p₁ - p₀) / w² and
    r'' = -2 w' r' / w."""
    poles, knots = np.array([(0.0, 0.0, 0.0), (4.0, -2.0, 8.0)]), np.array([0.0, 0.0, 1.0, 1.0])
    u = np.linspace(0.0, 1.0, 5)
    _, rate, bend = Curve(1, knots, poles).evaluate(u, 2)
    assert np.array_equal(rate, np.tile(poles[1], (5, 1))) and np.array_equal(bend, 0.0 * rate)
    own = np.array([1.0, 3.0])
    _, rate, bend = Curve(1, knots, poles, own).evaluate(u, 2)
    weight = ((1.0 - u) * own[0] + u * own[1])[:, None]
    expected = own.prod() * poles[1] / weight**2
    assert rate == pytest.approx(expected, rel=1e-12)
    assert bend == pytest.approx(-2.0 * (own[1] - own[0]) * expected / weight, rel=1e-12)


def test_a_curve_runs_between_the_knots_its_poles_span():
    curve = bent()
    assert curve.domain == (0.0, 5.0)
    assert np.array_equal(curve.breaks, [0.0, 2.0, 5.0])
