# SPDX-License-Identifier: LGPL-2.1-or-later
"""The axis: how near it comes to its surface, what it does not depend on, what it reports."""

import numpy as np
import pytest
from curved_members import ELLIPSOID, HALF_AXES, diagonal, irregular, oblique, on_torus, rotation

from BendTorsionWB.core.axes.axis import axis_from_curve, fit_axis
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.geometry.surface import analytic_surface

TORUS = analytic_surface("torus", {"R": 30000.0, "r": 8000.0})
PLANE = analytic_surface("plane", {})
CASES = {
    "diagonal": (diagonal, ELLIPSOID),
    "oblique": (oblique, ELLIPSOID),
    "torus": (on_torus, TORUS),
}


@pytest.mark.parametrize("case", CASES)
def test_nine_irregular_points_give_an_axis_on_the_surface(case):
    curve, surface = CASES[case]
    for seed in range(25):
        points = irregular(curve, 9, seed)
        axis = fit_axis("A1", points, surface)
        rms, largest = axis.distance_to(surface)
        # 0.005 holds at ¼, ½ and ¾ of every span; between them by a hair more.
        assert rms <= 0.003 and largest <= 0.0055
        # It stays on its points, and near the curve they came from.
        along = axis.place_of(points)
        assert np.linalg.norm(axis.position(along) - points, axis=1).max() < 1e-3
        assert (np.diff(along) > 0).all()
        assert not axis.findings


def test_the_length_is_that_of_the_exact_curve():
    dense = oblique(np.linspace(0, 1, 4001))
    exact = np.linalg.norm(np.diff(dense, axis=0), axis=1).sum()
    assert fit_axis("A1", irregular(oblique), ELLIPSOID).length == pytest.approx(exact, abs=2.0)
    assert fit_axis("A1", oblique(np.linspace(0, 1, 81)), ELLIPSOID).length == pytest.approx(
        exact, abs=1e-3
    )


def test_the_parameter_is_arc_length():
    axis = fit_axis("A1", irregular(diagonal), ELLIPSOID)
    s = np.linspace(0, axis.length, 333)
    assert np.abs(np.linalg.norm(axis.tangent(s), axis=1) - 1).max() < 1e-9
    dense = axis.position(np.linspace(0, axis.length, 20001))
    steps = np.linalg.norm(np.diff(dense, axis=0), axis=1)
    assert steps.sum() == pytest.approx(axis.length, abs=1e-4)


def test_reversed_points_give_the_same_curve():
    points = irregular(oblique)
    there, back = fit_axis("A1", points, ELLIPSOID), fit_axis("A1", points[::-1], ELLIPSOID)
    assert back.length == pytest.approx(there.length, abs=1e-8)
    s = np.linspace(0, there.length, 101)
    assert np.abs(there.position(s) - back.position(there.length - s)).max() < 1e-7


def test_a_rigid_motion_moves_the_axis_with_its_points():
    shift, turn = np.array([1200.0, -800.0, 5000.0]), rotation()
    points = irregular(diagonal, 7)
    kept = fit_axis("A1", points, None)
    moved = fit_axis("A1", points @ turn.T + shift, None)
    s = np.linspace(0, kept.length, 57)
    assert np.abs(moved.position(s) - (kept.position(s) @ turn.T + shift)).max() < 1e-8
    moved_surface = analytic_surface("ellipsoid", dict(zip("abc", HALF_AXES)), shift)
    pulled = fit_axis("A1", points, ELLIPSOID)
    both = fit_axis("A1", points + shift, moved_surface)
    assert np.abs(both.position(s) - (pulled.position(s) + shift)).max() < 1e-7


def test_ten_times_the_size_is_ten_times_the_curve():
    big = analytic_surface("ellipsoid", dict(zip("abc", 10 * HALF_AXES)))
    points = irregular(diagonal)
    small = fit_axis("A1", points, ELLIPSOID, tolerance=0.005)
    large = fit_axis("A1", 10 * points, big, tolerance=0.05)
    s = np.linspace(0, small.length, 99)
    assert np.abs(large.position(10 * s) - 10 * small.position(s)).max() < 1e-6


def test_keep_leaves_points_and_curve_where_they_are():
    points = irregular(diagonal)
    points[3] += [0.0, 0.0, 40.0]
    axis = fit_axis("A1", points, ELLIPSOID, fit="keep")
    assert np.array_equal(axis.control, points) and not axis.moved.any() and not axis.findings
    assert axis.distance_to(ELLIPSOID)[1] > 10


def test_a_point_off_the_surface_is_pulled_and_told():
    points = irregular(diagonal)
    normal = ELLIPSOID.closest(points).normals
    points[4] += 25.0 * normal[4]
    points[6] -= 0.5 * normal[6]
    axis = fit_axis("A1", points, ELLIPSOID)
    assert axis.distance_to(ELLIPSOID)[1] <= 0.005
    assert axis.moved[[4, 6]] == pytest.approx([25.0, 0.5], abs=1e-3)
    [finding] = [f for f in axis.findings if f.severity != "note"]
    assert (finding.severity, finding.code, finding.object) == ("warning", "axis-point-moved", "A1")
    assert finding.position == "point 5" and finding.value == pytest.approx(25.0, abs=1e-3)


def test_an_inner_point_too_close_to_its_neighbour_is_merged_and_told():
    points = irregular(diagonal)
    close = points[3] + 0.02 * (points[4] - points[3])
    axis = fit_axis("A1", np.insert(points, 4, close, axis=0), ELLIPSOID)
    [finding] = [f for f in axis.findings if f.code == "axis-point-merged"]
    assert finding.severity == ("warning" if finding.value > 1.0 else "note")
    assert finding.position == "point 5" and finding.value > 0.1
    clean = fit_axis("A1", points, ELLIPSOID)
    assert axis.length == pytest.approx(clean.length, abs=1e-9)


def test_end_points_are_never_merged_away():
    points = irregular(diagonal)
    near_end = points[-1] + 0.02 * (points[-2] - points[-1])
    axis = fit_axis("A1", np.insert(points, len(points) - 1, near_end, axis=0), None)
    assert np.abs(axis.position([0.0, axis.length]) - points[[0, -1]]).max() < 1e-9


def test_two_points_are_a_line_and_three_a_parabola():
    line = fit_axis("A1", [[0, 0, 0], [3000, 4000, 0]], None)
    assert line.length == pytest.approx(5000) and line.curve.degree == 1
    assert line.position([2500.0])[0] == pytest.approx([1500, 2000, 0])
    bow = fit_axis("A1", [[0, 0, 0], [1000, 300, 0], [2000, 0, 0]], None)
    x = bow.position(np.linspace(0, bow.length, 41))
    assert bow.curve.degree == 2
    assert np.abs(x[:, 1] - 300 * (1 - ((x[:, 0] - 1000) / 1000) ** 2)).max() < 1e-8


def test_two_points_with_a_surface_follow_it():
    axis = fit_axis("A1", diagonal([0.0, 1.0]), ELLIPSOID)
    assert axis.distance_to(ELLIPSOID)[1] <= 0.005
    assert axis.length > np.linalg.norm(np.diff(diagonal([0.0, 1.0]), axis=0)) * 1.01


def test_the_largest_spacing_holds():
    axis = fit_axis("A1", irregular(diagonal), ELLIPSOID, max_spacing=400.0)
    gaps = np.linalg.norm(np.diff(axis.control, axis=0), axis=1)
    assert 300 < gaps.max() <= 400.0


@pytest.mark.parametrize(
    "points, code, position",
    [
        ([[0, 0, 0]], "axis-too-few-points", ""),
        (np.empty((0, 3)), "axis-too-few-points", ""),
        ([[0, 0, 0], [1, np.nan, 0], [2, 0, 0]], "axis-point-not-a-number", "point 2"),
        ([[0, 0, 0], [np.inf, 1, 0]], "axis-point-not-a-number", "point 2"),
        ([[0, 0, 0], [1e300, 1, 0]], "axis-point-too-far", "point 2"),
        ([[0, 0, 0], [500, 0, 0], [500, 0, 1e-4]], "axis-points-coincide", "point 3"),
    ],
)
def test_what_is_no_axis_is_refused_with_its_point(points, code, position):
    with pytest.raises(BendTorsionError) as caught:
        fit_axis("A7", points, PLANE)
    [finding] = caught.value.findings
    assert (finding.code, finding.object, finding.position) == (code, "A7", position)
    assert finding.mend


def test_an_exact_curve_is_used_as_it_is():
    half = np.sqrt(0.5)
    quarter = Curve(
        2,
        np.array([0.0, 0, 0, 1, 1, 1]),
        np.array([[5000.0, 0, 0], [5000, 5000, 0], [0, 5000, 0]]),
        np.array([1, half, 1]),
    )
    axis = axis_from_curve("A1", quarter)
    assert axis.length == pytest.approx(2500 * np.pi, abs=1e-8)
    angle = np.linspace(0, np.pi / 2, 31)
    circle = 5000 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    assert np.abs(axis.position(5000 * angle) - circle).max() < 1e-7


def test_the_place_of_a_point_is_where_the_axis_is_nearest():
    axis = fit_axis("A1", irregular(diagonal), ELLIPSOID)
    s = np.array([0.0, 3111.1, 17000.0, axis.length])
    normal = ELLIPSOID.closest(axis.position(s)).normals
    assert axis.place_of(axis.position(s) + 300 * normal) == pytest.approx(s, abs=0.05)
    assert axis.place_of(axis.position(s)) == pytest.approx(s, abs=1e-6)
