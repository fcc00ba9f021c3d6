# SPDX-License-Identifier: LGPL-2.1-or-later
"""Member frames: orthonormal, turned by the surface's normal, torsion as the surface says."""

import numpy as np
import pytest
from curved_members import ELLIPSOID, HALF_AXES, diagonal, hand_frames, irregular, oblique, rotation

from BendTorsionWB.core.axes.axis import axis_from_curve, fit_axis
from BendTorsionWB.core.axes.frames import surface_frames, torsion_angle
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.geometry.piecewise import sample
from BendTorsionWB.core.geometry.surface import Flipped, analytic_surface
from BendTorsionWB.core.members.member import Member


def framed(curve=diagonal, count=9, surface=ELLIPSOID, **more):
    return surface_frames(fit_axis("A1", irregular(curve, count), surface), surface, **more)


def helix(radius, lead, turns=0.4, count=61):
    """Points of a helix on the cylinder about z, and its angle α to the circles."""
    angle = 2 * np.pi * turns * np.linspace(0, 1, count)
    points = np.column_stack(
        [radius * np.cos(angle), radius * np.sin(angle), lead * angle / (2 * np.pi)]
    )
    return points, np.arctan2(lead, 2 * np.pi * radius)


def test_frames_are_orthonormal_right_handed_and_stand_on_the_axis():
    frames = framed()
    s = np.linspace(0, frames.axis.length, 301)
    at = frames.at(s)
    matrix = np.stack([at.x, at.y, at.z], axis=1)
    assert np.abs(matrix @ matrix.transpose(0, 2, 1) - np.eye(3)).max() < 1e-9
    assert np.linalg.det(matrix) == pytest.approx(1.0, abs=1e-9)
    assert np.abs(at.origin - frames.axis.position(s)).max() < 1e-8


def test_z_is_the_outward_normal_less_its_tangent_part():
    frames = framed()
    s = np.linspace(0.5, frames.axis.length - 0.5, 301)
    member = Member("M1", frames, None)
    origin, x, y, z = hand_frames(member, ELLIPSOID, s)
    at = frames.at(s)
    for own, by_hand in ((at.x, x), (at.y, y), (at.z, z)):
        assert np.linalg.norm(np.cross(own, by_hand), axis=1).max() < 1e-9
        assert (own * by_hand).sum(axis=1).min() > 0
    assert ((at.z * origin / HALF_AXES**2).sum(axis=1) > 0).all()


def test_rates_are_those_of_the_frame_vectors():
    frames = framed(oblique)
    s, h = np.linspace(100, frames.axis.length - 100, 57), 2.0
    at, before, after = frames.at(s), frames.at(s - h), frames.at(s + h)
    x_rate, y_rate, z_rate = (
        (getattr(after, v) - getattr(before, v)) / (2 * h) for v in ("x", "y", "z")
    )
    expected = (
        (x_rate, at.ky[:, None] * at.y + at.kz[:, None] * at.z),
        (y_rate, -at.ky[:, None] * at.x + at.twist[:, None] * at.z),
        (z_rate, -at.kz[:, None] * at.x - at.twist[:, None] * at.y),
    )
    for measured, stated in expected:
        assert np.abs(measured - stated).max() < 1e-9


def test_torsion_of_a_helix_on_a_cylinder():
    points, alpha = helix(9000.0, 20000.0)
    surface = analytic_surface("cylinder", {"r": 9000.0})
    frames = surface_frames(fit_axis("A1", points, surface), surface)
    s, theta = torsion_angle(frames)
    # Geodesic torsion of a curve at angle α to the circles of a cylinder: sin α cos α / r.
    expected = np.sin(alpha) * np.cos(alpha) / 9000.0 * s
    assert np.abs(np.abs(theta) - expected).max() < 1e-5
    mirrored = points * [1, 1, -1]
    other = torsion_angle(surface_frames(fit_axis("A1", mirrored, surface), surface))[1]
    assert np.abs(other + theta).max() < 1e-9
    assert abs(theta[-1]) > 0.3


@pytest.mark.parametrize("curve", [diagonal, oblique])
def test_torsion_is_the_integral_of_the_geodesic_torsion(curve):
    """On the exact curve: −∫ dN·y with N from the ellipsoid's gradient, by central differences."""
    t = np.linspace(0, 1, 20001)
    points = curve(t)
    normal = points / HALF_AXES**2
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    middle = 0.5 * (normal[1:] + normal[:-1])
    y = np.cross(middle, np.diff(points, axis=0))
    y /= np.linalg.norm(y, axis=1, keepdims=True)
    expected = -(np.diff(normal, axis=0) * y).sum()
    axis = fit_axis("A1", curve(np.linspace(0, 1, 241)), ELLIPSOID)
    _, theta = torsion_angle(surface_frames(axis, ELLIPSOID))
    assert theta[-1] == pytest.approx(expected, abs=2e-7)
    assert abs(expected) > 0.02
    # What twelve points do not tell of the curve stays unknown; it is little.
    sparse = torsion_angle(framed(curve, 12))[1][-1]
    assert np.degrees(abs(sparse - expected)) < 0.02


def test_torsion_does_not_depend_on_the_stations():
    frames = framed()
    coarse, fine = torsion_angle(frames, 57), torsion_angle(frames, 301)
    assert coarse[1][-1] == pytest.approx(fine[1][-1], abs=1e-7)


def test_a_straight_ruling_twists_with_its_surface():
    """Along the ruling x = 0 of z = x y / c the normal turns by atan(y / c)."""

    class Saddle:
        c = 8000.0

        def closest(self, points):
            gradient = np.column_stack(
                [-points[:, 1] / self.c, -points[:, 0] / self.c, np.ones(len(points))]
            )
            normals = gradient / np.linalg.norm(gradient, axis=1, keepdims=True)
            return type("Foot", (), {"points": points, "normals": normals})

    line = fit_axis("A1", [[0, 0, 0], [0, 6000, 0]], None)
    s, theta = torsion_angle(surface_frames(line, Saddle()))
    assert np.abs(np.abs(theta) - np.arctan(s / 8000)).max() < 1e-10


def test_roll_turns_the_section_about_the_tangent():
    plain, rolled = framed(), framed(roll=0.3)
    s = np.linspace(0, plain.axis.length, 41)
    a, b = plain.at(s), rolled.at(s)
    assert np.abs(b.z - (np.cos(0.3) * a.z - np.sin(0.3) * a.y)).max() < 1e-9
    assert torsion_angle(rolled)[1][-1] == pytest.approx(torsion_angle(plain)[1][-1], abs=1e-9)


def test_a_flipped_surface_turns_height_and_breadth_round():
    plain, other = framed(), framed(surface=Flipped(ELLIPSOID))
    s = np.linspace(0, plain.axis.length, 41)
    assert np.abs(plain.at(s).z + other.at(s).z).max() < 1e-9
    assert np.abs(plain.at(s).y + other.at(s).y).max() < 1e-9


def test_a_normal_that_flips_from_side_to_side_is_carried_on():
    """A surface whose reported normals change sign half way: the section must not turn over."""

    class Fickle:
        def closest(self, points):
            foot = ELLIPSOID.closest(points)
            side = np.where(points[:, :1] > 30000.0, -1.0, 1.0)
            return type("Foot", (), {"points": foot.points, "normals": foot.normals * side})

    axis = fit_axis("A1", irregular(diagonal), ELLIPSOID)
    # Breaks exactly where the sign changes, as an axis has knots at the borders of its faces.
    s = axis.place_of(diagonal(np.linspace(0, 1, 400)))
    x = axis.position(s)[:, 0]
    crossing = np.interp(30000.0, x[::-1], s[::-1])
    for _ in range(4):
        crossing -= (axis.position([crossing])[0, 0] - 30000.0) / axis.tangent([crossing])[0, 0]
    breaks = np.sort(np.append(axis.position.breaks, crossing))
    cut = type(axis)(
        axis.name, axis.curve, sample(axis.position, breaks), axis.given, axis.moved, axis.control
    )
    frames = surface_frames(cut, Fickle())
    z = frames.at(np.linspace(0, axis.length, 2001)).z
    assert (z[1:] * z[:-1]).sum(axis=1).min() > 0.99


def test_a_rigid_motion_turns_the_frames():
    turn = rotation()

    class Moved:
        def closest(self, points):
            foot = ELLIPSOID.closest(points @ turn)
            return type(
                "Foot", (), {"points": foot.points @ turn.T, "normals": foot.normals @ turn.T}
            )

    curve = fit_axis("A1", irregular(diagonal), ELLIPSOID).curve
    moved = Curve(curve.degree, curve.knots, curve.poles @ turn.T, curve.weights)
    here = surface_frames(axis_from_curve("A1", curve), ELLIPSOID)
    there = surface_frames(axis_from_curve("A1", moved), Moved())
    s = np.linspace(0, here.axis.length, 33)
    for vector in ("x", "y", "z"):
        difference = getattr(there.at(s), vector) - getattr(here.at(s), vector) @ turn.T
        assert np.abs(difference).max() < 1e-8
    assert torsion_angle(there)[1][-1] == pytest.approx(torsion_angle(here)[1][-1], abs=1e-9)


def test_an_axis_along_the_normal_is_refused_with_its_place():
    plane = analytic_surface("plane", {})
    with pytest.raises(BendTorsionError) as caught:
        surface_frames(fit_axis("A1", [[0, 0, 0], [10, 0, 5000]], plane, fit="keep"), plane)
    [finding] = caught.value.findings
    assert finding.code == "axis-along-normal" and finding.position.startswith("s = ")
