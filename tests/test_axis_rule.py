# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes by rule against closed forms: plane sections, iso-curves, geodesics."""

import numpy as np
import pytest
from exact_axes import free_form

from BendTorsionWB.core.axes.axis import arc_length_position, axis_from_curve
from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.axes.axis_iso import IsoCurve, iso_curve
from BendTorsionWB.core.axes.axis_rule import Geodesic, PlaneSection
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.patches import PatchSurface
from BendTorsionWB.core.geometry.surface import (
    Cylinder,
    Ellipsoid,
    Flipped,
    Offset,
    Plane,
    Sphere,
    Torus,
)

HALL = Ellipsoid(40e3, 30e3, 20e3)
RING = Torus(30e3, 8e3)
ROOF = PatchSurface((free_form(),))


def by_rule(rule, surface, **more):
    return axis_from(AxisInput("A1", rule=rule, **more), surface)


def stations(axis, count=301):
    return np.linspace(0.0, axis.length, count)


def geodesic_curvature(axis, surface):
    s = stations(axis)[1:-1]
    across = np.cross(surface.closest(axis.position(s)).normals, axis.tangent(s))
    return np.abs((axis.curvature(s) * across).sum(axis=1)).max()


@pytest.mark.parametrize("surface", [HALL, RING, ROOF, Flipped(HALL)])
def test_a_plane_section_lies_on_plane_and_surface(surface):
    origin, normal = np.array([18e3, 9e3, 3e3]), np.array([0.5, -0.8, 0.2])
    if surface is ROOF:
        feet = surface.closest(np.array([[4e3, 3e3, 2e3], [25e3, 16e3, 2e3]])).points
        normal = np.cross(feet[1] - feet[0], [0.1, 0.1, 1.0])
        origin, ends = feet[0], [tuple(foot) for foot in feet]
    else:
        feet = surface.closest(np.array([[37e3, 13e3, 0.0], [22e3, 3e3, 14e3]])).points
        normal = np.cross(feet[1] - feet[0], [0.3, 1.0, 0.1])
        origin, ends = feet[0], [tuple(foot) for foot in feet]
    axis = by_rule(PlaneSection(tuple(origin), tuple(normal), *ends), surface)
    points = axis.position(stations(axis))
    unit = normal / np.linalg.norm(normal)
    assert np.abs((points - origin) @ unit).max() < 5e-6
    assert np.abs(surface.closest(points).distance).max() < 5e-6
    ends = np.array(ends)
    assert np.linalg.norm((points[[0, -1]] - ends)[:, :2], axis=1).max() < 1000
    assert not axis.findings


def test_a_section_of_a_sphere_is_a_circle_open_or_closed():
    ball = Sphere(30e3)
    radius = np.sqrt(30e3**2 - 12e3**2)
    ends = (radius, 0, 12e3), (0, radius, 12e3)
    half = by_rule(PlaneSection((0, 0, 12e3), (0, 0, 1), *ends), ball)
    assert half.length == pytest.approx(radius * np.pi / 2, abs=1e-5)
    ring = by_rule(PlaneSection((0, 0, 12e3), (0, 0, 1), (radius, 0, 12e3), closed=True), ball)
    assert ring.closed and ring.length == pytest.approx(2 * np.pi * radius, abs=1e-5)
    curvature = np.linalg.norm(ring.curvature(stations(ring)), axis=1)
    assert curvature * radius == pytest.approx(1.0, abs=1e-5)
    # Counter-clockwise about the plane's normal.
    x, y = ring.position(np.array([0.0, 1000.0]))[:, :2]
    assert x[0] * y[1] - x[1] * y[0] > 0


def test_a_section_goes_the_short_way_between_its_ends():
    one, two = HALL.closest(np.array([[39e3, -3e3, 0], [39e3, 3e3, 0.0]])).points
    axis = by_rule(PlaneSection((0, 0, 0), (0, 0, 1), tuple(one), tuple(two)), HALL)
    assert axis.length < 7e3


def test_an_iso_curve_is_the_surface_itself():
    patch = free_form()
    (u0, u1), (v0, v1) = patch.domain
    for direction in "uv":
        axis = by_rule(IsoCurve(direction, 0.3, 0.1, 0.9), ROOF)
        t = np.linspace(0.1, 0.9, 101)
        held = np.full_like(t, 0.3)
        u, v = (held, t) if direction == "u" else (t, held)
        exact = patch.evaluate(u0 + u * (u1 - u0), v0 + v * (v1 - v0))[0]
        near = axis.position(axis.place_of(exact))
        assert np.linalg.norm(near - exact, axis=1).max() < 1e-7
        assert np.abs(axis.position(np.array([0.0, axis.length])) - exact[[0, -1]]).max() < 1e-7


def test_geodesics_of_the_sphere_are_great_circles():
    ball = Sphere(30e3)
    start, end = np.array([30e3, 0, 0]), 30e3 * np.array([-0.5, 0.6, np.sqrt(0.39)])
    axis = by_rule(Geodesic(tuple(start), tuple(end)), ball)
    angle = np.arccos(start @ end / 30e3**2)
    assert axis.length == pytest.approx(30e3 * angle, abs=1e-5)
    pole = np.cross(start, end)
    points = axis.position(stations(axis))
    assert np.abs(points @ pole / np.linalg.norm(pole)).max() < 1e-5


def test_geodesics_of_the_cylinder_are_helices():
    axis = by_rule(Geodesic((10e3, 0, 0), (0, 10e3, 9e3)), Cylinder(10e3))
    assert axis.length == pytest.approx(np.hypot(10e3 * np.pi / 2, 9e3), abs=1e-5)
    x, y, z = axis.position(stations(axis)).T
    assert z == pytest.approx(9e3 * np.arctan2(y, x) / (np.pi / 2), abs=1e-4)


@pytest.mark.parametrize(
    "surface, start, end",
    [
        (HALL, (39e3, 3e3, 5e3), (-10e3, 24e3, 14e3)),
        (RING, (37e3, 3e3, 2e3), (20e3, 25e3, 7e3)),
        (ROOF, (4e3, 3e3, 3e3), (25e3, 16e3, 3e3)),
        (Plane(), (0, 0, 0), (9e3, 4e3, 0)),
    ],
)
def test_a_geodesic_lies_on_its_surface_and_bends_only_with_it(surface, start, end):
    ends = surface.closest(np.array([start, end], float)).points
    axis = by_rule(Geodesic(*map(tuple, ends)), surface)
    assert np.abs(surface.closest(axis.position(stations(axis))).distance).max() < 5e-6
    assert np.abs(axis.position(np.array([0.0, axis.length])) - ends).max() < 1e-6
    # The free-form patch is C2: its geodesics bend smoothly only to second order at its knots.
    assert geodesic_curvature(axis, surface) * 1e3 < (1e-4 if surface is ROOF else 1e-6)


def test_a_geodesic_is_shorter_than_its_neighbours():
    ends = HALL.closest(np.array([[30e3, 10e3, 12e3], [5e3, 24e3, 10e3]])).points
    axis = by_rule(Geodesic(*map(tuple, ends)), HALL)
    for side in (-400.0, 400.0):
        s = stations(axis, 4001)
        points, x = axis.position(s), axis.tangent(s)
        across = np.cross(HALL.closest(points).normals, x)
        aside = side * np.sin(np.pi * s / axis.length)[:, None]
        beside = HALL.closest(points + aside * across).points
        assert np.linalg.norm(np.diff(beside, axis=0), axis=1).sum() > axis.length + 1


@pytest.mark.parametrize(
    "rule, code",
    [
        (PlaneSection((0, 0, 0), (0, 0, 0), (40e3, 0, 0), (0, 30e3, 0)), "axis-rule-plane"),
        (PlaneSection((0, 0, 20e3), (0, 0, 1), (40e3, 0, 0), (0, 30e3, 0)), "axis-rule-tangent"),
        (PlaneSection((0, 0, 0), (0, 0, 1), (60e3, 0, 0), (0, 30e3, 0)), "axis-rule-end"),
        (PlaneSection((0, 0, 0), (0, 0, 1), (40e3, 0, 0), None), "axis-rule-end"),
        (Geodesic((40e3, 0, 0), (40e3, 0, 0.1)), "axis-rule-end"),
        (Geodesic((80e3, 0, 0), (0, 30e3, 0)), "axis-rule-end"),
        (IsoCurve("u", 1.5), "axis-rule-iso"),
    ],
)
def test_rules_that_give_no_curve_are_refused(rule, code):
    with pytest.raises(BendTorsionError) as caught:
        by_rule(rule, HALL)
    assert caught.value.findings[0].code == code


def test_a_section_past_the_border_is_refused():
    rule = PlaneSection((4e3, 3e3, 0), (0, 1, 0), (4e3, 3e3, 2e3), (40e3, 3e3, 0))
    with pytest.raises(BendTorsionError):
        by_rule(rule, ROOF)
    with pytest.raises(BendTorsionError) as caught:
        by_rule(Geodesic((0, 0, 0), (1, 0, 0)), None)
    assert caught.value.findings[0].code == "axis-rule-surface"


def test_an_axis_by_rule_is_a_curve_like_any_other():
    axis = by_rule(Geodesic((40e3, 0, 0), (0, 30e3, 0)), HALL, reversed=True)
    again = axis_from_curve("A1", axis.curve)
    assert again.length == pytest.approx(axis.length, abs=1e-7)


@pytest.mark.parametrize(
    ("surface", "held", "at", "length", "point"),
    [
        (Sphere(20000.0), "u", 0.25, np.pi * 20000, (0, 20000, 0)),
        (Sphere(20000.0), "v", 0.75, 2 * np.pi * 20000 * np.sqrt(0.5), None),
        (Ellipsoid(40e3, 30e3, 20e3), "v", 0.5, None, (-40e3, 0, 0)),
        (Torus(30e3, 8e3), "u", 0.5, 2 * np.pi * 8e3, (-22e3, 0, 0)),
        (Torus(30e3, 8e3), "v", 0.25, 2 * np.pi * 30e3, (-30e3, 0, 8e3)),
    ],
)
def test_iso_curves_of_closed_analytic_surfaces_are_exact(surface, held, at, length, point):
    curve = iso_curve("A1", IsoCurve(held, at), surface)
    first, last = curve.domain
    points = curve.evaluate(np.linspace(first, last, 301))[0]
    assert np.abs(surface.closest(points).distance).max() < 1e-9
    if length is not None:
        assert arc_length_position(curve).end == pytest.approx(length, rel=1e-12)
    if point is not None:
        assert points[150] == pytest.approx(np.array(point, float), abs=1e-9)
    half = iso_curve("A1", IsoCurve(held, at, 0.0, 0.5), surface)
    assert half.evaluate(np.array([half.domain[1]]))[0][0] == pytest.approx(points[150], abs=1e-9)


@pytest.mark.parametrize("surface", [Plane(), Cylinder(5000.0), Offset(Sphere(9000.0), 10.0)])
def test_surfaces_without_bounded_parameters_have_no_iso_curve(surface):
    with pytest.raises(BendTorsionError) as problem:
        iso_curve("A1", IsoCurve("u", 0.5), surface)
    assert [f.code for f in problem.value.findings] == ["axis-rule-patch"]
