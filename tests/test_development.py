# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laying flat: exact on developables, both edges kept on all, the known diagonal error, inverse."""

import numpy as np
import pytest
from curved_members import member, rotation, tapered
from geodesic import path_length

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.flattening.development import develop, strain
from BendTorsionWB.core.flattening.surface_shape import shape_of
from BendTorsionWB.core.geometry.piecewise import Piecewise, resolve
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box


def ruled(first, second, length, spans=6):
    return resolve(
        lambda s: np.column_stack([first(s), second(s)]), np.linspace(0, length, spans + 1), length
    )


def cylinder(radius=12000.0, skew=0.08):
    """A strip of a cylinder about z between two skew curves, and how its points unroll."""

    def rail(offset, lean):
        def points(s):
            angle = s / radius
            height = offset + lean * s + 300 * np.sin(s / 2500)
            return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])

        return points

    rails = ruled(rail(0.0, skew), rail(800.0, -skew / 2), 6000.0)

    def unrolled(points):
        return np.column_stack([radius * np.arctan2(points[:, 1], points[:, 0]), points[:, 2]])

    return rails, unrolled


def cone(half_angle=0.35):
    """A strip of a cone about z, apex at the origin, and how its points unroll."""
    sine = np.sin(half_angle)

    def rail(reach, wave):
        def points(s):
            angle = s / 4000.0
            r = reach + wave * np.sin(s / 1700)
            return np.column_stack(
                [r * sine * np.cos(angle), r * sine * np.sin(angle), r * np.cos(half_angle)]
            )

        return points

    rails = ruled(rail(9000.0, 120.0), rail(9800.0, -90.0), 6000.0)

    def unrolled(points):
        r = np.linalg.norm(points, axis=1)
        angle = np.arctan2(points[:, 1], points[:, 0]) * sine
        return np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    return rails, unrolled


def helicoid(twist, width=800.0, length=6000.0):
    """A strip turning about its middle line x, rad/m."""
    rate = twist / 1000.0

    def rail(side):
        return lambda s: np.column_stack([s, side * np.cos(rate * s), side * np.sin(rate * s)])

    return ruled(rail(-width / 2), rail(width / 2), length)


def mesh(length, count=41):
    s = np.repeat(np.linspace(0, length, count), 5)
    return s, np.tile(np.linspace(0, 1, 5), count)


def aligned(points, target):
    """points (n, 2) moved onto target by the best proper motion."""
    a, b = points - points.mean(axis=0), target - target.mean(axis=0)
    u, _, v = np.linalg.svd(a.T @ b)
    turn = u @ np.diag([1, np.sign(np.linalg.det(u @ v))]) @ v
    return a @ turn + target.mean(axis=0)


@pytest.mark.parametrize("make", [cylinder, cone])
def test_developable_strips_unroll_to_their_closed_form(make):
    rails, unrolled = make()
    development = develop(rails)
    s, w = mesh(6000.0)
    flat, exact = development.flat(s, w), unrolled(development.point(s, w))
    sides = [np.cross(*np.diff(points[[0, 4, 5]], axis=0)) for points in (exact, flat)]
    if sides[0] * sides[1] < 0:
        exact = exact * [1, -1]
    assert np.abs(aligned(flat, exact) - exact).max() < 1e-7
    assert np.abs(strain(development, np.linspace(1, 5999, 99), np.linspace(0, 1, 5))).max() < 1e-10
    assert np.abs(shape_of(rails, np.linspace(1, 5999, 9), np.array([0.5])).gauss).max() < 1e-14


@pytest.mark.parametrize("twist", [0.01, 0.06])
def test_both_edges_and_every_ruling_of_a_helicoid_keep_their_length(twist):
    rails = helicoid(twist)
    development = develop(rails)
    exact = 6000.0 * np.sqrt(1 + (twist / 1000 * 400) ** 2)
    for w in (0.0, 1.0):
        speed = np.linalg.norm(edge(development, w).derivative.values, axis=2)
        assert Piecewise(development.plane.breaks, speed[..., None]).integral()[0] == (
            pytest.approx(exact, abs=1e-9)
        )
    s = np.linspace(0, 6000, 77)
    ends = [development.flat(s, np.full(77, w)) for w in (0.0, 1.0)]
    assert np.linalg.norm(ends[1] - ends[0], axis=1) == pytest.approx(800.0, abs=1e-9)


def edge(development, w):
    nodes = development.plane.nodes
    flat = development.flat(nodes.ravel(), np.full(nodes.size, w))
    return Piecewise(development.plane.breaks, flat.reshape(*nodes.shape, 2))


@pytest.mark.parametrize("twist", [0.01, 0.03, 0.06])
def test_the_error_of_a_diagonal_follows_its_law(twist):
    """flat − true ≈ |K| A² / (12 D), K = −τ², for a 500 × 800 panel."""
    rails = helicoid(twist)
    development = develop(rails)
    a, b = (np.array([2750.0]), np.array([0.0])), (np.array([3250.0]), np.array([1.0]))
    flat = np.linalg.norm(development.flat(*b) - development.flat(*a))
    true = path_length(lambda s: rails(s).reshape(-1, 2, 3), (2750.0, 0.0), (3250.0, 1.0))
    law = (twist / 1000) ** 2 * (500 * 800) ** 2 / (12 * np.hypot(500, 800))
    # Lengths are flat minus true; which sign the two diagonals have follows from K < 0.
    assert abs(flat - true) == pytest.approx(law, rel=0.05)
    assert shape_of(rails, np.array([3000.0]), np.array([0.5])).gauss[0, 0] == pytest.approx(
        -((twist / 1000) ** 2), rel=1e-9
    )


def test_strain_of_a_helicoid_is_that_of_its_metric():
    """The middle is stretched: edges √(1 + τ²b²/4) long, the middle line 1."""
    twist = 0.06
    development = develop(helicoid(twist))
    found = strain(development, np.array([3000.0]), np.array([0.0, 0.5, 1.0]))[0]
    expected = np.sqrt(1 + (twist / 1000 * 400) ** 2) - 1
    assert found == pytest.approx([0, expected, 0], abs=1e-12)


def test_points_map_from_the_plane_back_to_the_surface():
    development = develop(tapered_plate().rails.mid)
    s, w = mesh(1.0)
    start, end = development.plane.start, development.plane.end
    s = start + 1 + s * (end - start - 2)
    flat = development.flat(s, w)
    # A line square to the chord through the point crosses the ruling there, and gives w back.
    found = development.ruling_crossing(s, flat - [1000.0, 1.0], flat + [1000.0, 1.0])
    assert np.abs(found - w).max() < 1e-9
    assert np.abs(development.point(s, found) - development.point(s, w)).max() < 1e-6


def test_a_mirrored_surface_gives_the_mirrored_pattern():
    rails = helicoid(0.03)
    flat = develop(rails)
    mirrored = develop(resolve(lambda s: rails(s) * np.tile([1, 1, -1], 2), rails.breaks, 6000.0))
    s, w = mesh(6000.0)
    # Seen from P' × R on both, so that the rails run the same way in the plane.
    assert np.abs(mirrored.flat(s, w) - flat.flat(s, w)).max() < 1e-8
    swapped = develop(resolve(lambda s: rails(s)[:, [3, 4, 5, 0, 1, 2]], rails.breaks, 6000.0))
    other = swapped.flat(s, 1 - w) * [1, -1]
    assert np.abs(aligned(other, flat.flat(s, w)) - flat.flat(s, w)).max() < 1e-8


def test_a_rigid_motion_changes_nothing_in_the_plane():
    plate = tapered_plate()
    turn, shift = rotation(), np.array([4e4, -2e4, 1e4])
    here = develop(plate.rails.mid)
    moved = Piecewise(
        plate.rails.mid.breaks,
        np.concatenate(
            [plate.rails.mid.values[..., k : k + 3] @ turn.T + shift for k in (0, 3)], axis=-1
        ),
    )
    there = develop(moved)
    s, w = mesh(1.0)
    s = plate.start + s * (plate.end - plate.start)
    assert np.abs(there.flat(s, w) - here.flat(s, w)).max() < 1e-6


def tapered_plate():
    built = tapered("box2", align="top", align_to="previous")
    return next(p for p in split_plates(built, {})[0] if p.folds and p.face == "bottom")


def test_a_fold_is_crossed_without_tearing_or_turning():
    plate = tapered_plate()
    development = develop(plate.rails.mid)
    assert len(plate.folds) == 2
    # Both folds of the transition, and where the chamfers beside the plate begin.
    for fold in plate.rails.mid_folds:
        for w in (0.0, 0.5, 1.0):
            at = np.array([fold - 1e-7, fold + 1e-7])
            assert np.abs(np.diff(development.flat(at, np.full(2, w)), axis=0)).max() < 1e-6
        at = np.array([fold])
        before, after = (development.plane(at, side)[0, 2] for side in ("earlier", "later"))
        assert before == pytest.approx(after, abs=1e-12)
        # Lengths on the side before the fold are kept.
        for w in (0.0, 1.0):
            s = np.linspace(fold - 80, fold, 2001)
            space, plane = (
                np.linalg.norm(np.diff(f(s, np.full(2001, w)), axis=0), axis=1).sum()
                for f in (development.point, development.flat)
            )
            assert plane == pytest.approx(space, abs=1e-6)


@pytest.mark.parametrize(
    "second, message",
    [
        (lambda s: np.column_stack([3000 - s, 0 * s + 800, 0 * s]), "folds over itself"),
        (lambda s: np.column_stack([s, 0 * s, 0 * s]), "no width"),
    ],
)
def test_a_plate_over_itself_or_without_width_is_refused_with_its_place(second, message):
    rails = ruled(lambda s: np.column_stack([s, 0 * s, 0 * s]), second, 3000.0)
    with pytest.raises(BendTorsionError) as caught:
        develop(rails, "M1-T1")
    [finding] = caught.value.findings
    assert finding.code == "plate-folds-over" and finding.object == "M1-T1"
    assert message in finding.message and finding.position.startswith("s = ")


def test_edges_of_a_real_box_are_kept_on_all_four_faces():
    built = member([Segment(box("S", "box1", 800, 800, 20))])
    for plate in split_plates(built, {})[0]:
        development = develop(plate.rails.mid, plate.mark)
        for w in (0.0, 1.0):
            flat = np.linalg.norm(edge(development, w).derivative.values, axis=2)[..., None]
            rate = plate.rails.mid.derivative.values[..., 3 * int(w) : 3 * int(w) + 3]
            true = np.linalg.norm(rate, axis=2)[..., None]
            lengths = [Piecewise(plate.rails.mid.breaks, v).integral()[0] for v in (flat, true)]
            assert lengths[0] == pytest.approx(lengths[1], abs=1e-7)
