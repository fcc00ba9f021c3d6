# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closest points, normals and signed distances of analytic surfaces."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import (
    Cone,
    Cylinder,
    Ellipsoid,
    Flipped,
    Offset,
    Plane,
    Sphere,
    Torus,
    analytic_surface,
)

HALL = Ellipsoid(40e3, 30e3, 20e3)
CONE = Cone(12e3, math.radians(35))
SPIRE = Cone(12e3, math.radians(-20))


def on_ellipsoid(surface, rng, count):
    """Points exactly on the surface and outward unit normals."""
    unit = rng.normal(size=(count, 3))
    unit /= np.linalg.norm(unit, axis=1)[:, None]
    axes = np.array([surface.a, surface.b, surface.c])
    normal = unit / axes
    return unit * axes, normal / np.linalg.norm(normal, axis=1)[:, None]


def on_revolution(profile, rng, count):
    """Points and normals of a profile (radius, z, normal radius, normal z) turned about z."""
    radius, z, out, up = profile
    turn = rng.uniform(0, 2 * np.pi, count)
    cosine, sine = np.cos(turn), np.sin(turn)
    points = np.column_stack([radius * cosine, radius * sine, z])
    return points, np.column_stack([out * cosine, out * sine, up])


def truth(surface, rng, count=2000):
    if isinstance(surface, Ellipsoid):
        return on_ellipsoid(surface, rng, count)
    if isinstance(surface, Sphere):
        return on_ellipsoid(Ellipsoid(surface.r, surface.r, surface.r), rng, count)
    if isinstance(surface, Plane):
        points = rng.normal(size=(count, 3)) * [9e3, 9e3, 0]
        return points, np.tile([0.0, 0.0, 1.0], (count, 1))
    z = rng.uniform(-9e3, 9e3, count)
    one = np.ones(count)
    if isinstance(surface, Cylinder):
        return on_revolution((surface.r * one, z, one, 0 * one), rng, count)
    if isinstance(surface, Cone):
        slope = math.tan(surface.angle)
        radius = surface.r + z * slope
        length = math.hypot(1, slope)
        return on_revolution((radius, z, one / length, -slope * one / length), rng, count)
    tube = rng.uniform(0, 2 * np.pi, count)
    radius = surface.R + surface.r * np.cos(tube)
    return on_revolution((radius, surface.r * np.sin(tube), np.cos(tube), np.sin(tube)), rng, count)


ANALYTIC = [
    HALL,
    Ellipsoid(20e3, 20e3, 35e3),
    Ellipsoid(30e3, 30e3, 12e3),
    Sphere(25e3),
    Cylinder(15e3),
    CONE,
    SPIRE,
    Torus(30e3, 8e3),
    Plane(),
]


@pytest.mark.parametrize("surface", ANALYTIC, ids=lambda s: type(s).__name__)
def test_points_pushed_along_normals_come_back(surface):
    rng = np.random.default_rng(3)
    points, normals = truth(surface, rng)
    move = np.array([100.0, -2000.0, 55.0])
    placed = replace(surface, origin=tuple(move))
    for push in (0.0, 3500.0, -2500.0):
        foot = placed.closest(points + push * normals + move)
        assert np.abs(foot.points - points - move).max() < 1e-10
        assert np.abs(foot.normals - normals).max() < 1e-14
        assert np.abs(foot.distance - push).max() < 2e-11
        assert not foot.ambiguous.any() and not foot.outside.any()


def test_ellipsoid_foot_is_optimal_everywhere():
    rng = np.random.default_rng(5)
    given = rng.uniform(-60e3, 60e3, (5000, 3))
    # Symmetry planes and axes, and points a hair off them.
    given[:500, 0] = 0
    given[500:1000, 1] = 0
    given[1000:1500, 2] = 0
    given[1500:2000, 2] = 1e-9
    given[2000:2200, :2] = 0
    given[2200:2400, 1:] = [0, 1e-40]
    given[2400:2600, ::2] = 0
    foot = HALL.closest(given)
    axes = np.array([40e3, 30e3, 20e3])
    assert np.abs(np.linalg.norm(foot.points / axes, axis=1) - 1).max() < 4e-16 * 2
    residual = given - foot.points
    assert np.abs(np.cross(residual, foot.normals)).max() < 1e-10
    # No sampled point of the surface is nearer than the foot.
    sample, _ = on_ellipsoid(HALL, rng, 3000)
    for point, nearest in zip(given[::25], np.abs(foot.distance[::25]), strict=True):
        assert np.linalg.norm(sample - point, axis=1).min() >= nearest - 1e-9


def test_ellipsoid_middle_plane_is_ambiguous_and_still_optimal():
    foot = HALL.closest([[0, 0, 0], [1000, 500, 0], [1000, 500, 1.0], [39e3, 0, 0]])
    assert foot.ambiguous.tolist() == [True, True, False, False]
    assert foot.distance[0] == -20e3
    assert np.allclose(foot.points[3], [40e3, 0, 0])
    assert np.isfinite(foot.normals).all()


@pytest.mark.parametrize(
    ("surface", "point", "distance"),
    [
        (Sphere(5e3), [0, 0, 0], -5e3),
        (Cylinder(5e3), [0, 0, 700], -5e3),
        (Torus(30e3, 8e3), [0, 0, 0], 22e3),
        (Torus(30e3, 8e3), [0, 30e3, 0], -8e3),
        (CONE, [0, 0, 0], -12e3 * math.cos(math.radians(35))),
        (CONE, [0, 0, -12e3 / math.tan(math.radians(35)) - 9e3], 9e3),
        (SPIRE, [0, 0, 12e3 / math.tan(math.radians(20)) + 9e3], 9e3),
        (Ellipsoid(7e3, 7e3, 7e3), [0, 0, 0], -7e3),
    ],
)
def test_points_with_many_feet_are_flagged_and_finite(surface, point, distance):
    foot = surface.closest([point])
    assert foot.ambiguous.all()
    assert foot.distance[0] == pytest.approx(distance, rel=1e-14)
    assert np.linalg.norm(foot.normals[0]) == pytest.approx(1, rel=1e-15)


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_scale_invariance(scale):
    given = np.random.default_rng(8).uniform(-50e3, 50e3, (400, 3))
    once = HALL.closest(given)
    scaled = Ellipsoid(40e3 * scale, 30e3 * scale, 20e3 * scale).closest(given * scale)
    assert np.abs(scaled.points / scale - once.points).max() < 1e-9
    assert np.abs(scaled.normals - once.normals).max() < 1e-13


def test_offset_of_a_sphere_and_flip():
    given = np.random.default_rng(2).normal(size=(100, 3)) * 9e3
    bigger, offset = Sphere(5700).closest(given), Offset(Sphere(5e3), 700).closest(given)
    assert np.abs(bigger.points - offset.points).max() < 1e-11
    assert np.abs(bigger.distance - offset.distance).max() < 1e-11
    inward = Flipped(Sphere(5e3)).closest(given)
    assert np.array_equal(inward.normals, -Sphere(5e3).closest(given).normals)
    # A positive offset follows the outward side after the flip: towards the centre.
    moved = analytic_surface("sphere", {"r": 5e3}, offset=700, flip=True).closest(given)
    assert np.abs(np.linalg.norm(moved.points, axis=1) - 4300).max() < 1e-11
    assert np.abs(given - moved.points - moved.distance[:, None] * moved.normals).max() < 1e-10


def test_keys_follow_content():
    assert HALL.key == Ellipsoid(40000, 30000, 20000).key
    assert pickle.loads(pickle.dumps(HALL)).key == HALL.key
    others = [
        Ellipsoid(40e3, 30e3, 20e3 + 1e-9),
        replace(HALL, origin=(0, 0, 1.0)),
        Flipped(HALL),
        Offset(HALL, 1.0),
        Sphere(5.0),
        Cylinder(5.0),
        Plane(),
    ]
    assert len({surface.key for surface in [HALL, *others]}) == 8


@pytest.mark.parametrize(
    ("kind", "parameters", "more", "position"),
    [
        ("dome", {"r": 1}, {}, ""),
        ("ellipsoid", {"a": 1, "b": 2}, {}, "c"),
        ("sphere", {"r": 1, "R": 2}, {}, "R"),
        ("sphere", {"r": math.nan}, {}, "r"),
        ("sphere", {"r": "ten"}, {}, "r"),
        ("cylinder", {"r": -1}, {}, "r"),
        ("cone", {"r": 1, "angle": 35.0}, {}, "angle"),
        ("torus", {"R": 5, "r": 6}, {}, "R"),
        ("plane", {}, {"origin": (0, math.inf, 0)}, "y"),
        ("plane", {}, {"offset": math.inf}, "offset"),
        ("ellipsoid", {"a": 40e3, "b": 30e3, "c": 20e3}, {"offset": -10e3}, "offset"),
        ("torus", {"R": 30e3, "r": 8e3}, {"offset": -22e3, "flip": True}, "offset"),
    ],
)
def test_bad_parameters_are_named(kind, parameters, more, position):
    with pytest.raises(BendTorsionError) as caught:
        analytic_surface(kind, parameters, object="Roof", **more)
    assert [f.position for f in caught.value.findings] == [position]
    assert caught.value.findings[0].object == "Roof"
    assert caught.value.findings[0].mend
