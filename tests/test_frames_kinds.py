# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames surface, minimal, fixed and given, with twist and roll, on curves with exact truth."""

import math

import numpy as np
import pytest
from exact_axes import curves

from BendTorsionWB.core.axes.axis_input import AxisInput, axis_from
from BendTorsionWB.core.axes.axis_preset import Preset
from BendTorsionWB.core.axes.frames import (
    FRAMES,
    FrameInput,
    frames_of,
    torsion_angle,
    wanted_z,
    winding_number,
)
from BendTorsionWB.core.axes.frames_law import GivenDirection
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane

CURVES = curves()
AXES = {name: curve.axis() for name, curve in CURVES.items()}
TABLE = (
    GivenDirection(0.0, 0.1, None, True),
    GivenDirection(0.4, 0.5, None, True),
    GivenDirection(1.0, -0.2, None, True),
)


def at(axis, surface, given, count=201):
    return frames_of(axis, surface, given).at(np.linspace(0, axis.length, count))


@pytest.mark.parametrize("name", CURVES)
def test_torsion_angle_is_the_integral_of_geodesic_torsion(name):
    curve, axis = CURVES[name], AXES[name]
    s, theta = torsion_angle(frames_of(axis, curve.surface))
    truth = curve.torsion_to(curve.parameters_at(s))
    assert np.degrees(np.abs(theta - truth).max()) < 1e-6


@pytest.mark.parametrize("kind", FRAMES)
@pytest.mark.parametrize("name", ["E-S", "T-diag", "HP-line", "HP-S", "E-wave", "T-ring"])
def test_frames_are_what_is_worked_out_afresh(name, kind):
    curve, axis = CURVES[name], AXES[name]
    table = TABLE[:2] if curve.closed else TABLE
    given = FrameInput(kind, 0.3, given=table, twist=table)
    s = np.linspace(0, axis.length, 41)
    own = frames_of(axis, curve.surface, given).at(s)
    assert np.abs(own.z - wanted_z(axis, curve.surface, given, s)).max() < 1e-8
    assert np.abs((own.x * own.z).sum(axis=1)).max() < 1e-9
    assert np.abs(np.linalg.norm(own.z, axis=1) - 1).max() < 1e-9


@pytest.mark.parametrize("name", ["E-diag", "T-diag", "HP-line", "HP-S", "N-diag"])
def test_a_minimal_frame_does_not_turn_about_an_open_axis(name):
    curve, axis = CURVES[name], AXES[name]
    frames = frames_of(axis, curve.surface, FrameInput("minimal"))
    assert np.degrees(np.abs(torsion_angle(frames)[1]).max()) < 1e-6
    assert np.abs(frames.at(np.linspace(0, axis.length, 301)).twist).max() < 1e-9
    normal = curve.surface.closest(axis.position(np.zeros(1))).normals
    assert np.abs(frames.at(np.zeros(1)).z - normal).max() < 1e-9


@pytest.mark.parametrize(
    ("name", "total", "turns"),
    [("T-ring", -358.650, -1), ("E-wave", -3.790, 0), ("E-ring", 0.0, 0)],
)
def test_closed_axes_close_and_count_their_turns(name, total, turns):
    curve, axis = CURVES[name], AXES[name]
    ends = np.array([0.0, axis.length])
    for kind in ("surface", "minimal", "fixed"):
        z = frames_of(axis, curve.surface, FrameInput(kind)).at(ends).z
        assert np.abs(z[1] - z[0]).max() < 1e-9
    surface = frames_of(axis, curve.surface)
    assert np.degrees(torsion_angle(surface)[1][-1]) == pytest.approx(total, abs=1e-3)
    assert winding_number(surface) == turns
    # What the minimal frame misses at the seam is spread: it turns evenly.
    minimal = frames_of(axis, curve.surface, FrameInput("minimal"))
    twist = minimal.at(np.linspace(0, axis.length, 101)).twist
    missing = total - 360 * turns
    assert np.degrees(twist * axis.length) == pytest.approx(np.full(101, missing), abs=1e-3)


def test_fixed_frames_stand_upright():
    axis = AXES["T-diag"]
    own = at(axis, None, FrameInput("fixed"))
    assert np.abs(own.y[:, 2]).max() < 1e-12
    tilted = at(axis, None, FrameInput("fixed", math.radians(30)))
    angle = np.degrees(
        np.arctan2((np.cross(own.z, tilted.z) * own.x).sum(axis=1), (own.z * tilted.z).sum(axis=1))
    )
    assert angle == pytest.approx(np.full(201, 30.0), abs=1e-9)


def test_given_angles_and_directions_are_met_and_smooth_between():
    curve, axis = CURVES["E-diag"], AXES["E-diag"]
    minimal = frames_of(axis, curve.surface, FrameInput("minimal"))
    places = np.array([0.0, 8e3, 15e3, axis.length])
    angles = np.array([0.0, 0.4, 0.1, 2.0])
    rows = tuple(GivenDirection(s, a) for s, a in zip(places, angles, strict=True))
    given = frames_of(axis, curve.surface, FrameInput("given", given=rows))
    base, own = minimal.at(places), given.at(places)
    met = np.arctan2((np.cross(base.z, own.z) * base.x).sum(axis=1), (base.z * own.z).sum(axis=1))
    assert np.abs(met - angles).max() < 1e-9
    directions = tuple(
        GivenDirection(s, None, tuple(z)) for s, z in zip(places, own.z, strict=True)
    )
    again = frames_of(axis, curve.surface, FrameInput("given", given=directions))
    s = np.linspace(0, axis.length, 400)
    assert np.abs(again.at(s).z - given.at(s).z).max() < 1e-8
    # The twist rate has no jump at the inner stations.
    beside = given.at(np.sort(np.concatenate([places[1:3] - 1e-3, places[1:3] + 1e-3]))).twist
    assert np.abs(beside[1::2] - beside[::2]).max() < 1e-8


def test_a_twist_law_adds_to_any_frame_and_is_held_beyond_its_stations():
    curve, axis = CURVES["E-diag"], AXES["E-diag"]
    law = (GivenDirection(0.25, 0.0, None, True), GivenDirection(0.75, 0.5, None, True))
    s = np.linspace(0, axis.length, 201)
    for kind in ("surface", "minimal"):
        plain, turned = (
            frames_of(axis, curve.surface, FrameInput(kind, twist=t)).at(s) for t in ((), law)
        )
        angle = np.arctan2(
            (np.cross(plain.z, turned.z) * plain.x).sum(axis=1), (plain.z * turned.z).sum(axis=1)
        )
        assert np.abs(angle[s < 0.25 * axis.length]).max() < 1e-9
        assert np.abs(angle[s > 0.75 * axis.length] - 0.5).max() < 1e-9
        assert (np.diff(angle) > -1e-9).all()
    even = (
        frames_of(
            axis,
            curve.surface,
            FrameInput(
                "minimal", twist=(GivenDirection(0.0, 0.0), GivenDirection(1.0, 1.0, None, True))
            ),
        )
        .at(s)
        .twist
    )
    assert even * axis.length == pytest.approx(np.ones(201), abs=1e-6)


def test_a_preset_keeps_the_normals_of_the_design_surface():
    curve = CURVES["E-diag"]
    points = curve.points(9, 5)
    preset = Preset(
        np.array([0.0, 0.5, 1.0]), np.array([[0, 0, 0], [0, 0, 900.0], [0, 0, 0]]), "ratio"
    )
    axis = axis_from(AxisInput("A", points, preset=preset), curve.surface)
    s = np.linspace(0, axis.length, 101)
    own = frames_of(axis, curve.surface).at(s)
    normals = curve.surface.closest(axis.surface_points(s)).normals
    assert np.abs((np.cross(normals, own.z) * own.x).sum(axis=1)).max() < 1e-9
    moved = curve.surface.closest(axis.position(s)).normals
    assert np.abs((np.cross(moved, own.z) * own.x).sum(axis=1)).max() > 1e-3


@pytest.mark.parametrize(
    ("given", "code"),
    [
        (FrameInput("given"), "frame-table-empty"),
        (FrameInput("fixed", direction=(0.0, 0.0, 0.0)), "frame-direction"),
        (FrameInput("fixed", direction=(1.0, 0.0, 0.0)), "axis-along-direction"),
        (FrameInput("bishop"), "frame-kind"),
        (FrameInput(twist=(GivenDirection(9e9, 1.0),)), "frame-station-outside"),
        (
            FrameInput(twist=(GivenDirection(10.0, 1.0), GivenDirection(10.0, 2.0))),
            "frame-stations-order",
        ),
        (
            FrameInput("given", given=(GivenDirection(0.0, None, (1.0, 0.0, 0.0)),)),
            "frame-direction",
        ),
    ],
)
def test_frames_that_cannot_be_are_errors_with_their_place(given, code):
    axis = axis_from(AxisInput("A9", np.array([[0, 0, 0], [9e3, 0, 0.0]])), Plane())
    with pytest.raises(BendTorsionError) as caught:
        frames_of(axis, Plane(), given)
    assert [f.code for f in caught.value.findings] == [code]
    assert caught.value.findings[0].object == "A9"


def test_a_closed_axis_takes_whole_turns_only():
    curve, axis = CURVES["E-ring"], AXES["E-ring"]
    ends = (GivenDirection(0.0, 0.0), GivenDirection(1.0, 2 * math.pi, None, True))
    assert winding_number(frames_of(axis, curve.surface, FrameInput("minimal", twist=ends))) == 1
    with pytest.raises(BendTorsionError) as caught:
        frames_of(
            axis,
            curve.surface,
            FrameInput(
                "minimal", twist=(GivenDirection(0.0, 0.0), GivenDirection(1.0, 1.0, None, True))
            ),
        )
    assert [f.code for f in caught.value.findings] == ["frame-does-not-close"]
