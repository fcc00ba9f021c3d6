# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends moved, places found, presets laid over the design axis."""

import numpy as np
import pytest
from exact_axes import curves

from BendTorsionWB.core.axes.axis import axis_from_curve, fit_axis
from BendTorsionWB.core.axes.axis_ends import AxisEnd, with_ends
from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.axes.axis_places import crossings, cut_place
from BendTorsionWB.core.axes.axis_preset import Preset, with_preset
from BendTorsionWB.core.axes.axis_rule import Geodesic, PlaneSection
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.geometry.surface import Ellipsoid, Sphere

HALL = Ellipsoid(40e3, 30e3, 20e3)
EXACT = curves()["E-diag"]
AXIS = fit_axis("A1", EXACT.points(12, 1, 2.0), HALL)
HALF = np.sqrt(0.5)
ARC = Curve(
    2,
    np.array([0, 0, 0, 1, 1, 1.0]),
    np.array([[10e3, 0, 0], [10e3, 0, 10e3], [0, 0, 10e3]]),
    np.array([1, HALF, 1]),
)


def refused(call, *arguments, **more):
    with pytest.raises(BendTorsionError) as caught:
        call(*arguments, **more)
    return caught.value.findings[0]


def height(axis, at_end):
    return axis.position(np.array([axis.length if at_end else 0.0]))[0, 2]


def test_trimming_keeps_the_rest_and_counts_from_the_new_start():
    cut = with_ends(AXIS, AxisEnd(extension=-2500.0), AxisEnd(extension=-1000.0), HALL)
    assert cut.length == pytest.approx(AXIS.length - 3500.0, abs=1e-6)
    s = np.linspace(0, cut.length, 77)
    assert np.abs(cut.position(s) - AXIS.position(s + 2500.0)).max() < 1e-6
    ends = cut.curve.evaluate(np.array(cut.curve.domain))[0]
    assert np.abs(ends - AXIS.position(np.array([2500.0, AXIS.length - 1000.0]))).max() < 1e-6
    assert cut.trimmed == (-2500.0, -1000.0)


@pytest.mark.parametrize("surface", [HALL, None])
def test_an_extension_runs_on_smoothly(surface):
    long = with_ends(AXIS, AxisEnd(extension=3000.0), AxisEnd(extension=2000.0), surface)
    assert long.length == pytest.approx(AXIS.length + 5000.0, abs=1e-5)
    s = np.linspace(0, AXIS.length, 77)
    assert np.abs(long.position(s + 3000.0) - AXIS.position(s)).max() < 1e-5
    for joint in (3000.0, 3000.0 + AXIS.length):
        turn = long.tangent(np.array([joint - 1e-3, joint + 1e-3]))
        assert np.linalg.norm(np.diff(turn, axis=0)) < 1e-6
        bend = long.curvature(np.array([joint - 1.0, joint + 1.0]))
        assert np.linalg.norm(np.diff(bend, axis=0)) < 3e-6
    if surface is not None:
        assert long.distance_to(HALL)[1] < 0.006


def test_an_extended_arc_goes_on_as_its_circle():
    arc = axis_from_curve("A1", ARC)
    long = with_ends(arc, AxisEnd(), AxisEnd(extension=4000.0))
    points = long.position(np.linspace(0, long.length, 99))
    assert np.linalg.norm(points, axis=1) == pytest.approx(10e3, abs=1e-4)
    angle = long.length / 10e3
    assert points[-1] == pytest.approx(10e3 * np.array([np.cos(angle), 0, np.sin(angle)]), abs=1e-3)


def test_a_great_circle_goes_on_as_a_great_circle():
    ball = Sphere(30e3)
    short = axis_from(AxisInput("A", rule=Geodesic((30e3, 0, 0), (20e3, 10e3, 20e3))), ball)
    long = with_ends(short, AxisEnd(), AxisEnd(extension=9000.0), ball)
    pole = np.cross(*short.position(np.array([0.0, short.length])))
    points = long.position(np.linspace(0, long.length, 99))
    assert np.abs(points @ pole / np.linalg.norm(pole)).max() < 1e-3


@pytest.mark.parametrize("surface", [HALL, None])
@pytest.mark.parametrize("dz", [-700.0, 350.0])
def test_ends_are_brought_to_their_height(surface, dz):
    low, high = height(AXIS, False), height(AXIS, True)
    moved = with_ends(AXIS, AxisEnd(dz=dz), AxisEnd(z=high + dz), surface)
    assert height(moved, False) == pytest.approx(low + dz, abs=1e-6)
    assert height(moved, True) == pytest.approx(high + dz, abs=1e-6)
    # The axis rises: a higher start is cut off, a higher end runs on.
    assert np.sign(moved.trimmed) == pytest.approx(np.array([-np.sign(dz), np.sign(dz)]))


def test_height_first_then_extension():
    high = height(AXIS, True)
    both = with_ends(AXIS, AxisEnd(), AxisEnd(z=high - 500.0, extension=800.0), HALL)
    only = with_ends(AXIS, AxisEnd(), AxisEnd(z=high - 500.0), HALL)
    assert both.length == pytest.approx(only.length + 800.0, abs=1e-5)


def test_ends_that_cannot_be_are_refused():
    assert refused(with_ends, AXIS, AxisEnd(), AxisEnd(z=28e3), HALL).code == "axis-end-height"
    short = AxisEnd(extension=-0.6 * AXIS.length)
    assert refused(with_ends, AXIS, short, short, HALL).code == "axis-too-short"
    far = AxisEnd(extension=3 * AXIS.length)
    assert refused(with_ends, AXIS, AxisEnd(), far, HALL).code == "axis-extension"
    ring = axis_from(
        AxisInput("R", rule=PlaneSection((0, 0, 5e3), (0, 0, 1), (39e3, 0, 5e3), closed=True)), HALL
    )
    assert refused(with_ends, ring, AxisEnd(), AxisEnd(dz=10), HALL).code == "axis-end-closed"


def line(start, end):
    length = float(np.linalg.norm(np.subtract(end, start)))
    poles = np.array([start, end], float)
    return axis_from_curve("L", Curve(1, np.array([0, 0, length, length]), poles))


def test_crossing_axes_give_place_and_distance_on_each():
    one, two = line((0, 0, 0), (9e3, 0, 0)), line((2e3, -3e3, 40), (2e3, 5e3, 40))
    [found] = crossings(one, two)
    assert (found.first, found.second) == pytest.approx((2e3, 3e3), abs=1e-6)
    assert found.distance == pytest.approx(40.0, abs=1e-9)
    # Nearest at an end, and twice on an arc.
    [end] = crossings(one, line((9.5e3, -1e3, 0), (9.5e3, 1e3, 0)))
    assert (end.first, end.distance) == pytest.approx((9e3, 500.0), abs=1e-6)
    arc = axis_from_curve("C", ARC)
    chord = line((12e3, 0, 0), (-2e3, 0, 14e3 * 0.9))
    both = crossings(chord, arc)
    assert len(both) == 2 and all(item.distance < 1e-6 for item in both)
    for item in both:
        assert np.linalg.norm(item.first_point) == pytest.approx(10e3, abs=1e-5)
    assert not crossings(one, line((0, 5e3, 0), (9e3, 6e3, 0)))


def test_cuts_by_length_ratio_point_and_crossing_with_an_offset():
    one, two = line((0, 0, 0), (9e3, 0, 0)), line((2e3, -3e3, 40), (2e3, 5e3, 40))
    assert cut_place(one, length=1200.0, offset=30.0) == 1230.0
    assert cut_place(one, length=-1000.0) == pytest.approx(8000.0)
    assert cut_place(one, ratio=0.25, offset=-50.0) == pytest.approx(2200.0)
    assert cut_place(one, point=(3e3, 400, -300)) == pytest.approx(3e3)
    assert cut_place(one, crossing=two, offset=100.0) == pytest.approx(2100.0)
    assert refused(cut_place, one, length=9500.0).code == "cut-beyond-axis"
    assert refused(cut_place, one, point=(3e3, 4000, 0)).code == "cut-point-far"
    away = line((0, 5e3, 0), (9e3, 6e3, 0))
    assert refused(cut_place, one, crossing=away).code == "cut-no-crossing"
    arc, chord = axis_from_curve("C", ARC), line((12e3, 0, 0), (-2e3, 0, 14e3 * 0.9))
    assert refused(cut_place, chord, crossing=arc).code == "cut-crossing-ambiguous"
    assert refused(cut_place, one, length=1.0, ratio=0.5).code == "cut-place"


ROWS = np.array([0.0, 0.3, 0.5, 0.8, 1.0])
MOVES = np.array([[0, 0, 0], [5, 0, 30], [8, -4, 45], [3, 0, 20], [0, 0, 0.0]])


def test_a_preset_moves_the_axis_by_its_table():
    made = with_preset(AXIS, Preset(ROWS, MOVES, "ratio"))
    s = made.place_of(AXIS.position(ROWS * AXIS.length) + MOVES)
    assert np.abs(made.position(s) - AXIS.position(ROWS * AXIS.length) - MOVES).max() < 1e-5
    assert made.design_place(s)[:, 0] == pytest.approx(ROWS * AXIS.length, abs=1e-3)
    by_length = with_preset(AXIS, Preset(ROWS * AXIS.length, MOVES))
    assert by_length.length == pytest.approx(made.length, abs=1e-9)


def test_both_coordinates_of_every_control_point_are_kept():
    made = with_preset(AXIS, Preset(ROWS, MOVES, "ratio"))
    assert np.array_equal(made.control_design, AXIS.control)
    assert made.control.shape == AXIS.control.shape
    where = made.place_of(made.control)
    assert np.abs(made.position(where) - made.control).max() < 1e-4
    assert np.abs(AXIS.position(made.design_place(where)[:, 0]) - AXIS.control).max() < 1e-2


def test_normals_stay_those_of_the_design_surface_at_the_design_point():
    lift = np.array([[0, 0, 400.0]])
    made = with_preset(AXIS, Preset(np.array([0.0]), lift))
    s = np.linspace(0, made.length, 31)
    assert made.length == pytest.approx(AXIS.length, abs=1e-5)
    assert np.abs(made.surface_points(s) - AXIS.position(s)).max() < 1e-4
    # A shifted axis has the tangents of the design axis, so the frames are the same.
    moved, plain = surface_frames(made, HALL).at(s), surface_frames(AXIS, HALL).at(s)
    assert np.abs(moved.z - plain.z).max() < 1e-6
    assert np.abs(moved.origin - plain.origin - lift).max() < 1e-4


def test_the_last_displacement_is_held_beyond_the_table():
    made = with_preset(AXIS, Preset(np.array([0.2, 0.5, 0.8]), MOVES[1:4], "ratio"))
    ends = made.position(np.array([0.0, made.length])) - AXIS.position(np.array([0.0, AXIS.length]))
    assert np.abs(ends - MOVES[[1, 3]]).max() < 1e-5
    assert [f.code for f in made.findings] == ["preset-held"]


@pytest.mark.parametrize(
    "preset, code",
    [
        (Preset(np.array([0.0, np.nan]), MOVES[:2]), "preset-not-a-number"),
        (Preset(np.array([0.0, 1.5]), MOVES[:2], "ratio"), "preset-beyond-axis"),
        (Preset(np.array([0.3, 0.3]), MOVES[:2], "ratio"), "preset-twice"),
        (Preset(np.array([]), np.zeros((0, 3))), "preset-empty"),
    ],
)
def test_presets_that_cannot_be_are_refused(preset, code):
    assert refused(with_preset, AXIS, preset).code == code
