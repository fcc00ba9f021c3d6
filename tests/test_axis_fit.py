# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closed axes, offsets, end tangents and rules for control points; what bad points are told."""

import numpy as np
import pytest
from exact_axes import curves

from BendTorsionWB.core.axes.axis import axis_from_curve, fit_axis, fit_uncertainty
from BendTorsionWB.core.axes.axis_fit import Refinement
from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from, axis_uncertainty
from BendTorsionWB.core.axes.axis_smoothness import smoothness
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.geometry.surface import Ellipsoid, Offset, Sphere

HALL = Ellipsoid(40e3, 30e3, 20e3)
CURVES = curves()
RINGS = [name for name, curve in CURVES.items() if curve.closed]


def codes(axis):
    return [finding.code for finding in axis.findings]


def refusal(surface=HALL, **given):
    with pytest.raises(BendTorsionError) as caught:
        axis_from(AxisInput("A1", **given), surface)
    return caught.value.findings[0]


@pytest.mark.parametrize("name", CURVES)
def test_a_pulled_axis_through_sparse_points_lies_on_its_surface(name):
    exact = CURVES[name]
    for seed in range(4):
        points = exact.points(6 + 3 * seed, seed, 50.0)
        axis = fit_axis(name, points, exact.surface, closed=exact.closed)
        rms, largest = axis.distance_to(exact.surface)
        assert rms <= 0.003 and largest <= 0.0065
        assert axis.closed == exact.closed


@pytest.mark.parametrize("name", RINGS)
def test_a_closed_axis_is_smooth_across_its_seam(name):
    exact = CURVES[name]
    axis = fit_axis(name, exact.points(15, 1, 3.0), exact.surface, closed=True)
    ends = np.array([0.0, axis.length])
    assert np.abs(np.diff(axis.position(ends), axis=0)).max() < 1e-10
    assert np.abs(np.diff(axis.tangent(ends), axis=0)).max() < 1e-9
    assert np.abs(np.diff(axis.curvature(ends), axis=0)).max() < 1e-10
    assert np.array_equal(axis.curve.poles[0], axis.curve.poles[-1])


def test_where_a_closed_axis_starts_does_not_change_it():
    exact = CURVES["E-wave"]
    points = exact.points(15, 3, 2.0)
    one = fit_axis("A", points, exact.surface, closed=True)
    two = fit_axis("A", np.roll(points, -6, axis=0), exact.surface, closed=True)
    assert one.length == pytest.approx(two.length, abs=0.5)
    near = two.place_of(one.position(np.linspace(0, one.length, 50)))
    away = two.position(near) - one.position(np.linspace(0, one.length, 50))
    assert np.linalg.norm(away, axis=1).max() < 0.5


def test_a_ring_may_repeat_its_first_point():
    points = CURVES["E-ring"].points(12, 0, 2.0)
    once = fit_axis("A", points, HALL, closed=True)
    twice = fit_axis("A", np.vstack([points, points[:1]]), HALL, closed=True)
    assert twice.length == pytest.approx(once.length, abs=1e-9)


@pytest.mark.parametrize("distance", [-500.0, 800.0])
def test_an_offset_axis_holds_its_distance(distance):
    points = CURVES["E-diag"].points(9, 2)
    axis = fit_axis("A", points, HALL, "offset", offset=distance)
    s = np.linspace(0, axis.length, 301)
    assert HALL.closest(axis.position(s)).distance == pytest.approx(distance, abs=0.0065)
    assert axis.distance_to(HALL)[1] <= 0.0065 and not axis.findings
    # Not given, the points say it.
    outside = Offset(HALL, distance).closest(points).points
    told = fit_axis("A", outside, HALL, "offset")
    assert told.offset == pytest.approx(distance, abs=1e-6)
    assert told.length == pytest.approx(axis.length, rel=1e-4)
    assert codes(told) == ["axis-offset-measured"]


@pytest.mark.parametrize("count", [2, 3, 4, 9])
@pytest.mark.parametrize("ends", [(True, False), (False, True), (True, True)])
def test_given_tangents_are_kept(count, ends):
    exact = CURVES["E-S"]
    points, rates, *_ = exact.derivatives(np.linspace(0, 1, count))
    wanted = [rate if end else None for rate, end in zip(rates[[0, -1]], ends)]
    axis = fit_axis("A", points, exact.surface, start_tangent=wanted[0], end_tangent=wanted[1])
    for s, tangent in zip((0.0, axis.length), wanted):
        if tangent is not None:
            # The pull may turn the curve only about its points on the surface.
            cosine = axis.tangent(np.array([s]))[0] @ tangent / np.linalg.norm(tangent)
            assert cosine > 1 - 1e-9
    assert axis.distance_to(exact.surface)[0] <= 0.003


def test_rules_for_control_points_hold_between_them():
    points = CURVES["T-diag"].points(9, 1, 3.0)
    surface = CURVES["T-diag"].surface

    def spans(**rule):
        axis = fit_axis("A", points, surface, refinement=Refinement(**rule), tolerance=1.0)
        return axis, axis.place_of(axis.control)

    axis, at = spans(chord_sag=2.0)
    for a, b in zip(at[:-1], at[1:]):
        run = axis.position(np.linspace(a, b, 21))
        along = (run[-1] - run[0]) / np.linalg.norm(run[-1] - run[0])
        away = run - run[0]
        sag = np.linalg.norm(away - (away @ along)[:, None] * along, axis=1).max()
        assert sag <= 2.0 * 1.02
    axis, at = spans(tangent_turn=np.radians(2.0))
    x = axis.tangent(at)
    turned = np.degrees(np.arccos(np.clip((x[1:] * x[:-1]).sum(1), -1, 1)))
    assert 1.0 < turned.max() <= 2.02
    plain = len(spans()[0].control)
    axis, at = spans(twist_step=np.radians(2.0))
    normals = surface.closest(axis.position(at)).normals
    x = axis.tangent(0.5 * (at[1:] + at[:-1]))
    turn = np.degrees(np.abs((np.cross(normals[:-1], normals[1:]) * x).sum(1)))
    assert turn.max() <= 2.05 and len(axis.control) > 2 * plain
    assert spans(max_spacing=500.0)[1] == pytest.approx(spans(max_spacing=500.0)[1])
    assert np.diff(spans(max_spacing=500.0)[1]).max() <= 500.5


def test_uncertainty_shrinks_with_more_points_and_covers_the_true_error():
    exact = CURVES["E-diag"]
    truth = exact.derivatives(np.linspace(0, 1, 4001))[0]
    told, real = [], []
    for count in (7, 13, 25):
        points = exact.derivatives(np.linspace(0, 1, count))[0]
        told.append(fit_uncertainty("A", points, exact.surface).max())
        axis = fit_axis("A", points, exact.surface)
        s = axis.place_of(truth[::40])
        real.append(np.linalg.norm(axis.position(s) - truth[::40], axis=1).max())
    assert told[0] > 3 * told[1] > 9 * told[2] > 0
    assert all(r < t for r, t in zip(real, told))
    # It is none of the distance to the surface, which stays within tolerance.
    assert told[0] > 0.05 > fit_axis("A", points, exact.surface).distance_to(exact.surface)[1]


def test_points_rounded_to_a_millimetre_are_pulled_and_told():
    exact = CURVES["T-diag"]
    axis = fit_axis("A", np.round(exact.points(11, 4)), exact.surface)
    assert axis.distance_to(exact.surface)[0] <= 0.003
    [finding] = axis.findings
    assert finding.code == "axis-points-pulled" and "rounded to 1 mm" in finding.message
    assert finding.value == pytest.approx(axis.moved.max())


POINTS = CURVES["E-diag"].points(9, 5, 3.0)


@pytest.mark.parametrize(
    "points, code, words",
    [
        (POINTS / 1000, "axis-far-from-surface", "metres"),
        (POINTS / 25.4, "axis-far-from-surface", "inches"),
        (POINTS + [0, 0, 10e3], "axis-far-from-surface", "far"),
        (POINTS[[0, 1, 2, 6, 5, 4, 8, 3, 7]], "axis-crosses-itself", "crosses"),
        (POINTS[:1], "axis-too-few-points", "two points"),
        (POINTS[[0, 1, 2, 2, 3]], "axis-points-coincide", "coincide"),
    ],
)
def test_points_that_would_give_a_wrong_curve_are_refused(points, code, words):
    finding = refusal(points=points)
    assert finding.code == code and finding.mend
    assert words.split()[0] in finding.line() or code == "axis-too-few-points"


@pytest.mark.parametrize(
    ("axis", "surface", "words"),
    [
        (1e-3, 1.0, "coordinates are likely in metres"),
        (1.0, 1e-3, "surface is likely in metres and taken for mm"),
        (1e3, 1.0, "coordinates are likely in mm and taken for metres"),
        (1.0, 1e3, "surface is likely in mm and taken for metres"),
        (1.0, 0.1, "surface is likely in centimetres and taken for mm"),
        (1.0, 1 / 25.4, "surface is likely in inches and taken for mm"),
        (0.1, 1.0, "coordinates are likely in centimetres"),
    ],
)
def test_whichever_of_axis_and_surface_is_in_another_unit_is_told(axis, surface, words):
    hall = Ellipsoid(*(surface * size for size in (HALL.a, HALL.b, HALL.c)))
    finding = refusal(hall, points=axis * POINTS)
    assert finding.code == "axis-far-from-surface" and words in finding.message


def test_an_axis_is_not_small_enough_for_any_unit_where_the_surface_passes_the_origin():
    """A ring 10 m wide at the level of the crown of a dome, 2.7 m above it: a thousandth of it
    would be next to the crown, and is no axis of the dome."""
    turn = np.linspace(0.0, 1.9 * np.pi, 12)
    ring = 10e3 * np.column_stack([np.cos(turn), np.sin(turn), 0.0 * turn])
    finding = refusal(Sphere(20e3, (0.0, 0.0, -20e3)), points=ring)
    assert finding.code == "axis-far-from-surface" and "likely" not in finding.message


def test_a_size_in_metres_is_told_without_a_surface():
    axis = fit_axis("A", POINTS / 1000)
    assert codes(axis) == ["axis-size"] and "metres" in axis.findings[0].message
    assert not fit_axis("A", POINTS).findings


def test_keep_far_from_its_surface_is_a_warning():
    axis = fit_axis("A", POINTS + [0, 0, 10e3], HALL, "keep")
    assert codes(axis) == ["axis-far-from-surface"]
    assert axis.findings[0].severity == "warning"


def test_gaps_of_one_to_a_thousand_are_merged_or_told():
    near = HALL.closest(POINTS[4:5] + (POINTS[5] - POINTS[4]) / 1000).points[0]
    axis = fit_axis("A", np.insert(POINTS, 5, near, axis=0), HALL)
    assert codes(axis) == ["axis-point-merged"]
    assert axis.length == pytest.approx(fit_axis("A", POINTS, HALL).length, abs=1e-9)
    dense = CURVES["E-diag"].derivatives(np.append(np.linspace(0, 0.02, 8), 1.0))[0]
    wide = fit_axis("A", dense, HALL)
    assert "axis-gap" in codes(wide)
    assert next(f for f in wide.findings if f.code == "axis-gap").position == "point 8"


def test_a_ring_left_open_is_told():
    points = CURVES["E-ring"].points(12, 0, 2.0)
    axis = fit_axis("A", np.vstack([points, points[:1]]), HALL)
    assert "axis-ends-meet" in codes(axis) and not axis.closed


def test_a_kinked_wire_is_refused_with_its_place_and_a_polyline_is_points():
    corner = Curve(
        1, np.array([0, 0, 1, 2, 2.0]), np.array([[0, 0, 0], [5e3, 0, 0], [5e3, 5e3, 0.0]])
    )
    with pytest.raises(BendTorsionError) as caught:
        axis_from_curve("A", corner)
    [finding] = caught.value.findings
    assert finding.code == "axis-kink" and "5000, 0, 0" in finding.position
    assert finding.value == pytest.approx(90.0)
    knots = np.concatenate([[0], np.arange(9), [8]]).astype(float)
    drawn = axis_from(AxisInput("A", curve=Curve(1, knots, POINTS)), HALL)
    assert codes(drawn) == ["axis-polyline"]
    assert drawn.length == pytest.approx(fit_axis("A", POINTS, HALL).length, abs=1e-9)


def test_an_exact_ring_is_found_to_be_closed():
    half = np.sqrt(0.5)
    square = np.array(
        [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]]
    )
    ring = Curve(
        2,
        np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4.0]),
        np.column_stack([9e3 * square, np.zeros(9)]),
        np.array([1, half, 1, half, 1, half, 1, half, 1]),
    )
    axis = axis_from_curve("A", ring)
    assert axis.closed and axis.length == pytest.approx(18e3 * np.pi, abs=1e-7)
    assert np.abs(np.diff(axis.position(np.array([0.0, axis.length])), axis=0)).max() < 1e-10


def test_reversed_turns_the_axis_and_keeps_the_points_numbers():
    plain = axis_from(AxisInput("A", points=POINTS), HALL)
    back = axis_from(AxisInput("A", points=POINTS, reversed=True), HALL)
    s = np.linspace(0, plain.length, 40)
    assert np.abs(plain.position(s) - back.position(plain.length - s)).max() < 1e-8
    assert np.array_equal(back.given, POINTS)
    assert (
        np.abs(
            back.curve.evaluate(np.array(back.curve.domain))[0]
            - back.position(np.array([0.0, back.length]))
        ).max()
        < 1e-8
    )


def test_direction_by_rule_goes_from_the_low_end_to_the_high():
    for points in (POINTS, POINTS[::-1]):
        axis = axis_from(AxisInput("A", points=points, direction="rule"), HALL)
        z = axis.position(np.array([0.0, axis.length]))[:, 2]
        assert z[1] > z[0]
    level = np.array([[3e3, 0, 0], [1e3, 500, 0], [-2e3, 0, 0]])
    axis = axis_from(AxisInput("A", points=level, direction="rule"), None)
    assert np.diff(axis.position(np.array([0.0, axis.length]))[:, 0]) > 0


def test_curvature_before_and_after_is_that_of_a_circle():
    ball = Sphere(30e3)
    angle = np.linspace(0.2, 1.3, 12)
    points = 30e3 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    data = smoothness(fit_axis("A", points, ball))
    assert data.polygon_curvature == pytest.approx(1 / 30e3, rel=1e-9)
    assert data.after_curvature == pytest.approx(1 / 30e3, rel=0.02)
    assert np.abs(data.after_curvature * 30e3 - 1).mean() < 0.004
    assert data.before.shape == data.before_curvature.shape
    assert data.after[-1] == pytest.approx(33e3)


def test_exact_curves_leave_nothing_open():
    line = Curve(1, np.array([0, 0, 1, 1.0]), POINTS[[0, 1]])
    assert axis_uncertainty(AxisInput("A", curve=line), None).largest == 0.0


def test_an_exact_curve_far_from_its_surface_is_refused_as_points_are():
    """Wherever it comes from; fit keep says that it is meant to be there."""
    arc = fit_axis("A", POINTS, HALL).curve
    far = Curve(arc.degree, arc.knots, arc.poles + [0, 0, 20e3], arc.weights)
    metres = Curve(arc.degree, arc.knots, arc.poles / 1000, arc.weights)
    for curve, words in ((far, "far"), (metres, "metres")):
        with pytest.raises(BendTorsionError) as refused:
            axis_from(AxisInput("A", curve=curve), HALL)
        [finding] = refused.value.findings
        assert (finding.code, finding.severity) == ("axis-far-from-surface", "error")
        assert words in finding.message and finding.value > finding.limit
        points = curve.evaluate(np.linspace(*curve.domain, 9))[0]
        of_points = refusal(points=points)
        assert (of_points.code, of_points.mend) == (finding.code, finding.mend)
        kept = axis_from(AxisInput("A", curve=curve, fit="keep"), HALL)
        assert [f.severity for f in kept.findings if f.code == finding.code] == ["warning"]
    near = Curve(arc.degree, arc.knots, arc.poles + [0, 0, 20], arc.weights)
    [left] = axis_from(AxisInput("A", curve=near), HALL).findings
    assert left.severity == "warning" and "lies off its surface" in left.message
