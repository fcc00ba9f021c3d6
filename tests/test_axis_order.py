# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shuffled segments and bare points put in order; gaps, branches and doubt told with places."""

import time

import numpy as np
import pytest
from exact_axes import curves

from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.axes.axis_order import chain_curves, chain_points, chain_segments
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.curve import Curve

CURVES = curves()


def cut(points, rng, count=4):
    """The run of points as shuffled segments, some turned."""
    at = np.sort(rng.choice(np.arange(1, len(points) - 1), count, replace=False))
    edges = [0, *at, len(points) - 1]
    parts = [points[a : b + 1] for a, b in zip(edges[:-1], edges[1:])]
    parts = [part[::-1] if rng.random() < 0.5 else part for part in parts]
    return [parts[k] for k in rng.permutation(len(parts))]


def refusals(segments):
    with pytest.raises(BendTorsionError) as caught:
        chain_segments("A1", tuple(segments))
    return caught.value.findings


def test_shuffled_and_turned_segments_are_restored():
    for seed in range(60):
        rng = np.random.default_rng(seed)
        exact = CURVES[("E-S", "T-diag", "N-diag", "HP-line")[seed % 4]]
        points = exact.points(int(rng.integers(7, 20)), seed, 50.0)
        chain = chain_segments("A", tuple(cut(points, rng)))
        assert not chain.closed and not chain.findings
        assert (
            np.abs(chain.points - points).max() == 0
            or np.abs(chain.points[::-1] - points).max() == 0
        )


def test_segments_of_a_ring_close():
    rng = np.random.default_rng(4)
    points = CURVES["E-ring"].points(12, 1, 3.0)
    chain = chain_segments("A", tuple(cut(np.vstack([points, points[:1]]), rng)))
    assert chain.closed and len(chain.points) == len(points)
    steps = np.linalg.norm(np.diff(np.vstack([chain.points, chain.points[:1]]), axis=0), axis=1)
    around = np.linalg.norm(np.diff(np.vstack([points, points[:1]]), axis=0), axis=1)
    assert np.sort(steps) == pytest.approx(np.sort(around))
    axis = axis_from(
        AxisInput("A", segments=tuple(cut(np.vstack([points, points[:1]]), rng))),
        CURVES["E-ring"].surface,
    )
    assert axis.closed


def test_ends_that_differ_by_less_than_the_tolerance_meet_in_the_middle():
    first = np.array([[0, 0, 0], [1000, 0, 0.0]])
    second = np.array([[1000, 0.6, 0], [2000, 0, 0]])
    chain = chain_segments("A", (first, second))
    assert chain.points == pytest.approx(np.array([[0, 0, 0], [1000, 0.3, 0], [2000, 0, 0]]))


def test_a_gap_is_told_with_its_place_and_width():
    points = CURVES["E-S"].points(12, 0, 2.0)
    parts = [points[:4], points[3:7], points[8:]]
    [finding] = refusals(parts)
    assert finding.code == "axis-segment-gap"
    assert finding.value == pytest.approx(np.linalg.norm(points[8] - points[6]))
    x = f"{points[6][0]:.0f}", f"{points[8][0]:.0f}"
    assert any(value in finding.position for value in x)
    assert "segment 2" in finding.message and "segment 3" in finding.message


def test_a_branch_is_told_with_its_place():
    points = CURVES["E-S"].points(9, 0, 2.0)
    twig = np.array([points[4], points[4] + [0, 0, 900.0]])
    [finding] = refusals([points[:5], points[4:], twig])
    assert finding.code == "axis-branch" and "1, 2, 3" in finding.message
    assert f"{points[4][0]:.0f}" in finding.position


def test_thousands_of_segments_are_joined_at_once_and_told_in_a_line():
    x = np.arange(3001.0)[:, None] * [10.0, 0, 0]
    steps = [x[k : k + 2] for k in range(3000)]
    tips = np.column_stack([np.cos(x[:, 0]), np.sin(x[:, 0]), x[:, 0]]) * 1e3
    arcs = [np.array([[0, 0, 0], [500, 10.0 * k, 0], [1000, 0, 0]]) for k in range(3000)]
    crosses = [np.array([[0, 0, 0], tip]) + 1e6 * k for k in range(30) for tip in np.eye(3) * 9]
    started = time.perf_counter()
    chain = chain_segments("A1", tuple(steps[::2] + steps[1::2] + steps[:2]))
    assert np.array_equal(chain.points, x) and len(chain.findings) == 2
    star = refusals([np.array([[0, 0, 0], tip]) for tip in tips])
    many_arcs, many_crosses, lone = refusals(arcs), refusals(crosses), refusals(steps[::2])
    assert time.perf_counter() - started < 5.0
    assert [f.value for f in star] == [3001] and [f.value for f in many_arcs] == [3000] * 2
    assert star[0].message == "segments 1, 2, 3, 4, 5, 6, … all meet at one place"
    [finding] = many_crosses
    assert finding.code == "axis-branch" and "30 places" in finding.message
    [finding] = lone
    assert finding.code == "axis-segment-gap" and "1500 chains" in finding.message


def test_bare_points_have_a_limit():
    with pytest.raises(BendTorsionError) as caught:
        chain_points("A1", np.arange(3003.0).reshape(-1, 3))
    [finding] = caught.value.findings
    assert (finding.code, finding.value, finding.limit) == ("axis-too-many-points", 1001, 1000)


def test_a_segment_given_twice_and_one_without_length_are_left_out():
    points = CURVES["E-S"].points(9, 0, 2.0)
    speck = points[4] + np.array([[0, 0, 0], [0, 0, 0.1]])
    chain = chain_segments("A", (points[:5], points[4:], points[4:][::-1], speck))
    assert np.array_equal(chain.points, points)
    assert [(f.code, f.position) for f in chain.findings] == [
        ("axis-segment-twice", "segment 3"),
        ("axis-segment-short", "segment 4"),
    ]


def test_bare_points_find_their_order_from_any_shuffle():
    for seed in range(30):
        rng = np.random.default_rng(seed)
        exact = CURVES[("E-diag", "E-S", "T-diag", "N-diag")[seed % 4]]
        points = exact.points(int(rng.integers(8, 25)), seed, 3.0)
        shuffle = rng.permutation(len(points))
        chain = chain_points("A", points[shuffle])
        back = chain.points[::-1]
        assert np.array_equal(chain.points, points) or np.array_equal(back, points)
        assert np.array_equal(points[shuffle][chain.order], chain.points)
        assert chain.order[0] < chain.order[-1]


def test_points_of_a_ring_find_their_order():
    exact = CURVES["E-wave"]
    points = exact.points(20, 2, 2.0)
    chain = chain_points("A", np.random.default_rng(0).permutation(points), closed=True)
    start = int(np.argmin(np.linalg.norm(points - chain.points[0], axis=1)))
    turned = np.roll(points, -start, axis=0)
    back = np.vstack([turned[:1], turned[:0:-1]])
    assert np.array_equal(chain.points, turned) or np.array_equal(chain.points, back)


def test_a_doubtful_order_is_told():
    # Two rows side by side, as far apart as the points along them.
    x = np.arange(6) * 1000.0
    rows = [np.column_stack([x, np.full_like(x, y), 0 * x]) for y in (0.0, 1000.0)]
    points = np.vstack(rows)
    chain = chain_points("A", points)
    [finding] = chain.findings
    assert (finding.severity, finding.code) == ("warning", "axis-order-ambiguous")
    assert finding.position.startswith("point ")
    line = CURVES["E-diag"].points(12, 0, 2.0)
    assert not chain_points("A", line).findings


def test_findings_call_points_as_they_were_given():
    exact = CURVES["E-diag"]
    points = exact.points(9, 0, 2.0)
    points[6] += 40.0 * exact.surface.closest(points).normals[6]
    shuffle = np.random.default_rng(1).permutation(9)
    axis = axis_from(AxisInput("A", points=points[shuffle], order="nearest"), exact.surface)
    [finding] = [f for f in axis.findings if f.code == "axis-point-moved"]
    assert finding.position == f"point {int(np.flatnonzero(shuffle == 6)[0]) + 1}"


def test_points_given_twice_are_left_out():
    points = CURVES["E-diag"].points(9, 0, 2.0)
    chain = chain_points("A", np.vstack([points, points[3]]))
    assert len(chain.points) == 9 and chain.findings[0].position == "point 10"


def test_exact_curves_are_joined_in_any_order():
    half = np.sqrt(0.5)
    arc = Curve(
        2,
        np.array([0, 0, 0, 1, 1, 1.0]),
        np.array([[5e3, 0, 0], [10e3, 0, 0], [10e3, 5e3, 0.0]]),
        np.array([1, half, 1]),
    )
    first = Curve(1, np.array([0, 0, 1, 1.0]), np.array([[5e3, 0, 0], [0, 0, 0.0]]))
    last = Curve(1, np.array([0, 0, 1, 1.0]), np.array([[10e3, 5e3, 0], [10e3, 9e3, 0.0]]))
    curve, _ = chain_curves("A", (arc, last, first))
    axis = axis_from(AxisInput("A", curve=curve), None)
    assert axis.length == pytest.approx(5e3 + 2.5e3 * np.pi + 4e3, abs=1e-7)
    s = np.sort([0.0, 5e3, 5e3 + 1.25e3 * np.pi, axis.length])
    middle = [5e3 + 5e3 * half, 5e3 - 5e3 * half, 0]
    wanted = np.array([[0, 0, 0], [5e3, 0, 0], middle, [10e3, 9e3, 0]])
    found = axis.position(s)
    if found[0][1] > 1:
        found = axis.position(axis.length - s)
    assert np.abs(found - wanted).max() < 1e-6
