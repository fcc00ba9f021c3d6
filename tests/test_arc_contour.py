# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contours of lines and arcs: what lies inside, against winding numbers and closed forms."""

import numpy as np
import pytest

from BendTorsionWB.core.geometry.arc_contour import (
    clearance,
    inside,
    polygon,
    rounded_rectangle,
    runs,
)


def winding(ring, points):
    """How often a ring (n, 2) turns round each point (k, 2)."""
    arms = ring[None] - points[:, None]
    angles = np.arctan2(arms[..., 1], arms[..., 0])
    steps = np.diff(np.concatenate([angles, angles[:, :1]], axis=1), axis=1)
    return np.rint(((steps + np.pi) % (2.0 * np.pi) - np.pi).sum(axis=1) / (2.0 * np.pi))


def star(count):
    angle = np.arange(count) * 2.0 * np.pi / count
    radius = np.where(np.arange(count) % 2, 700.0, 1000.0) + 5.0 * np.sin(7.0 * angle)
    return np.column_stack([1.3 * radius * np.cos(angle), radius * np.sin(angle)])


@pytest.mark.parametrize("count", [4, 9, 400])
def test_inside_a_polygon_is_where_it_winds_round(count):
    ring = star(count)
    points = np.random.default_rng(count).uniform(-1400.0, 1400.0, (500, 2))
    within = inside(polygon(ring), points)
    assert np.array_equal(within, winding(ring, points) != 0) and 0 < within.sum() < 500


def test_a_polygon_gives_the_same_with_one_of_its_sides_an_arc_as_flat_as_a_line():
    straight = polygon(star(60))
    bent = straight.copy()
    bent[7, 2] = 1e-8
    points = np.random.default_rng(1).uniform(-1400.0, 1400.0, (500, 2))
    assert np.array_equal(inside(straight, points), inside(bent, points))
    middle = np.zeros((1, 2))
    assert clearance(straight, middle) == pytest.approx(clearance(bent, middle), abs=1e-6)


def test_inside_a_slot_is_within_its_radius_of_its_axis():
    contour = rounded_rectangle(300.0, 100.0, 50.0)
    points = np.random.default_rng(2).uniform(-200.0, 200.0, (2000, 2))
    off = np.hypot(np.maximum(np.abs(points[:, 0]) - 100.0, 0.0), points[:, 1])
    clear = np.abs(off - 50.0) > 0.02
    assert np.array_equal(inside(contour, points)[clear], off[clear] < 50.0)


def test_a_line_is_its_two_ends_and_an_arc_is_within_its_sagitta():
    contour = rounded_rectangle(300.0, 100.0, 20.0)
    sides = runs(contour, 0.5)
    ends = np.roll(contour[:, :2], -1, axis=0)
    for k, side in enumerate(sides):
        assert np.array_equal(side[[0, -1]], [contour[k, :2], ends[k]])
        assert (len(side) == 2) == (contour[k, 2] == 0.0)
